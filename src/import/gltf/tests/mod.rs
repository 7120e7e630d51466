//! Models from documents that the tests make.

mod accessors;
mod hostile;
mod materials;
mod places;
mod pose;
mod primitives;
mod textures;

use super::{Model, ModelChoice, read_model};
use crate::Result;
use crate::scene::{Material, Mesh, Principled, Scene, Surface};
use serde_json::{Map, Value, json};

/// A document in the making, with one buffer.
#[derive(Clone)]
struct Maker {
    root: Map<String, Value>,
    bytes: Vec<u8>,
}

const F32: u32 = 5126;
const U8: u32 = 5121;
const U16: u32 = 5123;

impl Maker {
    /// Nothing but a version.
    fn new() -> Self {
        let root = json!({ "asset": { "version": "2.0" } });
        Self { root: root.as_object().unwrap().clone(), bytes: Vec::new() }
    }

    /// One triangle in the plane z = 0, in mesh 0 and node 0 of the scene, with texture coordinates and without a material.
    fn triangle() -> Self {
        let mut maker = Self::new();
        let positions = maker.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let uvs = maker.floats(&[[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]);
        let attributes = json!({ "POSITION": positions, "TEXCOORD_0": uvs });
        maker.add("meshes", json!({ "primitives": [{ "attributes": attributes }] }));
        maker.add("nodes", json!({ "mesh": 0 }));
        maker.add("scenes", json!({ "nodes": [0] }));
        maker
    }

    /// The same with a material.
    fn with_material(material: Value) -> Self {
        let mut maker = Self::triangle();
        maker.add("materials", material);
        maker.root["meshes"][0]["primitives"][0]["material"] = json!(0);
        maker
    }

    /// Adds an object to a list and gives its number.
    fn add(&mut self, list: &str, object: Value) -> usize {
        let list = self.root.entry(list).or_insert_with(|| json!([])).as_array_mut().unwrap();
        list.push(object);
        list.len() - 1
    }

    /// Adds a view of bytes.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        self.bytes.extend(bytes);
        self.add("bufferViews", view)
    }

    /// Adds an accessor of bytes.
    fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessor =
            json!({ "bufferView": view, "type": kind, "componentType": component, "count": count });
        self.add("accessors", accessor)
    }

    /// Adds an accessor of floats.
    fn floats<const N: usize>(&mut self, elements: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = elements.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let kind = ["", "SCALAR", "VEC2", "VEC3", "VEC4"].get(N).unwrap_or(&"MAT4");
        self.accessor(kind, F32, elements.len(), &bytes)
    }

    /// The document with its buffer as GLB.
    fn glb(&self) -> Vec<u8> {
        let mut root = self.root.clone();
        root.entry("buffers").or_insert_with(|| json!([{ "byteLength": self.bytes.len() }]));
        let mut text = serde_json::to_vec(&root).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.bytes.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut glb = b"glTF\x02\0\0\0".to_vec();
        glb.extend((12 + 8 + text.len() as u32 + 8 + binary.len() as u32).to_le_bytes());
        for (kind, data) in [(b"JSON", &text), (b"BIN\0", &binary)] {
            glb.extend((data.len() as u32).to_le_bytes());
            glb.extend(kind);
            glb.extend(data.iter());
        }
        glb
    }

    /// What is read of it, without animation.
    fn read(&self) -> Result<(Scene, Model)> {
        self.show(&ModelChoice::default())
    }

    fn show(&self, choice: &ModelChoice) -> Result<(Scene, Model)> {
        read_bytes(&self.glb(), choice)
    }

    fn at(&self, time: f32) -> (Scene, Model) {
        self.show(&ModelChoice { time: Some(time), ..ModelChoice::default() }).unwrap()
    }

    /// The message of what is wrong with it, without the name of the file.
    fn error(&self) -> String {
        self.read().unwrap_err().message
    }
}

fn read_bytes(bytes: &[u8], choice: &ModelChoice) -> Result<(Scene, Model)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.glb");
    std::fs::write(&path, bytes).unwrap();
    let mut scene = Scene::default();
    let model = read_model(&path, choice, &mut scene)?;
    Ok((scene, model))
}

/// The mesh of the only instance.
fn only_mesh((scene, model): &(Scene, Model)) -> &Mesh {
    assert_eq!(model.instances.len(), 1);
    &scene.meshes[model.instances[0].mesh]
}

/// The material of the only instance.
fn only_material((scene, model): &(Scene, Model)) -> &Material {
    &scene.materials[model.instances[0].material]
}

fn principled(material: &Material) -> &Principled {
    match &material.surface {
        Surface::Principled(principled) => principled,
        other => panic!("{other:?}"),
    }
}
