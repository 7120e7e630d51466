//! Parts of quadrics, tubes and patches in whole renders: rays leave them, and they light what they should.

use super::floor::*;
use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, DVec3, EulerRot, Quat, Vec3};

fn quadric(extent: Extent, phi_max: f32) -> Quadric {
    Quadric { extent, center: Vec3::ZERO, radius: 1.0, axis: Vec3::Z, meridian: Vec3::X, phi_max }
}

#[test]
fn curved_shapes_do_not_shadow_themselves() {
    let mut random = Random(8);
    let patch = [(-1.0, -1.0, 0.15), (1.0, -1.0, -0.15), (-1.0, 1.0, -0.15), (1.0, 1.0, 0.15)];
    let strip = Quadric {
        axis: Vec3::X,
        meridian: Vec3::Y,
        ..quadric(Extent::Cylinder { z_min: -1.0, z_max: 1.0 }, 180.0)
    };
    // All of them bulge towards +z, but the patch, which bends both ways
    let shapes = [
        ShapeKind::Quadric(quadric(Extent::Sphere { z_min: 0.0, z_max: 1.0 }, 300.0)),
        ShapeKind::Quadric(quadric(Extent::Disk { inner_radius: 0.3 }, 200.0)),
        ShapeKind::Quadric(strip),
        ShapeKind::Patch(Patch::new(patch.map(Vec3::from))),
    ];
    let mut totals = [(0, 0); 4];
    for i in 0..32 {
        let scale = random.between(-17.0, 20.0).exp2();
        let angles = [0; 3].map(|_| random.between(0.0, 6.0));
        let turn = Quat::from_euler(EulerRot::XYZ, angles[0], angles[1], angles[2]);
        let up = turn * Vec3::Z;
        let light = (up + 0.5 * random.in_cube(1.0)).normalize();
        let away = random.in_cube(4.0) * if i & 1 == 0 { 0.0 } else { 1.0 };
        let mut s = scene(48, 48, 1);
        s.render.sampler = Sampler::Center;
        s.render.max_depth = 1;
        s.camera = look((away + 4.0 * (up + 0.3 * random.in_cube(1.0))) * scale, away * scale, 35.0);
        let irradiance = Vec3::splat(std::f32::consts::PI);
        s.lights.push(Light::distant(-light, irradiance));
        let white = s.diffuse(1.0);
        let kind = i / 2 % 4;
        let map = Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, away * scale);
        s.shape(shapes[kind], white).world_from_object = map;
        let p = render(&s);
        for k in (0..p.rgb.len()).filter(|&k| p.alpha[k] > 0.0) {
            let normal = Vec3::from(p.normal[k]);
            let cosine = normal.dot(light);
            // Below that a saddle may hide the light, and the inside of a dome may be seen
            if cosine > 0.3 && normal.dot(up) > 0.3 {
                totals[kind].1 += 1;
                totals[kind].0 += usize::from(p.rgb[k][0] < 0.9 * cosine);
            }
        }
    }
    assert!(totals.iter().all(|&(dark, lit)| dark == 0 && lit > 3_000), "dark and lit: {totals:?}");
}

/// A lamp as a function of two numbers in the unit square.
type Surface2 = Box<dyn Fn(f64, f64) -> DVec3>;

/// A lamp above the floor, whose front is seen from the origin without anything before it where it faces there.
fn lamps() -> Vec<(&'static str, ShapeKind, Surface2)> {
    let around = |turn: f64| DVec3::new(turn.cos(), 0.0, -turn.sin());
    let at = Vec3::new(-1.2, 2.0, 0.5);
    let base = Quadric {
        center: at,
        axis: Vec3::Y,
        meridian: Vec3::X,
        ..quadric(Extent::Disk { inner_radius: 0.0 }, 250.0)
    };
    let phi = 250_f64.to_radians();
    let center = at.as_dvec3();
    let bowl = Quadric { radius: 0.8, extent: Extent::Sphere { z_min: -0.8, z_max: -0.2 }, ..base };
    let bowl_at = move |a: f64, b: f64| {
        let y = -1.0 + 0.75 * b;
        center + 0.8 * (around(phi * a) * (1.0 - y * y).max(0.0).sqrt() + DVec3::Y * y)
    };
    let tube = Quadric { radius: 0.3, extent: Extent::Cylinder { z_min: -0.5, z_max: 1.0 }, ..base };
    let tube_at = move |a: f64, b: f64| center + 0.3 * around(phi * a) + DVec3::Y * (1.5 * b - 0.5);
    // Facing down: its angle runs the other way round, seen from above
    let ring = Quadric { axis: Vec3::NEG_Y, extent: Extent::Disk { inner_radius: 0.4 }, ..base };
    let ring_at = move |a: f64, b: f64| {
        let turn = around(-phi * a);
        center + turn * (1.0 - 0.6 * b)
    };
    let corners = [(-2.0, 2.0, -1.0), (0.5, 1.6, -1.0), (-2.0, 1.5, 1.2), (0.8, 2.4, 1.0)].map(Vec3::from);
    let patch_at = move |a: f64, b: f64| {
        let [p, q, r, s] = corners.map(|corner| corner.as_dvec3());
        p.lerp(q, a).lerp(r.lerp(s, a), b)
    };
    vec![
        ("part of a sphere", ShapeKind::Quadric(bowl), Box::new(bowl_at)),
        ("tube", ShapeKind::Quadric(tube), Box::new(tube_at)),
        ("ring", ShapeKind::Quadric(ring), Box::new(ring_at)),
        ("patch", ShapeKind::Patch(Patch::new(corners)), Box::new(patch_at)),
    ]
}

#[test]
fn curved_lamps_light_a_floor_as_quadrature_says() {
    let wo = EYE.as_dvec3().normalize();
    for (name, kind, at) in lamps() {
        // A diffuse floor, whose lamp is found by sampling, and a lobe, which finds it by itself
        for (i, (surface, bsdf)) in surfaces().into_iter().enumerate() {
            let h = 1e-5;
            let expected = integrate_square(700, |a, b| {
                let p = at(a, b);
                let across = (at(a + h, b) - at(a - h, b)).cross(at(a, b + h) - at(a, b - h)) / (4.0 * h * h);
                let wi = p.normalize();
                // The front is where ∂p/∂u × ∂p/∂v points
                let facing = (-across.dot(wi)).max(0.0);
                2.0 * bsdf(wo, wi) * wi.y.max(0.0) * facing / p.length_squared()
            });
            let mut s = floor_scene(surface, 2048);
            s.camera.position = EYE.normalize();
            let lamp = s.emitter(grey(2.0), false);
            s.shape(kind, lamp);
            eprintln!("{name}, surface {i}: {expected}");
            expect_grey(mean(&render(&s)), expected, 3e-3);
        }
    }
}

#[test]
fn a_ball_of_parts_lights_as_the_whole() {
    let mut s = floor_scene(white(), 4096);
    s.camera.position = Vec3::new(0.3, 0.1, 0.2);
    let lamp = s.emitter(grey(3.0), false);
    let (center, radius) = (Vec3::new(0.5, 1.6, -0.3), 0.7);
    for (z_min, z_max) in [(-0.7, 0.1), (0.1, 0.7)] {
        let extent = Extent::Sphere { z_min, z_max };
        let half = Quadric { center, radius, axis: Vec3::X, meridian: Vec3::Y, ..quadric(extent, 360.0) };
        s.shape(ShapeKind::Quadric(half), lamp);
    }
    // E = π L (r/d)² cos θ
    let d = center.as_dvec3();
    let expected = 3.0 * 0.7_f64.powi(2) / d.length_squared() * d.normalize().y;
    expect_grey(mean(&render(&s)), expected, 1e-3);
}
