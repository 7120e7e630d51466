//! `shaders/base/bilinear.glsl`: rays meet random patches where they were aimed.

use crate::common::probe::{Probe, Word, as_doubles, vector};
use crate::common::random::Random;
use crate::common::twins::math::{cross, dot, length, sub, wide};

const GLSL: &str = "#include \"base/bilinear.glsl\"
    void probe(uint i) {
        vec3 p[4];
        vec3 o = uintBitsToFloat(fetch_points(6u * i + 4u).xyz);
        for (uint k = 0u; k < 4u; ++k) p[k] = uintBitsToFloat(fetch_points(6u * i + k).xyz) - o;
        vec3 d = uintBitsToFloat(fetch_points(6u * i + 5u).xyz);
        Bilinear b = bilinear_patch(p[0], p[1], p[2], p[3]);
        BilinearHits hits = bilinear_hits(b, normalize(d));
        store_values(2u * i, floatBitsToUint(vec4(hits.first.t, hits.second.t, hits.first.uv)));
        BilinearHit nearest = bilinear_nearest(b, normalize(d), length(d));
        store_values(2u * i + 1u, floatBitsToUint(vec4(hits.second.uv, nearest.uv)));
    }";

#[test]
fn rays_meet_random_patches_where_they_were_aimed() {
    let mut random = Random(12);
    let (mut inputs, mut cases): (Vec<Word>, Vec<_>) = (Vec::new(), Vec::new());
    while cases.len() < 100_000 {
        let mut corners = [0; 4].map(|_| random.cube(1.0));
        if cases.len() % 4 == 0 {
            // A parallelogram, on which the equation is linear
            corners[3] = [0, 1, 2].map(|c| corners[1][c] + corners[2][c] - corners[0][c]);
        }
        // On an edge now and then, where it is not seen at a grazing angle
        let edge = cases.len() % 8 == 1;
        let (mut u, v) = (random.f32(), random.f32());
        if edge {
            u = u.round();
        }
        let origin = random.cube(3.0);
        let [a, b, c, d] = corners.map(wide);
        let (x, y) = (f64::from(u), f64::from(v));
        let mix = |p: [f64; 3], q: [f64; 3], t: f64| [0, 1, 2].map(|i| p[i] * (1.0 - t) + q[i] * t);
        let target = mix(mix(a, b, x), mix(c, d, x), y);
        let normal = cross(mix(sub(b, a), sub(d, c), y), mix(sub(c, a), sub(d, b), x));
        let direction = sub(target, wide(origin)).map(|c| c as f32);
        let along = wide(direction);
        // Not along the surface, where two meetings become one
        let least = if edge { 0.3 } else { 0.05 };
        if length(normal) > 0.1 && dot(normal, along).abs() > least * length(normal) * length(along) {
            inputs.extend(corners.map(vector));
            inputs.extend([vector(origin), vector(direction)]);
            cases.push(([u, v].map(f64::from), length(along)));
        }
    }
    let values = Probe::new().both(GLSL, &inputs, cases.len(), 2 * cases.len());
    for (([u, v], distance), value) in cases.iter().zip(values.chunks_exact(2)) {
        let ([first, second, a, b], [c, d, e, f]) = (as_doubles(value[0]), as_doubles(value[1]));
        let off = |t: f64, x: f64, y: f64| (t / distance - 1.0).abs().max((x - u).abs()).max((y - v).abs());
        let best = off(first, a, b).min(off(second, c, d));
        assert!(best < 2e-3, "{u} {v} at {distance}: {first} {a} {b} and {second} {c} {d}");
        let t = if off(first, a, b) < off(second, c, d) { first } else { second };
        // The distance does not suffer from what is not known of u and v
        assert!((t / distance - 1.0).abs() < 2e-4, "{u} {v}: {t}, not {distance}");
        assert!((e - u).abs().max((f - v).abs()) < 2e-3, "{u} {v}: {e} {f}");
    }
}
