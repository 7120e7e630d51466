//! `shaders/base`: fixed point, ray offset, bases.

use crate::common::probe::{Probe, Word, as_doubles, as_floats, floats};
use crate::common::random::Random;
use crate::common::twins::{fixed, math};

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
fn points_of_the_circle_are_on_it() {
    let glsl = "#include \"base/math.glsl\"
        void probe(uint i) { store_values(i, floatBitsToUint(vec4(circle_point(uintBitsToFloat(fetch_points(i).x)), 0.0, 0.0))); }";
    let mut random = Random(11);
    let eighths = (-64..=64).map(|i| i as f32 * std::f32::consts::FRAC_PI_4);
    let angles: Vec<f32> = eighths
        .flat_map(|angle| [angle.next_down(), angle, angle.next_up()])
        .chain((0..20_000).map(|_| random.between(-50.0, 50.0)))
        .collect();
    let inputs: Vec<Word> = angles.iter().map(|&angle| floats(angle, 0.0, 0.0, 0.0)).collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (&angle, value) in angles.iter().zip(&values) {
        let [x, y, ..] = as_doubles(*value);
        let (sin, cos) = f64::from(angle).sin_cos();
        assert!((x - cos).abs() < 1.5e-7 && (y - sin).abs() < 1.5e-7, "{angle}: {x} {y}, not {cos} {sin}");
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
