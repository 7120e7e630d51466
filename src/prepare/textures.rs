//! Texture trees to GLSL and records.
//!
//! A texture is named in the kernels by a reference: the shape of its tree in the upper 8 bits, the word of its record in
//! the lower 24. Textures of one shape share one case of the generated function; what differs between them is read from
//! their records, so that changing a number compiles nothing.

use super::Prepared;
use super::atlas::{Atlas, Format, Reader};
use crate::layout::{CHANNEL_A, CHANNEL_B, CHANNEL_G, CHANNEL_R, CHANNEL_RGB, CHANNEL_SHIFT};
use crate::layout::{FLAG_INVERT, FLAG_NEAREST, ImageTexture, Record};
use crate::layout::{WRAP_BLACK, WRAP_CLAMP, WRAP_MIRROR, WRAP_REPEAT, WRAP_V_SHIFT};
use crate::scene::{self, Channel, Handle, Scene, TexelFilter, Texture, Wrap};
use crate::{Error, Result};
use std::fmt::Write as _;

/// References of the textures of a scene, and how bright they are.
pub(super) struct References {
    references: Vec<u32>,
    means: Vec<f64>,
    maxima: Vec<f32>,
}

impl References {
    /// The reference of a texture.
    pub(super) fn reference(&self, handle: Handle<Texture>) -> u32 {
        self.references[handle.index()]
    }

    /// Mean of its values over the picture.
    pub(super) fn mean(&self, handle: Handle<Texture>) -> f64 {
        self.means[handle.index()]
    }

    /// Largest of its values over the picture.
    pub(super) fn max(&self, handle: Handle<Texture>) -> f32 {
        self.maxima[handle.index()]
    }
}

/// Fills `textures`, `texels` and `texture_glsl`.
pub(super) fn prepare(scene: &Scene, out: &mut Prepared) -> Result<References> {
    let mut atlas = Atlas::default();
    let mut places = Vec::new();
    for (_, _, Texture::Image(texture)) in scene.textures.iter() {
        places.push((texture, atlas.place(scene, texture)?));
    }
    if places.len() * ImageTexture::WORDS as usize >= 1 << 24 {
        return Err(Error::scene(format!(
            "{} textures are too many: their records take 2^24 words",
            places.len()
        )));
    }
    let mut shapes: Vec<Format> = Vec::new();
    let mut references = References { references: Vec::new(), means: Vec::new(), maxima: Vec::new() };
    for (texture, place) in places {
        let shape = shapes.iter().position(|format| *format == place.format).unwrap_or_else(|| {
            shapes.push(place.format);
            shapes.len() - 1
        });
        let image = &scene.images[texture.image];
        let word = out.textures.len() as u32;
        let record = record(texture, image, atlas.address(place));
        out.textures.extend_from_slice(bytemuck::cast_slice(std::slice::from_ref(&record)));
        references.references.push((shape as u32) << 24 | word);
        let (mean, max) = brightness(texture, image);
        references.means.push(mean);
        references.maxima.push(max);
    }
    out.texels = atlas.into_words();
    out.texture_glsl = glsl(&shapes);
    Ok(references)
}

/// Mean brightness over the picture, for the power of a light; and its largest value, for the unit of the sums.
fn brightness(texture: &scene::ImageTexture, image: &scene::Image) -> (f64, f32) {
    let read = Reader { image, decode: texture.color_space == scene::ColorSpace::Srgb };
    let value = |x, y| {
        let [r, g, b, a] = read.linear(x, y);
        let rgb = match texture.channel {
            Channel::Rgb => [r, g, b],
            Channel::R => [r; 3],
            Channel::G => [g; 3],
            Channel::B => [b; 3],
            Channel::A => [a; 3],
        };
        rgb.map(|c| f64::from(if texture.invert { 1.0 - c } else { c }) * f64::from(texture.scale))
    };
    let (mut sum, mut max) = (0.0_f64, 0.0_f64);
    for y in 0..image.height {
        for x in 0..image.width {
            let [r, g, b] = value(x, y);
            sum += (r + g + b) / 3.0;
            max = max.max(r).max(g).max(b);
        }
    }
    (sum / (f64::from(image.width) * f64::from(image.height)).max(1.0), max as f32)
}

fn glsl(shapes: &[Format]) -> String {
    let mut text = String::from(
        "// Generated from the textures of the scene.\n#include \"texture/image.glsl\"\n\n\
         vec4 texture_evaluate(uint reference, TextureContext context)\n{\n    uint at = reference & 0xffffffu;\n    \
         switch (reference >> 24) {\n",
    );
    for (i, format) in shapes.iter().enumerate() {
        _ = writeln!(text, "    case {i}u: return image_texture(at, {}u, context);", format.number());
    }
    text.push_str("    default: return vec4(0.0);\n    }\n}\n");
    text
}

fn record(texture: &scene::ImageTexture, image: &scene::Image, (base, pitch): (u32, u32)) -> ImageTexture {
    let uv = texture.uv.matrix();
    let wrap = |wrap| match wrap {
        Wrap::Repeat => WRAP_REPEAT,
        Wrap::Clamp => WRAP_CLAMP,
        Wrap::Mirror => WRAP_MIRROR,
        Wrap::Black => WRAP_BLACK,
    };
    let channel = match texture.channel {
        Channel::Rgb => CHANNEL_RGB,
        Channel::R => CHANNEL_R,
        Channel::G => CHANNEL_G,
        Channel::B => CHANNEL_B,
        Channel::A => CHANNEL_A,
    };
    let nearest = if texture.filter == TexelFilter::Nearest { FLAG_NEAREST } else { 0 };
    let invert = if texture.invert { FLAG_INVERT } else { 0 };
    ImageTexture {
        base,
        pitch,
        size: [image.width, image.height],
        uv_column0: uv.matrix2.x_axis.to_array(),
        uv_column1: uv.matrix2.y_axis.to_array(),
        uv_offset: uv.translation.to_array(),
        scale: texture.scale,
        flags: wrap(texture.wrap[0])
            | wrap(texture.wrap[1]) << WRAP_V_SHIFT
            | nearest
            | invert
            | channel << CHANNEL_SHIFT,
    }
}
