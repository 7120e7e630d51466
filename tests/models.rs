//! Models whose pictures have a right answer: those of the collection in `../shared/assets/gltf`, and one in OBJ.
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
use dapple::scene::{Projection, Scene, Surface};
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

/// Covered part of the middle of a picture of a model, from a place towards another.
fn covered(file: &Path, position: [f32; 3], target: [f32; 3]) -> f32 {
    let scene = scene_with(
        file,
        &format!(
            "film.size = [8, 8]\nrender = {{ spp = 4, max_depth = 1 }}\nenvironment.color = 1\n\
             camera = {{ position = {position:?}, target = {target:?}, fov = 2 }}"
        ),
    );
    let picture = render(&scene);
    picture.alpha.iter().sum::<f32>() / picture.alpha.len() as f32
}

#[test]
fn what_is_single_sided_is_not_there_from_inside() {
    let Some(file) = model("01_single_vs_double_sided/01_single_vs_double_sided.gltf") else { return };
    // Balls with holes at their poles, whose axis is upright: the double-sided one at the origin, the other beside it
    assert_eq!(covered(&file, [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]), 1.0);
    assert_eq!(covered(&file, [-2.5, 0.0, 0.0], [-2.5, 0.0, 1.0]), 0.0);
    for x in [0.0, -2.5] {
        assert_eq!(covered(&file, [x, 0.0, 3.0], [x, 0.0, 0.0]), 1.0, "from outside at {x}");
    }
    let Some(plane) = model("TwoSidedPlane/TwoSidedPlane.gltf") else { return };
    for y in [3.0, -3.0] {
        assert_eq!(covered(&plane, [0.1, y, 0.1], [0.0, 0.0, 0.0]), 1.0, "from {y}");
    }
}

#[test]
fn colours_of_vertices_are_linear_and_mixed_over_the_triangle() {
    let Some(file) = model("22_vertex_color/22_vertex_color.gltf") else { return };
    let side = |below: bool| {
        let (y, up) = if below { (-5, 1) } else { (5, -1) };
        let mut scene = scene_with(
            &file,
            &format!(
                "film.size = [40, 80]\nrender = {{ spp = 64, max_depth = 0 }}\nenvironment.color = 1\n\
                 camera = {{ kind = 'orthographic', position = [0, {y}, 1], target = [0, 0, 1], up = [0, 0, {up}], view_size = 8 }}"
            ),
        );
        let colors: Vec<_> =
            scene.materials.iter().map(|(handle, _, material)| (handle, material.surface.clone())).collect();
        for (handle, surface) in colors {
            let Surface::Principled(principled) = surface else { panic!("{surface:?}") };
            scene.materials[handle].surface = Surface::Unlit { color: principled.base_color };
        }
        render(&scene)
    };
    let corners = [[2250, 51349, 4864], [4736, 637, 51349], [65535, 41337, 31412]]
        .map(|c: [u16; 3]| c.map(|x| f32::from(x) / 65535.0));
    let picture = side(true);
    // The triangle (−1, 1), (1, 1), (−1, −1) of x and z, at z = 0 and again at z = 3: the middles of its pixels
    for z in [0.0, 3.0] {
        for (x, y) in [(-0.55, 0.55), (-0.85, 0.75), (-0.75, -0.35), (0.35, 0.85)] {
            let (a, b) = (0.5 * (x + 1.0), 0.5 * (1.0 - y));
            let found = pixel(&picture, [40, 80], 10.0, x, y + z - 1.0);
            for k in 0..3 {
                let expected = (1.0 - a - b) * corners[0][k] + a * corners[1][k] + b * corners[2][k];
                assert!(
                    (found[k] - expected).abs() < 5e-3,
                    "{x} {y} {z}: {found:?}, expected {expected} in {k}"
                );
            }
        }
    }
    assert!(side(false).alpha.iter().all(|alpha| *alpha == 0.0), "its default material has a front alone");
}

#[test]
fn alpha_of_vertices_does_not_make_an_opaque_material_clear() {
    let Some(file) = model("BoxVertexColors/BoxVertexColors.glb") else { return };
    // Its corners have an alpha from 0 to 1, and its material is opaque
    assert_eq!(covered(&file, [2.0, 2.5, 3.0], [0.0, 0.0, 0.0]), 1.0);
}

#[test]
fn a_model_with_two_sets_of_texture_coordinates_has_both() {
    let Some(file) = model("12_orm_two_uvmaps/12_orm_two_uvmaps.gltf") else { return };
    let (scene, warnings) = read_scene(&file, &[]).unwrap();
    assert!(warnings.is_empty(), "{}", warnings[0]);
    let mesh = scene.meshes.iter().next().unwrap().2;
    assert_eq!((mesh.uvs1.len(), mesh.uvs.len()), (24, 24));
    assert_eq!(mesh.uvs1, mesh.uvs, "the sets of this file are alike");
}

#[test]
fn an_obj_file_shines_with_the_pictures_of_its_materials() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    // Four squares of 4 × 4 texels: in their middles nothing is filtered
    let [red, green, blue, white] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]];
    let texel = |i: usize| match (i / 32, i % 8 / 4) {
        (0, 0) => red,
        (0, _) => green,
        (_, 0) => blue,
        _ => white,
    };
    let texels: Vec<u8> = (0..64).flat_map(texel).collect();
    image::save_buffer(at("four.png"), &texels, 8, 8, image::ColorType::Rgb8).unwrap();
    std::fs::write(
        at("m.mtl"),
        "newmtl plain\nKd 0\nKe 0.25 0.5 0.75\nnewmtl four\nKd 0\nKe 2 1 1\nmap_Ke -o 0.5 0 four.png\n",
    )
    .unwrap();
    let square = |x: i32| format!("v {x} 0 0\nv {} 0 0\nv {} 2 0\nv {x} 2 0\n", x + 2, x + 2);
    let object = format!(
        "mtllib m.mtl\n{}{}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl plain\nf 1/1 2/2 3/3 4/4\nusemtl four\nf 5/1 6/2 7/3 8/4\n",
        square(-2),
        square(0)
    );
    std::fs::write(at("m.obj"), object).unwrap();
    let scene = scene_with(
        &at("m.obj"),
        "film.size = [36, 18]\nrender = { spp = 16, max_depth = 0 }\n\
         camera = { kind = 'orthographic', position = [0, 1, 5], target = [0, 1, 0], view_size = 2 }",
    );
    let picture = render(&scene);
    let near = |x: f32, y: f32, expected: [f32; 3]| {
        let found = pixel(&picture, [36, 18], 9.0, x, y - 1.0);
        let same = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(same, "{x} {y}: {found:?}, expected {expected:?}");
    };
    near(-1.0, 1.0, [0.25, 0.5, 0.75]);
    // The picture is moved by half of its width
    near(0.5, 0.5, [2.0, 1.0, 1.0]);
    near(1.5, 0.5, [0.0, 0.0, 1.0]);
    near(0.5, 1.5, [0.0, 1.0, 0.0]);
    near(1.5, 1.5, [2.0, 0.0, 0.0]);
}
