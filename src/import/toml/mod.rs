//! The scene language: TOML files → [`Scene`]. `scenes/README.md` is its manual.
//!
//! A file is parsed into a tree of values that know their place ([`document`]), joined with the files that it
//! includes ([`include`]), changed by `--set` ([`overrides`]), and read table by table ([`reader`]).

mod assets;
mod camera;
mod detail;
mod displacement;
mod document;
mod exposure;
mod film;
mod include;
mod keys;
mod lens;
mod light;
mod material;
mod mesh;
mod mix;
mod model;
mod names;
mod overrides;
mod reader;
mod shape;
mod text;
mod texture;
mod transform;
mod value;
mod view;

#[cfg(test)]
mod tests;

pub use assets::Assets;

use crate::import::{ModelChoice, is_model};
use crate::scene::Scene;
use crate::{Place, Result};
use std::fmt;
use std::path::Path;

/// Something that is allowed in a scene and probably not meant.
///
/// Printed as `file:line:column: message`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Where.
    pub place: Place,
    /// The thing and why it is doubtful, in one sentence without a full stop.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

/// Reads a scene file, the files that it includes, and the pictures and meshes that it names.
///
/// `overrides` are the key and value of each `--set key=value`, such as `render.spp` and `16`. They are applied in
/// order before the scene is read; file names in them are relative to the scene file. `choice` is what is shown of glTF models.
///
/// # Errors
/// The first thing that is wrong, with file, line and column, or with the `--set` that it comes from.
pub fn read_scene_with(
    path: &Path,
    overrides: &[(String, String)],
    choice: &ModelChoice,
    assets: &mut dyn Assets,
) -> Result<(Scene, Vec<Warning>)> {
    let mut sources = document::Sources::default();
    let mut document = match is_model(path) {
        true => model::document(&mut sources, path)?,
        false => include::load(path, assets, &mut sources)?,
    };
    overrides::apply(&mut sources, path, &mut document, overrides)?;
    reader::read(&sources, assets, choice, &document)
}
