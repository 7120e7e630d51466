//! Files in memory.

use crate::import::toml::Assets;
use crate::import::{Model, ModelChoice, Spacing};
use crate::scene::*;
use crate::{Error, Result};
use glam::{Affine3A, Vec3};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Files in memory. Pictures end in `.png` (8 bits) or `.exr` (floats), meshes in `.obj`.
#[derive(Default)]
pub(super) struct Memory {
    pub texts: BTreeMap<String, String>,
    pub loaded: Vec<String>,
}

impl Memory {
    pub fn new(texts: &[(&str, &str)]) -> Self {
        let texts = texts.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect();
        Self { texts, loaded: Vec::new() }
    }
}

impl Assets for Memory {
    fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
        self.loaded.push(path.display().to_string());
        let texels = match path.extension().and_then(|ext| ext.to_str()) {
            Some("png") => Texels::Rgba8(vec![[255; 4]]),
            Some("exr") => Texels::RgbaF32(vec![[1.0; 4]]),
            _ => return Err(Error::scene("not a picture")),
        };
        Ok(Arc::new(Image { width: 1, height: 1, texels }))
    }

    fn mesh(&mut self, path: &Path) -> Result<Mesh> {
        self.loaded.push(path.display().to_string());
        let part = |name: &str, at| MeshPart { name: name.into(), triangles: at..at + 1, material: None };
        let whole = vec![MeshPart { name: String::new(), triangles: 0..2, material: None }];
        let named = vec![part("steel", 0), part("paint", 1)];
        Ok(Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: Vec::new(),
            triangles: vec![[0, 1, 2]; 2],
            parts: if path.ends_with("plain.ply") { whole } else { named },
            ..Mesh::default()
        })
    }

    fn model(&mut self, path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
        let shown = format!("{} {:?} {:?}", path.display(), choice.time, choice.variant);
        self.loaded.push(shown.clone());
        let white = Material::new(Surface::Unlit { color: Value::Constant(Vec3::ONE) }, None);
        let (mesh, material) =
            (self.mesh(Path::new("car.obj"))?, scene.materials.add("white of a model", white));
        let mesh = scene.meshes.add("model", mesh);
        let world_from_object = Affine3A::from_translation(Vec3::X);
        let instance = Instance { name: shown, mesh, material, world_from_object, at_close: None };
        let lights = vec![Light::distant(-Vec3::Y, Vec3::ONE)];
        Ok(Model { instances: vec![instance], lights, ..Model::default() })
    }

    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        let text = "# A singlet\n50 4 1.5 20 60\n-50 2 1 20\n0 0 0 9\n";
        crate::import::lens::parse(text, spacing, path)
    }

    fn exists(&mut self, path: &Path) -> bool {
        !path.display().to_string().contains("missing")
    }

    fn text(&mut self, path: &Path) -> Result<String> {
        self.texts.get(&path.display().to_string()).cloned().ok_or_else(|| Error::scene("no such text"))
    }
}
