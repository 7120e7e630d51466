//! Patterns finer than a pixel, seen in curved mirrors and through glass: one sample of one pixel along the axis.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

/// A checker of unit squares, of which the axis meets the cell from (−0.3, −0.2) on.
fn checker(s: &mut Scene) -> Handle<Material> {
    let placed = Affine3A::from_translation(Vec3::new(-0.3, -0.2, 0.0));
    let space =
        PatternSpace { pattern_from_space: placed.inverse(), ..PatternSpace::new(Coordinates::World) };
    let pattern = Texture::Checker { dimensions: 2, even: grey(1.0), odd: grey(0.0), space };
    let texture = s.textures.add("checker", pattern);
    s.unlit(Value::Texture(texture))
}

/// Parallel rays along −z from the origin, a pixel `width` wide.
fn beam(width: f32) -> Scene {
    let mut s = scene(1, 1, 1);
    s.render.sampler = Sampler::Center;
    s.camera.projection = Projection::Orthographic { size: width, axis: FovAxis::Vertical };
    s
}

/// The square wave of one axis, about `x`, by its mean over a width.
fn wave(x: f64, width: f64) -> f64 {
    let n = 200_000;
    let sign = |x: f64| if x.floor().rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
    (0..n).map(|i| sign(x + width * ((f64::from(i) + 0.5) / f64::from(n) - 0.5))).sum::<f64>() / f64::from(n)
}

#[track_caller]
fn expect_width(s: &Scene, width: f64) {
    let expected = 0.5 + 0.5 * wave(0.3, width) * wave(0.2, width);
    let found = f64::from(render(s).rgb[0][0]);
    assert!((found - expected).abs() < 1e-4, "{found}, expected {expected} of a width of {width}");
}

#[test]
fn mirrors_spread_and_focus() {
    // A parallel beam of width w leaves a sphere of radius R with the spread 2 w / R, and a hollow one with −2 w / R
    for (width, radius, wall) in
        [(0.25, 2.0, 3.0), (0.125, 1.0, 9.0), (0.5, -4.0, 1.5), (0.5, -4.0, 6.0), (0.75, 0.0, 9.0)]
    {
        let mut s = beam(width);
        let mirror = s.conductor(1.0, 0.0, Fresnel::None);
        if radius == 0.0 {
            s.quad(Vec3::new(-1.0, -1.0, -1.0), Vec3::X * 2.0, Vec3::Y * 2.0, mirror);
        } else {
            // The hollow one is met from inside; its near half is behind the camera
            s.sphere(Vec3::new(0.0, 0.0, -1.0 - radius), radius.abs(), mirror);
        }
        let pattern = checker(&mut s);
        // A hollow sphere is around its wall
        s.quad(Vec3::new(-1.0, -1.0, wall - 1.0), Vec3::X * 2.0, Vec3::Y * 2.0, pattern);
        let spread = if radius == 0.0 { 0.0 } else { 2.0 * width / radius };
        expect_width(&s, f64::from((width + spread * wall).abs()));
    }
}

#[test]
fn a_ball_of_glass_has_its_focus_half_a_radius_behind_it() {
    // The focal length of a ball is n D / (4 (n − 1)) from its middle: 1.5 R for n = 1.5
    for (width, wall) in [(0.5_f32, 0.5_f32), (0.5, 0.1), (0.5, 4.0), (0.25, 7.0)] {
        let mut s = beam(width);
        let ball = s.glass(1.5, 0.0, Vec3::ZERO, false);
        s.sphere(Vec3::new(0.0, 0.0, -2.0), 1.0, ball);
        let pattern = checker(&mut s);
        s.quad(Vec3::new(-1.0, -1.0, -3.0 - wall), Vec3::X * 2.0, Vec3::Y * 2.0, pattern);
        let behind = f64::from(wall) - 0.5;
        expect_width(&s, (f64::from(width) * behind / 1.5).abs());
    }
}

#[test]
fn a_fine_checker_is_grey_in_a_small_mirror_ball_and_sharp_in_a_flat_mirror() {
    let contrast = |flat: bool| {
        let mut s = scene(32, 32, 1);
        s.render.sampler = Sampler::Center;
        s.camera.projection = Projection::pinhole(2.0);
        let mirror = s.conductor(1.0, 0.0, Fresnel::None);
        if flat {
            s.quad(Vec3::new(-1.0, -1.0, -10.0), Vec3::X * 2.0, Vec3::Y * 2.0, mirror);
        } else {
            s.sphere(Vec3::new(0.0, 0.0, -10.2), 0.2, mirror);
        }
        let pattern = checker(&mut s);
        s.quad(Vec3::new(-500.0, -500.0, 5.0), Vec3::X * 1000.0, Vec3::Y * 1000.0, pattern);
        let picture = render(&s);
        // In the middle, where the ball is met head-on
        let middle = (8..24).flat_map(|y| (8..24).map(move |x| 32 * y + x));
        middle.map(|i| (f64::from(picture.rgb[i][0]) - 0.5).abs()).fold(0.0, f64::max)
    };
    assert!(contrast(true) > 0.49, "{}", contrast(true));
    assert!(contrast(false) < 0.1, "{}", contrast(false));
}
