//! `shaders/geometry/quadric.glsl`: ray against sphere and disk.

use crate::common::probe::{Probe, Word, as_doubles, as_floats, floats, vector};
use crate::common::random::Random;
use crate::common::twins::geometry;
use crate::common::twins::math::{length, towards};

/// Runs a test of a ray: its origin; its direction and the end of its range.
fn hits(test: &str) -> String {
    format!(
        "#include \"geometry/quadric.glsl\"
        void probe(uint i) {{
            vec3 o = uintBitsToFloat(fetch_points(2u * i).xyz);
            vec4 d = uintBitsToFloat(fetch_points(2u * i + 1u));
            float t;
            bool hit = {test}(o, d.xyz, 0.0, d.w, t);
            store_values(i, uvec4(hit ? 1u : 0u, floatBitsToUint(t), 0u, 0u));
        }}"
    )
}

#[test]
fn spheres_are_hit_where_doubles_say() {
    let glsl = hits("sphere_hit");
    let mut random = Random(6);
    let mut inputs: Vec<Word> = Vec::new();
    for i in 0..100_000 {
        let size = if i % 3 == 0 { 0.57 } else { random.between(0.0, 6.0).exp2() };
        let origin = random.cube(size);
        let aim = random.cube(1.2);
        let scale = random.between(-5.0, 5.0).exp2();
        let d = towards(origin, aim).map(|c| c * scale);
        let limit = if i % 2 == 0 { 3e38 } else { random.f32() * 2.0 / scale };
        inputs.extend([vector(origin), floats(d[0], d[1], d[2], limit)]);
    }
    // Known: head-on, from the centre, from behind, past
    let known = [
        ([0.0, 0.0, 3.0], [0.0, 0.0, -1.0], Some(2.0)),
        ([0.0, 0.0, 0.0], [0.0, 2.0, 0.0], Some(0.5)),
        ([0.0, 0.0, 3.0], [0.0, 0.0, 1.0], None),
        ([0.0, 1.5, 3.0], [0.0, 0.0, -1.0], None),
        ([0.5, 0.0, 0.0], [1.0, 0.0, 0.0], Some(0.5)),
        ([0.5, 0.0, 0.0], [-1.0, 0.0, 0.0], Some(1.5)),
    ];
    for (o, d, _) in known {
        inputs.extend([vector(o), floats(d[0], d[1], d[2], 3e38)]);
    }
    let count = inputs.len() / 2;
    let values = Probe::new().both(&glsl, &inputs, count, count);
    for ((o, _, t), value) in known.iter().zip(&values[count - known.len()..]) {
        assert_eq!((value[0] == 1).then(|| as_floats(*value)[1]), *t, "from {o:?}");
    }
    let mut seen = [0; 2];
    for (input, value) in inputs.chunks_exact(2).zip(&values) {
        let ([ox, oy, oz, _], [dx, dy, dz, limit]) = (as_doubles(input[0]), as_doubles(input[1]));
        let (o, d) = ([ox, oy, oz], [dx, dy, dz]);
        let (roots, miss) = geometry::sphere_hit(o, d);
        // The closest point is known to a few ulp of the distance of the origin
        let slack = 4e-7 * (1.0 + length(o));
        let expected = roots.and_then(|r| r.into_iter().find(|t| *t > 0.0));
        let near_zero = roots.is_some_and(|r| r.iter().any(|t| (t * length(d)).abs() < 4.0 * slack));
        let near_limit = expected.is_some_and(|t| ((t - limit) * length(d)).abs() < 100.0 * slack);
        // How much a miss distance near 1 spreads the roots
        if (miss - 1.0).abs() < 2.0 * slack || near_zero || near_limit {
            continue;
        }
        let expected = expected.filter(|t| *t < limit);
        assert_eq!(value[0] == 1, expected.is_some(), "{o:?} {d:?} {miss} {roots:?} {limit}");
        seen[usize::from(expected.is_some())] += 1;
        if let Some(t) = expected {
            let got = as_doubles(*value)[1];
            let spread = slack * (1.0 + 1.0 / (1.0 - miss * miss).max(slack).sqrt());
            assert!(((got - t) * length(d)).abs() < 2.0 * spread, "{got} not {t}: {o:?} {d:?}");
        }
    }
    assert!(seen[0] > 10_000 && seen[1] > 30_000, "{seen:?}");
}

#[test]
fn disks_are_hit_where_doubles_say() {
    let glsl = hits("disk_hit");
    let mut random = Random(7);
    let mut inputs: Vec<Word> = Vec::new();
    for i in 0..100_000 {
        let size = random.between(0.0, 6.0).exp2();
        let origin = random.cube(size);
        let aim = [random.between(-1.2, 1.2), random.between(-1.2, 1.2), 0.0];
        let scale = random.between(-5.0, 5.0).exp2() * if i % 4 == 0 { -1.0 } else { 1.0 };
        let d = towards(origin, aim).map(|c| c * scale);
        let limit = if i % 2 == 0 { 3e38 } else { random.f32() * 2.0 / scale.abs() };
        inputs.extend([vector(origin), floats(d[0], d[1], d[2], limit)]);
    }
    // In the plane, and parallel to it: never
    let never = [
        ([3.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
        ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
        ([0.0, 0.0, 0.0], [0.0, 1.0, -0.0]),
    ];
    for (o, d) in never {
        inputs.extend([vector(o), floats(d[0], d[1], d[2], 3e38)]);
    }
    let count = inputs.len() / 2;
    let values = Probe::new().both(&glsl, &inputs, count, count);
    assert!(values[count - never.len()..].iter().all(|v| v[0] == 0));
    let mut seen = [0; 2];
    for (input, value) in inputs.chunks_exact(2).zip(&values).take(count - never.len()) {
        let ([ox, oy, oz, _], [dx, dy, dz, limit]) = (as_doubles(input[0]), as_doubles(input[1]));
        let t = -oz / dz;
        let p = [ox + t * dx, oy + t * dy];
        let radius = p[0].hypot(p[1]);
        let slack = 4e-7 * (1.0 + length([ox, oy, oz]));
        if (radius - 1.0).abs() < slack || (t / limit - 1.0).abs() < 1e-6 {
            continue;
        }
        let expected = t > 0.0 && t < limit && radius < 1.0;
        assert_eq!(value[0] == 1, expected, "{input:?}");
        seen[usize::from(expected)] += 1;
        // A division: 2.5 ulp
        assert!(!expected || (as_doubles(*value)[1] / t - 1.0).abs() < 4e-7);
    }
    assert!(seen[0] > 10_000 && seen[1] > 10_000, "{seen:?}");
}
