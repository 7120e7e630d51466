//! Animations, morph targets and skins, with known places at a time.

use super::*;
use glam::{Quat, Vec2, Vec3, Vec4};
use std::f32::consts::FRAC_PI_2;

/// A triangle whose node is animated along one path.
fn animated<const N: usize>(path: &str, interpolation: &str, times: &[f32], values: &[[f32; N]]) -> Maker {
    let mut maker = Maker::triangle();
    let times: Vec<[f32; 1]> = times.iter().map(|time| [*time]).collect();
    let (input, output) = (maker.floats(&times), maker.floats(values));
    maker.add(
        "animations",
        json!({
            "samplers": [{ "input": input, "output": output, "interpolation": interpolation }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": path } }],
        }),
    );
    maker
}

/// Where the node puts a point.
fn place(read: &(Scene, Model), point: Vec3) -> Vec3 {
    read.1.instances[0].world_from_object.transform_point3(point)
}

#[track_caller]
fn near(found: Vec3, expected: Vec3) {
    assert!(found.distance(expected) < 1e-5, "{found}, expected {expected}");
}

#[test]
fn translations_are_interpolated_held_and_clamped() {
    let values = [[0.0, 0.0, 0.0], [2.0, 4.0, 0.0]];
    let linear = animated("translation", "LINEAR", &[1.0, 3.0], &values);
    for (time, x) in [(0.0, 0.0), (1.0, 0.0), (1.5, 0.5), (3.0, 2.0), (9.0, 2.0)] {
        near(place(&linear.at(time), Vec3::ZERO), Vec3::new(x, 2.0 * x, 0.0));
    }
    let step = animated("translation", "STEP", &[1.0, 3.0], &values);
    near(place(&step.at(2.9), Vec3::ZERO), Vec3::ZERO);
    near(place(&step.at(3.0), Vec3::ZERO), Vec3::new(2.0, 4.0, 0.0));
    // Without a time nothing is animated
    assert_eq!(place(&linear.read().unwrap(), Vec3::X), Vec3::X);
}

#[test]
fn cubic_splines_are_those_of_hermite() {
    // From 0 with a slope of 2 to 1 with a slope of −4, in two seconds: at the middle ½·0 + ½·1 + 2·(2 − (−4))/8
    let values =
        [[9.0, 0.0, 0.0], [0.0; 3], [2.0, 0.0, 0.0], [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0], [9.0, 0.0, 0.0]];
    let cubic = animated("translation", "CUBICSPLINE", &[0.0, 2.0], &values);
    near(place(&cubic.at(1.0), Vec3::ZERO), Vec3::X * 2.0);
    near(place(&cubic.at(0.0), Vec3::ZERO), Vec3::ZERO);
    near(place(&cubic.at(2.0), Vec3::ZERO), Vec3::X);
}

#[test]
fn rotations_turn_steadily_the_shorter_way() {
    let quarter = Quat::from_rotation_z(FRAC_PI_2);
    // The other of the two quaternions of that rotation
    let turned = (-quarter).to_array();
    let maker = animated("rotation", "LINEAR", &[0.0, 3.0], &[Quat::IDENTITY.to_array(), turned]);
    let (sin, cos) = (FRAC_PI_2 / 3.0).sin_cos();
    near(place(&maker.at(1.0), Vec3::X), Vec3::new(cos, sin, 0.0));
    near(place(&maker.at(3.0), Vec3::X), Vec3::Y);
}

#[test]
fn a_matrix_can_be_animated_in_its_parts() {
    let mut maker = animated("scale", "LINEAR", &[0.0, 1.0], &[[1.0; 3], [3.0; 3]]);
    maker.root["nodes"][0]["matrix"] =
        json!([1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 5.0, 6.0, 7.0, 1.0]);
    near(place(&maker.at(0.5), Vec3::X), Vec3::new(7.0, 6.0, 7.0));
}

#[test]
fn morph_targets_move_vertices_by_their_weights() {
    let mut maker = animated("weights", "LINEAR", &[0.0, 2.0], &[[0.0], [1.0], [1.0], [0.0]]);
    let up = maker.floats(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [0.0, 0.0, 3.0]]);
    let along = maker.floats(&[[4.0, 0.0, 0.0]; 3]);
    let primitive = &mut maker.root["meshes"][0]["primitives"][0];
    primitive["targets"] = json!([{ "POSITION": up }, { "POSITION": along }]);
    maker.root["meshes"][0]["weights"] = json!([0.5, 0.0]);
    // Those of the mesh
    assert_eq!(only_mesh(&maker.read().unwrap()).positions[1], Vec3::new(1.0, 0.0, 1.0));
    // At 0.5 s: weights of 0.25 and 0.75
    assert_eq!(only_mesh(&maker.at(0.5)).positions[1], Vec3::new(4.0, 0.0, 0.5));
    // Those of the node come before those of the mesh
    maker.root["nodes"][0]["weights"] = json!([0.0, 1.0]);
    assert_eq!(only_mesh(&maker.read().unwrap()).positions[1], Vec3::new(5.0, 0.0, 0.0));
}

#[test]
fn morph_targets_move_both_sets_of_coordinates_and_colours() {
    let mut maker = Maker::triangle();
    let second = maker.floats(&[[0.25, 0.25]; 3]);
    let colors = maker.floats(&[[0.5, 0.5, 0.5, 0.5]; 3]);
    let by = maker.floats(&[[0.5, 0.5]; 3]);
    let dye = maker.floats(&[[0.5, -0.25, 4.0]; 3]);
    let primitive = &mut maker.root["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_1"] = json!(second);
    primitive["attributes"]["COLOR_0"] = json!(colors);
    primitive["targets"] = json!([{ "TEXCOORD_0": by, "TEXCOORD_1": by, "COLOR_0": dye }]);
    maker.root["meshes"][0]["weights"] = json!([0.5]);
    let read = maker.read().unwrap();
    let mesh = only_mesh(&read);
    // v runs upwards
    assert_eq!((mesh.uvs[0], mesh.uvs1[0]), (Vec2::new(0.25, -0.25), Vec2::new(0.5, 0.5)));
    assert_eq!(mesh.colors[0], Vec4::new(0.75, 0.375, 1.0, 0.5));
}

/// A triangle that hangs on two joints: the first vertex on node 1, the second on node 2, the third on both.
fn skinned() -> Maker {
    let mut maker = Maker::triangle();
    let normals = maker.floats(&[[0.0, 0.0, 1.0]; 3]);
    let joints = maker.accessor("VEC4", U8, 3, &[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    let weights = maker.floats(&[[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]]);
    let attributes = &mut maker.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = json!(normals);
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    let moved = |x: f32| {
        let mut matrix = glam::Mat4::IDENTITY;
        matrix.w_axis.x = x;
        matrix.to_cols_array()
    };
    let inverse = maker.floats(&[moved(0.0), moved(-1.0)]);
    maker.add("nodes", json!({ "translation": [0.0, 0.0, 10.0] }));
    maker.add("nodes", json!({ "translation": [1.0, 0.0, 10.0] }));
    maker.add("skins", json!({ "joints": [1, 2], "inverseBindMatrices": inverse }));
    maker.root["nodes"][0] = json!({ "mesh": 0, "skin": 0, "translation": [100.0, 100.0, 100.0] });
    maker.root["scenes"][0]["nodes"] = json!([0, 1, 2]);
    maker
}

#[test]
fn skins_put_vertices_where_their_joints_are() {
    let mut maker = skinned();
    // At rest both joints move by 10 along z; the place of the node of the mesh does not count
    let read = maker.read().unwrap();
    let z = Vec3::Z * 10.0;
    assert_eq!(only_mesh(&read).positions, [z, Vec3::X + z, Vec3::Y + z]);
    near(place(&read, Vec3::ONE), Vec3::ONE);
    // The second joint turns by 90° about y, through the point (1, 0, 0) of the mesh
    maker.root["nodes"][2]["rotation"] = json!(Quat::from_rotation_y(FRAC_PI_2).to_array());
    let read = maker.read().unwrap();
    let mesh = only_mesh(&read);
    near(mesh.positions[0], z);
    near(mesh.positions[1], Vec3::X + z);
    // (0, 1, 0) is at (1, 1, 1) with the second joint, and half of the way with both
    near(mesh.positions[2], Vec3::new(0.5, 1.0, 0.5) + z);
    near(mesh.normals[0], Vec3::Z);
    near(mesh.normals[1], Vec3::X);
    near(mesh.normals[2], Vec3::new(1.0, 0.0, 1.0).normalize());
}

#[test]
fn joints_that_the_skin_does_not_have_are_refused() {
    let mut maker = skinned();
    maker.root["skins"][0]["joints"] = json!([1]);
    let error = maker.error();
    assert_eq!(error, "/meshes/0/primitives/0/attributes/JOINTS_0: joint 1 is not in the skin, which has 1");
}

#[test]
fn of_two_animations_of_one_thing_the_first_counts() {
    let mut maker = animated("translation", "STEP", &[0.0], &[[1.0, 0.0, 0.0]]);
    let output = maker.floats(&[[0.0, 1.0, 0.0]]);
    let mut second = maker.root["animations"][0].clone();
    second["samplers"][0]["output"] = json!(output);
    maker.add("animations", second.clone());
    near(place(&maker.at(0.0), Vec3::ZERO), Vec3::X);
    second["channels"][0]["target"]["path"] = json!("scale");
    second["samplers"][0]["output"] = json!(maker.floats(&[[2.0, 2.0, 2.0]]));
    maker.root["animations"][1] = second;
    near(place(&maker.at(0.0), Vec3::X), Vec3::X * 3.0);
}

#[test]
fn key_frames_that_do_not_go_together_are_refused() {
    let wrong = [
        (
            animated("translation", "LINEAR", &[1.0, 0.5], &[[0.0; 3]; 2]),
            "the times of the key frames do not grow",
        ),
        (
            animated("translation", "LINEAR", &[0.0, 1.0], &[[0.0; 3]; 3]),
            "there are 3 values for 2 key frames",
        ),
        (
            animated("translation", "CUBICSPLINE", &[0.0], &[[0.0; 3]; 2]),
            "there are 2 values for 1 key frames",
        ),
        (animated("weights", "LINEAR", &[0.0, 1.0], &[[0.0]; 3]), "there are 3 weights for 2 key frames"),
        (animated("translation", "LINEAR", &[0.0], &[[0.0; 4]]), "elements are of type VEC4"),
        (animated("colour", "LINEAR", &[0.0], &[[0.0; 4]]), "no such thing of a node can be animated"),
    ];
    for (maker, expected) in wrong {
        let choice = ModelChoice { time: Some(0.5), ..ModelChoice::default() };
        let error = maker.show(&choice).unwrap_err().message;
        assert!(error.contains(expected), "{error}, expected {expected}");
    }
}
