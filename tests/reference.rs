//! Scenes of `../shared/reference` against the pictures of pbrt-v4 and Mitsuba 3.
//!
//! Scenes of pbrt are rendered as they are. Those of Mitsuba are built by hand in the scene language:
//! `tests/scenes/reference/NAME.toml`. Every test renders one on the default device, writes `target/reference/NAME.exr`, and
//! `NAME.png` with the reference, the picture and their difference, and puts both to the test of `dapple::diff`. The noise of
//! the picture is what its film says.
//!
//! These references show what dapple cannot render yet:
//!
//! | reference | what it needs |
//! |---|---|
//! | `m_principled` | Disney's principled BSDF, where dapple has that of glTF |

#![allow(clippy::unwrap_used, clippy::panic)] // Helpers of tests are tests too.
mod common;

use common::references::{Reference, folder, reference, rendered};
use dapple::diff::{compare, flip, write_panel};
use dapple::film::write;
use dapple::gpu::{DeviceChoice, Gpu};
use dapple::import::read_scene;
use dapple::render::{Next, Options, Renderer};
use dapple::scene::Scene;
use dapple::shader::{CacheOptions, Compiler, Sources};
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Instant;

/// The default device and a compiler, for one test at a time: a render keeps all cores busy.
fn device() -> &'static Mutex<(Arc<Gpu>, Compiler)> {
    static DEVICE: OnceLock<Mutex<(Arc<Gpu>, Compiler)>> = OnceLock::new();
    DEVICE.get_or_init(|| {
        let validation = dapple::gpu::validation_from_environment();
        let gpu = Gpu::open(&DeviceChoice { validation, ..DeviceChoice::default() }).unwrap();
        let compiler = Compiler::new(Sources::embedded(), CacheOptions::from_environment());
        Mutex::new((Arc::new(gpu), compiler))
    })
}

/// Renders a scene and compares it with the picture of `renderer`.
fn check(renderer: &str, name: &str) {
    let Some(folder) = folder().unwrap() else { return };
    let expected = reference(&folder, renderer, name).unwrap();
    let scene = if renderer == "pbrt" {
        let path = folder.join("pbrt").join(name).with_extension("pbrt");
        read(&path, &[("render.spp", "256")])
    } else {
        read(&root().join("tests/scenes/reference").join(name).with_extension("toml"), &[])
    };
    compare_with(&expected, &scene, name);
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Reads a scene that has no warnings.
fn read(path: &Path, settings: &[(&str, &str)]) -> Scene {
    let settings: Vec<_> =
        settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let (scene, warnings) = read_scene(path, &settings).unwrap_or_else(|error| panic!("{error}"));
    let warnings: Vec<_> = warnings.iter().map(ToString::to_string).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
    scene
}

fn compare_with(expected: &Reference, scene: &Scene, name: &str) {
    let mut device = device().lock().unwrap_or_else(PoisonError::into_inner);
    let (gpu, compiler) = &mut *device;
    let start = Instant::now();
    let renderer = Renderer::open(gpu.clone(), compiler, scene.clone(), Options::of(gpu)).unwrap();
    let film = renderer.render(0, scene.render.spp, &mut |_| Next::Continue).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!((film.left_out(), film.clamped()), (0, 0), "samples left out, clamped");

    let out = root().join("target/reference");
    std::fs::create_dir_all(&out).unwrap();
    let file = out.join(name).with_extension("exr");
    write(&file, &film.resolve(), &scene.film, &film.meta()).unwrap();
    let picture = rendered(&file).unwrap();
    let errors = flip(&expected.picture, &picture);
    write_panel(&out.join(name).with_extension("png"), &expected.picture, &picture, &errors).unwrap();
    let verdict = compare(&expected.picture, &picture, expected.systematic);
    println!("{name:20} {seconds:5.1} s  {verdict}");
    assert!(verdict.accepted(), "{name}: {verdict}");
}

/// A test for each scene.
macro_rules! scenes {
    ($($renderer:ident: $($name:ident)+;)+) => {
        $($(
            #[test]
            fn $name() {
                check(stringify!($renderer), stringify!($name));
            }
        )+)+
    };
}

scenes! {
    pbrt: a_cornell b_wrap c_uv_quadrics d_checker e_noise f_marble_dots g_bump h_normalmap i_alpha j_thinlens k_softshadow l_materials m_instances
        n_infinite_const n_infinite_image o_lens_dgauss o_lens_wide p_equirect p_ortho q_meshes r_hardlights;
    mitsuba: m_area_lights m_bitmap_wrap_filter m_bumpmap m_cornell_saturated m_dielectric m_mask m_thinlens m_volume_texture;
}
