//! What patterns are functions of, and of what kind.

use super::Value;
use glam::{Affine3A, Vec3};

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

/// How octaves of noise are summed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NoiseSum {
    /// n itself.
    Fbm,
    /// |n|: creases where the noise changes its sign (Perlin 1985).
    Turbulence,
}

/// Σ gainⁱ n(lacunarityⁱ p) / Σ gainⁱ over octaves, with n the improved noise (Perlin 2002), which is within −1 and 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// What is summed.
    pub sum: NoiseSum,
    /// Number of octaves; 1 is noise alone.
    pub octaves: u32,
    /// Factor on the amplitude from one octave to the next.
    pub gain: f32,
    /// Factor on the frequency from one octave to the next.
    pub lacunarity: f32,
    /// For a sum of −1, or of 0 where absolute values are summed.
    pub low: Value<Vec3>,
    /// For a sum of 1.
    pub high: Value<Vec3>,
    /// Where the pattern is; a cell of the lattice of the first octave has a side of 1.
    pub space: PatternSpace,
}
