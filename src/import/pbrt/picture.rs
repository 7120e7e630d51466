//! Pictures: textures of class imagemap, and others that materials and cameras name.

use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::texture::Number;
use super::unsupported::Unsupported;
use crate::import::text::{Limits, shown};
use crate::scene::{
    Channel, ColorSpace, Handle, Image, ImageTexture, TexelFilter, Texels, Texture, UvTransform, Value, Wrap,
};
use crate::{Error, Result};
use std::path::Path;

impl Reader<'_> {
    pub(super) fn image_map(&mut self, from: &Parameters, number: Number) -> Result<Texture> {
        let (spot, path) =
            from.file("filename")?.ok_or_else(|| from.missing("filename", super::parameter::Type::String))?;
        let placement = self.placement(from)?;
        let filter = self.texel_filter(from)?;
        let wrap = self.wrap(from)?;
        let scale = from.float_or("scale", 1.0, Limits::Finite)?;
        let invert = from.bool_or("invert", false)?;
        let encoded = self.encoding(from)?;
        from.float("maxanisotropy", Limits::Above(0.0))?;
        let (image, transparent) = self.image(&spot, &path)?;
        let color_space = match self.scene.images[image].texels {
            Texels::Rgba8(_) | Texels::Rgba16(_) => encoded,
            Texels::RgbaF32(_) => ColorSpace::Linear,
        };
        // A number from a picture with holes is its alpha
        let channel = if number == Number::Float && transparent { Channel::A } else { Channel::Rgb };
        // pbrt inverts after it scales; a picture here is scaled last, and by nothing below 0
        let own = if invert || scale < 0.0 { 1.0 } else { scale };
        let uv = placement.uv;
        let picture = ImageTexture {
            image,
            filter,
            wrap: [wrap; 2],
            uv,
            color_space,
            channel,
            scale: own,
            invert: false,
        };
        let mut texture = self.placed(&placement, Texture::Image(picture));
        if own != scale {
            let value = Value::Texture(self.part(texture));
            texture = Texture::Scale { value, factor: Value::Constant(scale) };
        }
        if invert {
            texture = Texture::Invert { value: Value::Texture(self.part(texture)) };
        }
        Ok(texture)
    }

    /// pbrt filters with pyramids of pictures, unless an option says otherwise.
    fn texel_filter(&self, from: &Parameters) -> Result<TexelFilter> {
        let smooth = if self.filtered { TexelFilter::Trilinear } else { TexelFilter::Bilinear };
        let filters = [
            ("bilinear", smooth),
            ("point", TexelFilter::Nearest),
            ("trilinear", smooth),
            ("ewa", smooth),
            ("EWA", smooth),
        ];
        from.choice_or("filter", smooth, &filters)
    }

    fn wrap(&mut self, from: &Parameters) -> Result<Wrap> {
        let wraps = [
            ("repeat", Some(Wrap::Repeat)),
            ("clamp", Some(Wrap::Clamp)),
            ("black", Some(Wrap::Black)),
            ("octahedralsphere", None),
        ];
        let wrap = from.choice_or("wrap", Some(Wrap::Repeat), &wraps)?;
        Ok(wrap.unwrap_or_else(|| {
            self.unsupported(Unsupported::Octahedral, &from.spot);
            Wrap::Repeat
        }))
    }

    fn encoding(&mut self, from: &Parameters) -> Result<ColorSpace> {
        let Some((parameter, name)) = from.string("encoding")? else { return Ok(ColorSpace::Srgb) };
        match name {
            "sRGB" => Ok(ColorSpace::Srgb),
            "linear" => Ok(ColorSpace::Linear),
            _ if name.starts_with("gamma ") => {
                let spot = parameter.spot.clone();
                self.unsupported(Unsupported::Encoding, &spot);
                Ok(ColorSpace::Srgb)
            }
            _ => {
                let rule = "\"sRGB\", \"linear\" or \"gamma\" and a number";
                Err(from.refuse(parameter, format!("\"{}\"", shown(name)), rule).help("choose one of them"))
            }
        }
    }

    /// A picture in numbers as they are, for normals.
    pub(super) fn linear_picture(&mut self, spot: &Spot, path: &Path) -> Result<Handle<Texture>> {
        let (image, _) = self.image(spot, path)?;
        let filter = if self.filtered { TexelFilter::Trilinear } else { TexelFilter::Bilinear };
        let texture = ImageTexture {
            image,
            filter,
            wrap: [Wrap::Repeat; 2],
            uv: UvTransform::default(),
            color_space: ColorSpace::Linear,
            channel: Channel::Rgb,
            scale: 1.0,
            invert: false,
        };
        Ok(self.part(Texture::Image(texture)))
    }

    /// The picture of a file, loaded once, and whether it has holes.
    pub(super) fn image(&mut self, spot: &Spot, path: &Path) -> Result<(Handle<Image>, bool)> {
        if let Some(known) = self.images.get(path) {
            return Ok(*known);
        }
        self.need_file(spot, path)?;
        let image = self.assets.image(path).map_err(|error| spot.locate(error))?;
        let transparent = match &image.texels {
            Texels::Rgba8(texels) => texels.iter().any(|texel| texel[3] != u8::MAX),
            Texels::Rgba16(texels) => texels.iter().any(|texel| texel[3] != u16::MAX),
            Texels::RgbaF32(texels) => texels.iter().any(|texel| texel[3] != 1.0),
        };
        let known = (self.scene.images.add(path.display().to_string(), image), transparent);
        self.images.insert(path.to_path_buf(), known);
        Ok(known)
    }

    /// Checks that a file is there before it is read, so that a wrong name is reported where it is written.
    pub(super) fn need_file(&mut self, spot: &Spot, path: &Path) -> Result<()> {
        if self.assets.exists(path) {
            return Ok(());
        }
        let message = format!("there is no file {}", shown(&path.display().to_string()));
        Err(spot
            .locate(Error::scene(message).help("names are relative to the file that they are written in")))
    }
}
