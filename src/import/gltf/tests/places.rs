//! Nodes, cameras, lights and instances: where they are.

use super::*;
use crate::scene::{Light, Projection};
use glam::{Quat, Vec3};
use std::f32::consts::FRAC_PI_2;

#[track_caller]
fn near(found: Vec3, expected: Vec3) {
    assert!(found.distance(expected) < 1e-5, "{found}, expected {expected}");
}

#[test]
fn nodes_are_placed_in_their_parents() {
    let mut maker = Maker::triangle();
    // Node 1 holds node 2, which holds node 0; node 1 turns x to y, node 2 is a matrix that moves by x = 2 and doubles
    let turn = Quat::from_rotation_z(FRAC_PI_2).to_array();
    maker.add("nodes", json!({ "children": [2], "rotation": turn, "translation": [10, 0, 0] }));
    let matrix = [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 1];
    maker.add("nodes", json!({ "children": [0], "matrix": matrix }));
    maker.root["nodes"][0]["scale"] = json!([3, 1, 1]);
    maker.root["scenes"][0]["nodes"] = json!([1]);
    let (_, model) = maker.read().unwrap();
    let map = model.instances[0].world_from_object;
    near(map.transform_point3(Vec3::X), Vec3::new(10.0, 8.0, 0.0));
    near(map.transform_point3(Vec3::Y), Vec3::new(8.0, 2.0, 0.0));
}

#[test]
fn one_scene_is_shown_the_one_that_the_file_says() {
    let mut maker = Maker::triangle();
    maker.add("nodes", json!({ "mesh": 0, "name": "second" }));
    maker.add("scenes", json!({ "nodes": [1] }));
    let shown =
        |maker: &Maker| maker.read().unwrap().1.instances.iter().map(|i| i.name.clone()).collect::<Vec<_>>();
    assert_eq!(shown(&maker), ["node 0"]);
    maker.root.insert("scene".into(), json!(1));
    assert_eq!(shown(&maker), ["second"]);
    maker.root.remove("scene");
    maker.root.remove("scenes");
    assert_eq!(shown(&maker), ["node 0", "second"]);
    // Both show the same mesh
    let (scene, model) = maker.read().unwrap();
    assert_eq!(model.instances[0].mesh, model.instances[1].mesh);
    assert_eq!(scene.meshes.len(), 1);
}

#[test]
fn nodes_that_are_no_trees_are_refused() {
    let mut maker = Maker::triangle();
    maker.add("nodes", json!({ "children": [2] }));
    maker.add("nodes", json!({ "children": [1] }));
    assert_eq!(maker.error(), "/nodes/1: the node is its own ancestor, or below one that is");
    maker.root["nodes"][1]["children"] = json!([0]);
    maker.root["nodes"][2]["children"] = json!([0]);
    assert_eq!(maker.error(), "/nodes/2: node 0 is a child of node 1 and of node 2");
    maker.root["nodes"][2]["children"] = json!([9]);
    assert_eq!(maker.error(), "/nodes/2/children/0: there is no /nodes/9, the file has 3");
}

#[test]
fn a_chain_of_many_nodes_needs_no_stack() {
    let mut maker = Maker::triangle();
    for i in 1..20_000 {
        maker.add("nodes", json!({ "children": [i - 1], "translation": [1, 0, 0] }));
    }
    maker.root["scenes"][0]["nodes"] = json!([19_999]);
    let (_, model) = maker.read().unwrap();
    near(model.instances[0].world_from_object.transform_point3(Vec3::ZERO), Vec3::X * 19_999.0);
}

#[test]
fn a_node_without_volume_is_left_out_with_a_warning() {
    let mut maker = Maker::triangle();
    maker.add("nodes", json!({ "mesh": 0, "scale": [1, 0, 1] }));
    maker.root["scenes"][0]["nodes"] = json!([0, 1]);
    let (_, model) = maker.read().unwrap();
    assert_eq!(model.instances.len(), 1);
    assert_eq!(model.warnings, ["/nodes/1: the node has no volume, and what it holds is left out"]);
}

#[test]
fn cameras_look_along_minus_z_of_their_nodes() {
    let mut maker = Maker::triangle();
    maker.add(
        "cameras",
        json!({ "type": "perspective", "perspective": { "yfov": 1.0, "aspectRatio": 1.5, "znear": 1 } }),
    );
    maker.add("cameras", json!({ "name": "plan", "type": "orthographic", "orthographic": { "xmag": 3, "ymag": 2, "znear": 0, "zfar": 9 } }));
    maker.add("nodes", json!({ "camera": 0, "translation": [1, 2, 3] }));
    maker.add(
        "nodes",
        json!({ "camera": 1, "rotation": Quat::from_rotation_x(-FRAC_PI_2).to_array(), "scale": [2, 2, 2] }),
    );
    maker.root["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let (_, model) = maker.read().unwrap();
    let [first, plan] = &model.cameras[..] else { panic!("{:?}", model.cameras) };
    assert_eq!((first.name.as_str(), first.aspect, plan.aspect), ("camera 0", Some(1.5), Some(1.5)));
    near(first.camera.position, Vec3::new(1.0, 2.0, 3.0));
    let map = first.camera.world_from_camera();
    near(map.transform_vector3(-Vec3::Z), -Vec3::Z);
    near(map.transform_vector3(Vec3::Y), Vec3::Y);
    let Projection::Perspective(view) = &first.camera.projection else { panic!() };
    assert!((view.fov - 1.0_f32.to_degrees()).abs() < 1e-4);
    // From above, with −z at the top of the picture
    let map = plan.camera.world_from_camera();
    near(map.transform_vector3(-Vec3::Z), -Vec3::Y);
    near(map.transform_vector3(Vec3::Y), -Vec3::Z);
    assert!(matches!(plan.camera.projection, Projection::Orthographic { size: 4.0, .. }));
    // By name, by number, and none
    assert_eq!(model.camera(None).unwrap().unwrap().name, "camera 0");
    assert_eq!(model.camera(Some("plan")).unwrap().unwrap().name, "plan");
    assert_eq!(model.camera(Some("1")).unwrap().unwrap().name, "plan");
    let error = model.camera(Some("2")).unwrap_err();
    assert_eq!(error.to_string(), "the model has no camera \"2\"; there are \"camera 0\", \"plan\"");
}

#[test]
fn lights_shine_along_minus_z_of_their_nodes() {
    let mut maker = Maker::triangle();
    let lights = json!([
        { "type": "point", "intensity": 5, "color": [1, 0.5, 0] },
        { "type": "directional", "intensity": 3 },
        { "type": "spot", "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
        { "type": "spot", "spot": {} },
    ]);
    maker.root.insert("extensions".into(), json!({ "KHR_lights_punctual": { "lights": lights } }));
    for light in 0..4 {
        let turn = Quat::from_rotation_y(FRAC_PI_2).to_array();
        let extensions = json!({ "KHR_lights_punctual": { "light": light } });
        let node = maker
            .add("nodes", json!({ "translation": [0, 7, 0], "rotation": turn, "extensions": extensions }));
        maker.root["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    let (_, model) = maker.read().unwrap();
    let (position, forward) = (Vec3::Y * 7.0, -Vec3::X);
    assert_eq!(model.lights[0], Light::point(position, Vec3::new(5.0, 2.5, 0.0)));
    assert_eq!(model.lights[1].kind, crate::scene::LightKind::distant(0.0));
    near(-model.lights[1].world_from_light.z_axis, forward);
    assert_eq!(model.lights[1].intensity, crate::scene::Value::Constant(Vec3::splat(3.0)));
    for (light, outer, edge) in
        [(&model.lights[2], 0.5_f32, 0.25_f32), (&model.lights[3], 45_f32.to_radians(), 45_f32.to_radians())]
    {
        let crate::scene::LightKind::Punctual(spot) = light.kind else { panic!("{light:?}") };
        let [cone_angle, falloff_angle, ..] = spot.numbers;
        near(-light.world_from_light.z_axis, forward);
        assert_eq!(light.intensity, crate::scene::Value::Constant(Vec3::ONE));
        assert!(
            (cone_angle - outer.to_degrees()).abs() < 1e-4
                && (falloff_angle - edge.to_degrees()).abs() < 1e-4
        );
    }
    maker.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = json!(4);
    assert!(
        maker.error().starts_with("/nodes/1/extensions/KHR_lights_punctual/light: there is no "),
        "{}",
        maker.error()
    );
}

#[test]
fn instances_of_a_node_are_placed_in_it() {
    let mut maker = Maker::triangle();
    let translation = maker.floats(&[[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]]);
    let scale = maker.floats(&[[1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]);
    // 90° about z in normalised bytes: (0, 0, √½, √½)
    let rotation = maker.accessor("VEC4", 5120, 2, &[0, 0, 0, 127, 0, 0, 90, 90]);
    maker.root["accessors"][rotation]["normalized"] = json!(true);
    maker.root["nodes"][0]["translation"] = json!([0, 0, 3]);
    maker.root["nodes"][0]["extensions"] = json!({
        "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale } },
    });
    let (_, model) = maker.read().unwrap();
    let at = |i: usize, p: Vec3| model.instances[i].world_from_object.transform_point3(p);
    assert_eq!(model.instances.len(), 2);
    near(at(0, Vec3::X), Vec3::new(1.0, 0.0, 3.0));
    near(at(1, Vec3::X), Vec3::new(5.0, 2.0, 3.0));
}

#[test]
fn a_model_can_be_one_mesh_with_named_parts() {
    let mut maker = Maker::with_material(json!({ "name": "steel" }));
    maker.add("nodes", json!({ "mesh": 0, "translation": [0, 0, 4], "scale": [-1, 1, 1] }));
    maker.root["scenes"][0]["nodes"] = json!([0, 1]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.glb");
    std::fs::write(&path, maker.glb()).unwrap();
    let mesh = crate::import::read_mesh(&path).unwrap();
    assert_eq!(mesh.positions[4], Vec3::new(-1.0, 0.0, 4.0));
    // The mirrored one is turned round, so that its front stays its front
    assert_eq!(mesh.triangles, [[0, 1, 2], [3, 5, 4]]);
    let parts: Vec<_> =
        mesh.parts.iter().map(|part| (part.name.as_str(), part.triangles.clone(), part.material)).collect();
    assert_eq!(parts, [("steel", 0..1, None), ("steel", 1..2, None)]);
}
