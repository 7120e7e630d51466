//! Volumes from slices.

use super::{Channel, ColorSpace, Image, PatternSpace, Wrap};
use crate::scene::Handle;

/// A volume of texels that fills the unit cube. Centres of texels are at (i + ½) / n along each axis.
#[derive(Debug, Clone, PartialEq)]
pub struct StackTexture {
    /// Slices of one size across z, by growing z. The columns of a slice are along x, its lowest row is at y = 0.
    pub slices: Vec<Handle<Image>>,
    /// Whether values between texels are trilinear; else they are those of the nearest texel.
    pub smooth: bool,
    /// Outside the cube, along x, y and z.
    pub wrap: [Wrap; 3],
    /// Where the cube is.
    pub space: PatternSpace,
    /// How the stored numbers are meant.
    pub color_space: ColorSpace,
    /// The channel that is given.
    pub channel: Channel,
    /// Factor on the value, after `invert`.
    pub scale: f32,
    /// Give 1 − value.
    pub invert: bool,
}
