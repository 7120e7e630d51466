//! A whole life of a device under the validation layer: opened, used, and taken down, without a word of the layer.
#![allow(clippy::unwrap_used, clippy::panic, reason = "what fails here fails the test that called it")]

use dapple::gpu::{DeviceChoice, Gpu, choose, devices, late_messages};
use dapple::import::read_scene;
use dapple::render::{Next, Options, Renderer};
use dapple::shader::{CacheOptions, Compiler, Sources};
use std::sync::Arc;

const SCENE: &str = r#"
film.size = [8, 8]
render.spp = 2
material.clay = { kind = "diffuse", color = 0.5 }
environment.color = 1.0
[[shape]]
kind = "sphere"
center = [0, 0, 0]
radius = 1
material = "clay"
"#;

#[test]
fn nothing_is_said_from_the_first_call_to_the_last() {
    let choice = DeviceChoice { validation: true, ..DeviceChoice::default() };
    if let Err(error) = devices(true)
        && error.message.contains("validation layer is not installed")
    {
        assert!(std::env::var_os("CI").is_none_or(|v| v != "true"), "{error}");
        eprintln!("SKIPPED: {error}");
        return;
    }
    choose(&choice).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, SCENE).unwrap();
    let (scene, _) = read_scene(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
    let gpu = Arc::new(Gpu::open(&choice).unwrap());
    let mut compiler = Compiler::new(Sources::embedded(), CacheOptions::from_environment());
    let renderer = Renderer::open(gpu.clone(), &mut compiler, scene, Options::of(&gpu)).unwrap();
    let film = renderer.render(0, 2, &mut |_| Next::Continue).unwrap();
    assert_eq!(film.samples_per_pixel(), 2);
    drop((renderer, gpu));
    assert_eq!(late_messages(), 0, "messages while the device was taken down");
}
