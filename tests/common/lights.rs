//! Lights, and samples of them from the kernels.

use super::probe::{Probe, Word, as_doubles, floats, three, vector};
use super::random::Random;
use super::twins::math::{cross, dot, length, normalize, sub, wide};
use dapple::layout::{LIGHT_DISK, LIGHT_SPHERE, LIGHT_TRIANGLE, Light, NONE};
use dapple::scene::PUNCTUAL_LIGHTS;
use std::f64::consts::PI;

/// One sample of a light.
pub struct Sample {
    pub u01: [f64; 2],
    pub wi: [f64; 3],
    pub pdf: f64,
    pub point: [f64; 3],
    pub pdf_again: f64,
    pub normal: [f64; 3],
    pub radiance: f64,
}

const GLSL: &str = "
    #define HAS_LIGHT_POINT
    #define HAS_LIGHT_SPHERE
    #define HAS_LIGHT_QUAD
    #define HAS_LIGHT_DISK
    #define HAS_LIGHT_TRIANGLE
    #define HAS_LIGHT_PART
    #define HAS_LIGHT_PATCH
    #include \"light/light.glsl\"
    Light probe_light() {
        return light_unpack(fetch_points(0u), fetch_points(1u), fetch_points(2u), fetch_points(3u),
                            fetch_points(4u), fetch_points(5u), fetch_points(6u));
    }
    void probe(uint i) {
        Light light = probe_light();
        vec3 from = uintBitsToFloat(fetch_points(7u).xyz);
        LightSample s = light_sample_one(light, from, uintBitsToFloat(fetch_points(8u + i).xy));
        float pdf = light_pdf_one(light, from, s.point, s.normal);
        store_values(3u * i, floatBitsToUint(vec4(s.wi, s.pdf)));
        store_values(3u * i + 1u, floatBitsToUint(vec4(s.point, pdf)));
        store_values(3u * i + 2u, floatBitsToUint(vec4(s.normal, s.radiance.x)));
    }";

/// Samples of a light as seen from a point, at random.
pub fn samples(light: &Light, from: [f32; 3], count: usize) -> Vec<Sample> {
    let rows = PUNCTUAL_LIGHTS.iter().map(|row| format!("#define HAS_LIGHT_{}\n", row.name.to_uppercase()));
    let glsl = rows.collect::<String>() + GLSL;
    let mut inputs: Vec<Word> = bytemuck::cast_slice(std::slice::from_ref(light)).to_vec();
    inputs.push(vector(from));
    let header = inputs.len();
    let mut random = Random(1);
    inputs.extend((0..count).map(|_| floats(random.f32(), random.f32(), 0.0, 0.0)));
    let values = Probe::new().both(&glsl, &inputs, count, 3 * count);
    let sample = |(v, u): (&[Word], &Word)| {
        let [a, b, c] = [v[0], v[1], v[2]].map(as_doubles);
        let [x, y, ..] = as_doubles(*u);
        Sample {
            u01: [x, y],
            wi: three(a),
            pdf: a[3],
            point: three(b),
            pdf_again: b[3],
            normal: three(c),
            radiance: c[3],
        }
    };
    values.chunks_exact(3).zip(&inputs[header..]).map(sample).collect()
}

/// A light of radiance 3, alone.
pub fn light(kind: u32) -> Light {
    Light { kind, chance: 1.0, accept: 1.0, radiance: [3.0; 3], texture: NONE, ..Light::default() }
}

/// A ball.
pub fn sphere(position: [f32; 3], radius: f32, two_sided: u32) -> Light {
    let area = (4.0 * PI * f64::from(radius).powi(2)) as f32;
    // Its axes are those of the world; the third is spread over the uv fields
    let (edge_u, edge_v) = ([radius, 0.0, 0.0], [0.0, radius, 0.0]);
    let uv1 = [radius, 0.0];
    Light { position, edge_u, edge_v, uv1, a: radius, b: area, two_sided, ..light(LIGHT_SPHERE) }
}

/// A rectangle, disk or triangle.
pub fn flat(kind: u32, position: [f32; 3], edge_u: [f32; 3], edge_v: [f32; 3]) -> Light {
    let area = length(cross(wide(edge_u), wide(edge_v)));
    let share = match kind {
        LIGHT_DISK => PI,
        LIGHT_TRIANGLE => 0.5,
        _ => 1.0,
    };
    Light { position, edge_u, edge_v, a: 1.0, b: (area * share) as f32, ..light(kind) }
}

/// Checks what holds for every point on a surface light, and gives the mean of 1 / pdf over all samples.
pub fn check(
    place: &str,
    light: &Light,
    from: [f32; 3],
    all: &[Sample],
    normal_at: impl Fn([f64; 3]) -> [f64; 3],
) -> f64 {
    let from = wide(from);
    let mut sum = 0.0;
    for s in all.iter().filter(|s| s.pdf > 0.0) {
        let to = sub(s.point, from);
        let reach = length(s.point).max(length(from));
        assert!(
            length(sub(normalize(to), s.wi)) < 2e-6 * (1.0 + reach / length(to)),
            "{place}: wi {:?}",
            s.wi
        );
        let normal = normal_at(s.point);
        let side = dot(s.normal, normal);
        assert!((side.abs() - 1.0).abs() < 1e-4, "{place}: normal {:?}, not {normal:?}", s.normal);
        assert!(light.two_sided != 0 || side > 0.0, "{place}: the back of the light is seen");
        // Seen from `from`; a grazing point may be on either side of its horizon by rounding
        assert!(dot(s.normal, s.wi) < 1e-3, "{place}: {:?} looks away", s.point);
        assert_eq!(s.radiance, f64::from(light.radiance[0]), "{place}");
        // The same formula of the same point; where it grazes the surface, the cosine keeps few digits
        let grazing = 2e-6 / dot(normal, s.wi).abs().max(1e-6);
        assert!((s.pdf_again / s.pdf - 1.0).abs() < 1e-4 + grazing, "{place}: {} and {}", s.pdf, s.pdf_again);
        sum += 1.0 / s.pdf;
    }
    sum / all.len() as f64
}

/// |mean of 1 / pdf − solid angle| within `relative`, or four standard errors of samples whose 1 / pdf spreads.
pub fn expect_solid_angle(place: &str, all: &[Sample], mean: f64, solid_angle: f64, relative: f64) {
    let n = all.len() as f64;
    let squares: f64 = all.iter().filter(|s| s.pdf > 0.0).map(|s| s.pdf.powi(-2)).sum();
    let sigma = ((squares / n - mean * mean).max(0.0) / n).sqrt();
    let tolerance = relative * solid_angle + 4.0 * sigma;
    assert!((mean - solid_angle).abs() < tolerance, "{place}: {mean} ± {sigma}, not {solid_angle}");
}
