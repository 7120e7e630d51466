//! `[texture.NAME]`: pictures, GLSL, volumes, and what joins textures.

use super::Writer;
use super::keys::{Keys, color, matrix, number, one_or_two, pair, rows, vector};
use crate::Result;
use crate::scene::{
    Channel, ColorSpace, GlslTexture, Handle, ImageTexture, Mapping, MappingKind, MappingSpace, Parameter,
    StackTexture, TexelFilter, Texture, UvTransform, Warp, Wrap,
};
use glam::{Affine3A, Mat3A, Vec2, Vec3, Vec3A};
use toml_edit::Value;

impl Writer<'_> {
    pub(super) fn texture(&mut self, handle: Handle<Texture>, texture: &Texture) -> Result<Keys> {
        let mut keys;
        match texture {
            Texture::Image(image) => return self.image_texture(image),
            Texture::Glsl(glsl) => return self.glsl(handle, glsl),
            Texture::Stack(stack) => return self.stack(stack),
            Texture::Veins(veins) => return self.veins(handle, veins),
            Texture::Constant(value) => {
                keys = Keys::of_kind("constant");
                keys.set("color", color(*value));
            }
            Texture::VertexColor(channel) => {
                keys = Keys::of_kind("vertex_color");
                self::channel(&mut keys, *channel);
            }
            Texture::Ramp { value, stops, smooth } => {
                keys = Keys::of_kind("ramp");
                keys.set("value", self.amount(value));
                keys.set("stops", self::stops(stops));
                keys.flag("smooth", *smooth, false);
            }
            Texture::Curve { value, points, smooth } => {
                keys = Keys::of_kind("curve");
                keys.set("value", self.color(value));
                keys.set("points", rows(points.iter().map(|&(x, y)| pair(Vec2::new(x, y)))));
                keys.flag("smooth", *smooth, false);
            }
            Texture::Scale { value, factor } => {
                keys = Keys::of_kind("scale");
                keys.set("value", self.color(value));
                keys.set("factor", self.amount(factor));
            }
            Texture::Warp(warp) => keys = self.warp(warp),
            Texture::Mix { a, b, amount } => {
                keys = Keys::of_kind("mix");
                self.put_color(&mut keys, "a", a, 0.0);
                self.put_color(&mut keys, "b", b, 1.0);
                self.put_amount(&mut keys, "amount", amount, 0.5);
            }
            Texture::DirectionMix { a, b, direction } => {
                keys = Keys::of_kind("direction_mix");
                self.put_color(&mut keys, "a", a, 0.0);
                self.put_color(&mut keys, "b", b, 1.0);
                keys.vector("direction", *direction, Vec3::Y);
            }
            Texture::Add { a, b } | Texture::Multiply { a, b } => {
                let adds = matches!(texture, Texture::Add { .. });
                keys = Keys::of_kind(if adds { "add" } else { "multiply" });
                keys.set("a", self.color(a));
                keys.set("b", self.color(b));
            }
            Texture::Invert { value } => {
                keys = Keys::of_kind("invert");
                keys.set("value", self.color(value));
            }
            Texture::Mapped { value, mapping } => {
                keys = Keys::of_kind("mapped");
                keys.set("value", self.color(value));
                self::mapping(&mut keys, mapping);
            }
            Texture::Checker { dimensions, even, odd, space } => {
                keys = self.checker(*dimensions, even, odd, space);
            }
            Texture::Noise(noise) => keys = self.noise(noise),
            Texture::ValueNoise(noise) => keys = self.value_noise(noise),
            Texture::Brick(wall) => keys = self.brick(wall),
            Texture::Dots(dots) => keys = self.dots(dots),
            Texture::Gradient { shape, low, high, space } => {
                keys = self.gradient(*shape, low, high, space);
            }
            Texture::Worley { feature, metric, low, high, space } => {
                keys = self.worley(*feature, *metric, low, high, space);
            }
        }
        Ok(keys)
    }

    fn image_texture(&mut self, texture: &ImageTexture) -> Result<Keys> {
        let mut keys = Keys::of_kind("image");
        keys.set("file", self.image(texture.image)?);
        let filter = match texture.filter {
            TexelFilter::Nearest => "nearest",
            TexelFilter::Bilinear => "bilinear",
            TexelFilter::Trilinear => "trilinear",
        };
        keys.word("filter", filter, "bilinear");
        if texture.wrap != [Wrap::Repeat; 2] {
            keys.set("wrap", one_or_two(texture.wrap.map(|wrap| Value::from(self::wrap(wrap)))));
        }
        let UvTransform { scale, rotate, offset } = texture.uv;
        if scale != Vec2::ONE {
            keys.set("uv_scale", one_or_two([number(scale.x), number(scale.y)]));
        }
        keys.number("uv_rotate", rotate, 0.0);
        if offset != Vec2::ZERO {
            keys.set("uv_offset", pair(offset));
        }
        shading(&mut keys, texture.color_space, texture.channel, texture.scale, texture.invert);
        Ok(keys)
    }

    fn stack(&mut self, stack: &StackTexture) -> Result<Keys> {
        let mut keys = Keys::of_kind("stack");
        let files = stack.slices.iter().map(|slice| self.image(*slice).map(Value::from));
        keys.set("files", rows(files.collect::<Result<Vec<_>>>()?.into_iter()));
        keys.word("filter", if stack.smooth { "trilinear" } else { "nearest" }, "trilinear");
        if stack.wrap != [Wrap::Repeat; 3] {
            keys.set("wrap", stack.wrap.iter().map(|wrap| self::wrap(*wrap)).collect::<Value>());
        }
        keys.space(&stack.space);
        shading(&mut keys, stack.color_space, stack.channel, stack.scale, stack.invert);
        Ok(keys)
    }

    fn glsl(&mut self, handle: Handle<Texture>, texture: &GlslTexture) -> Result<Keys> {
        let name = self.textures.name(handle).to_owned();
        let mut keys = Keys::of_kind("glsl");
        // What it includes is in it: lines that say where that was are of no more use
        let source: String =
            texture.source.split_inclusive('\n').filter(|line| !line.starts_with("#line ")).collect();
        keys.set("file", self.files.add(&name, "texture", "glsl", source.as_bytes())?);
        if !texture.parameters.is_empty() {
            let mut parameters = Keys::new();
            for (name, value) in &texture.parameters {
                parameters.set(
                    name,
                    match value {
                        Parameter::Number(value) => number(*value),
                        Parameter::Color(value) => vector(*value),
                    },
                );
            }
            keys.set("parameters", parameters.inline());
        }
        keys.number("max", texture.max, 1.0);
        Ok(keys)
    }

    fn warp(&self, warp: &Warp) -> Keys {
        let mut keys = Keys::of_kind("warp");
        match warp {
            Warp::By { value, by, amount } => {
                keys.set("value", self.color(value));
                keys.set("by", self.color(by));
                keys.number("amount", *amount, 1.0);
            }
            Warp::Noise { value, amount, octaves, gain, lacunarity, space } => {
                keys.set("value", self.color(value));
                keys.number("amount", *amount, 1.0);
                keys.count("octaves", *octaves, 6);
                keys.fractal(*gain, *lacunarity);
                keys.space(space);
            }
        }
        keys
    }
}

fn wrap(wrap: Wrap) -> &'static str {
    match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Clamp => "clamp",
        Wrap::Mirror => "mirror",
        Wrap::Black => "black",
        Wrap::Octahedral => "octahedral",
    }
}

fn channel(keys: &mut Keys, channel: Channel) {
    let word = match channel {
        Channel::Rgb => "rgb",
        Channel::R => "r",
        Channel::G => "g",
        Channel::B => "b",
        Channel::A => "a",
    };
    keys.word("channel", word, "rgb");
}

/// How the numbers of a picture are meant. The colour space is always said: its default is that of the file.
fn shading(keys: &mut Keys, space: ColorSpace, channel: Channel, scale: f32, invert: bool) {
    keys.set("color_space", if space == ColorSpace::Srgb { "srgb" } else { "linear" });
    self::channel(keys, channel);
    keys.number("scale", scale, 1.0);
    keys.flag("invert", invert, false);
}

/// Places and colours.
pub(super) fn stops(stops: &[(f32, Vec3)]) -> Value {
    rows(stops.iter().map(|(place, value)| [number(*place), color(*value)].into_iter().collect()))
}

fn mapping(keys: &mut Keys, mapping: &Mapping) {
    let Mapping { kind, space, mapping_from_space, pole_u, seam_blend, sharpness } = *mapping;
    keys.set(
        "mapping",
        match kind {
            MappingKind::Uv | MappingKind::Uv1 => "uv",
            MappingKind::Spherical => "spherical",
            MappingKind::Cylindrical => "cylindrical",
            MappingKind::Planar => "planar",
            MappingKind::Cube => "cube",
            MappingKind::Triplanar => "triplanar",
        },
    );
    keys.count("uv_set", u32::from(kind == MappingKind::Uv1), 0);
    let by_uv = matches!(kind, MappingKind::Uv | MappingKind::Uv1);
    let turns = matches!(kind, MappingKind::Spherical | MappingKind::Cylindrical);
    if !by_uv {
        keys.word("mapping_space", if space == MappingSpace::World { "world" } else { "object" }, "object");
        // z along +y, and x along itself
        let upright = Mat3A::from_cols(Vec3A::X, Vec3A::NEG_Z, Vec3A::Y).transpose();
        let usual = if turns { Affine3A::from_mat3(upright.into()) } else { Affine3A::IDENTITY };
        if mapping_from_space != usual {
            keys.set("mapping_matrix", matrix(&mapping_from_space));
        }
    }
    if turns {
        keys.number("pole_u", pole_u, 0.0);
    }
    if turns || by_uv {
        keys.number("seam_blend", seam_blend, 0.0);
    }
    if kind == MappingKind::Triplanar {
        keys.number("sharpness", sharpness, 4.0);
    }
}
