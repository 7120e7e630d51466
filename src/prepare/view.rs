//! Views: what may be shown of a scene in place of its picture.

use super::Stage;

/// What is shown in place of the picture. Each view has a kernel of its own in `shaders/views/` that stands for one stage of the wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// The shading normal of the first surface in world space, on the side that is seen: 0.5 + 0.5 n.
    Normals,
    /// Texture coordinates of the first surface: u and v without their whole numbers as red and green, and a checker of an
    /// eighth in blue.
    Uv,
    /// How many nodes, triangles and instances a camera ray was tested against: the heat of log₂(1 + tests) / 10.
    BvhCost,
    /// Scattering events of each path, as heat from 0 to `max_depth`.
    PathDepth,
    /// Samples that are not a number as magenta, infinite ones as yellow and negative ones as cyan, each 64 times as bright as
    /// white, over a dim grey of the others. The film counts the same samples as left out that it leaves out without the view.
    NonFinite,
}

impl View {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Normals, Self::Uv, Self::BvhCost, Self::PathDepth, Self::NonFinite];

    /// log₂ of the unit of the sums of radiance of every view: their colours do not depend on how bright the scene is.
    pub const RADIANCE_EXPONENT: i32 = -30;

    /// The stage that its kernel stands for: `Shade` where it shows the first surface, else `Film`.
    pub fn stage(self) -> Stage {
        match self {
            Self::Normals | Self::Uv | Self::BvhCost => Stage::Shade,
            Self::PathDepth | Self::NonFinite => Stage::Film,
        }
    }

    /// Its kernel in the shader tree.
    pub fn file(self) -> &'static str {
        match self {
            Self::Normals => "views/normals.comp",
            Self::Uv => "views/uv.comp",
            Self::BvhCost => "views/bvh_cost.comp",
            Self::PathDepth => "views/path_depth.comp",
            Self::NonFinite => "views/non_finite.comp",
        }
    }
}

/// The kernel of a stage, or of a view that stands for it.
pub fn kernel_file(stage: Stage, view: Option<View>) -> &'static str {
    view.filter(|view| view.stage() == stage).map_or(stage.file(), View::file)
}
