//! Mappings: where a surface point is in a picture, other than by the uv of the surface.

use glam::Affine3A;

/// How a point becomes texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MappingKind {
    /// Those of the surface.
    Uv,
    /// The second set of the surface, or the first where it has no second.
    Uv1,
    /// Longitude about z from x in turns, and latitude: 0 at −z, 1 at +z.
    Spherical,
    /// Longitude, and z.
    Cylindrical,
    /// x and y.
    Planar,
    /// From the origin onto the six faces of a cube, a whole picture on each.
    Cube,
    /// Along each axis on a plane across it, mixed by how much the surface faces each.
    Triplanar,
}

/// The space that is mapped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MappingSpace {
    /// Object space of the shape or instance.
    Object,
    /// The world.
    World,
}

/// Texture coordinates in place of those of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mapping {
    /// How.
    pub kind: MappingKind,
    /// Of what.
    pub space: MappingSpace,
    /// From there to where the kind is defined.
    pub mapping_from_space: Affine3A,
    /// u where longitude has none, on the axis of a spherical or cylindrical kind.
    pub pole_u: f32,
    /// Share of a turn over which the end of a picture that holds 1 and this share of turns is faded into its beginning.
    pub seam_blend: f32,
    /// Exponent of the weights of a triplanar kind: 1 is softest.
    pub sharpness: f32,
}

impl Mapping {
    /// In object space, as it is there, without a faded seam and with weights of a middle sharpness.
    pub fn new(kind: MappingKind) -> Self {
        Self {
            kind,
            space: MappingSpace::Object,
            mapping_from_space: Affine3A::IDENTITY,
            pole_u: 0.0,
            seam_blend: 0.0,
            sharpness: 4.0,
        }
    }
}
