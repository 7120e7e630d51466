//! Bilinear patches.

use super::object::Geometry;
use super::parameters::Parameters;
use super::quadric::grid;
use super::reader::Reader;
use super::shape::Looks;
use super::unsupported::Unsupported;
use crate::Result;
use crate::scene::{Mesh, Patch, ShapeKind};
use glam::{DAffine3, Vec2, Vec3};
use std::ops::{Add, Mul, Sub};

/// Most patches of a mesh that are shapes of their own; where there are more, they are cut into triangles, unless they are lamps.
const MOST_PATCHES: usize = 1 << 16;
/// Most cells along a side of a patch that is cut.
const MOST_CELLS: u32 = 16;
/// Triangles of all patches of a mesh that are cut.
const MOST_TRIANGLES: u32 = 1 << 21;
/// How far a corner may be from where a parallelogram has it, in parts of the sides.
const TOLERANCE: f32 = 1e-5;

/// Between the values of four corners, at (0, 0), (1, 0), (0, 1) and (1, 1).
fn bilinear<T: Copy + Add<Output = T> + Mul<f32, Output = T>>([a, b, c, d]: [T; 4], u: f32, v: f32) -> T {
    (a * (1.0 - u) + b * u) * (1.0 - v) + (c * (1.0 - u) + d * u) * v
}

impl Reader<'_> {
    pub(super) fn bilinear_mesh(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let corners = super::mesh::vertices(from)?;
        let indices = match super::mesh::indices::<4>(from, corners.positions.len())? {
            Some(indices) => indices,
            None if corners.positions.len() == 4 => vec![[0, 1, 2, 3]],
            None => return Err(from.missing("indices", super::parameter::Type::Integer)),
        };
        // Where pbrt looks for light on a patch; it changes no brightness
        if let Some((spot, path)) = from.file("emissionfilename")? {
            self.need_file(&spot, &path)?;
        }
        from.ignore(&["faceIndices"]);
        let patches =
            indices.iter().map(|at| patch(&corners, at, self.state.reverse)).filter(Patch::has_area);
        let (flat, curved): (Vec<_>, Vec<_>) =
            if self.shines() { (Vec::new(), patches.collect()) } else { patches.partition(is_parallelogram) };
        if flat.is_empty() && curved.is_empty() {
            let message = "the bilinearmesh has no patches with an area";
            return Err(looks.spot.error(message).help("move their corners apart"));
        }
        let cut = curved.len() > MOST_PATCHES && !self.shines();
        let mut mesh = Mesh::default();
        flat.iter().for_each(|patch| append(&mut mesh, in_cells(patch, 1)));
        if cut {
            self.unsupported(Unsupported::ManyPatches, &looks.spot);
            let cells = cells(curved.len());
            curved.iter().for_each(|patch| append(&mut mesh, in_cells(patch, cells)));
        }
        if !mesh.triangles.is_empty() {
            self.made(mesh.triangles.len(), &looks.spot)?;
            let mesh = super::mesh::oriented(mesh, false);
            self.add_mesh("bilinearmesh", mesh, looks)?;
        }
        for patch in curved.iter().filter(|_| !cut) {
            let area = area(patch, &self.state.maps[0]);
            self.add_shape("bilinearmesh", Geometry::Shape(ShapeKind::Patch(*patch)), area, looks)?;
        }
        Ok(())
    }

    /// Whether shapes are lamps. Each patch is one, with the power of it all, as in pbrt.
    fn shines(&self) -> bool {
        self.state.area_light.is_some() && self.objects.open.is_none()
    }
}

/// A patch whose front is that of pbrt: where the normals of its corners point, or else where u goes to v counter-clockwise; the
/// reverse of both after `ReverseOrientation`.
fn patch(mesh: &Mesh, corners: &[u32; 4], reverse: bool) -> Patch {
    let corners = corners.map(|i| i as usize);
    let mut patch = Patch::new(corners.map(|i| mesh.positions[i]));
    if !mesh.uvs.is_empty() {
        patch.uvs = corners.map(|i| mesh.uvs[i]);
    }
    if !mesh.normals.is_empty() {
        patch.normals = Some(corners.map(|i| if reverse { -mesh.normals[i] } else { mesh.normals[i] }));
    }
    let turned = match patch.normals {
        None => reverse,
        Some(normals) => normal(&patch.corners, 0.5, 0.5).dot(normals.iter().sum()) < 0.0,
    };
    if turned {
        patch.corners.swap(1, 2);
        patch.uvs.swap(1, 2);
        if let Some(normals) = &mut patch.normals {
            normals.swap(1, 2);
        }
    }
    patch
}

/// ∂p/∂u × ∂p/∂v.
fn normal([a, b, c, d]: &[Vec3; 4], u: f32, v: f32) -> Vec3 {
    ((b - a) * (1.0 - v) + (d - c) * v).cross((c - a) * (1.0 - u) + (d - b) * u)
}

/// Area in the world.
fn area(patch: &Patch, map: &DAffine3) -> f32 {
    const SIDE: u32 = 32;
    let corners = patch.corners.map(|corner| map.transform_point3(corner.as_dvec3()).as_vec3());
    let at = |i: u32| (i as f32 + 0.5) / SIDE as f32;
    let parts = (0..SIDE * SIDE).map(|i| f64::from(normal(&corners, at(i % SIDE), at(i / SIDE)).length()));
    (parts.sum::<f64>() / f64::from(SIDE * SIDE)) as f32
}

/// Cells along a side of each of so many patches.
fn cells(patches: usize) -> u32 {
    let room = MOST_TRIANGLES as usize / (2 * patches.max(1));
    (room.isqrt() as u32).clamp(1, MOST_CELLS)
}

/// Whether two triangles are the same as a patch.
fn is_parallelogram(patch: &Patch) -> bool {
    fn twist<T: Copy + Add<Output = T> + Sub<Output = T>>([a, b, c, d]: [T; 4]) -> T {
        a + d - b - c
    }
    let [a, b, c, _] = patch.corners;
    twist(patch.corners).length() <= TOLERANCE * ((b - a).length() + (c - a).length())
        && twist(patch.uvs).length() <= TOLERANCE
        && patch.normals.is_none_or(|normals| twist(normals).length() <= TOLERANCE)
}

/// A patch as so many cells along each side.
fn in_cells(patch: &Patch, cells: u32) -> Mesh {
    grid([cells, cells], |u, v| {
        let own = normal(&patch.corners, u, v);
        let normal = patch.normals.map_or(own, |normals| bilinear(normals, u, v));
        let unit = normal.try_normalize().unwrap_or(Vec3::Z);
        (bilinear(patch.corners, u, v), unit, bilinear::<Vec2>(patch.uvs, u, v))
    })
}

fn append(mesh: &mut Mesh, other: Mesh) {
    let base = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions);
    mesh.normals.extend(other.normals);
    mesh.uvs.extend(other.uvs);
    mesh.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|i| i + base)));
}
