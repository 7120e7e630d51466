//! `shaders/material`: every lobe against its own density, reciprocity and energy.

use crate::common::chi2;
use crate::common::directions::{CELLS_PHI, CELLS_Z, cell_integrals, cell_of, midpoints};
use crate::common::probe::{Probe, Word, as_doubles, floats, three, vector};
use crate::common::random::Random;
use crate::common::twins::fresnel;
use crate::common::twins::math::{cross, dot, normalize};
use crate::common::twins::sampling::{DISK_ERROR, disk_inverse, turn, turns_apart};
use dapple::layout::{
    FRESNEL_EXACT, FRESNEL_INDEX, FRESNEL_NONE, FRESNEL_SCHLICK, MATERIAL_CONDUCTOR, MATERIAL_DIELECTRIC,
    MATERIAL_DIFFUSE, MATERIAL_PHONG,
};

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
    #define HAS_METAL_INDEX
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
    u01: [f64; 2],
    wi: [f64; 3],
    pdf: f64,
    weight: [f64; 3],
    eta: f64,
    through: bool,
    eval: [f64; 3],
    pdf_again: f64,
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
    let sample = |(v, u): (&[Word], &Word)| {
        let [a, b, c] = [v[0], v[1], v[2]].map(as_doubles);
        let [x, y, ..] = as_doubles(*u);
        Sample {
            u01: [x, y],
            wi: three(a),
            pdf: a[3],
            weight: three(b),
            eta: b[3].abs(),
            through: b[3] < 0.0,
            eval: three(c),
            pdf_again: c[3],
        }
    };
    values.chunks_exact(3).zip(&inputs[HEADER..]).map(sample).collect()
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
            // Facets throw a part of the light under the surface, where their density is 0
            let least = if matches!(lobe.kind, MATERIAL_DIFFUSE | MATERIAL_PHONG) { 0.998 } else { 0.0 };
            assert!((least..1.002).contains(&everywhere), "{place}: the density integrates to {everywhere}");
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
fn lobes_go_back_to_the_square() {
    let diffuse = Lobe { name: "diffuse", kind: MATERIAL_DIFFUSE, color: [0.5; 3], ..Lobe::default() };
    let glossy = |name, exponent| {
        let specular = [1.0; 3];
        Lobe { name, kind: MATERIAL_PHONG, specular, exponent, ..Lobe::default() }
    };
    for lobe in [diffuse, glossy("phong 1", 1.0), glossy("phong 20", 20.0), glossy("phong 300", 300.0)] {
        // A cosine is known to a rounding, which its power multiplies
        let tolerance = if lobe.kind == MATERIAL_DIFFUSE {
            DISK_ERROR
        } else {
            1e-6 + 3e-7 * (f64::from(lobe.exponent) + 1.0)
        };
        for wo in directions() {
            let mirror = [-wo[0], -wo[1], wo[2]].map(f64::from);
            let side = normalize(cross(mirror, [0.6, -0.8, 0.0]));
            let other = cross(mirror, side);
            let (mut zero, mut kept) = (None, 0);
            for s in samples(&lobe, wo, 10_000, 5).iter().filter(|s| s.weight != [0.0; 3]) {
                kept += 1;
                let off = if lobe.kind == MATERIAL_DIFFUSE {
                    let back = disk_inverse(s.wi[0], s.wi[1]);
                    (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs())
                } else {
                    let cos = dot(s.wi, mirror);
                    let angle = turn(dot(s.wi, side), dot(s.wi, other));
                    // The zero of the angle is anywhere
                    let zero = *zero.get_or_insert((angle - s.u01[1]).rem_euclid(1.0));
                    let back = cos.powf(f64::from(lobe.exponent) + 1.0);
                    let sin = (1.0 - cos * cos).max(0.0).sqrt();
                    (back - s.u01[0]).abs().max(turns_apart(angle, s.u01[1] + zero) * sin)
                };
                assert!(off < tolerance, "{} from {wo:?}: {:?} is off by {off}", lobe.name, s.u01);
            }
            assert!(kept > 5000, "{} from {wo:?}: {kept}", lobe.name);
        }
    }
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
