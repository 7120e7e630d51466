//! What a model has to offer, for `dapple check`.

use super::animation;
use super::document::{Document, File};
use super::light;
use super::variant;
use crate::Result;
use std::path::Path;

/// Names of what can be chosen in a model, and counts of the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelContents {
    /// The program that wrote it.
    pub generator: Option<String>,
    /// Nodes.
    pub nodes: usize,
    /// Skins.
    pub skins: usize,
    /// Lights of KHR_lights_punctual.
    pub lights: usize,
    /// Names of cameras, for `--camera`.
    pub cameras: Vec<String>,
    /// Names of variants, for `--variant`.
    pub variants: Vec<String>,
    /// Names of animations and their lengths in seconds, for `--time`.
    pub animations: Vec<(String, f32)>,
    /// Extensions that it uses.
    pub extensions: Vec<String>,
}

/// Reads what is in a `.gltf` or `.glb` file.
///
/// # Errors
/// A file that cannot be read, or whose document is wrong.
pub fn model_contents(path: &Path) -> Result<ModelContents> {
    read(path).map_err(|error| error.in_file(path))
}

fn read(path: &Path) -> Result<ModelContents> {
    let mut file = File::read(path)?;
    let document = Document::open(&mut file)?;
    let root = &document.root;
    let cameras = root.list("cameras")?;
    let animations = root.list("animations")?;
    let used = root.list("extensionsUsed")?;
    Ok(ModelContents {
        generator: root.need("asset")?.text("generator")?.map(str::to_owned),
        nodes: root.list("nodes")?.len(),
        skins: root.list("skins")?.len(),
        lights: light::all(&document)?.len(),
        cameras: cameras
            .iter()
            .enumerate()
            .map(|(i, camera)| camera.name("camera", i))
            .collect::<Result<_>>()?,
        variants: variant::names(&document)?,
        animations: animations
            .iter()
            .enumerate()
            .map(|(i, json)| Ok((json.name("animation", i)?, animation::length(&document, json)?)))
            .collect::<Result<_>>()?,
        extensions: used.iter().map(|name| Ok(name.string()?.to_owned())).collect::<Result<_>>()?,
    })
}
