//! Spheres, disks and cylinders about the z axis.

use super::object::Geometry;
use super::parameters::Parameters;
use super::reader::Reader;
use super::shape::Looks;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::Limits;
use crate::scene::{Extent, Mesh, Quadric, ShapeKind};
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Sides of a whole turn of a mesh; they leave out 8e-5 of the radius.
const SIDES: f32 = 256.0;
/// Rows of a mesh of a sphere from pole to pole.
const ROWS: u32 = 128;

/// A vertex of a mesh at u and v.
struct Vertex {
    position: Vec3,
    normal: Vec3,
}

impl Reader<'_> {
    pub(super) fn sphere(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let radius = from.float_or("radius", 1.0, Limits::Above(0.0))?;
        let [z_min, z_max] = zs(from, -radius, radius)?.map(|z| z.clamp(-radius, radius));
        if z_min == z_max {
            return Err(from.error("zmin and zmax leave nothing of the sphere").help("move them apart"));
        }
        let phi_max = turn(from)?;
        let sphere = if phi_max == 360.0 && z_min == -radius && z_max == radius {
            ShapeKind::Sphere { center: Vec3::ZERO, radius, pole: Vec3::Z, meridian: Vec3::X }
        } else {
            part(Extent::Sphere { z_min, z_max }, 0.0, radius, phi_max)
        };
        let phi = phi_max.to_radians();
        let area = phi * radius * (z_max - z_min);
        self.add_quadric("sphere", sphere, area, looks, || {
            let [south, north] = [z_min, z_max].map(|z| (z / radius).clamp(-1.0, 1.0).acos());
            turned(phi, ROWS, |u, v| {
                let (sin, cos) = (phi * u).sin_cos();
                let (around, along) = (south + (north - south) * v).sin_cos();
                let normal = Vec3::new(around * cos, around * sin, along);
                Vertex { position: radius * normal, normal }
            })
        })
    }

    pub(super) fn cylinder(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let radius = from.float_or("radius", 1.0, Limits::Above(0.0))?;
        let [z_min, z_max] = zs(from, -1.0, 1.0)?;
        let phi_max = turn(from)?;
        let phi = phi_max.to_radians();
        let cylinder = part(Extent::Cylinder { z_min, z_max }, 0.0, radius, phi_max);
        let area = (z_max - z_min) * radius * phi;
        self.add_quadric("cylinder", cylinder, area, looks, || {
            turned(phi, 1, |u, v| {
                let (sin, cos) = (phi * u).sin_cos();
                let normal = Vec3::new(cos, sin, 0.0);
                Vertex { position: (radius * normal).with_z(z_min + (z_max - z_min) * v), normal }
            })
        })
    }

    pub(super) fn disk(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let radius = from.float_or("radius", 1.0, Limits::Above(0.0))?;
        let inner_radius = from.float_or("innerradius", 0.0, Limits::AtLeast(0.0))?;
        let height = from.float_or("height", 0.0, Limits::Finite)?;
        let phi_max = turn(from)?;
        if inner_radius >= radius {
            return Err(from
                .error("the hole of the disk is as large as the disk")
                .help("write a smaller innerradius"));
        }
        let disk = if inner_radius == 0.0 && phi_max == 360.0 {
            let center = Vec3::new(0.0, 0.0, height);
            ShapeKind::Disk { center, normal: Vec3::Z, radius, meridian: Vec3::X }
        } else {
            part(Extent::Disk { inner_radius }, height, radius, phi_max)
        };
        let phi = phi_max.to_radians();
        let area = 0.5 * phi * (radius * radius - inner_radius * inner_radius);
        self.add_quadric("disk", disk, area, looks, || {
            turned(phi, 1, |u, v| {
                let (sin, cos) = (phi * u).sin_cos();
                let r = radius + (inner_radius - radius) * v;
                Vertex { position: Vec3::new(r * cos, r * sin, height), normal: Vec3::Z }
            })
        })
    }

    /// Adds a quadric, or a mesh of it where its front is inside.
    fn add_quadric(
        &mut self,
        kind: &'static str,
        shape: ShapeKind,
        area: f32,
        looks: &Looks,
        mesh: impl FnOnce() -> Mesh,
    ) -> Result<()> {
        if !self.inside_out() {
            return self.add_shape(kind, Geometry::Shape(shape), area, looks);
        }
        self.unsupported(Unsupported::InsideOut, &looks.spot);
        let mesh = super::mesh::oriented(mesh(), true);
        self.made(mesh.triangles.len(), &looks.spot)?;
        let name = looks.spot.name(kind);
        let handle = self.scene.meshes.add(name, mesh);
        self.add_shape(kind, Geometry::Mesh(handle), area, looks)
    }

    /// Whether the front of a quadric is where its back would be: after `ReverseOrientation`, or when its transform mirrors it, but
    /// not after both. pbrt does not count the transform of what moves.
    fn inside_out(&self) -> bool {
        let [open, close] = self.state.maps;
        self.state.reverse != (open == close && open.matrix3.determinant() < 0.0)
    }
}

/// A surface over u and v, with u along a turn of `phi`.
fn turned(phi: f32, rows: u32, at: impl Fn(f32, f32) -> Vertex) -> Mesh {
    let columns = ((SIDES * phi / TAU).ceil() as u32).max(1);
    grid([columns, rows], |u, v| {
        let Vertex { position, normal } = at(u, v);
        (position, normal, Vec2::new(u, v))
    })
}

/// A quadric about the z axis, at a height.
fn part(extent: Extent, height: f32, radius: f32, phi_max: f32) -> ShapeKind {
    let center = Vec3::new(0.0, 0.0, height);
    ShapeKind::Quadric(Quadric { extent, center, radius, axis: Vec3::Z, meridian: Vec3::X, phi_max })
}

/// A surface over u and v from 0 to 1, with normals and texture coordinates. Its front is where ∂p/∂u × ∂p/∂v points.
pub(super) fn grid([columns, rows]: [u32; 2], at: impl Fn(f32, f32) -> (Vec3, Vec3, Vec2)) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let (position, normal, uv) = at(column as f32 / columns as f32, row as f32 / rows as f32);
            mesh.positions.push(position);
            mesh.normals.push(normal);
            mesh.uvs.push(uv);
        }
    }
    let index = |row: u32, column: u32| row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [index(row, column), index(row, column + 1)];
            let [c, d] = [index(row + 1, column), index(row + 1, column + 1)];
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    mesh
}

/// Ends along z, the lower first.
fn zs(from: &Parameters, low: f32, high: f32) -> Result<[f32; 2]> {
    let [a, b] = [from.float_or("zmin", low, Limits::Finite)?, from.float_or("zmax", high, Limits::Finite)?];
    if a == b {
        return Err(from.error("zmin and zmax are the same").help("write a larger zmax"));
    }
    Ok([a.min(b), a.max(b)])
}

/// Part of a whole turn, in degrees.
fn turn(from: &Parameters) -> Result<f32> {
    Ok(from.float_or("phimax", 360.0, Limits::Above(0.0))?.min(360.0))
}
