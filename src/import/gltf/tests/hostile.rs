//! Files that are damaged, or made to exhaust memory: refused in time, without a panic.

use super::*;
use proptest::prelude::*;

/// A model with a bit of everything.
fn rich() -> Maker {
    let mut maker = Maker::with_material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "alphaMode": "BLEND",
    }));
    textures::add_picture(&mut maker);
    let indices = maker.accessor("SCALAR", U8, 3, &[0, 1, 2]);
    maker.root["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let (input, output) = (maker.floats(&[[0.0], [1.0]]), maker.floats(&[[0.0; 3], [1.0; 3]]));
    let joints = maker.accessor("VEC4", U8, 3, &[0; 12]);
    let weights = maker.floats(&[[1.0, 0.0, 0.0, 0.0]; 3]);
    let attributes = &mut maker.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    maker.add("skins", json!({ "joints": [0] }));
    maker.root["nodes"][0]["skin"] = json!(0);
    maker.add(
        "animations",
        json!({
            "samplers": [{ "input": input, "output": output }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
        }),
    );
    maker
}

fn animated(bytes: &[u8]) -> Result<(Scene, Model)> {
    read_bytes(bytes, &ModelChoice { time: Some(0.5), ..ModelChoice::default() })
}

proptest! {
    #[test]
    fn damaged_files_are_refused_or_read(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = rich().glb();
        for (at, value) in flips {
            *at.get_mut(&mut bytes) = value;
        }
        let _ = animated(&bytes);
    }

    #[test]
    fn numbers_of_the_document_can_be_anything(at in 0_usize..400, number in prop::sample::select(vec![
        "-1", "0", "7", "255", "4294967295", "1e300", "1.5", "null", "\"x\"", "[]", "{}", "18446744073709551615",
    ])) {
        let maker = rich();
        let text = serde_json::to_string(&maker.root).unwrap();
        // Replaces one of the numbers of the text
        let numbers: Vec<_> = text.match_indices(|c: char| c.is_ascii_digit()).map(|(i, _)| i).collect();
        let i = numbers[at % numbers.len()];
        let mut changed = text;
        changed.replace_range(i..=i, number);
        if let Ok(root) = serde_json::from_str::<Map<String, Value>>(&changed) {
            let _ = animated(&Maker { root, ..maker }.glb());
        }
    }

    #[test]
    fn files_may_end_anywhere(end in any::<prop::sample::Index>()) {
        let bytes = rich().glb();
        let end = end.index(bytes.len());
        prop_assert!(animated(&bytes[..end]).is_err());
    }
}

#[test]
fn the_rich_model_is_read() {
    let (scene, model) = animated(&rich().glb()).unwrap();
    assert_eq!((model.instances.len(), scene.images.len()), (1, 1));
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn small_files_cannot_become_large_scenes() {
    // Each of many nodes has the mesh in a pose of its own: their vertices would be many times the file
    let mut maker = rich();
    let count = 20_000;
    let positions = vec![[0.0_f32; 3]; count];
    let position = maker.floats(&positions);
    let joints = maker.accessor("VEC4", U8, count, &vec![0; 4 * count]);
    let weights = maker.accessor("VEC4", U8, count, &vec![255; 4 * count]);
    maker.root["accessors"][weights]["normalized"] = json!(true);
    let attributes = json!({ "POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": weights });
    maker.root["meshes"][0]["primitives"][0]["attributes"] = attributes;
    for _ in 0..10_000 {
        let node = maker.add("nodes", json!({ "mesh": 0, "skin": 0 }));
        maker.root["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    assert!(maker.error().contains("grows to more than 64 times its"), "{}", maker.error());

    // Many nodes with many instances each
    let mut maker = Maker::triangle();
    let translation = maker.floats(&vec![[0.0; 3]; 10_000]);
    let extensions = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translation } } });
    for _ in 0..10_000 {
        let node = maker.add("nodes", json!({ "mesh": 0, "extensions": extensions }));
        maker.root["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    assert!(maker.error().contains("grows to more than 64 times its"), "{}", maker.error());

    // Many primitives that share vertices are no more than one
    let mut maker = Maker::triangle();
    let indices = maker.accessor("SCALAR", U8, 3, &[0, 1, 2]);
    let primitive = json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": indices });
    maker.root["meshes"][0]["primitives"] = json!(vec![primitive; 5000]);
    assert_eq!(only_mesh(&maker.read().unwrap()).positions.len(), 3);
}

#[test]
fn files_that_are_no_models_are_refused_with_what_they_are() {
    let message = |bytes: &[u8]| read_bytes(bytes, &ModelChoice::default()).unwrap_err().message;
    assert!(message(b"\x89PNG").contains("this is neither GLB nor JSON text"));
    assert!(message(b"").contains("this is neither GLB nor JSON text"));
    assert_eq!(message(b"glTF\x02\0\0\0"), "the GLB file ends within its header");
    assert_eq!(message(b"[]"), "/: this is a list of 0, must be an object");
    assert_eq!(message(b"{}"), "/: `asset` is missing");
    let mut maker = Maker::triangle();
    maker.root["asset"]["version"] = json!("1.0");
    assert_eq!(maker.error(), "/asset/version: this is glTF 1, must be glTF 2");
    maker.root["asset"]["version"] = json!("2.0");
    maker.root["asset"]["minVersion"] = json!("2.1");
    assert_eq!(maker.error(), "/asset/minVersion: this is the string \"2.1\", must be at most \"2.0\"");
    maker.root.insert("buffers".into(), json!([{ "byteLength": 1_000_000 }]));
    maker.root["asset"]["minVersion"] = json!("2.0");
    assert!(maker.error().starts_with("/buffers/0: `byteLength` announces 1000000 bytes, there are "));
}
