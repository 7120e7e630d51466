//! Pictures with the variance of their means.

use crate::import::read_image;
use crate::scene::{ColorSpace, Image, Texels};
use crate::{Error, Result};
use exr::prelude::{FlatSamples, ReadChannels, ReadLayers};
use std::path::Path;

/// Means of the pixels, row by row from the top, and the variances of these means; red, green, blue, linear.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width · height` means.
    pub mean: Vec<[f64; 3]>,
    /// `width · height` variances of these means.
    pub variance: Vec<[f64; 3]>,
}

/// A picture from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// What the file holds; its variance is 0 where the file has none.
    pub estimate: Estimate,
    /// Whether the file has a layer `variance`.
    pub noise_is_known: bool,
}

/// Reads a picture: EXR and HDR as they are, PNG and JPEG from sRGB to linear. The variance of its means is in the layer
/// `variance` of an EXR file (channels `variance.R`, `variance.G`, `variance.B`), as dapple writes it.
///
/// # Errors
/// As [`read_image`].
pub fn read(path: &Path) -> Result<Reading> {
    let image = read_image(path)?;
    let (width, height) = (image.width as usize, image.height as usize);
    let variance = variance_layer(path, width * height)?;
    let noise_is_known = variance.is_some();
    let estimate = Estimate {
        width,
        height,
        mean: linear(&image),
        variance: variance.unwrap_or_else(|| vec![[0.0; 3]; width * height]),
    };
    Ok(Reading { estimate, noise_is_known })
}

/// Reads variances that are a picture of their own. A small negative one, which rounding makes, counts as 0.
///
/// # Errors
/// As [`read_image`].
pub fn read_variance(path: &Path) -> Result<Vec<[f64; 3]>> {
    Ok(linear(&read_image(path)?).iter().map(|pixel| pixel.map(|v| v.max(0.0))).collect())
}

fn linear(image: &Image) -> Vec<[f64; 3]> {
    let space = match image.texels {
        Texels::RgbaF32(_) => ColorSpace::Linear,
        Texels::Rgba8(_) | Texels::Rgba16(_) => ColorSpace::Srgb,
    };
    let count = image.width as usize * image.height as usize;
    (0..count).map(|i| image.linear(i, space)).map(|[r, g, b, _]| [r, g, b].map(f64::from)).collect()
}

/// The layer `variance` of an EXR file that is known to be sound; none in a file of another kind.
fn variance_layer(path: &Path, pixels: usize) -> Result<Option<Vec<[f64; 3]>>> {
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("exr")) {
        return Ok(None);
    }
    let reader = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    let image =
        reader.first_valid_layer().all_attributes().from_file(path).map_err(|error| {
            Error::scene(format!("the EXR file cannot be decoded: {error}")).in_file(path)
        })?;
    let channels = image.layer_data.channel_data.list;
    let find = |name: &str| channels.iter().find(|c| c.name == *name).map(|c| &c.sample_data);
    let [Some(r), Some(g), Some(b)] = ["variance.R", "variance.G", "variance.B"].map(find) else {
        return Ok(None);
    };
    let mut variance = vec![[0.0; 3]; pixels];
    for (c, samples) in [r, g, b].into_iter().enumerate() {
        let values = variance.iter_mut().map(|pixel| &mut pixel[c]);
        match samples {
            FlatSamples::F16(s) => values.zip(s).for_each(|(value, s)| *value = s.to_f64()),
            FlatSamples::F32(s) => values.zip(s).for_each(|(value, s)| *value = f64::from(*s)),
            FlatSamples::U32(s) => values.zip(s).for_each(|(value, s)| *value = f64::from(*s)),
        }
    }
    Ok(Some(variance))
}
