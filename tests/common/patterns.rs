//! Patterns of every kind, to be compiled.

use dapple::scene::{
    Brick, Dots, Metric, Noise, NoiseSum, PatternSpace, Perlin, PerlinVariant, Scene, Spread, Texture, Value,
    ValueNoise, VeinKind, Veins, Warp, WorleyFeature,
};
use glam::{Vec2, Vec3};

fn constant(x: f32) -> Value<Vec3> {
    Value::Constant(Vec3::splat(x))
}

/// A sum of two octaves.
pub fn noise(sum: NoiseSum, perlin: Perlin, low: Value<Vec3>, space: PatternSpace) -> Noise {
    let (octaves, gain, lacunarity, high) = (2, 0.5, 2.0, constant(0.5));
    Noise { perlin, sum, octaves, gain, lacunarity, normalize: true, w: [0.5, 1.0], low, high, space }
}

/// Patterns of every kind that are made of noise or of cells, one in the other.
pub fn patterns(scene: &mut Scene, inner: Value<Vec3>, space: PatternSpace, turn: u32) -> Value<Vec3> {
    let mut last = inner;
    let mut wrap = |texture: Texture| Value::Texture(scene.textures.add("pattern", texture));
    for dimensions in 1..=4 {
        let variant = [PerlinVariant::Improved, PerlinVariant::Classic, PerlinVariant::Pbrt][turn as usize];
        let perlin = Perlin { variant, dimensions };
        let sum = [NoiseSum::Windy, NoiseSum::Turbulence][(dimensions & 1) as usize];
        last = wrap(Texture::Noise(noise(sum, perlin, last, space)));
    }
    let (octaves, gain, lacunarity, variation) = (2, 0.5, 2.0, 0.5);
    let kind = [VeinKind::Marble, VeinKind::Wood, VeinKind::Granite][turn as usize];
    let colors = match kind {
        VeinKind::Marble => Spread::Spline(vec![Vec3::ONE; 5]),
        _ => Spread::Stops(vec![(0.0, Vec3::ONE)]),
    };
    let veins = wrap(Texture::Veins(Veins { kind, octaves, gain, lacunarity, variation, colors, space }));
    let (dimensions, length, amplitude, frequency) = (turn + 1, 8, 3.0, 7.0);
    let (low, high) = (last, veins);
    let value = ValueNoise { dimensions, length, amplitude, frequency, octaves, low, high, space };
    let value = wrap(Texture::ValueNoise(value));
    let (size, joint, offset) = (Vec2::ONE, 0.1, 0.5);
    let brick = Brick { brick: value, mortar: last, size, joint, offset, variation, space };
    let brick = wrap(Texture::Brick(brick));
    let dots = wrap(Texture::Dots(Dots { inside: brick, outside: last, radius: 0.35, space }));
    let curve = wrap(Texture::Curve { value: dots, points: vec![(0.0, 0.0), (1.0, 0.9)], smooth: true });
    let warp = Warp::Noise { value: curve, amount: 0.5, octaves, gain, lacunarity, space };
    let (value, by, amount) = (wrap(Texture::Warp(warp)), veins, 0.5);
    let value = wrap(Texture::Warp(Warp::By { value, by, amount }));
    let Value::Texture(factor) = veins else { return value };
    let low = wrap(Texture::Scale { value, factor: Value::Texture(factor) });
    let (feature, metric) = (WorleyFeature::Edge, Metric::Euclidean);
    wrap(Texture::Worley { feature, metric, low, high: constant(0.5), space })
}
