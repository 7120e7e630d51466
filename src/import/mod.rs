//! Files → [`crate::scene::Scene`].

mod exr;
mod file;
mod image;
mod lens;
mod mesh;
mod obj;
mod ply;
mod ply_header;
mod ply_vertices;
mod srgb;
mod toml;
mod volume;

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

/// Reads a scene file and everything that it names. `overrides` are key and value as in `--set key=value`.
///
/// # Errors
/// The first thing that is wrong, with file, line and column. See `scenes/README.md` for the language.
pub fn read_scene(path: &Path, overrides: &[(String, String)]) -> Result<(Scene, Vec<Warning>)> {
    read_scene_with(path, overrides, &mut Files)
}
