//! Light of surfaces: pictures on them, and their sides.

use super::floor::*;
use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, DVec3, Vec3};
use std::f64::consts::PI;

/// 2 × 2 texels, top row first: dark and bright, so that a turned picture shows.
fn four() -> Image {
    let texel = |x: f32| [x, x, x, 1.0];
    Image {
        width: 2,
        height: 2,
        texels: Texels::RgbaF32(vec![texel(1.0), texel(6.0), texel(2.5), texel(0.0)]),
    }
}

/// Its value at uv.
fn four_at(u: f64, v: f64) -> f64 {
    match (u < 0.5, v < 0.5) {
        (true, false) => 1.0,
        (false, false) => 6.0,
        (true, true) => 2.5,
        (false, true) => 0.0,
    }
}

fn textured_light(s: &mut Scene) -> dapple::scene::Handle<Material> {
    let texture = s.picture(four(), |t| t.filter = TexelFilter::Nearest);
    s.emitter(Value::Texture(texture), false)
}

#[test]
fn textured_emission_of_quads_and_meshes() {
    let (origin, u, v) = (Vec3::new(-1.6, 1.0, -0.8), Vec3::X * 2.0, Vec3::Z * 2.4);
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    for (i, (surface, bsdf)) in surfaces().into_iter().enumerate() {
        let expected = under_quad(origin, u, v, four_at, &bsdf);
        // The mirrored rectangle has the mirrored picture; its front still faces down
        let flip = |p: Vec3| mirror.transform_vector3(p);
        let expected_mirrored = under_quad(flip(origin), flip(u), flip(v), four_at, &bsdf);
        for (kind, map, expected) in [
            ("quad", Affine3A::IDENTITY, expected),
            ("mesh", Affine3A::IDENTITY, expected),
            ("quad", mirror, expected_mirrored),
            ("mesh", mirror, expected_mirrored),
        ] {
            let mut s = floor_scene(surface.clone(), 1024);
            s.camera.position = EYE.normalize() * 0.9;
            let light = textured_light(&mut s);
            if kind == "mesh" {
                let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
                s.place(mesh, light, map);
            } else {
                s.quad(origin, u, v, light).world_from_object = map;
            }
            eprintln!("surface {i}, {kind}, {}: {expected}", map.matrix3.determinant());
            expect_grey(mean(&render(&s)), expected, 2e-3);
        }
    }
}

#[test]
fn textured_emission_of_spheres_and_disks() {
    // A sphere above the floor; longitude from +x towards pole × meridian, latitude from −y to +y
    let (center, radius) = (DVec3::new(-0.3, 1.5, 0.2), 0.8);
    let d = center.length();
    let cap = 1.0 - (1.0 - (radius / d).powi(2)).sqrt();
    let (axis, x) = (center / d, (center / d).any_orthonormal_vector());
    let y = axis.cross(x);
    let expected = cap
        * 2.0
        * integrate_square(1000, |a, b| {
            let cos = 1.0 - a * cap;
            let (sin, phi) = ((1.0 - cos * cos).sqrt(), 2.0 * PI * b);
            let wi = axis * cos + (x * phi.cos() + y * phi.sin()) * sin;
            let t = d * cos - (radius * radius - d * d * sin * sin).max(0.0).sqrt();
            let n = (wi * t - center) / radius;
            // pole × meridian = y × x = −z
            let u = (-n.z).atan2(n.x) / (2.0 * PI);
            four_at(if u < 0.0 { u + 1.0 } else { u }, 0.5 + n.y.asin() / PI) * wi.y
        });
    let mut s = floor_scene(white(), 4096);
    let light = textured_light(&mut s);
    s.sphere(center.as_vec3(), radius as f32, light);
    expect_grey(mean(&render(&s)), expected, 2e-3);

    // A disk: u = angle from +x, v from the rim to the centre; also mirrored, when it turns the other way round
    let expected = |side: f64| {
        2.0 * integrate_square(1000, |a, b| {
            let (r, phi) = (a, 2.0 * PI * b);
            // normal −y: normal × meridian = −y × x = z
            let p = DVec3::new(side * (r * phi.cos() + 0.6), 1.0, r * phi.sin() + 0.4);
            four_at(b, 1.0 - a) * (1.0 / p.length_squared()).powi(2) * r
        })
    };
    for side in [1.0, -1.0] {
        let mut s = floor_scene(white(), 4096);
        s.camera.position = Vec3::new(0.3, 0.2, 0.1);
        let light = textured_light(&mut s);
        let (center, normal) = (Vec3::new(0.6, 1.0, 0.4), Vec3::NEG_Y);
        let disk = ShapeKind::Disk { center, normal, radius: 1.0, meridian: Vec3::X };
        s.shape(disk, light).world_from_object = Affine3A::from_scale(Vec3::new(side, 1.0, 1.0));
        expect_grey(mean(&render(&s)), expected(f64::from(side)), 2e-3);
    }
}

#[test]
fn emission_from_one_side_and_from_both() {
    let (origin, u, v) = QUADS[0];
    let irradiance = polygon_irradiance(&quad_corners(origin, u, v)) / PI;
    for (two_sided, up) in [(false, false), (false, true), (true, false), (true, true)] {
        for as_mesh in [false, true] {
            let (u, v) = if up { (v, u) } else { (u, v) };
            let mut s = floor_scene(white(), 256);
            let light = s.emitter(grey(1.0), two_sided);
            if as_mesh {
                let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
                s.place(mesh, light, Affine3A::IDENTITY);
            } else {
                s.quad(origin, u, v, light);
            }
            let measured = mean(&render(&s));
            if up && !two_sided {
                assert_eq!(measured.mean, [0.0; 3], "light from the back");
            } else {
                expect_grey(measured, irradiance, 1e-3);
            }
            // The same from the light itself
            s.camera = look(Vec3::new(-0.2, 0.5, 0.2), Vec3::new(-0.2, 2.0, 0.21), 5.0);
            expect_every_pixel(&render(&s), [if up && !two_sided { 0.0 } else { 1.0 }; 3], 0.0);
        }
    }
}
