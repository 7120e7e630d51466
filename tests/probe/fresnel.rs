//! `shaders/material/fresnel.glsl`: Fresnel's equations.

use crate::common::probe::{Probe, Word, as_doubles, floats};
use crate::common::random::Random;
use crate::common::twins::fresnel;

#[test]
fn fresnel_of_dielectrics() {
    let glsl = "#include \"material/fresnel.glsl\"
        void probe(uint i) {
            vec4 p = uintBitsToFloat(fetch_points(i));
            store_values(i, floatBitsToUint(vec4(fresnel_dielectric(p.x, p.y), fresnel_schlick(p.x, vec3(p.z)))));
        }";
    let mut random = Random(1);
    let mut cases: Vec<[f32; 3]> =
        (0..20_000).map(|_| [random.f32(), random.between(0.4, 2.5), random.f32()]).collect();
    for eta in [1.5_f32, 1.0 / 1.5, 1.0, 1.33] {
        cases.extend([[1.0, eta, 0.04], [0.0, eta, 1.0], [(1.0 / (1.0 + eta * eta)).sqrt(), eta, 0.0]]);
    }
    let inputs: Vec<Word> = cases.iter().map(|c| floats(c[0], c[1], c[2], 0.0)).collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (input, value) in inputs.iter().zip(&values) {
        let ([cos_i, eta, at_normal, _], [f, schlick, ..]) = (as_doubles(*input), as_doubles(*value));
        let expected = fresnel::fresnel_dielectric(cos_i, eta);
        // About ten roundings; near the critical angle cos_t is the root of what is left of 1: √(1e-7) in the worst case
        let sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
        let tolerance = 4e-6 + 2e-6 / (1.0 - sin2_t).abs().max(1e-6).sqrt();
        assert!((f - expected).abs() < tolerance, "F({cos_i}, {eta}) = {f}, not {expected}");
        assert!((0.0..=1.000_001).contains(&f));
        let expected = fresnel::fresnel_schlick(cos_i, at_normal);
        assert!((schlick - expected).abs() < 1e-6, "Schlick({cos_i}, {at_normal}) = {schlick}");
    }
    let of = |cos_i: f32, eta: f32| {
        let at = cases.iter().position(|c| c[0] == cos_i && c[1] == eta).unwrap();
        as_doubles(values[at])[0]
    };
    assert!((of(1.0, 1.5) - 0.04).abs() < 1e-7);
    assert!((of(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-7);
    assert_eq!(of(0.0, 1.0 / 1.5), 1.0, "total reflection");
    assert_eq!(of(0.0, 1.5), 1.0, "grazing");
    assert!(of(1.0, 1.0) == 0.0);
    // Brewster's angle: what is left is half of the perpendicular part
    let brewster = f64::from((1.0_f32 / (1.0 + 1.5 * 1.5)).sqrt());
    let [parallel, perpendicular] = fresnel::fresnel_dielectric_parts(brewster, 1.5);
    assert!(parallel < 1e-13);
    assert!((of((1.0_f32 / (1.0 + 1.5 * 1.5)).sqrt(), 1.5) - perpendicular / 2.0).abs() < 1e-6);
}

#[test]
fn fresnel_of_conductors() {
    let glsl = "#include \"material/fresnel.glsl\"
        void probe(uint i) {
            vec4 p = uintBitsToFloat(fetch_points(i));
            store_values(i, floatBitsToUint(vec4(fresnel_conductor(p.x, vec3(p.y), vec3(p.z)), 0.0)));
        }";
    let mut random = Random(2);
    let mut cases: Vec<[f32; 3]> =
        (0..20_000).map(|_| [random.f32(), random.between(0.05, 4.0), random.between(0.05, 8.0)]).collect();
    // Known: silver and gold in green at normal incidence; k = 0 is glass; grazing reflects all
    cases.extend([[1.0, 0.129, 3.25], [1.0, 0.402, 2.54], [0.6, 1.5, 0.0], [0.0, 0.2, 3.0]]);
    let inputs: Vec<Word> = cases.iter().map(|c| floats(c[0], c[1], c[2], 0.0)).collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (input, value) in inputs.iter().zip(&values) {
        let ([cos_i, eta, k, _], [r, ..]) = (as_doubles(*input), as_doubles(*value));
        let expected = fresnel::fresnel_conductor(cos_i, eta, k);
        // Some twenty roundings, and a² + b² − η² cancels where k is large: 1e-5
        assert!((r - expected).abs() < 1e-5, "R({cos_i}, {eta}, {k}) = {r}, not {expected}");
    }
    let normal = |eta: f64, k: f64| ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
    let last: Vec<f64> = values[20_000..].iter().map(|v| as_doubles(*v)[0]).collect();
    assert!((last[0] - normal(0.129, 3.25)).abs() < 1e-6);
    assert!((last[1] - normal(0.402, 2.54)).abs() < 1e-6);
    assert!((last[2] - fresnel::fresnel_dielectric(0.6, 1.5)).abs() < 1e-5);
    assert!((last[3] - 1.0).abs() < 1e-6);
}
