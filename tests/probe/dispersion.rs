//! Glass with dispersion against three glasses, one for each colour.

use crate::common::probe::{Probe, as_doubles, floats};
use crate::common::random::Random;
use crate::lobe::{Lobe, Tables, directions};
use dapple::layout::{DIELECTRIC_SOLID, MATERIAL_DIELECTRIC, MATERIAL_PRINCIPLED};
use dapple::scene::LensInterface;

const INDEX: f32 = 1.6;
const ABBE: f32 = 20.0;
/// In µm.
const WAVELENGTHS: [f64; 3] = [0.6114, 0.5491, 0.4643];

fn glasses() -> [Lobe; 3] {
    let glass = |name, alpha| Lobe {
        name,
        kind: MATERIAL_DIELECTRIC,
        mode: DIELECTRIC_SOLID,
        ior: INDEX,
        color: [1.0; 3],
        alpha: [alpha; 2],
        interface: Tables::NONE,
        ..Lobe::default()
    };
    let layered = Lobe {
        kind: MATERIAL_PRINCIPLED,
        coat: [0.0, 0.1],
        sheen_roughness: 0.5,
        ..glass("principled", 0.3)
    };
    let layered =
        Lobe { color: [0.9, 0.6, 0.3], specular: [1.0; 3], weight: 1.0, transmission: 0.8, ..layered };
    [glass("smooth", 0.0), glass("rough", 0.2), layered]
}

/// What a path brings of each colour: alike, not alike, and of one alone.
const THROUGHPUTS: [[f32; 3]; 3] = [[1.0; 3], [0.8, 0.5, 0.6], [0.0, 2.0, 0.0]];

/// The header of the kernels here: `dispersing` is what each of them asks.
fn kernel(lobe: &str, throughput: [f32; 3], body: &str) -> String {
    let [r, g, b] = throughput;
    let switch = format!("#define HAS_DISPERSION\n#define THROUGHPUT vec3({r:?}, {g:?}, {b:?})\n");
    format!(
        "{switch}{lobe}
        #include \"material/dispersion.glsl\"
        Bsdf dispersing() {{
            Bsdf b = probe_bsdf();
            disperse(b, 1.0 / {ABBE:?}, THROUGHPUT, 0.5);
            return b;
        }}
        void probe(uint i) {{
            vec3 wo = vector(8u);
            vec3 u = vector(HEADER + i);
            {body}
        }}"
    )
}

#[test]
fn indices_are_those_of_lenses() {
    let [lobe, ..] = glasses();
    let (inputs, header) = lobe.inputs([0.0, 0.0, 1.0], [[0; 4]].into_iter());
    let body = "store_values(i, floatBitsToUint(vec4(dispersing().indices, 0.0)));";
    let found = as_doubles(Probe::new().both(&kernel(&header, THROUGHPUTS[0], body), &inputs, 1, 1)[0]);
    let row = LensInterface {
        radius: 0.0,
        thickness: 0.0,
        index: INDEX.into(),
        abbe: Some(ABBE.into()),
        aperture: 1.0,
    };
    let [a, b] = row.cauchy();
    for (found, wavelength) in found.into_iter().zip(WAVELENGTHS) {
        let expected = a + b / (wavelength * wavelength);
        assert!((found - expected).abs() < 2e-6, "{found}, expected {expected}");
    }
    assert!(found[0] < f64::from(INDEX) && found[2] - found[0] > 0.025);
}

#[test]
fn values_are_those_of_the_colours_and_densities_their_mean() {
    let body = "
        Bsdf b = dispersing();
        vec3 wi = u;
        vec3 f; vec3 pdf;
        for (uint c = 0u; c < 3u; ++c) {
            Bsdf one = dispersing();
            one.ior = dot(one.indices, color_mask(COLOR_RED + c));
            f += color_mask(COLOR_RED + c) * bsdf_eval(one, wo, wi);
            pdf += color_mask(COLOR_RED + c) * bsdf_pdf(one, wo, wi);
        }
        float mean = dot(pdf, THROUGHPUT) / (3.0 * mean_component(THROUGHPUT));
        store_values(2u * i, floatBitsToUint(vec4(dispersed_eval(b, wo, wi) - f, dispersed_pdf(b, wo, wi) - mean)));
        store_values(2u * i + 1u, floatBitsToUint(vec4(f, mean)));";
    let body = body.replace("vec3 f; vec3 pdf;", "vec3 f = vec3(0.0), pdf = vec3(0.0);");
    let mut random = Random(1);
    for (lobe, throughput) in glasses()[1..].iter().flat_map(|lobe| THROUGHPUTS.map(|t| (lobe, t))) {
        for wo in directions() {
            let points: Vec<_> =
                (0..2000).map(|_| random.direction()).map(|[x, y, z]| floats(x, y, z, 0.0)).collect();
            let count = points.len();
            let (inputs, header) = lobe.inputs(wo, points.into_iter());
            let values = Probe::new().both(&kernel(&header, throughput, &body), &inputs, count, 2 * count);
            let mut apart = 0.0_f64;
            for pair in values.chunks_exact(2).map(|pair| [as_doubles(pair[0]), as_doubles(pair[1])]) {
                for (off, value) in pair[0].into_iter().zip(pair[1]) {
                    assert!(off.abs() <= 1e-5 * value.abs(), "{}: {pair:?}", lobe.name);
                }
                apart = apart.max(1.0 - pair[1][2] / pair[1][0].max(1e-9));
            }
            assert!(apart > 0.01, "{}: colours that are alike prove nothing", lobe.name);
        }
    }
}

/// Means of what a colour brings along x, y, z and in all, of reflected and of transmitted light, with their errors.
fn moments(lobe: &Lobe, wo: [f32; 3], throughput: [f32; 3], sample: &str, seed: u64) -> [[[f64; 2]; 5]; 3] {
    const COUNT: usize = 200_000;
    let mut random = Random(seed);
    let points = (0..COUNT).map(|_| floats(random.f32(), random.f32(), random.f32(), 0.0));
    let (inputs, header) = lobe.inputs(wo, points);
    let body = format!(
        "{sample}
        store_values(2u * i, floatBitsToUint(vec4(s.wi, s.through ? 1.0 : 0.0)));
        store_values(2u * i + 1u, floatBitsToUint(vec4(s.weight, 0.0)));"
    );
    let values = Probe::new().run(
        &kernel(&header, throughput, &body),
        dapple::layout::Backend::Storage,
        &inputs,
        COUNT,
        2 * COUNT,
    );
    let mut sums = [[[0.0; 2]; 5]; 3];
    for pair in values.chunks_exact(2) {
        let ([x, y, z, through], weight) = (as_doubles(pair[0]), as_doubles(pair[1]));
        for (c, sums) in sums.iter_mut().enumerate() {
            for (sum, f) in sums.iter_mut().zip([x, y, z, through, 1.0]) {
                sum[0] += weight[c] * f;
                sum[1] += (weight[c] * f).powi(2);
            }
        }
    }
    let n = COUNT as f64;
    sums.map(|color| {
        color.map(|[sum, squares]| [sum / n, ((squares / n - (sum / n).powi(2)).max(0.0) / n).sqrt()])
    })
}

#[test]
fn samples_bring_each_colour_what_its_own_glass_brings() {
    let all = "Bsdf b = dispersing(); BsdfSample s = dispersed_sample(b, wo, u.z, u.xy);";
    for (lobe, throughput) in
        glasses().iter().flat_map(|lobe| [(lobe, THROUGHPUTS[0]), (lobe, THROUGHPUTS[1])])
    {
        for wo in directions() {
            let together = moments(lobe, wo, throughput, all, 1);
            for (c, of_color) in together.into_iter().enumerate().filter(|(c, _)| throughput[*c] > 0.0) {
                let one = format!(
                    "Bsdf b = dispersing(); b.ior = dot(b.indices, color_mask(COLOR_RED + {c}u));
                    BsdfSample s = bsdf_sample(b, wo, u.z, u.xy);"
                );
                let alone = moments(lobe, wo, throughput, &one, 2)[c];
                for ([a, a_error], [b, b_error]) in of_color.into_iter().zip(alone) {
                    let allowed = 4.5 * a_error.hypot(b_error) + 1e-4;
                    assert!(allowed < 0.06, "{}: too noisy to tell", lobe.name);
                    assert!((a - b).abs() < allowed, "{} from {wo:?}, colour {c}: {a}, alone {b}", lobe.name);
                }
            }
        }
    }
}

#[test]
fn what_a_path_brings_in_all_does_not_grow() {
    // Of glass that is all but smooth the colours hardly meet again; nothing here makes energy, so that a path brings no more than it did
    let [_, rough, _] = glasses();
    let lobe = Lobe { name: "nearly smooth", alpha: [0.002; 2], ..rough };
    let body = "
        BsdfSample s = dispersed_sample(dispersing(), wo, u.z, u.xy);
        store_values(i, floatBitsToUint(vec4(s.weight * THROUGHPUT, 0.0)));";
    let mut random = Random(5);
    for (throughput, wo) in THROUGHPUTS.iter().flat_map(|t| directions().map(|wo| (*t, wo))) {
        const COUNT: usize = 20_000;
        let points = (0..COUNT).map(|_| floats(random.f32(), random.f32(), random.f32(), 0.0));
        let (inputs, header) = lobe.inputs(wo, points);
        let values = Probe::new().both(&kernel(&header, throughput, body), &inputs, COUNT, COUNT);
        let before: f32 = throughput.iter().sum();
        for after in values.into_iter().map(as_doubles).map(|[r, g, b, _]| r + g + b) {
            // On the way out a path brings more, by the square of the index
            let most = if wo[2] > 0.0 { 1.0 } else { f64::from(INDEX + 0.1).powi(2) };
            assert!(after <= 1.02 * most * f64::from(before), "{after} after {before}");
        }
    }
}
