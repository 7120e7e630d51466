//! Light of pictures around the scene.

use super::floor::*;
use super::light_texture::octahedral;
use crate::common::render::*;
use dapple::scene::*;
use glam::{DVec3, Mat3, Vec3};
use std::f64::consts::PI;

/// 8 × 4 texels with one bright one.
fn sky() -> (Image, impl Fn(DVec3) -> f64) {
    let value =
        |x: usize, y: usize| if (x, y) == (5, 1) { 40.0 } else { 0.2 + ((x * 7 + y * 3) % 5) as f32 * 0.3 };
    let texels =
        (0..32).map(|i| [value(i % 8, i / 8), value(i % 8, i / 8), value(i % 8, i / 8), 1.0]).collect();
    let at = move |d: DVec3| {
        // The middle column looks along −z, u grows towards +x there, the top row is +y
        let u = 0.5 + d.x.atan2(-d.z) / (2.0 * PI);
        let row = (0.5 - d.y.clamp(-1.0, 1.0).asin() / PI) * 4.0;
        f64::from(value(((u * 8.0) as usize).min(7), (row as usize).min(3)))
    };
    (Image { width: 8, height: 4, texels: Texels::RgbaF32(texels) }, at)
}

fn image_environment(s: &mut Scene, image: Image, turn: Mat3) {
    let texture = s.picture(image, |t| t.filter = TexelFilter::Nearest);
    s.environment =
        Some(Environment { world_from_environment: turn, ..Environment::new(Value::Texture(texture)) });
}

#[test]
fn which_pixel_of_an_environment_is_seen_where() {
    let tilt = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(0.4);
    for turn in [Mat3::IDENTITY, tilt] {
        let mut s = scene(1, 1, 1);
        let (image, at) = sky();
        image_environment(&mut s, image, turn);
        s.render.sampler = Sampler::Center;
        // A little off the borders between texels
        for d in [Vec3::NEG_Z, Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::new(0.6, 0.5, 0.4)]
        {
            let d = d.normalize() + Vec3::new(0.02, 0.013, 0.017);
            s.camera = look(Vec3::ZERO, d, 10.0);
            let expected = at(turn.as_dmat3().transpose() * d.as_dvec3().normalize());
            // Sums are whole numbers of 2⁻²⁴ here: 2⁻³⁰ of the brightest texel, 40, rounded up to a power of two
            let seen = f64::from(render(&s).rgb[0][1]);
            assert!((seen - expected).abs() < 1e-7, "{d}: {seen}, expected {expected}");
        }
    }
}

#[test]
fn image_environment_on_a_floor() {
    let tilt = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(0.4) * Mat3::from_rotation_z(-0.3);
    for turn in [Mat3::IDENTITY, tilt] {
        let (_, at) = sky();
        let wo = EYE.as_dvec3().normalize();
        for (surface, bsdf) in surfaces() {
            let back = turn.as_dmat3().transpose();
            let expected = albedo(wo, |wo, wi| bsdf(wo, wi) * at(back * wi));
            let mut s = floor_scene(surface, 2048);
            image_environment(&mut s, sky().0, turn);
            // The quadrature meets the borders of texels at random: about one cell of 1500 wide
            expect_grey(mean(&render(&s)), expected, 2e-3);
        }
    }
}

#[test]
fn moved_environment_pictures_are_sampled_without_bias() {
    let (_, at) = sky();
    let wo = EYE.as_dvec3().normalize();
    // u moved by a quarter: what was seen along −z is seen where u was a quarter less
    let expected = albedo(wo, |_, wi| at(DVec3::new(-wi.z, wi.y, wi.x)) / PI);
    let mut s = floor_scene(white(), 16_384);
    let texture = s.picture(sky().0, |t| {
        t.filter = TexelFilter::Nearest;
        t.uv.offset = glam::Vec2::new(0.25, 0.0);
    });
    s.environment = Some(Environment::new(Value::Texture(texture)));
    expect_grey(mean(&render(&s)), expected, 2e-3);
}

#[test]
fn bright_texels_of_an_environment_are_not_clamped() {
    let mut s = scene(4, 4, 4);
    let image = Image { width: 1, height: 1, texels: Texels::RgbaF32(vec![[5.0e4, 1.0, 1.0e-3, 1.0]]) };
    image_environment(&mut s, image, Mat3::IDENTITY);
    let p = render(&s);
    // Sums are whole numbers of 2⁻¹⁴ here
    assert!(p.rgb.iter().all(|c| (c[0] - 5.0e4).abs() < 1e-2 && (c[1] - 1.0).abs() < 1e-4), "{:?}", p.rgb[0]);
}

#[test]
fn an_even_equal_area_environment_is_even() {
    // A white floor under it shows its radiance, whatever direction is drawn, and so does a mirror of it
    let mut s = floor_scene(white(), 256);
    let image = Image { width: 5, height: 5, texels: Texels::RgbaF32(vec![[0.7; 4]; 25]) };
    image_environment(&mut s, image, Mat3::from_rotation_x(0.4));
    s.environment.as_mut().unwrap().mapping = DirectionMapping::EqualArea;
    expect_grey(mean(&render(&s)), f64::from(0.7_f32), 1e-4);
}

#[test]
fn an_equal_area_environment_on_a_floor() {
    let tilt = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(0.4) * Mat3::from_rotation_z(-0.3);
    let value = |i: usize| if i == 11 { 40.0 } else { 0.2 + (i * 7 % 5) as f32 * 0.3 };
    let at = |d: DVec3| {
        let uv = octahedral(d);
        let [column, row] = [uv.x, 1.0 - uv.y].map(|x| ((x * 6.0) as usize).min(5));
        f64::from(value(row * 6 + column))
    };
    let wo = EYE.as_dvec3().normalize();
    for turn in [Mat3::IDENTITY, tilt] {
        for (surface, bsdf) in surfaces() {
            let back = turn.as_dmat3().transpose();
            let expected = albedo(wo, |wo, wi| bsdf(wo, wi) * at(back * wi));
            let mut s = floor_scene(surface, 2048);
            let texels = Texels::RgbaF32((0..36).map(|i| [value(i); 4]).collect());
            image_environment(&mut s, Image { width: 6, height: 6, texels }, turn);
            s.environment.as_mut().unwrap().mapping = DirectionMapping::EqualArea;
            // The quadrature meets the borders of texels at random
            expect_grey(mean(&render(&s)), expected, 2e-3);
        }
    }
}
