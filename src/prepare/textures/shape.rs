//! What a texture tree is, but for its numbers: textures of one shape share a function.

use super::mapping::MappingShape;
use crate::prepare::atlas::Format;
use crate::scene::{
    Channel, Coordinates, Gradient, Metric, NoiseSum, PatternSpace, Perlin, VeinKind, WorleyFeature,
};

/// A node of a texture tree. Its inputs are shapes with smaller numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// How its texels are kept, and whether it has a pyramid.
    Image(Format, bool),
    /// The number of its text.
    User(u32),
    Stack(Format, Coordinates),
    Constant,
    VertexColor(Channel),
    Checker(Place, u32, [Input; 2]),
    Noise(NoiseShape, Place, [Input; 2]),
    ValueNoise(u32, Place, [Input; 2]),
    Brick(Place, [Input; 2]),
    Dots(Place, [Input; 2]),
    /// The number, not the colour.
    Veins(VeinKind, Place),
    Gradient(Gradient, Place, [Input; 2]),
    Worley(WorleyFeature, Metric, Place, [Input; 2]),
    Ramp([Input; 1]),
    Spline([Input; 1]),
    Curve([Input; 1]),
    Mix([Input; 3]),
    DirectionMix([Input; 2]),
    Add([Input; 2]),
    Multiply([Input; 2]),
    Scale([Input; 2]),
    Invert([Input; 1]),
    WarpBy([Input; 2]),
    WarpNoise(Place, [Input; 1]),
    Mapped(MappingShape, [Input; 1]),
}

/// An input of a tree: a constant in its record, or a tree of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Input {
    Constant,
    Texture(u32),
}

/// What a pattern is a function of, and whether of the width of the pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    pub coordinates: Coordinates,
    pub filtered: bool,
}

/// A sum of noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NoiseShape {
    pub sum: NoiseSum,
    pub perlin: Perlin,
    /// By the sum of the amplitudes.
    pub normalized: bool,
}

impl From<&PatternSpace> for Place {
    fn from(space: &PatternSpace) -> Self {
        Self { coordinates: space.coordinates, filtered: space.filter_width > 0.0 }
    }
}

impl Shape {
    /// Whether its value depends on the width of the pixel, inputs left out.
    pub(super) fn sees_footprint(self) -> bool {
        match self {
            Self::Checker(place, ..)
            | Self::Noise(_, place, _)
            | Self::ValueNoise(_, place, _)
            | Self::Brick(place, _)
            | Self::Dots(place, _)
            | Self::Veins(_, place)
            | Self::WarpNoise(place, _) => place.filtered,
            Self::Image(_, pyramid) => pyramid,
            Self::User(_) => true,
            _ => false,
        }
    }
}
