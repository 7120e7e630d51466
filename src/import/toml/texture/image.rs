//! `kind = "image"`.

use crate::Result;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::Limits;
use crate::import::toml::view::{Item, View};
use crate::scene::{
    Channel, ColorSpace, Handle, Image, ImageTexture, TexelFilter, Texels, UvTransform, Wrap,
};
use glam::Vec2;

pub(super) const WRAPS: [(&str, Wrap); 4] =
    [("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp), ("mirror", Wrap::Mirror), ("black", Wrap::Black)];

impl Reader<'_> {
    pub(super) fn image_texture(&mut self, view: &View<'_>) -> Result<ImageTexture> {
        let filters = [
            ("trilinear", TexelFilter::Trilinear),
            ("bilinear", TexelFilter::Bilinear),
            ("nearest", TexelFilter::Nearest),
        ];
        let file = view.need("file")?;
        let filter = view.choice_or("filter", TexelFilter::Bilinear, &filters)?;
        let wrap = view.get("wrap").map_or(Ok([Wrap::Repeat; 2]), wrap)?;
        let uv = UvTransform {
            scale: view.get("uv_scale").map_or(Ok(Vec2::ONE), uv_scale)?,
            rotate: view.f32_or("uv_rotate", 0.0, Limits::Finite)?,
            offset: view.get("uv_offset").map_or(Ok(Vec2::ZERO), |item| item.vec2(Limits::Finite))?,
        };
        let image = self.image_at(file, file.path()?)?;
        let (color_space, channel, scale, invert) = shading(view, &self.scene.images[image])?;
        Ok(ImageTexture { image, filter, wrap, uv, color_space, channel, scale, invert })
    }

    /// The picture of a file, loaded once.
    pub(in crate::import::toml) fn image(&mut self, file: Item<'_>) -> Result<Handle<Image>> {
        self.image_at(file, file.path()?)
    }
}

fn wrap(item: Item<'_>) -> Result<[Wrap; 2]> {
    if !item.is_list() {
        let [repeat, clamp, mirror, black] = WRAPS;
        let all = [repeat, clamp, mirror, black, ("octahedral", Wrap::Octahedral)];
        return item.choice(&all).map(|both| [both; 2]);
    }
    let choices: Vec<_> = item.list("a list")?.map(|one| one.choice(&WRAPS)).collect::<Result<_>>()?;
    <[Wrap; 2]>::try_from(choices).map_err(|_| item.mismatch("one word or two"))
}

fn uv_scale(item: Item<'_>) -> Result<Vec2> {
    if item.is_number() { item.f32(Limits::Finite).map(Vec2::splat) } else { item.vec2(Limits::Finite) }
}

/// How the numbers of a picture are meant, which channel is given, the factor on it, and whether it is inverted.
pub(super) fn shading(view: &View<'_>, image: &Image) -> Result<(ColorSpace, Channel, f32, bool)> {
    let usual = match image.texels {
        Texels::Rgba8(_) | Texels::Rgba16(_) => ColorSpace::Srgb,
        Texels::RgbaF32(_) => ColorSpace::Linear,
    };
    let spaces = [("srgb", ColorSpace::Srgb), ("linear", ColorSpace::Linear)];
    Ok((
        view.choice_or("color_space", usual, &spaces)?,
        channel(view)?,
        view.f32_or("scale", 1.0, Limits::AtLeast(0.0))?,
        view.bool_or("invert", false)?,
    ))
}

/// Which channel is given.
pub(super) fn channel(view: &View<'_>) -> Result<Channel> {
    let channels =
        [("rgb", Channel::Rgb), ("r", Channel::R), ("g", Channel::G), ("b", Channel::B), ("a", Channel::A)];
    view.choice_or("channel", Channel::Rgb, &channels)
}
