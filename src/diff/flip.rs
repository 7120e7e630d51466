//! ꟻLIP: differences as people see them when they flip between two pictures (Andersson et al. 2020).

use super::Estimate;
use crate::film::srgb;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageFloat, FlipImageRgb8};

/// The error of each pixel, 0 (the same) to 1.
pub struct ErrorMap {
    errors: FlipImageFloat,
}

impl ErrorMap {
    /// Mean over the picture.
    pub fn mean(&self) -> f64 {
        let errors = self.errors.to_vec();
        errors.iter().map(|&e| f64::from(e)).sum::<f64>() / errors.len() as f64
    }

    /// Bytes of red, green and blue, row by row: black for 0 to light yellow for 1.
    pub fn magma(&self) -> Vec<u8> {
        self.errors.apply_color_lut(&nv_flip::magma_lut()).to_vec()
    }
}

/// The error map of two pictures of one size, as a screen shows them (sRGB, white at 1) at the distance that ꟻLIP takes by
/// default: 67 pixels a degree.
pub fn flip(reference: &Estimate, test: &Estimate) -> ErrorMap {
    let errors = nv_flip::flip(shown(reference), shown(test), DEFAULT_PIXELS_PER_DEGREE);
    ErrorMap { errors }
}

fn shown(picture: &Estimate) -> FlipImageRgb8 {
    FlipImageRgb8::with_data(picture.width as u32, picture.height as u32, &bytes(&picture.mean))
}

/// What a screen shows of linear colours.
pub(super) fn bytes(linear: &[[f64; 3]]) -> Vec<u8> {
    linear.iter().flatten().map(|&v| (255.0 * srgb(v.clamp(0.0, 1.0))).round() as u8).collect()
}
