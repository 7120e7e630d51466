//! Choices by alias tables (`light_sample`, `environment_sample`): what is chosen is what the table of `prepare` says, as often
//! as it says, and with that density.

use crate::common::chi2;
use crate::common::probe::{Probe, Word, as_doubles, floats, three};
use crate::common::random::Random;
use crate::common::render::{Build, constant_environment, point, scene};
use crate::common::twins::math::dot;
use crate::common::twins::sampling::turn;
use dapple::layout::{Backend, Frame, NONE};
use dapple::prepare::{Prepared, prepare};
use dapple::scene::{Environment, Image, Scene, TexelFilter, Texels, Value};
use glam::{Mat3, Vec3};
use std::f64::consts::PI;

const COUNT: usize = 100_000;

/// A slot and what is left of the second number, from the two numbers that choose in a table of `accept`.
fn slot_of(pick: f64, u: f64, accept: impl Fn(usize) -> f64, slots: usize) -> (usize, bool, f64) {
    let slot = ((pick * slots as f64) as usize).min(slots - 1);
    let accept = accept(slot);
    if u < accept { (slot, true, u / accept) } else { (slot, false, (u - accept) / (1.0 - accept)) }
}

/// Chances of the slots of a table, from who owns how much of which.
fn chances(table: &[(f32, u32)]) -> Vec<f64> {
    let mut chances = vec![0.0; table.len()];
    for (slot, &(accept, alias)) in table.iter().enumerate() {
        chances[slot] += f64::from(accept) / table.len() as f64;
        if accept < 1.0 {
            chances[alias as usize] += (1.0 - f64::from(accept)) / table.len() as f64;
        }
    }
    chances
}

/// Three random numbers a word.
fn triples(seed: u64) -> Vec<Word> {
    let mut random = Random(seed);
    (0..COUNT).map(|_| floats(random.f32(), random.f32(), random.f32(), 0.0)).collect()
}

/// Runs `glsl`, for which `TABLE` is where the records begin, on both back ends.
fn run(glsl: &str, frame: &Frame, points: &[Word], records: &[Word], outputs: usize) -> Vec<[f64; 4]> {
    let glsl = format!("#define TABLE {}u\n{glsl}", points.len());
    let inputs = [points, records].concat();
    let frame = Frame { point_count: points.len() as u32, threads: 1, ..*frame };
    let on = |backend| Probe::new().run_with_frame(&glsl, backend, &frame, &inputs, outputs);
    let values = on(Backend::Storage);
    assert!(values == on(Backend::Texel), "the back ends differ");
    values.into_iter().map(as_doubles).collect()
}

fn light_choices(prepared: &Prepared) -> (Vec<Word>, Vec<[f64; 4]>) {
    // The points of the lights tell them apart; the environment has none
    let glsl = "
        #define fetch_lights(i) fetch_points(TABLE + (i))
        #define HAS_LIGHTS
        #define HAS_LIGHT_POINT
        #define HAS_ENVIRONMENT
        #include \"light/light.glsl\"
        void probe(uint i) {
            vec3 u = uintBitsToFloat(fetch_points(i).xyz);
            LightSample s = light_sample(vec3(0.0), u.x, u.yz);
            store_values(i, floatBitsToUint(vec4(s.point, s.pdf)));
        }";
    let frame = Frame {
        light_count: prepared.lights.len() as u32,
        environment_chance: prepared.environment_chance,
        ..Frame::default()
    };
    let points = triples(1);
    let values = run(glsl, &frame, &points, bytemuck::cast_slice(&prepared.lights), COUNT);
    (points, values)
}

#[test]
fn lights_are_chosen_by_their_chance() {
    for sky in [false, true] {
        let mut s = scene(4, 4, 1);
        for i in 0..23_u16 {
            let power = f32::from(i * i % 17);
            s.lights.push(point(Vec3::new(f32::from(i) + 1.0, 1.0, 0.0), power));
        }
        s.environment = constant_environment(1.0).filter(|_| sky);
        let prepared = prepare(&s).unwrap();
        let lights = &prepared.lights;
        let rest = 1.0 - f64::from(prepared.environment_chance);
        assert_eq!(rest < 1.0, sky);
        let table: Vec<(f32, u32)> = lights.iter().map(|light| (light.accept, light.alias)).collect();
        let chances = chances(&table);
        for (light, chance) in lights.iter().zip(&chances) {
            // In proportion to the power: that of the lamp of number i is i² mod 17
            let number = light.position[0] as u32 - 1;
            let share = rest * f64::from(number * number % 17) / powers();
            assert!((f64::from(light.chance) - share).abs() < 1e-6, "{number}: {} not {share}", light.chance);
            assert!((chance * rest - share).abs() < 1e-6, "{number}: the table gives {chance}, not {share}");
        }
        let (inputs, values) = light_choices(&prepared);
        let mut counts = vec![0_u64; lights.len() + 1];
        for (input, value) in inputs.iter().zip(&values) {
            let ([pick, u, ..], [x, .., pdf]) = (as_doubles(*input), *value);
            if x == 0.0 {
                counts[lights.len()] += 1;
                assert!(pick < 1.0 - rest && (pdf - (1.0 - rest) / (4.0 * PI)).abs() < 1e-7, "{pick} {pdf}");
                continue;
            }
            let chosen = x as usize - 1;
            counts[chosen] += 1;
            assert!((pdf - f64::from(lights[chosen].chance)).abs() < 1e-7, "{chosen}: {pdf}");
            let pick = (pick - (1.0 - rest)) / rest;
            let at = (pick * lights.len() as f64).fract();
            let accept = |slot: usize| f64::from(lights[slot].accept);
            let (slot, own, _) = slot_of(pick, u, accept, lights.len());
            // Within rounding of the border of a slot or of a share another one may be right
            if at.min(1.0 - at) > 1e-5 && (u - accept(slot)).abs() > 1e-6 {
                let expected = if own { slot } else { lights[slot].alias as usize };
                assert_eq!(chosen, expected, "{pick} {u}");
            }
        }
        let mut expected: Vec<f64> = chances.iter().map(|c| c * rest * COUNT as f64).collect();
        expected.push((1.0 - rest) * COUNT as f64);
        chi2::accept(&[(format!("sky {sky}"), chi2::test(&counts, &expected))]);
    }
}

/// Sum of the powers of `lights_are_chosen_by_their_chance`.
fn powers() -> f64 {
    (0..23_u32).map(|i| f64::from(i * i % 17)).sum()
}

/// A sky of 12 × 8 texels of all kinds of brightness, turned.
fn sky() -> (Scene, Mat3) {
    let turned = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(0.4);
    let texel = |i: u32| [(i * i % 31) as f32, 0.1, 0.0, 1.0];
    let texels = Texels::RgbaF32((0..96).map(texel).collect());
    let mut s = scene(4, 4, 1);
    let picture = s.picture(Image { width: 12, height: 8, texels }, |t| t.filter = TexelFilter::Nearest);
    let radiance = Value::Texture(picture);
    s.environment = Some(Environment { world_from_environment: turned, ..Environment::new(radiance) });
    (s, turned)
}

#[test]
fn cells_of_an_environment_are_chosen_by_their_chance_and_go_back_to_the_square() {
    let glsl = "
        #define fetch_environment(i) fetch_points(TABLE + (i))
        #define HAS_ENVIRONMENT
        #define ENVIRONMENT_IMAGE
        #include \"light/light.glsl\"
        void probe(uint i) {
            vec3 u = uintBitsToFloat(fetch_points(i).xyz);
            LightSample s = environment_sample(u.x, u.yz);
            store_values(2u * i, floatBitsToUint(vec4(s.wi, s.pdf)));
            store_values(2u * i + 1u, floatBitsToUint(vec4(environment_pdf(s.wi), 0.0, 0.0, 0.0)));
        }";
    let (scene, turned) = sky();
    let prepared = prepare(&scene).unwrap();
    let (cells, size) = (&prepared.environment, prepared.environment_size.map(|n| n as usize));
    assert_eq!(cells.len(), size[0] * size[1]);
    let table: Vec<(f32, u32)> = cells.iter().map(|cell| (cell.accept, cell.alias)).collect();
    let chances = chances(&table);
    for (cell, chance) in cells.iter().zip(&chances) {
        assert!((f64::from(cell.chance) - chance).abs() < 1e-7, "{} is {chance} in the table", cell.chance);
    }
    // The density is even over uv in a cell: its integral is the sum of the chances
    assert!((cells.iter().map(|cell| f64::from(cell.chance)).sum::<f64>() - 1.0).abs() < 1e-6);
    // World directions to those of the picture: the columns of the turn
    let rows = [turned.x_axis, turned.y_axis, turned.z_axis].map(|row| row.to_array());
    let frame = Frame {
        environment_row0: rows[0],
        environment_row1: rows[1],
        environment_row2: rows[2],
        environment_size: prepared.environment_size,
        environment_texture: NONE,
        ..Frame::default()
    };
    let inputs = triples(2);
    let values = run(glsl, &frame, &inputs, bytemuck::cast_slice(cells), 2 * COUNT);
    let mut counts = vec![0_u64; cells.len()];
    for (input, value) in inputs.iter().zip(values.chunks_exact(2)) {
        let ([pick, u, v, _], [wi, again]) = (as_doubles(*input), [value[0], value[1]]);
        let d = rows.map(|row| dot(row.map(f64::from), three(wi)));
        let at = [turn(-d[2], d[0]), 0.5 + d[1].atan2(d[0].hypot(d[2])) / PI];
        let at = [(at[0] + 0.5).rem_euclid(1.0) * size[0] as f64, at[1] * size[1] as f64];
        let [column, row] = [0, 1].map(|i| (at[i] as usize).min(size[i] - 1));
        let chosen = row * size[0] + column;
        counts[chosen] += 1;
        let latitude = (at[1] / size[1] as f64 - 0.5) * PI;
        let density = f64::from(cells[chosen].chance) * cells.len() as f64 / (2.0 * PI * PI * latitude.cos());
        let accept = |slot: usize| f64::from(cells[slot].accept);
        let (slot, own, rest) = slot_of(pick, u, accept, cells.len());
        let border = |x: f64| (x.fract() - 0.5).abs() > 0.5 - 1e-4;
        // Within rounding of the border of a slot, a share or a cell another one may be right
        if border(pick * cells.len() as f64) || (u - accept(slot)).abs() < 1e-6 || at.into_iter().any(border)
        {
            continue;
        }
        // Near a pole the cosine keeps few digits
        let tolerance = 1e-5 + 1e-6 / latitude.cos();
        assert!((wi[3] / density - 1.0).abs() < tolerance, "{pick} {u} {v}: {} not {density}", wi[3]);
        assert!((again[0] / density - 1.0).abs() < tolerance, "{pick} {u} {v}: {} not {density}", again[0]);
        let expected = if own { slot } else { cells[slot].alias as usize };
        assert_eq!(chosen, expected, "{pick} {u} {v}");
        // Rounding of u grows as the share gets small; near a pole a step in u is small
        let share = if own { accept(slot) } else { 1.0 - accept(slot) };
        let off = (at[0].fract() - rest).abs() * latitude.cos();
        assert!(off < 2e-5 + 2e-7 / share && (at[1].fract() - v).abs() < 2e-5, "{pick} {u} {v}: {at:?}");
    }
    let expected: Vec<f64> = chances.iter().map(|c| c * COUNT as f64).collect();
    chi2::accept(&[("cells".to_owned(), chi2::test(&counts, &expected))]);
}
