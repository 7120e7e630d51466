//! What patterns are functions of, and of what kind.

use super::Value;
use glam::{Affine3A, Vec2, Vec3};

/// The coordinates that a pattern is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// u, v and 0.
    Uv,
    /// Position in the object space of the shape or instance. On spheres and disks that is where their radius is 1.
    Object,
    /// Position in the world.
    World,
}

/// Where a pattern is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternSpace {
    /// What it is a function of.
    pub coordinates: Coordinates,
    /// From these to those of the pattern.
    pub pattern_from_space: Affine3A,
    /// How wide the part of the pattern is that a value stands for, in widths of the pixel: finer parts fade out; 0 keeps all.
    pub filter_width: f32,
}

impl PatternSpace {
    /// The coordinates themselves, filtered over the width of a pixel.
    pub fn new(coordinates: Coordinates) -> Self {
        Self { coordinates, pattern_from_space: Affine3A::IDENTITY, filter_width: 1.0 }
    }
}

/// A distance to scattered points, of those in the 27 cells around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum WorleyFeature {
    /// To the nearest.
    F1,
    /// To the one after the nearest.
    F2,
    /// The difference of both: 0 where two cells meet.
    Difference,
    /// To the plane between the nearest and another, where two cells meet. Euclidean only.
    Edge,
}

/// How a distance is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Metric {
    /// √(x² + y² + z²).
    Euclidean,
    /// |x| + |y| + |z|.
    Manhattan,
    /// The largest of |x|, |y| and |z|.
    Chebyshev,
}

/// The distance of a gradient.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Gradient {
    /// x.
    Linear,
    /// From the z axis.
    Cylindrical,
    /// From the origin.
    Spherical,
}

/// A wall of bricks in rows along x. A brick with its part of the mortar is one cell of the wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Brick {
    /// Of the bricks.
    pub brick: Value<Vec3>,
    /// Between them.
    pub mortar: Value<Vec3>,
    /// Length and height of a cell.
    pub size: Vec2,
    /// Width of the mortar.
    pub joint: f32,
    /// How far a row is moved against the one below, in parts of a cell.
    pub offset: f32,
    /// Bricks are lighter and darker by up to this part.
    pub variation: f32,
    /// Where the pattern is.
    pub space: PatternSpace,
}

impl Brick {
    /// The colour of clay, of bricks for which a scene says none.
    pub const CLAY: Vec3 = Vec3::new(0.42, 0.13, 0.07);
    /// The colour of lime, of their mortar.
    pub const LIME: Vec3 = Vec3::new(0.55, 0.52, 0.47);
}

/// Disks in about every other unit square of x and y, each somewhere inside its square (pbrt, `dots`).
#[derive(Debug, Clone, PartialEq)]
pub struct Dots {
    /// Of the disks.
    pub inside: Value<Vec3>,
    /// Between them.
    pub outside: Value<Vec3>,
    /// Of a disk, at most ½.
    pub radius: f32,
    /// Where the pattern is.
    pub space: PatternSpace,
}
