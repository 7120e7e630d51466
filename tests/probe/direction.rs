//! `light/direction.glsl`: directions and their places in pictures.

use crate::common::chi2;
use crate::common::directions::{CELLS_PHI, CELLS_Z, cell_integrals, cell_of, midpoints};
use crate::common::probe::{Probe, Word, as_doubles, floats, three};
use crate::common::random::Random;
use crate::common::render::{Build, scene};
use crate::common::twins::math::{cross, length, sub};
use dapple::layout::{Backend, Frame, NONE};
use dapple::prepare::prepare;
use dapple::scene::{DirectionMapping, Environment, Image, Texels, Value};
use std::f64::consts::PI;

const COUNT: usize = 100_000;

/// The direction of a place in the equal-area square, in pbrt's order of steps and with z up as there, turned so that y is up.
fn equal_area_direction([s, t]: [f64; 2]) -> [f64; 3] {
    let (u, v) = (2.0 * s - 1.0, 1.0 - 2.0 * t);
    let signed = 1.0 - (u.abs() + v.abs());
    let r = 1.0 - signed.abs();
    let phi = if r == 0.0 { 1.0 } else { (v.abs() - u.abs()) / r + 1.0 } * PI / 4.0;
    let across = r * (2.0 - r * r).sqrt();
    let [x, y, z] =
        [phi.cos().copysign(u) * across, phi.sin().copysign(v) * across, (1.0 - r * r).copysign(signed)];
    [x, z, -y]
}

#[test]
fn equal_area_places_go_to_directions_and_back() {
    let glsl = "
        #include \"shared/bindings.glsl\"
        #include \"light/direction.glsl\"
        void probe(uint i) {
            vec2 uv = uintBitsToFloat(fetch_points(i).xy);
            vec3 d = equal_area_direction(uv);
            store_values(2u * i, floatBitsToUint(vec4(d, 0.0)));
            store_values(2u * i + 1u, floatBitsToUint(vec4(equal_area_uv(d), 0.0, 0.0)));
        }";
    let mut random = Random(5);
    let mut places = vec![
        [0.5, 0.5],
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.5, 1.0],
        [1.0, 0.5],
        [0.25, 0.25],
        [0.25, 0.75_f32],
    ];
    places.extend((0..COUNT).map(|_| [random.f32(), random.f32()]));
    let inputs: Vec<Word> = places.iter().map(|p| floats(p[0], p[1], 0.0, 0.0)).collect();
    let values = Probe::new().both(glsl, &inputs, inputs.len(), 2 * inputs.len());
    let mut counts = vec![0_u64; CELLS_Z * CELLS_PHI];
    for (i, (place, value)) in places.iter().zip(values.chunks_exact(2)).enumerate() {
        let place = place.map(f64::from);
        let (d, back) = (three(as_doubles(value[0])), as_doubles(value[1]));
        assert!((length(d) - 1.0).abs() < 1e-6, "{place:?}: {d:?}");
        assert!(length(sub(d, equal_area_direction(place))) < 2e-6, "{place:?}: {d:?}");
        // The corners are one direction. The arc tangent of the driver is off by 4e-6, of which there are π in u and v
        let off = (back[0] - place[0]).abs().max((back[1] - place[1]).abs());
        assert!(off < 3e-6 || (1..4).contains(&i), "{place:?} comes back as {back:?}");
        if i >= places.len() - COUNT {
            counts[cell_of(d)] += 1;
        }
    }
    assert_eq!(as_doubles(values[0])[..3], [0.0, 1.0, 0.0], "the middle is +y");
    assert!(as_doubles(values[8])[2] > 0.999_999, "the middle of the upper edge is +z");
    assert!(as_doubles(values[10])[0] > 0.999_999, "the middle of the right edge is +x");
    assert!(as_doubles(values[4])[1] < -0.999_999, "a corner is -y");
    chi2::accept(&[("directions of even places".into(), chi2::test_uniform(&counts))]);
}

#[test]
fn the_equal_area_square_has_equal_areas() {
    let mut random = Random(6);
    let step = 1e-6;
    for _ in 0..1000 {
        let [u, v] = [random.f32(), random.f32()].map(f64::from);
        // Differences across the creases of the map are none
        let creases = [u - 0.5, v - 0.5, (u - 0.5).abs() + (v - 0.5).abs() - 0.5, u, 1.0 - u, v, 1.0 - v];
        if creases.iter().any(|crease| crease.abs() < 1e-3) {
            continue;
        }
        let slope = |du: f64, dv: f64| {
            let ends = sub(equal_area_direction([u + du, v + dv]), equal_area_direction([u - du, v - dv]));
            ends.map(|c| c / (2.0 * step))
        };
        let area = length(cross(slope(step, 0.0), slope(0.0, step)));
        assert!((area / (4.0 * PI) - 1.0).abs() < 1e-6, "{u} {v}: {area}");
    }
}

#[test]
fn the_density_of_an_environment_adds_up_to_one() {
    let mut random = Random(7);
    let texels: Vec<[f32; 4]> = (0..12 * 12).map(|_| [random.f32() * 9.0; 4]).collect();
    for (mapping, switch) in [
        (DirectionMapping::Equirectangular, ""),
        (DirectionMapping::EqualArea, "#define ENVIRONMENT_EQUAL_AREA"),
    ] {
        let mut s = scene(4, 4, 1);
        let picture =
            s.picture(Image { width: 12, height: 12, texels: Texels::RgbaF32(texels.clone()) }, |_| {});
        s.environment = Some(Environment { mapping, ..Environment::new(Value::Texture(picture)) });
        let prepared = prepare(&s).unwrap();
        let directions = midpoints();
        let glsl = format!(
            "#define fetch_environment(i) fetch_points({}u + (i))
            #define HAS_ENVIRONMENT
            #define ENVIRONMENT_IMAGE
            {switch}
            #include \"light/light.glsl\"
            void probe(uint i) {{
                float pdf = environment_pdf(uintBitsToFloat(fetch_points(i).xyz));
                store_values(i, floatBitsToUint(vec4(pdf, 0.0, 0.0, 0.0)));
            }}",
            directions.len()
        );
        let mut inputs: Vec<Word> = directions.iter().map(|d| floats(d[0], d[1], d[2], 0.0)).collect();
        inputs.extend(bytemuck::cast_slice::<_, Word>(&prepared.environment));
        let frame = Frame {
            environment_row0: [1.0, 0.0, 0.0],
            environment_row1: [0.0, 1.0, 0.0],
            environment_row2: [0.0, 0.0, 1.0],
            environment_size: prepared.environment_size,
            environment_texture: NONE,
            point_count: directions.len() as u32,
            threads: 1,
            ..Frame::default()
        };
        let values = Probe::new().run_with_frame(&glsl, Backend::Storage, &frame, &inputs, directions.len());
        let whole: f64 = cell_integrals(values.into_iter().map(|value| as_doubles(value)[0])).iter().sum();
        // Borders of cells go through the grid of directions
        assert!((whole - 1.0).abs() < 2e-3, "{mapping:?}: {whole}");
    }
}
