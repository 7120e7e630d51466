//! Textures: a picture with its sampler and its place on a surface.

use super::document::index_into;
use super::json::Json;
use super::reader::Reader;
use crate::Result;
use crate::scene::{
    Channel, ColorSpace, Handle, ImageTexture, Mapping, MappingKind, TexelFilter, Texture, UvTransform,
    Value, Wrap,
};
use glam::{Vec2, Vec3};

/// What is taken from a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    pub color_space: ColorSpace,
    pub channel: Channel,
}

/// Which texture coordinates place a picture.
#[derive(Debug, Clone, Copy)]
enum UvSet {
    First,
    Second,
}

/// Colours.
pub(super) const COLOR: Part = Part { color_space: ColorSpace::Srgb, channel: Channel::Rgb };
/// Numbers in all three channels, as in normal maps.
pub(super) const VECTOR: Part = Part { color_space: ColorSpace::Linear, channel: Channel::Rgb };

/// A number in one channel.
pub(super) const fn number_in(channel: Channel) -> Part {
    Part { color_space: ColorSpace::Linear, channel }
}

/// What can be a factor on a texture.
pub(super) trait Factor: Copy + PartialEq {
    const NOTHING: Self;
    const WHOLE: Self;
    fn color(self) -> Vec3;
}

impl Factor for f32 {
    const NOTHING: Self = 0.0;
    const WHOLE: Self = 1.0;
    fn color(self) -> Vec3 {
        Vec3::splat(self)
    }
}

impl Factor for Vec3 {
    const NOTHING: Self = Vec3::ZERO;
    const WHOLE: Self = Vec3::ONE;
    fn color(self) -> Vec3 {
        self
    }
}

impl Reader<'_> {
    /// A number times one channel of a texture, when the object has a texture of that key.
    pub fn number(
        &mut self,
        object: &Json<'_>,
        factor: &str,
        default: f32,
        key: &str,
        channel: Channel,
    ) -> Result<Value<f32>> {
        let factor = self.limited(object, factor, default, 1.0)?;
        let Some(info) = object.get(key)? else { return Ok(Value::Constant(factor)) };
        self.scaled(&info, number_in(channel), factor)
    }

    /// The same for a number that is known.
    pub fn scaled(&mut self, info: &Json<'_>, part: Part, factor: f32) -> Result<Value<f32>> {
        let Some((texture, set)) = self.image_texture(info, part, factor)? else {
            return Ok(Value::Constant(factor));
        };
        if texture.channel == Channel::A && self.scene.images[texture.image].is_opaque() {
            return Ok(Value::Constant(factor));
        }
        Ok(Value::Texture(self.add_picture(info, texture, set)))
    }

    /// A colour times a texture of colours, when the object has a texture of that key.
    pub fn color(&mut self, object: &Json<'_>, factor: Vec3, key: &str) -> Result<Value<Vec3>> {
        let Some(info) = object.get(key)? else { return Ok(Value::Constant(factor)) };
        if factor == Vec3::ZERO {
            return Ok(Value::Constant(factor));
        }
        // A grey factor is one of the picture itself
        let grey = if factor == Vec3::splat(factor.x) { factor.x } else { 1.0 };
        let Some((texture, set)) = self.image_texture(&info, COLOR, grey)? else {
            return Ok(Value::Constant(factor));
        };
        let picture = Value::Texture(self.add_picture(&info, texture, set));
        if grey != 1.0 || factor == Vec3::ONE {
            return Ok(picture);
        }
        let product = Texture::Multiply { a: picture, b: Value::Constant(factor) };
        Ok(Value::Texture(self.add_texture(&info, product)))
    }

    /// A texture of its own.
    pub fn picture(&mut self, info: &Json<'_>, part: Part) -> Result<Option<Handle<Texture>>> {
        let texture = self.image_texture(info, part, 1.0)?;
        Ok(texture.map(|(texture, set)| self.add_picture(info, texture, set)))
    }

    /// A colour or a number times what vertices have of it, where they have colours.
    pub fn dyed<T: Factor>(&mut self, value: Value<T>, channel: Channel, colored: bool) -> Value<T> {
        if !colored || value == Value::Constant(T::NOTHING) {
            return value;
        }
        let textures = &mut self.scene.textures;
        let dye = textures.add("colours of vertices", Texture::VertexColor(channel));
        let a = match value {
            Value::Constant(factor) if factor == T::WHOLE => return Value::Texture(dye),
            Value::Constant(factor) => Value::Constant(factor.color()),
            Value::Texture(texture) => Value::Texture(texture),
        };
        Value::Texture(textures.add("dyed", Texture::Multiply { a, b: Value::Texture(dye) }))
    }

    /// Equal textures are one.
    fn add_texture(&mut self, info: &Json<'_>, texture: Texture) -> Handle<Texture> {
        self.scene.textures.add(info.pointer(), texture)
    }

    /// A picture that is placed by a set of texture coordinates.
    fn add_picture(&mut self, info: &Json<'_>, texture: ImageTexture, set: UvSet) -> Handle<Texture> {
        let picture = self.add_texture(info, Texture::Image(texture));
        match set {
            UvSet::First => picture,
            UvSet::Second => {
                let mapping = Mapping::new(MappingKind::Uv1);
                self.add_texture(info, Texture::Mapped { value: Value::Texture(picture), mapping })
            }
        }
    }

    /// A picture, and the set of texture coordinates that place it.
    fn image_texture(
        &mut self,
        info: &Json<'_>,
        part: Part,
        scale: f32,
    ) -> Result<Option<(ImageTexture, UvSet)>> {
        let textures = self.document.root.list("textures")?;
        let texture = &textures[index_into(&info.need("index")?, "textures", textures.len())?];
        let (uv, set) = placed(info)?;
        let set = match set {
            0 => UvSet::First,
            1 => UvSet::Second,
            _ => {
                let message =
                    format!("the texture uses set {set} of texture coordinates, and is shown by set 0");
                self.warn(info, &message);
                UvSet::First
            }
        };
        let Some(image) = self.image_of(texture)? else { return Ok(None) };
        let samplers = self.document.root.list("samplers")?;
        let sampler = match texture.get("sampler")? {
            Some(reference) => Some(&samplers[index_into(&reference, "samplers", samplers.len())?]),
            None => None,
        };
        let filter = sampler.map_or(Ok(TexelFilter::Trilinear), filter)?;
        let wrap = sampler.map_or(Ok([Wrap::Repeat; 2]), |sampler| {
            Ok([wrap(sampler, "wrapS")?, wrap(sampler, "wrapT")?])
        })?;
        let Part { color_space, channel } = part;
        let texture = ImageTexture { image, filter, wrap, uv, color_space, channel, scale, invert: false };
        Ok(Some((texture, set)))
    }
}

/// The texture coordinates of a picture from those of the surface, and which set of them.
///
/// KHR_texture_transform gives w' = O + R S w, with R clockwise in coordinates whose v runs downwards. Those of the scene have V = 1 − v:
/// there R is counter-clockwise and the offset is (O_u, 1 − O_v) − R S (0, 1).
fn placed(info: &Json<'_>) -> Result<(UvTransform, usize)> {
    let set = info.whole_or("texCoord", 0)?;
    let Some(transform) = info.extension("KHR_texture_transform")? else {
        return Ok((UvTransform::default(), set));
    };
    let offset = Vec2::from(transform.numbers_or("offset", [0.0; 2])?);
    let scale = Vec2::from(transform.numbers_or("scale", [1.0; 2])?);
    let angle = transform.number_or("rotation", 0.0)?;
    let moved = Vec2::from_angle(angle).rotate(scale * Vec2::Y);
    let offset = Vec2::new(offset.x, 1.0 - offset.y) - moved;
    let uv = UvTransform { scale, rotate: angle.to_degrees(), offset };
    Ok((uv, transform.whole_or("texCoord", set)?))
}

/// OpenGL's numbers of filters. A sampler that does not say it wants the best there is.
fn filter(sampler: &Json<'_>) -> Result<TexelFilter> {
    const NEAREST: usize = 9728;
    const LINEAR: usize = 9729;
    const MIPMAPS: [usize; 4] = [9984, 9985, 9986, 9987];
    let mag = sampler.get("magFilter")?;
    let min = sampler.get("minFilter")?;
    let number = |filter: &Option<Json<'_>>| filter.as_ref().map(Json::whole).transpose();
    match (number(&mag)?, number(&min)?) {
        (Some(NEAREST), _) => Ok(TexelFilter::Nearest),
        (None | Some(LINEAR), Some(NEAREST | LINEAR)) => Ok(TexelFilter::Bilinear),
        (None | Some(LINEAR), min) if min.is_none_or(|min| MIPMAPS.contains(&min)) => {
            Ok(TexelFilter::Trilinear)
        }
        _ => Err(sampler.error("`magFilter` or `minFilter` is no filter")),
    }
}

fn wrap(sampler: &Json<'_>, key: &str) -> Result<Wrap> {
    let Some(wrap) = sampler.get(key)? else { return Ok(Wrap::Repeat) };
    match wrap.whole()? {
        10497 => Ok(Wrap::Repeat),
        33071 => Ok(Wrap::Clamp),
        33648 => Ok(Wrap::Mirror),
        other => Err(wrap.error(format!("{other} is no way to wrap a texture"))),
    }
}
