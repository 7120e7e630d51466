//! Models: files that are shown by themselves or placed as a whole.

use super::gltf;
use super::obj_model::read_obj_model;
use super::{Model, ModelChoice};
use crate::Result;
use crate::scene::Scene;
use std::path::Path;

fn ends_in(path: &Path, extensions: &[&str]) -> bool {
    path.extension().is_some_and(|found| extensions.iter().any(|known| found.eq_ignore_ascii_case(known)))
}

/// Whether the name of a file says that it is a model.
pub fn is_model(path: &Path) -> bool {
    is_gltf(path) || is_obj(path)
}

/// Whether the name of a file says that it is a glTF model.
pub fn is_gltf(path: &Path) -> bool {
    ends_in(path, &["gltf", "glb"])
}

fn is_obj(path: &Path) -> bool {
    ends_in(path, &["obj"])
}

/// Reads a `.gltf`, `.glb` or `.obj` file into a scene.
///
/// # Errors
/// What is wrong, with the file and the JSON pointer, or line and column; what a model requires and is not read; and a model without
/// triangles.
pub fn read_model(path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
    if is_obj(path) { read_obj_model(path, choice, scene) } else { gltf::read_model(path, choice, scene) }
}
