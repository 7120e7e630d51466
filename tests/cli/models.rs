//! glTF models as scenes.

use crate::{Room, png_size};
use serde_json::{Value, json};

/// A red triangle that shines, in front of an orthographic camera named `front`, with one animation that takes it away.
pub fn model() -> String {
    // Positions, then the times 0 and 2, then the places 0 and 100 along x
    let numbers =
        [-1.0_f32, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 100.0, 0.0, 0.0];
    let data: String =
        numbers.iter().flat_map(|x| x.to_le_bytes()).map(|byte| format!("%{byte:02x}")).collect();
    let view = |offset: usize, numbers: usize| json!({ "buffer": 0, "byteOffset": 4 * offset, "byteLength": 4 * numbers });
    let accessor = |view: usize, kind: &str, count: usize| json!({ "bufferView": view, "componentType": 5126, "type": kind, "count": count });
    json!({
        "asset": { "version": "2.0", "generator": "the tests" },
        "extensionsUsed": ["KHR_materials_unlit", "VENDOR_magic"],
        "buffers": [{ "byteLength": 4 * numbers.len(), "uri": format!("data:application/octet-stream,{data}") }],
        "bufferViews": [view(0, 9), view(9, 2), view(11, 6)],
        "accessors": [accessor(0, "VEC3", 3), accessor(1, "SCALAR", 2), accessor(2, "VEC3", 2)],
        "materials": [{
            "pbrMetallicRoughness": { "baseColorFactor": [1, 0, 0, 1] }, "extensions": { "KHR_materials_unlit": {} },
        }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
        "cameras": [{ "name": "front", "type": "orthographic", "orthographic": { "xmag": 2, "ymag": 1, "znear": 0, "zfar": 9 } }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "translation": [0, 0, 5] }],
        "scenes": [{ "nodes": [0, 1] }],
        "animations": [{
            "name": "leave",
            "samplers": [{ "input": 1, "output": 2 }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
        }],
    })
    .to_string()
}

#[test]
fn check_tells_what_can_be_chosen_in_a_model() {
    let room = Room::new();
    room.write("model.gltf", &model());
    let ran = room
        .run("check model.gltf")
        .code(0)
        .err_has("warning: model.gltf: the extension VENDOR_magic is left out");
    for row in [
        "film           960 x 480",
        "triangles      1",
        "cameras        front",
        "animations     leave (2.00 s)",
        "variants       none",
    ] {
        assert!(ran.out.contains(row), "no `{row}` in {}", ran.out);
    }
    let ran = room.run("check model.gltf --json").code(0);
    let contents: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(contents["model"]["generator"], "the tests");
    assert_eq!(contents["model"]["animations"], json!([{ "name": "leave", "seconds": 2.0 }]));
    room.run("check model.gltf --camera back").code(2).err_has("the model has no camera \"back\"");
    room.run("check model.gltf --variant red").code(2).err_has("the model has no variant \"red\"");
    room.run("check scene.toml --time 1").code(2).err_has("choose in glTF models, and the scene has none");
    room.run("check none.glb").code(2).err_has("there is no file none.glb");
}

#[test]
fn a_model_is_rendered_without_any_other_file() {
    let room = Room::new();
    room.write("model.gltf", &model());
    room.run("render model.gltf -q --size 16x8 --spp 4").code(0);
    assert_eq!(png_size(&room.path("model.png")), (16, 8));
    let red = |name: &str| {
        let [red, green, blue, _] = image::open(room.path(name)).unwrap().into_rgba8().get_pixel(8, 4).0;
        [red, green, blue]
    };
    assert_eq!(red("model.png"), [255, 0, 0]);
    room.run("render model.gltf -o later.png -q --size 16x8 --spp 4 --time 1 --camera front").code(0);
    let later = red("later.png");
    assert!(later[0] == later[1] && later[0] > 20, "the grey of the studio: {later:?}");
}
