//! Pictures as PNG and EXR files.

use crate::scene::{Image, Texels};
use crate::{Error, Result};
use exr::prelude::{SpecificChannels, WritableImage};
use std::io::Cursor;

/// Extension and bytes of a file from which the same texels are read: PNG for 8 and 16 bits a channel, EXR for floats.
///
/// # Errors
/// What the encoders refuse, such as a picture without texels.
pub(super) fn picture(image: &Image) -> Result<(&'static str, Vec<u8>)> {
    let refused = |reason: String| {
        Error::output(format!("the picture cannot be encoded: {reason}")).help("leave it out of the scene")
    };
    let png = |depth, bytes: &[u8]| png(image, depth, bytes).map_err(|error| refused(error.to_string()));
    match &image.texels {
        Texels::Rgba8(texels) => png(png::BitDepth::Eight, texels.as_flattened()),
        Texels::Rgba16(texels) => {
            let bytes: Vec<u8> = texels.iter().flatten().flat_map(|c| c.to_be_bytes()).collect();
            png(png::BitDepth::Sixteen, &bytes)
        }
        Texels::RgbaF32(texels) => exr(image, texels).map_err(|error| refused(error.to_string())),
    }
}

fn png(
    image: &Image,
    depth: png::BitDepth,
    bytes: &[u8],
) -> Result<(&'static str, Vec<u8>), png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, image.width, image.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    Ok(("png", file))
}

fn exr(image: &Image, texels: &[[f32; 4]]) -> exr::error::Result<(&'static str, Vec<u8>)> {
    let width = image.width as usize;
    let texel = |at: exr::math::Vec2<usize>| <(f32, f32, f32, f32)>::from(texels[at.y() * width + at.x()]);
    let picture =
        exr::image::Image::from_channels((width, image.height as usize), SpecificChannels::rgba(texel));
    let mut file = Vec::new();
    picture.write().non_parallel().to_buffered(Cursor::new(&mut file))?;
    Ok(("exr", file))
}
