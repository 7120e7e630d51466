//! What the camera is inside of: paths begin in that glass.

use super::meet::{Meeting, meet};
use super::places::shape_frame;
use super::triangles::part_materials;
use crate::layout::NONE;
use crate::scene::{Handle, Instance, Material, Scene, Shape, Surface};
use glam::{Affine3A, DVec3, Vec3};
use std::collections::HashMap;

/// Direction of the line through the camera: along no edge that people would build.
const ALONG: DVec3 = DVec3::new(0.311_746_1, 0.850_650_8, 0.423_310_9);

/// Where the line meets a boundary of glass: its place on the line, and whether the line leaves the glass there.
struct Crossing {
    material: u32,
    t: f64,
    leaves: bool,
}

/// The material of the glass around the camera, or NONE in the open.
///
/// A point is inside glass when the line through it leaves that glass on both sides, so that a sheet that closes nothing has
/// no inside. Of several, one in the other, the first that is left. A lens counts by its middle.
pub(super) fn around_camera(scene: &Scene) -> u32 {
    let mut crossings = Vec::new();
    for shape in scene.shapes.iter().filter(|shape| is_glass(scene, shape.material)) {
        meet_shape(scene, shape, &mut crossings);
    }
    for instance in &scene.instances {
        meet_mesh(scene, instance, &mut crossings);
    }
    crossings.sort_by(|a, b| a.t.total_cmp(&b.t));
    let (behind, ahead) = crossings.split_at(crossings.partition_point(|crossing| crossing.t < 0.0));
    let behind = left(behind.iter().rev().map(|crossing| (crossing.material, !crossing.leaves)));
    let ahead = left(ahead.iter().map(|crossing| (crossing.material, crossing.leaves)));
    ahead.into_iter().find(|material| behind.contains(material)).unwrap_or(NONE)
}

/// Materials that a walk leaves more often than it entered them before, in that order.
fn left(walk: impl Iterator<Item = (u32, bool)>) -> Vec<u32> {
    let (mut entered, mut left) = (HashMap::new(), Vec::new());
    for (material, leaves) in walk {
        let times = entered.entry(material).or_insert(0);
        *times += if leaves { -1 } else { 1 };
        if leaves && *times == -1 {
            left.push(material);
        }
    }
    left
}

fn is_glass(scene: &Scene, material: Handle<Material>) -> bool {
    match &scene.materials[material].surface {
        Surface::Dielectric(dielectric) => !dielectric.thin,
        Surface::Principled(principled) => principled.has_inside(),
        _ => false,
    }
}

/// The line in the space of an object.
fn line(scene: &Scene, world_from_object: &Affine3A) -> (DVec3, DVec3) {
    let map = world_from_object.as_daffine3().inverse();
    (map.transform_point3(scene.camera.position.as_dvec3()), map.transform_vector3(ALONG))
}

fn meet_shape(scene: &Scene, shape: &Shape, crossings: &mut Vec<Crossing>) {
    let material = shape.material.index() as u32;
    let (o, d) = line(scene, &shape_frame(shape));
    let met = meet(&shape.kind, o, d).into_iter();
    crossings.extend(met.map(|Meeting { t, leaves }| Crossing { material, t, leaves }));
}

fn meet_mesh(scene: &Scene, instance: &Instance, crossings: &mut Vec<Crossing>) {
    let mesh = &scene.meshes[instance.mesh];
    let parts = mesh.parts.iter().filter_map(|part| part.material);
    if !parts.chain([instance.material]).any(|material| is_glass(scene, material)) {
        return;
    }
    let materials = part_materials(mesh);
    let (o, d) = line(scene, &instance.world_from_object);
    for (i, corners) in mesh.triangles.iter().enumerate() {
        let material = materials.get(i).copied().flatten().unwrap_or(instance.material);
        if let Some((t, leaves)) = meet_triangle(corners.map(|v| mesh.positions[v as usize]), o, d)
            && is_glass(scene, material)
        {
            crossings.push(Crossing { material: material.index() as u32, t, leaves });
        }
    }
}

/// Möller and Trumbore 1997.
fn meet_triangle(corners: [Vec3; 3], o: DVec3, d: DVec3) -> Option<(f64, bool)> {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    let (ab, ac, s) = (b - a, c - a, o - a);
    let p = d.cross(ac);
    let q = s.cross(ab);
    let determinant = ab.dot(p);
    let (u, v) = (s.dot(p) / determinant, d.dot(q) / determinant);
    // The determinant is less than 0 when the line goes along the normal
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| (ac.dot(q) / determinant, determinant < 0.0))
}
