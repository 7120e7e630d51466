//! Views: what may be shown of a scene in place of its picture.

use super::Stage;
use crate::layout::NUMBER_FACTOR;

/// What is shown in place of the picture. Each view has a kernel of its own in `shaders/views/` that stands for one stage of the wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// The shading normal of the first surface in world space, on the side that is seen: 0.5 + 0.5 n.
    Normals,
    /// Texture coordinates of the first surface: u and v without their whole numbers as red and green, and a checker of an
    /// eighth in blue.
    Uv,
    /// A colour for each shape and each instance; [`View::number`] tells which.
    Objects,
    /// A colour for each material, a mix being one; [`View::number`] tells which.
    Materials,
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
    pub const ALL: [Self; 7] = [
        Self::Normals,
        Self::Uv,
        Self::Objects,
        Self::Materials,
        Self::BvhCost,
        Self::PathDepth,
        Self::NonFinite,
    ];

    /// log₂ of the unit of the sums of radiance of every view: their colours do not depend on how bright the scene is.
    pub const RADIANCE_EXPONENT: i32 = -30;

    /// The stage that its kernel stands for: `Shade` where it shows the first surface, else `Film`.
    pub fn stage(self) -> Stage {
        match self {
            Self::Normals | Self::Uv | Self::Objects | Self::Materials | Self::BvhCost => Stage::Shade,
            Self::PathDepth | Self::NonFinite => Stage::Film,
        }
    }

    /// Its kernel in the shader tree.
    pub fn file(self) -> &'static str {
        match self {
            Self::Normals => "views/normals.comp",
            Self::Uv => "views/uv.comp",
            Self::Objects => "views/objects.comp",
            Self::Materials => "views/materials.comp",
            Self::BvhCost => "views/bvh_cost.comp",
            Self::PathDepth => "views/path_depth.comp",
            Self::NonFinite => "views/non_finite.comp",
        }
    }

    /// The number behind a colour of the views of objects and materials; none where a pixel has nothing. Objects are `scene.shapes`, and
    /// `scene.instances` behind them; materials have the index of their handle. Numbers have 24 bits.
    pub fn number(rgb: [f32; 3]) -> Option<u32> {
        const BITS: u32 = 0x00FF_FFFF;
        // Newton's way to the number that times the factor is 1: each step has twice as many bits right, and 3 are at first
        const BACK: u32 = {
            let (mut back, mut step) = (NUMBER_FACTOR, 0);
            while step < 4 {
                back = back.wrapping_mul(2_u32.wrapping_sub(NUMBER_FACTOR.wrapping_mul(back)));
                step += 1;
            }
            back
        };
        let bits = rgb.iter().fold(0, |bits, c| bits << 8 | (c * 255.0).round() as u32 & 255);
        (bits.wrapping_mul(BACK) & BITS).checked_sub(1)
    }
}

/// The kernel of a stage, or of a view that stands for it.
pub fn kernel_file(stage: Stage, view: Option<View>) -> &'static str {
    view.filter(|view| view.stage() == stage).map_or(stage.file(), View::file)
}
