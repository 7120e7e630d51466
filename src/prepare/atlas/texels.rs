//! How texels are kept in words, and how they are read from pictures.

use crate::layout::{TEXELS_RGBA8, TEXELS_RGBA8_SRGB, TEXELS_RGBA16F, TEXELS_RGBA32F};
use crate::scene::{ColorSpace, Image, Texels};
use half::f16;

/// How texels are kept: what the kernels call `TEXELS_…`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// 2×2 texels a word, linear.
    Rgba8,
    /// 2×2 texels a word, sRGB.
    Rgba8Srgb,
    /// 2×1 texels a word.
    Rgba16F,
    /// 1 texel a word.
    RgbaF32,
}

impl Format {
    /// 8 bits stay as they are; halves where they hold every texel exactly; else floats.
    pub(super) fn of(image: &Image, space: ColorSpace) -> Self {
        match (&image.texels, space) {
            (Texels::Rgba8(_), ColorSpace::Linear) => Self::Rgba8,
            (Texels::Rgba8(_), ColorSpace::Srgb) => Self::Rgba8Srgb,
            (Texels::RgbaF32(texels), ColorSpace::Linear) if texels.iter().flatten().all(is_half) => {
                Self::Rgba16F
            }
            _ => Self::RgbaF32,
        }
    }

    /// That of the levels of a pyramid above a picture: bytes would show as bands, and a mean of halves is a half.
    pub(super) fn coarse(self) -> Self {
        match self {
            Self::Rgba8 | Self::Rgba8Srgb | Self::Rgba16F => Self::Rgba16F,
            Self::RgbaF32 => Self::RgbaF32,
        }
    }

    /// Its number in the kernels.
    pub(in crate::prepare) fn number(self) -> u32 {
        match self {
            Self::Rgba8 => TEXELS_RGBA8,
            Self::Rgba8Srgb => TEXELS_RGBA8_SRGB,
            Self::Rgba16F => TEXELS_RGBA16F,
            Self::RgbaF32 => TEXELS_RGBA32F,
        }
    }

    /// Columns and rows of words of a picture.
    pub(super) fn words(self, size: [u32; 2]) -> [u32; 2] {
        let block = match self {
            Self::Rgba8 | Self::Rgba8Srgb => [2, 2],
            Self::Rgba16F => [2, 1],
            Self::RgbaF32 => [1, 1],
        };
        [size[0].div_ceil(block[0]).max(1), size[1].div_ceil(block[1]).max(1)]
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "called by Iterator::all on references")]
fn is_half(x: &f32) -> bool {
    f16::from_f32(*x).to_f32() == *x
}

/// Reads texels as the kernels shall see them.
pub(in crate::prepare) struct Reader<'a> {
    pub image: &'a Image,
    pub decode: bool,
}

impl Reader<'_> {
    /// The word of a column and row of words.
    pub(super) fn word(&self, format: Format, x: u32, y: u32) -> [u32; 4] {
        match format {
            Format::Rgba8 | Format::Rgba8Srgb => [[0, 0], [1, 0], [0, 1], [1, 1]]
                .map(|[i, j]| u32::from_le_bytes(self.bytes(2 * x + i, 2 * y + j))),
            Format::Rgba16F => {
                let pair = |a: f32, b: f32| {
                    u32::from(f16::from_f32(a).to_bits()) | u32::from(f16::from_f32(b).to_bits()) << 16
                };
                let ([r, g, b, a], [s, h, c, d]) = (self.linear(2 * x, y), self.linear(2 * x + 1, y));
                [pair(r, g), pair(b, a), pair(s, h), pair(c, d)]
            }
            Format::RgbaF32 => self.linear(x, y).map(f32::to_bits),
        }
    }

    /// Index of a texel; those past the edge of a block are the edge again.
    fn index(&self, x: u32, y: u32) -> usize {
        let (x, y) = (x.min(self.image.width - 1), y.min(self.image.height - 1));
        y as usize * self.image.width as usize + x as usize
    }

    fn bytes(&self, x: u32, y: u32) -> [u8; 4] {
        match &self.image.texels {
            Texels::Rgba8(texels) => texels[self.index(x, y)],
            _ => [0; 4],
        }
    }

    /// A texel as linear light; alpha is linear always.
    pub(in crate::prepare) fn linear(&self, x: u32, y: u32) -> [f32; 4] {
        let space = if self.decode { ColorSpace::Srgb } else { ColorSpace::Linear };
        self.image.linear(self.index(x, y), space)
    }
}
