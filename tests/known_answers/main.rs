//! Scenes whose pictures are known in closed form.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

#[path = "../common/mod.rs"]
mod common;

mod camera;
mod cones;
mod corners;
mod curved;
mod dispersion;
mod displacement;
mod emission;
mod environment;
mod errata;
mod far_noise;
mod floor;
mod furnace;
mod geometry;
mod glass;
mod lens;
mod light;
mod light_texture;
mod material;
mod motion;
mod offset;
mod opacity;
mod paths;
mod pbrt_lights;
mod planes;
mod relief;
mod sides;
mod sizes;
mod texture;
mod traversal;
mod views;
