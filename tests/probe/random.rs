//! `shaders/base/random.glsl`: hashes, Sobol points, strata.

use crate::common::chi2;
use crate::common::probe::{Probe, Word, as_floats};
use crate::common::random::Random;
use crate::common::twins::random;

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
