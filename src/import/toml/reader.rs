//! The document as a scene: the order in which tables are read, and what they share.

use super::Warning;
use super::assets::Assets;
use super::document::{Data, Entry, Node, Sources, Spot, Table};
use super::model::Models;
use super::names::Names;
use crate::import::ModelChoice;
use crate::scene::{Handle, Image, Material, Mesh, Scene, Texture};
use crate::{Error, Result};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Most warnings that are listed one by one: to find a line takes a walk through the file.
const MAX_WARNINGS: usize = 100;

/// A scene in the making.
pub(super) struct Reader<'a> {
    pub sources: &'a Sources,
    pub assets: &'a mut dyn Assets,
    pub scene: Scene,
    pub textures: Names<Texture>,
    pub materials: Names<Material>,
    pub meshes: Names<Mesh>,
    /// Pictures that are loaded already, by the identity of the file.
    pub images: BTreeMap<PathBuf, Handle<Image>>,
    pub models: Models,
    /// Triangles of subdivided meshes so far.
    pub subdivided: u64,
    warnings: Vec<(Spot, String)>,
}

/// Reads a whole document. Its outline has been checked.
pub(super) fn read(
    sources: &Sources,
    assets: &mut dyn Assets,
    choice: &ModelChoice,
    document: &Table,
) -> Result<(Scene, Vec<Warning>)> {
    let mut reader = Reader::new(sources, assets, choice, Scene::default());
    // What is quick to check comes before the files that may be large.
    reader.settings(document)?;
    if let Some(entry) = document.get("camera") {
        reader.camera(&entry.node)?;
    }
    reader.textures(named(document, "texture"))?;
    reader.materials(named(document, "material"))?;
    for (index, node) in listed(document, "shape") {
        reader.shape(index, node)?;
    }
    for (index, node) in listed(document, "light") {
        reader.light(index, node)?;
    }
    if let Some(entry) = document.get("environment") {
        reader.environment(&entry.node)?;
    }
    let shining = reader.scene.materials.iter().any(|(_, _, material)| material.emission.is_some());
    let shines = shining || !reader.scene.lights.is_empty() || reader.scene.environment.is_some();
    for entry in named(document, "mesh") {
        reader.mesh(entry)?;
    }
    for (index, node) in listed(document, "instance") {
        reader.instance(index, node)?;
    }
    reader.complete_from_models(document, shines)?;
    Ok(reader.finish())
}

impl<'a> Reader<'a> {
    /// A reader that adds to a scene.
    pub fn new(sources: &'a Sources, assets: &'a mut dyn Assets, choice: &ModelChoice, scene: Scene) -> Self {
        Self {
            sources,
            assets,
            scene,
            textures: Names::new(["texture", "textures"]),
            materials: Names::new(["material", "materials"]),
            meshes: Names::new(["mesh", "meshes"]),
            images: BTreeMap::new(),
            models: Models::showing(choice),
            subdivided: 0,
            warnings: Vec::new(),
        }
    }

    /// `[film]` and `[render]`.
    pub fn settings(&mut self, document: &Table) -> Result<()> {
        if let Some(entry) = document.get("film") {
            self.film(&entry.node)?;
        }
        match document.get("render") {
            Some(entry) => self.render(&entry.node),
            None => Ok(()),
        }
    }

    pub fn warn(&mut self, spot: Spot, message: String) {
        self.warnings.push((spot, message));
    }

    /// Checks that a file is there before it is read, so that a wrong name is reported where it is written.
    pub fn need_file(&mut self, spot: Spot, path: &std::path::Path) -> Result<()> {
        if self.assets.exists(path) {
            return Ok(());
        }
        let message = format!("there is no file {}", super::text::shown(&path.display().to_string()));
        Err(self.sources.locate(spot, Error::scene(message)))
    }

    fn finish(mut self) -> (Scene, Vec<Warning>) {
        self.warnings.extend(self.textures.unused());
        self.warnings.extend(self.materials.unused());
        self.warnings.extend(self.meshes.unused());
        self.warnings.sort();
        let more = self.warnings.len().saturating_sub(MAX_WARNINGS);
        if let Some((_, message)) = self.warnings.get_mut(MAX_WARNINGS).filter(|_| more > 1) {
            *message = format!("{more} more warnings from here on");
        }
        let warning = |(spot, message)| Warning { place: self.sources.place(spot), message };
        let own = self.warnings.into_iter().take(MAX_WARNINGS + 1).map(warning);
        (self.scene, own.chain(self.models.warnings).collect())
    }
}

fn named<'a>(document: &'a Table, key: &str) -> &'a [Entry] {
    match document.get(key).map(|entry| &entry.node.data) {
        Some(Data::Table(table)) => &table.entries,
        _ => &[],
    }
}

/// The tables of a list with their numbers from 1.
fn listed<'a>(document: &'a Table, key: &str) -> impl Iterator<Item = (usize, &'a Node)> {
    let nodes = match document.get(key).map(|entry| &entry.node.data) {
        Some(Data::List(nodes)) => nodes.as_slice(),
        _ => &[],
    };
    nodes.iter().enumerate().map(|(i, node)| (i + 1, node))
}
