//! `shaders/material/ggx.glsl`: visible normals.

use crate::common::chi2;
use crate::common::directions::{CELLS_PHI, CELLS_Z, cell_integrals, cell_of, midpoints};
use crate::common::probe::{Probe, as_doubles, floats, three, vector};
use crate::common::random::Random;
use crate::common::twins::math::{cross, dot, normalize, wide};
use crate::common::twins::sampling::{DISK_ERROR, disk_inverse};

/// Inverse of `ggx_visible_sample`: the normal of the stretched surface, its place on the disk that `wo` sees, that place
/// before the lower half of the disk was squeezed, and the two numbers that it was drawn with.
fn visible_inverse(wo: [f64; 3], alpha: [f64; 2], m: [f64; 3]) -> [f64; 2] {
    let stretched = |w: [f64; 3], by: [f64; 2]| normalize([w[0] * by[0], w[1] * by[1], w[2]]);
    let v = stretched(wo, alpha);
    let n = stretched(m, alpha.map(|a| 1.0 / a));
    let flat = v[0].hypot(v[1]);
    let x_axis = if flat > 0.0 { [-v[1] / flat, v[0] / flat, 0.0] } else { [1.0, 0.0, 0.0] };
    let (x, y) = (dot(n, x_axis), dot(n, cross(v, x_axis)));
    let (share, edge) = (0.5 * (1.0 + v[2]), (1.0 - x * x).max(0.0).sqrt());
    disk_inverse(x, (y - (1.0 - share) * edge) / share)
}

#[test]
fn visible_normals_follow_their_density_and_go_back_to_the_square() {
    const COUNT: usize = 100_000;
    let draw = "#include \"material/ggx.glsl\"
        void probe(uint i) {
            vec4 wo = uintBitsToFloat(fetch_points(0u));
            vec2 alpha = uintBitsToFloat(fetch_points(1u).xy);
            store_values(i, floatBitsToUint(vec4(ggx_visible_sample(wo.xyz, alpha, uintBitsToFloat(fetch_points(2u + i).xy)), 0.0)));
        }";
    let weigh = "#include \"material/ggx.glsl\"
        void probe(uint i) {
            vec4 wo = uintBitsToFloat(fetch_points(0u));
            vec2 alpha = uintBitsToFloat(fetch_points(1u).xy);
            vec3 m = uintBitsToFloat(fetch_points(2u + i).xyz);
            store_values(i, floatBitsToUint(vec4(ggx_visible_pdf(wo.xyz, m, alpha), ggx_distribution(m, alpha) * m.z, 0.0, 0.0)));
        }";
    let mut random = Random(3);
    let mut results = Vec::new();
    for alpha in [[0.25, 0.25], [0.2, 0.8], [1.0, 1.0_f32]] {
        for wo in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.48, -0.6, 0.64], [-0.97, 0.1, 0.221_585_f32]] {
            let header = [vector(wo), floats(alpha[0], alpha[1], 0.0, 0.0)];
            let mut inputs = header.to_vec();
            inputs.extend((0..COUNT).map(|_| floats(random.f32(), random.f32(), 0.0, 0.0)));
            let mut observed = vec![0; CELLS_Z * CELLS_PHI];
            for (u, m) in inputs[2..].iter().zip(Probe::new().both(draw, &inputs, COUNT, COUNT)) {
                let ([u, v, ..], m) = (as_doubles(*u), three(as_doubles(m)));
                let back = visible_inverse(wide(wo), alpha.map(f64::from), m);
                let off = (back[0] - u).abs().max((back[1] - v).abs());
                assert!(off < DISK_ERROR, "{alpha:?} {wo:?}: ({u}, {v}) comes back as {back:?}");
                assert!((m.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-5 && m[2] > 0.0);
                observed[cell_of(m)] += 1;
            }
            let mut inputs = header.to_vec();
            inputs.extend(midpoints().iter().map(|m| floats(m[0], m[1], m[2].max(0.0), 0.0)));
            let count = inputs.len() - 2;
            let values = Probe::new().both(weigh, &inputs, count, count);
            let upper = |lane: usize| {
                let at = values.iter().zip(midpoints());
                cell_integrals(at.map(move |(v, m)| if m[2] > 0.0 { as_doubles(*v)[lane] } else { 0.0 }))
            };
            let (visible, area): (Vec<f64>, f64) = (upper(0), upper(1).iter().sum());
            let whole: f64 = visible.iter().sum();
            assert!((area - 1.0).abs() < 2e-3, "{alpha:?}: the microfacets have an area of {area}");
            assert!((whole - 1.0).abs() < 2e-3, "{alpha:?} {wo:?}: {whole}");
            let expected: Vec<f64> = visible.iter().map(|v| v * COUNT as f64).collect();
            results.push((format!("{alpha:?} {wo:?}"), chi2::test(&observed, &expected)));
        }
    }
    chi2::accept(&results);
}
