//! Rays leave the surface that they start on, and no more than that, at every scale.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, EulerRot, Quat, Vec3};

/// Unshadowed points of a convex thing under parallel light are as bright as their normal says: the pixels that are
/// darker, of those that are lit.
fn dark_spots(s: &Scene, towards_light: Vec3) -> (usize, usize) {
    let p = render(s);
    let (mut dark, mut lit) = (0, 0);
    for i in (0..p.rgb.len()).filter(|&i| p.alpha[i] > 0.0) {
        let cosine = Vec3::from(p.normal[i]).dot(towards_light);
        if cosine > 1e-3 {
            lit += 1;
            dark += usize::from(p.rgb[i][0] < 0.5 * cosine);
        }
    }
    (dark, lit)
}

/// A scene of one white thing, whose radiance is the cosine to a light.
fn under_light(towards_light: Vec3, camera: Camera) -> Scene {
    let mut s = scene(64, 64, 1);
    s.render.sampler = Sampler::Center;
    s.render.max_depth = 1;
    s.camera = camera;
    let irradiance = Vec3::splat(std::f32::consts::PI);
    s.lights.push(Light::distant(-towards_light, irradiance));
    s
}

#[test]
fn no_surface_shadows_itself() {
    let mut random = Random(3);
    let mut totals = [(0, 0); 4];
    for i in 0..120 {
        let scale = random.between(-17.0, 20.0).exp2();
        let turn = Quat::from_euler(
            EulerRot::XYZ,
            random.between(0.0, 6.0),
            random.between(0.0, 6.0),
            random.between(0.0, 6.0),
        );
        let normal = turn * Vec3::Z;
        let light = (normal + 3.0 * random.in_cube(1.0)).normalize();
        let away = random.in_cube(4.0) * if i & 1 == 0 { 0.0 } else { 1.0 };
        let kind = i % 4;
        // Near the middle of something large, or in front of all of it
        let distance = if kind == 0 { random.between(-6.0, 2.0).exp2() } else { 4.0 };
        let eye = (away + distance * (normal + 0.7 * random.in_cube(1.0))) * scale;
        let mut s = under_light(light, look(eye, away * scale, 35.0));
        let white = s.diffuse(1.0);
        let map = Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, away * scale);
        match kind {
            0 => {
                s.quad(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0, white).world_from_object =
                    map
            }
            1 => s.sphere(Vec3::ZERO, 1.0, white).world_from_object = map,
            2 => s.disk(Vec3::ZERO, Vec3::Z, 1.0, white).world_from_object = map,
            _ => {
                let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-0.5), Vec3::splat(0.5), false));
                s.place(mesh, white, map);
                // Out of sight: so the mesh has a tree of its own
                s.place(mesh, white, Affine3A::from_translation(-1e3 * scale * normal) * map);
            }
        }
        let (dark, lit) = dark_spots(&s, light);
        totals[kind].0 += dark;
        totals[kind].1 += lit;
    }
    assert!(totals.iter().all(|&(dark, lit)| dark == 0 && lit > 15_000), "dark and lit: {totals:?}");
}

/// A closed room with a floor of its own, a ball, a disk, a tube, a patch, two boxes of one mesh, and lamps of four kinds.
fn room(scale: f32) -> Scene {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z) * scale;
    let mut s = scene(32, 32, 16);
    s.render.max_depth = 4;
    s.camera = look(at(0.3, 0.2, 1.8), at(0.0, -0.2, 0.0), 70.0);
    let (white, grey_paint, mirror) = (s.diffuse(0.8), s.diffuse(0.4), s.conductor(0.9, 0.3, Fresnel::Exact));
    let mesh = s.meshes.add("walls", box_mesh(at(-2.0, -1.0, -2.0), at(2.0, 1.0, 2.0), true));
    s.place(mesh, white, Affine3A::IDENTITY);
    s.quad(at(-2.0, -0.99, 2.0), at(4.0, 0.0, 0.0), at(0.0, 0.0, -4.0), grey_paint);
    s.sphere(at(0.6, -0.59, 0.2), 0.4 * scale, white);
    s.disk(at(-1.0, 0.0, -1.0), Vec3::new(0.3, 0.2, 1.0), 0.5 * scale, mirror);
    let extent = Extent::Cylinder { z_min: -0.59 * scale, z_max: 0.3 * scale };
    let (center, radius, axis, meridian) = (at(1.3, -0.4, -0.7), 0.2 * scale, Vec3::Y, Vec3::X);
    s.shape(ShapeKind::Quadric(Quadric { extent, center, radius, axis, meridian, phi_max: 280.0 }), white);
    let corners = [at(-0.4, -0.5, -1.5), at(0.4, -0.2, -1.6), at(-0.3, 0.3, -1.4), at(0.5, 0.1, -1.0)];
    s.shape(ShapeKind::Patch(Patch::new(corners)), grey_paint);
    let block = s.meshes.add("block", box_mesh(at(-0.2, 0.0, -0.2), at(0.2, 0.5, 0.2), false));
    for (x, angle) in [(-0.5, 0.3), (-1.2, 0.9)] {
        s.place(
            block,
            white,
            Affine3A::from_rotation_translation(Quat::from_rotation_y(angle), at(x, -0.99, 0.3)),
        );
    }
    let lamp = s.emitter(grey(10.0), false);
    s.quad(at(-0.3, 0.99, -0.3), at(0.6, 0.0, 0.0), at(0.0, 0.0, 0.6), lamp);
    s.disk(at(1.5, 0.5, 1.0), Vec3::new(-1.0, -0.2, -0.5), 0.1 * scale, lamp);
    s.sphere(at(-1.5, 0.6, 0.5), 0.1 * scale, lamp);
    s.lights.push(point(at(1.0, 0.7, -1.0), scale * scale));
    s
}

#[test]
fn a_scene_looks_the_same_at_every_scale() {
    let expected = render(&room(1.0));
    // Powers of two scale all numbers of a scene exactly: not a bit may differ
    for exponent in exact_scales(&[-40, -13, 17, 40], 20) {
        let picture = render(&room((exponent as f32).exp2()));
        assert!(picture.rgb == expected.rgb, "at 2^{exponent}");
    }
    for scale in [1e-4, 1e5] {
        // The same paths, but for those next to an edge
        let (found, expected) = (mean(&render(&room(scale))).mean[0], mean(&expected).mean[0]);
        assert!((found / expected - 1.0).abs() < 2e-3, "scale {scale}: {found}, not {expected}");
    }
}

#[test]
fn furnaces_small_and_large() {
    for scale in [1e-8_f32, 1e-4, 1e5] {
        let mut s = scene(8, 8, 256);
        s.render.max_depth = 20;
        s.camera = look(Vec3::new(0.2, -0.1, 0.5) * scale, Vec3::new(0.0, 0.1, -0.3) * scale, 90.0);
        let emission = Some(Emission { radiance: grey(1.0), two_sided: false });
        let m = s.material(Surface::diffuse(grey(0.5)), emission);
        let walls = box_mesh(Vec3::new(-1.0, -0.7, -2.0) * scale, Vec3::new(1.5, 0.9, 1.0) * scale, true);
        let mesh = s.meshes.add("box", walls);
        s.place(mesh, m, Affine3A::IDENTITY);
        // What is not seen through a leak: 1 + ρ + ρ² + …
        expect_grey(mean(&render(&s)), 2.0, 1e-5);
    }
}

/// Part of the picture that is lit: a floor, and above half of it a lid whose shadow begins `gap` from its edge.
fn lit_under_a_lid(scale: f32, gap: f32) -> f64 {
    let eye = Vec3::new(-2.0, 0.5, 0.0) * gap * scale;
    let camera = look(eye, eye + Vec3::new(1.0, -1.0 / 6.0, 0.0) * scale, 14.0);
    let mut s = under_light(Vec3::new(-1.0, 1.0, 0.0).normalize(), camera);
    let white = s.diffuse(1.0);
    s.quad(Vec3::new(-1.0, 0.0, 1.0) * scale, Vec3::X * 2.0 * scale, Vec3::NEG_Z * 2.0 * scale, white);
    s.quad(Vec3::new(0.0, gap, 1.0) * scale, Vec3::X * scale, Vec3::NEG_Z * 2.0 * scale, white);
    let p = render(&s);
    assert!(p.alpha.iter().all(|alpha| *alpha == 1.0));
    p.rgb.iter().filter(|rgb| rgb[0] > 0.5).count() as f64 / p.rgb.len() as f64
}

#[test]
fn shadows_begin_where_they_should_below_a_narrow_gap() {
    let expected = lit_under_a_lid(1.0, 0.1);
    assert!((0.3..0.7).contains(&expected), "{expected}");
    for (scale, gap) in [(1e-4, 1e-3), (1e-4, 0.1), (1.0, 1e-3), (1e5, 1e-3), (1e5, 0.1)] {
        let lit = lit_under_a_lid(scale, gap);
        // A row of pixels is 1/64 of the picture
        assert!((lit - expected).abs() < 0.02, "scale {scale}, gap {gap}: {lit}, not {expected}");
    }
}
