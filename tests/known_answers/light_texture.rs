//! Lights that textures drive, and pictures thrown from a point.

use super::floor::*;
use crate::common::render::*;
use dapple::prepare::prepare;
use dapple::scene::*;
use glam::{DMat3, DVec2, DVec3, Mat3, Vec2, Vec3};
use std::f64::consts::PI;

/// A picture of floats, of which no two are equal.
fn patches(width: u32, height: u32) -> Image {
    let texel = |i: u32| [1.0 + i as f32, 0.5 + (i * 7 % 5) as f32, 2.0, 1.0];
    Image { width, height, texels: Texels::RgbaF32((0..width * height).map(texel).collect()) }
}

/// The texel of `patches` at a uv.
fn patch(width: u32, height: u32, uv: DVec2) -> [f64; 3] {
    let column = ((uv.x * f64::from(width)) as u32).min(width - 1);
    let row = (((1.0 - uv.y) * f64::from(height)) as u32).min(height - 1);
    let i = row * width + column;
    [f64::from(1 + i), 0.5 + f64::from(i * 7 % 5), 2.0]
}

/// The middle column along −z, u towards +x there, the upper row at +y.
pub(super) fn longitude_latitude(d: DVec3) -> DVec2 {
    DVec2::new(0.5 + d.x.atan2(-d.z) / (2.0 * PI), 0.5 + d.y.asin() / PI)
}

/// The octahedral square of Clarberg 2008: a quarter of the sphere a corner, by its azimuth and the area of its cap.
pub(super) fn octahedral(d: DVec3) -> DVec2 {
    // Distance from the middle along |u| + |v|: the cap above holds the same share of half the sphere as that diamond of half
    // the square
    let cap = (1.0 - d.y.abs()).sqrt();
    let share = d.z.abs().atan2(d.x.abs()) / (0.5 * PI);
    let p = DVec2::new(cap * (1.0 - share), cap * share);
    let p = if d.y < 0.0 { DVec2::new(1.0 - p.y, 1.0 - p.x) } else { p };
    0.5 + 0.5 * p * DVec2::new(d.x.signum(), d.z.signum())
}

type DirectionToUv = fn(DVec3) -> DVec2;

fn textured(s: &mut Scene, kind: LightKind, image: Image) -> Light {
    let texture = s.picture(image, |t| t.filter = TexelFilter::Nearest);
    Light::new(kind, Value::Texture(texture))
}

fn turns() -> [Mat3; 3] {
    let turn = |x: f32, y: f32| Mat3::from_rotation_y(y) * Mat3::from_rotation_x(x);
    [Mat3::IDENTITY, turn(0.4, 0.7), turn(-1.9, 2.5) * Mat3::from_rotation_z(0.8)]
}

#[test]
fn a_point_light_shines_as_its_picture_says_in_each_direction() {
    let mappings: [(_, DirectionToUv); 2] =
        [(DirectionMapping::Equirectangular, longitude_latitude), (DirectionMapping::EqualArea, octahedral)];
    for (mapping, uv) in mappings {
        for turn in turns() {
            for at in [Vec3::new(1.0, 2.0, -0.5), Vec3::new(-3.0, 1.0, 2.0)] {
                let mut s = floor_scene(white(), 4);
                let light = textured(&mut s, LightKind::Point { position: at, mapping }, patches(9, 9));
                s.lights.push(Light { world_from_light: turn, strength: Strength::Scale(2.0), ..light });
                let p = at.as_dvec3();
                let seen = turn.as_dmat3().transpose() * -p.normalize();
                let falls = 2.0 * p.normalize().y / p.length_squared() / PI;
                expect_mean(mean(&render(&s)), patch(9, 9, uv(seen)).map(|c| c * falls), 1e-4);
            }
        }
    }
}

#[test]
fn patterns_see_the_direction_of_a_light() {
    // A checker in object space turns with the light, one in world space does not: octants of directions
    for (coordinates, turned) in [(Coordinates::Object, true), (Coordinates::World, false)] {
        let mut bright = 0;
        for turn in turns() {
            for at in [Vec3::new(1.0, 2.0, -0.5), Vec3::new(-3.0, 1.0, 2.0), Vec3::new(-0.4, 2.0, -0.6)] {
                let mut s = floor_scene(white(), 4);
                let space = PatternSpace::new(coordinates);
                let checker = Texture::Checker { dimensions: 3, even: grey(1.0), odd: grey(0.25), space };
                let texture = Value::Texture(s.textures.add("octants", checker));
                let point = LightKind::Point { position: at, mapping: DirectionMapping::default() };
                s.lights.push(Light { world_from_light: turn, ..Light::new(point, texture) });
                let p = at.as_dvec3();
                let seen = if turned { turn.as_dmat3().transpose() } else { DMat3::IDENTITY } * -p;
                let even = seen.to_array().iter().filter(|c| **c < 0.0).count() % 2 == 0;
                bright += usize::from(even);
                let value = if even { 1.0 } else { 0.25 };
                expect_grey(mean(&render(&s)), value * p.normalize().y / p.length_squared() / PI, 1e-4);
            }
        }
        assert!((1..9).contains(&bright), "{bright} of 9");
    }
}

#[test]
fn a_spot_light_aims_at_the_middle_of_its_picture() {
    let at = Vec3::new(1.0, 2.0, -0.5);
    let (d2, cos) = (f64::from(at.length_squared()), f64::from(at.normalize().y));
    let (outer, inner) = (50_f64.to_radians().cos(), 10_f64.to_radians().cos());
    for off in [Vec3::ZERO, Vec3::X * 0.9, Vec3::Z * 0.8, Vec3::new(-0.7, 0.0, -0.9)] {
        let mut s = floor_scene(white(), 4);
        let kind = LightKind::spot(at, 50.0, 40.0);
        let (direction, up) = ((off - at).normalize(), Vec3::new(0.3, 1.0, 0.2));
        let light = textured(&mut s, kind, patches(31, 15));
        s.lights.push(Light { world_from_light: facing(direction, up).unwrap(), ..light });
        let (axis, to) = (direction.as_dvec3(), -at.as_dvec3().normalize());
        let right = axis.cross(up.as_dvec3()).normalize();
        let seen = DVec3::new(to.dot(right), to.dot(right.cross(axis)), -to.dot(axis));
        let t = ((to.dot(axis) - outer) / (inner - outer)).clamp(0.0, 1.0);
        let falls = cos / d2 / PI * t * t * (3.0 - 2.0 * t);
        let expected = patch(31, 15, longitude_latitude(seen)).map(|c| c * falls);
        if off == Vec3::ZERO {
            assert_eq!(patch(31, 15, DVec2::splat(0.5)), patch(31, 15, longitude_latitude(seen)));
        }
        expect_mean(mean(&render(&s)), expected, 2e-4);
    }
}

/// A white floor of `size` units, seen from above: +x to the right and −z up. 24 x 24 pixels, whose middles are looked at.
fn from_above(size: f32) -> Scene {
    let mut s = scene(24, 24, 1);
    s.render.max_depth = 1;
    s.render.sampler = Sampler::Center;
    let projection = Projection::Orthographic { size, axis: FovAxis::Vertical };
    s.camera = Camera { up: Vec3::NEG_Z, projection, ..look(Vec3::Y, Vec3::ZERO, 40.0) };
    let white = s.material(white(), None);
    // Small: the place of a point on it is known to a rounding of its size
    s.quad(Vec3::new(-5.0, 0.0, 5.0), Vec3::X * 10.0, Vec3::NEG_Z * 10.0, white);
    s
}

/// x and z of the middle of each pixel of `from_above`.
fn places(size: f32) -> impl Iterator<Item = DVec2> {
    let at = move |i: u32| (f64::from(i) + 0.5) / 24.0 - 0.5;
    (0..24 * 24).map(move |i| DVec2::new(at(i % 24), at(i / 24)) * f64::from(size))
}

fn expect_pixels(s: &Scene, expected: impl IntoIterator<Item = [f64; 3]>, relative: f64) {
    let picture = render(s);
    for (i, (seen, expected)) in picture.rgb.iter().zip(expected).enumerate() {
        for c in 0..3 {
            let off = (f64::from(seen[c]) - expected[c]).abs();
            assert!(off <= relative * expected[c] + 1e-7, "pixel {i}: {seen:?}, expected {expected:?}");
        }
    }
}

#[test]
fn a_cookie_of_stripes_lies_across_the_light() {
    let mut s = from_above(5.0);
    let image = Image { width: 2, height: 1, texels: Texels::RgbaF32(vec![[1.0; 4], [3.0; 4]]) };
    let texture = s.picture(image, |t| {
        t.filter = TexelFilter::Nearest;
        t.uv.scale = Vec2::splat(0.5);
    });
    // Light that travels along +x and down: seen along it, right is +z, and a step along z is a step in u
    let direction = Vec3::new(0.6, -0.8, 0.0);
    let light = Light::new(LightKind::distant(0.0), Value::Texture(texture)).along(direction);
    s.lights.push(light.clone());
    let stripe = |u: f64| if u.rem_euclid(2.0) < 1.0 { 1.0 } else { 3.0 };
    expect_pixels(&s, places(5.0).map(|at| [stripe(at.y) * 0.8 / PI; 3]), 1e-5);
    // With z up a step in u lies in the plane of x and y
    s.lights = vec![Light { world_from_light: facing(direction, Vec3::Z).unwrap(), ..light }];
    let right = direction.as_dvec3().cross(DVec3::Z).normalize();
    expect_pixels(&s, places(5.0).map(|at| [stripe(at.x * right.x) * 0.8 / PI; 3]), 1e-5);
}

#[test]
fn a_projection_fills_its_frustum_and_no_more() {
    // 60° upward at height 2, twice as wide as high; −z is up, so +x is right
    let mut s = from_above(6.0);
    let (position, fov_axis) = (Vec3::Y * 2.0, FovAxis::Vertical);
    let kind = LightKind::Projection { position, fov: 60.0, fov_axis, aspect: 2.0 };
    let light = textured(&mut s, kind, patches(6, 5));
    s.lights.push(Light { strength: Strength::Scale(3.0), ..light.clone().along(Vec3::NEG_Y) });
    let half = 2.0 * 30_f64.to_radians().tan();
    let inside = |at: DVec2| {
        let uv = 0.5 + 0.5 * DVec2::new(at.x / (2.0 * half), -at.y / half);
        let holds = uv.min_element() >= 0.0 && uv.max_element() <= 1.0;
        // No cosine at the light: intensity · cos θ / d² at the floor
        let falls = 3.0 * 2.0 / (at.length_squared() + 4.0).powf(1.5) / PI;
        if holds { patch(6, 5, uv).map(|c| c * falls) } else { [0.0; 3] }
    };
    let lit = places(6.0).filter(|at| inside(*at)[0] > 0.0).count();
    assert!((100..400).contains(&lit), "{lit} pixels");
    expect_pixels(&s, places(6.0).map(inside), 1e-5);
    // Across the shorter side it is the same field of view; without a texture it is even
    let even =
        |fov_axis, fov| Light::new(LightKind::Projection { position, fov, fov_axis, aspect: 2.0 }, grey(1.0));
    for light in
        [even(FovAxis::Smaller, 60.0), even(FovAxis::Horizontal, 2.0 * half.atan().to_degrees() as f32)]
    {
        s.lights = vec![light.along(Vec3::NEG_Y)];
        let expected = |at: DVec2| {
            let falls = 2.0 / (at.length_squared() + 4.0).powf(1.5) / PI;
            let holds = at.x.abs() <= 2.0 * half && at.y.abs() <= half;
            [if holds { falls } else { 0.0 }; 3]
        };
        expect_pixels(&s, places(6.0).map(expected), 1e-5);
    }
}

/// Mean of red, green and blue of all that a light sends out, by a grid over the uv of its picture.
fn sent(uv_to_solid_angle: impl Fn(DVec2) -> f64) -> f64 {
    integrate_square(720, |u, v| {
        let uv = DVec2::new(u, v);
        patch(45, 45, uv).into_iter().sum::<f64>() / 3.0 * uv_to_solid_angle(uv)
    })
}

#[test]
fn power_is_what_is_sent_out() {
    let position = Vec3::Y;
    let point = |mapping| LightKind::Point { position, mapping };
    let spot = LightKind::spot(position, 60.0, 60.0);
    let slide = LightKind::Projection { position, fov: 90.0, fov_axis: FovAxis::Vertical, aspect: 1.5 };
    let latitude = |uv: DVec2| 2.0 * PI * PI * ((uv.y - 0.5) * PI).cos();
    let soft = |uv: DVec2| {
        let toward = ((uv.y - 0.5) * PI).cos() * ((uv.x - 0.5) * 2.0 * PI).cos();
        let t = ((toward - 0.5) / 0.5).clamp(0.0, 1.0);
        latitude(uv) * t * t * (3.0 - 2.0 * t)
    };
    let flat =
        |uv: DVec2| 6.0 * (1.0 + ((2.0 * uv - 1.0) * DVec2::new(1.5, 1.0)).length_squared()).powf(-1.5);
    let cases: [(LightKind, f64); 4] = [
        (point(DirectionMapping::Equirectangular), sent(latitude)),
        (point(DirectionMapping::EqualArea), sent(|_| 4.0 * PI)),
        (spot, sent(soft)),
        (slide, sent(flat)),
    ];
    for (kind, whole) in cases {
        let mut s = floor_scene(white(), 1);
        let light = textured(&mut s, kind, patches(45, 45));
        s.lights.push(Light { strength: Strength::Power(80.0), ..light });
        let factor = f64::from(prepare(&s).unwrap().lights[0].radiance[1]);
        // Texels are weighed at their middles
        assert!((factor * whole / 80.0 - 1.0).abs() < 2e-3, "{kind:?}: {factor} · {whole}");
        s.lights = vec![Light { strength: Strength::Power(80.0), ..Light::new(kind, grey(7.0)) }];
        let even = f64::from(prepare(&s).unwrap().lights[0].radiance[0]);
        let angle = match kind {
            LightKind::Point { .. } => 4.0 * PI,
            // ∫ smoothstep over the cosine from ½ to 1
            LightKind::Punctual(_) => 2.0 * PI * 0.25,
            _ => 4.0 * (1.5 / 3.25_f64.sqrt()).asin().min((1.5 / (3.25 * 2.0_f64).sqrt()).asin()),
        };
        assert!((even * angle / 80.0 - 1.0).abs() < 1e-5, "{kind:?}: {even} · {angle}");
    }
}

#[test]
fn textured_lights_are_chosen_by_their_mean_and_add_up() {
    // One picture is dark but for a texel; the constant light beside it is right, and so is the sum
    let mut s = floor_scene(white(), 4096);
    let mut texels = vec![[0.0, 0.0, 0.0, 1.0]; 32];
    texels[27] = [900.0, 900.0, 900.0, 1.0];
    let image = Image { width: 8, height: 4, texels: Texels::RgbaF32(texels) };
    let position = Vec3::new(0.3, 2.0, 0.5);
    let light = textured(&mut s, LightKind::Point { position, mapping: DirectionMapping::default() }, image);
    s.lights.push(light);
    s.lights.push(point(Vec3::new(1.0, 2.0, 0.0), 3.0));
    let down = longitude_latitude(-position.as_dvec3().normalize());
    let at = (((1.0 - down.y) * 4.0) as usize) * 8 + (down.x * 8.0) as usize;
    let bright = if at == 27 { 900.0 } else { 0.0 };
    let falls = |p: Vec3| f64::from(p.normalize().y / p.length_squared()) / PI;
    assert!(bright > 0.0, "texel {at}");
    expect_grey(mean(&render(&s)), bright * falls(position) + 3.0 * falls(Vec3::new(1.0, 2.0, 0.0)), 1e-3);
}
