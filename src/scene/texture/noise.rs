//! Noise, and what is made of it.

use super::{PatternSpace, Value};
use glam::Vec3;

/// Which gradients, and what is between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PerlinVariant {
    /// A few directions, and 6t⁵ − 15t⁴ + 10t³ (Perlin 2002).
    Improved,
    /// Random unit gradients, and 3t² − 2t³ (Perlin 1985).
    Classic,
    /// As improved, but for two of the 16 directions (pbrt, `util/noise.cpp`). In 3 dimensions only; in others it is improved
    /// noise.
    Pbrt,
}

/// Gradient noise: a function within −1 and 1 that is 0 at the points of the lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Perlin {
    /// Gradients.
    pub variant: PerlinVariant,
    /// 1 to 4: of x, of x and y, of x, y and z, or of these and w.
    pub dimensions: u32,
}

impl Perlin {
    /// That of pbrt.
    pub const PBRT: Self = Self { variant: PerlinVariant::Pbrt, dimensions: 3 };
}

impl Default for Perlin {
    fn default() -> Self {
        Self { variant: PerlinVariant::Improved, dimensions: 3 }
    }
}

/// How octaves of noise are summed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NoiseSum {
    /// n itself.
    Fbm,
    /// |n|: creases where the noise changes its sign (Perlin 1985).
    Turbulence,
    /// (1 − |n|)²: ridges there (after Musgrave, Texturing and Modeling, chapter 16, without weights).
    Ridged,
    /// |F(p / 10)| · F(p), with F the sum of n over 3 and over `octaves` octaves: wind over water (pbrt, `windy`).
    Windy,
}

/// Σ gainⁱ f(n(lacunarityⁱ p)) over octaves, with n the noise; divided by Σ gainⁱ, or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// n.
    pub perlin: Perlin,
    /// f.
    pub sum: NoiseSum,
    /// Number of octaves; 1 is noise alone.
    pub octaves: u32,
    /// Factor on the amplitude from one octave to the next.
    pub gain: f32,
    /// Factor on the frequency from one octave to the next.
    pub lacunarity: f32,
    /// Divide by the sum of the amplitudes. Else the sum is as it is: `low` is for 0, `high` for 1, and what is below or above goes
    /// on in a straight line.
    pub normalize: bool,
    /// w when the shutter opens, and by how much it grows until it closes.
    pub w: [f32; 2],
    /// For a sum of −1, or of 0 where no term is negative.
    pub low: Value<Vec3>,
    /// For a sum of 1.
    pub high: Value<Vec3>,
    /// Where the pattern is; a cell of the lattice of the first octave has a side of 1.
    pub space: PatternSpace,
}

impl Noise {
    /// Most octaves of a sum.
    pub const MOST_OCTAVES: u32 = 32;
    /// The lacunarity of pbrt's noise: octaves of 2 would have their zeros in one place.
    pub const PBRT_LACUNARITY: f32 = 1.99;
    /// Octaves of the waves of [`NoiseSum::Windy`] in pbrt.
    pub const WAVE_OCTAVES: u32 = 6;
}

/// The noise of the lecture: random values at the points of a lattice, 3t² − 2t³ between them, and octaves of it, each with twice
/// the frequency and half the amplitude of the one before, added.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueNoise {
    /// 1 to 3: of x, of x and y, of x, y and z.
    pub dimensions: u32,
    /// Points of the lattice along each axis, after which it begins again.
    pub length: u32,
    /// Values of the first octave are between this and its negative.
    pub amplitude: f32,
    /// Points of the lattice of the first octave in a unit.
    pub frequency: f32,
    /// How many are added.
    pub octaves: u32,
    /// For a sum of −1; what is beyond goes on in a straight line.
    pub low: Value<Vec3>,
    /// For a sum of 1.
    pub high: Value<Vec3>,
    /// Where the pattern is.
    pub space: PatternSpace,
}

/// A material that has grown or flowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum VeinKind {
    /// ½ + ½ sin(y + variation · fbm) (pbrt, `marble`).
    Marble,
    /// Rings about the z axis, bent by noise, and fibres along it.
    Wood,
    /// Turbulence.
    Granite,
}

/// How a number becomes a colour.
#[derive(Debug, Clone, PartialEq)]
pub enum Spread {
    /// By stops, as in a colour map; places grow, one at least.
    Stops(Vec<(f32, Vec3)>),
    /// Along uniform Bézier segments that overlap: for 0 to 1, segment i of n − 3 has the colours i to i + 3 (pbrt, `marble`). Four
    /// at least.
    Spline(Vec<Vec3>),
}

/// Marble, wood or granite: a number from noise, then a colour.
#[derive(Debug, Clone, PartialEq)]
pub struct Veins {
    /// Which.
    pub kind: VeinKind,
    /// Octaves of the noise.
    pub octaves: u32,
    /// Factor on the amplitude from one octave to the next.
    pub gain: f32,
    /// Factor on the frequency from one octave to the next.
    pub lacunarity: f32,
    /// How much the noise bends waves and rings; granite: factor on the sum.
    pub variation: f32,
    /// The colours.
    pub colors: Spread,
    /// Where the pattern is.
    pub space: PatternSpace,
}

impl Veins {
    /// Colours of pbrt's marble (`MarbleTexture`), with the factor that it applies.
    pub const MARBLE: [[f32; 3]; 9] = [
        [0.87, 0.87, 0.9],
        [0.87, 0.87, 0.9],
        [0.87, 0.87, 0.9],
        [0.75, 0.75, 0.75],
        [0.9, 0.885, 0.87],
        [0.87, 0.87, 0.9],
        [0.87, 0.87, 0.9],
        [0.3, 0.3, 0.495],
        [0.87, 0.87, 0.9],
    ];
}

/// A texture at points that are moved, in every space by the same numbers.
#[derive(Debug, Clone, PartialEq)]
pub enum Warp {
    /// By amount · (2 · colour − 1) of another texture.
    By {
        /// The texture.
        value: Value<Vec3>,
        /// The other.
        by: Value<Vec3>,
        /// How far.
        amount: f32,
    },
    /// By amount · three sums of noise.
    Noise {
        /// The texture.
        value: Value<Vec3>,
        /// How far.
        amount: f32,
        /// Octaves of the noise.
        octaves: u32,
        /// Factor on the amplitude from one octave to the next.
        gain: f32,
        /// Factor on the frequency from one octave to the next.
        lacunarity: f32,
        /// Where the noise is.
        space: PatternSpace,
    },
}
