//! Noise that is finer than a pixel: one sample through the middle of each pixel, of a wall that is near or far.

use crate::common::render::*;
use crate::common::twins::noise::perlin;
use dapple::prepare;
use dapple::scene::*;
use glam::Vec3;

const SIDE: u32 = 24;
const OCTAVES: i32 = 5;

/// An unlit wall of fbm in two dimensions, `pixel` wide in each pixel.
fn wall(pixel: f32, filter_width: f32) -> Scene {
    let mut s = scene(SIDE, SIDE, 1);
    s.render.sampler = Sampler::Center;
    s.camera.projection = Projection::pinhole(4.0);
    let distance = pixel * SIDE as f32 / (2.0 * 2.0_f32.to_radians().tan());
    let noise = Noise {
        perlin: Perlin { dimensions: 2, ..Perlin::default() },
        sum: NoiseSum::Fbm,
        octaves: OCTAVES as u32,
        gain: 0.5,
        lacunarity: 2.0,
        normalize: true,
        w: [0.0; 2],
        low: grey(0.0),
        high: grey(1.0),
        space: PatternSpace { filter_width, ..PatternSpace::new(Coordinates::World) },
    };
    let texture = s.textures.add("noise", Texture::Noise(noise));
    let m = s.unlit(Value::Texture(texture));
    let half = pixel * SIDE as f32;
    s.quad(Vec3::new(-half, -half, -distance), Vec3::X * 2.0 * half, Vec3::Y * 2.0 * half, m);
    s
}

/// What is left of octave i of a pixel (pbrt, `FBm`).
fn weight(width: f64, i: i32) -> f64 {
    let t = ((-1.0 - width.log2() - f64::from(i) - 0.3) / 0.4).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Mean of squared differences to the middle, of the picture and of the sums with weights for a width.
fn variances(pixel: f32, filter_width: f32, weighted: impl Fn(i32) -> f64) -> (f64, f64) {
    let s = wall(pixel, filter_width);
    let picture = render(&s);
    let table = prepare::prepare(&s).unwrap().textures;
    let whole: f64 = (0..OCTAVES).map(|i| 0.5_f64.powi(i)).sum();
    let (mut found, mut expected) = (0.0, 0.0);
    for y in 0..SIDE {
        for x in 0..SIDE {
            let at = |i: u32| f64::from(pixel) * (f64::from(i) + 0.5 - 0.5 * f64::from(SIDE));
            let octave = |i: i32| {
                let f = 2.0_f64.powi(i);
                0.5_f64.powi(i)
                    * weighted(i)
                    * perlin(&table[..256], &[f * at(x), -f * at(y)], PerlinVariant::Improved)
            };
            let value = 0.5 + 0.5 * (0..OCTAVES).map(octave).sum::<f64>() / whole;
            let pixel = f64::from(picture.rgb[(y * SIDE + x) as usize][0]);
            assert!((pixel - value).abs() < 4e-3, "{x}, {y}: {pixel}, expected {value}");
            found += (pixel - 0.5).powi(2);
            expected += (value - 0.5).powi(2);
        }
    }
    let count = f64::from(SIDE * SIDE);
    (found / count, expected / count)
}

#[test]
fn far_noise_fades_and_near_noise_does_not() {
    // Near: the width of a pixel resolves every octave
    let near = variances(0.005, 1.0, |_| 1.0);
    assert!(near.0 > 1e-3);
    // In between: some octaves are left
    let between = variances(0.06, 1.0, |i| weight(0.06, i));
    assert!(between.0 > 2e-3 && (between.0 / between.1 - 1.0).abs() < 0.02, "{between:?}");
    // Far: nothing is left, where without the filter each pixel hits another grain
    let far = variances(3.7, 1.0, |i| weight(3.7, i));
    let aliased = variances(3.7, 0.0, |_| 1.0);
    assert!(far.0 < 1e-9 && aliased.0 > 5e-3, "{far:?}, {aliased:?}");
}
