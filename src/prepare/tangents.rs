//! Tangents of meshes for normal maps.

use super::details::is_on_uv1;
use super::triangles::part_materials;
use crate::scene::{Handle, Material, Mesh, Scene, Tangents};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Vec2, Vec3};

/// Tangents of the corners of triangles, and the side on which the bitangent is: 1 or −1 times normal × tangent.
pub(super) type CornerTangents = Vec<[(Vec3, f32); 3]>;

/// Tangents of the vertices, or else by MikkTSpace (Mikkelsen 2008), when a mesh has uv and is placed with a normal map that wants
/// them. The latter are those of the set of texture coordinates by which the map is placed: that of the material of a triangle, or of
/// the first that it is placed with.
pub(super) fn of(
    scene: &Scene,
    mesh: &Mesh,
    placed_with: impl IntoIterator<Item = Handle<Material>>,
) -> Option<CornerTangents> {
    let uvs = |material: Handle<Material>| {
        let map = scene.materials[material].detail.normal_map?;
        let second = !mesh.uvs1.is_empty() && is_on_uv1(scene, map.texture);
        let uvs = if second { &mesh.uvs1 } else { &mesh.uvs };
        (map.tangents == Tangents::MikkTSpace && !uvs.is_empty()).then_some(uvs.as_slice())
    };
    let rest = placed_with.into_iter().find_map(uvs);
    let parts = mesh.parts.iter().filter_map(|part| part.material);
    let any = rest.or(parts.into_iter().find_map(uvs))?;
    if mesh.tangents.len() == mesh.positions.len() {
        let given = |corner: u32| mesh.tangents[corner as usize];
        return Some(mesh.triangles.iter().map(|t| t.map(given).map(|t| (t.truncate(), t.w))).collect());
    }
    let own = part_materials(mesh);
    let of = |i: usize| own.get(i).copied().flatten().map_or(rest, uvs).unwrap_or(any);
    let uvs = (0..mesh.triangles.len()).map(of).collect();
    let mut corners = Corners { mesh, uvs, tangents: vec![[(Vec3::ZERO, 1.0); 3]; mesh.triangles.len()] };
    // The error has no cases
    generate_tangents(&mut corners).ok()?;
    Some(corners.tangents)
}

struct Corners<'a> {
    mesh: &'a Mesh,
    /// Those of the vertices, for each triangle.
    uvs: Vec<&'a [Vec2]>,
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
        self.uvs[face][self.vertex(face, corner)].to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some([x, y, z, side]) = space.map(|space| space.tangent_encoded()) {
            self.tangents[face][corner] = (Vec3::new(x, y, z), side);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{NormalMap, Surface, Texture, Value};
    use glam::{Vec2, Vec4};

    #[test]
    fn tangents_of_the_vertices_come_before_those_of_mikktspace() {
        let mut scene = Scene::default();
        let texture = scene.textures.add("flat", Texture::Constant(Vec3::ONE));
        let map = NormalMap { texture, green_down: false, strength: 1.0, tangents: Tangents::MikkTSpace };
        let mut material = Material::new(Surface::diffuse(Value::Constant(Vec3::ONE)), None);
        material.detail.normal_map = Some(map);
        let material = scene.materials.add("bumpy", material);
        let mut mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        assert_eq!(of(&scene, &mesh, [material]).unwrap(), [[(Vec3::X, 1.0); 3]]);
        mesh.tangents = vec![Vec4::new(0.0, 1.0, 0.0, -1.0); 3];
        assert_eq!(of(&scene, &mesh, [material]).unwrap(), [[(Vec3::Y, -1.0); 3]]);
    }
}
