//! What integration tests share. Every file of `tests/` uses a part of it.
#![allow(dead_code, reason = "each test program compiles all of it and uses some")]

pub mod chi2;
pub mod directions;
pub mod lights;
pub mod patterns;
pub mod placed;
pub mod probe;
pub mod random;
pub mod references;
pub mod render;
pub mod twins;
