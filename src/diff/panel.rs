//! Reference, picture and difference side by side, for people to look at.

use super::Estimate;
use super::flip::{ErrorMap, bytes};
use crate::film::write_bytes;
use crate::{Error, Result};
use image::{ColorType, ImageEncoder, codecs::png::PngEncoder};
use std::path::Path;

/// Writes a PNG in sRGB: the reference on the left, the picture in the middle, the error map on the right. All are of one size.
///
/// # Errors
/// When the file cannot be written.
pub fn write_panel(path: &Path, reference: &Estimate, test: &Estimate, errors: &ErrorMap) -> Result<()> {
    let parts = [bytes(&reference.mean), bytes(&test.mean), errors.magma()];
    let (row, rows) = (3 * reference.width, 0..reference.height);
    let joined: Vec<u8> =
        rows.flat_map(|y| parts.iter().flat_map(move |part| &part[y * row..][..row])).copied().collect();
    let (width, height) = (3 * reference.width as u32, reference.height as u32);
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(&joined, width, height, ColorType::Rgb8.into())
        .map_err(|error| Error::output(format!("the picture cannot be encoded: {error}")).in_file(path))?;
    write_bytes(path, file)
}
