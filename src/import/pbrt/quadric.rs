//! Spheres, disks and cylinders about the z axis.

use super::object::Geometry;
use super::parameters::Parameters;
use super::reader::Reader;
use super::shape::Looks;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::Limits;
use crate::scene::{Mesh, ShapeKind};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

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
        let [low, high] = zs(from, -radius, radius)?.map(|z| z.clamp(-radius, radius));
        let phi = turn(from)?;
        let area = phi * radius * (high - low);
        let whole = low == -radius && high == radius && phi == TAU;
        if whole && !self.state.reverse {
            let kind = ShapeKind::Sphere { center: Vec3::ZERO, radius, pole: Vec3::Z, meridian: Vec3::X };
            return self.add_shape("sphere", Geometry::Shape(kind), area, looks);
        }
        self.unsupported(
            if whole { Unsupported::InsideOut } else { Unsupported::PartialSphere },
            &looks.spot,
        );
        let [south, north] = [low, high].map(|z| (z / radius).clamp(-1.0, 1.0).acos());
        let mesh = self.turned(phi, ROWS, |u, v| {
            let (sin, cos) = (phi * u).sin_cos();
            let (around, along) = (south + (north - south) * v).sin_cos();
            let normal = Vec3::new(around * cos, around * sin, along);
            Vertex { position: radius * normal, normal }
        });
        self.add_quadric("sphere", mesh, area, looks)
    }

    pub(super) fn cylinder(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let radius = from.float_or("radius", 1.0, Limits::Above(0.0))?;
        let [low, high] = zs(from, -1.0, 1.0)?;
        let phi = turn(from)?;
        self.unsupported(Unsupported::Cylinder, &looks.spot);
        let mesh = self.turned(phi, 1, |u, v| {
            let (sin, cos) = (phi * u).sin_cos();
            let normal = Vec3::new(cos, sin, 0.0);
            Vertex { position: (radius * normal).with_z(low + (high - low) * v), normal }
        });
        self.add_quadric("cylinder", mesh, (high - low) * radius * phi, looks)
    }

    pub(super) fn disk(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let radius = from.float_or("radius", 1.0, Limits::Above(0.0))?;
        let inner = from.float_or("innerradius", 0.0, Limits::AtLeast(0.0))?;
        let height = from.float_or("height", 0.0, Limits::Finite)?;
        let phi = turn(from)?;
        if inner >= radius {
            return Err(from
                .error("the hole of the disk is as large as the disk")
                .help("write a smaller innerradius"));
        }
        let area = 0.5 * phi * (radius * radius - inner * inner);
        let whole = inner == 0.0 && phi == TAU;
        if whole && !self.state.reverse {
            let center = Vec3::new(0.0, 0.0, height);
            let kind = ShapeKind::Disk { center, normal: Vec3::Z, radius, meridian: Vec3::X };
            return self.add_shape("disk", Geometry::Shape(kind), area, looks);
        }
        self.unsupported(if whole { Unsupported::InsideOut } else { Unsupported::PartialDisk }, &looks.spot);
        let mesh = self.turned(phi, 1, |u, v| {
            let (sin, cos) = (phi * u).sin_cos();
            let r = radius + (inner - radius) * v;
            Vertex { position: Vec3::new(r * cos, r * sin, height), normal: Vec3::Z }
        });
        self.add_quadric("disk", mesh, area, looks)
    }

    fn add_quadric(&mut self, kind: &'static str, mesh: Mesh, area: f32, looks: &Looks) -> Result<()> {
        self.made(mesh.triangles.len(), &looks.spot)?;
        let mesh = super::mesh::oriented(mesh, self.state.reverse);
        let name = format!("{kind} of {}", looks.spot.place());
        let handle = self.scene.meshes.add(name, mesh);
        self.add_shape(kind, Geometry::Mesh(handle), area, looks)
    }

    /// A surface over u and v, with u along a turn of `phi`.
    fn turned(&self, phi: f32, rows: u32, at: impl Fn(f32, f32) -> Vertex) -> Mesh {
        let columns = ((SIDES * phi / TAU).ceil() as u32).max(1);
        grid([columns, rows], |u, v| {
            let Vertex { position, normal } = at(u, v);
            (position, normal, Vec2::new(u, v))
        })
    }
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

/// Part of a whole turn, in radians.
fn turn(from: &Parameters) -> Result<f32> {
    let degrees = from.float_or("phimax", 360.0, Limits::Above(0.0))?;
    Ok(if degrees >= 360.0 { TAU } else { degrees / 180.0 * PI })
}
