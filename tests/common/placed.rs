//! Mapped pictures, volumes and textures of the user's own, to be compiled.

use dapple::scene::{
    Channel, ColorSpace, Coordinates, GlslTexture, Image, ImageTexture, Mapping, MappingKind, MappingSpace,
    Parameter, PatternSpace, Scene, StackTexture, TexelFilter, Texels, Texture, UvTransform, Value, Wrap,
};
use glam::{Affine3A, Vec3};

/// The sum of a picture by every mapping, of a volume, and of functions of the user's own.
pub fn placed(scene: &mut Scene) -> Value<Vec3> {
    let texels = Texels::Rgba8(vec![[9, 99, 200, 255]; 6]);
    let image = scene.images.add("picture", Image { width: 3, height: 2, texels });
    let picture = ImageTexture {
        image,
        filter: TexelFilter::Trilinear,
        wrap: [Wrap::Repeat, Wrap::Clamp],
        uv: UvTransform::default(),
        color_space: ColorSpace::Srgb,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    };
    let value = Value::Texture(scene.textures.add("picture", Texture::Image(picture)));
    let mut parts = Vec::new();
    let projections = [
        MappingKind::Uv,
        MappingKind::Spherical,
        MappingKind::Cylindrical,
        MappingKind::Planar,
        MappingKind::Cube,
        MappingKind::Triplanar,
    ];
    for (i, kind) in projections.into_iter().enumerate() {
        let mapping = Mapping {
            kind,
            space: [MappingSpace::Object, MappingSpace::World][i % 2],
            mapping_from_space: Affine3A::IDENTITY,
            pole_u: 0.0,
            seam_blend: if i < 2 { 0.1 } else { 0.0 },
            sharpness: 4.0,
        };
        parts.push(Texture::Mapped { value, mapping });
    }
    for smooth in [false, true] {
        parts.push(Texture::Stack(StackTexture {
            slices: vec![image; 4],
            smooth,
            wrap: [Wrap::Repeat, Wrap::Mirror, Wrap::Black],
            space: PatternSpace::new(Coordinates::Object),
            color_space: ColorSpace::Srgb,
            channel: Channel::Rgb,
            scale: 1.0,
            invert: false,
        }));
    }
    let source = "float wave(float x) { return sin(rate * x); }\n\
        vec4 color(TextureContext context) {\n\
            float n = fbm_noise(context.position, context.footprint, 3u) + turbulence_noise(context.position, 0.0, 2u);\n\
            return vec4(tint * wave(n + worley_f1(worley_euclidean(context.object_position))), 1.0);\n\
        }\n";
    for name in ["one.glsl", "other.glsl"] {
        let parameters = [("rate", Parameter::Number(2.0)), ("tint", Parameter::Color(Vec3::ONE))];
        parts.push(Texture::Glsl(GlslTexture {
            source: source.to_owned(),
            file: name.into(),
            line: 1,
            parameters: parameters.map(|(name, value)| (name.to_owned(), value)).to_vec(),
            max: 2.0,
        }));
    }
    let mut sum = Value::Constant(Vec3::ZERO);
    for part in parts {
        let b = Value::Texture(scene.textures.add("part", part));
        sum = Value::Texture(scene.textures.add("sum", Texture::Add { a: sum, b }));
    }
    sum
}
