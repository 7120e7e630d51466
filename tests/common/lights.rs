//! Lights, and samples of them from the kernels.

use super::probe::{Probe, Word, as_doubles, floats, three, vector};
use super::random::Random;
use super::twins::math::{cross, length, wide};
use dapple::layout::{LIGHT_DISK, LIGHT_SPHERE, LIGHT_TRIANGLE, Light, NONE};
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

/// Samples of a light as seen from a point, at random.
pub fn samples(light: &Light, from: [f32; 3], count: usize) -> Vec<Sample> {
    let glsl = "
        #define HAS_LIGHT_POINT
        #define HAS_LIGHT_SPOT
        #define HAS_LIGHT_DISTANT
        #define HAS_LIGHT_SPHERE
        #define HAS_LIGHT_QUAD
        #define HAS_LIGHT_DISK
        #define HAS_LIGHT_TRIANGLE
        #include \"light/light.glsl\"
        Light probe_light() {
            return light_unpack(fetch_points(0u), fetch_points(1u), fetch_points(2u), fetch_points(3u),
                                fetch_points(4u), fetch_points(5u), fetch_points(6u));
        }
        void probe(uint i) {
            Light light = probe_light();
            vec3 from = uintBitsToFloat(fetch_points(7u).xyz);
            LightSample s = light_sample_one(light, from, uintBitsToFloat(fetch_points(8u + i).xy));
            float pdf = 0.0;
            if (light.kind == LIGHT_SPHERE) pdf = sphere_light_pdf(light, from, s.point, s.normal);
            else if (light.kind == LIGHT_QUAD) pdf = quad_light_pdf(light, from, s.point, s.normal);
            else pdf = flat_light_pdf(light, from, s.point, s.normal);
            store_values(3u * i, floatBitsToUint(vec4(s.wi, s.pdf)));
            store_values(3u * i + 1u, floatBitsToUint(vec4(s.point, pdf)));
            store_values(3u * i + 2u, floatBitsToUint(vec4(s.normal, s.radiance.x)));
        }";
    let mut inputs: Vec<Word> = bytemuck::cast_slice(std::slice::from_ref(light)).to_vec();
    inputs.push(vector(from));
    let header = inputs.len();
    let mut random = Random(1);
    inputs.extend((0..count).map(|_| floats(random.f32(), random.f32(), 0.0, 0.0)));
    let values = Probe::new().both(glsl, &inputs, count, 3 * count);
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
