//! Pictures: textures of class imagemap, and others that materials and cameras name.

use super::parameter::number;
use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::texture::Number;
use crate::import::text::{Limits, shown};
use crate::scene::{
    Channel, ColorSpace, Handle, Image, ImageTexture, TexelFilter, Texels, Texture, UvTransform, Value, Wrap,
};
use crate::{Error, Result};
use std::path::Path;
use std::sync::Arc;

/// How the integers of a picture are meant.
#[derive(Debug, Clone, Copy)]
enum Encoding {
    Space(ColorSpace),
    /// Linear light is this power of the numbers.
    Gamma(f32),
}

impl Reader<'_> {
    pub(super) fn image_map(&mut self, from: &Parameters, number: Number) -> Result<Texture> {
        let (spot, path) =
            from.file("filename")?.ok_or_else(|| from.missing("filename", super::parameter::Type::String))?;
        let placement = self.placement(from)?;
        let filter = self.texel_filter(from)?;
        let wraps = [
            ("repeat", Wrap::Repeat),
            ("clamp", Wrap::Clamp),
            ("black", Wrap::Black),
            ("octahedralsphere", Wrap::Octahedral),
        ];
        let wrap = from.choice_or("wrap", Wrap::Repeat, &wraps)?;
        let scale = from.float_or("scale", 1.0, Limits::Finite)?;
        let invert = from.bool_or("invert", false)?;
        let encoding = encoding(from)?;
        from.float("maxanisotropy", Limits::Above(0.0))?;
        let (image, transparent) = match encoding {
            Encoding::Space(_) => self.image(&spot, &path)?,
            Encoding::Gamma(gamma) => self.image_of_gamma(&spot, &path, gamma)?,
        };
        let color_space = match (&self.scene.images[image].texels, encoding) {
            (Texels::Rgba8(_) | Texels::Rgba16(_), Encoding::Space(space)) => space,
            _ => ColorSpace::Linear,
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
        self.image_as(spot, path, None)
    }

    /// The same of a file whose numbers are powers of linear light.
    fn image_of_gamma(&mut self, spot: &Spot, path: &Path, gamma: f32) -> Result<(Handle<Image>, bool)> {
        self.image_as(spot, path, Some(gamma))
    }

    fn image_as(&mut self, spot: &Spot, path: &Path, gamma: Option<f32>) -> Result<(Handle<Image>, bool)> {
        let key = (path.to_path_buf(), gamma.map(f32::to_bits));
        if let Some(known) = self.images.get(&key) {
            return Ok(*known);
        }
        self.need_file(spot, path)?;
        let mut image = self.assets.image(path).map_err(|error| spot.locate(error))?;
        if let Some(gamma) = gamma {
            image = without_gamma(Arc::unwrap_or_clone(image), gamma).into();
        }
        let transparent = match &image.texels {
            Texels::Rgba8(texels) => texels.iter().any(|texel| texel[3] != u8::MAX),
            Texels::Rgba16(texels) => texels.iter().any(|texel| texel[3] != u16::MAX),
            Texels::RgbaF32(texels) => texels.iter().any(|texel| texel[3] != 1.0),
        };
        let known = (self.scene.images.add(path.display().to_string(), image), transparent);
        self.images.insert(key, known);
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

fn encoding(from: &Parameters) -> Result<Encoding> {
    let Some((parameter, name)) = from.string("encoding")? else {
        return Ok(Encoding::Space(ColorSpace::Srgb));
    };
    let words: Vec<_> = name.split_ascii_whitespace().collect();
    match words.as_slice() {
        ["sRGB"] => return Ok(Encoding::Space(ColorSpace::Srgb)),
        ["linear"] => return Ok(Encoding::Space(ColorSpace::Linear)),
        ["gamma", gamma] => match number(gamma).map(|gamma| gamma as f32) {
            Some(gamma) if gamma > 0.0 && gamma.is_finite() => return Ok(Encoding::Gamma(gamma)),
            _ => {}
        },
        _ => {}
    }
    let rule = "\"sRGB\", \"linear\" or \"gamma\" and a number above 0";
    Err(from.refuse(parameter, format!("\"{}\"", shown(name)), rule).help("choose one of them"))
}

/// A picture of integers whose colours are powers of them; alpha is as it was. Floats are linear already.
fn without_gamma(image: Image, gamma: f32) -> Image {
    if matches!(image.texels, Texels::RgbaF32(_)) {
        return image;
    }
    let count = image.width as usize * image.height as usize;
    let texel = |i: usize| {
        let [r, g, b, a] = image.linear(i, ColorSpace::Linear);
        let [r, g, b] = [r, g, b].map(|c| c.powf(gamma));
        [r, g, b, a]
    };
    Image { texels: Texels::RgbaF32((0..count).map(texel).collect()), ..image }
}
