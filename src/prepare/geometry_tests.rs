//! The stack that `prepare` promises is enough for every way through the trees, and an edit builds those again that it touches.

use super::super::wide::child;
use super::super::{Prepared, Trees, prepare, prepare_again};
use crate::layout::{LEAF, LEAF_FIRST_MASK, LEAF_INSTANCE, NONE, Node};
use crate::scene::{Environment, Instance, Material, Mesh, Scene, Surface, Value};
use glam::{Affine3A, Vec3};
use proptest::prelude::*;

/// Most entries, with `kept` on the stack, that `geometry/traverse.glsl` keeps below a reference.
fn written(prepared: &Prepared, reference: u32, kept: u32) -> u32 {
    if reference == NONE || reference & LEAF != 0 && reference & LEAF_INSTANCE == 0 {
        return kept;
    }
    let item = prepared.tree[(reference & LEAF_FIRST_MASK) as usize];
    if reference & LEAF != 0 {
        let instance = &prepared.instances[item[0][0] as usize];
        return if instance.root == NONE { kept } else { written(prepared, instance.root, kept + 1) };
    }
    let node: Node = bytemuck::cast(item);
    let children = (0..4).filter_map(|i| child(&node, i));
    let others = children.clone().count() as u32 - 1;
    children.map(|child| written(prepared, child, kept + others)).max().unwrap_or(kept)
}

/// `copies` instances of a mesh of `triangles` triangles, and with `soup` a mesh that is placed once.
fn scene(triangles: u32, copies: u32, soup: bool) -> Scene {
    let mut scene = Scene::default();
    let surface = Surface::diffuse(Value::Constant(Vec3::splat(0.5)));
    let material = scene.materials.add("grey", Material::new(surface, None));
    let mesh = |count: u32| Mesh {
        positions: (0..count)
            .flat_map(|i| {
                let p = Vec3::new((i % 7) as f32, (i / 7) as f32, (i % 3) as f32);
                [p, p + 0.4 * Vec3::X, p + 0.4 * Vec3::Y]
            })
            .collect(),
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    };
    let shared = scene.meshes.add("shared", mesh(triangles));
    for i in 0..copies {
        // Each is as far again as all before: the tree over them is as deep as it can be
        let world_from_object = Affine3A::from_translation(Vec3::X * 1.5_f32.powi(i as i32));
        scene.instances.push(Instance {
            name: String::new(),
            mesh: shared,
            material,
            world_from_object,
            at_close: None,
        });
    }
    if soup {
        let once = scene.meshes.add("once", mesh(5));
        scene.instances.push(Instance {
            name: String::new(),
            mesh: once,
            material,
            world_from_object: Affine3A::IDENTITY,
            at_close: None,
        });
    }
    scene
}

proptest! {
    #[test]
    fn the_stack_holds_what_traversal_keeps(triangles in 1..60_u32, copies in 1..60_u32, soup: bool) {
        let prepared = prepare(&scene(triangles, copies, soup))?;
        let most = written(&prepared, prepared.root, 1);
        prop_assert!(most <= prepared.stack_entries, "{most} entries, {} promised", prepared.stack_entries);
    }
}

#[test]
fn an_edit_builds_again_only_the_trees_that_it_touches() {
    let mut trees = Trees::kept();
    let mut before = scene(50, 3, true);
    // The shared mesh, the soup, and the tree over instances
    let mut built = |scene: &Scene| {
        let prepared = prepare_again(scene, &mut trees).unwrap();
        assert_eq!(prepared, prepare(scene).unwrap());
        trees.built()
    };
    assert_eq!(built(&before), 3);
    assert_eq!(built(&before), 0);
    before.camera.position.x += 1.0;
    let grey = before.instances[0].material;
    before.materials[grey].surface = Surface::diffuse(Value::Constant(Vec3::splat(0.2)));
    before.environment = Some(Environment::new(Value::Constant(Vec3::ONE)));
    assert_eq!(built(&before), 0);
    before.instances[0].world_from_object.translation.y += 1.0;
    assert_eq!(built(&before), 1, "that over instances");
    let shared = before.instances[0].mesh;
    before.meshes[shared].positions[0].x -= 0.1;
    assert_eq!(built(&before), 2, "its own and that over instances");
}
