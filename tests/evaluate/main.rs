//! The kernel `evaluate`, which no render dispatches: values of textures at points that the host names, against texels
//! that are known by hand.
#![allow(clippy::unwrap_used, clippy::panic, reason = "what fails here fails the test that called it")]

#[path = "../common/mod.rs"]
mod common;

mod trees;

use common::probe::{Word, as_floats, cache, floats, sources};
use common::render::{Build, gpu, scene};
use dapple::gpu::{Command, Place};
use dapple::layout::{Backend, Frame, ImageTexture, Record, WORKGROUP};
use dapple::prepare::{self, Stage};
use dapple::render::key;
use dapple::scene::{Channel, Image, Scene, TexelFilter, Texels, Wrap};
use dapple::shader::Compiler;

/// Three workgroups, the last of which is not full.
const POINTS: usize = 130;

/// Two textures: the nearest of four colours, and a ramp of red from 0 to 2.
fn textures() -> Scene {
    let mut scene = scene(8, 8, 1);
    let colors =
        vec![[0.1, 0.2, 0.3, 1.0], [0.4, 0.5, 0.6, 1.0], [0.7, 0.8, 0.9, 0.5], [1.0, 2.0, 3.0, 0.25]];
    let colors = Image { width: 2, height: 2, texels: Texels::RgbaF32(colors) };
    scene.picture(colors, |texture| texture.filter = TexelFilter::Nearest);
    let ramp = vec![[0, 9, 9, 255], [255, 9, 9, 255]];
    let ramp = Image { width: 2, height: 1, texels: Texels::Rgba8(ramp) };
    scene.picture(ramp, |texture| {
        texture.wrap = [Wrap::Clamp; 2];
        texture.channel = Channel::R;
        texture.scale = 2.0;
    });
    scene
}

/// Reference of a texture, u, v, and what must come.
type Case = (u32, f32, f32, [f32; 4]);

fn cases() -> Vec<Case> {
    // The shape of the tree is in the upper 8 bits, the record in the lower 24.
    let (colors, ramp, none) = (0, 1 << 24 | ImageTexture::WORDS, 9 << 24);
    vec![
        (colors, 0.25, 0.75, [0.1, 0.2, 0.3, 1.0]),
        (colors, 0.75, 0.75, [0.4, 0.5, 0.6, 1.0]),
        (colors, 0.25, 0.25, [0.7, 0.8, 0.9, 0.5]),
        (colors, 0.75, 0.25, [1.0, 2.0, 3.0, 0.25]),
        (colors, -0.25, 1.25, [1.0, 2.0, 3.0, 0.25]),
        (ramp, 0.25, 0.5, [0.0, 0.0, 0.0, 1.0]),
        (ramp, 0.5, 0.5, [1.0, 1.0, 1.0, 1.0]),
        (ramp, 0.625, 0.1, [1.5, 1.5, 1.5, 1.0]),
        (ramp, 7.0, 0.5, [2.0, 2.0, 2.0, 1.0]),
        (none, 0.25, 0.75, [0.0; 4]),
    ]
}

fn evaluate(scene: &Scene, backend: Backend, points: &[Word], threads: u32) -> dapple::Result<Vec<Word>> {
    let gpu = gpu();
    let count = points.len() as u32 / 4;
    let prepared = prepare::prepare(scene)?;
    let mut sources = sources()?;
    sources.set_virtual("generated/textures.glsl", prepared.texture_glsl.as_str())?;
    let kernel = Compiler::new(sources, cache()).kernel(&key(scene, &prepared, Stage::Evaluate, backend))?;
    let layout = gpu.layout(backend)?;
    let pipeline = gpu.pipeline(&layout, &kernel)?;
    let frame = Frame { point_count: count, threads, ..Frame::default() };
    let bytes = u64::from(count) * 16;
    let values = gpu.buffer("values", bytes, Place::Device)?;
    let host = gpu.buffer("values (host)", bytes, Place::Readback)?;
    let bindings = gpu.bindings(
        &layout,
        &[
            ("frame", &gpu.upload("frame", bytemuck::bytes_of(&frame))?),
            ("points", &gpu.upload("points", bytemuck::cast_slice(points))?),
            ("textures", &gpu.upload("textures", bytemuck::cast_slice(&prepared.textures))?),
            ("texels", &gpu.upload("texels", bytemuck::cast_slice(&prepared.texels))?),
            ("values", &values),
        ],
    )?;
    let groups = [count.div_ceil(WORKGROUP).div_ceil(threads), threads];
    gpu.run(&[
        Command::Fill { buffer: &values, bytes, value: u32::MAX },
        Command::Barrier,
        Command::Dispatch { pipeline: &pipeline, bindings: &bindings, groups },
        Command::Barrier,
        Command::Copy { from: &values, to: &host, bytes },
        Command::Barrier,
    ])?;
    host.read(bytes, |words| words.as_chunks().0.to_vec())
}

#[test]
fn textures_have_the_values_of_their_texels() {
    let cases = cases();
    let case = |i: usize| cases[i % cases.len()];
    let points: Vec<Word> = (0..POINTS)
        .flat_map(|i| {
            let (reference, u, v, _) = case(i);
            [[reference, 0, 0, 0], [0; 4], floats(u, v, 0.0, 0.0), floats(0.0, 0.0, 1.0, 0.0)]
        })
        .collect();
    for (backend, threads) in [(Backend::Storage, 1), (Backend::Texel, 2)] {
        let values =
            evaluate(&textures(), backend, &points, threads).unwrap_or_else(|error| panic!("{error}"));
        for (i, value) in values.into_iter().map(as_floats).enumerate() {
            let (_, u, v, expected) = case(i);
            let off = (0..4).map(|c| (value[c] - expected[c]).abs()).fold(0.0, f32::max);
            // A filter rounds a few times.
            assert!(off <= 1e-6, "{backend:?}, point {i} at {u}, {v}: {value:?}, expected {expected:?}");
        }
    }
}
