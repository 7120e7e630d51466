//! A scene with every kind of texture.

use crate::scene::{
    Brick, Bump, Channel, ColorSpace, Coordinates, Derivative, Dots, GlslTexture, Gradient, Image,
    ImageTexture, Mapping, MappingKind, MappingSpace, Material, Metric, Noise, NoiseSum, NormalMap, Opacity,
    Parameter, PatternSpace, Perlin, PerlinVariant, Scene, Spread, StackTexture, Surface, Tangents,
    TexelFilter, Texels, Texture, UvTransform, Value, ValueNoise, VeinKind, Veins, Warp, WorleyFeature, Wrap,
};
use glam::{Vec2, Vec3};

const HALF: Value<Vec3> = Value::Constant(Vec3::splat(0.5));
const SOURCE: &str = "vec4 color(TextureContext context)\n{\n    \
    float n = fbm_noise(context.position, context.footprint, 3u) + turbulence_noise(context.position, 0.0, 2u);\n    \
    return vec4(tint * (n + worley_f1(worley_euclidean(context.object_position))), 1.0);\n}\n";

/// A material for each texture, which is its colour, opacity, bumps and normals.
pub fn scene(vertex_color: bool, uv1: bool) -> Scene {
    let mut scene = Scene::default();
    let mut textures = pictures(&mut scene);
    let picture = textures.first().cloned().map(|picture| scene.textures.add("picture", picture));
    let picture = picture.map_or(HALF, Value::Texture);
    for (coordinates, filter_width) in
        [(Coordinates::Uv, 1.0), (Coordinates::Object, 1.0), (Coordinates::World, 0.0)]
    {
        let space = PatternSpace { filter_width, ..PatternSpace::new(coordinates) };
        textures.extend(patterns(picture, space));
    }
    textures.extend(noises(picture));
    textures.extend(joins(picture));
    textures.extend(mapped(picture, uv1));
    if vertex_color {
        let channels = [Channel::Rgb, Channel::R, Channel::G, Channel::B, Channel::A];
        textures.extend(channels.map(Texture::VertexColor));
    }
    for texture in textures {
        let texture = scene.textures.add("texture", texture);
        let (color, value) = (Value::Texture(texture), Value::Texture(texture));
        let mut material = Material::new(Surface::diffuse(color), None);
        material.detail.opacity = Opacity { value, cutoff: None, filter: color };
        material.detail.bump =
            Some(Bump { texture, height: 1.0, derivative: Derivative::Kernel, curvature: true });
        material.detail.normal_map =
            Some(NormalMap { texture, green_down: false, strength: 1.0, tangents: Tangents::Uv });
        scene.materials.add("material", material);
    }
    scene
}

/// Pictures and volumes of every format, and a picture by directions.
fn pictures(scene: &mut Scene) -> Vec<Texture> {
    let formats = [
        (ColorSpace::Srgb, Texels::Rgba8(vec![[9; 4]; 6])),
        (ColorSpace::Linear, Texels::Rgba8(vec![[9; 4]; 6])),
        (ColorSpace::Linear, Texels::Rgba16(vec![[9; 4]; 6])),
        (ColorSpace::Linear, Texels::RgbaF32(vec![[9.0; 4]; 6])),
    ];
    let mut parts = Vec::new();
    for (color_space, texels) in formats {
        let image = scene.images.add("picture", Image { width: 3, height: 2, texels });
        let picture = ImageTexture {
            image,
            filter: TexelFilter::Trilinear,
            wrap: [Wrap::Repeat, Wrap::Mirror],
            uv: UvTransform::default(),
            color_space,
            channel: Channel::Rgb,
            scale: 1.0,
            invert: false,
        };
        let bilinear =
            ImageTexture { filter: TexelFilter::Bilinear, wrap: [Wrap::Octahedral; 2], ..picture.clone() };
        parts.extend([picture, bilinear].map(Texture::Image));
        for coordinates in [Coordinates::Object, Coordinates::World] {
            parts.push(Texture::Stack(StackTexture {
                slices: vec![image; 2],
                smooth: true,
                wrap: [Wrap::Repeat, Wrap::Clamp, Wrap::Black],
                space: PatternSpace::new(coordinates),
                color_space,
                channel: Channel::Rgb,
                scale: 1.0,
                invert: false,
            }));
        }
    }
    parts
}

/// Patterns in a space.
fn patterns(low: Value<Vec3>, space: PatternSpace) -> Vec<Texture> {
    let (high, value) = (HALF, low);
    let (octaves, gain, lacunarity, variation) = (2, 0.5, 2.0, 0.5);
    let (size, joint, offset) = (Vec2::ONE, 0.1, 0.5);
    let (length, amplitude, frequency) = (8, 3.0, 7.0);
    let mut parts = vec![
        Texture::Brick(Brick { brick: low, mortar: high, size, joint, offset, variation, space }),
        Texture::Dots(Dots { inside: low, outside: high, radius: 0.35, space }),
        Texture::Warp(Warp::Noise { value, amount: 0.5, octaves, gain, lacunarity, space }),
    ];
    let numbers = [2, 3].map(|dimensions| Texture::Checker { dimensions, even: low, odd: high, space });
    parts.extend(numbers);
    parts.extend((1..=4).map(|dimensions| {
        Texture::ValueNoise(ValueNoise {
            dimensions,
            length,
            amplitude,
            frequency,
            octaves,
            low,
            high,
            space,
        })
    }));
    for kind in [VeinKind::Marble, VeinKind::Wood, VeinKind::Granite] {
        for colors in [Spread::Stops(vec![(0.0, Vec3::ONE)]), Spread::Spline(vec![Vec3::ONE; 5])] {
            parts.push(Texture::Veins(Veins { kind, octaves, gain, lacunarity, variation, colors, space }));
        }
    }
    let shapes = [Gradient::Linear, Gradient::Cylindrical, Gradient::Spherical];
    parts.extend(shapes.map(|shape| Texture::Gradient { shape, low, high, space }));
    for feature in [WorleyFeature::F1, WorleyFeature::F2, WorleyFeature::Difference, WorleyFeature::Edge] {
        let metrics = [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev];
        parts.extend(metrics.map(|metric| Texture::Worley { feature, metric, low, high, space }));
    }
    parts
}

/// Every sum of every gradient noise.
fn noises(low: Value<Vec3>) -> Vec<Texture> {
    let space = PatternSpace::new(Coordinates::Object);
    let (octaves, gain, lacunarity, high) = (2, 0.5, 2.0, HALF);
    let mut parts = Vec::new();
    for variant in [PerlinVariant::Improved, PerlinVariant::Classic, PerlinVariant::Pbrt] {
        for dimensions in 1..=4 {
            for sum in [NoiseSum::Fbm, NoiseSum::Turbulence, NoiseSum::Ridged, NoiseSum::Windy] {
                let perlin = Perlin { variant, dimensions };
                let (normalize, w) = (sum != NoiseSum::Windy, [0.5, 1.0]);
                let noise = Noise { perlin, sum, octaves, gain, lacunarity, normalize, w, low, high, space };
                parts.push(Texture::Noise(noise));
            }
        }
    }
    parts
}

/// What makes a texture of others, a constant, and a function of the user's own.
fn joins(a: Value<Vec3>) -> Vec<Texture> {
    let (value, b, amount, smooth) = (a, HALF, 0.5, true);
    let factor = match a {
        Value::Texture(texture) => Value::Texture(texture),
        Value::Constant(_) => Value::Constant(0.5),
    };
    let parameters = vec![("tint".to_owned(), Parameter::Color(Vec3::ONE))];
    let source = SOURCE.to_owned();
    vec![
        Texture::Constant(Vec3::ONE),
        Texture::Ramp { value: factor, stops: vec![(0.0, Vec3::ZERO), (1.0, Vec3::ONE)], smooth },
        Texture::Curve { value, points: vec![(0.0, 0.0), (1.0, 0.9)], smooth },
        Texture::Scale { value, factor },
        Texture::Warp(Warp::By { value, by: a, amount }),
        Texture::Mix { a, b, amount: factor },
        Texture::DirectionMix { a, b, direction: Vec3::Y },
        Texture::Add { a, b },
        Texture::Multiply { a, b },
        Texture::Invert { value },
        Texture::Glsl(GlslTexture { source, file: "texture.glsl".into(), line: 1, parameters, max: 1.0 }),
    ]
}

/// A texture by every mapping.
fn mapped(value: Value<Vec3>, uv1: bool) -> Vec<Texture> {
    let mut kinds = vec![
        MappingKind::Uv,
        MappingKind::Spherical,
        MappingKind::Cylindrical,
        MappingKind::Planar,
        MappingKind::Cube,
        MappingKind::Triplanar,
    ];
    kinds.extend(uv1.then_some(MappingKind::Uv1));
    let mut parts = Vec::new();
    for kind in kinds {
        for space in [MappingSpace::Object, MappingSpace::World] {
            for seam_blend in [0.0, 0.1] {
                let mapping = Mapping { space, seam_blend, ..Mapping::new(kind) };
                parts.push(Texture::Mapped { value, mapping });
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// A kind that is missing here does not compile; one that is new gets the next number.
    fn number(texture: &Texture) -> usize {
        match texture {
            Texture::Image(_) => 0,
            Texture::Glsl(_) => 1,
            Texture::Stack(_) => 2,
            Texture::Constant(_) => 3,
            Texture::VertexColor(_) => 4,
            Texture::Checker { .. } => 5,
            Texture::Noise(_) => 6,
            Texture::ValueNoise(_) => 7,
            Texture::Veins(_) => 8,
            Texture::Brick(_) => 9,
            Texture::Dots(_) => 10,
            Texture::Gradient { .. } => 11,
            Texture::Worley { .. } => 12,
            Texture::Ramp { .. } => 13,
            Texture::Curve { .. } => 14,
            Texture::Scale { .. } => 15,
            Texture::Warp(Warp::By { .. }) => 16,
            Texture::Warp(Warp::Noise { .. }) => 17,
            Texture::Mix { .. } => 18,
            Texture::DirectionMix { .. } => 19,
            Texture::Add { .. } => 20,
            Texture::Multiply { .. } => 21,
            Texture::Invert { .. } => 22,
            Texture::Mapped { .. } => 23,
        }
    }

    const KINDS: usize = 24;

    #[test]
    fn every_kind_of_texture_is_there() {
        let kinds = |vertex_color, uv1| -> BTreeSet<usize> {
            scene(vertex_color, uv1).textures.iter().map(|(_, _, texture)| number(texture)).collect()
        };
        assert_eq!(kinds(true, true), (0..KINDS).collect());
        let without = crate::prepare::prepare(&scene(false, false)).unwrap().features;
        assert!(!without.vertex_color && !without.uv1);
        let with = crate::prepare::prepare(&scene(true, true)).unwrap().features;
        assert!(with.vertex_color && with.uv1 && with.footprint && with.timed_textures);
    }
}
