//! Light: how much arrives, from what.

use super::floor::*;
use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, DVec3, Vec3};
use std::f64::consts::PI;

#[test]
fn sphere_light_irradiance() {
    // E = π L (r/d)² cos θ where the whole sphere is above the horizon
    for (center, radius) in [
        (Vec3::new(0.0, 2.0, 0.0), 1.0),
        (Vec3::new(0.0, 1.05, 0.0), 1.0),
        (Vec3::new(-1.0, 3.0, 2.0), 0.7),
        (Vec3::new(-1.0, 3.0, 2.0), 0.01),
        (Vec3::new(0.0, 300.0, 0.0), 2.0),
    ] {
        let mut s = floor_scene(white(), 1024);
        // Below the spheres
        s.camera.position = Vec3::new(0.3, 0.03, 0.2);
        let light = s.emitter(grey(3.0), false);
        s.sphere(center, radius, light);
        let d = center.as_dvec3();
        let irradiance = PI * 3.0 * f64::from(radius).powi(2) / d.length_squared() * d.normalize().y;
        expect_grey(mean(&render(&s)), irradiance / PI, 1e-4);
    }
}

#[test]
fn disk_light_on_its_axis() {
    for (radius, height) in [(1.0, 1.5), (3.0, 0.5), (0.05, 2.0)] {
        let mut s = floor_scene(white(), 1024);
        let light = s.emitter(grey(2.0), false);
        s.disk(Vec3::new(0.0, height, 0.0), Vec3::NEG_Y, radius, light);
        // E = π L r² / (r² + h²). The camera must not be under the disk's shadow of itself
        let (r, h) = (f64::from(radius), f64::from(height));
        s.camera = look(Vec3::new(0.4, 0.3, 0.2), Vec3::ZERO, 0.02);
        expect_grey(mean(&render(&s)), 2.0 * r * r / (r * r + h * h), 1e-4);
    }
}

#[test]
fn quad_light_irradiance() {
    for (i, (origin, u, v)) in QUADS.into_iter().enumerate() {
        let mut s = floor_scene(white(), 1024);
        s.camera = look(Vec3::new(0.3, 0.2, 0.1), Vec3::ZERO, 0.02);
        let light = s.emitter(grey(2.0), false);
        s.quad(origin, u, v, light);
        let expected = 2.0 * polygon_irradiance(&quad_corners(origin, u, v)) / PI;
        eprintln!("quad {i}: {expected}");
        expect_grey(mean(&render(&s)), expected, 1e-4);
    }
}

#[test]
fn lights_without_extent() {
    let at = Vec3::new(1.0, 2.0, -0.5);
    let (d2, cos) = (f64::from(at.length_squared()), f64::from(at.normalize().y));
    let with = |light: Light| {
        let mut s = floor_scene(white(), 4);
        s.lights.push(light);
        mean(&render(&s))
    };
    expect_grey(with(point(at, 5.0)), 5.0 / d2 * cos / PI, 1e-4);
    // Irradiance on a surface that faces the light
    let distant = Light::distant(-at.normalize(), Vec3::splat(4.0));
    expect_grey(with(distant), 4.0 * cos / PI, 1e-4);
    // Smoothstep in the cosine between the cone and the cone less its soft edge
    for turn in [0.0_f32, 12.0, 17.0, 24.0, 29.0] {
        let away = glam::Quat::from_axis_angle(at.normalize().any_orthonormal_vector(), turn.to_radians());
        let direction = away * -at.normalize();
        let spot = LightKind::spot(at, 30.0, 15.0);
        let spot = Light::new(spot, grey(5.0)).along(direction);
        let (outer, inner) = (30_f64.to_radians().cos(), 15_f64.to_radians().cos());
        let t = ((f64::from(turn).to_radians().cos() - outer) / (inner - outer)).clamp(0.0, 1.0);
        // Near the edge of the cone the rounding of the cosine counts: t is a difference of two of them
        expect_grey(with(spot), 5.0 / d2 * cos / PI * t * t * (3.0 - 2.0 * t), 2e-4);
    }
    let direction = Vec3::new(1.0, 2.0, -0.4).normalize();
    let spot = LightKind::spot(at, 30.0, 15.0);
    assert_eq!(with(Light::new(spot, grey(1.0)).along(direction)).mean, [0.0; 3]);
}

/// A strip of floor from left to right, and a black half-plane at height 2 above its left half.
fn floor_below_an_edge(spp: u32) -> Scene {
    let mut s = scene(24, 1, spp);
    s.render.max_depth = 1;
    s.camera = look(Vec3::new(0.0, 1.0, 0.001), Vec3::ZERO, 4.0);
    s.camera.up = Vec3::NEG_Z;
    let white = s.material(white(), None);
    s.floor(white);
    let black = s.black();
    s.quad(Vec3::new(-50.0, 2.0, -50.0), Vec3::X * 50.0, Vec3::Z * 100.0, black);
    s
}

/// Where a pixel of that strip is in x, and how wide it is.
fn place(s: &Scene, px: u32) -> (f64, f64) {
    let on_floor = |px: u32| {
        let (from, along) = center_ray(s, px, 0);
        from.x + along.x / -along.y
    };
    (on_floor(px), on_floor(1) - on_floor(0))
}

#[test]
fn penumbra_of_a_disk_in_the_sky() {
    // 20° wide, straight above an edge at height 2: the penumbra is 2 · 2 tan 10° wide
    let mut s = floor_below_an_edge(2048);
    s.lights.push(Light::new(LightKind::distant(20.0), grey(3.0)).along(Vec3::NEG_Y));
    let p = render(&s);
    // The part of the disk, as it is on the floor, from which rays pass the edge
    let half = 10_f64.to_radians().sin();
    let seen = |x: f64| {
        integrate_square(200, |u, v| {
            let [a, b] = [2.0 * u - 1.0, 2.0 * v - 1.0].map(|c| half * c);
            let r2 = a * a + b * b;
            if r2 < half * half && x + 2.0 * a / (1.0 - r2).sqrt() > 0.0 { 4.0 / PI } else { 0.0 }
        })
    };
    let (mut dark, mut part, mut full) = (0, 0, 0);
    for px in 0..24 {
        let (x, width) = place(&s, px);
        let share =
            (0..16).map(|k| seen(x + ((f64::from(k) + 0.5) / 16.0 - 0.5) * width)).sum::<f64>() / 16.0;
        let measured = mean_of(&p, [px as usize]);
        let off = (measured.mean[1] - 3.0 / PI * share).abs();
        assert!(off <= SIGMAS * measured.error[1] + 4e-3, "{x}: {measured:?}, expected {share} of 3 / π");
        assert!(SIGMAS * measured.error[1] < 0.06, "too noisy");
        match share {
            0.0 => dark += 1,
            _ if share < 0.99 => part += 1,
            _ => full += 1,
        }
    }
    assert!(dark >= 2 && part >= 5 && full >= 2, "{dark} {part} {full}");
}

#[test]
fn penumbra_behind_a_straight_edge() {
    // Light at height 4, 1 wide; edge at height 2: the penumbra is 1 · 2 / (4 − 2) = 1 wide
    let (origin, u, v) = (Vec3::new(-0.5, 4.0, -0.5), Vec3::X, Vec3::Z);
    let mut s = floor_below_an_edge(4096);
    let light = s.emitter(grey(1.0), false);
    s.quad(origin, u, v, light);
    let p = render(&s);
    // Irradiance at x: of the part of the light that the edge leaves, x_light > −x
    let at = |x: f64, z: f64| {
        let left = (-x).clamp(-0.5, 0.5);
        let corners = [(left, -0.5), (0.5, -0.5), (0.5, 0.5), (left, 0.5)];
        if left >= 0.5 {
            0.0
        } else {
            polygon_irradiance(&corners.map(|(a, b)| DVec3::new(a - x, 4.0, b - z)))
        }
    };
    let full_light = at(0.5, 0.0) / PI;
    let (mut dark, mut half, mut full) = (0, 0, 0);
    for px in 0..24 {
        let (x, width) = place(&s, px);
        let expected = integrate_square(64, |a, b| at(x + (a - 0.5) * width, (b - 0.5) * width)) / PI;
        let measured = mean_of(&p, [px as usize]);
        if x + width < -0.5 {
            assert_eq!(measured.mean, [0.0; 3]);
            dark += 1;
        } else if x - width > -0.45 {
            // Relative to full light: where hardly any arrives, the part that does is all noise
            let off = (measured.mean[1] - expected).abs();
            assert!(
                off <= SIGMAS * measured.error[1] + 2e-3 * full_light,
                "{x}: {measured:?}, expected {expected}"
            );
            assert!(SIGMAS * measured.error[1] < 0.05 * full_light, "too noisy");
            if x > 0.5 { full += 1 } else { half += 1 }
        }
    }
    assert!(dark >= 2 && half >= 5 && full >= 2, "{dark} {half} {full}");
}

#[test]
fn area_lights_weigh_both_strategies_right() {
    // Small, and so large that the lobe of the surface finds it more often
    let lights = [
        (Vec3::new(-2.0, 1.2, -1.0), Vec3::X * 0.3, Vec3::Z * 0.3),
        (Vec3::new(-6.0, 1.5, -4.0), Vec3::X * 7.0, Vec3::Z * 6.0),
    ];
    for (origin, u, v) in lights {
        for (i, (surface, bsdf)) in surfaces().into_iter().enumerate() {
            let expected = under_quad(origin, u, v, |_, _| 2.0, bsdf);
            for as_mesh in [false, true] {
                let mut s = floor_scene(surface.clone(), 1024);
                s.camera.position = EYE.normalize() * 1.0;
                let light = s.emitter(grey(2.0), false);
                if as_mesh {
                    let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
                    s.place(mesh, light, Affine3A::IDENTITY);
                } else {
                    s.quad(origin, u, v, light);
                }
                eprintln!("surface {i}, mesh {as_mesh}: {expected}");
                expect_grey(mean(&render(&s)), expected, 1e-3);
            }
        }
    }
}

#[test]
fn hundred_thousand_point_lights() {
    let mut random = Random(7);
    let mut s = floor_scene(white(), 256);
    let mut expected = 0.0;
    for _ in 0..100_000 {
        let position = random.in_cube(1.0) + Vec3::Y * 3.0;
        let intensity = random.between(0.0, 2.0);
        s.lights.push(point(position, intensity));
        let p = position.as_dvec3();
        expected += f64::from(intensity) * p.normalize().y / p.length_squared() / PI;
    }
    // Light number and slot come from 24 bits: 168 values a light, whose shares round by about 1/√n of 0.6 %
    expect_grey(mean(&render(&s)), expected, 5e-4);
}

#[test]
fn lights_of_all_kinds_and_powers_add_up() {
    let mut s = floor_scene(white(), 16_384);
    s.camera.position = Vec3::new(0.3, 0.2, 0.1);
    let (strong, weak) = (s.emitter(grey(20.0), false), s.emitter(grey(0.5), true));
    let mut expected = 0.0;
    let (origin, u, v) = QUADS[0];
    s.quad(origin, u, v, strong);
    expected += 20.0 * polygon_irradiance(&quad_corners(origin, u, v));
    let (origin, u, v) = (Vec3::new(3.0, 2.0, 0.0), Vec3::Y, Vec3::Z);
    let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
    s.place(mesh, weak, Affine3A::IDENTITY);
    expected += 0.5 * polygon_irradiance(&quad_corners(origin, u, v));
    s.sphere(Vec3::new(-3.0, 3.0, 0.0), 0.5, weak);
    expected += 0.5 * PI * 0.25 / 18.0 * 0.5_f64.sqrt();
    s.lights.push(point(Vec3::new(0.0, 4.0, 4.0), 3.0));
    expected += 3.0 / 32.0 * 0.5_f64.sqrt();
    s.lights.push(Light::distant(Vec3::new(-1.0, -0.2, 0.0).normalize(), Vec3::splat(0.3)));
    expected += 0.3 * 0.2 / 1.04_f64.sqrt();
    s.environment = constant_environment(0.2);
    // The environment behind the lights is hidden by them, up to their own irradiance at radiance 0.2
    expected += 0.2 * (PI - polygon_irradiance(&quad_corners(QUADS[0].0, QUADS[0].1, QUADS[0].2)));
    expected -= 0.2 * (polygon_irradiance(&quad_corners(origin, u, v)) + PI * 0.25 / 18.0 * 0.5_f64.sqrt());
    expect_grey(mean(&render(&s)), expected / PI, 1e-4);
}

#[test]
fn light_of_a_stretched_sphere_is_found_by_both_strategies() {
    // A wide lobe against a diffuse one under an ellipsoid light, against quadrature over directions
    let (center, axes) = (DVec3::new(-0.5, 2.0, 0.3), DVec3::new(1.2, 0.4, 0.7));
    let map = Affine3A::from_translation(center.as_vec3()) * Affine3A::from_scale(axes.as_vec3());
    let wo = EYE.as_dvec3().normalize();
    for (surface, bsdf) in surfaces() {
        let hits = |wi: DVec3| {
            let (o, d) = (-center / axes, wi / axes);
            let (b, c) = (o.dot(d), o.length_squared() - 1.0);
            b * b - d.length_squared() * c >= 0.0 && b < 0.0
        };
        let expected = albedo(wo, |wo, wi| if hits(wi) { 2.0 * bsdf(wo, wi) } else { 0.0 });
        let mut s = floor_scene(surface, 2048);
        let light = s.emitter(grey(2.0), false);
        s.sphere(Vec3::ZERO, 1.0, light).world_from_object = map;
        expect_grey(mean(&render(&s)), expected, 3e-3);
    }
}

/// A small grey floor below the camera.
fn small_floor() -> Scene {
    let mut s = scene(4, 4, 64);
    s.render.max_depth = 1;
    s.camera = look(Vec3::new(0.0, 1.0, 0.5), Vec3::ZERO, 20.0);
    let m = s.diffuse(0.5);
    s.quad(Vec3::new(-1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::NEG_Z * 2.0, m);
    s
}

#[test]
fn lamps_that_are_bright_and_far_light_as_much_as_they_should() {
    // Irradiance by the solid angle, which is π r² / d² but for a part in 10⁹
    let (radiance, away) = (1e12_f32, 1e6_f32);
    let at = Vec3::Y * away;
    let mut s = small_floor();
    let lamp = s.emitter(grey(radiance), false);
    s.sphere(at, 1.0, lamp);
    expect_grey(mean(&render(&s)), 0.5, 1e-4);

    let mut s = small_floor();
    let lamp = s.emitter(grey(radiance), false);
    s.disk(at, Vec3::NEG_Y, 1.0, lamp);
    expect_grey(mean(&render(&s)), 0.5, 1e-4);

    let mut s = small_floor();
    let lamp = s.emitter(grey(radiance), false);
    let mesh =
        s.meshes.add("lamp", rectangle_mesh(at - Vec3::new(1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::Z * 2.0));
    s.place(mesh, lamp, Affine3A::IDENTITY);
    expect_grey(mean(&render(&s)), 0.5 * 4.0 / PI, 1e-4);

    let mut s = small_floor();
    s.lights.push(point(at, radiance));
    expect_grey(mean(&render(&s)), 0.5 / PI, 1e-4);
}

#[test]
fn a_bright_lamp_is_seen_as_bright_as_it_is() {
    // Near, and so far that it fills 10⁻⁵ of the half space: no sample of it is clamped
    for distance in [3.0_f32, 200.0] {
        let mut s = small_floor();
        s.camera = look(Vec3::Y, Vec3::Y + Vec3::NEG_Z, 0.01);
        let lamp = s.emitter(grey(1e12), false);
        s.quad(Vec3::new(-1.0, 0.0, -distance), Vec3::X * 2.0, Vec3::Y * 2.0, lamp);
        expect_every_pixel(&render(&s), [1e12; 3], 1e-6);
    }
}
