//! Displacement: a mesh that is cut fine and moved by a texture.

use super::{Handle, Texture};

/// Along what a mesh is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DisplacementDirection {
    /// The normal, by the mean of red, green and blue.
    Normal,
    /// The axes of object space, by red, green and blue.
    Object,
    /// ∂p/∂u, normal × ∂p/∂u and the normal, by red, green and blue.
    Tangent,
}

/// How long an edge may be before it is cut, measured before anything is moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EdgeLimit {
    /// Scene units.
    Length(f32),
    /// Pixels, as seen from the camera.
    Pixels(f32),
}

/// How a mesh is displaced: by `height` · (value − `offset`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displacement {
    /// The values.
    pub texture: Handle<Texture>,
    /// Height of a value of 1, in scene units of the nearest instance.
    pub height: f32,
    /// Value that moves nothing.
    pub offset: f32,
    /// Along what.
    pub direction: DisplacementDirection,
    /// How fine the mesh is cut.
    pub edge: EdgeLimit,
    /// Most triangles that it may be cut into.
    pub most_triangles: u32,
}

impl Displacement {
    /// Triangles that a mesh may be cut into where nothing is said: about a gigabyte with all that belongs to them.
    pub const USUAL_MOST_TRIANGLES: u32 = 4_000_000;
}
