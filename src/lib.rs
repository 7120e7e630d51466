//! dapple: a ray tracer written in GLSL compute shaders on Vulkan, with a Rust host.

mod error;
pub mod import;
pub mod scene;
pub mod shader;

pub use error::{Error, ErrorKind, Place, Result};
