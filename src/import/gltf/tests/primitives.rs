//! Triangles of all modes, and vertices of meshes with several primitives.

use super::*;
use glam::{Vec2, Vec3, Vec4};

/// Triangles of a primitive of five vertices in a row.
fn triangles(mode: Option<u32>, indices: Option<(u32, &[u32])>) -> Vec<[u32; 3]> {
    let mut maker = Maker::new();
    let positions = maker.floats(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|x| [x, x * x, 0.0]));
    let mut primitive = json!({ "attributes": { "POSITION": positions } });
    if let Some(mode) = mode {
        primitive["mode"] = json!(mode);
    }
    if let Some((component, indices)) = indices {
        let size = match component {
            U8 => 1,
            U16 => 2,
            _ => 4,
        };
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()[..size].to_vec()).collect();
        primitive["indices"] = json!(maker.accessor("SCALAR", component, indices.len(), &bytes));
    }
    maker.add("meshes", json!({ "primitives": [primitive] }));
    maker.add("nodes", json!({ "mesh": 0 }));
    only_mesh(&maker.read().unwrap()).triangles.clone()
}

#[test]
fn lists_strips_and_fans_become_triangles() {
    // The specification, section 3.7.2.1
    assert_eq!(triangles(None, None), [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(triangles(Some(5), None), [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]);
    assert_eq!(triangles(Some(6), None), [[1, 2, 0], [2, 3, 0], [3, 4, 0], [4, 5, 0]]);
    for component in [U8, U16, 5125] {
        let indices = Some((component, &[5, 1, 3, 0][..]));
        assert_eq!(triangles(Some(4), indices), [[5, 1, 3]], "what is left over is no triangle");
        assert_eq!(triangles(Some(5), indices), [[5, 1, 3], [1, 0, 3]]);
        assert_eq!(triangles(Some(6), indices), [[1, 3, 5], [3, 0, 5]]);
    }
}

#[test]
fn points_and_lines_are_left_out_with_a_warning() {
    for mode in 0..4 {
        let mut maker = Maker::triangle();
        let points = json!({ "attributes": { "POSITION": 0 }, "mode": mode });
        maker.root["meshes"][0]["primitives"].as_array_mut().unwrap().push(points);
        let read = maker.read().unwrap();
        assert_eq!(only_mesh(&read).triangles, [[0, 1, 2]]);
        assert!(
            read.1.warnings[0].starts_with("/meshes/0/primitives/1: points, lines"),
            "{:?}",
            read.1.warnings
        );
        maker.root["meshes"][0]["primitives"].as_array_mut().unwrap().remove(0);
        assert_eq!(maker.error(), "the scene of the model has no triangles");
    }
}

#[test]
fn indices_beyond_the_vertices_are_refused() {
    let mut maker = Maker::triangle();
    let indices = maker.accessor("SCALAR", U8, 3, &[0, 1, 3]);
    maker.root["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    assert_eq!(maker.error(), "/meshes/0/primitives/0/indices: index 2 names vertex 3, and there are 3");
}

#[test]
fn primitives_share_vertices_and_are_joined_where_their_attributes_agree() {
    let mut maker = Maker::triangle();
    let other = maker.floats(&[[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]]);
    let normals = maker.floats(&[[0.0, 0.0, 2.0]; 3]);
    let primitives = maker.root["meshes"][0]["primitives"].as_array_mut().unwrap();
    primitives.push(json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 } }));
    primitives.push(json!({ "attributes": { "POSITION": other, "TEXCOORD_0": 1 } }));
    primitives.push(json!({ "attributes": { "POSITION": other, "NORMAL": normals } }));
    let (scene, model) = maker.read().unwrap();
    let meshes: Vec<&Mesh> = model.instances.iter().map(|instance| &scene.meshes[instance.mesh]).collect();
    assert_eq!(meshes.len(), 2);
    assert_eq!(meshes[0].triangles, [[0, 1, 2], [0, 1, 2], [3, 4, 5]]);
    assert_eq!((meshes[0].positions.len(), meshes[0].parts.len()), (6, 3));
    assert_eq!(meshes[0].positions[3], Vec3::new(0.0, 0.0, 5.0));
    assert!(meshes[0].normals.is_empty(), "flat");
    // v runs upwards
    assert_eq!(meshes[0].uvs[..3], [Vec2::ZERO, Vec2::X, Vec2::Y]);
    assert_eq!(meshes[1].normals, [Vec3::Z; 3]);
}

#[test]
fn quantized_attributes_are_numbers_of_their_own() {
    // KHR_mesh_quantization: positions of bytes that are not normalised, normals that are
    let mut maker = Maker::new();
    let positions = maker.accessor("VEC3", 5120, 3, &[0, 0, 0, 0, 100, 0, 0, 0, 0, 0x9c, 0, 0]);
    maker.root["bufferViews"][0]["byteStride"] = json!(4);
    let normals = maker.accessor("VEC3", 5120, 3, &[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0]);
    maker.root["bufferViews"][1]["byteStride"] = json!(4);
    maker.root["accessors"][normals]["normalized"] = json!(true);
    let attributes = json!({ "POSITION": positions, "NORMAL": normals });
    maker.add("meshes", json!({ "primitives": [{ "attributes": attributes }] }));
    maker.add("nodes", json!({ "mesh": 0 }));
    maker.root.insert("extensionsRequired".into(), json!(["KHR_mesh_quantization"]));
    let read = maker.read().unwrap();
    assert_eq!(only_mesh(&read).positions, [Vec3::ZERO, Vec3::X * 100.0, Vec3::Y * -100.0]);
    assert_eq!(only_mesh(&read).normals, [Vec3::Z; 3]);
}

#[test]
fn colours_of_vertices_have_alpha_1_where_they_have_none() {
    let colors = |kind: &str, component: u32, bytes: &[u8]| {
        let mut maker = Maker::triangle();
        let colors = maker.accessor(kind, component, 3, bytes);
        maker.root["accessors"][colors]["normalized"] = json!(component != F32);
        maker.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        only_mesh(&maker.read().unwrap()).colors.clone()
    };
    let bytes = |numbers: &[f32]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let (half, clear) = (Vec4::new(0.5, 0.25, 0.0, 1.0), Vec4::new(0.5, 0.25, 0.0, 0.75));
    assert_eq!(colors("VEC3", F32, &bytes(&[0.5, 0.25, 0.0].repeat(3))), [half; 3]);
    assert_eq!(colors("VEC4", F32, &bytes(&[0.5, 0.25, 0.0, 0.75].repeat(3))), [clear; 3]);
    assert_eq!(
        colors("VEC4", F32, &bytes(&[7.0, -1.0, 0.0, 1.5].repeat(3))),
        [Vec4::new(1.0, 0.0, 0.0, 1.0); 3]
    );
    // Linear, and not by the curve of sRGB; a number times 1 / 255 is rounded twice
    let words: Vec<u8> =
        [13107_u16, 65535, 0, 26214].repeat(3).iter().flat_map(|x| x.to_le_bytes()).collect();
    for (component, bytes) in [(U8, [51, 255, 0, 102].repeat(3)), (U16, words)] {
        let found = colors("VEC4", component, &bytes);
        assert!(
            found.iter().all(|color| color.abs_diff_eq(Vec4::new(0.2, 1.0, 0.0, 0.4), 1e-7)),
            "{found:?}"
        );
    }
}

#[test]
fn a_model_as_one_mesh_has_white_and_the_first_set_where_a_part_has_nothing_else() {
    let mut maker = Maker::triangle();
    let colors = maker.floats(&[[1.0, 0.0, 0.0]; 3]);
    let second = maker.floats(&[[0.5, 0.25]; 3]);
    let attributes = json!({ "POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": second, "COLOR_0": colors });
    let primitives = maker.root["meshes"][0]["primitives"].as_array_mut().unwrap();
    primitives.push(json!({ "attributes": attributes }));
    primitives.push(json!({ "attributes": { "POSITION": 0 } }));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.glb");
    std::fs::write(&path, maker.glb()).unwrap();
    let mesh = super::super::read_gltf_mesh(&path).unwrap();
    let (red, set) = (Vec4::new(1.0, 0.0, 0.0, 1.0), [Vec2::ZERO, Vec2::X, Vec2::Y]);
    assert_eq!(mesh.colors, [[Vec4::ONE; 3], [red; 3], [Vec4::ONE; 3]].concat());
    assert_eq!(mesh.uvs, [set, set, [Vec2::ZERO, Vec2::X, Vec2::ONE]].concat());
    assert_eq!(mesh.uvs1, [set, [Vec2::new(0.5, 0.75); 3], [Vec2::ZERO, Vec2::X, Vec2::ONE]].concat());
}

#[test]
fn tangents_of_the_file_are_kept() {
    let mut maker = Maker::triangle();
    let normals = maker.floats(&[[0.0, 0.0, 1.0]; 3]);
    let tangents = maker.floats(&[[0.0, 1.0, 0.0, -1.0]; 3]);
    maker.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = json!(tangents);
    assert!(only_mesh(&maker.read().unwrap()).tangents.is_empty(), "they need normals");
    maker.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    assert_eq!(only_mesh(&maker.read().unwrap()).tangents, [glam::Vec4::new(0.0, 1.0, 0.0, -1.0); 3]);
}
