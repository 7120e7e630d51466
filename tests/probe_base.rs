//! `shaders/base`: hashes, Sobol points, fixed point, ray offset, bases.

mod common;

use common::chi2;
use common::probe::{Probe, Word, as_doubles, as_floats, floats};
use common::random::Random;
use common::twins::{fixed, math, random};

const SAMPLERS: &str = "#define SAMPLER_CENTER 0\n#define SAMPLER_REGULAR 1\n#define SAMPLER_RANDOM 2\n\
    #define SAMPLER_STRATIFIED 3\n#define SAMPLER_SOBOL 4\n";

/// Includes `base/random.glsl` with a sampler.
fn with_sampler(sampler: &str, body: &str) -> String {
    format!("{SAMPLERS}#define SAMPLER {sampler}\n#include \"base/random.glsl\"\n{body}")
}

/// Numbers with few and many bits, and random ones.
fn uints(count: usize, seed: u64) -> Vec<u32> {
    let mut random = Random(seed);
    let edges = [0, 1, 2, 3, u32::MAX, u32::MAX - 1, 1 << 31, (1 << 31) - 1, 0xffff, 0x1_0000];
    edges.into_iter().chain(std::iter::repeat_with(|| random.u32())).take(count).collect()
}

#[test]
fn hashes_are_their_twins() {
    let glsl = with_sampler(
        "SAMPLER_SOBOL",
        "void probe(uint i) {
            uvec4 p = fetch_points(i);
            store_values(2u * i, uvec4(hash(p.x), hash2(p.x, p.y), owen_hash(p.x, p.y), pascal_product(p.x)));
            store_values(2u * i + 1u, uvec4(sobol_2d(p.x, p.y), floatBitsToUint(uniform_float(p.x)), 0u));
        }",
    );
    let (a, b) = (uints(20_000, 1), uints(19_997, 2));
    let inputs: Vec<Word> = a.iter().zip(b.iter().cycle()).map(|(&a, &b)| [a, b, 0, 0]).collect();
    let values = Probe::new().both(&glsl, &inputs, inputs.len(), 2 * inputs.len());
    // Integer functions: no tolerance
    for (i, [a, b, ..]) in inputs.iter().copied().enumerate() {
        let ([h, h2, owen, pascal], [x, y, uniform, _]) = (values[2 * i], values[2 * i + 1]);
        assert_eq!(random::hash_inverse(h), a, "hash({a})");
        assert_eq!(h2, random::hash2(a, b), "hash2({a}, {b})");
        assert_eq!(owen, random::fast_owen(a.reverse_bits(), b).reverse_bits(), "owen_hash({a}, {b})");
        assert_eq!(pascal, random::sobol(a)[1].reverse_bits(), "pascal_product({a})");
        assert_eq!([x, y], random::sobol_2d(a, b), "sobol_2d({a}, {b})");
        let expected = f64::from(a >> 8) / 16_777_216.0;
        assert_eq!(f64::from(f32::from_bits(uniform)), expected, "uniform_float({a})");
    }
}

#[test]
fn known_values_of_the_twins() {
    let quarters: Vec<[f64; 2]> =
        (0..4).map(|i| random::sobol(i).map(|v| f64::from(v) / 4_294_967_296.0)).collect();
    assert_eq!(quarters, [[0.0, 0.0], [0.5, 0.5], [0.25, 0.75], [0.75, 0.25]]);
    for a in uints(1000, 3) {
        assert_eq!(random::hash_inverse(random::hash(a)), a);
    }
}

#[test]
fn owen_hash_is_a_nested_scrambling() {
    let glsl = with_sampler(
        "SAMPLER_SOBOL",
        "void probe(uint i) { uvec4 p = fetch_points(i); store_values(i, uvec4(owen_hash(p.x, p.y))); }",
    );
    // For each number, itself and itself with one bit turned: no bit below that one may change, and that one must
    let numbers = uints(500, 4);
    let mut random = Random(5);
    let mut inputs = Vec::new();
    for &v in &numbers {
        let seed = random.u32();
        inputs.push([v, seed, 0, 0]);
        inputs.extend((0..32).map(|bit| [v ^ 1 << bit, seed, 0, 0]));
    }
    let values = Probe::new().both(&glsl, &inputs, inputs.len(), inputs.len());
    for group in values.chunks_exact(33) {
        for bit in 0..32 {
            assert_eq!((group[0][0] ^ group[bit + 1][0]).trailing_zeros(), bit as u32);
        }
    }
}

#[test]
fn permute_is_a_permutation() {
    let glsl = with_sampler(
        "SAMPLER_SOBOL",
        "void probe(uint i) { uvec4 p = fetch_points(i); store_values(i, uvec4(permute(p.x, p.y, p.z))); }",
    );
    let mut random = Random(6);
    let mut inputs = Vec::new();
    // The last ones are what `strata` of more than 256 x 256 ask for
    for n in (1..=100).chain([255, 256, 257, 1000, 4096, 65_537, 300_007]) {
        let orders = match n {
            16 => 256,
            65_537.. => 1,
            _ => 8,
        };
        for _ in 0..orders {
            let seed = random.u32();
            inputs.extend((0..n).map(|i| [i, n, seed, 0]));
        }
    }
    let values = Probe::new().both(&glsl, &inputs, inputs.len(), inputs.len());
    let mut at = 0;
    let mut orders = std::collections::BTreeSet::new();
    while at < inputs.len() {
        let n = inputs[at][1] as usize;
        let order: Vec<u32> = values[at..at + n].iter().map(|v| v[0]).collect();
        let mut sorted = order.clone();
        sorted.sort_unstable();
        let twice = sorted.windows(2).find(|pair| pair[0] == pair[1]);
        assert!(sorted.iter().copied().eq(0..n as u32), "n = {n}: twice or more: {twice:?}");
        if n == 16 {
            orders.insert(order);
        }
        at += n;
    }
    // 256 of the 16! orders: none is drawn twice
    assert_eq!(orders.len(), 256, "seeds share orders");
}

#[test]
fn sobol_blocks_have_one_point_in_every_elementary_interval() {
    let glsl = with_sampler(
        "SAMPLER_SOBOL",
        "void probe(uint i) {
            uvec4 p = fetch_points(i);
            SampleKey key = sample_key(uvec2(p.z, 7u), p.x, p.y, uvec2(1u));
            vec2 u01 = sample_2d(key, p.w);
            store_values(i, uvec4(floatBitsToUint(u01), floatBitsToUint(sample_1d(key, p.w)), 0u));
        }",
    );
    let mut inputs = Vec::new();
    for seed in [0, 1, 12_345] {
        for (pixel, dimension) in [(0, 0), (3, 1), (100, 9)] {
            for block in [0, 1, 5, 4095] {
                inputs.extend((block * 1024..(block + 1) * 1024).map(|i| [i, seed, pixel, dimension]));
            }
        }
    }
    let values = Probe::new().both(&glsl, &inputs, inputs.len(), inputs.len());
    for (points, input) in values.chunks_exact(1024).zip(inputs.chunks_exact(1024)) {
        for point in points {
            assert_eq!(point[0], point[2], "sample_1d is the first of sample_2d");
        }
        for k in 0..=10_u32 {
            for block in points.chunks_exact(1 << k) {
                for across in 0..=k {
                    let (columns, rows) = (1_u32 << across, 1_u32 << (k - across));
                    let mut seen = vec![false; 1 << k];
                    for point in block {
                        let [x, y, ..] = as_floats(*point);
                        let cell = (x * columns as f32) as u32 + columns * (y * rows as f32) as u32;
                        let again = std::mem::replace(&mut seen[cell as usize], true);
                        assert!(!again, "2^{k} points, {columns} × {rows} cells, {:?}", input[0]);
                    }
                }
            }
        }
    }
}

#[test]
fn dimensions_pixels_and_seeds_are_independent() {
    let glsl = with_sampler(
        "SAMPLER_SOBOL",
        "void probe(uint i) {
            uvec4 p = fetch_points(i);
            vec2 a = sample_2d(sample_key(uvec2(10u, 20u), i, 1u, uvec2(1u)), 1u);
            vec2 b = sample_2d(sample_key(uvec2(10u, 20u) + p.xy, i, 1u + p.z, uvec2(1u)), 1u + p.w);
            store_values(i, floatBitsToUint(vec4(a, b)));
        }",
    );
    let mut results = Vec::new();
    for change in
        [[0, 0, 0, 1], [0, 0, 0, 2], [0, 0, 0, 8], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 1, 1, 1]]
    {
        let n = 1 << 14;
        let values = Probe::new().both(&glsl, &vec![change; n], n, n);
        for (first, second) in [(0, 2), (0, 3), (1, 2), (1, 3), (0, 1)] {
            let mut counts = vec![0; 256];
            for value in &values {
                let f = as_floats(*value);
                counts[(f[first] * 16.0) as usize * 16 + (f[second] * 16.0) as usize] += 1;
            }
            results.push((format!("{change:?} {first} {second}"), chi2::test_uniform(&counts)));
        }
    }
    chi2::accept(&results);
}

#[test]
fn keys_differ_by_pixel_and_seed() {
    let glsl = with_sampler(
        "SAMPLER_RANDOM",
        "void probe(uint i) {
            uvec4 p = fetch_points(i);
            SampleKey key = sample_key(p.xy, p.w, p.z, uvec2(1u));
            store_values(i, uvec4(key.pixel, floatBitsToUint(random_2d(key, 0u)), floatBitsToUint(random_2d(key, 1u).x)));
        }",
    );
    let mut inputs: Vec<Word> = Vec::new();
    for y in 0..128 {
        inputs.extend((0..128).flat_map(|x| [[x, y, 0, 0], [x, y, 1, 0]]));
    }
    let pixels = inputs.len();
    inputs.extend((0..1 << 15).map(|index| [5, 6, 0, index]));
    let values = Probe::new().both(&glsl, &inputs, inputs.len(), inputs.len());
    let distinct: std::collections::BTreeSet<u32> = values[..pixels].iter().map(|v| v[0]).collect();
    // 2^15 keys of 32 bits: an eighth of a collision is expected by chance
    assert!(pixels - distinct.len() <= 3, "{} of {pixels} keys are alike", pixels - distinct.len());
    let samples: std::collections::BTreeSet<[u32; 2]> =
        values[pixels..].iter().map(|v| [v[1], v[2]]).collect();
    assert!((1 << 15) - samples.len() <= 2, "samples of a pixel are alike");
}

#[test]
fn strata_are_visited_once_a_pass() {
    let body = "void probe(uint i) {
            SampleKey key = sample_key(uvec2(3u, 4u), i, 9u, uvec2(5u, 3u));
            store_values(i, floatBitsToUint(vec4(sample_2d(key, 2u), sample_pixel(key, 0u))));
        }";
    let cells = |values: &[Word], lane: usize| -> Vec<usize> {
        let cell = |f: [f32; 4]| (f[lane] * 5.0) as usize + 5 * (f[lane + 1] * 3.0) as usize;
        values.iter().map(|v| cell(as_floats(*v))).collect()
    };
    let stratified = Probe::new().both(&with_sampler("SAMPLER_STRATIFIED", body), &[], 60, 60);
    for lane in [0, 2] {
        let passes: Vec<Vec<usize>> = cells(&stratified, lane).chunks_exact(15).map(<[_]>::to_vec).collect();
        assert!(passes[0] != passes[1], "every pass has an order of its own");
        for mut pass in passes {
            pass.sort_unstable();
            assert!(pass.into_iter().eq(0..15), "lane {lane}");
        }
    }
    let regular = Probe::new().both(&with_sampler("SAMPLER_REGULAR", body), &[], 60, 60);
    assert!(cells(&regular, 2).into_iter().eq((0..60).map(|i| i % 15)));
    let center = Probe::new().both(&with_sampler("SAMPLER_CENTER", body), &[], 60, 60);
    assert!(center.iter().all(|v| as_floats(*v)[2..] == [0.5, 0.5]));
}

#[test]
fn fixed_from_float_is_the_nearest_integer() {
    let glsl = "#include \"base/fixed.glsl\"
        void probe(uint i) {
            uvec4 p = fetch_points(i);
            float x = uintBitsToFloat(p.x);
            store_values(i, uvec4(fixed_from_float(x), fixed_add(fixed_from_float(x), fixed_from_float(uintBitsToFloat(p.y)))));
        }";
    let mut random = Random(7);
    let mut numbers: Vec<f32> =
        vec![0.0, 0.5, 1.0, 1.5, 2.5, 0.49999997, 0.99999994, 274_877_906_944.0, 1e-30];
    // Around every power of two up to 2^38, where halves are lost and limbs overflow
    for exponent in 0..38 {
        let power = (exponent as f32).exp2();
        numbers.extend([
            power.next_down(),
            power,
            power.next_up(),
            power + 0.5,
            power + 1.0,
            1.5 * power + 0.5,
        ]);
    }
    numbers.extend((0..20_000).map(|_| random.between(-1.0, 1.0) * random.between(0.0, 38.0).exp2()));
    let inputs: Vec<Word> = numbers
        .iter()
        .flat_map(|&x| [x, -x])
        .map(|x| floats(x, random.between(-1.0, 1.0) * random.between(0.0, 38.0).exp2(), 0.0, 0.0))
        .collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (input, value) in inputs.iter().zip(&values) {
        let [x, y, ..] = as_floats(*input);
        let (x_fixed, y_fixed) = (fixed::fixed_from_float(x), fixed::fixed_from_float(y));
        assert_eq!(value[..2], fixed::fixed_words(x_fixed), "fixed_from_float({x})");
        assert_eq!(value[2..], fixed::fixed_words(x_fixed + y_fixed), "{x} + {y}");
    }
}

#[test]
fn wide_sums_carry() {
    let glsl = "#include \"base/fixed.glsl\"
        void probe(uint i) {
            uvec3 a = fetch_points(3u * i).xyz;
            uvec3 b = fetch_points(3u * i + 1u).xyz;
            uvec4 p = fetch_points(3u * i + 2u);
            store_values(3u * i, uvec4(fixed_wide_add(a, b), 0u));
            store_values(3u * i + 1u, uvec4(fixed_add(a.xy, b.xy), 0u, 0u));
            store_values(3u * i + 2u, uvec4(fixed_wide_from_float(uintBitsToFloat(p.x)), 0u));
        }";
    let mut random = Random(8);
    let limb = |r: &mut Random| match r.u32() % 4 {
        0 => 0,
        1 => u32::MAX,
        2 => u32::MAX - r.u32() % 3,
        _ => r.u32(),
    };
    let mut inputs: Vec<Word> = Vec::new();
    for i in 0..10_000 {
        for _ in 0..2 {
            inputs.push([limb(&mut random), limb(&mut random), limb(&mut random), 0]);
        }
        let x = if i < 76 { (i as f32).exp2() } else { random.between(0.0, 75.9).exp2() };
        inputs.push(floats(if i % 2 == 0 { x } else { x.next_down() }, 0.0, 0.0, 0.0));
    }
    let values = Probe::new().both(glsl, &inputs, inputs.len() / 3, inputs.len());
    let wide = |w: Word| u128::from(w[0]) | u128::from(w[1]) << 32 | u128::from(w[2]) << 64;
    for (input, value) in inputs.chunks_exact(3).zip(values.chunks_exact(3)) {
        let sum = wide(input[0]) + wide(input[1]);
        assert_eq!(value[0][..3], fixed::fixed_wide_words(sum), "{input:?}");
        let narrow = |w: Word| u64::from(w[0]) | u64::from(w[1]) << 32;
        let sum = narrow(input[0]).wrapping_add(narrow(input[1]));
        assert_eq!(value[1][..2], fixed::fixed_words(sum as i64), "{input:?}");
        let x = f32::from_bits(input[2][0]);
        assert_eq!(value[2][..3], fixed::fixed_wide_words(fixed::fixed_wide_from_float(x)), "{x}");
    }
}

#[test]
fn rays_start_on_the_side_of_the_normal() {
    let glsl = "#include \"base/offset.glsl\"
        void probe(uint i) {
            vec4 p = uintBitsToFloat(fetch_points(2u * i));
            vec3 n = uintBitsToFloat(fetch_points(2u * i + 1u).xyz);
            store_values(i, uvec4(floatBitsToUint(offset_ray_origin(p.xyz, n, p.w)), 0u));
        }";
    let mut random = Random(9);
    let mut cases = vec![([0.0; 3], [0.0, 0.0, 1.0], 1.0), ([1.0, -1.0, 0.0], [0.0, 1.0, 0.0], 1.0)];
    for _ in 0..20_000 {
        let size = random.between(-60.0, 60.0).exp2();
        // No coordinate of a point is larger than those of its surface
        let (p, more) = (random.cube(size), random.between(0.0, 6.0).exp2());
        cases.push((p, random.direction(), more * p.iter().fold(0.0_f32, |most, c| most.max(c.abs()))));
    }
    let inputs: Vec<Word> = cases
        .iter()
        .flat_map(|(p, n, reach)| [floats(p[0], p[1], p[2], *reach), floats(n[0], n[1], n[2], 0.0)])
        .collect();
    let values = Probe::new().both(glsl, &inputs, cases.len(), cases.len());
    for ((p, n, reach), value) in cases.iter().zip(&values) {
        let moved = as_floats(*value);
        let mut along = 0.0;
        for c in 0..3 {
            let expected = math::offset(p[c], n[c], *reach);
            // The product is rounded, and the sum
            let tolerance = f64::from(p[c].abs()) * 2f64.powi(-23) + f64::from(*reach) * 2f64.powi(-43);
            assert!(
                (f64::from(moved[c]) - expected).abs() <= tolerance,
                "{p:?} {n:?}: {} not {expected}",
                moved[c]
            );
            along += f64::from(n[c]) * (f64::from(moved[c]) - f64::from(p[c]));
        }
        // All but the rounding of the sum: at most half a unit in the last place of each coordinate
        let expected = f64::from(*reach) * 2f64.powi(-20);
        assert!(along > 0.8 * expected, "{p:?} {n:?} {reach} moved by {along}");
    }
}

#[test]
fn bases_are_orthonormal() {
    let glsl = "#include \"base/math.glsl\"
        void probe(uint i) {
            vec3 z = uintBitsToFloat(fetch_points(2u * i).xyz);
            vec3 along = uintBitsToFloat(fetch_points(2u * i + 1u).xyz);
            Basis a = basis_around(z);
            Basis b = basis_along(z, along);
            store_values(6u * i, uvec4(floatBitsToUint(a.x), 0u));
            store_values(6u * i + 1u, uvec4(floatBitsToUint(a.y), 0u));
            store_values(6u * i + 2u, uvec4(floatBitsToUint(b.x), 0u));
            store_values(6u * i + 3u, uvec4(floatBitsToUint(b.y), 0u));
            store_values(6u * i + 4u, uvec4(floatBitsToUint(basis_to_world(a, basis_to_local(a, along))), 0u));
            store_values(6u * i + 5u, floatBitsToUint(vec4(a.z, 0.0)));
        }";
    let mut random = Random(10);
    let mut directions = Vec::new();
    for sign in [1.0, -1.0_f32] {
        directions.push([0.0, 0.0, sign]);
        directions.extend([[0.0, sign, 0.0], [sign, 0.0, 0.0], [0.0, sign, -0.0], [sign, 0.0, -0.0]]);
        for tilt in [1e-8_f32, 1e-6, 1e-4, 1e-3] {
            directions.extend([[tilt, 0.0, sign], [0.0, -tilt, sign], [tilt, tilt, sign]]);
            directions.extend([[sign, 0.0, tilt], [sign, 0.0, -tilt]]);
        }
    }
    directions.extend((0..20_000).map(|_| random.direction()));
    for z in &mut directions {
        *z = math::normalize(math::wide(*z)).map(|c| c as f32);
    }
    let inputs: Vec<Word> = directions
        .iter()
        .flat_map(|z| {
            let along = random.direction();
            [floats(z[0], z[1], z[2], 0.0), floats(along[0], along[1], along[2], 0.0)]
        })
        .collect();
    let values = Probe::new().both(glsl, &inputs, directions.len(), 6 * directions.len());
    let vector = |w: Word| <[f64; 3]>::try_from(&as_doubles(w)[..3]).unwrap();
    for ((z, input), value) in directions.iter().zip(inputs.chunks_exact(2)).zip(values.chunks_exact(6)) {
        let z = math::wide(*z);
        let along = vector(input[1]);
        for (x, y, tolerance) in [
            // A dozen roundings of numbers of at most 2 around; z itself is a unit vector within 2e-7
            (vector(value[0]), vector(value[1]), 2e-6),
            // x is what is left of `along`: its angle to z is known to rounding over its length
            (vector(value[2]), vector(value[3]), 1e-6 / math::length(math::cross(z, along)).max(1e-6)),
        ] {
            let errors = [
                math::dot(x, x) - 1.0,
                math::dot(y, y) - 1.0,
                math::dot(x, y),
                math::dot(x, z),
                math::dot(y, z),
                math::length(math::sub(math::cross(x, y), z)),
            ];
            assert!(errors.iter().all(|e| e.abs() < tolerance), "{z:?} along {along:?}: {errors:?}");
        }
        let back = vector(value[4]);
        assert!(math::length(math::sub(back, along)) < 4e-6, "{z:?}: {along:?} comes back as {back:?}");
    }
}

#[test]
fn short_vectors_have_a_direction() {
    let glsl = "#include \"base/math.glsl\"
        void probe(uint i) {
            vec3 v = uintBitsToFloat(fetch_points(i).xyz);
            store_values(i, floatBitsToUint(vec4(normalize_or(v, vec3(0.0, 1.0, 0.0)), 0.0)));
        }";
    let sizes = [1e-37, 1e-30, 1e-20, 1.0, 1e20, 1e38];
    let mut inputs: Vec<Word> = sizes.map(|s: f32| floats(0.6 * s, 0.0, -0.8 * s, 0.0)).to_vec();
    inputs.push(floats(0.0, 0.0, 0.0, 0.0));
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for value in &values[..6] {
        let [x, y, z, _] = as_doubles(*value);
        // A division of 2.5 ulp, a square root, a product
        assert!((x - 0.6).abs() < 1e-6 && y == 0.0 && (z + 0.8).abs() < 1e-6, "{x} {y} {z}");
    }
    assert_eq!(as_floats(values[6]), [0.0, 1.0, 0.0, 0.0]);
}

#[test]
fn arc_functions_are_exact() {
    let glsl = "#include \"base/math.glsl\"
        void probe(uint i) {
            float x = uintBitsToFloat(fetch_points(i).x);
            store_values(i, floatBitsToUint(vec4(asin_exact(x), acos_exact(x), 0.0, 0.0)));
        }";
    let mut random = Random(12);
    let mut numbers =
        vec![0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 0.99999994, 0.5000001, 1e-20, 1.000_001, -1.000_001];
    numbers.extend((0..50_000).map(|_| random.between(-1.0, 1.0)));
    let inputs: Vec<Word> = numbers.iter().map(|&x| floats(x, 0.0, 0.0, 0.0)).collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (x, value) in numbers.iter().zip(&values) {
        let x = f64::from(*x).clamp(-1.0, 1.0);
        let [asin, acos, ..] = as_doubles(*value);
        // The polynomial is good to 1e-7, and π / 2 takes a rounding of 6e-8 twice
        assert!((asin - x.asin()).abs() < 3e-7, "asin({x}) = {asin}");
        assert!((acos - x.acos()).abs() < 4e-7, "acos({x}) = {acos}");
    }
}

#[test]
fn power_heuristic_holds_for_every_density() {
    let glsl = "#include \"base/math.glsl\"
        void probe(uint i) {
            vec4 p = uintBitsToFloat(fetch_points(i));
            store_values(i, floatBitsToUint(vec4(power_heuristic(p.x, p.y), power_heuristic(p.y, p.x), 0.0, 0.0)));
        }";
    let numbers: Vec<f32> = [1e-30, 1e-10, 0.3, 1.0, 2.0, 7e4, 1e10, 1e20, 1e30].to_vec();
    let inputs: Vec<Word> =
        numbers.iter().flat_map(|&a| numbers.iter().map(move |&b| floats(a, b, 0.0, 0.0))).collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (input, value) in inputs.iter().zip(&values) {
        let ([a, b, ..], [own, other, ..]) = (as_doubles(*input), as_doubles(*value));
        let expected = a * a / (a * a + b * b);
        // Four roundings and a division of 2.5 ulp
        assert!((own - expected).abs() < 1e-6, "({a}, {b}): {own} not {expected}");
        assert!((own + other - 1.0).abs() < 1e-6, "({a}, {b}): {own} + {other}");
    }
}

#[test]
fn chi_square_of_the_tables() {
    // Abramowitz and Stegun, table 26.8, and closed forms for two and four degrees of freedom
    for (statistic, dof, p) in [
        (3.841_458_82, 1, 0.05),
        (18.307_038_05, 10, 0.05),
        (124.342_113_4, 100, 0.05),
        (149.449_253, 100, 0.001),
        (2.0, 2, f64::exp(-1.0)),
        (6.0, 4, 4.0 * f64::exp(-3.0)),
    ] {
        let got = chi2::p_value(statistic, dof);
        assert!((got - p).abs() < 1e-5 * p + 1e-7, "{statistic} {dof}: {got} not {p}");
    }
    assert!((chi2::p_value(1023.0, 1023) - 0.494).abs() < 0.002);
}

#[test]
fn chi_square_refuses_what_is_wrong() {
    let mut random = Random(11);
    let mut counts = vec![0_u64; 64];
    (0..64_000).for_each(|_| counts[(random.u32() >> 26) as usize] += 1);
    chi2::accept(&[("fair".to_string(), chi2::test_uniform(&counts))]);
    let refused = |counts: &[u64], expected: &[f64]| {
        let p = chi2::test(counts, expected);
        std::panic::catch_unwind(|| chi2::accept(&vec![("unfair".to_string(), p); 100])).is_err()
    };
    let fair = vec![1000.0; 64];
    // A fifth of one cell in the next one; a slope; a cell that must stay empty
    let mut moved = counts.clone();
    moved[3] -= 200;
    moved[4] += 200;
    assert!(refused(&moved, &fair));
    let slope: Vec<u64> = (0..64).map(|i| 900 + 200 * i / 63).collect();
    assert!(refused(&slope, &fair));
    let mut empty = fair.clone();
    empty[0] = 0.0;
    empty[1] = 2000.0;
    assert!(refused(&counts, &empty));
    assert!(std::panic::catch_unwind(|| chi2::accept(&[("nan".to_string(), f64::NAN)])).is_err());
    assert!(std::panic::catch_unwind(|| chi2::accept(&[])).is_err());
}
