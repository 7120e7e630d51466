//! The uniform block: what stays the same during a slice.

use super::camera;
use super::plan::{Slice, Tiles};
use crate::layout::{Frame, PATH_DEPTH_BITS, ROUNDS_A_STEP};
use crate::prepare::{self, Prepared};
use crate::scene::{Scene, Value};

/// The part of the block that no slice changes.
pub(super) fn of_scene(scene: &Scene, prepared: &Prepared, threads: u32) -> Frame {
    let (film, render) = (&scene.film, &scene.render);
    let window = film.window();
    let mut frame = Frame {
        filter_radius: film.filter.radius,
        seed: render.seed,
        film_size: [film.width, film.height],
        window_min: [window.x0, window.y0],
        window_max: [window.x1, window.y1],
        tiles_x: Tiles::of(window).columns,
        threads,
        strata: render.strata,
        max_depth: render.max_depth.min((1 << PATH_DEPTH_BITS) - 1),
        diffuse_bounces: render.diffuse_bounces.unwrap_or(u32::MAX),
        root: prepared.root,
        step_limit: step_limit(prepared),
        light_count: prepared.lights.len() as u32,
        environment_chance: prepared.environment_chance,
        camera_medium: prepared.camera_medium,
        firefly_clamp: render.firefly_clamp.unwrap_or(0.0),
        radiance_scale: (-prepared.radiance_exponent as f32).exp2(),
        depth_scale: (-prepared.depth_exponent as f32).exp2(),
        environment_texture: prepared.environment_texture,
        environment_size: prepared.environment_size,
        parked_stack: prepare::stack_size(prepared.stack_entries),
        ..camera::of_scene(scene, prepared)
    };
    if let Some(environment) = &scene.environment {
        let [row0, row1, row2] = prepare::environment_rows(environment);
        (frame.environment_row0, frame.environment_row1, frame.environment_row2) = (row0, row1, row2);
        frame.environment_scale = environment.scale;
        if let Value::Constant(radiance) = environment.radiance {
            frame.environment_radiance = (radiance * environment.scale).to_array();
        }
    }
    frame
}

/// Steps of a ray in one dispatch. Mesa before 25.0 leaves all loops of a subgroup after 65,535 rounds. In a tree over
/// instances the up to 16 lanes of a subgroup take turns, at worst, in the inner loop of a traversal; its outer loop takes as
/// many rounds as one lane.
fn step_limit(prepared: &Prepared) -> u32 {
    const ROUNDS: u32 = 65_000;
    ROUNDS / if prepared.features.instances { 16 * ROUNDS_A_STEP + 1 } else { ROUNDS_A_STEP + 1 }
}

/// The block of a slice.
pub(super) fn of_slice(scene: &Frame, slice: &Slice, band: (u32, u32)) -> Frame {
    Frame {
        first_tile: slice.first_tile,
        tile_count: slice.tiles,
        first_sample: slice.first_sample,
        sample_count: slice.samples,
        slot_count: slice.slots(),
        film_first_tile: band.0,
        film_tile_count: band.1,
        ..*scene
    }
}
