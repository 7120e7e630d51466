//! Scenes at the edge of what makes sense: a correct picture or a clear error, never a panic, a hang or a NaN.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

mod common;

use common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

#[test]
fn an_empty_scene_is_black_or_its_environment() {
    let mut s = scene(9, 5, 4);
    let p = render(&s);
    assert!(p.rgb.iter().all(|c| *c == [0.0; 3]) && p.depth.iter().all(|d| *d == f32::INFINITY));
    assert!(p.alpha.iter().all(|a| *a == 0.0));
    s.environment = constant_environment(0.5);
    expect_every_pixel(&render(&s), [0.5; 3], 0.0);
}

#[test]
fn no_lights_is_black() {
    let mut s = scene(8, 8, 4);
    let m = s.diffuse(0.5);
    s.sphere(Vec3::Z * -3.0, 1.0, m);
    let glass = s.glass(1.5, 0.1, Vec3::ONE, false);
    s.sphere(Vec3::new(1.0, 0.0, -2.0), 0.5, glass);
    let p = render(&s);
    assert!(p.rgb.iter().all(|c| *c == [0.0; 3]) && p.alpha.contains(&1.0));
}

#[test]
fn lights_without_power_are_black() {
    let mut s = scene(8, 8, 4);
    let m = s.diffuse(0.5);
    s.sphere(Vec3::Z * -3.0, 1.0, m);
    s.lights.push(point(Vec3::ZERO, 0.0));
    let dark = s.emitter(grey(0.0), true);
    s.sphere(Vec3::new(1.0, 1.0, -3.0), 0.3, dark);
    s.environment = constant_environment(0.0);
    assert!(render(&s).rgb.iter().all(|c| *c == [0.0; 3]));
}

#[test]
fn pictures_of_one_pixel_row_or_column() {
    for (width, height) in [(1, 1), (1, 37), (37, 1), (3, 2)] {
        let mut s = scene(width, height, 4);
        s.environment = constant_environment(1.0);
        let m = s.diffuse(0.5);
        s.sphere(Vec3::Z * -3.0, 50.0, m);
        let p = render(&s);
        assert_eq!(p.rgb.len(), (width * height) as usize);
        // From inside a ball of albedo ½ without light
        assert!(p.rgb.iter().all(|c| *c == [0.0; 3]) && p.alpha.iter().all(|a| *a == 1.0));
    }
}

#[test]
fn coordinates_of_all_sizes() {
    // The same picture at every scale
    let with = |scale: f32, away: Vec3| {
        let mut s = scene(16, 16, 64);
        s.render.max_depth = 3;
        s.camera = look((Vec3::new(0.0, 1.0, 4.0) + away) * scale, away * scale, 40.0);
        s.environment = constant_environment(1.0);
        let m = s.diffuse(0.5);
        s.sphere(away * scale, 0.8 * scale, m);
        let mesh =
            s.meshes.add("box", box_mesh(Vec3::new(-1.5, -0.8, -1.5), Vec3::new(1.5, -0.7, 1.5), false));
        s.place(
            mesh,
            m,
            Affine3A::from_scale_rotation_translation(Vec3::splat(scale), glam::Quat::IDENTITY, away * scale),
        );
        mean(&render(&s))
    };
    let expected = with(1.0, Vec3::ZERO);
    for scale in [1e3_f32, 1e5, 30.0, 0.05, 1e-4] {
        expect_same(with(scale, Vec3::ZERO), expected, 1e-3);
    }
    expect_same(with(1.0, Vec3::new(40.0, -30.0, 20.0)), expected, 2e-3);
}

#[test]
fn huge_and_tiny_numbers_are_finite() {
    for scale in [1e-18_f32, 1e-6, 1e12, 1e17] {
        let mut s = scene(8, 8, 16);
        s.camera = look(Vec3::new(0.0, 1.0, 4.0) * scale, Vec3::ZERO, 40.0);
        s.environment = constant_environment(1.0);
        let m = s.diffuse(0.5);
        s.sphere(Vec3::ZERO, 0.8 * scale, m);
        let mesh = s
            .meshes
            .add("box", box_mesh(Vec3::splat(-1.0) * scale, Vec3::new(1.0, -0.5, 1.0) * scale, false));
        s.place(mesh, m, Affine3A::IDENTITY);
        s.lights.push(point(Vec3::new(1.0, 2.0, 1.0) * scale, scale * scale));
        let film = film_of(&s, options());
        assert_eq!(film.left_out(), 0, "scale {scale}");
        assert!(film.resolve().rgb.iter().flatten().all(|c| c.is_finite()));
    }
    // Beyond the range of floats: an error, not a picture
    let mut s = scene(8, 8, 1);
    let m = s.diffuse(0.5);
    s.sphere(Vec3::X * 3e38, 1.0, m);
    s.sphere(Vec3::X * -3e38, 1.0, m);
    let error = dapple::prepare::prepare(&s).unwrap_err();
    assert_eq!(error.to_string(), "the scene is too large for 32-bit floats; scale it down");
}

#[test]
fn the_power_of_the_brightest_lights_is_finite() {
    let mut s = floor_under_lights();
    s.lights.push(point(Vec3::Y, 1e38));
    s.lights.push(point(Vec3::Y * 2.0, 1e38));
    let lamp = s.emitter(grey(2e38), true);
    s.quad(Vec3::new(-1.0, 3.0, -1.0), Vec3::X * 1e3, Vec3::Z * 1e3, lamp);
    let bright = Image { width: 1, height: 1, texels: Texels::RgbaF32(vec![[3e38, 3e38, 3e38, 1.0]]) };
    let texture = s.picture(bright, |_| {});
    let lamp = s.emitter(Value::Texture(texture), true);
    s.quad(Vec3::new(-1.0, 3.5, -1.0), Vec3::X * 1e3, Vec3::Z * 1e3, lamp);
    let prepared = dapple::prepare::prepare(&s).unwrap();
    let chances: Vec<f32> = prepared.lights.iter().map(|light| light.chance).collect();
    // In proportion: 4π · 10³⁸ each, and 2π · 10⁶ · 2 · 10³⁸ and 3 · 10³⁸
    let area = 0.5e6_f32;
    let sum = 2.0 + 5.0 * area;
    let expected = [2.0 * area / sum, 3.0 * area / sum, 1.0 / sum, 1.0 / sum];
    for (chance, expected) in chances.iter().zip(expected) {
        assert!((chance / expected - 1.0).abs() < 1e-5, "{chances:?}, expected {expected:?}");
    }
    assert_eq!(chances.len(), 4);

    // Darkness is not what comes out: samples are clamped to what the film holds, or not finite and counted
    let mut s = floor_under_lights();
    s.lights.push(point(Vec3::Y * 1e3, 1e38));
    let film = film_of(&s, options());
    assert_eq!(film.left_out(), 0);
    assert!(film.resolve().rgb.iter().all(|c| c[1] > 1e18), "{:?}", film.resolve().rgb[0]);

    // A sky as bright: every direction has its chance
    let mut s = floor_under_lights();
    let sky = vec![[3e38, 3e38, 3e38, 1.0], [1e38, 1e38, 1e38, 1.0]];
    let texture = s.picture(Image { width: 2, height: 1, texels: Texels::RgbaF32(sky) }, |_| {});
    let radiance = Value::Texture(texture);
    s.environment = Some(Environment::new(radiance));
    let cells = dapple::prepare::prepare(&s).unwrap().environment;
    let sum: f32 = cells.iter().map(|cell| cell.chance).sum();
    assert!((sum - 1.0).abs() < 1e-5, "{cells:?}");
}

/// A white floor that a narrow camera looks down on.
fn floor_under_lights() -> Scene {
    let mut s = scene(4, 4, 4);
    s.render.max_depth = 1;
    s.camera = look(Vec3::new(0.3, 2.0, 0.1), Vec3::ZERO, 0.02);
    let white = s.diffuse(1.0);
    s.floor(white);
    s
}

#[test]
fn a_sphere_light_seen_from_inside() {
    // A small white ball in a large lamp that shines inward
    let mut s = scene(8, 8, 256);
    s.camera.projection = Projection::pinhole(10.0);
    let lamp = s.emitter(grey(2.0), true);
    s.sphere(Vec3::new(0.3, 0.2, 0.1), 5.0, lamp);
    let white = s.diffuse(0.5);
    s.sphere(Vec3::Z * -2.0, 1.0, white);
    expect_grey(mean(&render(&s)), 1.0, 0.0);
    // One that shines outward only is black from inside
    let mut s = scene(8, 8, 16);
    let lamp = s.emitter(grey(2.0), false);
    s.sphere(Vec3::ZERO, 5.0, lamp);
    assert!(render(&s).rgb.iter().all(|c| *c == [0.0; 3]));
}

#[test]
fn triangles_without_area_are_not_there() {
    let with = |extra: bool| {
        let mut s = scene(16, 16, 4);
        s.environment = constant_environment(1.0);
        let m = s.diffuse(0.5);
        let mut mesh = box_mesh(Vec3::new(-1.0, -1.0, -4.0), Vec3::new(1.0, 1.0, -3.0), false);
        if extra {
            // A point, lines along and across, and needles
            mesh.triangles.extend([[0, 0, 0], [0, 0, 1], [1, 2, 1], [3, 4, 4]]);
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([
                Vec3::new(-2.0, 0.0, -3.0),
                Vec3::new(0.0, 0.0, -3.0),
                Vec3::new(2.0, 0.0, -3.0),
            ]);
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        let glow = s.emitter(grey(1.0), true);
        let mesh = s.meshes.add("mesh", mesh);
        s.place(mesh, m, Affine3A::IDENTITY);
        // Lights without area, too
        if extra {
            let mut flat = rectangle_mesh(Vec3::new(0.0, 3.0, -3.0), Vec3::X, Vec3::X * 2.0);
            flat.triangles.push([0, 0, 0]);
            let flat = s.meshes.add("flat", flat);
            s.place(flat, glow, Affine3A::IDENTITY);
        }
        render(&s)
    };
    let (plain, extra) = (with(false), with(true));
    // Their units differ, because the bounds of the scenes do
    for (a, b) in plain.depth.iter().zip(&extra.depth) {
        assert!(a == b || (a - b).abs() < 1e-5, "{a} {b}");
    }
    expect_same(mean(&extra), mean(&plain), 0.0);
}

#[test]
fn many_lights_that_are_triangles() {
    // 20,000 emitting triangles tile a ceiling of 2 × 2 at height 2: the same as one quad
    let with = |n: u32| {
        let mut s = scene(8, 8, 1024);
        s.camera = look(Vec3::new(0.5, 0.3, 0.2), Vec3::ZERO, 0.02);
        s.render.max_depth = 1;
        let m = s.diffuse(1.0);
        s.floor(m);
        let lamp = s.emitter(grey(1.0), false);
        let mut mesh = Mesh::default();
        for j in 0..=n {
            for i in 0..=n {
                mesh.positions.push(Vec3::new(
                    i as f32 * 2.0 / n as f32 - 1.0,
                    2.0,
                    j as f32 * 2.0 / n as f32 - 1.0,
                ));
            }
        }
        for j in 0..n {
            for i in 0..n {
                let at = |i: u32, j: u32| j * (n + 1) + i;
                mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let mesh = s.meshes.add("ceiling", mesh);
        s.place(mesh, lamp, Affine3A::IDENTITY);
        mean(&render(&s))
    };
    expect_same(with(100), with(1), 1e-3);
}

#[test]
fn a_camera_on_a_surface_and_in_a_corner() {
    // Exactly on a floor, at a vertex of a box, at the centre of a sphere
    let mut s = scene(8, 8, 16);
    s.environment = constant_environment(1.0);
    let m = s.diffuse(0.5);
    s.floor(m);
    let mesh = s.meshes.add("box", box_mesh(Vec3::ZERO, Vec3::ONE, false));
    s.place(mesh, m, Affine3A::IDENTITY);
    s.sphere(Vec3::ZERO, 0.5, m);
    render(&s);
    s.camera = look(Vec3::ZERO, Vec3::ONE, 120.0);
    render(&s);
    // A lamp exactly where the camera is, and a point light on a surface
    s.lights.push(point(Vec3::ZERO, 1.0));
    s.lights.push(point(Vec3::new(0.3, 0.0, -3.0), 1.0));
    let film = film_of(&s, options());
    assert_eq!(film.left_out(), 0);
}

#[test]
fn lights_at_the_ends_of_their_ranges() {
    let position = Vec3::new(0.5, 2.0, 0.5);
    let spot = |cone, edge| LightKind::spot(position, cone, edge);
    let dark = [spot(0.0, 0.0), spot(0.0, 180.0)];
    let bright = [spot(180.0, 0.0), spot(180.0, 180.0), spot(0.01, 0.0), LightKind::distant(90.0)];
    let with = |kind: Option<LightKind>| {
        let mut s = scene(8, 8, 16);
        let m = s.diffuse(0.5);
        s.floor(m);
        s.lights.push(point(Vec3::new(-0.3, 1.0, 0.0), 1.0));
        s.lights.extend(kind.map(|kind| Light::new(kind, grey(1.0)).along(Vec3::NEG_Y)));
        let film = film_of(&s, options());
        assert_eq!(film.left_out(), 0, "{kind:?}");
        mean(&film.resolve())
    };
    let alone = with(None);
    for kind in dark {
        // What cannot be seen changes nothing, nor the unit of the sums
        assert_eq!(with(Some(kind)).mean, alone.mean, "{kind:?}");
    }
    for kind in bright {
        let both = with(Some(kind));
        let noise = 4.0 * (both.error[1] + alone.error[1]);
        assert!(both.mean[1] >= 0.999 * alone.mean[1] - noise, "{kind:?}: {both:?}, alone {alone:?}");
    }
}

#[test]
fn materials_at_the_ends_of_their_ranges() {
    let metal = |x: f32, a: f32, f| conductor(x, a, f);
    let index = Fresnel::Index {
        eta: Value::Constant(Vec3::new(0.2, 1.0, 5.0)),
        k: Value::Constant(Vec3::new(0.0, 4.0, 20.0)),
    };
    let layered = |ior, transmission, alpha, change: fn(&mut Principled)| {
        let (ior, transmission) = (Value::Constant(ior), Value::Constant(transmission));
        let mut p =
            Principled { ior, transmission, roughness: Roughness::alpha(alpha), ..Principled::default() };
        change(&mut p);
        Surface::Principled(Box::new(p))
    };
    let surfaces = [
        metal(1.0, 1.0, Fresnel::Exact),
        metal(1.0, 0.001, Fresnel::Exact),
        metal(0.0, 1e-4, Fresnel::Schlick),
        metal(0.5, 0.0, index),
        metal(0.5, 0.5, index),
        glass(1.0, 0.0, Vec3::ZERO, false),
        glass(1.0, 0.3, Vec3::ZERO, false),
        glass(4.0, 1.0, Vec3::splat(1e6), false),
        glass(0.5, 0.0, Vec3::ZERO, false),
        glass(1.5, 0.0, Vec3::ZERO, true),
        Surface::phong(grey(0.0), grey(1.0), Value::Constant(1e6)),
        Surface::phong(grey(0.0), grey(0.0), Value::Constant(0.0)),
        Surface::diffuse(grey(1.0)),
        layered(1.0, 1.0, 0.0, |_| {}),
        layered(100.0, 1.0, 0.0, |p| p.thin = true),
        layered(1.5, 0.5, 1.0, |p| p.specular = Value::Constant(0.0)),
        layered(1.5, 0.0, 0.0, |p| (p.base_color, p.metallic) = (grey(0.0), Value::Constant(1.0))),
        layered(1.5, 0.0, 0.5, |p| (p.base_color, p.specular) = (grey(0.0), Value::Constant(0.0))),
        layered(2.0, 0.0, 0.2, |p| (p.specular_color, p.clearcoat) = (grey(1e30), Value::Constant(1.0))),
        layered(1.5, 1.0, 1.0, |p| (p.sheen_color, p.sheen_roughness) = (grey(1.0), Value::Constant(0.0))),
    ];
    for (i, surface) in surfaces.into_iter().enumerate() {
        let mut s = scene(8, 8, 1024);
        s.environment = constant_environment(1.0);
        s.camera.projection = Projection::pinhole(30.0);
        let text = format!("{surface:?}");
        let m = s.material(surface, None);
        s.sphere(Vec3::Z * -4.0, 0.9, m);
        let film = film_of(&s, options());
        assert_eq!(film.left_out(), 0, "{i}: samples that are not finite: {text}");
        // Nothing makes light: all see a white room, through glass too
        let p = film.resolve();
        for (i, c) in p.rgb.iter().enumerate() {
            let noise = p.variance[i].map(|v| 4.0 * v.sqrt());
            assert!((0..3).all(|k| c[k] <= 1.0 + 1e-3 + noise[k]), "pixel {i}: {c:?} ± {noise:?}: {text}");
        }
    }
}
