//! The same scene gives the same sums, however the work is cut: slices, runs, windows, threads, back ends, parked rays.

use dapple::film::Film;
use dapple::gpu::{DeviceChoice, Gpu};
use dapple::layout::Backend;
use dapple::prepare;
use dapple::render::{Next, Options, Renderer, Slicing};
use dapple::scene::{
    Conductor, Dielectric, Emission, Environment, Fresnel, Handle, Instance, Lens, Material, Mesh, Rect,
    Scene, Shape, ShapeKind, Surface, Value,
};
use dapple::shader::{CacheOptions, Compiler, Sources};
use glam::{Affine3A, Mat3, Vec3};
use std::sync::{Arc, LazyLock};

static GPU: LazyLock<Result<Arc<Gpu>, String>> = LazyLock::new(|| {
    let validation = std::env::var_os("DAPPLE_VALIDATION").is_some();
    let choice = DeviceChoice { validation, ..DeviceChoice::default() };
    Gpu::open(&choice).map(Arc::new).map_err(|error| error.to_string())
});

fn render(scene: &Scene, options: impl FnOnce(Options) -> Options, first: u32, spp: u32) -> Film {
    let result = GPU.clone().and_then(|gpu| {
        let mut compiler = Compiler::new(Sources::embedded(), CacheOptions::from_environment());
        let options = options(Options::of(&gpu));
        Renderer::open(gpu, &mut compiler, scene, options)
            .and_then(|renderer| renderer.render(first, spp, &mut |_| Next::Continue))
            .map_err(|error| error.to_string())
    });
    match result {
        Ok(film) => film,
        Err(error) => {
            assert!(error.is_empty(), "{error}");
            std::process::exit(1)
        }
    }
}

fn with_slots(slots: u32) -> impl FnOnce(Options) -> Options {
    move |options| Options { slicing: Slicing { slots, ..options.slicing }, ..options }
}

fn shape(kind: ShapeKind, material: Handle<Material>) -> Shape {
    Shape { name: "shape".into(), kind, material, world_from_object: Affine3A::IDENTITY }
}

fn diffuse(scene: &mut Scene, color: f32) -> Handle<Material> {
    let surface = Surface::Diffuse { color: Value::Constant(Vec3::splat(color)) };
    scene.materials.add("diffuse", Material { surface, emission: None })
}

/// Spheres of clay, metal and glass, two copies of a mesh, a lamp and a sky, seen through a lens: 37 × 29 pixels.
fn scene() -> Scene {
    let mut scene = Scene::default();
    (scene.film.width, scene.film.height) = (37, 29);
    scene.render.max_depth = 6;
    scene.camera.position = Vec3::new(0.0, 1.0, 6.0);
    scene.camera.lens = Some(Lens {
        aperture: dapple::scene::Aperture::Radius(0.05),
        focus_distance: 6.0,
        blades: 5,
        blade_rotation: 10.0,
    });
    let clay = diffuse(&mut scene, 0.6);
    let zero = Value::Constant(0.0);
    let glass =
        Dielectric { ior: 1.5, alpha_u: zero, alpha_v: zero, absorption: Vec3::splat(0.2), thin: false };
    let metal = Conductor {
        reflectance: Value::Constant(Vec3::splat(0.8)),
        fresnel: Fresnel::Exact,
        alpha_u: Value::Constant(0.2),
        alpha_v: Value::Constant(0.2),
    };
    let lamp = Emission { radiance: Value::Constant(Vec3::splat(8.0)), two_sided: true };
    let mut add = |surface, emission| scene.materials.add("material", Material { surface, emission });
    let glass = add(Surface::Dielectric(glass), None);
    let metal = add(Surface::Conductor(metal), None);
    let lamp = add(Surface::Diffuse { color: Value::Constant(Vec3::ZERO) }, Some(lamp));
    let sphere = |x: f32| ShapeKind::Sphere {
        center: Vec3::new(x, 0.0, 0.0),
        radius: 0.7,
        pole: Vec3::Y,
        meridian: Vec3::X,
    };
    let quad = |origin, edge_u, edge_v| ShapeKind::Quad { origin, edge_u, edge_v };
    let floor = quad(Vec3::new(-9.0, -0.7, 9.0), Vec3::X * 18.0, Vec3::NEG_Z * 18.0);
    let light = quad(Vec3::new(-1.0, 3.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0);
    scene.shapes = vec![
        shape(sphere(-1.6), clay),
        shape(sphere(0.0), glass),
        shape(sphere(1.6), metal),
        shape(floor, clay),
        shape(light, lamp),
    ];
    let mesh = scene.meshes.add("triangle", triangles(1));
    for x in [-1.0, 1.0] {
        let world_from_object = Affine3A::from_translation(Vec3::new(x, 1.0, -1.0));
        scene.instances.push(Instance { name: "copy".into(), mesh, material: clay, world_from_object });
    }
    scene.environment = Some(Environment {
        radiance: Value::Constant(Vec3::new(0.2, 0.3, 0.4)),
        scale: 1.0,
        world_from_environment: Mat3::IDENTITY,
    });
    scene
}

/// The same triangle `count` times.
fn triangles(count: usize) -> Mesh {
    Mesh {
        positions: vec![Vec3::new(-0.8, -0.6, 0.0), Vec3::new(0.8, -0.6, 0.1), Vec3::new(0.0, 0.8, 0.2)],
        triangles: vec![[0, 1, 2]; count],
        ..Mesh::default()
    }
}

#[test]
fn sums_do_not_depend_on_slices() {
    let scene = scene();
    let whole = render(&scene, |options| options, 0, 8);
    assert_eq!(whole.left_out(), 0);
    for slots in [64, 4096, 65_536] {
        assert!(whole == render(&scene, with_slots(slots), 0, 8), "{slots} slots");
    }
}

#[test]
fn runs_that_share_the_samples_merge_to_the_same_sums() {
    let scene = scene();
    let mut first = render(&scene, |options| options, 0, 3);
    first.merge(&render(&scene, |options| options, 3, 5)).unwrap();
    assert!(first == render(&scene, |options| options, 0, 8));
    assert!(first != render(&scene, |options| options, 1, 8), "other samples must differ");
}

#[test]
fn a_window_has_the_pixels_of_the_whole_picture() {
    let mut scene = scene();
    let whole = render(&scene, |options| options, 0, 4).resolve();
    let window = Rect { x0: 5, y0: 3, x1: 26, y1: 20 };
    scene.film.crop = Some(window);
    let part = render(&scene, |options| options, 0, 4).resolve();
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let in_part = ((y - window.y0) * window.width() + x - window.x0) as usize;
            assert_eq!(part.rgb[in_part], whole.rgb[(y * 37 + x) as usize], "pixel {x}, {y}");
        }
    }
}

#[test]
fn both_ways_to_read_give_the_same_sums() {
    let scene = scene();
    let [texel, storage] = [Backend::Texel, Backend::Storage]
        .map(|backend| render(&scene, |options| Options { backend, ..options }, 0, 4));
    assert!(texel == storage);
}

#[test]
fn preparing_does_not_depend_on_threads() {
    let scene = scene();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| prepare::prepare(&scene).unwrap())
    };
    let one = with(1);
    assert!(one == with(2) && one == with(7));
}

/// A hundred thousand triangles in one place: a ray meets them all, more than the 65,535 rounds that Mesa before 25.0
/// allows the loops of a subgroup. Rays are parked and go on, and see what they see of one triangle.
#[test]
fn rays_are_parked_where_loops_would_be_cut() {
    let picture = |count| {
        let mut scene = Scene::default();
        (scene.film.width, scene.film.height) = (8, 8);
        scene.render.max_depth = 1;
        scene.camera.position = Vec3::new(0.0, 0.0, 4.0);
        let material = diffuse(&mut scene, 0.5);
        let mesh = scene.meshes.add("stack", triangles(count));
        let world_from_object = Affine3A::IDENTITY;
        scene.instances.push(Instance { name: "stack".into(), mesh, material, world_from_object });
        // A floor behind the stack, so that shadow rays pass through it too
        let wall = ShapeKind::Quad {
            origin: Vec3::new(-3.0, -3.0, -0.5),
            edge_u: Vec3::X * 6.0,
            edge_v: Vec3::Y * 6.0,
        };
        scene.shapes = vec![shape(wall, material)];
        scene.lights = vec![dapple::scene::Light::Point {
            position: Vec3::new(2.0, 0.4, 2.0),
            intensity: Vec3::splat(20.0),
        }];
        render(&scene, |options| options, 0, 1).resolve()
    };
    let (many, one) = (picture(100_000), picture(1));
    assert!(one.rgb.iter().any(|c| c[0] > 0.1) && one.rgb.iter().any(|c| c[0] == 0.0), "light and shadow");
    assert_eq!(many.rgb, one.rgb);
    assert_eq!(many.depth, one.depth);
}
