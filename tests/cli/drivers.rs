//! Another software driver than the one that is installed: the SwiftShader that comes with Chromium.

use crate::Room;
use serde_json::Value;
use std::path::Path;

/// Its manifest in Debian's package.
const SWIFTSHADER: &str = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// What lies near the limits that Vulkan has for functions of drivers: a lamp that must not be in its own shadow, curved mirrors, glass,
/// a spot with a smooth edge, noise, a lens, and things that turn.
const SCENE: &str = r#"
film.size = [32, 24]
render = { spp = 16, max_depth = 4 }
[camera]
position = [0, 3, 4]
target = [0, 0, 0]
lens_radius = 0.02
focus_distance = 5
[texture.veins]
kind = "marble"
[material.floor]
kind = "diffuse"
color = { texture = "veins" }
[material.metal]
kind = "conductor"
roughness = 0.4
[material.glass]
kind = "dielectric"
[[shape]]
kind = "quad"
center = [0, 0, 0]
edge_u = [10, 0, 0]
edge_v = [0, 0, -10]
material = "floor"
[[shape]]
kind = "sphere"
center = [-0.6, 0.5, 0]
radius = 0.5
material = "metal"
[[shape]]
kind = "cylinder"
center = [0.7, 0, 0]
radius = 0.4
z_min = 0
z_max = 1
material = "glass"
transform_close = [{ rotate = [0, 1, 0], angle = 40 }]
[[light]]
kind = "sphere"
center = [-1.5, 4, 2]
radius = 0.4
radiance = [60, 50, 35]
[[light]]
kind = "spot"
position = [2, 4, 1]
target = [0.5, 0, 0]
intensity = 20
"#;

#[test]
fn another_driver_shows_the_same_picture() {
    if !Path::new(SWIFTSHADER).exists() {
        assert!(std::env::var_os("CI").is_none_or(|v| v != "true"), "{SWIFTSHADER} is not there");
        eprintln!("SKIPPED: {SWIFTSHADER} is not there");
        return;
    }
    let room = Room::new();
    room.write("scene.toml", SCENE);
    room.run("render scene.toml -q -o a.exr").code(0);
    let ran = room.run_on(SWIFTSHADER, "render scene.toml --json -o b.exr").code(0);
    assert!(ran.out.contains("SwiftShader"), "{}", ran.out);
    let ran = room.run("diff --json a.exr b.exr");
    let found: Value = serde_json::from_str(ran.out.lines().next().unwrap()).unwrap();
    // The same random numbers: only a ray here and there that just meets something is another one
    let error = found["rel_mse"].as_f64().unwrap();
    assert!(error < 1e-5, "{found}");
}
