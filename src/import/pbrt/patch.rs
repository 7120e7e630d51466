//! Bilinear patches.

use super::parameters::Parameters;
use super::quadric::grid;
use super::reader::Reader;
use super::shape::Looks;
use super::unsupported::Unsupported;
use crate::Result;
use crate::scene::Mesh;
use glam::{Vec2, Vec3};
use std::ops::{Add, Mul};

/// Most cells along a side of a patch that is no parallelogram.
const MOST_CELLS: u32 = 16;
/// Triangles of all patches of a mesh.
const MOST_TRIANGLES: u32 = 1 << 21;
/// How far a corner may be from where a parallelogram has it, in parts of the sides.
const TOLERANCE: f32 = 1e-5;

/// Between the values of four corners, at (0, 0), (1, 0), (0, 1) and (1, 1).
fn bilinear<T: Copy + Add<Output = T> + Mul<f32, Output = T>>([a, b, c, d]: [T; 4], u: f32, v: f32) -> T {
    (a * (1.0 - u) + b * u) * (1.0 - v) + (c * (1.0 - u) + d * u) * v
}

impl Reader<'_> {
    pub(super) fn bilinear_mesh(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let flat = super::mesh::vertices(from)?;
        let patches = match super::mesh::indices::<4>(from, flat.positions.len())? {
            Some(patches) => patches,
            None if flat.positions.len() == 4 => vec![[0, 1, 2, 3]],
            None => return Err(from.missing("indices", super::parameter::Type::Integer)),
        };
        if let Some((spot, path)) = from.file("emissionfilename")? {
            self.need_file(&spot, &path)?;
            self.unsupported(Unsupported::EmissionImage, &looks.spot);
        }
        from.ignore(&["faceIndices"]);
        let curved: Vec<bool> = patches.iter().map(|patch| !is_parallelogram(&flat, patch)).collect();
        let count = curved.iter().filter(|curved| **curved).count();
        if count > 0 {
            self.unsupported(Unsupported::BilinearPatch, &looks.spot);
        }
        let cells = cells(count);
        let mut mesh = Mesh::default();
        for (patch, curved) in patches.iter().zip(&curved) {
            append(&mut mesh, cut(&flat, patch, if *curved { cells } else { 1 }));
        }
        self.made(mesh.triangles.len(), &looks.spot)?;
        if flat.normals.is_empty() && count == 0 {
            mesh.normals.clear();
        }
        let mesh = super::mesh::oriented(mesh, self.state.reverse);
        self.add_mesh("bilinearmesh", mesh, looks)
    }
}

/// Cells along a side of each of so many patches.
fn cells(patches: usize) -> u32 {
    let room = MOST_TRIANGLES as usize / (2 * patches.max(1));
    (room.isqrt() as u32).clamp(1, MOST_CELLS)
}

fn is_parallelogram(mesh: &Mesh, patch: &[u32; 4]) -> bool {
    let [a, b, c, d] = patch.map(|i| mesh.positions[i as usize]);
    let even = (a + d - b - c).length() <= TOLERANCE * ((b - a).length() + (c - a).length());
    let uv = patch.map(|i| mesh.uvs.get(i as usize).copied());
    let flat = match uv {
        [Some(a), Some(b), Some(c), Some(d)] => (a + d - b - c).length() <= TOLERANCE,
        _ => true,
    };
    even && flat
}

/// A patch as so many cells along each side.
fn cut(mesh: &Mesh, patch: &[u32; 4], cells: u32) -> Mesh {
    let corners = patch.map(|i| mesh.positions[i as usize]);
    let usual = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
    let uvs = [0, 1, 2, 3].map(|i| mesh.uvs.get(patch[i] as usize).copied().unwrap_or(usual[i]));
    let normals = patch.map(|i| mesh.normals.get(i as usize).copied());
    let [a, b, c, d] = corners;
    grid([cells, cells], |u, v| {
        let own = ((b - a) * (1.0 - v) + (d - c) * v).cross((c - a) * (1.0 - u) + (d - b) * u);
        let normal = match normals {
            [Some(a), Some(b), Some(c), Some(d)] => bilinear([a, b, c, d], u, v),
            _ => own,
        };
        (bilinear(corners, u, v), normal.try_normalize().unwrap_or(Vec3::Z), bilinear(uvs, u, v))
    })
}

fn append(mesh: &mut Mesh, other: Mesh) {
    let base = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions);
    mesh.normals.extend(other.normals);
    mesh.uvs.extend(other.uvs);
    mesh.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|i| i + base)));
}
