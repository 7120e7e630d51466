//! Meshes to records of triangles, with the shading data of their vertices.

use super::details;
use super::tangents::{self, CornerTangents};
use super::{Prepared, corners};
use crate::layout::{Face, NONE, Triangle, Vertex};
use crate::scene::{Handle, Material, Mesh, Scene};
use glam::{Affine3A, Mat3A, Vec2, Vec3};

/// What triangles are made of beside their mesh.
#[derive(Default)]
pub(super) struct Extras {
    /// Marks of the triangles; empty when none has one.
    pub marks: Vec<u32>,
    /// Tangents of the corners, where a normal map wants them.
    pub tangents: Option<CornerTangents>,
}

impl Extras {
    /// What a mesh needs that is placed with some materials.
    pub fn of(
        scene: &Scene,
        mesh: &Mesh,
        placed_with: impl IntoIterator<Item = Handle<Material>> + Clone,
    ) -> Self {
        Self {
            marks: details::marks(scene, mesh, placed_with.clone()),
            tangents: tangents::of(scene, mesh, placed_with),
        }
    }
}

/// The triangles of a mesh as records, with their vertices. Gives the first of their faces, or NONE. `instance` is set for
/// what is put into world space; a map that mirrors turns the triangles round, so that they stay counter-clockwise from
/// outside.
pub(super) fn push_triangles(
    mesh: &Mesh,
    map: &Affine3A,
    instance: Option<u32>,
    extras: &Extras,
    out: &mut Prepared,
    triangles: &mut Vec<Triangle>,
) -> u32 {
    let mirrored = mirrors(map);
    let has_extra = corners::has(mesh, &out.features);
    let has_vertices = has_extra || !mesh.normals.is_empty() || !mesh.uvs.is_empty();
    let (first_face, first_vertex) = (out.faces.len() as u32, out.vertices.len() as u32);
    if has_vertices {
        push_vertices(mesh, map, extras.tangents.as_ref(), out);
    }
    let materials = part_materials(mesh);
    triangles.reserve(mesh.triangles.len());
    for (i, vertices) in mesh.triangles.iter().enumerate() {
        let order = if mirrored { [0, 2, 1] } else { [0, 1, 2] };
        let [a, b, c] = order.map(|k| vertices[k]);
        let position = |v: u32| map.transform_point3(mesh.positions[v as usize]).to_array();
        if has_vertices {
            // With tangents each corner has a vertex of its own
            let vertices = match extras.tangents {
                Some(_) => order.map(|k| (3 * i + k) as u32),
                None => [a, b, c],
            };
            let extra = if has_extra { out.corners.len() as u32 } else { NONE };
            if has_extra {
                out.corners.extend(corners::words(mesh, i, order, &out.features));
            }
            out.faces.push(Face { vertices: vertices.map(|v| first_vertex + v), extra });
        }
        let mark = extras.marks.get(i).copied().unwrap_or(0);
        triangles.push(Triangle {
            a: position(a),
            instance: instance.unwrap_or(NONE),
            b: position(b),
            material: materials.get(i).copied().flatten().map_or(NONE, |material| material.index() as u32),
            c: position(c),
            primitive: i as u32 | mark,
        });
    }
    if has_vertices { first_face } else { NONE }
}

/// Shading data of the vertices, or of the corners of triangles when they have tangents.
fn push_vertices(mesh: &Mesh, map: &Affine3A, tangents: Option<&CornerTangents>, out: &mut Prepared) {
    let normal_map = normal_map(map);
    let vertex = |v: usize, tangent: Vec3| {
        let normal = mesh.normals.get(v).map_or(Vec3::ZERO, |n| normal_map * *n);
        let uv = mesh.uvs.get(v).copied().unwrap_or(Vec2::ZERO);
        Vertex { normal: normal.into(), u: uv.x, v: uv.y, tangent: tangent.into() }
    };
    let Some(tangents) = tangents else {
        return out.vertices.extend((0..mesh.positions.len()).map(|v| vertex(v, Vec3::ZERO)));
    };
    let side_of_map = if mirrors(map) { -1.0 } else { 1.0 };
    let corners = mesh.triangles.iter().flatten().zip(tangents.iter().flatten());
    out.vertices.extend(corners.map(|(v, (tangent, side))| {
        let tangent = map.transform_vector3(*tangent).normalize_or_zero();
        vertex(*v as usize, if side * side_of_map < 0.0 { 2.0 * tangent } else { tangent })
    }));
}

/// The map of normals, up to a factor that is the same for all: normals are interpolated before they get unit length, so
/// that a mesh put into world space looks like one that is mapped by the kernels.
fn normal_map(map: &Affine3A) -> Mat3A {
    let m = map.as_daffine3().matrix3.inverse().transpose();
    let longest = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
    let m = if longest > 0.0 { m * (1.0 / longest) } else { m };
    Mat3A::from_cols(m.x_axis.as_vec3a(), m.y_axis.as_vec3a(), m.z_axis.as_vec3a())
}

/// Material of each triangle, none for that of the instance; empty when no part has one of its own.
pub(super) fn part_materials(mesh: &Mesh) -> Vec<Option<Handle<Material>>> {
    if mesh.parts.iter().all(|part| part.material.is_none()) {
        return Vec::new();
    }
    let mut materials = vec![None; mesh.triangles.len()];
    for part in &mesh.parts {
        if let Some(slots) = materials.get_mut(part.triangles.start as usize..part.triangles.end as usize) {
            slots.fill(part.material);
        }
    }
    materials
}

/// Whether a map mirrors.
pub(super) fn mirrors(map: &Affine3A) -> bool {
    map.as_daffine3().matrix3.determinant() < 0.0
}
