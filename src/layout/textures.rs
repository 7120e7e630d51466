//! The records of textures that are not patterns, and of points at which the host asks for their values.

use super::{Field, Record, RecordInfo};

records! {
    /// A picture in the atlas, as a texture sees it.
    struct ImageTexture {
        /// word of its first block of texels
        base: u32,
        /// words from a row of blocks to the next
        pitch: u32,
        /// columns and rows of texels
        size: [u32; 2],
        /// uv to picture, column 0
        uv_column0: [f32; 2],
        /// uv to picture, column 1
        uv_column1: [f32; 2],
        /// uv to picture, offset
        uv_offset: [f32; 2],
        /// factor on the value
        scale: f32,
        /// FLAG_… bits, WRAP_… modes, CHANNEL_…, and the number of levels where it is filtered trilinearly
        flags: u32,
    }

    /// A level of the pyramid of a picture. All of them, the picture first, are after the ImageTexture.
    struct ImageLevel {
        /// word of its first block of texels
        base: u32,
        /// words from a row of blocks to the next
        pitch: u32,
        /// columns and rows of texels
        size: [u32; 2],
    }

    /// A volume of texels in the atlas.
    struct Stack {
        /// word of its first block of texels
        base: u32,
        /// words from a row of blocks to the next
        pitch: u32,
        /// words from a slice to the next
        slice_words: u32,
        /// as in ImageTexture
        flags: u32,
        /// columns, rows and slices
        size: [u32; 3],
        /// factor on the value
        scale: f32,
    }

    /// A mapping of textures. Rows of a 3×4 matrix.
    struct Mapping {
        /// row 0 of mapping from space
        row0: [f32; 4],
        /// row 1 of mapping from space
        row1: [f32; 4],
        /// row 2 of mapping from space
        row2: [f32; 4],
        /// u on the axis
        pole_u: f32,
        /// share of a turn over which the seam is faded
        seam_blend: f32,
        /// exponent of triplanar weights
        sharpness: f32,
        /// room
        spare: u32,
    }

    /// What a texture is made of: a constant, or another texture.
    struct TextureInput {
        /// the constant
        value: [f32; 3],
        /// word of the record of the texture
        at: u32,
    }

    /// A point at which the host asks for the value of a texture.
    struct TexturePoint {
        /// position in the world
        position: [f32; 3],
        /// width of what the value stands for, in the world; 0 = a point
        footprint: f32,
        /// position in object space
        object_position: [f32; 3],
        /// the width there
        object_footprint: f32,
        /// texture coordinates
        uv: [f32; 2],
        /// the widths in u and in v
        uv_footprint: [f32; 2],
        /// normal in the world
        normal: [f32; 3],
        /// time in the shutter interval, 0..1
        time: f32,
        /// normal in object space
        object_normal: [f32; 3],
        /// the texture
        reference: u32,
        /// second texture coordinates
        uv1: [f32; 2],
        /// the widths in these
        uv1_footprint: [f32; 2],
        /// colour of the vertices, linear, with alpha
        vertex_color: [f32; 4],
    }
}
