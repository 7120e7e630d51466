//! The variants of the kernels that scenes ask for, without a scene: to check shaders before anything is rendered.
//!
//! There are too many sets of switches for all of them. Each switch is tried alone, with all others, and missing among all others; each
//! sampler, filter and camera once or twice.

mod cameras;
mod case;
mod textures;

use super::{Stage, View, defines, kernel_file, prepare};
use crate::Result;
use crate::layout::Backend;
use crate::scene::Scene;
use case::{Case, cases};
use std::collections::{BTreeMap, BTreeSet};

/// A kernel and its switches.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Variant {
    /// The stage that it is for.
    pub stage: Stage,
    /// The kernel.
    pub file: &'static str,
    /// How it reads.
    pub backend: Backend,
    /// Its switches.
    pub defines: BTreeMap<String, String>,
}

/// Variants that are compiled with the same functions of textures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variants {
    /// The virtual file `generated/textures.glsl`.
    pub texture_glsl: String,
    /// The kernels, those that take longest first.
    pub kernels: Vec<Variant>,
}

/// Every stage on both back ends with the switches that scenes have, each set of switches once.
///
/// What takes the longest is left out where it would tell little: functions of all kinds of textures go into the kernels with all other
/// switches and into `evaluate`, and all but one of the switches are tried on storage buffers alone.
///
/// # Errors
///
/// None that a caller could avoid.
pub fn variants() -> Result<Vec<Variants>> {
    let mut seen = BTreeSet::new();
    let mut all = Vec::new();
    for (vertex_color, uv1) in [(true, true), (true, false), (false, true), (false, false)] {
        let texture_glsl = prepare(&textures::scene(vertex_color, uv1))?.texture_glsl;
        let evaluate = vec![(Stage::Evaluate, None)];
        let kernels = if vertex_color && uv1 { with_views() } else { evaluate };
        all.push(new_ones(texture_glsl, &kernels, &[Case::all(vertex_color, uv1)], &mut seen));
    }
    let texture_glsl = prepare(&Scene::default())?.texture_glsl;
    all.push(new_ones(texture_glsl.clone(), &with_views(), &[Case::default()], &mut seen));
    let stages = Stage::ALL.map(|stage| (stage, None));
    all.push(new_ones(texture_glsl, &stages, &cases(), &mut seen));
    Ok(all)
}

/// All stages, and those that views change.
fn with_views() -> Vec<(Stage, Option<View>)> {
    let of_views = View::ALL.into_iter().flat_map(|view| Stage::ALL.map(|stage| (stage, Some(view))));
    Stage::ALL.into_iter().map(|stage| (stage, None)).chain(of_views).collect()
}

/// The variants of some cases that are not among those before.
fn new_ones(
    texture_glsl: String,
    stages: &[(Stage, Option<View>)],
    cases: &[Case],
    seen: &mut BTreeSet<Variant>,
) -> Variants {
    let mut kernels = Vec::new();
    for case in cases {
        let prepared = case.prepared();
        let backends: &[Backend] =
            if case.storage_alone { &[Backend::Storage] } else { &[Backend::Storage, Backend::Texel] };
        for (&(stage, view), &backend) in stages.iter().flat_map(|s| backends.iter().map(move |b| (s, b))) {
            let defines = defines(&case.scene, &prepared, stage, view, backend);
            let variant = Variant { stage, file: kernel_file(stage, view), backend, defines };
            if seen.insert(variant.clone()) {
                kernels.push(variant);
            }
        }
    }
    kernels.sort_by_key(|variant| std::cmp::Reverse(variant.defines.len()));
    Variants { texture_glsl, kernels }
}
