//! `shaders/light`: rectangles, triangles and disks. Points lie on the light, densities are those of light_pdf, and solid
//! angles are those of closed forms.

use crate::common::chi2;
use crate::common::lights::{check, expect_solid_angle, flat, samples};
use crate::common::random::Random;
use crate::common::twins::math::{cross, dot, length, normalize, sub, wide};
use crate::common::twins::sampling::{DISK_ERROR, disk_inverse, triangle_inverse};
use dapple::layout::{LIGHT_DISK, LIGHT_QUAD, LIGHT_TRIANGLE, Light};
use std::f64::consts::{PI, TAU};

const COUNT: usize = 100_000;

/// Solid angle of an axis-aligned part of a rectangle at distance z, by the arctangent of its four corners.
fn corner_angle(x: [f64; 2], y: [f64; 2], z: f64) -> f64 {
    let f = |x: f64, y: f64| (x * y / (z * (x * x + y * y + z * z).sqrt())).atan();
    f(x[1], y[1]) - f(x[0], y[1]) - f(x[1], y[0]) + f(x[0], y[0])
}

#[test]
fn rectangles_are_uniform_over_their_solid_angle() {
    let mut results = Vec::new();
    for (position, edge_u, edge_v, from) in [
        ([-1.0, -1.0, 2.0], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        // Off to one side in u, in v, in both
        ([1.0, -0.5, 2.0], [0.0, 1.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ([-0.5, 1.0, 1.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ([-3.0, 0.5, 1.0], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ([0.6, 1.0, 0.8], [1.6, 0.0, -1.2], [0.0, -3.0, 0.0], [-0.5, 0.25, 0.0]),
        // Close by, and small
        ([-2.0, -3.0, 0.05], [0.0, 5.0, 0.0], [5.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ([4.0, 3.0, 5.0], [0.0, 0.8, 0.0], [1.2, 0.0, 0.0], [0.0, 0.0, 0.0_f32]),
    ] {
        let place = format!("rectangle {position:?} {edge_u:?} {edge_v:?} from {from:?}");
        let mut light = flat(LIGHT_QUAD, position, edge_u, edge_v);
        let (u, v) = (wide(edge_u), wide(edge_v));
        let normal = normalize(cross(u, v));
        let to = sub(wide(position), wide(from));
        light.two_sided = u32::from(dot(normal, to) > 0.0);
        let all = samples(&light, from, COUNT);
        assert!(all.iter().all(|s| s.pdf > 0.0), "{place}");
        let mean = check(&place, &light, from, &all, |_| normal);
        let (lu, lv) = (length(u), length(v));
        let (x0, y0, z) = (dot(to, u) / lu, dot(to, v) / lv, dot(to, normal).abs());
        let whole = corner_angle([x0, x0 + lu], [y0, y0 + lv], z);
        // The solid angle is what four angles of 4e-7 each leave of 2π; a small rectangle is uniform over its area
        expect_solid_angle(&place, &all, mean, whole, 1e-5 + 2e-6 / whole);
        let cells = 12;
        let mut counts = vec![0_u64; cells * cells];
        for s in &all {
            let on = sub(s.point, wide(position));
            let (x, y) = (dot(on, u) / (lu * lu), dot(on, v) / (lv * lv));
            assert!(
                dot(on, normal).abs() < 1e-5
                    && (-1e-5..=1.0 + 1e-5).contains(&x)
                    && (-1e-5..=1.0 + 1e-5).contains(&y),
                "{place}: {x} {y}"
            );
            let cell = |t: f64| ((t * cells as f64).max(0.0) as usize).min(cells - 1);
            counts[cell(x) * cells + cell(y)] += 1;
            // Back to the square: the part of the solid angle before x, known to 1e-6, and of the sines at x before y
            let to_x = x0 + x * lu;
            let height = |y: f64| y / (to_x * to_x + z * z + y * y).sqrt();
            let [from_y, to_y, at_y] = [y0, y0 + lv, y0 + y * lv].map(height);
            let back =
                [corner_angle([x0, to_x], [y0, y0 + lv], z) / whole, (at_y - from_y) / (to_y - from_y)];
            let off = (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs());
            assert!(off < 4e-6 + 1e-6 / whole, "{place}: {:?} comes back as {back:?}", s.u01);
        }
        let step = 1.0 / cells as f64;
        let part = |i: usize, at: f64, l: f64| [at + l * i as f64 * step, at + l * (i + 1) as f64 * step];
        let expected: Vec<f64> = (0..cells * cells)
            .map(|i| corner_angle(part(i / cells, x0, lu), part(i % cells, y0, lv), z) / whole * COUNT as f64)
            .collect();
        results.push((place, chi2::test(&counts, &expected)));
    }
    chi2::accept(&results);
}

#[test]
fn small_rectangles_keep_their_solid_angle() {
    let mut random = Random(9);
    for i in 0..24 {
        // From 1e-5 to 0.1 steradians, seen aslant
        let size = random.between(-7.0, -1.0).exp2();
        let (x, y) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        let position = [x, y, 1.0];
        let mut light = flat(LIGHT_QUAD, position, [size, 0.0, 0.0], [0.0, 0.7 * size, 0.0]);
        light.two_sided = 1;
        let all = samples(&light, [0.0; 3], 4096);
        let mean = check(&format!("small {i}"), &light, [0.0; 3], &all, |_| [0.0, 0.0, 1.0]);
        let [x, y, size] = [x, y, size].map(f64::from);
        let whole = corner_angle([x, x + size], [y, y + f64::from(0.7_f32 * size as f32)], 1.0);
        // 1e-6 over the least angle that is sampled as such
        expect_solid_angle(&format!("small {i}: {whole}"), &all, mean, whole, 5e-4);
    }
}

/// Solid angle of a triangle whose corners are seen at a, b and c (Van Oosterom and Strackee 1983).
fn triangle_angle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let (la, lb, lc) = (length(a), length(b), length(c));
    let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * dot(a, cross(b, c)).abs().atan2(below)
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// Coordinates along two edges of a point of their plane, by the dual basis.
fn along(on: [f64; 3], u: [f64; 3], v: [f64; 3]) -> [f64; 2] {
    let across = cross(u, v);
    [cross(on, v), cross(u, on)].map(|c| dot(c, across) / dot(across, across))
}

#[test]
fn triangles_are_uniform_over_their_solid_angle() {
    let mut random = Random(7);
    let (mut by_angle, mut by_area) = (0, 0);
    for i in 0..24 {
        let place = format!("triangle {i}");
        // From a billionth of the sphere to nearly half of it
        let size = random.between(-12.0, 1.5).exp2();
        let from = [0.3, -0.2, 0.1];
        let (position, edge_u, edge_v) = (
            random.cube(1.0).map(|c| c * 1.5),
            random.cube(1.0).map(|c| c * size),
            random.cube(1.0).map(|c| c * size),
        );
        let light = Light { two_sided: 1, ..flat(LIGHT_TRIANGLE, position, edge_u, edge_v) };
        let (a, u, v) = (sub(wide(position), wide(from)), wide(edge_u), wide(edge_v));
        let [b, c] = [u, v].map(|edge| normalize(add(a, edge)));
        let whole = triangle_angle(a, b, c);
        let all = samples(&light, from, COUNT / 4);
        let normal = normalize(cross(u, v));
        let mean = check(&place, &light, from, &all, |_| normal);
        expect_solid_angle(&place, &all, mean, whole, 1e-4);
        let spherical = (3.1e-4..6.0).contains(&whole);
        let flat_enough = whole < 2.9e-4;
        by_angle += usize::from(spherical);
        by_area += usize::from(flat_enough);
        for s in &all {
            let [x, y] = along(sub(s.point, wide(position)), u, v);
            let rounding = 1e-6 * (1.0 + length(a) / size_of(u, v));
            assert!(x.min(y) > -rounding && x + y < 1.0 + rounding, "{place}: {x} {y} {:?}", s.u01);
            if flat_enough {
                let back = triangle_inverse(x, y);
                let off = (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs());
                assert!(off < 2.0 * rounding, "{place}: {:?} comes back as {back:?}", s.u01);
            }
            if spherical {
                assert!((s.pdf * whole - 1.0).abs() < 1e-4, "{place}: {} not 1 / {whole}", s.pdf);
                // Back to the square: where the arc from b through the point meets the opposite edge
                let met = normalize(cross(cross(b, s.wi), cross(normalize(a), c)));
                let met = if dot(met, add(normalize(a), c)) < 0.0 { met.map(|c| -c) } else { met };
                let height = |d: [f64; 3]| length(sub(d, b)).powi(2);
                let back = [triangle_angle(a, b, met) / whole, height(s.wi) / height(met)];
                // Near b every arc is as good as another
                let across = (height(s.wi) / whole).sqrt().min(1.0);
                let off = ((back[0] - s.u01[0]) * across).abs().max((back[1] - s.u01[1]).abs());
                assert!(off < 2e-5 + 1e-6 / whole, "{place} {whole}: {:?} comes back as {back:?}", s.u01);
            }
        }
        // From behind, a light that shines on one side is dark
        let behind = dot(normal, a) > 0.0;
        let one_sided = samples(&flat(LIGHT_TRIANGLE, position, edge_u, edge_v), from, 256);
        assert!(one_sided.iter().all(|s| (s.pdf == 0.0) == behind), "{place}");
    }
    assert!(by_angle > 6 && by_area > 3, "{by_angle} by solid angle, {by_area} by area");
}

/// The least height of a triangle by its edges.
fn size_of(u: [f64; 3], v: [f64; 3]) -> f64 {
    length(cross(u, v)) / length(u).max(length(v))
}

#[test]
fn parallelograms_and_disks_have_the_solid_angle_of_their_closed_form() {
    let from = [0.3, -0.2, 0.1];
    let mut random = Random(7);
    for i in 0..6 {
        let (position, edge_u, edge_v) =
            (random.cube(1.0).map(|c| c * 2.0), random.cube(2.0), random.cube(2.0));
        let (p, u, v) = (sub(wide(position), wide(from)), wide(edge_u), wide(edge_v));
        let normal = normalize(cross(u, v));
        // Two triangles make a parallelogram
        let solid_angle =
            triangle_angle(p, add(p, u), add(p, v)) + triangle_angle(add(p, add(u, v)), add(p, u), add(p, v));
        let place = format!("parallelogram {i}: {position:?} {edge_u:?} {edge_v:?}");
        let light = Light { two_sided: 1, ..flat(LIGHT_QUAD, position, edge_u, edge_v) };
        let all = samples(&light, from, COUNT);
        let mean = check(&place, &light, from, &all, |_| normal);
        expect_solid_angle(&place, &all, mean, solid_angle, 1e-4);
        for s in &all {
            let on = sub(s.point, wide(position));
            let back = along(on, u, v);
            assert!(dot(on, normal).abs() < 1e-5 / length(cross(u, v)).min(1.0), "{place}: {:?}", s.u01);
            let off = (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs());
            assert!(off < 2e-6, "{place}: {:?} comes back as {back:?}", s.u01);
        }
        // From behind, a light that shines on one side is dark
        let behind = dot(normal, p) > 0.0;
        let one_sided = samples(&flat(LIGHT_QUAD, position, edge_u, edge_v), from, 256);
        assert!(one_sided.iter().all(|s| (s.pdf == 0.0) == behind), "{place}");
    }
    for (height, radius) in [(1.0_f32, 1.0_f32), (0.3, 2.0), (4.0, 0.5)] {
        let place = format!("disk of {radius} at {height}");
        let light = flat(LIGHT_DISK, [0.0, 0.0, height], [radius, 0.0, 0.0], [0.0, -radius, 0.0]);
        let all = samples(&light, [0.0; 3], COUNT);
        let mean = check(&place, &light, [0.0; 3], &all, |_| [0.0, 0.0, -1.0]);
        let (h, r) = (f64::from(height), f64::from(radius));
        expect_solid_angle(&place, &all, mean, TAU * (1.0 - h / h.hypot(r)), 1e-4);
        assert!(all.iter().all(|s| s.point[0].hypot(s.point[1]) < r * (1.0 + 1e-6) && s.point[2] == h));
        for s in &all {
            let back = disk_inverse(s.point[0] / r, -s.point[1] / r);
            let off = (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs());
            assert!(off < DISK_ERROR, "{place}: {:?} comes back as {back:?}", s.u01);
        }
        // Irradiance of a parallel disk: π L r² / (r² + h²)
        let irradiance = all.iter().map(|s| s.radiance * s.wi[2] / s.pdf).sum::<f64>() / COUNT as f64;
        let expected = 3.0 * PI * r * r / (r * r + h * h);
        assert!((irradiance / expected - 1.0).abs() < 0.01, "{place}: {irradiance} not {expected}");
    }
}
