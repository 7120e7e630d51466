//! Volumes from slices.

use super::evaluate;
use super::trees::points;
use crate::common::random::Random;
use crate::common::render::scene;
use crate::common::twins::texture::wrapped;
use dapple::layout::{Backend, TexturePoint};
use dapple::scene::{
    Channel, ColorSpace, Coordinates, Handle, Image, PatternSpace, Scene, StackTexture, Texels, Texture, Wrap,
};
use glam::Vec3;

/// A volume whose texels have the values of a function of column, row from the bottom, and slice.
fn volume(
    size: [u32; 3],
    value: impl Fn(u32, u32, u32) -> [f32; 4],
    change: impl FnOnce(&mut StackTexture),
) -> (Scene, Handle<Texture>) {
    let mut scene = scene(8, 8, 1);
    let [width, height, depth] = size;
    let slice = |z| {
        let rows = (0..height).rev().flat_map(|y| (0..width).map(move |x| (x, y)));
        let texels = Texels::RgbaF32(rows.map(|(x, y)| value(x, y, z)).collect());
        Image { width, height, texels }
    };
    let slices = (0..depth).map(|z| scene.images.add("slice", slice(z))).collect();
    let mut stack = StackTexture {
        slices,
        smooth: true,
        wrap: [Wrap::Clamp; 3],
        space: PatternSpace::new(Coordinates::Object),
        color_space: ColorSpace::Linear,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    };
    change(&mut stack);
    let handle = scene.textures.add("stack", Texture::Stack(stack));
    (scene, handle)
}

fn values(scene: &Scene, handle: Handle<Texture>, points: &[Vec3]) -> Vec<[f32; 4]> {
    let at = |p: &Vec3| TexturePoint { object_position: p.to_array(), ..TexturePoint::default() };
    let points: Vec<_> = points.iter().map(at).collect();
    let [storage, texel] =
        [Backend::Storage, Backend::Texel].map(|backend| evaluate(scene, handle, backend, &points).unwrap());
    assert!(storage == texel);
    storage
}

#[test]
fn a_ramp_is_exact_between_the_centres_of_texels() {
    let size = [5, 4, 3];
    let at = |i: u32, n: u32| (i as f32 + 0.5) / n as f32;
    let (scene, handle) =
        volume(size, |x, y, z| [at(x, size[0]), at(y, size[1]), at(z, size[2]), 0.25], |_| {});
    let inside: Vec<Vec3> = points(300, 0.5).into_iter().map(|p| 0.5 + p * (2.0 / 3.0)).collect();
    for (p, found) in inside.iter().zip(values(&scene, handle, &inside)) {
        let off = (Vec3::from_slice(&found) - *p).abs().max_element();
        assert!(off < 1e-6 && found[3] == 0.25, "{p}: {found:?}");
    }
    // Beyond the centres at the edges the value stays
    let found = values(&scene, handle, &[Vec3::new(-3.0, 0.5, 7.0)])[0];
    assert!((found[0] - 0.1).abs() < 1e-6 && (found[2] - 2.5 / 3.0).abs() < 1e-6, "{found:?}");
}

#[test]
fn values_are_what_the_definition_says_on_every_axis() {
    let size = [3_u32, 5, 4];
    let mut random = Random(17);
    let texels: Vec<[f32; 4]> = (0..60).map(|_| [0.0; 4].map(|_: f32| random.between(0.0, 1.0))).collect();
    let index = |x: usize, y: usize, z: usize| (z * 5 + y) * 3 + x;
    let wraps = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Black];
    let places = points(200, 1.7);
    for (k, smooth) in [(0, true), (1, true), (2, true), (3, true), (0, false), (1, false)] {
        let wrap = [wraps[k], wraps[(k + 1) % 4], wraps[(k + 2) % 4]];
        let (scene, handle) = volume(
            size,
            |x, y, z| texels[index(x as usize, y as usize, z as usize)],
            |stack| (stack.smooth, stack.wrap) = (smooth, wrap),
        );
        let texel = |at: [i64; 3]| {
            let inside = [0, 1, 2].map(|c| wrapped(at[c], i64::from(size[c]), wrap[c]));
            match inside {
                [Some(x), Some(y), Some(z)] => texels[index(x, y, z)].map(f64::from),
                _ => [0.0; 4],
            }
        };
        for (p, found) in places.iter().zip(values(&scene, handle, &places)) {
            let place =
                [0, 1, 2].map(|c| f64::from(p[c]) * f64::from(size[c]) - if smooth { 0.5 } else { 0.0 });
            let corner = place.map(|x| x.floor() as i64);
            let mut expected = [0.0; 4];
            for i in 0..8_i64 {
                let step = [i & 1, i >> 1 & 1, i >> 2];
                let weight: f64 = (0..3)
                    .map(|c| match (smooth, step[c]) {
                        (true, 0) => 1.0 - (place[c] - place[c].floor()),
                        (true, _) => place[c] - place[c].floor(),
                        (false, 0) => 1.0,
                        (false, _) => 0.0,
                    })
                    .product();
                let value = texel([corner[0] + step[0], corner[1] + step[1], corner[2] + step[2]]);
                (0..4).for_each(|c| expected[c] += weight * value[c]);
            }
            for c in 0..4 {
                assert!(
                    (f64::from(found[c]) - expected[c]).abs() < 4e-6,
                    "{wrap:?} {p}: {found:?}, {expected:?}"
                );
            }
        }
    }
}

#[test]
fn every_format_of_slices_is_read() {
    // Odd sizes, so that blocks of texels are not full
    let mut scene = scene(8, 8, 1);
    let bytes = |z: u8| Texels::Rgba8((0..15).map(|i| [i * 3 + z, i * 5, 255 - i, z * 9]).collect());
    let halves =
        |z: u8| Texels::RgbaF32((0..15_u8).map(|i| [f32::from(i) * 4.0 + f32::from(z); 4]).collect());
    let mixed = |z: u8| if z == 0 { bytes(z) } else { halves(z) };
    for texels in [&bytes as &dyn Fn(u8) -> Texels, &halves, &mixed] {
        let slices =
            (0..4).map(|z| scene.images.add("slice", Image { width: 3, height: 5, texels: texels(z) }));
        let stack = StackTexture {
            slices: slices.collect(),
            smooth: false,
            wrap: [Wrap::Repeat; 3],
            space: PatternSpace::new(Coordinates::Object),
            color_space: ColorSpace::Linear,
            channel: Channel::Rgb,
            scale: 1.0,
            invert: false,
        };
        let handle = scene.textures.add("stack", Texture::Stack(stack));
        let places: Vec<_> = (0..60_u32).map(|i| (i % 3, i / 3 % 5, i / 15)).collect();
        let at = |&(x, y, z): &(u32, u32, u32)| {
            (Vec3::new(x as f32, y as f32, z as f32) + 0.5) / Vec3::new(3.0, 5.0, 4.0)
        };
        let found = values(&scene, handle, &places.iter().map(at).collect::<Vec<_>>());
        for (&(x, y, z), found) in places.iter().zip(found) {
            let i = ((4 - y) * 3 + x) as usize;
            let expected = match texels(z as u8) {
                Texels::Rgba8(texels) => texels[i].map(|c| f32::from(c) / 255.0),
                Texels::RgbaF32(texels) => texels[i],
                Texels::Rgba16(_) => unreachable!(),
            };
            for c in 0..4 {
                assert!((found[c] - expected[c]).abs() <= 1e-7, "{x} {y} {z}: {found:?}, {expected:?}");
            }
        }
    }
}
