//! The records of shapes that a map to the world does not say all about. They lie behind the instances.

use super::{Field, Record, RecordInfo};

records! {
    /// What there is of a unit sphere, a unit disk, or a tube of radius 1 about z from 0 to 1.
    struct QuadricPart {
        /// least z; beyond the sphere when it is not cut there
        z_min: f32,
        /// greatest z
        z_max: f32,
        /// radius of the hole of a disk
        inner_radius: f32,
        /// angle about z from +x up to which it is there, turns
        turn: f32,
        /// v of the whole shape where v is 0
        v_min: f32,
        /// v of the whole shape where v is 1, less that
        v_range: f32,
        /// room
        spare: [f32; 2],
    }

    /// A bilinear patch in object space. Corners in the order p00, p10, p01, p11.
    struct BilinearPatch {
        /// corner u = 0, v = 0, divided by `size`
        p00: [f32; 3],
        /// largest coordinate of a corner, up to a factor of 2: a power of two
        size: f32,
        /// corner u = 1, v = 0, divided by `size`
        p10: [f32; 3],
        /// 1 when it has normals
        has_normals: u32,
        /// corner u = 0, v = 1, divided by `size`
        p01: [f32; 3],
        /// room
        spare01: f32,
        /// corner u = 1, v = 1, divided by `size`
        p11: [f32; 3],
        /// room
        spare11: f32,
        /// texture coordinates of p00
        uv00: [f32; 2],
        /// texture coordinates of p10
        uv10: [f32; 2],
        /// texture coordinates of p01
        uv01: [f32; 2],
        /// texture coordinates of p11
        uv11: [f32; 2],
    }

    /// Normals of the corners of a bilinear patch, behind it when it has them.
    struct PatchNormals {
        /// of p00
        n00: [f32; 3],
        /// room
        spare00: f32,
        /// of p10
        n10: [f32; 3],
        /// room
        spare10: f32,
        /// of p01
        n01: [f32; 3],
        /// room
        spare01: f32,
        /// of p11
        n11: [f32; 3],
        /// room
        spare11: f32,
    }
}
