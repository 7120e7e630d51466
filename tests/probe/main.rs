//! GLSL functions, one by one, against their twins in Rust or what they must be, through `shaders/probe.comp`.

#![allow(clippy::unwrap_used)] // Helpers of tests are tests too.
#[path = "../common/mod.rs"]
mod common;

mod base;
mod bilinear;
mod camera;
mod choice;
mod coated;
mod cone;
mod curved_light;
mod curved_surface;
mod direction;
mod dispersion;
mod flat_light;
mod fresnel;
mod geometry;
mod ggx;
mod layout;
mod lens;
mod light;
mod lobe;
mod material;
mod principled;
mod quadric;
mod random;
mod sampling;
mod texture;
