//! The table of lights: what is in it, and the time that it takes.

use super::super::{Prepared, prepare};
use crate::Result;
use crate::scene::{Emission, Instance, Material, Mesh, MeshPart, Scene, Surface, Value};
use glam::{Affine3A, Vec3};
use std::time::{Duration, Instant};

/// A mesh of separate triangles, alternately dark and bright, in `parts` parts of as many triangles each.
fn stripes(triangles: u32, parts: u32) -> Scene {
    let mut scene = Scene::default();
    let surface = Surface::diffuse(Value::Constant(Vec3::splat(0.5)));
    let dark = scene.materials.add("dark", Material::new(surface.clone(), None));
    let emission = Emission { radiance: Value::Constant(Vec3::ONE), two_sided: false };
    let bright = scene.materials.add("bright", Material::new(surface, Some(emission)));
    let each = triangles / parts;
    let part = |i: u32| MeshPart {
        name: String::new(),
        triangles: i * each..(i + 1) * each,
        material: Some(if i & 1 == 0 { dark } else { bright }),
    };
    let mesh = Mesh {
        positions: (0..triangles)
            .flat_map(|i| {
                let p = Vec3::new((i % 1000) as f32, (i / 1000) as f32, 0.0);
                [p, p + 0.5 * Vec3::X, p + 0.5 * Vec3::Y]
            })
            .collect(),
        triangles: (0..triangles).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        parts: (0..parts).map(part).collect(),
        ..Mesh::default()
    };
    let mesh = scene.meshes.add("stripes", mesh);
    let world_from_object = Affine3A::IDENTITY;
    let (name, at_close) = (String::new(), None);
    scene.instances.push(Instance { name, mesh, material: dark, world_from_object, at_close });
    scene
}

fn timed(scene: &Scene) -> Result<(Prepared, Duration)> {
    let start = Instant::now();
    prepare(scene).map(|prepared| (prepared, start.elapsed()))
}

#[test]
fn lights_of_many_parts_take_no_longer_than_those_of_two() {
    let triangles = 200_000;
    let (few, few_time) = timed(&stripes(triangles, 2)).unwrap();
    let (many, many_time) = timed(&stripes(triangles, triangles)).unwrap();
    for (prepared, each) in [(few, triangles / 2), (many, 1)] {
        assert_eq!(prepared.lights.len(), triangles as usize);
        for (i, light) in prepared.lights.iter().enumerate() {
            let bright = (i as u32 / each) % 2 == 1;
            let expected = if bright { 2.0 / triangles as f32 } else { 0.0 };
            assert!((light.chance - expected).abs() <= 1e-6 * expected, "light {i}: {}", light.chance);
        }
    }
    // Looking through all parts for every triangle would take a hundred times as long
    assert!(many_time < 8 * few_time, "{many_time:?} for {triangles} parts, {few_time:?} for 2");
}
