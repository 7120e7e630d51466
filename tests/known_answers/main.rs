//! Scenes whose pictures are known in closed form.

#[path = "../common/mod.rs"]
mod common;

mod camera;
mod geometry;
mod light;
mod paths;
mod texture;
