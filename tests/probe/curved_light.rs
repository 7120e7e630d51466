//! `shaders/light/part.glsl` and `patch.glsl`: points are uniform over the shape, densities are those of light_pdf, and solid
//! angles are those of closed forms or of quadrature.

use crate::common::chi2;
use crate::common::lights::{check, expect_solid_angle};
use crate::common::lights::{light, samples};
use crate::common::twins::math::{cross, dot, length, normalize, sub, wide};
use crate::common::twins::sampling::turn;
use dapple::layout::{LIGHT_CYLINDER, LIGHT_DISK_PART, LIGHT_PATCH, LIGHT_SPHERE_PART, Light};
use std::f64::consts::{PI, TAU};

const COUNT: usize = 100_000;

/// A part of a quadric about +z at the origin, seen from both sides. `z` is the length of its third axis.
fn part(kind: u32, radius: f32, z: f32, turn: f32, uv2: [f32; 2]) -> Light {
    let (edge_u, edge_v) = ([radius, 0.0, 0.0], [0.0, radius, 0.0]);
    Light { edge_u, edge_v, uv1: [z, turn], uv2, a: 1.0, two_sided: 1, ..light(kind) }
}

#[test]
fn parts_are_sampled_uniformly_by_area() {
    let mut results = Vec::new();
    // Kind, third axis, turn, limits; where it is seen from; solid angle; share of the area below a point
    type Share = fn([f64; 3]) -> f64;
    let cases: [(Light, [f32; 3], f64, Share); 5] = [
        // All of a sphere between two heights, from its middle: its area over r²
        (
            part(LIGHT_SPHERE_PART, 2.0, 2.0, 0.7, [-0.5, 0.75]),
            [0.0; 3],
            TAU * f64::from(0.7_f32) * 1.25,
            |p| (p[2] / 2.0 + 0.5) / 1.25,
        ),
        (part(LIGHT_SPHERE_PART, 0.5, 0.5, 1.0, [0.25, 1.0]), [0.0; 3], TAU * 0.75, |p| {
            (p[2] / 0.5 - 0.25) / 0.75
        }),
        // A tube from the middle of its lower end: sine of the elevation of the rim
        (
            part(LIGHT_CYLINDER, 1.5, 2.0, 0.6, [0.0; 2]),
            [0.0; 3],
            TAU * f64::from(0.6_f32) * 2.0 / (1.5 * 1.5 + 4.0_f64).sqrt(),
            |p| p[2] / 2.0,
        ),
        (
            part(LIGHT_CYLINDER, 1.0, 1.0, 1.0, [0.0; 2]),
            [0.0, 0.0, 0.5],
            2.0 * TAU * 0.5 / 1.25_f64.sqrt(),
            |p| p[2],
        ),
        // A ring from a point of its axis: the difference of two cones
        (
            part(LIGHT_DISK_PART, 2.0, 2.0, 0.9, [0.25, 0.0]),
            [0.0, 0.0, 1.0],
            TAU * f64::from(0.9_f32) * (1.0 / 1.25_f64.sqrt() - 1.0 / 5_f64.sqrt()),
            |p| (p[0] * p[0] + p[1] * p[1] - 0.25) / 3.75,
        ),
    ];
    for (light, from, solid_angle, share) in cases {
        let place = format!("{light:?}");
        let all = samples(&light, from, COUNT);
        let kind = light.kind;
        let mean = check(&place, &light, from, &all, |p| match kind {
            LIGHT_SPHERE_PART => normalize(p),
            LIGHT_DISK_PART => [0.0, 0.0, 1.0],
            _ => normalize([p[0], p[1], 0.0]),
        });
        assert!(all.iter().all(|s| s.pdf > 0.0), "{place}");
        expect_solid_angle(&place, &all, mean, solid_angle, 1e-4);
        let (radius, turns) = (f64::from(light.edge_u[0]), f64::from(light.uv1[1]));
        let mut counts = vec![0_u64; 144];
        for s in &all {
            let p = s.point;
            let across = p[0].hypot(p[1]);
            let on = match kind {
                LIGHT_SPHERE_PART => length(p) / radius - 1.0,
                LIGHT_DISK_PART => p[2],
                _ => across / radius - 1.0,
            };
            assert!(on.abs() < 1e-6, "{place}: {p:?}");
            let (a, b) = (share(p), turn(p[0], p[1]) / turns);
            assert!(
                (a - s.u01[0]).abs() < 1e-5 && (b - s.u01[1]).abs() < 1e-5,
                "{place}: {:?}: {a} {b}",
                s.u01
            );
            let cell = |x: f64| ((x * 12.0).max(0.0) as usize).min(11);
            counts[cell(a) * 12 + cell(b)] += 1;
        }
        results.push((place, chi2::test_uniform(&counts)));
    }
    chi2::accept(&results);
}

#[test]
fn a_stretched_tube_has_the_density_of_its_area() {
    // Sheared and mirrored; the area by quadrature, from where all of it is seen
    let (u, v, w) = ([2.0_f32, 0.0, 0.1], [0.3, -0.5, 0.0], [0.2, 0.1, 1.0]);
    let tube = Light {
        edge_u: u,
        edge_v: v,
        uv0: [w[0], w[1]],
        uv1: [w[2], 0.8],
        a: -1.0,
        two_sided: 1,
        ..light(LIGHT_CYLINDER)
    };
    let from = [0.1, 0.0, 0.4];
    let (u, v, w) = (wide(u), wide(v), wide(w));
    let n = 1000;
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    let all = samples(&tube, from, COUNT);
    let normal_of = |phi: f64| {
        let (s, c) = phi.sin_cos();
        let along = [0, 1, 2].map(|i| -s * u[i] + c * v[i]);
        cross(along, w)
    };
    let mut solid_angle = 0.0;
    for k in 0..n * n {
        let (phi, z) = (TAU * f64::from(0.8_f32) * at(k / n), at(k % n));
        let (s, c) = phi.sin_cos();
        let to = [0, 1, 2].map(|i| c * u[i] + s * v[i] + z * w[i] - f64::from(from[i]));
        solid_angle += dot(normal_of(phi), to).abs() / length(to).powi(3);
    }
    solid_angle *= TAU * f64::from(0.8_f32) / (n * n) as f64;
    let mut sum = 0.0;
    for s in &all {
        assert!((s.pdf_again / s.pdf - 1.0).abs() < 1e-3, "{} and {}", s.pdf, s.pdf_again);
        let phi = TAU * f64::from(0.8_f32) * s.u01[1];
        let normal = normalize(normal_of(phi));
        assert!((dot(normal, s.normal).abs() - 1.0).abs() < 1e-5, "{normal:?} {:?}", s.normal);
        sum += 1.0 / s.pdf;
    }
    let mean = sum / all.len() as f64;
    expect_solid_angle("a stretched tube", &all, mean, solid_angle, 1e-4);
}

#[test]
fn patches_have_the_density_of_their_area() {
    for (i, (u, v, twist, from)) in [
        ([2.0_f32, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 1.2_f32], [0.5_f32, 0.4, -1.0_f32]),
        ([1.0, 0.2, -0.3], [0.1, 1.0, 0.4], [0.6, -0.3, 0.2], [-0.5, 2.0, 1.0]),
        // A triangle: one edge has no length
        ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.2, 0.3, 0.7]),
    ]
    .into_iter()
    .enumerate()
    {
        let uv0 = [twist[0], twist[1]];
        let patch = Light {
            edge_u: u,
            edge_v: v,
            uv0,
            uv1: [twist[2], 0.0],
            a: 1.0,
            two_sided: 1,
            ..light(LIGHT_PATCH)
        };
        let (u, v, w) = (wide(u), wide(v), wide(twist));
        let point = |s: f64, t: f64| [0, 1, 2].map(|c| s * u[c] + t * v[c] + s * t * w[c]);
        let normal =
            |s: f64, t: f64| cross([0, 1, 2].map(|c| u[c] + t * w[c]), [0, 1, 2].map(|c| v[c] + s * w[c]));
        let all = samples(&patch, from, COUNT);
        let mut sum = 0.0;
        for s in all.iter().filter(|s| s.pdf > 0.0) {
            let [a, b] = s.u01;
            assert!(length(sub(s.point, point(a, b))) < 1e-6, "{i}: {:?}", s.point);
            let n = normal(a, b);
            let to = sub(s.point, wide(from));
            let density = length(to).powi(3) / dot(n, to).abs();
            let grazing = 1e-5 * length(n) * length(to) / dot(n, to).abs();
            assert!((s.pdf / density - 1.0).abs() < 1e-4 + grazing, "{i}: {} not {density}", s.pdf);
            // Next to a corner where the area vanishes, a rounding of u and v counts
            let rounding = 1e-3 + 10.0 * grazing + 1e-6 / length(n);
            assert!((s.pdf_again / s.pdf - 1.0).abs() < rounding, "{i}: {} and {}", s.pdf, s.pdf_again);
            sum += 1.0 / s.pdf;
        }
        let n = 1000;
        let at = |k: usize| (k as f64 + 0.5) / n as f64;
        let part = |k: usize| {
            let (a, b) = (at(k / n), at(k % n));
            let to = sub(point(a, b), wide(from));
            dot(normal(a, b), to).abs() / length(to).powi(3)
        };
        let solid_angle = (0..n * n).map(part).sum::<f64>() / (n * n) as f64;
        assert!(solid_angle < 2.0 * PI);
        expect_solid_angle(&format!("patch {i}"), &all, sum / all.len() as f64, solid_angle, 1e-4);
    }
}
