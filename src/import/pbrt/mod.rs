//! Scenes of pbrt-v4 → [`Scene`]. `scenes/pbrt.md` says what is read, and what is not supported.
//!
//! A file is cut into words ([`lexer`]), which are directives ([`directive`]) and their parameters ([`parameter`],
//! [`parameters`]). Directives change the graphics state ([`state`], [`transform`]) or add to the scene. The format is described at
//! <https://pbrt.org/fileformat-v4>.

mod camera;
mod color_space;
mod deprecated;
mod directive;
mod dress;
mod film;
mod lexer;
mod light;
mod light_image;
mod mapping;
mod material;
mod mesh;
mod object;
mod outset;
mod parameter;
mod parameters;
mod patch;
mod pattern;
mod picture;
mod place;
mod quadric;
mod reader;
mod shape;
mod spectrum;
mod state;
mod texture;
mod transform;
mod unsupported;

#[cfg(test)]
mod tests;

use super::{Assets, Warning};
use crate::Result;
use crate::scene::Scene;
use std::path::Path;

/// Reads a scene of pbrt-v4, the files that it includes, and the pictures and meshes that it names.
///
/// # Errors
/// The first thing that is wrong, with file, line and column.
pub(super) fn read_pbrt(path: &Path, assets: &mut dyn Assets) -> Result<(Scene, Vec<Warning>)> {
    reader::Reader::new(assets).read(path)
}
