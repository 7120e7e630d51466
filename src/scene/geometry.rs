//! Meshes, analytic shapes and their places in the world.

use super::{Handle, Material};
use glam::{Affine3A, Vec2, Vec3};
use std::ops::Range;

/// A run of triangles of a mesh that share a material.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshPart {
    /// Group or material name in the file; empty when there is none.
    pub name: String,
    /// Range in [`Mesh::triangles`].
    pub triangles: Range<u32>,
    /// Material; none = the material of the instance.
    pub material: Option<Handle<Material>>,
}

/// A triangle mesh in object space. Triangles are counter-clockwise seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Positions of the vertices.
    pub positions: Vec<Vec3>,
    /// Unit normals, one a vertex; empty = the mesh is flat.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one a vertex, v upward; empty = (0,0), (1,0), (1,1) on every triangle.
    pub uvs: Vec<Vec2>,
    /// Three vertex indices a triangle, all below `positions.len()`.
    pub triangles: Vec<[u32; 3]>,
    /// Parts that cover `triangles` without overlap, in order.
    pub parts: Vec<MeshPart>,
}

/// What a [`Shape`] is, in the object space of its transform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShapeKind {
    /// A sphere with longitude and latitude about axes of its own: u = longitude / 360° from `meridian` towards
    /// pole × meridian, v = (latitude + 90°) / 180°. At the poles u = 0.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius, above 0.
        radius: f32,
        /// Direction of the north pole (v = 1).
        pole: Vec3,
        /// Direction of longitude 0, made orthogonal to `pole`.
        meridian: Vec3,
    },
    /// A flat disk: u = angle / 360° from `meridian`, v = 1 at the centre and 0 at the rim.
    Disk {
        /// Centre.
        center: Vec3,
        /// Normal of the front.
        normal: Vec3,
        /// Radius, above 0.
        radius: f32,
        /// Direction of angle 0, made orthogonal to `normal`.
        meridian: Vec3,
    },
    /// A parallelogram: position = origin + u·edge_u + v·edge_v, front towards edge_u × edge_v.
    Quad {
        /// Corner with uv (0, 0).
        origin: Vec3,
        /// Edge along u.
        edge_u: Vec3,
        /// Edge along v.
        edge_v: Vec3,
    },
}

/// A sphere, disk or quad in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Name for messages, such as `shape 3`.
    pub name: String,
    /// Geometry.
    pub kind: ShapeKind,
    /// Material.
    pub material: Handle<Material>,
    /// Map to world space; invertible.
    pub world_from_object: Affine3A,
}

/// A mesh placed in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Name for messages, such as `instance 3`.
    pub name: String,
    /// The mesh.
    pub mesh: Handle<Mesh>,
    /// Material of the parts that have none of their own.
    pub material: Handle<Material>,
    /// Map to world space; invertible, may mirror.
    pub world_from_object: Affine3A,
}
