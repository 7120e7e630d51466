//! Files → [`crate::scene::Scene`].

mod exr;
mod file;
mod framing;
mod gltf;
mod image;
mod lens;
mod mesh;
mod obj;
mod ply;
mod ply_header;
mod ply_vertices;
mod srgb;
mod studio;
mod toml;
mod volume;

pub use self::gltf::{
    Model, ModelCamera, ModelChoice, ModelContents, is_model, model_contents, read_gltf_mesh, read_model,
};
pub use self::toml::{Assets, Warning, read_scene_with};
pub use image::read_image;
pub use lens::{Spacing, read_lens};
pub use mesh::read_mesh;
pub use obj::read_obj;
pub use ply::read_ply;
pub use volume::read_volume;

use crate::Result;
use crate::scene::{Image, LensSystem, Mesh, Scene};
use std::path::Path;

/// Reads images, meshes and lenses from the file system.
struct Files;

impl Assets for Files {
    fn image(&mut self, path: &Path) -> Result<Image> {
        read_image(path)
    }

    fn mesh(&mut self, path: &Path) -> Result<Mesh> {
        read_mesh(path)
    }

    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        read_lens(path, spacing)
    }
}

/// Reads a scene file and everything that it names. `overrides` are key and value as in `--set key=value`. A `.gltf` or `.glb` file is a
/// scene with one instance of that model.
///
/// # Errors
/// The first thing that is wrong, with file, line and column, or with file and JSON pointer. See `scenes/README.md` for the
/// language, and `scenes/gltf.md` for models.
pub fn read_scene(path: &Path, overrides: &[(String, String)]) -> Result<(Scene, Vec<Warning>)> {
    read_scene_showing(path, overrides, &ModelChoice::default())
}

/// The same, with a choice of time, camera and variant of the models in it, which wins over what the scene says.
///
/// # Errors
/// Those of [`read_scene`], and a choice that the models do not have.
pub fn read_scene_showing(
    path: &Path,
    overrides: &[(String, String)],
    choice: &ModelChoice,
) -> Result<(Scene, Vec<Warning>)> {
    read_scene_with(path, overrides, choice, &mut Files)
}
