//! Views: what is shown in place of the picture.

use crate::common::render::*;
use dapple::film::{Film, Picture};
use dapple::layout::Backend;
use dapple::prepare::View;
use dapple::render::{Next, Options, Slicing};
use dapple::scene::*;
use dapple::shader::Sources;
use glam::{Affine3A, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

fn showing(view: View) -> Options {
    Options { view: Some(view), ..options() }
}

/// A view of a scene, all of whose samples are sound.
fn show(scene: &Scene, view: View) -> Picture {
    let film = film_of(scene, showing(view));
    assert_eq!((film.left_out(), film.clamped()), (0, 0), "samples left out, and clamped");
    film.resolve()
}

fn centered(size: u32) -> Scene {
    let mut s = scene(size, size, 1);
    s.render.sampler = Sampler::Center;
    s
}

/// Demands a colour of each pixel.
#[track_caller]
fn expect(picture: &Picture, tolerance: f64, expected: impl Fn(u32, u32) -> [f64; 3]) {
    let width = picture.frame.width;
    for (i, rgb) in picture.rgb.iter().enumerate() {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let expected = expected(x, y);
        let off = (0..3).map(|c| (f64::from(rgb[c]) - expected[c]).abs()).fold(0.0, f64::max);
        assert!(off <= tolerance, "pixel {x},{y}: {rgb:?}, expected {expected:?}");
    }
}

/// The number behind a colour of heat: it is 0.98 of the lightness of OKLab, by the way from linear sRGB there (Ottosson 2020).
fn heat_of(rgb: [f32; 3]) -> f64 {
    let [r, g, b] = rgb.map(f64::from);
    let l = (0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b).cbrt();
    let m = (0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b).cbrt();
    let s = (0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b).cbrt();
    (0.210_454_255_3 * l + 0.793_617_785 * m - 0.004_072_046_8 * s) / 0.98
}

/// Demands a heat of every pixel. What of a colour is not in sRGB is cut off, so the lightness is not exact.
#[track_caller]
fn expect_heat(picture: &Picture, expected: f64) {
    for (i, rgb) in picture.rgb.iter().enumerate() {
        let found = heat_of(*rgb);
        assert!((found - expected).abs() < 0.004, "pixel {i}: {rgb:?} is {found}, expected {expected}");
    }
}

/// The point of the unit sphere at (0, 0, −3) that the middle of a pixel sees.
fn on_sphere(scene: &Scene, x: u32, y: u32) -> Option<DVec3> {
    let (_, direction) = center_ray(scene, x, y);
    let center = DVec3::new(0.0, 0.0, -3.0);
    let along = direction.dot(center);
    let under = along * along - center.length_squared() + 1.0;
    (under > 0.0).then(|| (along - under.sqrt()) * direction - center)
}

fn with_sphere() -> Scene {
    let mut s = centered(32);
    let m = s.diffuse(0.5);
    s.sphere(Vec3::new(0.0, 0.0, -3.0), 1.0, m);
    s.camera.projection = Projection::pinhole(50.0);
    s
}

#[test]
fn normals_are_colors() {
    // A wall that is seen from its front or from behind looks at the camera
    for turned in [false, true] {
        let mut s = centered(4);
        let m = s.diffuse(0.5);
        let (u, v) = if turned { (Vec3::Y, Vec3::X) } else { (Vec3::X, Vec3::Y) };
        s.quad(Vec3::new(-5.0, -5.0, -2.0), u * 10.0, v * 10.0, m);
        expect(&show(&s, View::Normals), 0.0, |_, _| [0.5, 0.5, 1.0]);
    }
    let s = with_sphere();
    let picture = show(&s, View::Normals);
    expect(&picture, 1e-5, |x, y| on_sphere(&s, x, y).map_or([0.0; 3], |n| (0.5 + 0.5 * n).to_array()));
    // What is not there is black and not covered
    assert_eq!((picture.alpha[0], picture.alpha[16 * 32 + 16]), (0.0, 1.0));
}

#[test]
fn normals_are_those_that_shading_sees() {
    // Bumps of one of two materials, drawn for each sample
    let mut s = scene(16, 16, 16);
    let texels = Texels::RgbaF32((0..64).map(|i| [(i * 37 % 64) as f32 / 64.0; 4]).collect());
    let texture = s.picture(Image { width: 8, height: 8, texels }, |_| {});
    let bumped = s.diffuse(0.5);
    s.materials[bumped].detail.bump =
        Some(Bump { texture, height: 2.0, derivative: Derivative::Analytic, curvature: true });
    let flat = s.diffuse(0.5);
    let mix = s.material(Surface::Mix(Mix { a: bumped, b: flat, amount: Value::Constant(0.5) }), None);
    s.quad(Vec3::new(-5.0, -5.0, -2.0), Vec3::X * 10.0, Vec3::Y * 10.0, mix);
    let normals = render(&s).normal;
    assert!(normals.iter().any(|n| n[2] < 0.9), "no bump is seen");
    let found = show(&s, View::Normals);
    expect(&found, 2e-6, |x, y| normals[(y * 16 + x) as usize].map(|n| f64::from(0.5 + 0.5 * n)));
}

#[test]
fn a_view_looks_through_what_lets_rays_through() {
    for filter in [1.0, 0.5] {
        let mut s = centered(4);
        let m = s.diffuse(0.5);
        s.materials[m].detail.opacity = Opacity {
            value: Value::Constant(0.0),
            filter: Value::Constant(Vec3::splat(filter)),
            ..Opacity::default()
        };
        // Tilted, so that its normal is another one
        s.quad(Vec3::new(-9.0, -9.0, -1.0), Vec3::new(18.0, 0.0, 0.1), Vec3::Y * 18.0, m);
        let wall = s.diffuse(0.5);
        s.quad(Vec3::new(-9.0, -9.0, -2.0), Vec3::X * 18.0, Vec3::Y * 18.0, wall);
        expect(&show(&s, View::Normals), 0.0, |_, _| [0.5, 0.5, 1.0]);
    }
}

#[test]
fn texture_coordinates_are_colors() {
    // A square of 4 × 4 at z = −2 with 3 repeats of u: its lower left corner is at the lower left of the picture
    let mut s = centered(24);
    let m = s.diffuse(0.5);
    let mut mesh = rectangle_mesh(Vec3::new(-2.0, -2.0, -2.0), Vec3::X * 4.0, Vec3::Y * 4.0);
    mesh.uvs.iter_mut().for_each(|uv| uv.x *= 3.0);
    let mesh = s.meshes.add("wall", mesh);
    s.place(mesh, m, Affine3A::IDENTITY);
    let blue = |u: f64, v: f64| 0.25 * (((8.0 * u).floor() + (8.0 * v).floor()) as i32).rem_euclid(2) as f64;
    // Middles of pixels are at odd 48ths, and cells begin at 48ths times 2 and 6
    expect(&show(&s, View::Uv), 2e-6, |x, y| {
        let (u, v) = (3.0 * (f64::from(x) + 0.5) / 24.0, 1.0 - (f64::from(y) + 0.5) / 24.0);
        [u.fract(), v, blue(u, v)]
    });
    // Longitude from +x about +y, and latitude
    let s = with_sphere();
    let cell_edge = |value: f64| (8.0 * value - (8.0 * value).round()).abs() < 1e-3;
    let picture = show(&s, View::Uv);
    let mut seen = 0;
    expect(&picture, 1e-5, |x, y| {
        let found = picture.rgb[(y * 32 + x) as usize].map(f64::from);
        let Some(n) = on_sphere(&s, x, y) else { return [0.0; 3] };
        let u = ((-n.z).atan2(n.x) / TAU).rem_euclid(1.0);
        let v = 0.5 + n.y.asin() / PI;
        let skip = cell_edge(u) || cell_edge(v);
        [u, v, if skip { found[2] } else { blue(u, v) }]
    });
    seen += picture.alpha.iter().filter(|&&alpha| alpha > 0.0).count();
    assert!(seen > 100, "{seen} pixels of a sphere");
}

#[test]
fn objects_and_materials_have_numbers() {
    // Five columns: a sphere, a quad, two places of one mesh of two materials, one over the other, and nothing
    let mut s = centered(10);
    let [a, b, c] = [0.1, 0.2, 0.3].map(|grey| s.diffuse(grey));
    let mixed = Surface::Mix(Mix { a, b, amount: Value::Constant(0.5) });
    let mix = s.materials.add("mix", Material::new(mixed, None));
    let at = |column: f32| -1.6 + 0.8 * column;
    s.sphere(Vec3::new(2.0 * at(0.0), 0.0, -4.0), 0.7, a);
    s.quad(Vec3::new(at(1.0) - 0.4, -9.0, -2.0), Vec3::X * 0.8, Vec3::Y * 18.0, mix);
    let mut mesh = rectangle_mesh(Vec3::new(-0.4, -0.5, 0.0), Vec3::X * 0.8, Vec3::Y);
    mesh.parts = vec![
        MeshPart { name: String::new(), triangles: 0..1, material: Some(b) },
        MeshPart { name: String::new(), triangles: 1..2, material: None },
    ];
    let mesh = s.meshes.add("card", mesh);
    for y in [-0.6, 0.6] {
        s.place(mesh, c, Affine3A::from_translation(Vec3::new(at(2.0), y, -2.0)));
    }
    let numbers = |view: View| -> Vec<Option<u32>> {
        let picture = show(&s, view);
        picture.rgb.into_iter().map(View::number).collect()
    };
    let (objects, materials) = (numbers(View::Objects), numbers(View::Materials));
    let index = |handle: Handle<Material>| Some(handle.index() as u32);
    for y in 0..10 {
        let row =
            |numbers: &[Option<u32>]| -> [Option<u32>; 5] { [0, 2, 5, 7, 9].map(|x| numbers[y * 10 + x]) };
        let (objects, materials) = (row(&objects), row(&materials));
        assert_eq!((objects[1], materials[1]), (Some(1), index(mix)), "row {y}");
        let card = if (2..8).contains(&y) { Some(if y < 5 { 3 } else { 2 }) } else { None };
        assert_eq!(objects[2], card, "row {y}");
        assert_eq!((objects[3], materials[3], objects[4]), (None, None, None), "row {y}");
    }
    let met: Vec<_> = objects.iter().zip(&materials).filter(|(object, _)| **object == Some(0)).collect();
    assert!(!met.is_empty() && met.iter().all(|(_, material)| **material == index(a)));
    let on_cards = |material| {
        let pairs = objects.iter().zip(&materials);
        pairs.filter(|(object, found)| object.is_some_and(|o| o > 1) && **found == index(material)).count()
    };
    assert!(on_cards(b) > 0 && on_cards(c) > 0 && on_cards(a) == 0);
}

#[test]
fn every_number_has_a_colour_of_its_own() {
    use dapple::layout::NUMBER_FACTOR;
    for number in (0..5000).chain([0x00FF_FFFD, 0x00FF_FFFE]) {
        let bits = (number + 1_u32).wrapping_mul(NUMBER_FACTOR);
        let rgb = [16, 8, 0].map(|shift| (bits >> shift & 255) as f32 / 255.0);
        assert_eq!(View::number(rgb), Some(number));
    }
    assert_eq!(View::number([0.0; 3]), None);
}

#[test]
fn the_cost_of_rays_is_what_they_are_tested_against() {
    // Nothing; one triangle or one sphere, which are met or not; each doubling of 1 + tests is a tenth
    expect(&show(&centered(8), View::BvhCost), 0.0, |_, _| [0.0; 3]);
    let mut s = centered(8);
    let m = s.diffuse(0.5);
    let positions = [(-1.0, -1.0), (1.0, -1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, -2.0));
    let mesh = Mesh { positions: positions.to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let mesh = s.meshes.add("triangle", mesh);
    s.place(mesh, m, Affine3A::IDENTITY);
    expect_heat(&show(&s, View::BvhCost), 0.1);
    let mut s = centered(8);
    let m = s.diffuse(0.5);
    s.sphere(Vec3::new(0.0, 0.0, -3.0), 1.0, m);
    expect_heat(&show(&s, View::BvhCost), 0.1);
    // A field of small triangles: behind it nothing but its first node is seen
    let mut s = centered(16);
    let m = s.diffuse(0.5);
    let mut mesh = Mesh::default();
    for i in 0..1024_u32 {
        let corner = Vec3::new((i % 32) as f32, (i / 32) as f32, 0.0) * 0.05 + Vec3::new(-0.8, -0.8, -2.0);
        mesh.positions.extend([corner, corner + Vec3::X * 0.05, corner + Vec3::Y * 0.05]);
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let mesh = s.meshes.add("field", mesh);
    s.place(mesh, m, Affine3A::IDENTITY);
    let picture = show(&s, View::BvhCost);
    let (corner, middle) = (heat_of(picture.rgb[0]), heat_of(picture.rgb[8 * 16 + 8]));
    assert!((corner - 0.1).abs() < 0.004, "{corner}");
    // Five levels of four children hold 1,024 leaves of one triangle; leaves of four need four levels and four tests
    assert!(middle > 0.25 && middle < 0.7, "{middle}");
}

/// The inside of a white box.
fn white_box() -> Scene {
    let mut s = scene(4, 4, 4);
    let m = s.diffuse(1.0);
    let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
    s.place(mesh, m, Affine3A::IDENTITY);
    s.render.russian_roulette = false;
    s
}

#[test]
fn paths_are_as_deep_as_they_may_be() {
    for (most, bounces, expected) in [(0, None, 0.0), (5, None, 1.0), (20, None, 1.0), (8, Some(2), 0.25)] {
        let mut s = white_box();
        (s.render.max_depth, s.render.diffuse_bounces) = (most, bounces);
        expect_heat(&show(&s, View::PathDepth), expected);
    }
    // Deeper than what is recorded at once, and with light, which the view does not show
    let mut s = white_box();
    (s.render.max_depth, s.render.diffuse_bounces) = (60, Some(30));
    s.lights.push(point(Vec3::splat(0.5), 1e6));
    expect_heat(&show(&s, View::PathDepth), 0.5);
}

/// A shining wall whose quarters along u send out NaN, infinity, less than nothing, and 1.
fn broken_film(view: Option<View>) -> Film {
    let mut s = centered(16);
    let m = s.unlit(grey(1.0));
    s.quad(Vec3::new(-2.0, -2.0, -2.0), Vec3::X * 4.0, Vec3::Y * 4.0, m);
    let line = "if (bsdf.kind == MATERIAL_UNLIT) path.radiance +=";
    let sound = include_str!("../../shaders/stages/shade.comp");
    assert!(sound.contains(line), "the kernel has changed: choose another line to break");
    let broken = "if (surface.uv.x < 0.75) path.radiance.y = uintBitsToFloat(0xbf800000u);
    if (surface.uv.x < 0.5) path.radiance.y = uintBitsToFloat(0x7f800000u);
    if (surface.uv.x < 0.25) path.radiance.y = uintBitsToFloat(0x7fc00000u);
    if (surface.uv.x >= 0.75) path.radiance +=";
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("stages")).unwrap();
    std::fs::write(folder.path().join("stages/shade.comp"), sound.replace(line, broken)).unwrap();
    let renderer = open_with(Sources::folder(folder.path()).unwrap(), &s, Options { view, ..options() });
    renderer.render(0, 1, &mut |_| Next::Continue).unwrap()
}

#[test]
fn samples_that_are_not_finite_are_marked() {
    let (plain, view) = (broken_film(None), broken_film(Some(View::NonFinite)));
    let marks = [[64.0, 0.0, 64.0], [64.0, 64.0, 0.0], [0.0, 64.0, 64.0], [0.1; 3]];
    expect(&view.resolve(), 1e-6, |x, _| marks[x as usize / 4]);
    // They are counted as they are without the view, and none is missing in it
    assert_eq!((plain.left_out(), view.left_out()), (128, 128));
    assert_eq!(plain.first_left_out(), view.first_left_out());
    assert!(view.resolve().samples.iter().all(|&n| n == 1));
    // In the view of the depths they are left out
    assert_eq!(broken_film(Some(View::PathDepth)).left_out(), 128);
}

#[test]
fn views_are_the_same_in_both_back_ends_and_slices() {
    let mut s = with_sphere();
    (s.render.spp, s.render.sampler) = (4, Sampler::Sobol);
    let m = s.diffuse(0.5);
    let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-9.0), Vec3::splat(9.0), true));
    s.place(mesh, m, Affine3A::IDENTITY);
    for view in View::ALL {
        let slicing = Slicing { slots: 4096, ..options().slicing };
        let [texel, storage] = [Backend::Texel, Backend::Storage]
            .map(|backend| film_of(&s, Options { backend, slicing, ..showing(view) }));
        assert!(texel == storage, "{view:?}");
        assert!(texel == film_of(&s, showing(view)), "{view:?}");
    }
}

#[test]
fn views_do_not_depend_on_how_bright_the_scene_is() {
    // The unit of the sums would be 2^50
    let mut s = centered(4);
    let m = s.emitter(grey(1e24), false);
    s.quad(Vec3::new(-5.0, -5.0, -2.0), Vec3::X * 10.0, Vec3::Y * 10.0, m);
    expect(&show(&s, View::Normals), 0.0, |_, _| [0.5, 0.5, 1.0]);
    // Grey, not white
    let picture = show(&s, View::NonFinite);
    expect(&picture, 1e-4, |_, _| [0.2; 3]);
}
