//! Rust twins of leaf functions of `shaders/`, named like them: slow and obvious, where they can be in f64 or by
//! another method.

pub mod fixed;
pub mod fresnel;
pub mod geometry;
pub mod math;
pub mod noise;
pub mod random;
pub mod sampling;
pub mod texture;
