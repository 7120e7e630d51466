//! `ColorSpace`: what `rgb` means.

use glam::{Mat3, Vec3};

/// The primaries of colours. All of them have the white of D65.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ColorSpace {
    Srgb,
    DciP3,
    Rec2020,
}

/// By columns; from the primaries of SMPTE EG 432-1 with D65 and of ITU-R BT.2020.
const REC709_FROM_P3: Mat3 = Mat3::from_cols(
    Vec3::new(1.224_940_1, -0.042_056_9, -0.019_637_6),
    Vec3::new(-0.224_940_4, 1.042_057_1, -0.078_636_1),
    Vec3::new(0.0, 0.0, 1.098_273_5),
);
const REC709_FROM_REC2020: Mat3 = Mat3::from_cols(
    Vec3::new(1.660_491, -0.124_550_5, -0.018_150_8),
    Vec3::new(-0.587_641_1, 1.132_899_9, -0.100_578_9),
    Vec3::new(-0.072_849_9, -0.008_349_4, 1.118_729_7),
);

impl ColorSpace {
    /// A colour in the primaries that dapple renders in; those that it cannot have are cut off at 0.
    pub fn rec709(self, rgb: Vec3) -> Vec3 {
        match self {
            Self::Srgb => rgb,
            Self::DciP3 => (REC709_FROM_P3 * rgb).max(Vec3::ZERO),
            Self::Rec2020 => (REC709_FROM_REC2020 * rgb).max(Vec3::ZERO),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_in_all_of_them() {
        for space in [ColorSpace::Srgb, ColorSpace::DciP3, ColorSpace::Rec2020] {
            assert!(space.rec709(Vec3::ONE).abs_diff_eq(Vec3::ONE, 1e-5), "{space:?}");
        }
        let green = ColorSpace::Rec2020.rec709(Vec3::Y);
        assert!(green.x == 0.0 && green.y > 1.0, "{green}");
    }
}
