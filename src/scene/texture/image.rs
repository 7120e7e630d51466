//! Pictures, and how they lie on surfaces.

use crate::scene::Handle;
use glam::{Affine2, Mat2, Vec2};
use std::sync::LazyLock;

/// How a value between texels is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TexelFilter {
    /// The texel that holds the point.
    Nearest,
    /// Bilinear between the four texels around the point; texel centres are at (i + ½) / n.
    Bilinear,
    /// Bilinear on the two levels of a pyramid of halved pictures whose texels are about as wide as the pixel, and mixed.
    Trilinear,
}

/// What lies outside [0, 1) of a texture coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The picture again.
    Repeat,
    /// The texel at the edge.
    Clamp,
    /// The picture and its mirror image in turn.
    Mirror,
    /// Zero, also in alpha.
    Black,
    /// What comes next on the sphere of an [equal-area map](crate::scene::DirectionMapping::EqualArea); along u and v alike.
    Octahedral,
}

/// How stored numbers become linear light. Alpha is always linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ColorSpace {
    /// IEC 61966-2-1.
    Srgb,
    /// As they are.
    Linear,
}

/// Which channel of a picture a texture gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The colour.
    Rgb,
    /// Red, as grey.
    R,
    /// Green, as grey.
    G,
    /// Blue, as grey.
    B,
    /// Alpha, as grey.
    A,
}

/// Scale, then rotation, then offset of texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UvTransform {
    /// Factors on u and v.
    pub scale: Vec2,
    /// Counter-clockwise rotation about (0, 0) in degrees.
    pub rotate: f32,
    /// Added last.
    pub offset: Vec2,
}

impl Default for UvTransform {
    fn default() -> Self {
        Self { scale: Vec2::ONE, rotate: 0.0, offset: Vec2::ZERO }
    }
}

impl UvTransform {
    /// The same as a matrix.
    pub fn matrix(&self) -> Affine2 {
        let linear = Mat2::from_angle(self.rotate.to_radians()) * Mat2::from_diagonal(self.scale);
        Affine2::from_mat2_translation(linear, self.offset)
    }
}

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageTexture {
    /// The picture.
    pub image: Handle<Image>,
    /// Between texels.
    pub filter: TexelFilter,
    /// Outside the picture, along u and v.
    pub wrap: [Wrap; 2],
    /// From the uv of the surface to the uv of the picture.
    pub uv: UvTransform,
    /// How the stored numbers are meant.
    pub color_space: ColorSpace,
    /// The channel that is given.
    pub channel: Channel,
    /// Factor on the value, after `invert`.
    pub scale: f32,
    /// Give 1 − value.
    pub invert: bool,
}

/// Texels as they were stored, row 0 on top. Grey is repeated in R, G, B; missing alpha is opaque.
#[derive(Debug, Clone, PartialEq)]
pub enum Texels {
    /// 8 bits a channel.
    Rgba8(Vec<[u8; 4]>),
    /// 16 bits a channel.
    Rgba16(Vec<[u16; 4]>),
    /// 32-bit floats.
    RgbaF32(Vec<[f32; 4]>),
}

/// A picture in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` texels, row by row from the top.
    pub texels: Texels,
}

impl Image {
    /// A picture without texels.
    pub const EMPTY: Self = Self { width: 0, height: 0, texels: Texels::Rgba8(Vec::new()) };

    /// The texel of an index as red, green, blue and alpha, 1 where an integer is largest. Colours of sRGB become linear; alpha
    /// is linear always.
    pub fn linear(&self, index: usize, space: ColorSpace) -> [f32; 4] {
        let [r, g, b, a] = match (&self.texels, space) {
            (Texels::Rgba8(texels), ColorSpace::Srgb) => {
                let [r, g, b, a] = texels[index];
                let [r, g, b] = [r, g, b].map(|c| SRGB[usize::from(c)]);
                return [r, g, b, f32::from(a) / 255.0];
            }
            (Texels::Rgba8(texels), ColorSpace::Linear) => texels[index].map(|c| f32::from(c) / 255.0),
            (Texels::Rgba16(texels), _) => texels[index].map(|c| f32::from(c) / 65535.0),
            (Texels::RgbaF32(texels), _) => texels[index],
        };
        match space {
            ColorSpace::Srgb => [srgb_decode(r), srgb_decode(g), srgb_decode(b), a],
            ColorSpace::Linear => [r, g, b, a],
        }
    }

    /// Whether alpha is 1 everywhere: surfaces of such a picture stop every ray.
    pub fn is_opaque(&self) -> bool {
        match &self.texels {
            Texels::Rgba8(texels) => texels.iter().all(|texel| texel[3] == u8::MAX),
            Texels::Rgba16(texels) => texels.iter().all(|texel| texel[3] == u16::MAX),
            Texels::RgbaF32(texels) => texels.iter().all(|texel| texel[3] >= 1.0),
        }
    }
}

/// What the 256 bytes of sRGB are in linear light.
static SRGB: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|c| srgb_decode(c as f32 / 255.0)));

/// IEC 61966-2-1.
fn srgb_decode(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
