//! A whole model as one mesh, whose parts have the names of its materials.

use super::{ModelChoice, read_model};
use crate::scene::{Mesh, MeshPart, Scene};
use crate::{Error, Result};
use glam::{Vec2, Vec3, Vec4};
use std::path::Path;

/// Most triangles of a mesh that is joined: instances are stored one by one.
const MOST_TRIANGLES: usize = 1 << 24;

/// Reads a `.gltf` or `.glb` file as a mesh in the space of the model: all that its scene places, without animation.
///
/// # Errors
/// All errors of [`crate::import::read_model`], and a model of more than 2²⁴ triangles.
pub fn read_gltf_mesh(path: &Path) -> Result<Mesh> {
    let mut scene = Scene::default();
    let model = read_model(path, &ModelChoice::default(), &mut scene)?;
    let placed =
        |list: fn(&Mesh) -> usize| model.instances.iter().map(|i| list(&scene.meshes[i.mesh])).sum::<usize>();
    if placed(|mesh| mesh.triangles.len()) > MOST_TRIANGLES {
        let message =
            format!("the model has more than {MOST_TRIANGLES} triangles, with its instances one by one");
        return Err(Error::scene(message).help("place it as an [[instance]] with `file`").in_file(path));
    }
    // A mesh has each attribute everywhere or nowhere
    let any = |has: fn(&Mesh) -> bool| model.instances.iter().any(|i| has(&scene.meshes[i.mesh]));
    let (normals, colors) = (any(|mesh| !mesh.normals.is_empty()), any(|mesh| !mesh.colors.is_empty()));
    let uvs1 = any(|mesh| !mesh.uvs1.is_empty());
    let uvs = uvs1 || any(|mesh| !mesh.uvs.is_empty());
    let mut whole = Mesh::default();
    for instance in &model.instances {
        let mesh = &scene.meshes[instance.mesh];
        let map = instance.world_from_object;
        let mirrored = map.matrix3.determinant() < 0.0;
        let first = whole.positions.len() as u32;
        // A vertex of its own for each corner where the triangles must bring along what they lack
        let flat = (normals && mesh.normals.is_empty()) || (uvs && mesh.uvs.is_empty());
        let vertices: Vec<usize> = if flat {
            mesh.triangles.iter().flatten().map(|corner| *corner as usize).collect()
        } else {
            (0..mesh.positions.len()).collect()
        };
        whole.positions.extend(vertices.iter().map(|v| map.transform_point3(mesh.positions[*v])));
        let normal_map = map.matrix3.inverse().transpose();
        if normals {
            whole.normals.extend(vertices.iter().enumerate().map(|(i, v)| match mesh.normals.get(*v) {
                Some(normal) => (normal_map * *normal).normalize_or_zero(),
                None => normal_map * flat_normal(mesh, i / 3),
            }));
        }
        const CORNERS: [Vec2; 3] = [Vec2::ZERO, Vec2::X, Vec2::ONE];
        let uv = |i: usize, v: usize| mesh.uvs.get(v).copied().unwrap_or(CORNERS[i % 3]);
        if uvs {
            whole.uvs.extend(vertices.iter().enumerate().map(|(i, v)| uv(i, *v)));
        }
        if uvs1 {
            let second = |(i, v): (usize, &usize)| mesh.uvs1.get(*v).copied().unwrap_or_else(|| uv(i, *v));
            whole.uvs1.extend(vertices.iter().enumerate().map(second));
        }
        if colors {
            whole.colors.extend(vertices.iter().map(|v| mesh.colors.get(*v).copied().unwrap_or(Vec4::ONE)));
        }
        let start = whole.triangles.len() as u32;
        whole.triangles.extend(mesh.triangles.iter().enumerate().map(|(i, corners)| {
            let [a, b, c] = if flat { [0, 1, 2].map(|k| (3 * i + k) as u32) } else { *corners };
            let turned = if mirrored { [a, c, b] } else { [a, b, c] };
            turned.map(|corner| first + corner)
        }));
        whole.parts.extend(mesh.parts.iter().map(|part| MeshPart {
            name: part.name.clone(),
            triangles: start + part.triangles.start..start + part.triangles.end,
            material: None,
        }));
    }
    crate::import::mesh::normalize_normals(&mut whole);
    Ok(whole)
}

fn flat_normal(mesh: &Mesh, triangle: usize) -> Vec3 {
    let [a, b, c] = mesh.triangles[triangle].map(|corner| mesh.positions[corner as usize]);
    (b - a).cross(c - a)
}
