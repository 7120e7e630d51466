//! GLSL source to checked SPIR-V, in the process and without a device.
//!
//! [`Sources`] holds the tree of shader files. [`Compiler::kernel`] turns one of them, with its defines, into
//! [`Spirv`], from the disk cache where it can. [`Reflection`] says what a kernel expects of its host as far as
//! naga can read it, [`scan()`] as far as the bare words say it.
//!
//! Every file is written for one tree: `#include "room/file.glsl"` is relative to the root, never to the file that
//! it stands in; a file goes into a kernel once, however often it is included; `#version` and `#extension` are
//! the business of this room.

mod cache;
mod compile;
mod compiler;
mod graph;
mod include;
mod log;
mod reflect;
mod scan;
mod source;
mod stack;
#[cfg(test)]
mod tests;
mod tree;

pub use cache::CacheOptions;
pub use compile::{KernelKey, Spirv, compile};
pub use compiler::{CompileStats, Compiler};
pub use reflect::{
    BindingClass, ReflectedBinding, Reflection, reflect, reflect_portable, translates_to_wgsl,
};
pub use scan::{Scan, scan};
pub use source::Sources;
pub use tree::embedded_files;
