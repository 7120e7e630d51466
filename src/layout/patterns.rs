//! The records of patterns, noise and what joins textures.

use super::{Field, Record, RecordInfo};

records! {
    /// Where a pattern is. Rows of a 3×4 matrix.
    struct Pattern {
        /// row 0 of pattern from space
        row0: [f32; 4],
        /// row 1 of pattern from space
        row1: [f32; 4],
        /// row 2 of pattern from space
        row2: [f32; 4],
        /// width of what a value stands for, in widths of the pixel
        filter_width: f32,
        /// w of noise in four dimensions, when the shutter opens
        w: f32,
        /// by how much w grows until it closes
        w_rate: f32,
        /// room
        spare: u32,
    }

    /// A sum of values on a lattice.
    struct ValueLattice {
        /// points along each axis, after which it begins again
        points: u32,
        /// amplitude of the first octave
        amplitude: f32,
        /// points in a unit, in the first octave
        frequency: f32,
        /// number of octaves
        octaves: u32,
    }

    /// A wall of bricks.
    struct Wall {
        /// length and height of a brick with its mortar
        size: [f32; 2],
        /// width of the mortar
        joint: f32,
        /// how far a row is moved against the one below, in parts of the length
        offset: f32,
    }

    /// The one number of a node of a texture tree.
    struct NodeNumber {
        /// variation of bricks, marble, wood and granite; radius of dots; amount of a warp
        number: f32,
        /// room
        spare: [u32; 3],
    }

    /// A sum of noise.
    struct NoiseSum {
        /// number of octaves
        octaves: u32,
        /// factor on the amplitude from one octave to the next
        gain: f32,
        /// factor on the frequency from one octave to the next
        lacunarity: f32,
        /// 1 / sum of the amplitudes
        scale: f32,
    }

    /// A colour map. Its input is the next word, and its stops are those after that.
    struct Ramp {
        /// number of stops
        count: u32,
        /// 1 when what is between stops follows 3t² − 2t³
        smooth_stops: u32,
        /// room
        spare: [u32; 2],
    }

    /// A stop of a colour map.
    struct RampStop {
        /// its colour
        color: [f32; 3],
        /// its place
        place: f32,
    }
}
