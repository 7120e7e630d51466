//! dapple: a ray tracer written in GLSL compute shaders on Vulkan, with a Rust host.

mod error;
pub mod film;
pub mod gpu;
pub mod import;
pub mod layout;
pub mod prepare;
pub mod render;
pub mod scene;
pub mod shader;

pub use error::{Error, ErrorKind, Place, Result};
