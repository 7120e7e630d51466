//! Files → [`crate::scene::Scene`].

mod affine;
mod assets;
mod exr;
mod file;
mod framing;
mod gltf;
mod image;
mod lens;
mod mesh;
mod model;
mod mtl;
mod mtl_material;
mod obj;
mod obj_model;
mod pbrt;
mod ply;
mod ply_header;
mod ply_vertices;
mod srgb;
mod studio;
mod text;
mod toml;
mod volume;
mod warning;

pub use self::gltf::{Model, ModelCamera, ModelChoice, ModelContents, model_contents, read_gltf_mesh};
pub use assets::{Assets, read_text};
pub use image::read_image;
pub use lens::{Spacing, read_lens};
pub use mesh::read_mesh;
pub use model::{is_gltf, is_model, read_model};
pub use obj::read_obj;
pub use ply::read_ply;
pub use volume::read_volume;
pub use warning::Warning;

use crate::Result;
use crate::scene::{Image, LensSystem, Mesh, Scene};
use std::path::Path;
use std::sync::Arc;

/// Reads images, meshes and lenses from the file system.
struct Files;

impl Assets for Files {
    fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
        read_image(path).map(Arc::new)
    }

    fn mesh(&mut self, path: &Path) -> Result<Mesh> {
        read_mesh(path)
    }

    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        read_lens(path, spacing)
    }
}

/// Reads a scene file and everything that it names: a scene of pbrt-v4 when its name ends in `.pbrt`, one instance of a model when it
/// ends in `.gltf`, `.glb` or `.obj`, else TOML. `overrides` are key and value as in `--set key=value`.
///
/// # Errors
/// The first thing that is wrong, with file, line and column, or with file and JSON pointer. `scenes/README.md` describes the
/// language, `scenes/pbrt.md`, `scenes/gltf.md` and `scenes/obj.md` what is read of the others.
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

/// The same, with files that come from elsewhere.
///
/// # Errors
/// As [`read_scene_showing`].
pub fn read_scene_with(
    path: &Path,
    overrides: &[(String, String)],
    choice: &ModelChoice,
    assets: &mut dyn Assets,
) -> Result<(Scene, Vec<Warning>)> {
    if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("pbrt")) {
        return toml::read_scene_with(path, overrides, choice, assets);
    }
    let (mut scene, warnings) = pbrt::read_pbrt(path, assets)?;
    toml::change_settings(&mut scene, path, overrides, assets)?;
    Ok((scene, warnings))
}
