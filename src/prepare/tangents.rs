//! Tangents of meshes for normal maps.

use crate::scene::{Handle, Material, Mesh, Scene, Tangents};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::Vec3;

/// Tangents of the corners of triangles, and the side on which the bitangent is: 1 or −1 times normal × tangent.
pub(super) type CornerTangents = Vec<[(Vec3, f32); 3]>;

/// Tangents by MikkTSpace (Mikkelsen 2008), when a mesh has uv and is placed with a normal map that wants them.
pub(super) fn of(
    scene: &Scene,
    mesh: &Mesh,
    placed_with: impl IntoIterator<Item = Handle<Material>>,
) -> Option<CornerTangents> {
    let wants = |material: Handle<Material>| {
        let map = scene.materials[material].detail.normal_map;
        map.is_some_and(|map| map.tangents == Tangents::MikkTSpace)
    };
    let parts = mesh.parts.iter().filter_map(|part| part.material);
    if mesh.uvs.is_empty() || !parts.chain(placed_with).any(wants) {
        return None;
    }
    let mut corners = Corners { mesh, tangents: vec![[(Vec3::ZERO, 1.0); 3]; mesh.triangles.len()] };
    // The error has no cases
    generate_tangents(&mut corners).ok()?;
    Some(corners.tangents)
}

struct Corners<'a> {
    mesh: &'a Mesh,
    tangents: CornerTangents,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.triangles[face][corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, corner)].to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        let flat = || {
            let [a, b, c] = [0, 1, 2].map(|corner| self.mesh.positions[self.vertex(face, corner)].as_dvec3());
            (b - a).cross(c - a).normalize_or_zero().as_vec3()
        };
        self.mesh.normals.get(self.vertex(face, corner)).copied().unwrap_or_else(flat).to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.mesh.uvs[self.vertex(face, corner)].to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some([x, y, z, side]) = space.map(|space| space.tangent_encoded()) {
            self.tangents[face][corner] = (Vec3::new(x, y, z), side);
        }
    }
}
