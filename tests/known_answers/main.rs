//! Scenes whose pictures are known in closed form.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::needless_range_loop,
    reason = "helpers of tests may panic: that is how they fail"
)]

#[path = "../common/mod.rs"]
mod common;

mod camera;
mod geometry;
mod light;
mod paths;
mod texture;
