//! Textures: a picture with its sampler and its place on a surface.

use super::document::index_into;
use super::json::Json;
use super::reader::Reader;
use crate::Result;
use crate::scene::{
    Channel, ColorSpace, Handle, Image, ImageTexture, Mapping, TexelFilter, Texels, Texture, UvTransform,
    Value, Wrap,
};
use glam::{Vec2, Vec3};

/// What is taken from a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    pub color_space: ColorSpace,
    pub channel: Channel,
}

/// A picture, and whether it lies on a surface by the second set of texture coordinates.
struct Placed {
    texture: ImageTexture,
    second: bool,
}

/// Colours.
pub(super) const COLOR: Part = Part { color_space: ColorSpace::Srgb, channel: Channel::Rgb };
/// Numbers in all three channels, as in normal maps.
pub(super) const VECTOR: Part = Part { color_space: ColorSpace::Linear, channel: Channel::Rgb };

/// A number in one channel.
pub(super) const fn number_in(channel: Channel) -> Part {
    Part { color_space: ColorSpace::Linear, channel }
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
        let Some(placed) = self.image_texture(info, part, factor)? else {
            return Ok(Value::Constant(factor));
        };
        let image = &self.scene.images[placed.texture.image];
        if placed.texture.channel == Channel::A && is_opaque(image) {
            return Ok(Value::Constant(factor));
        }
        Ok(Value::Texture(self.add_picture(info, placed)))
    }

    /// A colour times a texture of colours, when the object has a texture of that key.
    pub fn color(&mut self, object: &Json<'_>, factor: Vec3, key: &str) -> Result<Value<Vec3>> {
        let Some(info) = object.get(key)? else { return Ok(Value::Constant(factor)) };
        if factor == Vec3::ZERO {
            return Ok(Value::Constant(factor));
        }
        // A grey factor is one of the picture itself
        let grey = if factor == Vec3::splat(factor.x) { factor.x } else { 1.0 };
        let Some(placed) = self.image_texture(&info, COLOR, grey)? else {
            return Ok(Value::Constant(factor));
        };
        let picture = Value::Texture(self.add_picture(&info, placed));
        if grey != 1.0 || factor == Vec3::ONE {
            return Ok(picture);
        }
        let product = Texture::Multiply { a: picture, b: Value::Constant(factor) };
        Ok(Value::Texture(self.add_texture(&info, product)))
    }

    /// A texture of its own.
    pub fn picture(&mut self, info: &Json<'_>, part: Part) -> Result<Option<Handle<Texture>>> {
        let placed = self.image_texture(info, part, 1.0)?;
        Ok(placed.map(|placed| self.add_picture(info, placed)))
    }

    /// A texture that is named by its place in the document.
    pub fn add_texture(&mut self, info: &Json<'_>, texture: Texture) -> Handle<Texture> {
        self.scene.textures.add(info.pointer(), texture)
    }

    fn add_picture(&mut self, info: &Json<'_>, placed: Placed) -> Handle<Texture> {
        let picture = self.add_texture(info, Texture::Image(placed.texture));
        if !placed.second {
            return picture;
        }
        let mapping = Mapping::second_uv();
        self.add_texture(info, Texture::Mapped { value: Value::Texture(picture), mapping })
    }

    fn image_texture(&mut self, info: &Json<'_>, part: Part, scale: f32) -> Result<Option<Placed>> {
        let textures = self.document.root.list("textures")?;
        let texture = &textures[index_into(&info.need("index")?, "textures", textures.len())?];
        let (uv, set) = placed(info)?;
        if set > 1 {
            self.warn(
                info,
                &format!("the texture uses set {set} of texture coordinates, and is shown by set 0"),
            );
        }
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
        Ok(Some(Placed { texture, second: set == 1 }))
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

/// Whether alpha is 1 everywhere: surfaces of such a picture stop every ray.
fn is_opaque(image: &Image) -> bool {
    match &image.texels {
        Texels::Rgba8(texels) => texels.iter().all(|texel| texel[3] == u8::MAX),
        Texels::Rgba16(texels) => texels.iter().all(|texel| texel[3] == u16::MAX),
        Texels::RgbaF32(texels) => texels.iter().all(|texel| texel[3] >= 1.0),
    }
}
