//! Displaced meshes, with heights from the device.

use super::evaluate::{Asked, Evaluator};
use crate::Result;
use crate::gpu::Gpu;
use crate::layout::Backend;
use crate::prepare::{self, Displaced};
use crate::scene::Scene;
use crate::shader::Compiler;
use std::sync::Arc;

/// Cuts and moves the displaced meshes of a scene, but for those that the scene before had.
///
/// # Errors
///
/// As [`prepare::displace`] and [`Evaluator::new`].
pub fn displace(
    gpu: &Arc<Gpu>,
    compiler: &mut Compiler,
    scene: &mut Scene,
    backend: Backend,
    kept: &mut Displaced,
) -> Result<()> {
    kept.begin();
    let textures = prepare::displacing(scene);
    if textures.is_empty() {
        return Ok(());
    }
    let asked = Asked::new(compiler, scene, &textures, backend)?;
    let images = scene.images.clone();
    // Pictures are large: they are read for a hash only when somebody looks for it
    let made_from = if kept.remembers() { asked.hash(&images).as_bytes().to_vec() } else { Vec::new() };
    let mut evaluator = None;
    prepare::displace(scene, &made_from, kept, &mut |texture, points| {
        let evaluator = match &mut evaluator {
            Some(evaluator) => evaluator,
            nothing => nothing.insert(Evaluator::open(gpu.clone(), &asked, &images)?),
        };
        evaluator.values(texture, points)
    })
}
