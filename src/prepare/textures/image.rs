//! Image textures: their record, and how bright they are.

use super::range::Range;
use crate::layout::{CHANNEL_A, CHANNEL_B, CHANNEL_G, CHANNEL_R, CHANNEL_RGB, CHANNEL_SHIFT};
use crate::layout::{FLAG_INVERT, FLAG_NEAREST, ImageLevel, ImageTexture, LEVELS_SHIFT};
use crate::layout::{WRAP_BLACK, WRAP_CLAMP, WRAP_MIRROR, WRAP_REPEAT, WRAP_V_SHIFT};
use crate::prepare::atlas::{Atlas, Place, Reader, half_size, level_count};
use crate::scene::{self, Channel, TexelFilter, Wrap};

/// Mean brightness over the picture, for the power of a light; and its largest value, for the unit of the sums.
pub(super) fn brightness(texture: &scene::ImageTexture, image: &scene::Image) -> Range {
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
    let (mut sum, mut min, mut max) = (0.0_f64, f64::INFINITY, 0.0_f64);
    for y in 0..image.height {
        for x in 0..image.width {
            let [r, g, b] = value(x, y);
            sum += (r + g + b) / 3.0;
            max = max.max(r).max(g).max(b);
            min = min.min(r).min(g).min(b);
        }
    }
    Range { min: min.min(max), mean: sum / (f64::from(image.width) * f64::from(image.height)).max(1.0), max }
}

/// The levels of its pyramid, the picture first, which follow its record; none when it is filtered otherwise.
pub(super) fn levels(
    texture: &scene::ImageTexture,
    image: &scene::Image,
    atlas: &Atlas,
    place: Place,
) -> Vec<ImageLevel> {
    let above = atlas.levels(texture);
    if above.is_empty() || texture.filter != TexelFilter::Trilinear {
        return Vec::new();
    }
    let mut size = [image.width, image.height];
    let mut levels = Vec::with_capacity(above.len() + 1);
    for &place in [place].iter().chain(above) {
        let (base, pitch) = atlas.address(place);
        levels.push(ImageLevel { base, pitch, size });
        size = half_size(size);
    }
    levels
}

/// Its record; `base` and `pitch` are where the atlas has it.
pub(super) fn record(
    texture: &scene::ImageTexture,
    image: &scene::Image,
    (base, pitch): (u32, u32),
) -> ImageTexture {
    let uv = texture.uv.matrix();
    ImageTexture {
        base,
        pitch,
        size: [image.width, image.height],
        uv_column0: uv.matrix2.x_axis.to_array(),
        uv_column1: uv.matrix2.y_axis.to_array(),
        uv_offset: uv.translation.to_array(),
        scale: texture.scale,
        flags: image_flags(texture) | level_count([image.width, image.height]) << LEVELS_SHIFT,
    }
}

pub(super) fn wrap_mode(wrap: Wrap) -> u32 {
    match wrap {
        Wrap::Repeat => WRAP_REPEAT,
        Wrap::Clamp => WRAP_CLAMP,
        Wrap::Mirror => WRAP_MIRROR,
        Wrap::Black => WRAP_BLACK,
    }
}

/// The flags of its record but for the number of levels.
pub(super) fn image_flags(texture: &scene::ImageTexture) -> u32 {
    let channel = match texture.channel {
        Channel::Rgb => CHANNEL_RGB,
        Channel::R => CHANNEL_R,
        Channel::G => CHANNEL_G,
        Channel::B => CHANNEL_B,
        Channel::A => CHANNEL_A,
    };
    let nearest = if texture.filter == TexelFilter::Nearest { FLAG_NEAREST } else { 0 };
    let invert = if texture.invert { FLAG_INVERT } else { 0 };
    wrap_mode(texture.wrap[0])
        | wrap_mode(texture.wrap[1]) << WRAP_V_SHIFT
        | nearest
        | invert
        | channel << CHANNEL_SHIFT
}
