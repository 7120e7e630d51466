//! The kernels of a scene on a device.

use super::Options;
use crate::Result;
use crate::gpu::{Command, Gpu, Layout, Pipeline};
use crate::layout::Backend;
use crate::prepare::{self, Prepared, Stage, View};
use crate::scene::{BSDFS, PUNCTUAL_LIGHTS, Scene};
use crate::shader::{Compiler, KernelKey, Sources};
use std::sync::Arc;

/// One pipeline a stage of the wave.
#[derive(Clone)]
pub struct Kernels {
    layout: Arc<Layout>,
    pipelines: Vec<(Stage, Arc<Pipeline>)>,
}

/// The key under which a stage of a scene is compiled, or the kernel of a view that stands for it.
pub fn key(
    scene: &Scene,
    prepared: &Prepared,
    stage: Stage,
    view: Option<View>,
    backend: Backend,
) -> KernelKey {
    let defines = prepare::defines(scene, prepared, stage, view, backend);
    KernelKey { defines, ..KernelKey::new(prepare::kernel_file(stage, view)) }
}

/// Adds the files that are generated to a tree of shaders: menus, and the texture functions of a scene.
///
/// # Errors
///
/// None that a caller could avoid.
pub fn add_generated(sources: &mut Sources, texture_glsl: &str) -> Result<()> {
    let files = prepare::generated(texture_glsl, BSDFS, PUNCTUAL_LIGHTS);
    files.into_iter().try_for_each(|(name, text)| sources.set_virtual(name, text))
}

impl Kernels {
    /// Compiles the stages of a wave for a scene and makes their pipelines. Gives the texture code of the scene to
    /// `compiler`.
    ///
    /// # Errors
    ///
    /// When a kernel does not compile, or the driver refuses it.
    pub fn new(
        gpu: &Gpu,
        compiler: &mut Compiler,
        scene: &Scene,
        prepared: &Prepared,
        options: Options,
    ) -> Result<Self> {
        add_generated(compiler.sources_mut(), &prepared.texture_glsl)?;
        let layout = gpu.layout(options.backend)?;
        let mut pipelines = Vec::new();
        for stage in Stage::WAVE {
            let spirv = compiler.kernel(&key(scene, prepared, stage, options.view, options.backend))?;
            pipelines.push((stage, gpu.pipeline(&layout, &spirv)?));
        }
        Ok(Self { layout, pipelines })
    }

    /// The layout that all of them share.
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// The stage that a command dispatches.
    pub(super) fn stage_of(&self, command: &Command<'_>) -> Option<Stage> {
        let (Command::Dispatch { pipeline, .. } | Command::DispatchIndirect { pipeline, .. }) = command
        else {
            return None;
        };
        self.pipelines.iter().find(|(_, own)| Arc::ptr_eq(own, pipeline)).map(|(stage, _)| *stage)
    }

    /// The pipeline of a stage of the wave.
    pub(super) fn pipeline(&self, stage: Stage) -> &Arc<Pipeline> {
        // Made for every stage of a wave, in the order of `Stage::WAVE`, which is that of the enum.
        &self.pipelines[stage as usize].1
    }
}
