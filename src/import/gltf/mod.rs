//! glTF 2.0: `.gltf` and `.glb` files into a [`Scene`]. `scenes/gltf.md` says what is read, left out and refused.
//!
//! A file is JSON and buffers ([`container`], [`buffers`]). Each value of the document knows its JSON pointer ([`json`]); views and
//! accessors are checked against the bytes that are there before any is read ([`accessor`]), and what a model becomes in memory is
//! limited by the size of its file ([`budget`]). Then nodes are placed at a time ([`node`], [`animation`]) and what they hold goes into
//! the scene ([`reader`]).

mod accessor;
mod animation;
mod budget;
mod buffers;
mod camera;
mod container;
mod contents;
mod deform;
mod document;
mod elements;
mod image;
mod instancing;
mod join;
mod json;
mod light;
mod material;
mod mesh;
mod node;
mod primitive;
mod reader;
mod texture;
mod uri;
mod variant;

#[cfg(test)]
mod tests;

pub use camera::ModelCamera;
pub use contents::{ModelContents, model_contents};
pub use join::read_gltf_mesh;

use crate::import::file::shown;
use crate::scene::{Instance, Light, Scene};
use crate::{Error, Result};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What is shown of a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ModelChoice {
    /// Time of all animations in seconds; none = the pose of the file, without animations.
    pub time: Option<f32>,
    /// Name of the material variant; none = the materials of the file.
    pub variant: Option<String>,
    /// Name or number, from 0, of the camera; none = the first.
    pub camera: Option<String>,
}

/// What a model adds to a scene, beside the meshes, materials, textures and pictures that are in it already.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Model {
    /// Meshes in the space of the model.
    pub instances: Vec<Instance>,
    /// Cameras in the space of the model.
    pub cameras: Vec<ModelCamera>,
    /// Lights in the space of the model.
    pub lights: Vec<Light>,
    /// What is seen in another way than the file means it.
    pub warnings: Vec<String>,
    /// Files beside the model that it is made of.
    pub files: BTreeSet<PathBuf>,
}

/// Reads a `.gltf` or `.glb` file into a scene.
///
/// # Errors
/// What is wrong, with the file and the JSON pointer; an extension that is required and not read; a model without triangles; and a
/// file whose model would grow beyond all proportion.
pub fn read_model(path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
    read(path, choice, scene).map_err(|error| error.in_file(path))
}

fn read(path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
    let mut file = document::File::read(path)?;
    let document = document::Document::open(&mut file)?;
    let model = reader::Reader::new(document, scene, choice)?.read(choice)?;
    if model.instances.is_empty() {
        return Err(Error::scene("the scene of the model has no triangles")
            .help("export the model with meshes of triangles in its scene"));
    }
    Ok(model)
}

impl Model {
    /// The camera that is chosen by its name or number, or the first of all.
    ///
    /// # Errors
    /// A choice that names no camera.
    pub fn camera(&self, choice: Option<&str>) -> Result<Option<&ModelCamera>> {
        let Some(choice) = choice else { return Ok(self.cameras.first()) };
        let named = self.cameras.iter().find(|camera| camera.name == choice);
        let numbered = || choice.parse::<usize>().ok().and_then(|number| self.cameras.get(number));
        named.or_else(numbered).map(Some).ok_or_else(|| {
            let names: Vec<_> =
                self.cameras.iter().map(|c| format!("\"{}\"", shown(c.name.as_bytes()))).collect();
            let help = if names.is_empty() {
                "it has none".into()
            } else {
                format!("there are {}", names.join(", "))
            };
            Error::scene(format!("the model has no camera \"{}\"", shown(choice.as_bytes()))).help(help)
        })
    }
}
