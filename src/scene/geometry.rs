//! Meshes, analytic shapes and their places in the world.

use super::{Displacement, Handle, Material};
use glam::{Affine3A, Mat3A, Vec2, Vec3, Vec4};
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
    /// A second set of them; empty = as `uvs`.
    pub uvs1: Vec<Vec2>,
    /// Linear colours with alpha, one a vertex; empty = white.
    pub colors: Vec<Vec4>,
    /// Three vertex indices a triangle, all below `positions.len()`.
    pub triangles: Vec<[u32; 3]>,
    /// Parts that cover `triangles` without overlap, in order.
    pub parts: Vec<MeshPart>,
    /// How it is displaced before it is rendered.
    pub displacement: Option<Displacement>,
    /// Its vertices are on the unit sphere about the origin, and so are those that displacement adds.
    pub round: bool,
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

impl ShapeKind {
    /// From the unit sphere about the origin with its pole along +z, the unit disk in z = 0, or the unit square from the origin along
    /// x and y, to the shape.
    pub fn frame(&self) -> Affine3A {
        let around = |z: Vec3, along: Vec3, scale: f32, at: Vec3| {
            let z = z.normalize();
            let x = along.reject_from_normalized(z).normalize();
            let m = Mat3A::from_cols((x * scale).into(), (z.cross(x) * scale).into(), (z * scale).into());
            Affine3A { matrix3: m, translation: at.into() }
        };
        match *self {
            Self::Sphere { center, radius, pole, meridian } => around(pole, meridian, radius, center),
            Self::Disk { center, normal, radius, meridian } => around(normal, meridian, radius, center),
            Self::Quad { origin, edge_u, edge_v } => {
                // However long its edges are
                let normal = edge_u.as_dvec3().cross(edge_v.as_dvec3()).normalize().as_vec3();
                let matrix3 = Mat3A::from_cols(edge_u.into(), edge_v.into(), normal.into());
                Affine3A { matrix3, translation: origin.into() }
            }
        }
    }
}

impl Mesh {
    /// The unit square from the origin along x and y, as two triangles: uv = position.
    pub fn square() -> Self {
        let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        Self {
            positions: corners.iter().map(|c| c.extend(0.0)).collect(),
            uvs: corners.to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Self::default()
        }
    }

    /// The unit sphere about the origin, coarse, to be cut: longitude about +z from +x and latitude are its uv.
    pub fn unit_sphere() -> Self {
        const COLUMNS: u32 = 8;
        const ROWS: u32 = 4;
        let mut mesh = Self { round: true, ..Self::default() };
        for row in 0..=ROWS {
            for column in 0..=COLUMNS {
                // A pole has a vertex for each column, in its middle
                let pole = row == 0 || row == ROWS;
                let turn = (column as f32 + if pole { 0.5 } else { 0.0 }) / COLUMNS as f32;
                let v = row as f32 / ROWS as f32;
                let (sin, cos) = (std::f32::consts::PI * (v - 0.5)).sin_cos();
                // The last column is where the first is
                let (y, x) = (std::f32::consts::TAU * (column % COLUMNS) as f32 / COLUMNS as f32).sin_cos();
                let around = if pole { 0.0 } else { cos };
                mesh.positions.push(Vec3::new(around * x, around * y, if pole { sin.signum() } else { sin }));
                mesh.uvs.push(Vec2::new(turn, v));
            }
        }
        mesh.normals.clone_from(&mesh.positions);
        let at = |row: u32, column: u32| row * (COLUMNS + 1) + column;
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let [a, b] = [at(row, column), at(row, column + 1)];
                let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
                // Next to a pole one of both has no area
                if row > 0 {
                    mesh.triangles.push([a, b, if row + 1 < ROWS { d } else { c }]);
                }
                if row + 1 < ROWS {
                    mesh.triangles.push([a, d, c]);
                }
            }
        }
        mesh
    }
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
    /// Map to world space; invertible. When the shutter opens, if it moves.
    pub world_from_object: Affine3A,
    /// Map to world space when the shutter closes, which mirrors as the other does; none = it does not move.
    pub at_close: Option<Affine3A>,
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
    /// Map to world space; invertible, may mirror. When the shutter opens, if it moves.
    pub world_from_object: Affine3A,
    /// Map to world space when the shutter closes, which mirrors as the other does; none = it does not move.
    pub at_close: Option<Affine3A>,
}
