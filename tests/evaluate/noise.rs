//! Noise against its definitions, and octaves that a pixel cannot resolve.

use super::trees::{BLACK, WHITE, noise, points, reds, scene_of, space};
use crate::common::twins::noise::{perlin, value_noise};
use dapple::layout::{Backend, TexturePoint};
use dapple::prepare;
use dapple::scene::{
    Coordinates, Noise, NoiseSum, PatternSpace, Perlin, PerlinVariant, Spread, Texture, Value, ValueNoise,
    VeinKind, Veins,
};
use glam::{Affine3A, Vec3};

/// Values, and −1 for 0 and 1 for 1: the sum itself where it is normalised.
fn sums(noise: Noise, points: &[Vec3]) -> Vec<f64> {
    reds(Texture::Noise(noise), points).into_iter().map(|value| 2.0 * value - 1.0).collect()
}

/// Values at points that are `width` wide.
fn reds_of_width(texture: Texture, points: &[Vec3], width: f32) -> Vec<f64> {
    let (scene, handle) = scene_of([texture]);
    let at = |p: &Vec3| TexturePoint {
        position: p.to_array(),
        object_position: p.to_array(),
        uv: [p.x, p.y],
        footprint: width,
        object_footprint: width,
        uv_footprint: [width; 2],
        ..TexturePoint::default()
    };
    let points: Vec<_> = points.iter().map(at).collect();
    let values = super::evaluate(&scene, handle, Backend::Texel, &points).unwrap();
    values.into_iter().map(|value| f64::from(value[0])).collect()
}

fn close(found: &[f64], expected: &[f64], most: f64, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() < most, "{what}, point {i}: {found}, expected {expected}");
    }
}

#[test]
fn every_noise_is_what_its_corners_say() {
    use PerlinVariant::{Classic, Improved, Pbrt};
    for variant in [Improved, Classic, Pbrt] {
        for dimensions in 1..=4 {
            // Improved noise in 3 dimensions is tested against its reference
            if (variant == Pbrt) != (dimensions == 3) && variant != Classic {
                continue;
            }
            let one = Noise {
                perlin: Perlin { variant, dimensions },
                w: [0.3, 0.0],
                ..noise(NoiseSum::Fbm, 1, 0.5, 2.0)
            };
            let (scene, _) = scene_of([Texture::Noise(one.clone())]);
            let table = prepare::prepare(&scene).unwrap().textures;
            let at = points(400, 300.0);
            let expected: Vec<f64> = at
                .iter()
                .map(|p| {
                    let all = [p.x, p.y, p.z, 0.3].map(f64::from);
                    perlin(&table[..256], &all[..dimensions as usize], variant)
                })
                .collect();
            let what = format!("{variant:?}, {dimensions} dimensions");
            close(&sums(one.clone(), &at), &expected, 5e-4, &what);
            // Inside −1 to 1, and making use of it
            let most = expected.iter().fold(0.0_f64, |most, n| most.max(n.abs()));
            assert!(most > 0.35 && most <= 1.0, "{what}: {most}");
            // 0 at the points of the lattice
            let lattice: Vec<Vec3> = at.iter().map(|p| p.floor()).collect();
            let zero = sums(Noise { w: [2.0, 0.0], ..one }, &lattice);
            assert!(zero.iter().all(|n| *n == 0.0), "{what}");
        }
    }
}

#[test]
fn w_moves_with_time() {
    let perlin = Perlin { dimensions: 4, ..Perlin::default() };
    let moving = Noise { perlin, w: [0.25, 0.5], ..noise(NoiseSum::Fbm, 2, 0.5, 2.0) };
    let still = Noise { w: [0.25 + 0.5 * 0.75, 0.0], ..moving.clone() };
    let (scene, handle) = scene_of([Texture::Noise(moving)]);
    let at = points(50, 4.0);
    let point =
        |p: &Vec3| TexturePoint { object_position: p.to_array(), time: 0.75, ..TexturePoint::default() };
    let asked: Vec<_> = at.iter().map(point).collect();
    let found = super::evaluate(&scene, handle, Backend::Texel, &asked).unwrap();
    let found: Vec<f64> = found.into_iter().map(|value| f64::from(value[0])).collect();
    close(&found, &reds(Texture::Noise(still), &at), 1e-6, "time");
}

#[test]
fn value_noise_is_the_lectures() {
    // Its example: length 8, amplitude 3, frequency 7
    for dimensions in 1..=3_u32 {
        let one = ValueNoise {
            dimensions,
            length: 8,
            amplitude: 3.0,
            frequency: 7.0,
            octaves: 3,
            low: Value::Constant(Vec3::splat(-1.0)),
            high: WHITE,
            space: space(Coordinates::Object),
        };
        let at = points(400, 2.0);
        let twin = |p: &Vec3| {
            let all = p.to_array().map(f64::from);
            value_noise(&all[..dimensions as usize], 8, 3.0, 7.0, 3)
        };
        let expected: Vec<f64> = at.iter().map(twin).collect();
        let found = reds(Texture::ValueNoise(one.clone()), &at);
        close(&found, &expected, 1e-3, "value noise");
        assert!(found.iter().any(|n| *n > 1.5) && found.iter().any(|n| *n < -1.5));
        assert!(found.iter().all(|n| n.abs() <= 3.0 * 1.75));
        // The same again after 8 values at 7 in a unit
        let again: Vec<Vec3> = at.iter().map(|p| *p + Vec3::new(8.0 / 7.0, -16.0 / 7.0, 0.0)).collect();
        close(&reds(Texture::ValueNoise(one.clone()), &again), &found, 2e-3, "period");
        // At the points of a lattice there are the values themselves
        let alone = ValueNoise { octaves: 1, frequency: 1.0, ..one };
        let values = reds(Texture::ValueNoise(alone), &[Vec3::new(3.0, 0.0, 0.0), Vec3::new(11.0, 0.0, 0.0)]);
        close(&values, &[value_noise(&[3.0], 8, 3.0, 1.0, 1); 2], 1e-6, "lattice");
    }
}

#[test]
fn sums_may_keep_their_size() {
    let at = points(200, 5.0);
    let low = Value::Constant(Vec3::splat(0.25));
    for (sum, shift) in [(NoiseSum::Fbm, true), (NoiseSum::Turbulence, false), (NoiseSum::Ridged, false)] {
        let whole = noise(sum, 3, 0.5, 2.0);
        let raw = Noise { normalize: false, low, high: WHITE, ..whole.clone() };
        let part = |value: f64| if shift { 2.0 * value - 1.0 } else { value };
        let expected: Vec<f64> =
            reds(Texture::Noise(whole), &at).into_iter().map(|v| 0.25 + 0.75 * 1.75 * part(v)).collect();
        close(&reds(Texture::Noise(raw), &at), &expected, 1e-5, &format!("{sum:?}"));
    }
    // Wind: |F(p / 10)| · F(p)
    let perlin = Perlin { variant: PerlinVariant::Pbrt, dimensions: 3 };
    let raw = |octaves| Noise { perlin, normalize: false, ..noise(NoiseSum::Fbm, octaves, 0.5, 1.99) };
    let tenth: Vec<Vec3> = at.iter().map(|p| *p * 0.1).collect();
    let (strength, height) = (reds(Texture::Noise(raw(3)), &tenth), reds(Texture::Noise(raw(6)), &at));
    let expected: Vec<f64> = strength.iter().zip(&height).map(|(s, h)| s.abs() * h).collect();
    let windy = Noise { perlin, ..noise(NoiseSum::Windy, 6, 0.5, 1.99) };
    close(&reds(Texture::Noise(windy), &at), &expected, 1e-5, "windy");
}

#[test]
fn ridges_are_where_noise_changes_its_sign() {
    let at = points(300, 5.0);
    let n = sums(noise(NoiseSum::Fbm, 1, 0.5, 2.0), &at);
    let expected: Vec<f64> = n.iter().map(|n| (1.0 - n.abs()).powi(2)).collect();
    close(&reds(Texture::Noise(noise(NoiseSum::Ridged, 1, 0.5, 2.0)), &at), &expected, 1e-5, "ridged");
    // What octaves fade to is the mean
    let many = points(20_000, 200.0);
    for (sum, mean, most) in [(NoiseSum::Ridged, 0.63, 0.01), (NoiseSum::Turbulence, 0.2, 0.03)] {
        let values = reds(Texture::Noise(noise(sum, 1, 0.5, 2.0)), &many);
        let found = values.iter().sum::<f64>() / values.len() as f64;
        assert!((found - mean).abs() < most, "{sum:?}: {found}");
    }
}

/// What is left of octave i for a width, as pbrt has it.
fn weight(width: f64, lacunarity: f64, i: i32) -> f64 {
    let resolved = -1.0 - (width * lacunarity.powi(i)).log2();
    let t = ((resolved - 0.3) / 0.4).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[test]
fn octaves_fade_with_the_width_of_the_pixel() {
    let at = points(200, 5.0);
    let octave = |i: i32| {
        let scaled: Vec<Vec3> = at.iter().map(|p| *p * 2.0_f32.powi(i)).collect();
        sums(noise(NoiseSum::Fbm, 1, 0.5, 2.0), &scaled)
    };
    let octaves: Vec<Vec<f64>> = (0..5).map(octave).collect();
    let whole: f64 = (0..5).map(|i| 0.5_f64.powi(i)).sum();
    for width in [0.0_f32, 0.01, 0.05, 0.11, 0.24, 0.35, 0.6, 30.0] {
        for (sum, mean) in [(NoiseSum::Fbm, 0.0), (NoiseSum::Turbulence, 0.2), (NoiseSum::Ridged, 0.63)] {
            let term = |n: f64| match sum {
                NoiseSum::Fbm => n,
                NoiseSum::Turbulence => n.abs(),
                _ => (1.0 - n.abs()).powi(2),
            };
            let found = reds_of_width(Texture::Noise(noise(sum, 5, 0.5, 2.0)), &at, width);
            let expected: Vec<f64> = (0..at.len())
                .map(|p| {
                    let one = |i: i32| {
                        let left = weight(f64::from(width).max(1e-30), 2.0, i);
                        0.5_f64.powi(i) * (left * term(octaves[i as usize][p]) + (1.0 - left) * mean)
                    };
                    let s = (0..5).map(one).sum::<f64>() / whole;
                    if sum == NoiseSum::Fbm { 0.5 + 0.5 * s } else { s }
                })
                .collect();
            close(&found, &expected, 2e-5, &format!("{sum:?}, width {width}"));
        }
    }
    // A point has every octave to the bit, and so has a pattern that is not filtered
    let fbm = |filter_width| Noise {
        space: PatternSpace { filter_width, ..space(Coordinates::Object) },
        ..noise(NoiseSum::Fbm, 5, 0.5, 2.0)
    };
    let sharp = reds(Texture::Noise(fbm(0.0)), &at);
    assert_eq!(reds_of_width(Texture::Noise(fbm(0.0)), &at, 0.3), sharp);
    assert_eq!(reds(Texture::Noise(fbm(1.0)), &at), sharp);
    // The width is that in the pattern: here a pixel is four times as wide
    let small =
        PatternSpace { pattern_from_space: Affine3A::from_scale(Vec3::splat(4.0)), ..space(Coordinates::Uv) };
    let near: Vec<Vec3> = at.iter().map(|p| Vec3::new(p.x, p.y, 0.0) * 0.25).collect();
    let flat: Vec<Vec3> = at.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect();
    let scaled = Noise { space: small, ..fbm(1.0) };
    let expected = reds_of_width(Texture::Noise(fbm(1.0)), &flat, 0.2);
    close(&reds_of_width(Texture::Noise(scaled), &near, 0.05), &expected, 1e-5, "scaled");
    // Value noise fades to the middle
    let value = |width| {
        let lattice = ValueNoise {
            dimensions: 2,
            length: 64,
            amplitude: 1.0,
            frequency: 4.0,
            octaves: 3,
            low: BLACK,
            high: WHITE,
            space: space(Coordinates::Uv),
        };
        reds_of_width(Texture::ValueNoise(lattice), &at, width)
    };
    assert!(value(0.2).iter().all(|v| *v == 0.5) && value(0.01).iter().any(|v| (*v - 0.5).abs() > 0.2));
}

#[test]
fn marble_is_a_wave_that_noise_bends() {
    let at = points(300, 8.0);
    let ramp = Spread::Stops(vec![(0.0, Vec3::ZERO), (1.0, Vec3::ONE)]);
    let marble = |colors| {
        Texture::Veins(Veins {
            kind: VeinKind::Marble,
            octaves: 4,
            gain: 0.6,
            lacunarity: 1.99,
            variation: 0.4,
            colors,
            space: space(Coordinates::Object),
        })
    };
    let perlin = Perlin { variant: PerlinVariant::Pbrt, dimensions: 3 };
    let fbm = Noise { perlin, normalize: false, ..noise(NoiseSum::Fbm, 4, 0.6, 1.99) };
    let fbm = reds(Texture::Noise(fbm), &at);
    let place = |(p, n): (&Vec3, &f64)| 0.5 + 0.5 * (f64::from(p.y) + 0.4 * n).sin();
    let expected: Vec<f64> = at.iter().zip(&fbm).map(place).collect();
    close(&reds(marble(ramp), &at), &expected, 1e-5, "marble");
    // Uniform Bézier segments over 0, 1, 0, 0, 1: two, which overlap
    let colors = [0.0, 1.0, 0.0, 0.0, 1.0];
    let spline: Vec<f64> = expected
        .iter()
        .map(|t| {
            let i = (2.0 * t).floor().min(1.0);
            let (t, c) = (2.0 * t - i, &colors[i as usize..]);
            let s = 1.0 - t;
            s * s * s * c[0] + 3.0 * s * s * t * c[1] + 3.0 * s * t * t * c[2] + t * t * t * c[3]
        })
        .collect();
    let colors = Spread::Spline(colors.map(|c| Vec3::splat(c as f32)).to_vec());
    close(&reds(marble(colors), &at), &spline, 2e-5, "spline");
    // A pixel that is wider than the wave sees its middle
    let ramp = Spread::Stops(vec![(0.0, Vec3::ZERO), (1.0, Vec3::ONE)]);
    assert!(reds_of_width(marble(ramp), &at, 6.0).iter().all(|v| *v == 0.5));
}
