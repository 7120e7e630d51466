//! `shaders/light`: points lie on the light, densities are those of light_pdf, and solid angles are those of closed forms.

use crate::common::chi2;
use crate::common::lights::{Sample, flat, light, samples, sphere};
use crate::common::random::Random;
use crate::common::twins::math::{cross, dot, length, normalize, sub, wide};
use crate::common::twins::sampling::{
    DISK_ERROR, disk_inverse, sphere_inverse, triangle_inverse, turn, turns_apart,
};
use dapple::layout::{LIGHT_DISK, LIGHT_DISTANT, LIGHT_POINT, LIGHT_QUAD, LIGHT_SPOT, LIGHT_TRIANGLE, Light};
use std::f64::consts::{PI, TAU};

const COUNT: usize = 100_000;

/// Checks what holds for every point on a surface light, and gives the mean of 1 / pdf over all samples.
fn check(
    place: &str,
    light: &Light,
    from: [f32; 3],
    all: &[Sample],
    normal_at: impl Fn([f64; 3]) -> [f64; 3],
) -> f64 {
    let from = wide(from);
    let mut sum = 0.0;
    for s in all.iter().filter(|s| s.pdf > 0.0) {
        let to = sub(s.point, from);
        let reach = length(s.point).max(length(from));
        assert!(
            length(sub(normalize(to), s.wi)) < 2e-6 * (1.0 + reach / length(to)),
            "{place}: wi {:?}",
            s.wi
        );
        let normal = normal_at(s.point);
        let side = dot(s.normal, normal);
        assert!((side.abs() - 1.0).abs() < 1e-4, "{place}: normal {:?}, not {normal:?}", s.normal);
        assert!(light.two_sided != 0 || side > 0.0, "{place}: the back of the light is seen");
        // Seen from `from`; a grazing point may be on either side of its horizon by rounding
        assert!(dot(s.normal, s.wi) < 1e-3, "{place}: {:?} looks away", s.point);
        assert_eq!(s.radiance, f64::from(light.radiance[0]), "{place}");
        // The same formula of the same point; where it grazes the surface, the cosine keeps few digits
        let grazing = 2e-6 / dot(normal, s.wi).abs().max(1e-6);
        assert!((s.pdf_again / s.pdf - 1.0).abs() < 1e-4 + grazing, "{place}: {} and {}", s.pdf, s.pdf_again);
        sum += 1.0 / s.pdf;
    }
    sum / all.len() as f64
}

/// |mean of 1 / pdf − solid angle| within `relative`, or four standard errors of samples whose 1 / pdf spreads.
fn expect_solid_angle(place: &str, all: &[Sample], mean: f64, solid_angle: f64, relative: f64) {
    let n = all.len() as f64;
    let squares: f64 = all.iter().filter(|s| s.pdf > 0.0).map(|s| s.pdf.powi(-2)).sum();
    let sigma = ((squares / n - mean * mean).max(0.0) / n).sqrt();
    let tolerance = relative * solid_angle + 4.0 * sigma;
    assert!((mean - solid_angle).abs() < tolerance, "{place}: {mean} ± {sigma}, not {solid_angle}");
}

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

#[test]
fn parallelograms_disks_and_triangles_have_the_solid_angle_of_their_closed_form() {
    let from = [0.3, -0.2, 0.1];
    // Two triangles make a parallelogram; Van Oosterom and Strackee 1983 give the angle of each
    let triangle_angle = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        let (la, lb, lc) = (length(a), length(b), length(c));
        let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        2.0 * dot(a, cross(b, c)).abs().atan2(below)
    };
    let add = |a: [f64; 3], b: [f64; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let mut random = Random(7);
    for i in 0..6 {
        let (position, edge_u, edge_v) =
            (random.cube(1.0).map(|c| c * 2.0), random.cube(2.0), random.cube(2.0));
        let (p, u, v) = (sub(wide(position), wide(from)), wide(edge_u), wide(edge_v));
        let normal = normalize(cross(u, v));
        let half = triangle_angle(p, add(p, u), add(p, v));
        let other = triangle_angle(add(p, add(u, v)), add(p, u), add(p, v));
        for (kind, solid_angle) in [(LIGHT_TRIANGLE, half), (LIGHT_QUAD, half + other)] {
            let place = format!("{kind} {i}: {position:?} {edge_u:?} {edge_v:?}");
            let light = Light { two_sided: 1, ..flat(kind, position, edge_u, edge_v) };
            let all = samples(&light, from, COUNT);
            let mean = check(&place, &light, from, &all, |_| normal);
            expect_solid_angle(&place, &all, mean, solid_angle, 1e-4);
            for s in &all {
                // Coordinates along the edges, by the dual basis
                let on = sub(s.point, wide(position));
                let across = cross(u, v);
                let l2 = dot(across, across);
                let (x, y) = (dot(cross(on, v), across) / l2, dot(cross(u, on), across) / l2);
                let most = if kind == LIGHT_TRIANGLE { x + y } else { x.max(y) };
                let area = l2.sqrt();
                assert!(
                    x.min(y) > -1e-4 && most < 1.0 + 1e-4 && dot(on, normal).abs() < 1e-5 / area.min(1.0),
                    "{place}: {x} {y} {:?}",
                    s.u01
                );
                let back = if kind == LIGHT_TRIANGLE { triangle_inverse(x, y) } else { [x, y] };
                let off = (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs());
                assert!(off < 2e-6, "{place}: {:?} comes back as {back:?}", s.u01);
            }
            // From behind, a light that shines on one side is dark
            let behind = dot(normal, p) > 0.0;
            let one_sided = samples(&flat(kind, position, edge_u, edge_v), from, 256);
            assert!(one_sided.iter().all(|s| (s.pdf == 0.0) == behind), "{place}");
        }
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

#[test]
fn lights_without_extent() {
    let point = Light { position: [0.0, 2.0, 0.0], ..light(LIGHT_POINT) };
    for s in samples(&point, [0.0; 3], 8) {
        assert_eq!((s.wi, s.pdf, s.point), ([0.0, 1.0, 0.0], 1.0, [0.0, 2.0, 0.0]));
        assert_eq!(s.radiance, 0.75, "intensity / d²");
    }
    assert!(samples(&point, [0.0, 2.0, 0.0], 8).iter().all(|s| s.pdf == 0.0));
    let cos = |degrees: f64| degrees.to_radians().cos() as f32;
    let spot = Light {
        position: [0.0, 1.0, 0.0],
        edge_u: [0.0, -1.0, 0.0],
        a: cos(20.0),
        b: cos(30.0),
        ..light(LIGHT_SPOT)
    };
    for (degrees, share) in [(0.0, 1.0), (19.9, 1.0), (30.1, 0.0), (60.0, 0.0), (25.0, f64::NAN)] {
        let x = f64::to_radians(degrees).tan();
        for s in samples(&spot, [x as f32, 0.0, 0.0], 8) {
            let t = (f64::cos(f64::to_radians(degrees)) - f64::from(spot.b)) / f64::from(spot.a - spot.b);
            let share = if share.is_nan() { t * t * (3.0 - 2.0 * t) } else { share };
            let expected = 3.0 * share / (1.0 + x * x);
            assert!((s.radiance - expected).abs() < 1e-4, "{degrees}°: {} not {expected}", s.radiance);
        }
    }
    let distant = Light { edge_u: [0.6, -0.8, 0.0], ..light(LIGHT_DISTANT) };
    for s in samples(&distant, [5.0, 6.0, 7.0], 8) {
        assert!(length(sub(s.wi, [-0.6, 0.8, 0.0])) < 1e-6 && s.radiance == 3.0 && s.pdf == 1.0);
    }
}
