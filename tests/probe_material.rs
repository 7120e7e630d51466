//! `shaders/material`: GGX, and every lobe against its own density, reciprocity and energy.

mod common;

use common::chi2;
use common::probe::{Probe, Word, as_doubles, floats, vector};
use common::random::Random;
use common::twins::fresnel;
use dapple::layout::{
    FRESNEL_EXACT, FRESNEL_INDEX, FRESNEL_NONE, FRESNEL_SCHLICK, MATERIAL_CONDUCTOR, MATERIAL_DIELECTRIC,
    MATERIAL_DIFFUSE, MATERIAL_PHONG,
};
use std::f64::consts::{PI, TAU};

/// A BSDF that is tested.
#[derive(Clone, Copy, Default)]
struct Lobe {
    name: &'static str,
    kind: u32,
    mode: u32,
    ior: f32,
    exponent: f32,
    color: [f32; 3],
    specular: [f32; 3],
    k: [f32; 3],
    alpha: [f32; 2],
}

impl Lobe {
    fn header(&self, wo: [f32; 3]) -> Vec<Word> {
        vec![
            [self.kind, self.mode, self.ior.to_bits(), self.exponent.to_bits()],
            vector(self.color),
            vector(self.specular),
            vector(self.k),
            floats(self.alpha[0], self.alpha[1], 0.0, 0.0),
            vector(wo),
        ]
    }
}

const HEADER: usize = 6;

const BSDF: &str = "
    #define HAS_DIFFUSE
    #define HAS_PHONG
    #define HAS_CONDUCTOR
    #define HAS_DIELECTRIC
    #include \"material/material.glsl\"
    const uint HEADER = 6u;
    vec3 vector(uint at) { return uintBitsToFloat(fetch_points(at).xyz); }
    Bsdf probe_bsdf() {
        uvec4 a = fetch_points(0u);
        return Bsdf(a.x, a.y, vector(1u), vector(2u), vector(3u), uintBitsToFloat(a.z), uintBitsToFloat(a.w), vector(4u).xy);
    }
";

/// A sample of a BSDF and what the other two verbs say of it.
struct Sample {
    wi: [f64; 3],
    pdf: f64,
    weight: [f64; 3],
    eta: f64,
    through: bool,
    eval: [f64; 3],
    pdf_again: f64,
}

fn three(v: [f64; 4]) -> [f64; 3] {
    [v[0], v[1], v[2]]
}

fn samples(lobe: &Lobe, wo: [f32; 3], count: usize, seed: u64) -> Vec<Sample> {
    let glsl = format!(
        "{BSDF} void probe(uint i) {{
            Bsdf b = probe_bsdf();
            vec3 wo = vector(5u);
            vec3 u = vector(HEADER + i);
            BsdfSample s = bsdf_sample(b, wo, u.z, u.xy);
            store_values(3u * i, floatBitsToUint(vec4(s.wi, s.pdf)));
            store_values(3u * i + 1u, floatBitsToUint(vec4(s.weight, s.through ? -s.eta : s.eta)));
            store_values(3u * i + 2u, floatBitsToUint(vec4(bsdf_eval(b, wo, s.wi), bsdf_pdf(b, wo, s.wi))));
        }}"
    );
    let mut random = Random(seed);
    let mut inputs = lobe.header(wo);
    inputs.extend((0..count).map(|_| floats(random.f32(), random.f32(), random.f32(), 0.0)));
    let values = Probe::new().both(&glsl, &inputs, count, 3 * count);
    let sample = |v: &[Word]| {
        let [a, b, c] = [v[0], v[1], v[2]].map(as_doubles);
        Sample {
            wi: three(a),
            pdf: a[3],
            weight: three(b),
            eta: b[3].abs(),
            through: b[3] < 0.0,
            eval: three(c),
            pdf_again: c[3],
        }
    };
    values.chunks_exact(3).map(sample).collect()
}

/// Cells of the sphere of directions: by z, then by angle; each is divided into midpoints of the integral.
const CELLS_Z: usize = 24;
const CELLS_PHI: usize = 24;
const PARTS_Z: usize = 32;
const PARTS_PHI: usize = 8;

fn midpoints() -> Vec<[f32; 3]> {
    let (rows, columns) = (CELLS_Z * PARTS_Z, CELLS_PHI * PARTS_PHI);
    let mut all = Vec::with_capacity(rows * columns);
    for row in 0..rows {
        let z = (row as f64 + 0.5) / rows as f64 * 2.0 - 1.0;
        let r = (1.0 - z * z).sqrt();
        for column in 0..columns {
            let phi = (column as f64 + 0.5) / columns as f64 * TAU;
            all.push([(r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32]);
        }
    }
    all
}

fn cell_of([x, y, z]: [f64; 3]) -> usize {
    let row = ((z + 1.0) / 2.0 * CELLS_Z as f64).clamp(0.0, CELLS_Z as f64 - 1.0) as usize;
    let column = (y.atan2(x) / TAU).rem_euclid(1.0) * CELLS_PHI as f64;
    row * CELLS_PHI + (column as usize).min(CELLS_PHI - 1)
}

/// Integrals over each cell of values at the midpoints.
fn cell_integrals(at_midpoints: impl Iterator<Item = f64>) -> Vec<f64> {
    let columns = CELLS_PHI * PARTS_PHI;
    let area = 4.0 * PI / (CELLS_Z * PARTS_Z * columns) as f64;
    let mut cells = vec![0.0; CELLS_Z * CELLS_PHI];
    for (i, value) in at_midpoints.enumerate() {
        let (row, column) = (i / columns / PARTS_Z, i % columns / PARTS_PHI);
        cells[row * CELLS_PHI + column] += value * area;
    }
    cells
}

/// Density, value, and value with the directions exchanged, at every midpoint.
fn over_the_sphere(lobe: &Lobe, wo: [f32; 3]) -> Vec<(f64, [f64; 3], [f64; 3])> {
    let glsl = format!(
        "{BSDF} void probe(uint i) {{
            Bsdf b = probe_bsdf();
            vec3 wo = vector(5u);
            vec3 wi = vector(HEADER + i);
            store_values(2u * i, floatBitsToUint(vec4(bsdf_eval(b, wo, wi), bsdf_pdf(b, wo, wi))));
            store_values(2u * i + 1u, floatBitsToUint(vec4(bsdf_eval(b, wi, wo), 0.0)));
        }}"
    );
    let mut inputs = lobe.header(wo);
    inputs.extend(midpoints().iter().map(|m| floats(m[0], m[1], m[2], 0.0)));
    let count = inputs.len() - HEADER;
    let values = Probe::new().both(&glsl, &inputs, count, 2 * count);
    let row = |v: &[Word]| (as_doubles(v[0])[3], three(as_doubles(v[0])), three(as_doubles(v[1])));
    values.chunks_exact(2).map(row).collect()
}

fn lobes() -> Vec<Lobe> {
    let white = [1.0; 3];
    let phong =
        Lobe { kind: MATERIAL_PHONG, color: [0.3, 0.5, 0.2], specular: [0.7, 0.5, 0.4], ..Lobe::default() };
    let metal = Lobe { kind: MATERIAL_CONDUCTOR, mode: FRESNEL_NONE, color: white, ..Lobe::default() };
    let glass = Lobe { kind: MATERIAL_DIELECTRIC, ior: 1.5, ..Lobe::default() };
    vec![
        Lobe { name: "diffuse", kind: MATERIAL_DIFFUSE, color: [0.2, 0.5, 1.0], ..Lobe::default() },
        Lobe { name: "phong 0", exponent: 0.0, ..phong },
        Lobe { name: "phong 1", exponent: 1.0, ..phong },
        Lobe { name: "phong 7.5", exponent: 7.5, ..phong },
        Lobe { name: "phong 100", exponent: 100.0, ..phong },
        Lobe { name: "phong without diffuse", exponent: 20.0, color: [0.0; 3], specular: white, ..phong },
        Lobe { name: "metal 0.2", alpha: [0.2, 0.2], ..metal },
        Lobe { name: "metal 1", alpha: [1.0, 1.0], ..metal },
        Lobe {
            name: "metal 0.2 × 0.6",
            alpha: [0.2, 0.6],
            mode: FRESNEL_SCHLICK,
            color: [0.9, 0.6, 0.3],
            ..metal
        },
        Lobe { name: "metal exact", alpha: [0.5, 0.3], mode: FRESNEL_EXACT, color: [0.9, 0.6, 0.3], ..metal },
        Lobe {
            name: "metal by index",
            alpha: [0.4, 0.4],
            mode: FRESNEL_INDEX,
            specular: [0.2, 0.4, 1.4],
            k: [3.9, 2.4, 1.6],
            ..metal
        },
        Lobe { name: "glass 0.3", alpha: [0.3, 0.3], ..glass },
        Lobe { name: "glass 0.25 × 0.7", alpha: [0.25, 0.7], ..glass },
        Lobe { name: "bubble 0.4", alpha: [0.4, 0.4], ior: 0.75, ..glass },
    ]
}

/// From nearly upright to nearly grazing, and from below.
fn directions() -> [[f32; 3]; 4] {
    [[0.6, 0.0, 0.8], [-0.48, 0.6, 0.64], [0.1, -0.97, 0.221_585], [0.36, 0.48, -0.8]]
}

#[test]
fn samples_follow_the_density_and_weights_are_its_quotient() {
    const COUNT: usize = 60_000;
    let mut results = Vec::new();
    for (i, lobe) in lobes().iter().enumerate() {
        for (j, wo) in directions().into_iter().enumerate() {
            let place = format!("{} from {wo:?}", lobe.name);
            let mut observed = vec![0_u64; CELLS_Z * CELLS_PHI + 1];
            let mut sums = [0.0; 3];
            let mut squares = [0.0; 3];
            for s in samples(lobe, wo, COUNT, (i * 10 + j) as u64) {
                if s.weight == [0.0; 3] {
                    observed[CELLS_Z * CELLS_PHI] += 1;
                    continue;
                }
                assert!((s.wi.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-5, "{place}: {:?}", s.wi);
                assert_eq!(s.through, s.wi[2] * f64::from(wo[2]) < 0.0, "{place}");
                assert!(s.pdf > 0.0 && s.pdf.is_finite(), "{place}: pdf {}", s.pdf);
                // The same function, perhaps inlined in another way: a few ulp, more where pow amplifies them
                assert!((s.pdf_again / s.pdf - 1.0).abs() < 1e-4, "{place}: {} and {}", s.pdf, s.pdf_again);
                // Radiance is scaled by 1 / η² on the way through: furnaces count energy
                let energy = if s.through { s.eta * s.eta } else { 1.0 };
                for c in 0..3 {
                    let quotient = s.eval[c] * s.wi[2].abs() / s.pdf;
                    let tolerance = 1e-4 * quotient.max(1e-3);
                    assert!(
                        (s.weight[c] - quotient).abs() < tolerance,
                        "{place}: {} {quotient}",
                        s.weight[c]
                    );
                    sums[c] += s.weight[c] * energy;
                    squares[c] += (s.weight[c] * energy).powi(2);
                }
                observed[cell_of(s.wi)] += 1;
            }
            for c in 0..3 {
                let mean = sums[c] / COUNT as f64;
                let sigma = ((squares[c] / COUNT as f64 - mean * mean).max(0.0) / COUNT as f64).sqrt();
                assert!(mean <= 1.0 + 1e-5 + 4.0 * sigma, "{place}: a furnace gives {mean} ± {sigma}");
            }

            // A lobe that goes below the surface is absorbed there, whatever its density says
            let both_sides = lobe.kind == MATERIAL_DIELECTRIC;
            let density = over_the_sphere(lobe, wo);
            let everywhere: f64 = cell_integrals(density.iter().map(|d| d.0)).iter().sum();
            assert!(everywhere < 1.002, "{place}: the density integrates to {everywhere}");
            let kept = density
                .iter()
                .zip(midpoints())
                .map(|(d, wi)| if both_sides || wi[2] * wo[2] > 0.0 { d.0 } else { 0.0 });
            let mut expected: Vec<f64> = cell_integrals(kept).iter().map(|e| e * COUNT as f64).collect();
            let rest = COUNT as f64 - expected.iter().sum::<f64>();
            assert!(rest > -0.002 * COUNT as f64, "{place}: {rest}");
            expected.push(rest.max(0.0));
            if rest < 0.002 * COUNT as f64 {
                // What is absorbed is within the error of the integral: leave it out
                let last = expected.len() - 1;
                expected[last] = observed[last].max(1) as f64;
            }
            results.push((place, chi2::test(&observed, &expected)));
        }
    }
    chi2::accept(&results);
}

#[test]
fn lobes_are_reciprocal() {
    for lobe in lobes() {
        for wo in directions() {
            for ((_, there, back), wi) in over_the_sphere(&lobe, wo).into_iter().zip(midpoints()) {
                // Radiance in glass is η² times as dense (Veach 1997, section 5.2): from the side of index 1, f is
                // 1 / η² of what it is the other way round
                let through = lobe.kind == MATERIAL_DIELECTRIC && wi[2] * wo[2] < 0.0;
                let index = f64::from(lobe.ior);
                let scale = match (through, wo[2] > 0.0) {
                    (false, _) => 1.0,
                    (true, true) => index * index,
                    (true, false) => 1.0 / (index * index),
                };
                for c in 0..3 {
                    assert!(
                        there[c].is_finite() && there[c] >= 0.0,
                        "{} {wo:?} {wi:?}: {}",
                        lobe.name,
                        there[c]
                    );
                    let difference = (there[c] * scale - back[c]).abs();
                    // pow with an exponent of 100 and the division by a small cosine amplify roundings; of 1 − F
                    // few digits are left where a facet is grazed
                    let floor = if through { 3e-5 } else { 1e-6 };
                    let tolerance = 3e-4 * (there[c] * scale).max(back[c]) + floor;
                    assert!(difference < tolerance, "{} {wo:?} {wi:?}: {there:?} {back:?}", lobe.name);
                }
            }
        }
    }
}

#[test]
fn mirrors_and_clear_glass() {
    let white = [0.5, 0.7, 0.9];
    let mirror = Lobe { kind: MATERIAL_CONDUCTOR, mode: FRESNEL_NONE, color: white, ..Lobe::default() };
    for wo in directions() {
        for s in samples(&mirror, wo, 64, 1) {
            let out = wo.map(f64::from);
            assert_eq!(s.wi, [-out[0], -out[1], out[2]]);
            assert!(s.pdf == 0.0 && !s.through && s.eval == [0.0; 3] && s.pdf_again == 0.0);
            assert!((0..3).all(|c| (s.weight[c] - f64::from(white[c])).abs() < 1e-7));
        }
        for (ior, mode) in [(1.5_f32, 0), (0.7, 0), (1.5, 1)] {
            let glass = Lobe { kind: MATERIAL_DIELECTRIC, ior, mode, ..Lobe::default() };
            let all = samples(&glass, wo, 40_000, 2);
            let out = wo.map(f64::from);
            let thin = mode == 1;
            let eta = if out[2] > 0.0 || thin { f64::from(ior) } else { 1.0 / f64::from(ior) };
            let mut reflectance = fresnel::fresnel_dielectric(out[2].abs(), eta);
            if thin {
                reflectance = 2.0 * reflectance / (1.0 + reflectance);
            }
            for s in &all {
                if !s.through {
                    assert!((0..3).all(|c| (s.wi[c] - [-out[0], -out[1], out[2]][c]).abs() < 1e-6));
                    assert!(s.weight == [1.0; 3] && s.pdf == 0.0);
                } else if thin {
                    assert_eq!((s.wi, s.weight), (out.map(|c| -c), [1.0; 3]));
                } else {
                    // Snell: the part along the surface is divided by the index
                    assert!((s.wi[0] + out[0] / eta).abs() < 1e-6 && (s.wi[1] + out[1] / eta).abs() < 1e-6);
                    assert!(s.wi[2] * out[2] < 0.0);
                    assert!((s.weight[0] - 1.0 / (eta * eta)).abs() < 1e-5 && (s.eta - eta).abs() < 1e-6);
                }
            }
            let reflected = all.iter().filter(|s| !s.through).count() as f64 / all.len() as f64;
            let sigma = (reflectance * (1.0 - reflectance) / all.len() as f64).sqrt();
            assert!(
                (reflected - reflectance).abs() <= 4.0 * sigma,
                "{ior} {mode} {wo:?}: {reflected} {reflectance}"
            );
        }
    }
}

#[test]
fn visible_normals_follow_their_density() {
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
            let header = [floats(wo[0], wo[1], wo[2], 0.0), floats(alpha[0], alpha[1], 0.0, 0.0)];
            let mut inputs = header.to_vec();
            inputs.extend((0..COUNT).map(|_| floats(random.f32(), random.f32(), 0.0, 0.0)));
            let mut observed = vec![0; CELLS_Z * CELLS_PHI];
            for m in Probe::new().both(draw, &inputs, COUNT, COUNT) {
                let m = three(as_doubles(m));
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
