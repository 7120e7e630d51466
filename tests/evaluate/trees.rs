//! Patterns, noise and what joins them.

use crate::common::random::Random;
use crate::common::render::scene;
use crate::common::twins::noise::pcg3d;
use dapple::layout::{Backend, TexturePoint};
use dapple::prepare;
use dapple::scene::{
    Coordinates, Gradient, Handle, Metric, Noise, NoiseSum, PatternSpace, Perlin, Scene, Texture, Value,
    WorleyFeature,
};
use glam::{Affine3A, Vec3};

pub const WHITE: Value<Vec3> = Value::Constant(Vec3::ONE);
pub const BLACK: Value<Vec3> = Value::Constant(Vec3::ZERO);

pub fn space(coordinates: Coordinates) -> PatternSpace {
    PatternSpace::new(coordinates)
}

pub fn noise(sum: NoiseSum, octaves: u32, gain: f32, lacunarity: f32) -> Noise {
    Noise {
        perlin: Perlin::default(),
        sum,
        octaves,
        gain,
        lacunarity,
        normalize: true,
        w: [0.0; 2],
        low: BLACK,
        high: WHITE,
        space: space(Coordinates::Object),
    }
}

/// A scene of textures, and the handle of the last.
pub fn scene_of(textures: impl IntoIterator<Item = Texture>) -> (Scene, Handle<Texture>) {
    let mut scene = scene(8, 8, 1);
    let mut last = None;
    for texture in textures {
        last = Some(scene.textures.add("texture", texture));
    }
    (scene, last.unwrap())
}

/// Values of a texture at points in space, whose uv is their x and y, with both back ends.
pub fn values(scene: &Scene, handle: Handle<Texture>, points: &[Vec3]) -> Vec<[f64; 4]> {
    let at = |p: &Vec3| TexturePoint {
        position: p.to_array(),
        object_position: p.to_array(),
        uv: [p.x, p.y],
        ..TexturePoint::default()
    };
    let points: Vec<_> = points.iter().map(at).collect();
    let [storage, texel] = [Backend::Storage, Backend::Texel]
        .map(|backend| super::evaluate(scene, handle, backend, &points).unwrap());
    assert!(storage == texel);
    storage.into_iter().map(|value| value.map(f64::from)).collect()
}

pub fn reds(texture: Texture, points: &[Vec3]) -> Vec<f64> {
    let (scene, handle) = scene_of([texture]);
    values(&scene, handle, points).into_iter().map(|value| value[0]).collect()
}

pub fn points(count: usize, size: f32) -> Vec<Vec3> {
    let mut random = Random(5);
    (0..count).map(|_| Vec3::from_array(random.cube(size))).collect()
}

#[test]
fn checkers_change_at_whole_numbers() {
    let checker = |space| Texture::Checker { dimensions: 3, even: WHITE, odd: BLACK, space };
    let cases = [
        (Vec3::new(0.5, 0.5, 0.5), 1.0, 1.0),
        (Vec3::new(1.5, 0.5, 0.5), 0.0, 0.0),
        (Vec3::new(-0.5, 0.5, 0.5), 0.0, 0.0),
        (Vec3::new(-0.5, -0.5, 0.5), 1.0, 1.0),
        (Vec3::new(1.5, 1.5, 1.5), 0.0, 1.0),
        (Vec3::new(0.0, 0.0, 0.0), 1.0, 1.0),
        (Vec3::new(1e9, 0.5, 0.5), 1.0, 1.0),
        (Vec3::new(7.5, -3.5, 2.5), 0.0, 0.0),
    ];
    // 7 + (−4) + 2 is odd, and so is 7 + (−4)
    let at: Vec<Vec3> = cases.iter().map(|case| case.0).collect();
    assert_eq!(reds(checker(space(Coordinates::Object)), &at), cases.map(|case| case.1));
    assert_eq!(reds(checker(space(Coordinates::Uv)), &at), cases.map(|case| case.2));
    // Cells of half the size, moved by a quarter along x
    let map = Affine3A::from_translation(Vec3::X * 0.25) * Affine3A::from_scale(Vec3::splat(0.5));
    let small = PatternSpace { pattern_from_space: map.inverse(), ..space(Coordinates::World) };
    let at = [0.3, 0.7, 0.8, 0.2].map(|x| Vec3::new(x, 0.1, 0.1));
    assert_eq!(reds(checker(small), &at), [1.0, 1.0, 0.0, 0.0]);
}

#[test]
fn noise_is_perlins() {
    let one = || Texture::Noise(noise(NoiseSum::Fbm, 1, 0.5, 2.0));
    // What the reference implementation of 2002 gives
    let known = reds(one(), &[Vec3::new(314.0 / 100.0, 42.0, 7.0)])[0];
    assert!((known - (0.5 + 0.5 * 0.136_919_958_784)).abs() < 1e-6, "{known}");
    // 0 at the points of the lattice, whatever their sign and size
    let lattice: Vec<Vec3> = points(200, 300.0).into_iter().map(|p| p.floor()).collect();
    assert!(reds(one(), &lattice).iter().all(|value| *value == 0.5));
    // The same again after 256 cells
    let here: Vec<Vec3> = points(500, 8.0).into_iter().map(|p| (p * 64.0).floor() / 64.0).collect();
    let there: Vec<Vec3> = here.iter().map(|p| *p + Vec3::new(256.0, -512.0, 256.0)).collect();
    let (a, b) = (reds(one(), &here), reds(one(), &there));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-6));
    // Continuous across the sides of cells, and of mean 0
    let sides: Vec<Vec3> = points(300, 9.0).into_iter().map(|p| Vec3::new(p.x.floor(), p.y, p.z)).collect();
    let before: Vec<Vec3> = sides.iter().map(|p| *p - Vec3::X * 1e-4).collect();
    let (a, b) = (reds(one(), &sides), reds(one(), &before));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 3e-4));
    let many = reds(one(), &points(20_000, 100.0));
    let mean = many.iter().sum::<f64>() / many.len() as f64;
    assert!((mean - 0.5).abs() < 0.005, "{mean}");
    assert!(many.iter().any(|value| *value > 0.8) && many.iter().any(|value| *value < 0.2));
}

#[test]
fn octaves_add_up() {
    let (gain, lacunarity) = (0.6_f32, 2.5_f32);
    let at = points(300, 4.0);
    let octave = |i: i32| {
        let scaled: Vec<Vec3> = at.iter().map(|p| *p * lacunarity.powi(i)).collect();
        let values = reds(Texture::Noise(noise(NoiseSum::Fbm, 1, 0.5, 2.0)), &scaled);
        values.into_iter().map(|value| 2.0 * value - 1.0).collect::<Vec<f64>>()
    };
    let octaves: Vec<Vec<f64>> = (0..3).map(octave).collect();
    let amplitude = |i: usize| f64::from(gain).powi(i as i32);
    let whole: f64 = (0..3).map(amplitude).sum();
    for (sum, creased) in [(NoiseSum::Fbm, false), (NoiseSum::Turbulence, true)] {
        let found = reds(Texture::Noise(noise(sum, 3, gain, lacunarity)), &at);
        for (i, found) in found.into_iter().enumerate() {
            let of = |n: f64| if creased { n.abs() } else { n };
            let sum = (0..3).map(|k| amplitude(k) * of(octaves[k][i])).sum::<f64>() / whole;
            let expected = if creased { sum } else { 0.5 + 0.5 * sum };
            assert!((found - expected).abs() < 1e-5, "{creased}: {found}, expected {expected}");
        }
    }
}

#[test]
fn trees_join_their_inputs() {
    let checker = Texture::Checker {
        dimensions: 3,
        even: Value::Constant(Vec3::new(0.2, 0.4, 0.6)),
        odd: Value::Constant(Vec3::new(1.0, 0.5, 0.25)),
        space: space(Coordinates::Object),
    };
    let at = [Vec3::splat(0.5), Vec3::new(1.5, 0.5, 0.5)];
    let (even, odd) = (Vec3::new(0.2, 0.4, 0.6), Vec3::new(1.0, 0.5, 0.25));
    let red = Value::Constant(Vec3::new(0.5, 0.0, 1.0));
    let expect = |make: &dyn Fn(Value<Vec3>) -> Texture, of: &dyn Fn(Vec3) -> Vec3| {
        let (mut scene, checker) = scene_of([checker.clone()]);
        let handle = scene.textures.add("tree", make(Value::Texture(checker)));
        let found = values(&scene, handle, &at);
        for (found, color) in found.into_iter().zip([even, odd]) {
            let found = Vec3::new(found[0] as f32, found[1] as f32, found[2] as f32);
            assert!((found - of(color)).abs().max_element() < 1e-6, "{found}, expected {}", of(color));
        }
    };
    let b = Vec3::new(0.5, 0.0, 1.0);
    expect(&|a| Texture::Add { a, b: red }, &|a| a + b);
    expect(&|a| Texture::Multiply { a, b: red }, &|a| a * b);
    expect(&|value| Texture::Invert { value }, &|a| 1.0 - a);
    expect(&|a| Texture::Mix { a, b: red, amount: Value::Constant(0.25) }, &|a| a.lerp(b, 0.25));
    // A colour where a number is wanted is its mean
    expect(
        &|value| Texture::Mix {
            a: BLACK,
            b: WHITE,
            amount: match value {
                Value::Texture(handle) => Value::Texture(handle),
                Value::Constant(_) => Value::Constant(0.0),
            },
        },
        &|a| Vec3::splat(a.element_sum() / 3.0),
    );
}

#[test]
fn gradients_measure_distances() {
    let at = [Vec3::new(0.3, 0.4, 0.5), Vec3::new(-1.0, 0.0, 0.25), Vec3::new(2.0, 0.0, 0.0)];
    for (shape, expected) in [
        (Gradient::Linear, [0.3, 0.0, 1.0]),
        (Gradient::Cylindrical, [0.5, 1.0, 1.0]),
        (Gradient::Spherical, [0.5_f64.sqrt(), 1.0, 1.0]),
    ] {
        let space = space(Coordinates::Object);
        let found = reds(Texture::Gradient { shape, low: BLACK, high: WHITE, space }, &at);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{shape:?}: {found}, expected {expected}");
        }
    }
}

#[test]
fn a_mix_by_direction_sees_the_normal() {
    let (a, b) = (Value::Constant(Vec3::new(1.0, 0.5, 0.0)), BLACK);
    let (scene, handle) = scene_of([Texture::DirectionMix { a, b, direction: Vec3::new(0.6, 0.0, 0.8) }]);
    let at = |normal: [f32; 3]| TexturePoint { normal, ..TexturePoint::default() };
    let points =
        [[0.6, 0.0, 0.8], [-0.6, 0.0, -0.8], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.8, 0.0, -0.6]].map(at);
    for backend in [Backend::Storage, Backend::Texel] {
        let found = super::evaluate(&scene, handle, backend, &points).unwrap();
        for (found, expected) in found.iter().zip([1.0, 1.0, 0.0, 0.6, 0.0_f32]) {
            assert!(
                (found[0] - expected).abs() < 1e-6 && (found[1] - 0.5 * expected).abs() < 1e-6,
                "{found:?}"
            );
        }
    }
}

#[test]
fn worley_finds_the_nearest_points() {
    let at = points(400, 6.0);
    for metric in [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev] {
        let measure = |d: [f64; 3]| match metric {
            Metric::Euclidean => d.iter().map(|x| x * x).sum::<f64>().sqrt(),
            Metric::Manhattan => d.iter().map(|x| x.abs()).sum(),
            Metric::Chebyshev => d.iter().fold(0.0, |most: f64, x| most.max(x.abs())),
        };
        let of = |feature| {
            let space = space(Coordinates::Object);
            reds(Texture::Worley { feature, metric, low: BLACK, high: WHITE, space }, &at)
        };
        let found = [WorleyFeature::F1, WorleyFeature::F2, WorleyFeature::Difference].map(of);
        for (i, p) in at.iter().enumerate() {
            let mut distances = Vec::new();
            for (x, y, z) in (-1..2).flat_map(|x| (-1..2).flat_map(move |y| (-1..2).map(move |z| (x, y, z))))
            {
                let cell = [p.x.floor() as i32 + x, p.y.floor() as i32 + y, p.z.floor() as i32 + z];
                let random = pcg3d(cell.map(|c| c as u32)).map(|bits| f64::from(bits >> 8) / 16_777_216.0);
                let to = |k: usize| f64::from(cell[k]) + random[k] - f64::from(p[k]);
                distances.push(measure([to(0), to(1), to(2)]));
            }
            distances.sort_by(f64::total_cmp);
            let expected = [distances[0], distances[1], distances[1] - distances[0]];
            for (found, expected) in found.iter().zip(expected) {
                let off = (found[i] - expected.min(1.0)).abs();
                assert!(off < 1e-5, "{metric:?} at {p}: {}, expected {expected}", found[i]);
            }
        }
    }
}

#[test]
fn ramps_map_places_to_colors() {
    // Linear in x; a step at 0.5, where two stops meet
    let stops =
        [(0.0, 0.0), (0.25, 1.0), (0.5, 0.5), (0.5, 0.0), (1.0, 4.0)].map(|(x, v)| (x, Vec3::splat(v)));
    let cases = [
        (-1.0, 0.0, 0.0),
        (0.0625, 0.25, 0.156_25),
        (0.25, 1.0, 1.0),
        (0.375, 0.75, 0.75),
        (0.4999, 0.5002, 0.5),
        (0.5001, 0.0008, 0.0),
        (0.75, 2.0, 2.0),
        (7.0, 4.0, 4.0),
    ];
    let at: Vec<Vec3> = cases.iter().map(|case| Vec3::new(case.0, 0.0, 0.0)).collect();
    for smooth in [false, true] {
        // A gradient from −8 to 8 over as many units, so that no place is cut off
        let map = Affine3A::from_translation(Vec3::X * -8.0) * Affine3A::from_scale(Vec3::splat(16.0));
        let (low, high) = (Value::Constant(Vec3::splat(-8.0)), Value::Constant(Vec3::splat(8.0)));
        let space = PatternSpace { pattern_from_space: map.inverse(), ..space(Coordinates::Object) };
        let (mut scene, gradient) =
            scene_of([Texture::Gradient { shape: Gradient::Linear, low, high, space }]);
        let ramp = Texture::Ramp { value: Value::Texture(gradient), stops: stops.to_vec(), smooth };
        let ramp = scene.textures.add("ramp", ramp);
        for (found, (x, linear, eased)) in values(&scene, ramp, &at).into_iter().zip(cases) {
            let expected = if smooth { eased } else { linear };
            assert!((found[0] - expected).abs() < 1e-4, "{smooth}, {x}: {}, expected {expected}", found[0]);
        }
    }
}

#[test]
fn constants_are_folded_and_equal_trees_are_one() {
    let (mut scene, half) = scene_of([Texture::Constant(Vec3::splat(0.5))]);
    let double =
        scene.textures.add("double", Texture::Add { a: Value::Texture(half), b: Value::Texture(half) });
    scene.textures.add("same", Texture::Multiply { a: Value::Texture(double), b: WHITE });
    let checker =
        || Texture::Checker { dimensions: 3, even: WHITE, odd: BLACK, space: space(Coordinates::Uv) };
    scene.textures.add("one", checker());
    scene.textures.add("two", checker());
    let prepared = prepare::prepare(&scene).unwrap();
    // 0.5, 1, and a pattern with two inputs
    assert_eq!(prepared.textures.len(), 2 + 4 + 2);
    // And a function for each of the three uses
    assert_eq!(prepared.texture_glsl.matches("vec4 texture_").count(), 2 + 3, "{}", prepared.texture_glsl);
    assert!(!prepared.texture_glsl.contains("texture_add("));
}

#[test]
fn what_is_made_of_itself_is_refused() {
    let (mut scene, first) = scene_of([Texture::Constant(Vec3::ONE)]);
    let second = scene.textures.add("second", Texture::Invert { value: Value::Texture(first) });
    scene.textures[first] = Texture::Invert { value: Value::Texture(second) };
    let error = prepare::prepare(&scene).unwrap_err();
    assert!(error.message.contains("is made of itself"), "{error}");
    // 64 are allowed, one in the other; more are not
    let chain = |length: usize| {
        let (mut scene, mut last) = scene_of([Texture::Checker {
            dimensions: 3,
            even: WHITE,
            odd: BLACK,
            space: space(Coordinates::Uv),
        }]);
        for _ in 1..length {
            last = scene.textures.add("link", Texture::Invert { value: Value::Texture(last) });
        }
        prepare::prepare(&scene).map(|_| ())
    };
    assert!(chain(64).is_ok());
    assert!(chain(65).is_err() && chain(100_000).is_err());
}
