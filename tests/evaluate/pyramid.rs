//! Trilinear filtering: pictures with a pyramid of levels.

use super::evaluate;
use crate::common::random::Random;
use crate::common::render::{Build as _, scene};
use dapple::layout::{Backend, TexturePoint};
use dapple::scene::{
    Channel, ColorSpace, Handle, Image, ImageTexture, Scene, TexelFilter, Texels, Texture, UvTransform, Wrap,
};
use glam::Vec2;

fn picture(scene: &mut Scene, image: Image, change: impl FnOnce(&mut ImageTexture)) -> Handle<Texture> {
    scene.picture(image, |texture| {
        texture.filter = TexelFilter::Trilinear;
        change(texture);
    })
}

fn point(uv: Vec2, footprint: f32) -> TexturePoint {
    TexturePoint { uv: uv.to_array(), uv_footprint: [footprint; 2], ..TexturePoint::default() }
}

/// Values with both back ends, which must be equal to the bit.
fn values(scene: &Scene, handle: Handle<Texture>, points: &[TexturePoint]) -> Vec<[f32; 4]> {
    let [storage, texel] =
        [Backend::Storage, Backend::Texel].map(|backend| evaluate(scene, handle, backend, points).unwrap());
    assert!(storage == texel);
    storage
}

fn places(count: usize, size: f32, seed: u64) -> Vec<Vec2> {
    let mut random = Random(seed);
    (0..count)
        .map(|_| {
            let [x, y, _] = random.cube(size);
            Vec2::new(x, y)
        })
        .collect()
}

fn grey(width: u32, height: u32, value: impl Fn(u32, u32) -> f32) -> Image {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = texels.map(|(x, y)| [value(x, y), value(x, y), value(x, y), 1.0]).collect();
    Image { width, height, texels: Texels::RgbaF32(texels) }
}

/// Mean and variance of red.
fn moments(values: &[[f32; 4]]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().map(|value| f64::from(value[0])).sum::<f64>() / n;
    [mean, values.iter().map(|value| (f64::from(value[0]) - mean).powi(2)).sum::<f64>() / n]
}

/// Footprints from none to far more than the picture.
const FOOTPRINTS: [f32; 8] = [0.0, 1e-4, 0.01, 0.07, 0.2, 0.5, 1.0, 50.0];

#[test]
fn a_pixel_without_a_width_sees_what_bilinear_filtering_gives() {
    let mut random = Random(3);
    let floats: Vec<[f32; 4]> = (0..7 * 5).map(|_| [0.0; 4].map(|_: f32| random.between(0.0, 9.0))).collect();
    let halves = floats.iter().map(|texel| texel.map(half)).collect();
    let bytes = floats.iter().map(|texel| texel.map(|x| (x * 28.0) as u8)).collect::<Vec<_>>();
    let formats = [
        (Texels::RgbaF32(floats), ColorSpace::Linear),
        (Texels::RgbaF32(halves), ColorSpace::Linear),
        (Texels::Rgba8(bytes.clone()), ColorSpace::Linear),
        (Texels::Rgba8(bytes), ColorSpace::Srgb),
    ];
    let points: Vec<_> = places(200, 3.0, 8).into_iter().map(|uv| point(uv, 0.0)).collect();
    for (texels, space) in formats {
        let of = |filter| {
            let mut scene = scene(8, 8, 1);
            let image = Image { width: 7, height: 5, texels: texels.clone() };
            let handle = picture(&mut scene, image, |texture| {
                (texture.filter, texture.color_space) = (filter, space);
                texture.wrap = [Wrap::Mirror, Wrap::Black];
            });
            values(&scene, handle, &points)
        };
        assert!(of(TexelFilter::Trilinear) == of(TexelFilter::Bilinear), "{space:?}");
    }
}

/// A number that a half holds exactly.
fn half(x: f32) -> f32 {
    (x * 64.0).floor() / 64.0
}

#[test]
fn levels_are_means_of_the_picture() {
    // 4 x 4: a texel of level 1 is the mean of four, that of level 2 the mean of all
    let at = |x: u32, y: u32| ((x * 5 + y * 11) % 16) as f32 / 16.0;
    let mean = |x: u32, y: u32, n: u32| {
        let all = (0..n * n).map(|i| at(x * n + i % n, y * n + i / n)).sum::<f32>();
        all / (n * n) as f32
    };
    let mut scene = scene(8, 8, 1);
    let handle = picture(&mut scene, grey(4, 4, at), |_| {});
    let centre = |x: u32, n: u32| (x as f32 + 0.5) * n as f32 / 4.0;
    let uv = |x: u32, y: u32, n: u32| Vec2::new(centre(x, n), 1.0 - centre(y, n));
    let points = [
        point(uv(1, 2, 1), 0.25),
        point(uv(1, 0, 2), 0.5),
        point(uv(0, 1, 2), 0.5),
        point(uv(0, 0, 4), 1.0),
        point(uv(0, 0, 4), 1e6),
        // Half way between two levels, where the width is the geometric mean of theirs
        point(uv(0, 0, 4), 2.0_f32.sqrt() / 2.0),
    ];
    let level1 = (0..4).map(|i| mean(i % 2, i / 2, 2)).sum::<f32>() / 4.0;
    let expected = [
        at(1, 2),
        mean(1, 0, 2),
        mean(0, 1, 2),
        mean(0, 0, 4),
        mean(0, 0, 4),
        0.5 * (level1 + mean(0, 0, 4)),
    ];
    for (found, expected) in values(&scene, handle, &points).into_iter().zip(expected) {
        assert!((found[0] - expected).abs() < 2e-4, "{}, expected {expected}", found[0]);
    }
    // The scale of uv counts: twice as many texels in a pixel
    let twice = picture(&mut scene, grey(4, 4, at), |texture| {
        texture.uv = UvTransform { scale: Vec2::splat(2.0), rotate: 90.0, offset: Vec2::ZERO };
    });
    let found = values(&scene, twice, &[point(Vec2::new(0.3, 0.4), 0.5)])[0][0];
    assert!((found - mean(0, 0, 4)).abs() < 2e-4, "{found}");
}

#[test]
fn neighbours_in_the_atlas_do_not_bleed() {
    // Black and white of many sizes side by side, read as they are and through every level
    let mut scene = scene(8, 8, 1);
    let sizes = [[1, 1], [2, 2], [3, 5], [16, 16], [7, 2], [33, 17], [1, 40], [64, 64], [5, 1]];
    let mut handles = Vec::new();
    for (k, [width, height]) in sizes.into_iter().cycle().take(27).enumerate() {
        let value = if k % 2 == 0 { 255 } else { 0 };
        let texels = match k % 3 {
            0 => Texels::RgbaF32(vec![[f32::from(value) / 255.0; 4]; (width * height) as usize]),
            1 => Texels::RgbaF32(vec![[f32::from(value) * 1000.1; 4]; (width * height) as usize]),
            _ => Texels::Rgba8(vec![[value; 4]; (width * height) as usize]),
        };
        let handle = picture(&mut scene, Image { width, height, texels }, |texture| {
            texture.wrap = [[Wrap::Repeat; 2], [Wrap::Clamp; 2], [Wrap::Mirror; 2]][k / 9];
        });
        let peak = if k % 3 == 1 { 255.0 * 1000.1 } else { 1.0 };
        handles.push((handle, if value == 0 { 0.0 } else { peak }));
    }
    let points: Vec<_> = places(6, 2.0, 4)
        .into_iter()
        .flat_map(|uv| FOOTPRINTS.map(|footprint| point(uv, footprint)))
        .collect();
    for (handle, expected) in handles {
        for value in values(&scene, handle, &points) {
            assert!((value[0] - expected).abs() <= 3e-7 * expected, "{}, expected {expected}", value[0]);
        }
    }
}

#[test]
fn a_distant_checker_is_grey() {
    let mut scene = scene(8, 8, 1);
    let bytes = (0..64 * 64).map(|i| [if (i + i / 64) % 2 == 0 { 255 } else { 0 }; 4]).collect();
    let image = Image { width: 64, height: 64, texels: Texels::Rgba8(bytes) };
    let trilinear = picture(&mut scene, image.clone(), |texture| texture.channel = Channel::G);
    let bilinear = picture(&mut scene, image, |texture| texture.filter = TexelFilter::Bilinear);
    let far: Vec<_> = places(500, 5.0, 6).into_iter().map(|uv| point(uv, 0.1)).collect();
    let [mean, variance] = moments(&values(&scene, trilinear, &far));
    assert!((mean - 0.5).abs() < 1e-3 && variance < 1e-6, "{mean} ± {variance}");
    // What filtering is good for: without it the same points scatter
    let [mean, variance] = moments(&values(&scene, bilinear, &far));
    assert!((mean - 0.5).abs() < 0.05 && variance > 0.01, "{mean} ± {variance}");
}

#[test]
fn the_mean_of_a_picture_is_that_of_its_levels() {
    let mut random = Random(12);
    let bytes: Vec<[u8; 4]> = (0..23 * 14).map(|_| [0; 4].map(|_: u8| (random.f32() * 40.0) as u8)).collect();
    let linear = |c: u8| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    let expected = bytes.iter().map(|texel| linear(texel[0])).sum::<f64>() / bytes.len() as f64;
    let mut scene = scene(8, 8, 1);
    let image = Image { width: 23, height: 14, texels: Texels::Rgba8(bytes) };
    let handle = picture(&mut scene, image, |texture| texture.color_space = ColorSpace::Srgb);
    // Bilinear look-ups over whole periods of each level have the mean of its texels. 8 bits would be off by up to 3 %
    // in the dark: half a step; halves are good to 2⁻¹¹.
    for level in 0..6 {
        let footprint = 2.0_f32.powi(level) / 23.0;
        let grid = 64;
        let at = |i: u32| Vec2::new((i % grid) as f32 + 0.5, (i / grid) as f32 + 0.5) / grid as f32;
        let points: Vec<_> = (0..grid * grid).map(|i| point(at(i), footprint)).collect();
        let [mean, _] = moments(&values(&scene, handle, &points));
        // 64 places in 23 columns sample the look-up unevenly: off by 0.4 % on the picture itself
        let allowed = [0.01, 0.005, 0.003, 0.002, 0.001, 5e-4][level as usize];
        assert!((mean / expected - 1.0).abs() < allowed, "level {level}: {mean}, expected {expected}");
    }
}
