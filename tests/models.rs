//! glTF models whose pictures have a right answer, from the collection in `../shared/assets/gltf`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

mod common;

use common::render::*;
use dapple::film::Picture;
use dapple::import::{ModelChoice, read_scene, read_scene_showing};
use dapple::scene::{Projection, Scene};
use std::path::{Path, PathBuf};

/// A model of the collection; none, with a notice, where it is missing outside CI.
fn model(name: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/assets/gltf");
    if folder.is_dir() {
        return Some(folder.join(name));
    }
    assert_ne!(std::env::var("CI").as_deref(), Ok("true"), "{} is missing", folder.display());
    eprintln!("notice: {} is missing, nothing was checked", folder.display());
    None
}

/// A scene of a model, with the rest of a scene file.
fn scene_with(model: &Path, rest: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("{rest}\n[[instance]]\nfile = '{}'\n", model.display())).unwrap();
    read_scene(&file, &[]).unwrap_or_else(|error| panic!("{error}")).0
}

/// The pixel at a place, in units of the scene from the middle of a picture of so many pixels a unit.
fn pixel(picture: &Picture, size: [u32; 2], unit: f32, x: f32, y: f32) -> [f32; 3] {
    let column = (size[0] as f32 / 2.0 + x * unit) as usize;
    let row = (size[1] as f32 / 2.0 - y * unit) as usize;
    picture.rgb[row * size[0] as usize + column]
}

#[test]
fn all_modes_of_triangles_show_the_same_square() {
    let Some(folder) = model("Mesh_PrimitiveMode") else { return };
    let picture = |number: &str| {
        let file = folder.join(format!("Mesh_PrimitiveMode_{number}.gltf"));
        let set = [("film.size", "[24, 24]"), ("render.spp", "4"), ("render.max_depth", "1")];
        let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
        render(&read_scene(&file, &set).unwrap().0)
    };
    let plain = picture("06");
    let covered = plain.alpha.iter().filter(|alpha| **alpha == 1.0).count();
    assert!((200..500).contains(&covered), "{covered} pixels of the square");
    for number in ["04", "05", "11"] {
        let other = picture(number);
        for (a, b) in plain.depth.iter().zip(&other.depth) {
            assert!(a == b || (a - b).abs() < 1e-5 * a, "{number}: {a} {b}");
        }
        assert_eq!(other.alpha, plain.alpha, "{number}");
    }
}

#[test]
fn roughness_from_a_texture_is_that_of_the_factor() {
    let Some(file) = model("roughness-scale/scene.gltf") else { return };
    let scene = scene_with(
        &file,
        "film.size = [120, 72]\nrender = { spp = 160, max_depth = 1 }\n\
         camera = { kind = 'orthographic', position = [20, 0, 0], view_size = 9 }\n\
         light = [{ kind = 'distant', direction = [-1, -0.5, 0.3], irradiance = 3 }]",
    );
    assert!(scene.lights.len() == 1 && scene.environment.is_none(), "the scene has a light of its own");
    let picture = render(&scene);
    let mut highest = Vec::new();
    for z in [3.0, 0.0, -3.0, -6.0, 6.0] {
        let sphere = |row: usize| {
            let column = ((7.5 - z) * 8.0) as usize;
            let rows = row - 8..row + 8;
            rows.flat_map(move |y| (column - 8..column + 8).map(move |x| y * 120 + x)).collect::<Vec<_>>()
        };
        // By texture above, by factor below
        let (above, below) = (sphere(12), sphere(60));
        expect_same(mean_of(&picture, above.iter().copied()), mean_of(&picture, below.iter().copied()), 2e-3);
        let peak = |pixels: &[usize]| pixels.iter().map(|i| picture.rgb[*i][1]).fold(0.0, f32::max);
        let (a, b) = (peak(&above), peak(&below));
        assert!((a / b - 1.0).abs() < 0.1, "at z = {z} the highlights are {a} and {b}");
        highest.push(b);
    }
    // From roughness 1/255 on highlights grow wider and darker
    highest.rotate_right(1);
    assert!(highest[1] > 2.0 * highest[2] && highest[2] > 1.05 * highest[4], "{highest:?}");
}

#[test]
fn the_self_checking_texture_transforms_are_right() {
    let Some(file) = model("TextureTransformTest/TextureTransformTest.gltf") else { return };
    let scene = scene_with(
        &file,
        "film.size = [144, 96]\nrender = { spp = 16, max_depth = 2 }\nenvironment.color = 1\n\
         camera = { kind = 'orthographic', position = [0, 0, 5], view_size = 2.4 }",
    );
    let picture = render(&scene);
    let at = |x: f32, y: f32| pixel(&picture, [144, 96], 40.0, x, y);
    // Above, in the corner of each cell: green for an offset of u, blue for v, and both for u and v
    let [u, v, both] = [-1.1, 0.0, 1.1].map(|x| at(x - 0.35, 0.55 + 0.35));
    assert!(u[1] > 3.0 * u[0] && u[1] > 3.0 * u[2], "{u:?}");
    assert!(v[2] > 3.0 * v[0] && v[2] > 3.0 * v[1], "{v:?}");
    assert!(both[1] > 2.0 * both[0] && both[2] > 2.0 * both[0], "{both:?}");
    // Below, the dark arrows that point at the green squares: by rotation, scale, and all at once
    for (x, arrow) in [
        (-1.1, [[-0.41, 0.3], [-0.3, 0.0], [-0.18, -0.3]]),
        (0.0, [[-0.4, 0.4], [-0.3, 0.3], [-0.12, 0.1]]),
        (1.1, [[-0.34, 0.3], [-0.24, 0.1], [-0.14, -0.1]]),
    ] {
        for [dx, dy] in arrow {
            let found = at(x + dx, -0.55 + dy);
            assert!(found[1] < 0.35, "the arrow at {x} is not at {dx}, {dy}: {found:?}");
            let beside = at(x + dx + 0.25, -0.55 + dy);
            assert!(beside[1] > 0.5, "the arrow at {x} is too wide at {dx}, {dy}: {beside:?}");
        }
    }
}

#[test]
fn a_sparse_accessor_moves_the_tips_of_the_model() {
    let Some(file) = model("SimpleSparseAccessor/SimpleSparseAccessor.gltf") else { return };
    let scene = scene_with(
        &file,
        "film.size = [70, 50]\nrender = { spp = 4, max_depth = 0 }\nenvironment.color = 1\n\
         camera = { kind = 'orthographic', position = [3, 2.5, 9], target = [3, 2.5, 0], view_size = 5 }",
    );
    let picture = render(&scene);
    // Rows of seven vertices at y = 0 and y = 1, of which those at x = 1, 3 and 5 are lifted to y = 2, 3 and 4 with x + 1 between
    let covered = |x: f32, y: f32| picture.alpha[(50.0 - y * 10.0) as usize * 70 + (5.0 + x * 10.0) as usize];
    for (x, top) in [(1.0, 2.0), (3.0, 3.0), (5.0, 4.0)] {
        assert_eq!([covered(x, top - 0.5), covered(x, top + 0.15)], [1.0, 0.0], "the tip at {x}");
    }
    assert_eq!([covered(1.95, 0.85), covered(1.95, 1.25)], [1.0, 0.0], "between two tips");
}

#[test]
fn cameras_of_the_file_are_chosen_by_number_and_give_the_picture_its_shape() {
    let Some(file) = model("Cameras/Cameras.gltf") else { return };
    let shown = |camera: Option<&str>| {
        let choice = ModelChoice { camera: camera.map(str::to_owned), ..ModelChoice::default() };
        read_scene_showing(&file, &[], &choice).unwrap().0
    };
    let first = shown(None);
    assert!(matches!(first.camera.projection, Projection::Perspective(_)));
    assert_eq!((first.film.width, first.film.height), (480, 480), "the aspect ratio of the camera is 1");
    let mut second = shown(Some("1"));
    assert!(matches!(second.camera.projection, Projection::Orthographic { size: 2.0, .. }));
    // The square of x from 0 to 1 is tilted about x by 45°: from y = 0 to √½ of the two units that are seen about (½, ½)
    (second.film.width, second.film.height, second.render.spp) = (40, 40, 4);
    let picture = render(&second);
    let alpha = |x: f32, y: f32| {
        picture.alpha[(20.0 - (y - 0.5) * 20.0) as usize * 40 + (20.0 + (x - 0.5) * 20.0) as usize]
    };
    assert_eq!([alpha(0.5, 0.1), alpha(0.5, 0.62), alpha(0.1, 0.3), alpha(0.9, 0.3)], [1.0; 4]);
    assert_eq!([alpha(0.5, -0.1), alpha(0.5, 0.8), alpha(-0.1, 0.3), alpha(1.1, 0.3)], [0.0; 4]);
}

#[test]
fn alpha_modes_and_cutoffs_are_those_that_the_materials_are_named_after() {
    let Some(file) = model("AlphaBlendModeTest/AlphaBlendModeTest.glb") else { return };
    let (scene, warnings) = read_scene(&file, &[]).unwrap();
    assert!(warnings.is_empty(), "{}", warnings[0]);
    let cutoff = |name: &str| {
        let (.., material) = scene.materials.iter().find(|(_, found, _)| found.contains(name)).unwrap();
        (material.detail.opacity.is_whole(), material.detail.opacity.cutoff)
    };
    assert_eq!(cutoff("MatOpaque"), (true, None));
    assert_eq!(cutoff("MatBlend"), (false, None));
    assert_eq!(cutoff("MatCutoff25"), (false, Some(0.25)));
    assert_eq!(cutoff("MatCutoffDefault"), (false, Some(0.5)));
    assert_eq!(cutoff("MatCutoff75"), (false, Some(0.75)));
}

#[test]
fn instances_are_stored_once() {
    let Some(file) = model("24_gpu_instancing/24_gpu_instancing.gltf") else { return };
    let (scene, _) = read_scene(&file, &[]).unwrap();
    let stored: usize = scene.meshes.iter().map(|(.., mesh)| mesh.triangles.len()).sum();
    assert_eq!((stored, scene.instances.len()), (4034, 1900));
    let placed: usize = scene.instances.iter().map(|i| scene.meshes[i.mesh].triangles.len()).sum();
    assert!((7_600_000..7_700_000).contains(&placed), "{placed}");
}
