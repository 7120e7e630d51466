//! `kind = "image"`.

use crate::Result;
use crate::import::toml::include::identity;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::Limits;
use crate::import::toml::view::{Item, View};
use crate::scene::{
    Channel, ColorSpace, Handle, Image, ImageTexture, TexelFilter, Texels, UvTransform, Wrap,
};
use glam::Vec2;

const WRAPS: [(&str, Wrap); 4] =
    [("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp), ("mirror", Wrap::Mirror), ("black", Wrap::Black)];

impl Reader<'_> {
    pub(super) fn image_texture(&mut self, view: &View<'_>) -> Result<ImageTexture> {
        let filters = [("bilinear", TexelFilter::Bilinear), ("nearest", TexelFilter::Nearest)];
        let channels = [
            ("rgb", Channel::Rgb),
            ("r", Channel::R),
            ("g", Channel::G),
            ("b", Channel::B),
            ("a", Channel::A),
        ];
        let spaces = [("srgb", ColorSpace::Srgb), ("linear", ColorSpace::Linear)];

        let file = view.need("file")?;
        let filter = view.choice_or("filter", TexelFilter::Bilinear, &filters)?;
        let wrap = view.get("wrap").map_or(Ok([Wrap::Repeat; 2]), wrap)?;
        let uv = UvTransform {
            scale: view.get("uv_scale").map_or(Ok(Vec2::ONE), uv_scale)?,
            rotate: view.f32_or("uv_rotate", 0.0, Limits::Finite)?,
            offset: view.get("uv_offset").map_or(Ok(Vec2::ZERO), |item| item.vec2(Limits::Finite))?,
        };
        let color_space = match view.get("color_space") {
            Some(item) => Some(item.choice(&spaces)?),
            None => None,
        };
        let channel = view.choice_or("channel", Channel::Rgb, &channels)?;
        let scale = view.f32_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let invert = view.bool_or("invert", false)?;

        let image = self.image(file)?;
        let color_space = color_space.unwrap_or(match self.scene.images[image].texels {
            Texels::Rgba8(_) | Texels::Rgba16(_) => ColorSpace::Srgb,
            Texels::RgbaF32(_) => ColorSpace::Linear,
        });
        Ok(ImageTexture { image, filter, wrap, uv, color_space, channel, scale, invert })
    }

    /// The picture of a file, loaded once.
    pub(in crate::import::toml) fn image(&mut self, file: Item<'_>) -> Result<Handle<Image>> {
        let path = file.path()?;
        let identity = identity(&path);
        if let Some(&handle) = self.images.get(&identity) {
            return Ok(handle);
        }
        self.need_file(file.node.spot, &path)?;
        let image = self.assets.image(&path).map_err(|error| self.sources.locate(file.node.spot, error))?;
        let handle = self.scene.images.add(path.display().to_string(), image);
        self.images.insert(identity, handle);
        Ok(handle)
    }
}

fn wrap(item: Item<'_>) -> Result<[Wrap; 2]> {
    if !item.is_list() {
        return item.choice(&WRAPS).map(|both| [both; 2]);
    }
    let choices: Vec<_> = item.list("a list")?.map(|one| one.choice(&WRAPS)).collect::<Result<_>>()?;
    <[Wrap; 2]>::try_from(choices).map_err(|_| item.mismatch("one word or two"))
}

fn uv_scale(item: Item<'_>) -> Result<Vec2> {
    if item.is_number() { item.f32(Limits::NotZero).map(Vec2::splat) } else { item.vec2(Limits::NotZero) }
}
