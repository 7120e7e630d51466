//! `shaders/base/sampling.glsl`: every routine inverted, or its points counted against its density.

use crate::common::chi2;
use crate::common::probe::{Probe, Word, as_doubles, floats};
use crate::common::random::Random;
use crate::common::twins::sampling::{
    DISK_ERROR, disk_inverse, sphere_inverse, triangle_inverse, turn, turns_apart,
};
use std::f64::consts::{PI, TAU};

const COUNT: usize = 200_000;

/// Uniform random numbers: two for the sampling, two to spare.
fn uniforms(seed: u64) -> Vec<Word> {
    let mut random = Random(seed);
    let mut all: Vec<Word> =
        (0..COUNT).map(|_| floats(random.f32(), random.f32(), random.f32(), random.f32())).collect();
    // The edges of the square
    let edges = [0.0, 0.5, 0.999_999_94];
    for (i, x) in edges.into_iter().enumerate() {
        for (j, y) in edges.into_iter().enumerate() {
            all[i * 3 + j] = floats(x, y, 0.0, 0.0);
        }
    }
    all
}

/// Runs an expression of `u` (a vec4 of uniform numbers) that is a vec4.
fn sample(expression: &str, inputs: &[Word]) -> Vec<[f64; 4]> {
    let glsl = format!(
        "#include \"base/sampling.glsl\"
        void probe(uint i) {{
            vec4 u = uintBitsToFloat(fetch_points(i));
            store_values(i, floatBitsToUint({expression}));
        }}"
    );
    let values = Probe::new().both(&glsl, inputs, inputs.len(), inputs.len());
    values.into_iter().map(as_doubles).collect()
}

/// Counts of points of the unit square in 16 × 32 cells.
fn square_counts(points: impl Iterator<Item = [f64; 2]>) -> Vec<u64> {
    let mut counts = vec![0; 512];
    for [x, y] in points {
        assert!((-1e-6..=1.0 + 1e-6).contains(&x) && (-1e-6..=1.0 + 1e-6).contains(&y), "{x} {y}");
        let cell = |v: f64, n: usize| ((v * n as f64).max(0.0) as usize).min(n - 1);
        counts[cell(x, 16) * 32 + cell(y, 32)] += 1;
    }
    counts
}

#[track_caller]
fn expect_disk_inverse([u, v]: [f64; 2], [x, y]: [f64; 2]) {
    let [a, b] = disk_inverse(x, y);
    let error = (a - u).abs().max((b - v).abs());
    assert!(error < DISK_ERROR, "({u}, {v}): ({x}, {y}) comes back as ({a}, {b})");
}

#[test]
fn disk_points_are_uniform_and_go_back_to_the_square() {
    let inputs = uniforms(1);
    let points = sample("vec4(disk_sample(u.xy), 0.0, 0.0)", &inputs);
    for (input, [x, y, ..]) in inputs.iter().zip(&points) {
        let [u, v, ..] = as_doubles(*input);
        let r = x.hypot(*y);
        assert!(r <= 1.0 + 1e-6);
        expect_disk_inverse([u, v], [*x, *y]);
    }
    let counts = square_counts(points.iter().map(|[x, y, ..]| [x * x + y * y, turn(*x, *y)]));
    chi2::accept(&[("disk".into(), chi2::test_uniform(&counts))]);
}

#[test]
fn polygon_points_are_uniform_and_go_back_to_the_square() {
    let inputs = uniforms(2);
    let mut results = Vec::new();
    for (corners, rotation) in [(3, 0.0), (5, 0.3), (6, -1.0), (8, 7.0_f64)] {
        let points =
            sample(&format!("vec4(polygon_sample(u.xy, {corners}u, {rotation:?}), 0.0, 0.0)"), &inputs);
        let n = corners as f64;
        let (apothem, half_side) = ((PI / n).cos(), (PI / n).sin());
        let mut sides = vec![0_u64; corners];
        let mut on_side = vec![Vec::new(); corners];
        for (input, [x, y, ..]) in inputs.iter().zip(&points) {
            let [u, v, ..] = as_doubles(*input);
            let side = ((turn(*x, *y) - rotation / TAU).rem_euclid(1.0) * n) as usize % corners;
            let middle = (side as f64 + 0.5) / n * TAU + rotation;
            let out = x * middle.cos() + y * middle.sin();
            let along = -x * middle.sin() + y * middle.cos();
            let share = out / apothem;
            assert!(share <= 1.0 + 1e-5, "{corners} corners: ({x}, {y}) is outside");
            sides[side] += 1;
            let at = if share > 0.0 { 0.5 + along / (2.0 * half_side * share) } else { 0.5 };
            // At a corner rounding decides the side: the other one has the same point at its other end
            let corner = at.min(1.0 - at) < 1e-4 || share < 1e-4;
            let back = (side as f64 + share * share) / n;
            // Sines of GPUs are off by up to 2⁻²⁰
            assert!(corner || (back - u).abs() < 4e-6, "{corners} corners: {u} comes back as {back}");
            assert!(corner || (at - v).abs() * share < 4e-6, "{corners} corners: {v} comes back as {at}");
            on_side[side].push([share * share, at.clamp(0.0, 1.0)]);
        }
        results.push((format!("sides of {corners}"), chi2::test_uniform(&sides)));
        for (i, points) in on_side.into_iter().enumerate() {
            let share = |p: &[f64; 2]| [p[0].min(1.0), p[1]];
            let counts = square_counts(points.iter().map(share));
            results.push((format!("side {i} of {corners}"), chi2::test_uniform(&counts)));
        }
    }
    chi2::accept(&results);
}

#[test]
fn hemisphere_and_sphere_follow_their_densities_and_go_back_to_the_square() {
    let inputs = uniforms(3);
    let hemisphere = sample(
        "vec4(cosine_hemisphere_sample(u.xy), cosine_hemisphere_pdf(cosine_hemisphere_sample(u.xy).z))",
        &inputs,
    );
    for [x, y, z, pdf] in &hemisphere {
        assert!((x * x + y * y + z * z - 1.0).abs() < 1e-5 && *z >= 0.0, "{x} {y} {z}");
        assert!((pdf - z / PI).abs() < 1e-6);
    }
    for (input, [x, y, ..]) in inputs.iter().zip(&hemisphere) {
        let [u, v, ..] = as_doubles(*input);
        expect_disk_inverse([u, v], [*x, *y]);
    }
    // cos² θ is uniform when the density is cos θ / π
    let counts = square_counts(hemisphere.iter().map(|[x, y, z, _]| [z * z, turn(*x, *y)]));
    let sphere = sample("vec4(sphere_sample(u.xy), 0.0)", &inputs);
    for (input, [x, y, z, _]) in inputs.iter().zip(&sphere) {
        let [u, v, ..] = as_doubles(*input);
        assert!((x * x + y * y + z * z - 1.0).abs() < 1e-5);
        let back = sphere_inverse([*x, *y, *z]);
        assert!((u - back[0]).abs() < 1e-6);
        assert!(turns_apart(v, back[1]) * (1.0 - z * z).sqrt() < 1e-5, "{u} {v}");
    }
    let sphere = square_counts(sphere.iter().map(|[x, y, z, _]| [(1.0 - z) / 2.0, turn(*x, *y)]));
    chi2::accept(&[
        ("cosine".into(), chi2::test_uniform(&counts)),
        ("sphere".into(), chi2::test_uniform(&sphere)),
    ]);
}

#[test]
fn triangle_points_are_uniform_and_go_back_to_the_square() {
    let inputs = uniforms(4);
    let points = sample("vec4(triangle_sample(u.xy), 0.0, 0.0)", &inputs);
    for (input, [b, c, ..]) in inputs.iter().zip(&points) {
        let ([u, v, ..], back) = (as_doubles(*input), triangle_inverse(*b, *c));
        assert!((back[0] - u).abs().max((back[1] - v).abs()) < 2e-7, "({u}, {v}) comes back as {back:?}");
    }
    let counts = square_counts(points.iter().map(|[b, c, ..]| {
        assert!(*b >= 0.0 && *c >= 0.0 && b + c <= 1.0, "{b} {c}");
        // Of all points, (1 − b)² have a second coordinate beyond b; the third is then uniform
        [(1.0 - b) * (1.0 - b), (c / (1.0 - b).max(1e-12)).min(1.0)]
    }));
    chi2::accept(&[("triangle".into(), chi2::test_uniform(&counts))]);
}

type Filter = fn(f64) -> f64;

/// The filters as they are documented in the scene language, not normalised.
fn filters() -> [(&'static str, Filter); 3] {
    [
        ("tent_sample", |x| 1.0 - x.abs()),
        ("gaussian_sample", |x| (-4.5 * x * x).exp() - f64::exp(-4.5)),
        ("blackman_harris_sample", |x| {
            let t = (x + 1.0) * PI;
            0.35875 - 0.48829 * t.cos() + 0.14128 * (2.0 * t).cos() - 0.01168 * (3.0 * t).cos()
        }),
    ]
}

/// Integral of a filter over a part of its range, by the midpoint rule.
fn integral(f: Filter, low: f64, high: f64) -> f64 {
    let n = 2000;
    let step = (high - low) / f64::from(n);
    (0..n).map(|i| f(low + (f64::from(i) + 0.5) * step) * step).sum()
}

#[test]
fn filter_samples_follow_the_filters() {
    let inputs = uniforms(5);
    let mut results = Vec::new();
    for (name, filter) in filters() {
        let offsets = sample(&format!("vec4({name}(u.x), {name}(1.0 - u.x), 0.0, 0.0)"), &inputs);
        let whole = integral(filter, -1.0, 1.0);
        let mut counts = vec![0_u64; 64];
        for (i, (input, [x, mirrored, ..])) in inputs.iter().zip(&offsets).enumerate() {
            assert!((-1.0..=1.0).contains(x), "{name}: {x}");
            let u = as_doubles(*input)[0];
            // Where the filter is nearly 0, a share of 1e-6 (float error of the integral) is a long way
            let slope = filter(*x) / whole;
            if slope > 0.05 {
                assert!((x + mirrored).abs() < 4e-6 + 2e-6 / slope, "{name}({u}): {x} and {mirrored}");
            }
            if i % 400 == 0 {
                // Bisection stops within 2⁻²⁰; error_function is good to 1.5e-7
                let share = integral(filter, -1.0, *x) / whole;
                assert!((share - u).abs() < 3e-6, "{name}({u}): {x}, the integral there is {share}");
            }
            counts[((x + 1.0) * 32.0).min(63.0) as usize] += 1;
        }
        let cell = |i: usize| {
            let low = i as f64 / 32.0 - 1.0;
            integral(filter, low, low + 1.0 / 32.0) / whole * COUNT as f64
        };
        let expected: Vec<f64> = (0..64).map(cell).collect();
        results.push((name.to_string(), chi2::test(&counts, &expected)));
    }
    chi2::accept(&results);
}
