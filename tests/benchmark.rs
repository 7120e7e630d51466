//! The scene of `dapple bench --write-scene` has the brightness that another renderer gives it.

#![allow(clippy::unwrap_used, reason = "a test fails by a panic, in its helpers too")]

mod common;

use common::render::{mean, render};
use std::process::Command;

/// Mean over red, green, blue and all pixels, from Mitsuba 3 (`scalar_rgb`, independent sampler) of the scene that
/// `../shared/bench/mitsuba_blob.py` describes: 512 × 512 pixels, 5 scattering events, no Russian roulette.
const MITSUBA: f64 = 0.35995;

/// Part of the mean that may be off: the rounding of its last digit is 1.4e-5, the rest is noise of both.
const TOLERANCE: f64 = 2e-3;

#[test]
fn the_blob_is_as_bright_as_in_mitsuba() {
    let folder = tempfile::tempdir().unwrap();
    let written = Command::new(env!("CARGO_BIN_EXE_dapple"))
        .args(["bench", "--write-scene"])
        .arg(folder.path())
        .status()
        .unwrap();
    assert!(written.success());
    let (mut scene, warnings) = dapple::import::read_scene(&folder.path().join("blob.toml"), &[]).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!((scene.render.max_depth, scene.render.russian_roulette), (5, false));
    // The mean of a picture does not depend on its number of pixels, for a box filter one pixel wide
    (scene.film.width, scene.film.height, scene.render.spp) = (128, 128, 96);
    let measured = mean(&render(&scene));
    let over_channels = |values: [f64; 3]| values.iter().sum::<f64>() / 3.0;
    // Channels share their samples: the error of their mean is at most the mean of their errors
    let (brightness, error) = (over_channels(measured.mean), over_channels(measured.error));
    eprintln!("{brightness} ± {error}");
    assert!(error < 6e-4 * MITSUBA, "too noisy: ± {error}");
    let off = (brightness / MITSUBA - 1.0).abs();
    assert!(off < TOLERANCE, "{brightness} ± {error}, Mitsuba gives {MITSUBA}");
}
