//! Image textures: their record, and how bright they are.

use super::range::Range;
use crate::layout::{CHANNEL_A, CHANNEL_B, CHANNEL_G, CHANNEL_R, CHANNEL_RGB, CHANNEL_SHIFT};
use crate::layout::{FLAG_INVERT, FLAG_NEAREST, FLAG_OCTAHEDRAL, ImageLevel, ImageTexture, LEVELS_SHIFT};
use crate::layout::{WRAP_BLACK, WRAP_CLAMP, WRAP_MIRROR, WRAP_REPEAT, WRAP_V_SHIFT};
use crate::prepare::atlas::{Atlas, Placed, Reader, half_size, level_count};
use crate::scene::{self, Channel, Handle, Scene, TexelFilter, Texture, UvTransform, Wrap};
use glam::DVec2;

/// Mean brightness over the picture, for the power of a light; and its largest value, for the unit of the sums.
pub(super) fn brightness(texture: &scene::ImageTexture, image: &scene::Image) -> Range {
    let value = values(texture, image);
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

/// The colours of its texels, by column and row.
fn values<'a>(
    texture: &'a scene::ImageTexture,
    image: &'a scene::Image,
) -> impl Fn(u32, u32) -> [f64; 3] + 'a {
    let read = Reader { image, decode: texture.color_space == scene::ColorSpace::Srgb };
    move |x, y| {
        let [r, g, b, a] = read.linear(x, y);
        let rgb = match texture.channel {
            Channel::Rgb => [r, g, b],
            Channel::R => [r; 3],
            Channel::G => [g; 3],
            Channel::B => [b; 3],
            Channel::A => [a; 3],
        };
        rgb.map(|c| f64::from(if texture.invert { 1.0 - c } else { c }) * f64::from(texture.scale))
    }
}

/// Mean brightness of a texture over uv with the weight of each uv, texel by texel; none when it is no picture that fills the
/// unit square once, or when nothing has weight.
pub(in crate::prepare) fn picture_mean(
    scene: &Scene,
    handle: Handle<Texture>,
    weight: impl Fn(DVec2) -> f64,
) -> Option<f64> {
    let Texture::Image(texture) = &scene.textures[handle] else { return None };
    let image = &scene.images[texture.image];
    let value = values(texture, image);
    let (mut sum, mut whole) = (0.0, 0.0);
    for y in 0..image.height {
        for x in 0..image.width {
            let at =
                (DVec2::new(x.into(), y.into()) + 0.5) / DVec2::new(image.width.into(), image.height.into());
            let weight = weight(DVec2::new(at.x, 1.0 - at.y));
            sum += weight * value(x, y).into_iter().sum::<f64>() / 3.0;
            whole += weight;
        }
    }
    Some(sum / whole).filter(|mean| mean.is_finite() && texture.uv == UvTransform::default())
}

/// The levels of its pyramid, the picture first, which follow its record; none when it is filtered otherwise.
pub(super) fn levels(image: &scene::Image, atlas: &Atlas, placed: &Placed) -> Vec<ImageLevel> {
    if placed.above.is_empty() {
        return Vec::new();
    }
    let mut size = [image.width, image.height];
    let mut levels = Vec::with_capacity(placed.above.len() + 1);
    for &place in std::iter::once(&placed.picture).chain(&placed.above) {
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
        // The flag takes its place
        Wrap::Clamp | Wrap::Octahedral => WRAP_CLAMP,
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
    let octahedral = if texture.wrap.contains(&Wrap::Octahedral) { FLAG_OCTAHEDRAL } else { 0 };
    wrap_mode(texture.wrap[0])
        | wrap_mode(texture.wrap[1]) << WRAP_V_SHIFT
        | nearest
        | invert
        | octahedral
        | channel << CHANNEL_SHIFT
}
