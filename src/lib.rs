//! dapple: a ray tracer written in GLSL compute shaders on Vulkan, with a Rust host.
//!
//! A picture goes one way through the rooms of this crate, and each makes a new value out of the last:
//!
//! | room | makes |
//! |---|---|
//! | [`import`] | files → [`scene::Scene`], a description without a GPU type |
//! | [`export`] | [`scene::Scene`] → a scene file and what it names |
//! | [`prepare`] | [`scene::Scene`] → [`prepare::Prepared`]: trees, records and texture code, without Vulkan |
//! | [`shader`] | GLSL → SPIR-V, from a disk cache where it can |
//! | [`gpu`] | a Vulkan device: all `unsafe` code is there |
//! | [`render`] | [`prepare::Prepared`] on a device → [`film::Film`], exact sums of samples |
//! | [`film`] | [`film::Film`] → [`film::Picture`] → PNG or EXR |
//! | [`live`] | a scene that is edited → a [`render::Renderer`] for each state of it |
//! | [`diff`] | two pictures → how far they are apart |
//!
//! [`whole_file`] writes files, and [`layout`] is what host and kernels agree on. The whole way:
//!
//! ```no_run
//! use dapple::gpu::{DeviceChoice, Gpu};
//! use dapple::render::{Next, Options, Renderer};
//! use dapple::shader::{CacheOptions, Compiler, Sources};
//! use std::{path::Path, sync::Arc};
//!
//! # fn main() -> dapple::Result<()> {
//! let (scene, warnings) = dapple::import::read_scene(Path::new("scene.toml"), &[])?;
//! warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
//! let gpu = Arc::new(Gpu::open(&DeviceChoice::default())?);
//! let mut compiler = Compiler::new(Sources::embedded(), CacheOptions::from_environment());
//! let (look, spp) = (scene.film.clone(), scene.render.spp);
//! let renderer = Renderer::open(gpu.clone(), &mut compiler, scene, Options::of(&gpu))?;
//! let film = renderer.render(0, spp, &mut |progress| {
//!     eprintln!("{:.0} %", 100.0 * progress.done);
//!     Next::Continue
//! })?;
//! dapple::film::write(Path::new("scene.png"), &film.resolve(), &look, &film.meta())?;
//! # Ok(())
//! # }
//! ```

pub mod diff;
mod error;
pub mod export;
pub mod film;
pub mod gpu;
pub mod import;
pub mod layout;
pub mod live;
pub mod prepare;
pub mod render;
pub mod scene;
pub mod shader;
pub mod whole_file;

pub use error::{Error, ErrorKind, Place, Result};
