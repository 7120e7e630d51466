//! The scene language: TOML files → [`Scene`]. `scenes/README.md` is its manual.
//!
//! A file is parsed into a tree of values that know their place ([`document`]), joined with the files that it
//! includes ([`include`]), changed by `--set` ([`overrides`]), and read table by table ([`reader`]).

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
mod texture;
mod transform;
mod value;
mod view;

#[cfg(test)]
mod tests;

use super::assets::Assets;
use super::warning::Warning;
use super::{ModelChoice, assets, is_model, text};
use crate::Result;
use crate::scene::Scene;
use std::path::Path;

/// Reads a scene file, the files that it includes, and the pictures and meshes that it names.
///
/// `overrides` are the key and value of each `--set key=value`, such as `render.spp` and `16`. They are applied in
/// order before the scene is read; file names in them are relative to the scene file. `choice` is what is shown of glTF models.
///
/// # Errors
/// The first thing that is wrong, with file, line and column, or with the `--set` that it comes from.
pub(super) fn read_scene_with(
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

/// Changes `[film]` and `[render]` of a scene in another language by `--set`.
///
/// # Errors
/// Other keys, and values that are wrong, with the `--set` that they come from.
pub(super) fn change_settings(
    scene: &mut Scene,
    path: &Path,
    overrides: &[(String, String)],
    assets: &mut dyn Assets,
) -> Result<()> {
    if overrides.is_empty() {
        return Ok(());
    }
    let mut sources = document::Sources::default();
    let mut document = document::Table::default();
    overrides::apply(&mut sources, path, &mut document, overrides)?;
    if let Some(entry) =
        document.entries.iter().find(|entry| !["film", "render"].contains(&entry.key.as_str()))
    {
        let message = format!("[{}] of this scene cannot be set", text::shown(&entry.key));
        return Err(sources
            .error(entry.spot, message)
            .help("set keys of film and render, or change the scene file"));
    }
    let mut reader = reader::Reader::new(&sources, assets, &ModelChoice::default(), std::mem::take(scene));
    reader.settings(&document)?;
    *scene = reader.scene;
    Ok(())
}
