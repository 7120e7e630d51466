//! Glass: what it reflects, lets through and absorbs.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

/// Reflectance of a boundary for unpolarised light (Fresnel 1823); `eta` behind over in front.
fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2_t).sqrt();
    let s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    (s * s + p * p) / 2.0
}

/// White above, black below: two halves of a room, seen from a camera above that looks down at y = 0 at an angle of
/// incidence. What is seen of the white is what is reflected.
fn reflected(surface: Surface, angle: f32, spp: u32, white_above: bool) -> Measured {
    let mut s = scene(8, 8, spp);
    s.render.max_depth = 40;
    s.render.russian_roulette = false;
    let (sin, cos) = angle.to_radians().sin_cos();
    s.camera = look(Vec3::new(sin, cos, 0.0) * 2.0, Vec3::ZERO, 0.02);
    let m = s.material(surface, None);
    s.floor(m);
    let (above, below) = (s.unlit(grey(f32::from(white_above))), s.unlit(grey(f32::from(!white_above))));
    // Half spheres would be cut by the floor; two planes do
    s.quad(Vec3::new(-300.0, 5.0, -300.0), Vec3::X * 600.0, Vec3::Z * 600.0, above);
    s.quad(Vec3::new(-300.0, -5.0, -300.0), Vec3::Z * 600.0, Vec3::X * 600.0, below);
    mean(&render(&s))
}

#[test]
fn glass_reflects_by_fresnel_and_transmits_the_rest() {
    for angle in [0.0_f32, 30.0, 56.31, 75.0] {
        let cos = f64::from(angle).to_radians().cos();
        let r = fresnel(cos, 1.5);
        let surface = || glass(1.5, 0.0, Vec3::ZERO, false);
        // Around 4 % of 64 · 16384 samples
        expect_grey(reflected(surface(), angle, 8192, true), r, 1e-4);
        // Radiance that comes from below is scaled by 1/η² of where it goes: here the sensor is outside, light inside
        expect_grey(reflected(surface(), angle, 8192, false), (1.0 - r) / 2.25, 1e-4);
    }
}

#[test]
fn a_thin_sheet_sums_its_inner_reflections() {
    for angle in [0.0_f32, 40.0, 70.0] {
        let r = fresnel(f64::from(angle).to_radians().cos(), 1.5);
        let sheet = 2.0 * r / (1.0 + r);
        let surface = || glass(1.5, 0.0, Vec3::ZERO, true);
        expect_grey(reflected(surface(), angle, 8192, true), sheet, 1e-4);
        expect_grey(reflected(surface(), angle, 8192, false), 1.0 - sheet, 1e-4);
    }
}

#[test]
fn total_reflection_from_inside() {
    // The camera is inside: beyond asin(1/1.5) = 41.8° nothing gets out
    for (angle, total) in [(43.0_f32, true), (60.0, true), (80.0, true), (35.0, false)] {
        let mut s = scene(4, 4, if total { 64 } else { 16_384 });
        let (sin, cos) = angle.to_radians().sin_cos();
        // Below the surface, looking up
        s.camera = look(Vec3::new(sin, -cos, 0.0) * 2.0, Vec3::ZERO, 0.02);
        let m = s.glass(1.5, 0.0, Vec3::ZERO, false);
        s.floor(m);
        let (above, below) = (s.unlit(grey(0.0)), s.unlit(grey(1.0)));
        s.quad(Vec3::new(-300.0, 5.0, -300.0), Vec3::X * 600.0, Vec3::Z * 600.0, above);
        s.quad(Vec3::new(-300.0, -5.0, -300.0), Vec3::Z * 600.0, Vec3::X * 600.0, below);
        let p = render(&s);
        if total {
            expect_every_pixel(&p, [1.0; 3], 1e-6);
        } else {
            let r = fresnel(f64::from(angle).to_radians().cos(), 1.0 / 1.5);
            assert!(r > 0.0 && r < 0.2);
            expect_grey(mean(&p), r, 1e-4);
        }
    }
}

/// A slab of glass, `thickness` thick, closed at its far ends.
fn slab(angle: f32, thickness: f32, absorption: f32, alpha: f32, white_above: bool) -> Measured {
    let mut s = scene(8, 8, 4096);
    s.render.max_depth = 100;
    let (sin, cos) = angle.to_radians().sin_cos();
    s.camera = look(Vec3::new(sin, cos, 0.0) * 2.0, Vec3::ZERO, 0.02);
    let m = s.glass(1.5, alpha, Vec3::splat(absorption), false);
    let mesh = s
        .meshes
        .add("slab", box_mesh(Vec3::new(-100.0, -thickness, -100.0), Vec3::new(100.0, 0.0, 100.0), false));
    s.place(mesh, m, Affine3A::IDENTITY);
    let (above, below) = (s.unlit(grey(f32::from(white_above))), s.unlit(grey(f32::from(!white_above))));
    s.quad(Vec3::new(-300.0, 5.0, -300.0), Vec3::X * 600.0, Vec3::Z * 600.0, above);
    s.quad(Vec3::new(-300.0, -5.0, -300.0), Vec3::Z * 600.0, Vec3::X * 600.0, below);
    mean(&render(&s))
}

#[test]
fn a_slab_absorbs_by_beer_and_loses_nothing_else() {
    for (angle, absorption) in [(0.0_f32, 0.0_f32), (0.0, 0.8), (50.0, 0.0), (50.0, 1.5)] {
        let cos = f64::from(angle).to_radians().cos();
        let r = fresnel(cos, 1.5);
        let cos_t = (1.0 - (1.0 - cos * cos) / 2.25).sqrt();
        let a = (-f64::from(absorption) * 0.5 / cos_t).exp();
        // Sums over the reflections inside
        let reflected = r + (1.0 - r).powi(2) * r * a * a / (1.0 - r * r * a * a);
        let transmitted = (1.0 - r).powi(2) * a / (1.0 - r * r * a * a);
        expect_grey(slab(angle, 0.5, absorption, 0.0, true), reflected, 1e-4);
        expect_grey(slab(angle, 0.5, absorption, 0.0, false), transmitted, 1e-4);
    }
}

#[test]
fn a_ball_of_clear_glass_in_a_white_room_is_invisible() {
    // Radiance in is radiance out, smooth: whatever way light takes
    let mut s = scene(16, 16, 64);
    s.render.max_depth = 200;
    s.environment = constant_environment(1.0);
    let m = s.glass(1.5, 0.0, Vec3::ZERO, false);
    s.sphere(Vec3::new(0.1, 0.2, -3.0), 2.0, m);
    expect_every_pixel(&render(&s), [1.0; 3], 1e-4);
}

#[test]
fn a_camera_inside_glass_sees_its_absorption() {
    let mut s = scene(4, 4, 4096);
    s.render.max_depth = 1;
    s.environment = constant_environment(1.0);
    s.camera.projection = Projection::pinhole(0.1);
    let m = s.glass(1.5, 0.0, Vec3::new(0.2, 0.5, 1.0), false);
    s.sphere(Vec3::ZERO, 2.0, m);
    // 2 units of glass, then out: 1 − R, and radiance 1/η² · … of the way from air to glass is 2.25
    let r = fresnel(1.0, 1.0 / 1.5);
    let expected = [0.2_f64, 0.5, 1.0].map(|a| (-2.0 * a).exp() * (1.0 - r) * 2.25);
    expect_mean(mean(&render(&s)), expected, 1e-3);
}

/// What a camera inside glass sees of a white ball at a distance of 1 that is in there with it.
fn ball_beside_the_camera(build: impl FnOnce(&mut Scene, Handle<Material>)) -> Measured {
    let mut s = scene(4, 4, 64);
    s.render.max_depth = 1;
    s.camera.projection = Projection::pinhole(0.1);
    let m = s.glass(1.5, 0.0, Vec3::new(0.2, 0.5, 1.0), false);
    build(&mut s, m);
    let white = s.unlit(grey(1.0));
    s.sphere(Vec3::NEG_Z * 1.5, 0.5, white);
    mean(&render(&s))
}

#[test]
fn glass_around_the_camera_absorbs_on_the_way_to_what_is_in_it() {
    let through = [0.2_f64, 0.5, 1.0].map(|a| (-a).exp());
    let clear = [1.0; 3];
    let cube = |s: &mut Scene, m, half: f32, inward| {
        let mesh = s.meshes.add("cube", box_mesh(Vec3::splat(-half), Vec3::splat(half), inward));
        s.place(mesh, m, Affine3A::IDENTITY);
    };
    let sphere = ball_beside_the_camera(|s, m| _ = s.sphere(Vec3::ZERO, 3.0, m));
    expect_mean(sphere, through, 0.0);
    expect_mean(ball_beside_the_camera(|s, m| cube(s, m, 3.0, false)), through, 0.0);
    // A mirrored map keeps the inside of a mesh inside
    let mirrored = ball_beside_the_camera(|s, m| {
        let mesh = s.meshes.add("cube", box_mesh(Vec3::splat(-3.0), Vec3::splat(3.0), false));
        s.place(mesh, m, Affine3A::from_scale(Vec3::new(1.0, -1.0, 1.0)));
    });
    expect_mean(mirrored, through, 0.0);
    // Six quads
    let quads = ball_beside_the_camera(|s, m| {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
            let (u, v) = axis.any_orthonormal_pair();
            let (u, v) = if u.cross(v).dot(axis) > 0.0 { (u, v) } else { (v, u) };
            s.quad(3.0 * (axis - u - v), 6.0 * u, 6.0 * v, m);
        }
    });
    expect_mean(quads, through, 0.0);
    // A bubble in glass, a ball of glass beside the camera, and a sheet that closes nothing
    let bubble = ball_beside_the_camera(|s, m| {
        cube(s, m, 4.0, false);
        cube(s, m, 3.0, true);
    });
    expect_mean(bubble, clear, 0.0);
    expect_mean(ball_beside_the_camera(|s, m| _ = s.sphere(Vec3::Y * 3.0, 2.0, m)), clear, 0.0);
    let sheet = ball_beside_the_camera(|s, m| {
        s.quad(Vec3::new(-9.0, 0.1, 9.0), Vec3::X * 18.0, Vec3::NEG_Z * 18.0, m);
    });
    expect_mean(sheet, clear, 0.0);
    // Of two, one in the other, the inner
    let inner = ball_beside_the_camera(|s, m| {
        s.sphere(Vec3::ZERO, 9.0, m);
        let other = s.glass(1.5, 0.0, Vec3::splat(2.0), false);
        s.sphere(Vec3::ZERO, 3.0, other);
    });
    expect_grey(inner, (-2.0_f64).exp(), 0.0);
}

#[test]
fn a_ball_inside_absorbing_glass() {
    // Camera outside, a white unlit ball inside a ball of glass, on the axis: through 1 unit of glass
    let mut s = scene(4, 4, 4096);
    s.camera = look(Vec3::Z * 6.0, Vec3::ZERO, 0.1);
    s.render.max_depth = 1;
    let m = s.glass(1.5, 0.0, Vec3::new(0.2, 0.5, 1.0), false);
    s.sphere(Vec3::ZERO, 2.0, m);
    let white = s.unlit(grey(1.0));
    s.sphere(Vec3::ZERO, 1.0, white);
    let r = fresnel(1.0, 1.5);
    let expected = [0.2_f64, 0.5, 1.0].map(|a| (-a).exp() * (1.0 - r) / 2.25);
    expect_mean(mean(&render(&s)), expected, 1e-3);
}

#[test]
fn a_sheet_inside_glass_leaves_the_glass_as_it_is() {
    // A ball of glass of radius 2 that bends nothing; in it a white disk at z = 0, behind a sheet at z = 1
    let mut s = scene(4, 4, 64);
    s.camera = look(Vec3::Z * 6.0, Vec3::ZERO, 0.02);
    s.render.max_depth = 3;
    let glass = s.glass(1.0, 0.0, Vec3::new(0.2, 0.5, 1.0), false);
    s.sphere(Vec3::ZERO, 2.0, glass);
    let sheet = s.glass(1.0, 0.0, Vec3::ZERO, true);
    s.disk(Vec3::Z, Vec3::Z, 1.0, sheet);
    let white = s.unlit(grey(1.0));
    s.disk(Vec3::ZERO, Vec3::Z, 0.3, white);
    expect_mean(mean(&render(&s)), [0.2_f64, 0.5, 1.0].map(|a| (-2.0 * a).exp()), 1e-4);
}

#[test]
fn a_lamp_inside_glass_is_absorbed_on_its_way_to_a_surface_there() {
    // A ball of glass of radius 2 that bends nothing; in its middle a white disk towards the camera, and a lamp beside
    let absorption = [0.2_f64, 0.5, 1.0];
    let inside = |lamp: &dyn Fn(&mut Scene)| {
        let mut s = scene(4, 4, 1024);
        s.camera = look(Vec3::Z * 6.0, Vec3::ZERO, 0.02);
        s.render.max_depth = 2;
        let m = s.glass(1.0, 0.0, Vec3::new(0.2, 0.5, 1.0), false);
        s.sphere(Vec3::ZERO, 2.0, m);
        let white = s.diffuse(1.0);
        s.disk(Vec3::ZERO, Vec3::Z, 0.3, white);
        lamp(&mut s);
        mean(&render(&s))
    };
    let at = Vec3::new(0.9, 0.2, 1.2);
    let (d, cos) = (f64::from(at.length()), f64::from(at.normalize().z));
    let expected = absorption.map(|a| (-a * (2.0 + d)).exp() * 5.0 * cos / (d * d * std::f64::consts::PI));
    expect_mean(inside(&|s| s.lights.push(point(at, 5.0))), expected, 1e-4);

    // A lamp that both strategies find
    let (origin, u, v) = (Vec3::new(0.3, -0.5, 1.0), Vec3::Y, Vec3::X * 0.8);
    let expected = absorption.map(|a| {
        let seen = integrate_square(400, |x, y| {
            let p = (origin + u * x as f32 + v * y as f32).as_dvec3();
            let cos = p.normalize().z;
            cos * cos / p.length_squared() * (-a * (2.0 + p.length())).exp()
        });
        2.0 * 0.8 * seen / std::f64::consts::PI
    });
    let quad = |s: &mut Scene| {
        let lamp = s.emitter(grey(2.0), false);
        s.quad(origin, u, v, lamp);
    };
    expect_mean(inside(&quad), expected, 1e-3);
}

#[test]
fn a_rough_boundary_absorbs_on_its_inner_side_only() {
    // A small lamp on one side of rough glass, the camera on the other; the way inside the glass has one length
    let across = |lamp_inside: bool, absorption: f32| {
        let mut s = scene(4, 4, 4096);
        s.render.max_depth = 1;
        let side = if lamp_inside { 1.0 } else { -1.0 };
        s.camera = look(Vec3::new(0.3, 1.5 * side, 0.1), Vec3::ZERO, 0.02);
        let m = s.glass(1.5, 0.5, Vec3::splat(absorption), false);
        s.floor(m);
        let lamp = s.emitter(grey(100.0), false);
        s.sphere(Vec3::new(0.2, -2.0 * side, 0.0), 0.02, lamp);
        mean(&render(&s))
    };
    let (from_lamp, from_camera) = (4.04_f64.sqrt(), 2.35_f64.sqrt());
    for (lamp_inside, inside) in [(true, from_lamp), (false, from_camera)] {
        let clear = across(lamp_inside, 0.0);
        assert!(clear.mean[0] > 1e-3, "{clear:?}");
        let faded = |x: f64| x * (-0.6 * inside).exp();
        let expected = Measured { mean: clear.mean.map(faded), error: clear.error.map(faded) };
        // The lamp is 1 % as large as its distance
        expect_same(across(lamp_inside, 0.6), expected, 0.01);
    }
}

#[test]
fn rough_glass_loses_little_and_makes_nothing() {
    // Radiance in a white room: a rough boundary of single scattering sends on less than 1, and not much less at α = 0.1.
    // White on both sides, where the far side counts 1/η² of its radiance.
    for alpha in [0.1_f32, 0.3] {
        let loss = if alpha < 0.2 { 0.01 } else { 0.06 };
        let seen = |above| reflected(glass(1.5, alpha, Vec3::ZERO, false), 30.0, 4096, above);
        let (r, t) = (seen(true), seen(false));
        let sum = r.mean[0] + t.mean[0] * 2.25;
        let noise = SIGMAS * r.error[0].hypot(2.25 * t.error[0]);
        assert!(sum <= 1.0 + noise && sum >= 1.0 - loss - noise, "α = {alpha}: {sum}");
        assert!(noise < 0.01);
        // Its reflection is near that of smooth glass
        assert!((r.mean[0] / fresnel(30_f64.to_radians().cos(), 1.5) - 1.0).abs() < 0.15, "{r:?}");
    }
}
