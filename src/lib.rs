//! dapple: a ray tracer written in GLSL compute shaders on Vulkan, with a Rust host.

mod error;
pub mod film;
pub mod import;
pub mod scene;

pub use error::{Error, ErrorKind, Place, Result};
