//! `shaders/light`: spheres, and lights without extent.

use crate::common::chi2;
use crate::common::lights::{check, expect_solid_angle, light, samples, sphere};
use crate::common::twins::math::{cross, dot, length, normalize, sub, wide};
use crate::common::twins::sampling::{disk_inverse, sphere_inverse, turn, turns_apart};
use dapple::layout::{LIGHT_POINT, LIGHT_PUNCTUAL, Light};
use dapple::scene::{InputNumber, PUNCTUAL_LIGHTS, Punctual, PunctualKind};
use std::f64::consts::{PI, TAU};

const COUNT: usize = 100_000;

#[test]
fn spheres_from_outside_fill_their_cone() {
    let mut results = Vec::new();
    for (position, radius, from) in [
        ([0.0, 2.0, 0.0], 1.0, [0.0, 0.0, 0.0]),
        ([1.0, -2.0, 0.5], 0.5, [3.0, 1.0, -1.0]),
        ([0.0, 0.0, 0.0], 1.0, [0.0, 0.0, 1.001]),
        ([5.0, 4.0, 3.0], 0.1, [-1.0, -2.0, 0.5]),
        ([100.0, 0.0, 0.0], 0.5, [0.0, 0.0, 0.0_f32]),
    ] {
        let place = format!("sphere {position:?} {radius} from {from:?}");
        let light = sphere(position, radius, 0);
        let all = samples(&light, from, COUNT);
        assert!(all.iter().filter(|s| s.pdf > 0.0).count() as f64 > 0.999 * COUNT as f64, "{place}");
        let center = wide(position);
        let mean = check(&place, &light, from, &all, |p| normalize(sub(p, center)));
        let axis = sub(center, wide(from));
        let distance = length(axis);
        let r = f64::from(radius);
        let cos_max = (1.0 - (r / distance).powi(2)).sqrt();
        // 1 − cos from an f32 distance: rounding over what is left of 1
        let rounding = 3e-7 / (1.0 - cos_max).max(1e-4) * (r / distance).powi(2) + 1e-5;
        expect_solid_angle(
            &place,
            &all,
            mean,
            TAU * (r / distance).powi(2) / (1.0 + cos_max),
            rounding + 1e-3,
        );
        let tall = normalize(axis);
        let side =
            normalize(cross(tall, if tall[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }));
        let other = cross(tall, side);
        let mut counts = vec![0_u64; 256];
        // A direction is known to a rounding, of which a small sphere is few; near the surface the way to it is short
        let sin_max = r / distance;
        let tolerance = 2e-6 + 6e-7 / sin_max + 1e-7 / (1.0 - sin_max);
        let mut zero = None;
        for s in all.iter().filter(|s| s.pdf > 0.0) {
            let on = sub(s.point, center);
            assert!((length(on) / r - 1.0).abs() < 2e-5, "{place}: {:?} is off the sphere", s.point);
            assert!(dot(on, axis) < 1e-4 * r * distance, "{place}: {:?} is behind", s.point);
            // The cosine is uniform over the cone; it comes from the angle across, which keeps its digits
            let across = length(cross(s.wi, tall));
            let share = across * across / (1.0 + (1.0 - across * across).max(0.0).sqrt()) / (1.0 - cos_max);
            let angle = turn(dot(s.wi, side), -dot(s.wi, other));
            counts[((share * 16.0) as usize).min(15) * 16 + ((angle * 16.0) as usize).min(15)] += 1;
            // Back to the square, whose zero of the angle is anywhere
            let zero = *zero.get_or_insert((angle - s.u01[1]).rem_euclid(1.0));
            let off = (share - s.u01[0]).abs().max(turns_apart(angle, s.u01[1] + zero) * across / sin_max);
            assert!(off < tolerance, "{place}: {:?} comes back as {share}, {angle} - {zero}", s.u01);
        }
        // A cone of 0.3° has its directions on a grid of floats: too coarse to count
        if r / distance > 0.01 {
            results.push((place, chi2::test_uniform(&counts)));
        }
    }
    chi2::accept(&results);
}

#[test]
fn spheres_from_inside() {
    for (radius, from) in [(1.0, [0.0, 0.0, 0.0]), (2.0, [0.5, 1.0, -0.5])] {
        let place = format!("inside a sphere of {radius} at {from:?}");
        let light = sphere([0.0; 3], radius, 1);
        let all = samples(&light, from, COUNT);
        let mean = check(&place, &light, from, &all, normalize);
        expect_solid_angle(&place, &all, mean, 4.0 * PI, 1e-4);
        // One that shines outward only is dark in there
        assert!(samples(&sphere([0.0; 3], radius, 0), from, 256).iter().all(|s| s.pdf == 0.0));
    }
}

#[test]
fn ellipsoids_are_uniform_over_the_ball_that_they_come_from() {
    let (center, from) = ([0.4, 2.0, -0.3_f32], [-0.5, 0.2, 0.1_f32]);
    // Upright, turned and mirrored
    for axes in [
        [[1.2, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.7]],
        [[0.6, 0.8, 0.0], [-0.4, 0.3, 0.2], [0.1, -0.1, 0.5]],
        [[-0.9, 0.0, 0.1], [0.0, 0.5, 0.0], [0.0, 0.2, 0.6_f32]],
    ] {
        let place = format!("ellipsoid {axes:?}");
        let [u, v, w] = axes.map(wide);
        let determinant = dot(u, cross(v, w));
        let [edge_u, edge_v, third] = axes;
        let light = Light {
            edge_u,
            edge_v,
            uv0: [third[0], third[1]],
            uv1: [third[2], 0.0],
            a: 0.0,
            ..sphere(center, 1.0, 1)
        };
        // Of a point of the ellipsoid, the one of the unit ball
        let back = |p: [f64; 3]| {
            let on = sub(p, wide(center));
            [dot(cross(v, w), on), dot(cross(w, u), on), dot(cross(u, v), on)].map(|c| c / determinant)
        };
        let normal_at = |p: [f64; 3]| {
            let n = back(p);
            let sum = |c: usize| cross(v, w)[c] * n[0] + cross(w, u)[c] * n[1] + cross(u, v)[c] * n[2];
            normalize([0, 1, 2].map(sum).map(|c| c * determinant.signum()))
        };
        let all = samples(&light, from, COUNT);
        let mean = check(&place, &light, from, &all, normal_at);
        // A ray meets the ellipsoid where its image meets the ball. It shines on both sides: what is behind counts, too
        let seen = solid_angle_of(|d| {
            let (o, d) = (back(wide(from)), back([0, 1, 2].map(|c| d[c] + f64::from(center[c]))));
            let (b, c) = (dot(o, d), dot(o, o) - 1.0);
            b < 0.0 && b * b > dot(d, d) * c
        });
        expect_solid_angle(&place, &all, mean, 2.0 * seen, 2e-3);
        for s in all.iter().filter(|s| s.pdf > 0.0) {
            let n = back(s.point);
            let [a, b] = sphere_inverse(n);
            let off = (a - s.u01[0]).abs().max(turns_apart(b, s.u01[1]) * n[0].hypot(n[1]));
            assert!(off < 1e-6, "{place}: {:?} comes back as {a}, {b}", s.u01);
        }
    }
}

/// Solid angle of the directions that fulfil a condition, by the midpoints of a grid.
fn solid_angle_of(holds: impl Fn([f64; 3]) -> bool) -> f64 {
    let n = 2000;
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    let direction = |i: usize| {
        let (z, phi) = (1.0 - 2.0 * at(i / n), TAU * at(i % n));
        let r = (1.0 - z * z).sqrt();
        [r * phi.cos(), r * phi.sin(), z]
    };
    4.0 * PI * (0..n * n).filter(|&i| holds(direction(i))).count() as f64 / (n * n) as f64
}

/// The number of a light of the table.
fn punctual(name: &str) -> u32 {
    LIGHT_PUNCTUAL + PunctualKind::named(name).unwrap().index() as u32
}

/// What `shines` of a row says is the mean of what its verb sends out around the axis.
#[test]
fn rows_shine_as_they_say() {
    const TURNS: u32 = 4;
    for row in PUNCTUAL_LIGHTS.iter().filter(|row| row.shines.is_some()) {
        let all = |of: fn(&InputNumber) -> f32| [0, 1, 2, 3].map(|i| row.numbers.get(i).map_or(0.0, of));
        let [usual, least, most] = [all(|n| n.default), all(|n| n.least), all(|n| n.most)];
        let turned = |a: [f32; 4], b: [f32; 4]| [0, 1, 2, 3].map(|i| if i % 2 == 0 { a[i] } else { b[i] });
        for numbers in [usual, least, most, turned(usual, most), turned(usual, least), turned(most, usual)] {
            let of = Punctual { kind: row, position: glam::Vec3::ZERO, numbers };
            let [a, b, c, d] = numbers;
            let (edge_u, edge_v) = ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0]);
            let light = Light { edge_u, edge_v, a, b, uv0: [c, d], ..light(punctual(row.name)) };
            for degrees in [0.7, 9.3, 20.9, 25.6, 27.3, 28.9, 29.8, 30.2, 47.1, 89.2, 91.3, 133.7, 179.1] {
                let (sine, cosine) = f64::to_radians(degrees).sin_cos();
                let sent = |turn: u32| {
                    let (y, x) = (TAU * f64::from(turn) / f64::from(TURNS)).sin_cos();
                    let from = [sine * x, sine * y, -cosine].map(|c| (2.0 * c) as f32);
                    let all = samples(&light, from, 64);
                    // The intensity is 3 and the distance 2
                    4.0 * all.iter().map(|s| s.radiance / s.pdf.max(1e-9)).sum::<f64>()
                        / (3.0 * all.len() as f64)
                };
                let mean = (0..TURNS).map(sent).sum::<f64>() / f64::from(TURNS);
                let said = of.shines(cosine).unwrap_or(f64::NAN);
                let place = format!("{} {numbers:?} at {degrees}°", row.name);
                assert!((mean - said).abs() < 1e-4, "{place}: {mean}, not {said}");
            }
        }
    }
}

/// A disk in the sky is where it should be, and gives a surface that faces it its irradiance.
#[test]
fn distant_light_from_a_disk() {
    let half = 10_f64.to_radians();
    let disk =
        Light { edge_u: [0.0, -1.0, 0.0], edge_v: [0.0, 0.0, -1.0], a: 20.0, ..light(punctual("distant")) };
    for s in samples(&disk, [5.0, 6.0, 7.0], 4096) {
        let sine = s.wi[0].hypot(s.wi[2]) / half.sin();
        assert!(sine < 1.0 + 1e-6 && (length(s.wi) - 1.0).abs() < 1e-6 && s.pdf == 1.0);
        assert!((s.radiance * s.wi[1] - 3.0).abs() < 1e-5);
        let [x, y] = disk_inverse(s.wi[0] / half.sin(), -s.wi[2] / half.sin());
        let off = (x - s.u01[0]).abs().max((y - s.u01[1]).abs());
        assert!(off < 1e-5, "{:?} is off by {off}", s.u01);
    }
}

#[test]
fn lights_without_extent() {
    let point = Light { position: [0.0, 2.0, 0.0], ..light(LIGHT_POINT) };
    for s in samples(&point, [0.0; 3], 8) {
        assert_eq!((s.wi, s.pdf, s.point), ([0.0, 1.0, 0.0], 1.0, [0.0, 2.0, 0.0]));
        assert_eq!(s.radiance, 0.75, "intensity / d²");
    }
    assert!(samples(&point, [0.0, 2.0, 0.0], 8).iter().all(|s| s.pdf == 0.0));
    let cos = |degrees: f64| degrees.to_radians().cos();
    let spot = Light {
        position: [0.0, 1.0, 0.0],
        edge_u: [0.0, -1.0, 0.0],
        // Half-angle of the cone, and what of it is soft
        a: 30.0,
        b: 10.0,
        ..light(punctual("spot"))
    };
    for (degrees, share) in [(0.0, 1.0), (19.9, 1.0), (30.1, 0.0), (60.0, 0.0), (25.0, f64::NAN)] {
        let x = f64::to_radians(degrees).tan();
        for s in samples(&spot, [x as f32, 0.0, 0.0], 8) {
            let t = (cos(degrees) - cos(30.0)) / (cos(20.0) - cos(30.0));
            let share = if share.is_nan() { t * t * (3.0 - 2.0 * t) } else { share };
            let expected = 3.0 * share / (1.0 + x * x);
            assert!((s.radiance - expected).abs() < 1e-4, "{degrees}°: {} not {expected}", s.radiance);
        }
    }
    let distant = Light { edge_u: [0.6, -0.8, 0.0], ..light(punctual("distant")) };
    for s in samples(&distant, [5.0, 6.0, 7.0], 8) {
        assert!(length(sub(s.wi, [-0.6, 0.8, 0.0])) < 1e-6 && s.radiance == 3.0 && s.pdf == 1.0);
    }
}
