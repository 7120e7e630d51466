//! Texture coordinates of surfaces and of points on lights: mirrored shapes, meshes without uv; and a lobe at its
//! limit.

#![allow(clippy::unwrap_used, clippy::panic)] // Helpers of tests are tests too.
mod common;

use common::references::rendered;
use dapple::diff::{Estimate, compare};
use dapple::film::write;
use dapple::gpu::{DeviceChoice, Gpu};
use dapple::import::read_scene;
use dapple::render::{Next, Options, Renderer};
use dapple::shader::{CacheOptions, Compiler, Sources};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

fn device() -> &'static Mutex<(Arc<Gpu>, Compiler)> {
    static DEVICE: OnceLock<Mutex<(Arc<Gpu>, Compiler)>> = OnceLock::new();
    DEVICE.get_or_init(|| {
        let validation = dapple::gpu::validation_from_environment();
        let gpu = Gpu::open(&DeviceChoice { validation, ..DeviceChoice::default() }).unwrap();
        let compiler = Compiler::new(Sources::embedded(), CacheOptions::from_environment());
        Mutex::new((Arc::new(gpu), compiler))
    })
}

/// Renders a scene of 16 x 16 pixels. `corner.png` beside it is black but for its upper left quarter.
fn render(scene: &str) -> Estimate {
    let folder = tempfile::tempdir().unwrap();
    let mut corner = [0_u8; 12];
    corner[..3].fill(255);
    image::save_buffer(folder.path().join("corner.png"), &corner, 2, 2, image::ColorType::Rgb8).unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, format!("film.size = [16, 16]\n{scene}")).unwrap();
    let (scene, _) = read_scene(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
    let mut device = device().lock().unwrap_or_else(PoisonError::into_inner);
    let (gpu, compiler) = &mut *device;
    let renderer = Renderer::open(gpu.clone(), compiler, scene.clone(), Options::of(gpu)).unwrap();
    let film = renderer.render(0, scene.render.spp, &mut |_| Next::Continue).unwrap();
    assert_eq!(film.left_out(), 0, "samples that are not finite");
    let file = folder.path().join("a.exr");
    write(&file, &film.resolve(), &scene.film, &film.meta()).unwrap();
    rendered(&file).unwrap()
}

/// That two pictures are the same but for noise, and not black.
fn assert_same(a: &Estimate, b: &Estimate) {
    assert!(a.mean.iter().any(|p| p[0] > 0.01), "a black picture shows nothing");
    let verdict = compare(a, b, 0.0);
    assert!(verdict.accepted(), "{verdict}");
}

/// A triangle that shows the picture, with `mesh` added to its mesh and `instances` of it.
fn triangle(mesh: &str, instances: &str) -> Estimate {
    render(&format!(
        r#"
        camera = {{ position = [0, 0, 3], target = [0, 0, 0] }}
        texture.corner = {{ kind = "image", file = "corner.png", wrap = "clamp" }}
        material.picture = {{ kind = "unlit", color = {{ texture = "corner" }} }}
        [mesh.one]
        positions = [[-1, -1, 0], [1, -1, 0], [1, 1, 0]]
        triangles = [[0, 1, 2]]
        {mesh}
        {instances}
        "#
    ))
}

const ALONE: &str = "[[instance]]\nmesh = 'one'\nmaterial = 'picture'\n";
const MIRRORED: &str =
    "[[instance]]\nmesh = 'one'\nmaterial = 'picture'\ntransform = [{ scale = [-1, 1, 1] }]\n";
const BEHIND: &str =
    "[[instance]]\nmesh = 'one'\nmaterial = 'picture'\ntransform = [{ translate = [0, 0, 9] }]\n";

#[test]
fn a_mesh_without_uv_has_those_of_the_manual_whether_it_has_normals_or_not() {
    let uvs = "uvs = [[0, 0], [1, 0], [1, 1]]";
    let normals = "normals = [[0, 0, 1], [0, 0, 1], [0, 0, 1]]";
    let expected = triangle(uvs, ALONE);
    assert_same(&expected, &triangle("", ALONE));
    assert_same(&expected, &triangle(normals, ALONE));
}

#[test]
fn a_mirrored_mesh_keeps_its_uv_alone_and_shared() {
    let expected = triangle("uvs = [[0, 0], [1, 0], [1, 1]]", MIRRORED);
    assert_same(&expected, &triangle("", MIRRORED));
    assert_same(&expected, &triangle("", &format!("{MIRRORED}{BEHIND}")));
}

/// A floor under a light that shines with the picture.
fn lit_floor(texture: &str, light: &str) -> Estimate {
    render(&format!(
        r#"
        render = {{ spp = 256, max_depth = 1 }}
        camera = {{ position = [0, 0.9, 3], target = [0, 0, 0] }}
        texture.corner = {{ kind = "image", file = "corner.png", filter = "nearest", {texture} }}
        material.floor = {{ kind = "diffuse", color = 0.8 }}
        [[shape]]
        kind = "quad"
        center = [0, 0, 0]
        edge_u = [3, 0, 0]
        edge_v = [0, 0, -3]
        material = "floor"
        [[light]]
        radiance = {{ texture = "corner" }}
        {light}
        "#
    ))
}

#[test]
fn a_mirrored_quad_light_shines_where_its_picture_is_bright() {
    let mirrored = lit_floor(
        "",
        "kind = 'quad'\norigin = [-0.5, 1, -0.5]\nedge_u = [1, 0, 0]\nedge_v = [0, 0, 1]\n\
         transform = [{ scale = [-1, 1, 1] }]",
    );
    // The same corners; its front is on top, but it shines below too
    let plain = lit_floor(
        "",
        "kind = 'quad'\norigin = [0.5, 1, -0.5]\nedge_u = [-1, 0, 0]\nedge_v = [0, 0, 1]\ntwo_sided = true",
    );
    assert_same(&plain, &mirrored);
}

#[test]
fn a_mirrored_disk_light_shines_where_its_picture_is_bright() {
    let disk = "kind = 'disk'\nradius = 0.7\ncenter = [0, 1, 0]\nnormal = [0, -1, 0]\n";
    let mirrored =
        lit_floor("", &format!("{disk}meridian = [1, 0, 0]\ntransform = [{{ scale = [-1, 1, 1] }}]"));
    // Its longitude runs the other way
    let plain = lit_floor("uv_scale = [-1, 1]", &format!("{disk}meridian = [-1, 0, 0]"));
    assert_same(&plain, &mirrored);
}

#[test]
fn a_sphere_light_shines_where_its_picture_is_bright() {
    // Below a sphere whose lower pole is in the bright half of the picture, within its radius of the axis, nothing
    // of the dark half is seen: as if all of it were bright.
    let scene = |radiance: &str| {
        render(&format!(
            r#"
            render = {{ spp = 256, max_depth = 1 }}
            camera = {{ position = [0, 0.2, 3], target = [0, 0, 0], fov = 20 }}
            [texture.corner]
            kind = "image"
            file = "corner.png"
            filter = "nearest"
            wrap = "clamp"
            uv_scale = [0.4, 1]
            [material.floor]
            kind = "diffuse"
            color = 0.8
            [[shape]]
            kind = "disk"
            radius = 0.5
            material = "floor"
            [[light]]
            kind = "sphere"
            center = [0, 1.2, 0]
            radius = 0.5
            pole = [0, -1, 0]
            radiance = {radiance}
            "#
        ))
    };
    assert_same(&scene("1"), &scene("{ texture = 'corner' }"));
}

#[test]
fn a_phong_lobe_of_exponent_0_fills_the_half_space_about_the_mirror_direction() {
    // ks / π over the directions above the surface that are also within a right angle of the mirror direction,
    // seen at 60°: ks (1 + cos 60°) / 2
    let picture = render(
        r#"
        render = { spp = 256, max_depth = 1 }
        camera = { position = [0, 1, 1.7320508], target = [0, 0, 0], fov = 1 }
        environment = { color = 1 }
        material.wide = { kind = "phong", diffuse = 0, specular = 0.5, exponent = 0 }
        [[shape]]
        kind = "disk"
        radius = 1
        material = "wide"
        "#,
    );
    let mean = picture.mean.iter().map(|p| p[0]).sum::<f64>() / 256.0;
    let error = picture.variance.iter().map(|p| p[0]).sum::<f64>().sqrt() / 256.0;
    assert!((mean - 0.375).abs() < 4.0 * error + 1e-3, "{mean} with a standard error of {error}, not 0.375");
}
