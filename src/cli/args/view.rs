//! The views of `dapple render`.

use clap::ValueEnum;
use dapple::prepare;

/// What is shown in place of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum View {
    /// Shading normal of the first surface in world space, on the side that is seen: -1 to 1 as 0 to 1
    Normals,
    /// Texture coordinates of the first surface: u is red, v is green, and blue is a checker of 8 by 8 from 0 to 1
    Uv,
    /// A colour for each shape and each instance of a mesh
    Objects,
    /// A colour for each material
    Materials,
    /// Nodes, triangles and instances that a camera ray was tested against: black is 0, each tenth of the way to light yellow
    /// doubles 1 + tests, up to 1024
    BvhCost,
    /// Scattering events of the paths: black is 0, light yellow is max_depth
    PathDepth,
    /// Samples that are NaN (magenta), infinite (yellow) or negative (cyan) over a dim grey of the picture
    NonFinite,
}

impl View {
    /// Its name on the command line.
    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

impl From<View> for prepare::View {
    fn from(view: View) -> Self {
        match view {
            View::Normals => Self::Normals,
            View::Uv => Self::Uv,
            View::Objects => Self::Objects,
            View::Materials => Self::Materials,
            View::BvhCost => Self::BvhCost,
            View::PathDepth => Self::PathDepth,
            View::NonFinite => Self::NonFinite,
        }
    }
}
