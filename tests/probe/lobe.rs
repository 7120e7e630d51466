//! Lobes of materials, and what every one of them must do.

use crate::common::chi2;
use crate::common::directions::{CELLS_PHI, CELLS_Z, cell_integrals, cell_of, midpoints};
use crate::common::probe::{Probe, Word, as_doubles, floats, three, vector};
use crate::common::random::Random;
use dapple::layout::{Backend, DIELECTRIC_SOLID, InterfaceInput, MATERIAL_BSDFS, MATERIAL_DIELECTRIC};
use dapple::scene::{BSDFS, BsdfKind};

/// A BSDF that is tested.
#[derive(Clone, Copy, Default)]
pub struct Lobe {
    pub name: &'static str,
    pub kind: u32,
    pub mode: u32,
    pub ior: f32,
    pub numbers: [f32; 2],
    pub color: [f32; 3],
    pub specular: [f32; 3],
    pub k: [f32; 3],
    pub alpha: [f32; 2],
    pub metallic: f32,
    pub weight: f32,
    pub transmission: f32,
    pub coat: [f32; 2],
    pub sheen: [f32; 3],
    pub sheen_roughness: f32,
    pub interface: Tables,
}

/// What an interface lets through: its record, and the words of its tables.
#[derive(Clone, Copy, Default)]
pub struct Tables {
    pub record: InterfaceInput,
    pub words: &'static [Word],
}

impl Tables {
    /// Of what has no interface.
    pub const NONE: Self = Self {
        record: InterfaceInput { through_table: 0, inner_table: 0, through_mean: 0.0, spare: 0 },
        words: &[],
    };
}

/// The number of a BSDF of the table.
pub fn bsdf(name: &str) -> u32 {
    MATERIAL_BSDFS + BsdfKind::named(name).unwrap().index() as u32
}

impl Lobe {
    /// Whether light can go through to an inside, or through a sheet of that.
    pub fn is_clear(&self) -> bool {
        self.kind == MATERIAL_DIELECTRIC || self.transmission > 0.0
    }

    fn header(&self, wo: [f32; 3]) -> Vec<Word> {
        vec![
            [self.kind, self.mode, self.ior.to_bits(), 0],
            vector(self.color),
            vector(self.specular),
            vector(self.k),
            floats(self.alpha[0], self.alpha[1], self.numbers[0], self.numbers[1]),
            floats(self.metallic, self.weight, self.transmission, 0.0),
            floats(self.coat[0], self.coat[1], self.sheen_roughness, 0.0),
            vector(self.sheen),
            vector(wo),
            bytemuck::cast(self.interface.record),
        ]
    }

    /// The header and what is behind it: points, then the tables.
    pub fn inputs(&self, wo: [f32; 3], points: impl Iterator<Item = Word>) -> (Vec<Word>, String) {
        let mut inputs = self.header(wo);
        inputs.extend(points);
        let rows = BSDFS.iter().map(|row| format!("#define HAS_BSDF_{}\n", row.name.to_uppercase()));
        let glsl = format!("#define TABLES {}u\n{}{BSDF}", inputs.len(), rows.collect::<String>());
        inputs.extend(self.interface.words);
        (inputs, glsl)
    }
}

const HEADER: usize = 10;

const BSDF: &str = "
    #define fetch_materials(i) fetch_points(TABLES + (i))
    #define HAS_CONDUCTOR
    #define HAS_METAL_INDEX
    #define HAS_DIELECTRIC
    #define HAS_COATED_DIFFUSE
    #define HAS_COATED_CONDUCTOR
    #define HAS_INTERFACE_TABLES
    #define HAS_PRINCIPLED
    #define HAS_TRANSMISSION
    #define HAS_CLEARCOAT
    #define HAS_SHEEN
    #include \"material/material.glsl\"
    const uint HEADER = 10u;
    vec3 vector(uint at) { return uintBitsToFloat(fetch_points(at).xyz); }
    Bsdf probe_bsdf() {
        uvec4 a = fetch_points(0u);
        vec3 mixed = vector(5u);
        vec3 coat = vector(6u);
        InterfaceInput of = interface_input_unpack(fetch_points(9u));
        return Bsdf(a.x, a.y, vector(1u), vector(2u), vector(3u), uintBitsToFloat(a.z), uintBitsToFloat(fetch_points(4u).zw), vector(4u).xy,
                    mixed.x, mixed.y, mixed.z, coat.x, coat.yy, vector(7u), coat.z, of.through_table, of.inner_table, of.through_mean,
                    vec3(uintBitsToFloat(a.z)), vec3(1.0 / 3.0), false);
    }
";

/// A sample of a BSDF and what the other two verbs say of it.
pub struct Sample {
    pub u01: [f64; 2],
    pub wi: [f64; 3],
    pub pdf: f64,
    pub weight: [f64; 3],
    pub eta: f64,
    pub through: bool,
    pub eval: [f64; 3],
    pub pdf_again: f64,
}

pub fn samples(lobe: &Lobe, wo: [f32; 3], count: usize, seed: u64) -> Vec<Sample> {
    let mut random = Random(seed);
    let points = (0..count).map(|_| floats(random.f32(), random.f32(), random.f32(), 0.0));
    let (inputs, bsdf) = lobe.inputs(wo, points);
    let glsl = format!(
        "{bsdf} void probe(uint i) {{
            Bsdf b = probe_bsdf();
            vec3 wo = vector(8u);
            vec3 u = vector(HEADER + i);
            BsdfSample s = bsdf_sample(b, wo, u.z, u.xy);
            store_values(3u * i, floatBitsToUint(vec4(s.wi, s.pdf)));
            store_values(3u * i + 1u, floatBitsToUint(vec4(s.weight, s.through ? -s.eta : s.eta)));
            store_values(3u * i + 2u, floatBitsToUint(vec4(bsdf_eval(b, wo, s.wi), bsdf_pdf(b, wo, s.wi))));
        }}"
    );
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
pub fn over_the_sphere(lobe: &Lobe, wo: [f32; 3]) -> Vec<(f64, [f64; 3], [f64; 3])> {
    let points = midpoints();
    let count = points.len();
    let (inputs, bsdf) = lobe.inputs(wo, points.iter().map(|m| floats(m[0], m[1], m[2], 0.0)));
    let glsl = format!(
        "{bsdf} void probe(uint i) {{
            Bsdf b = probe_bsdf();
            vec3 wo = vector(8u);
            vec3 wi = vector(HEADER + i);
            store_values(2u * i, floatBitsToUint(vec4(bsdf_eval(b, wo, wi), bsdf_pdf(b, wo, wi))));
            store_values(2u * i + 1u, floatBitsToUint(vec4(bsdf_eval(b, wi, wo), 0.0)));
        }}"
    );
    let values = Probe::new().both(&glsl, &inputs, count, 2 * count);
    let row = |v: &[Word]| (as_doubles(v[0])[3], three(as_doubles(v[0])), three(as_doubles(v[1])));
    values.chunks_exact(2).map(row).collect()
}

/// What is scattered in all of white light, seen from a direction: an integral over rows of midpoints. Light that has gone through
/// is counted without the 1 / η² that its radiance is scaled by.
pub fn albedo(lobe: &Lobe, wo: [f32; 3]) -> f64 {
    const ROWS: usize = 512;
    let (inputs, bsdf) = lobe.inputs(wo, std::iter::empty());
    let glsl = format!(
        "{bsdf} void probe(uint i) {{
            Bsdf b = probe_bsdf();
            vec3 wo = vector(8u);
            float z = (float(i) + 0.5) / 256.0 - 1.0;
            float scale = b.mode == DIELECTRIC_SOLID && z * wo.z < 0.0 ? (wo.z > 0.0 ? b.ior * b.ior : 1.0 / (b.ior * b.ior)) : 1.0;
            float sum = 0.0;
            for (uint k = 0u; k < 192u; ++k) {{
                float phi = 2.0 * PI * (float(k) + 0.5) / 192.0;
                sum += bsdf_eval(b, wo, vec3(safe_sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z)).x;
            }}
            store_values(i, floatBitsToUint(vec4(sum * abs(z) * scale * 4.0 * PI / (512.0 * 192.0), 0.0, 0.0, 0.0)));
        }}"
    );
    let rows = Probe::new().run(&glsl, Backend::Storage, &inputs, ROWS, ROWS);
    rows.into_iter().map(|row| as_doubles(row)[0]).sum()
}

/// From nearly upright to nearly grazing, and from below.
pub fn directions() -> [[f32; 3]; 4] {
    [[0.6, 0.0, 0.8], [-0.48, 0.6, 0.64], [0.1, -0.97, 0.221_585], [0.36, 0.48, -0.8]]
}

/// Samples follow the density, and their weights are its quotient. Furnaces do not gain.
pub fn check_samples(lobes: &[Lobe]) {
    const COUNT: usize = 60_000;
    let mut results = Vec::new();
    for (i, lobe) in lobes.iter().enumerate() {
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
            let density = over_the_sphere(lobe, wo);
            let mut values = density.iter().map(|d| d.1).zip(midpoints());
            let both_sides = values.any(|(value, wi)| wi[2] * wo[2] < 0.0 && value != [0.0; 3]);
            assert!(observed[..CELLS_Z * CELLS_PHI].iter().sum::<u64>() > 0, "{place}: nothing is sampled");
            let everywhere: f64 = cell_integrals(density.iter().map(|d| d.0)).iter().sum();
            // Facets throw a part of the light under the surface, where their density is 0
            let whole = [bsdf("diffuse"), bsdf("phong")].contains(&lobe.kind);
            let least = if whole { 0.998 } else { 0.0 };
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

/// Light goes both ways alike.
pub fn check_reciprocity(lobes: &[Lobe]) {
    for lobe in lobes {
        for wo in directions() {
            for ((_, there, back), wi) in over_the_sphere(lobe, wo).into_iter().zip(midpoints()) {
                // Radiance in glass is η² times as dense (Veach 1997, section 5.2): from the side of index 1, f is
                // 1 / η² of what it is the other way round
                let has_inside =
                    lobe.kind < MATERIAL_BSDFS && lobe.is_clear() && lobe.mode == DIELECTRIC_SOLID;
                let through = has_inside && wi[2] * wo[2] < 0.0;
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
