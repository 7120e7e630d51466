//! The scenes of the benchmark, made from formulas.

use super::blob;
use dapple::scene::{
    Camera, Conductor, Dielectric, Emission, Environment, Film, Fresnel, Handle, Instance, Material,
    Projection, Render, Roughness, Scene, Shape, ShapeKind, Surface, Value,
};
use glam::{Affine3A, Quat, Vec3};

/// Name of a scene, and how to make it.
type Named = (&'static str, fn() -> Scene);

/// All scenes.
pub(super) const ALL: [Named; 3] = [("blob", blob_scene), ("glass", glass_scene), ("forest", forest_scene)];

/// One large flat mesh over a ground under a square light and a constant sky, diffuse, five events a path: the scene
/// that `--write-scene` writes.
pub(super) fn blob_scene() -> Scene {
    let mut scene = room(5);
    let clay = diffuse(&mut scene, "blob", Vec3::new(0.6, 0.5, 0.4));
    let mesh = scene.meshes.add("blob", blob::mesh(7));
    scene.instances.push(Instance {
        name: "blob".into(),
        mesh,
        material: clay,
        world_from_object: Affine3A::IDENTITY,
        at_close: None,
    });
    scene
}

/// Spheres of glass, metal and clay: branching materials, long paths.
fn glass_scene() -> Scene {
    let mut scene = room(10);
    let glass = scene.materials.add(
        "glass",
        Material::new(
            Surface::Dielectric(Dielectric {
                ior: Value::Constant(1.5),
                roughness: Roughness::alpha(0.0),
                abbe: None,
                absorption: Vec3::new(0.1, 0.3, 0.6),
                thin: false,
            }),
            None,
        ),
    );
    let metal = scene.materials.add(
        "metal",
        Material::new(
            Surface::Conductor(Conductor {
                reflectance: Value::Constant(Vec3::new(0.9, 0.8, 0.6)),
                fresnel: Fresnel::Exact,
                roughness: Roughness::alpha(0.15),
            }),
            None,
        ),
    );
    let clay = diffuse(&mut scene, "clay", Vec3::new(0.3, 0.5, 0.6));
    for i in 0..5 {
        for j in 0..5 {
            let center = Vec3::new(0.75 * (i as f32 - 2.0), -0.95, 0.75 * (j as f32 - 2.0));
            let kind = ShapeKind::Sphere { center, radius: 0.3, pole: Vec3::Y, meridian: Vec3::X };
            let material = [glass, metal, clay][(i + 2 * j) % 3];
            scene.shapes.push(shape(kind, material));
        }
    }
    scene
}

/// A thousand turned and scaled copies of a small blob: two levels of trees.
fn forest_scene() -> Scene {
    let mut scene = room(5);
    let leaf = diffuse(&mut scene, "leaf", Vec3::new(0.3, 0.5, 0.2));
    let mesh = scene.meshes.add("blob", blob::mesh(5));
    for i in 0..1000_u32 {
        // A lattice of golden angles on the ground.
        let (turn, radius) = (2.399_963_2 * i as f32, 0.19 * (i as f32).sqrt());
        let at = Vec3::new(radius * turn.cos(), -1.1, radius * turn.sin());
        let rotation = Quat::from_rotation_y(1.7 * i as f32);
        scene.instances.push(Instance {
            name: format!("copy {i}"),
            mesh,
            material: leaf,
            world_from_object: Affine3A::from_scale_rotation_translation(
                Vec3::splat(0.09 + 0.05 * (i % 7) as f32 / 7.0),
                rotation,
                at,
            ),
            at_close: None,
        });
    }
    scene
}

/// Camera, ground, light and sky that all scenes share.
fn room(max_depth: u32) -> Scene {
    let mut scene = Scene {
        film: Film { width: 512, height: 512, ..Film::default() },
        render: Render { spp: 16, max_depth, russian_roulette: false, ..Render::default() },
        camera: Camera {
            position: Vec3::new(0.0, 1.2, 4.2),
            target: Vec3::new(0.0, -0.1, 0.0),
            projection: Projection::pinhole(45.0),
            ..Camera::default()
        },
        environment: Some(Environment::new(Value::Constant(Vec3::new(0.4, 0.45, 0.5)))),
        ..Scene::default()
    };
    let ground = diffuse(&mut scene, "ground", Vec3::splat(0.5));
    let lamp = scene.materials.add(
        "lamp",
        Material::new(
            Surface::diffuse(Value::Constant(Vec3::ZERO)),
            Some(Emission { radiance: Value::Constant(Vec3::new(12.0, 12.0, 11.0)), two_sided: false }),
        ),
    );
    let quad = |origin, edge_u, edge_v| ShapeKind::Quad { origin, edge_u, edge_v };
    let floor = quad(Vec3::new(-8.0, -1.25, 8.0), Vec3::X * 16.0, Vec3::NEG_Z * 16.0);
    let square = quad(Vec3::new(-1.0, 3.5, 0.0), Vec3::X * 2.0, Vec3::Z * 2.0);
    scene.shapes = vec![shape(floor, ground), shape(square, lamp)];
    scene
}

fn shape(kind: ShapeKind, material: Handle<Material>) -> Shape {
    Shape { name: "shape".into(), kind, material, world_from_object: Affine3A::IDENTITY, at_close: None }
}

fn diffuse(scene: &mut Scene, name: &str, color: Vec3) -> Handle<Material> {
    let surface = Surface::diffuse(Value::Constant(color));
    scene.materials.add(name, Material::new(surface, None))
}
