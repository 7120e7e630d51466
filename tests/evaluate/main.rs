//! The kernel `evaluate`, which no render dispatches: values of textures at points that the host names, against texels
//! that are known by hand.
#![allow(clippy::unwrap_used, clippy::panic, reason = "what fails here fails the test that called it")]

#[path = "../common/mod.rs"]
mod common;

mod mapping;
mod noise;
mod patterns;
mod pyramid;
mod stack;
mod trees;
mod user;

use common::probe::{cache, sources};
use common::render::{Build, gpu, scene};
use dapple::layout::{Backend, TexturePoint};
use dapple::render::Evaluator;
use dapple::scene::{Channel, Handle, Image, Scene, TexelFilter, Texels, Texture, Wrap};
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

/// u, v, and what must come.
type Case = (f32, f32, [f32; 4]);

const COLORS: [Case; 5] = [
    (0.25, 0.75, [0.1, 0.2, 0.3, 1.0]),
    (0.75, 0.75, [0.4, 0.5, 0.6, 1.0]),
    (0.25, 0.25, [0.7, 0.8, 0.9, 0.5]),
    (0.75, 0.25, [1.0, 2.0, 3.0, 0.25]),
    (-0.25, 1.25, [1.0, 2.0, 3.0, 0.25]),
];

const RAMP: [Case; 4] = [
    (0.25, 0.5, [0.0, 0.0, 0.0, 1.0]),
    (0.5, 0.5, [1.0, 1.0, 1.0, 1.0]),
    (0.625, 0.1, [1.5, 1.5, 1.5, 1.0]),
    (7.0, 0.5, [2.0, 2.0, 2.0, 1.0]),
];

/// Values of a texture, with one back end.
fn evaluate(
    scene: &Scene,
    texture: Handle<Texture>,
    backend: Backend,
    points: &[TexturePoint],
) -> dapple::Result<Vec<[f32; 4]>> {
    let mut compiler = Compiler::new(sources()?, cache());
    Evaluator::new(gpu(), &mut compiler, scene, &[texture], backend)?.values(texture, points)
}

fn at_uv(u: f32, v: f32) -> TexturePoint {
    TexturePoint { uv: [u, v], normal: [0.0, 0.0, 1.0], ..TexturePoint::default() }
}

#[test]
fn textures_have_the_values_of_their_texels() {
    let scene = textures();
    let handles: Vec<_> = scene.textures.iter().map(|(handle, ..)| handle).collect();
    for (handle, cases) in handles.into_iter().zip([&COLORS[..], &RAMP[..]]) {
        let case = |i: usize| cases[i % cases.len()];
        let points: Vec<_> = (0..POINTS).map(|i| at_uv(case(i).0, case(i).1)).collect();
        for backend in [Backend::Storage, Backend::Texel] {
            let values = evaluate(&scene, handle, backend, &points).unwrap();
            for (i, value) in values.into_iter().enumerate() {
                let (u, v, expected) = case(i);
                let off = (0..4).map(|c| (value[c] - expected[c]).abs()).fold(0.0, f32::max);
                // A filter rounds a few times.
                assert!(off <= 1e-6, "{backend:?}, point {i} at {u}, {v}: {value:?}, expected {expected:?}");
            }
        }
    }
}

#[test]
fn an_octahedral_picture_goes_on_across_its_edges() {
    // Places at an edge that are one direction: as far from its middle, on both sides. Filtering meets texels of both
    let mut scene = scene(8, 8, 1);
    let texels = (0..36).map(|i| [(i * 7 % 11) as f32, (i * 5 % 13) as f32, i as f32, 1.0]).collect();
    let image = Image { width: 6, height: 6, texels: Texels::RgbaF32(texels) };
    let picture = scene.picture(image, |texture| texture.wrap = [Wrap::Octahedral; 2]);
    let mut points = Vec::new();
    for i in 0..40 {
        let t = (i as f32 + 0.5) / 80.0;
        for edge in [0.0, 1.0] {
            points.extend([at_uv(edge, t), at_uv(edge, 1.0 - t), at_uv(t, edge), at_uv(1.0 - t, edge)]);
        }
    }
    // Half a texel beyond a corner is the middle of the texel in the opposite corner
    points.extend([at_uv(-1.0 / 12.0, -1.0 / 12.0), at_uv(11.0 / 12.0, 11.0 / 12.0)]);
    for backend in [Backend::Storage, Backend::Texel] {
        let values = evaluate(&scene, picture, backend, &points).unwrap();
        for (pair, place) in values.chunks_exact(2).zip(points.chunks_exact(2)) {
            let off = (0..4).map(|c| (pair[0][c] - pair[1][c]).abs()).fold(0.0, f32::max);
            assert!(off < 1e-4, "{:?} and {:?}: {pair:?}", place[0].uv, place[1].uv);
        }
        assert!(values[0] != values[4], "{:?}", values[0]);
    }
}
