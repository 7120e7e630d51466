//! What only textures ask of the corners of triangles: colours, and a second set of texture coordinates.

use super::{Features, Prepared};
use crate::layout::{CornerColors, CornerUvs, Face, NONE, Record as _};
use crate::scene::Mesh;
use glam::{Vec2, Vec4};

/// Whether a mesh has something of it that a scene uses.
pub(super) fn has(mesh: &Mesh, features: &Features) -> bool {
    features.vertex_color && !mesh.colors.is_empty() || features.uv1 && !mesh.uvs1.is_empty()
}

/// The words of a triangle, whose corners are taken in an order; what the mesh has none of is as it is without.
pub(super) fn words(
    mesh: &Mesh,
    triangle: usize,
    order: [usize; 3],
    features: &Features,
) -> impl Iterator<Item = [u32; 4]> {
    let corners = order.map(|k| (k, mesh.triangles[triangle][k] as usize));
    let color = |(_, v): (usize, usize)| mesh.colors.get(v).copied().unwrap_or(Vec4::ONE).to_array();
    let default = [Vec2::ZERO, Vec2::X, Vec2::ONE];
    let uv = |(k, v): (usize, usize)| {
        let own = mesh.uvs1.get(v).or(mesh.uvs.get(v)).copied();
        own.unwrap_or(default[k]).to_array()
    };
    let colors = features.vertex_color.then(|| {
        let [a, b, c] = corners.map(color);
        bytemuck::cast::<_, [[u32; 4]; 3]>(CornerColors { a, b, c })
    });
    let uvs = features.uv1.then(|| {
        let [a, b, c] = corners.map(uv);
        bytemuck::cast::<_, [[u32; 4]; 2]>(CornerUvs { a, b, c, spare: [0.0; 2] })
    });
    colors.into_iter().flatten().chain(uvs.into_iter().flatten())
}

/// Moves the words of faces to where they are once all of them are behind the faces.
pub(super) fn put_behind_faces(out: &mut Prepared) {
    let behind = out.faces.len() as u32 * Face::WORDS;
    for face in out.faces.iter_mut().filter(|face| face.extra != NONE) {
        face.extra += behind;
    }
}
