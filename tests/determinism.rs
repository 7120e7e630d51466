//! The same scene, seed and device give the same sums, however the work is cut.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

mod common;

use common::render::*;
use dapple::film::Film;
use dapple::layout::Backend;
use dapple::prepare::prepare;
use dapple::render::{Next, Options, Slicing};
use dapple::scene::*;
use glam::{Affine3A, Quat, Vec2, Vec3};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::Duration;

/// Something of everything: a mesh of its own tree, a baked one, spheres, disks, all materials, all kinds of light, pictures,
/// a lens, motion. 37 × 21 pixels, so that tiles reach beyond the picture.
fn everything() -> Scene {
    let mut s = scene(37, 21, 8);
    s.camera = look(Vec3::new(0.0, 1.5, 5.0), Vec3::new(0.0, 0.5, 0.0), 50.0);
    let aperture = Aperture::Radius(0.05);
    let mut lens = Lens::new(aperture, 5.0);
    (lens.opening.blades, lens.opening.blade_rotation) = (5, 10.0);
    s.camera.projection = Projection::thin_lens(50.0, lens);
    let mut random = Random(3);
    let texels = (0..15 * 7).map(|_| [0; 4].map(|_: u8| (random.uniform() * 256.0) as u8)).collect();
    let image = Image { width: 15, height: 7, texels: Texels::Rgba8(texels) };
    let picture = Value::Texture(s.picture(image, |t| t.color_space = ColorSpace::Srgb));
    let floor = s.material(Surface::diffuse(picture), None);
    s.quad(Vec3::new(-6.0, 0.0, 6.0), Vec3::X * 12.0, Vec3::NEG_Z * 12.0, floor);
    let phong = s.material(Surface::phong(grey(0.3), picture, Value::Constant(20.0)), None);
    let metal = s.conductor(0.9, 0.2, Fresnel::Exact);
    let mirror = s.conductor(0.9, 0.0, Fresnel::Schlick);
    let clear = s.glass(1.5, 0.0, Vec3::new(0.1, 0.4, 0.2), false);
    let rough = s.glass(1.4, 0.15, Vec3::ZERO, false);
    s.sphere(Vec3::new(-1.8, 0.6, 0.5), 0.6, clear);
    s.sphere(Vec3::new(-0.3, 0.5, 1.2), 0.5, rough);
    s.sphere(Vec3::new(1.2, 0.7, -0.4), 0.7, mirror);
    s.disk(Vec3::new(2.2, 0.8, 0.3), Vec3::new(-1.0, 0.2, 0.5).normalize(), 0.6, metal);
    let bar = s.meshes.add("bar", box_mesh(Vec3::new(-0.3, 0.0, -0.3), Vec3::new(0.3, 1.0, 0.3), false));
    s.place(
        bar,
        phong,
        Affine3A::from_rotation_translation(Quat::from_rotation_y(0.5), Vec3::new(0.3, 0.0, -1.5)),
    );
    s.place(
        bar,
        metal,
        Affine3A::from_scale_rotation_translation(
            Vec3::new(-1.0, 2.0, 1.0),
            Quat::IDENTITY,
            Vec3::new(-2.5, 0.0, -2.0),
        ),
    );
    let lamp = s.emitter(grey(6.0), false);
    s.quad(Vec3::new(-0.5, 3.0, -0.5), Vec3::X, Vec3::Z, lamp);
    let glow = s.emitter(picture, true);
    let mut sheet = rectangle_mesh(Vec3::new(-3.0, 0.5, 1.0), Vec3::new(0.3, 0.0, -1.0), Vec3::Y);
    sheet.uvs = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let sheet = s.meshes.add("sheet", sheet);
    s.place(sheet, glow, Affine3A::IDENTITY);
    s.lights.push(point(Vec3::new(2.0, 2.0, 2.0), 3.0));
    // The camera, a ball, a sheet and one of the bars move
    let (position, target) = (Vec3::new(0.1, 1.4, 5.0), Vec3::new(0.0, 0.6, 0.0));
    s.camera.at_close = Some(Stand { position, target, up: Vec3::Y });
    let turn = Affine3A::from_rotation_y(0.2);
    s.sphere(Vec3::new(0.8, 1.8, 0.0), 0.3, phong).at_close = Some(turn);
    s.quad(Vec3::new(-1.8, 1.5, 0.0), Vec3::X, Vec3::Y * 0.5, glow).at_close = Some(turn);
    s.instances[0].at_close = Some(s.instances[0].world_from_object * turn);
    s.environment = constant_environment(0.2);
    s
}

fn with_slots(slots: u32) -> Options {
    Options { slicing: Slicing { slots, budget: Duration::from_millis(60) }, ..options() }
}

fn render_range(scene: &Scene, options: Options, first: u32, spp: u32) -> Film {
    open(scene, options).render(first, spp, &mut |_| Next::Continue).unwrap()
}

#[test]
fn sums_do_not_depend_on_slicing() {
    let scene = everything();
    let whole = film_of(&scene, with_slots(65_536));
    assert_eq!(whole.left_out(), 0);
    for slots in [64, 4096] {
        assert!(film_of(&scene, with_slots(slots)) == whole, "{slots} slots");
    }
    // A budget that is never kept, so that slices shrink as they go
    let hurried = Options { slicing: Slicing { slots: 65_536, budget: Duration::ZERO }, ..options() };
    assert!(film_of(&scene, hurried) == whole, "no budget");
    let mut other = scene;
    other.render.seed = 1;
    assert!(
        film_of(&other, with_slots(65_536)).resolve().rgb != whole.resolve().rgb,
        "the seed does nothing"
    );
}

#[test]
fn ranges_of_samples_merge_to_the_whole() {
    let scene = everything();
    let whole = render_range(&scene, options(), 0, 8);
    let mut parts = render_range(&scene, options(), 3, 5);
    parts.merge(&render_range(&scene, options(), 0, 3)).unwrap();
    assert!(parts == whole);
    assert!(render_range(&scene, options(), 0, 3) != render_range(&scene, options(), 3, 3));
}

#[test]
fn a_render_that_is_stopped_has_whole_passes() {
    let mut scene = everything();
    scene.render.spp = 64;
    let stopped = open(&scene, with_slots(256))
        .render(0, 64, &mut |p| if p.spp >= 8 { Next::Stop } else { Next::Continue })
        .unwrap();
    let samples = stopped.resolve().samples;
    assert!(samples[0] >= 8 && samples[0] < 64 && samples.iter().all(|&n| n == samples[0]), "{}", samples[0]);
    assert!(stopped == render_range(&scene, options(), 0, samples[0]));
}

#[test]
fn a_crop_has_the_pixels_of_the_whole() {
    let mut scene = everything();
    let whole = film_of(&scene, options()).resolve();
    for crop in [
        Rect { x0: 5, y0: 3, x1: 22, y1: 20 },
        Rect { x0: 36, y0: 20, x1: 37, y1: 21 },
        Rect { x0: 0, y0: 9, x1: 37, y1: 10 },
    ] {
        scene.film.crop = Some(crop);
        let part = film_of(&scene, options()).resolve();
        for y in crop.y0..crop.y1 {
            for x in crop.x0..crop.x1 {
                let (i, j) = ((y * 37 + x) as usize, ((y - crop.y0) * crop.width() + x - crop.x0) as usize);
                assert_eq!(whole.rgb[i], part.rgb[j], "{x} {y}");
                assert_eq!(
                    (whole.depth[i], whole.normal[i], whole.albedo[i]),
                    (part.depth[j], part.normal[j], part.albedo[j])
                );
                assert_eq!((whole.alpha[i], whole.variance[i]), (part.alpha[j], part.variance[j]));
            }
        }
    }
}

#[test]
fn prepared_bytes_do_not_depend_on_the_number_of_threads() {
    let mut scene = everything();
    // Enough triangles that the builder works in parallel
    let mut random = Random(1);
    let mut mesh = Mesh::default();
    for i in 0..30_000_u32 {
        let at = random.in_cube(5.0);
        mesh.positions.extend([at, at + random.in_cube(0.1), at + random.in_cube(0.1)]);
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let m = scene.diffuse(0.5);
    let mesh = scene.meshes.add("cloud", mesh);
    scene.place(mesh, m, Affine3A::IDENTITY);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| prepare(&scene).unwrap())
    };
    let one = with(1);
    assert!(one.triangle_count > 30_000);
    assert!(one == with(2) && one == with(7));
}

#[test]
fn both_ways_of_fetching_give_the_same_sums() {
    // The kernels differ only in the instruction that loads a word
    let scene = everything();
    let with = |backend| film_of(&scene, Options { backend, ..options() });
    assert!(with(Backend::Texel) == with(Backend::Storage));
}

/// For the next test, which runs this one alone in a process of its own: prints a hash of all sums.
#[test]
#[ignore = "a part of the test below"]
fn print_a_hash_of_the_sums() {
    let mut hasher = DefaultHasher::new();
    format!("{:?}", film_of(&everything(), options())).hash(&mut hasher);
    println!("sums {:016x}", hasher.finish());
}

#[test]
fn sums_do_not_depend_on_the_threads_of_the_driver() {
    let with = |threads: &str| {
        let run = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "print_a_hash_of_the_sums", "--ignored", "--nocapture"])
            .env("LP_NUM_THREADS", threads)
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&run.stdout).into_owned();
        let at = text.find("sums ").unwrap_or_else(|| panic!("{text}"));
        text[at..at + 21].to_owned()
    };
    let one = with("1");
    assert_eq!(one, with("2"));
    assert_eq!(one, with("7"));
}
