//! [`Scene`] → [`Renderer`] in one step, and again after an edit.

use super::{Kernels, Options, Renderer, Uploads, displace};
use crate::Result;
use crate::gpu::Gpu;
use crate::prepare::{self, Displaced, Trees, View};
use crate::scene::Scene;
use crate::shader::Compiler;
use std::sync::Arc;
use std::time::Instant;

/// What is kept of a scene, so that the next one does only what an edit touches. Kernels are kept by the compiler and the device.
pub struct Kept {
    displaced: Displaced,
    trees: Trees,
    uploads: Uploads,
}

impl Default for Kept {
    fn default() -> Self {
        Self { displaced: Displaced::remembering(), trees: Trees::kept(), uploads: Uploads::kept() }
    }
}

/// What it took to bring a scene onto the device.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Opened {
    /// Seconds of cutting and moving displaced meshes.
    pub displace_seconds: f64,
    /// Seconds of trees and records.
    pub prepare_seconds: f64,
    /// Seconds of looking for kernels and compiling GLSL.
    pub compile_seconds: f64,
    /// Seconds in which the driver compiled; see [`Accumulation::warm`](super::Accumulation::warm) for the rest.
    pub driver_seconds: f64,
    /// Seconds of sending buffers.
    pub upload_seconds: f64,
    /// Displaced meshes that were cut and moved.
    pub displaced: u32,
    /// Trees that were built.
    pub trees: u32,
    /// Kernels that were given to glslang.
    pub kernels: u32,
    /// Bytes that were sent.
    pub bytes: u64,
}

impl Renderer {
    /// Prepares a scene, compiles its kernels and puts it on the device: all the way from [`Scene`] in one step. It is used up, so that
    /// host and device do not both hold its pictures.
    ///
    /// # Errors
    ///
    /// As [`prepare::prepare`], [`Kernels::new`] and [`Self::new`].
    pub fn open(gpu: Arc<Gpu>, compiler: &mut Compiler, scene: Scene, options: Options) -> Result<Self> {
        let mut nothing =
            Kept { displaced: Displaced::default(), trees: Trees::default(), uploads: Uploads::default() };
        Ok(Self::open_again(gpu, compiler, scene, options, &mut nothing)?.0)
    }

    /// The same, with what is kept of the scene before as long as its renderer lives.
    ///
    /// # Errors
    ///
    /// As [`Self::open`]. What was kept is still of use then.
    pub fn open_again(
        gpu: Arc<Gpu>,
        compiler: &mut Compiler,
        mut scene: Scene,
        options: Options,
        kept: &mut Kept,
    ) -> Result<(Self, Opened)> {
        let mut clock = Clock(Instant::now());
        displace(&gpu, compiler, &mut scene, options.backend, &mut kept.displaced)?;
        let displace_seconds = clock.lap();
        let mut prepared = prepare::prepare_again(&scene, &mut kept.trees)?;
        if options.view.is_some() {
            prepared.radiance_exponent = View::RADIANCE_EXPONENT;
        }
        let prepare_seconds = clock.lap();
        let before = compiler.stats();
        let kernels = Kernels::new(&gpu, compiler, &scene, &prepared, options)?;
        let after = compiler.stats();
        let kernel_seconds = clock.lap();
        let renderer = Self::place(gpu, kernels, scene, prepared, options.slicing, &mut kept.uploads)?;
        let compile_seconds =
            after.lookup_seconds - before.lookup_seconds + after.compile_seconds - before.compile_seconds;
        kept.displaced.end();
        let opened = Opened {
            displace_seconds,
            prepare_seconds,
            compile_seconds,
            driver_seconds: (kernel_seconds - compile_seconds).max(0.0),
            upload_seconds: clock.lap(),
            displaced: kept.displaced.made(),
            trees: kept.trees.built(),
            kernels: after.misses - before.misses,
            bytes: kept.uploads.bytes(),
        };
        Ok((renderer, opened))
    }
}

/// Seconds since it was last asked.
struct Clock(Instant);

impl Clock {
    fn lap(&mut self) -> f64 {
        std::mem::replace(&mut self.0, Instant::now()).elapsed().as_secs_f64()
    }
}
