//! Paths: how they go on, through what, and when they end.

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
    s.camera.fov = 0.1;
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
    s.camera.fov = 0.1;
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

#[test]
fn max_depth_counts_scattering_events() {
    // A closed box of emission 1 and reflectance ½: 1, 1.5, 1.75 for 0, 1, 2 events
    for (depth, expected) in [(0, 1.0), (1, 1.5), (2, 1.75), (3, 1.875)] {
        let mut s = scene(8, 8, 256);
        s.render.max_depth = depth;
        let m = s.material(
            Surface::Diffuse { color: grey(0.5) },
            Some(Emission { radiance: grey(1.0), two_sided: false }),
        );
        let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        let p = render(&s);
        if depth == 0 {
            expect_every_pixel(&p, [1.0; 3], 0.0);
        } else {
            expect_grey(mean(&p), expected, 0.0);
        }
    }
    // Point light on a floor: nothing at 0, direct light at 1
    for depth in [0, 1] {
        let mut s = scene(4, 4, 4);
        s.render.max_depth = depth;
        s.camera = look(Vec3::new(0.0, 2.0, 1.0), Vec3::ZERO, 0.02);
        let m = s.diffuse(1.0);
        s.floor(m);
        s.lights.push(point(Vec3::Y * 2.0, 4.0));
        let expected = f64::from(depth) * 4.0 / 4.0 / std::f64::consts::PI;
        expect_every_pixel(&render(&s), [expected; 3], 1e-5);
    }
}

#[test]
fn diffuse_bounces_count_what_is_not_mirror_or_glass() {
    // No bounce: direct light only, behind a mirror too. Inside a diffuse ball: 1 + ½ (direct), and so on
    for (bounces, expected) in [(0, 1.5), (1, 1.75), (2, 1.875)] {
        let mut s = scene(8, 8, 1024);
        (s.render.max_depth, s.render.diffuse_bounces) = (50, Some(bounces));
        let m = s.material(
            Surface::Diffuse { color: grey(0.5) },
            Some(Emission { radiance: grey(1.0), two_sided: true }),
        );
        s.sphere(Vec3::new(0.2, 0.1, 0.3), 2.0, m);
        expect_grey(mean(&render(&s)), expected, 0.0);
    }
    // Whitted's ray tracer: a mirror, then a lit floor
    let mut s = scene(4, 4, 4);
    s.render.diffuse_bounces = Some(0);
    let mirror = s.conductor(0.5, 0.0, Fresnel::None);
    let white = s.diffuse(1.0);
    // Down the +x axis into a mirror at 45° that sends the ray down to the floor
    s.quad(Vec3::new(4.0, 1.0, -1.0), Vec3::new(2.0, -2.0, 0.0), Vec3::Z * 2.0, mirror);
    s.quad(Vec3::new(-50.0, -3.0, 50.0), Vec3::X * 100.0, Vec3::NEG_Z * 100.0, white);
    s.camera = look(Vec3::ZERO, Vec3::X, 0.02);
    s.lights.push(point(Vec3::new(5.0, -1.0, 2.0), 4.0));
    let cos = 2.0 / 8_f64.sqrt();
    let lit = 4.0 / 8.0 * cos / std::f64::consts::PI;
    let p = render(&s);
    let seen = mean(&p).mean[0];
    assert!((seen - 0.5 * lit).abs() < 1e-4, "{seen}, expected {}", 0.5 * lit);
}

#[test]
fn russian_roulette_keeps_the_mean() {
    let with = |roulette, rho: f32| {
        let mut s = scene(8, 8, 2048);
        (s.render.max_depth, s.render.russian_roulette) = (30, roulette);
        let m = s.diffuse(rho);
        let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        let light = s.emitter(grey(5.0), false);
        s.sphere(Vec3::new(0.3, 0.4, -0.2), 0.2, light);
        let glass = s.glass(1.5, 0.0, Vec3::splat(0.5), false);
        s.sphere(Vec3::new(-0.4, -0.3, -0.5), 0.3, glass);
        mean(&render(&s))
    };
    for rho in [0.3, 0.8] {
        expect_same(with(true, rho), with(false, rho), 0.0);
    }
}

#[test]
fn every_sampler_has_the_same_mean() {
    let with = |sampler| {
        let mut s = scene(8, 8, 1024);
        (s.render.sampler, s.render.strata) = (sampler, [8, 4]);
        let m = s.diffuse(0.7);
        let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        let light = s.emitter(grey(5.0), false);
        s.quad(Vec3::new(-0.3, 0.95, -0.3), Vec3::X * 0.6, Vec3::Z * 0.6, light);
        let metal = s.conductor(0.8, 0.3, Fresnel::Schlick);
        s.sphere(Vec3::new(-0.4, -0.3, -0.5), 0.3, metal);
        mean(&render(&s))
    };
    let random = with(Sampler::Random);
    for sampler in [Sampler::Stratified, Sampler::Sobol, Sampler::Center, Sampler::Regular] {
        // Center and regular look at other points of the pixels: the picture is smooth, but has edges
        let bias = if matches!(sampler, Sampler::Center | Sampler::Regular) { 0.02 } else { 0.0 };
        expect_same(with(sampler), random, bias);
    }
}

#[test]
fn firefly_clamp_bounds_what_is_indirect() {
    let with = |clamp, spp| {
        let mut s = scene(8, 8, spp);
        (s.render.firefly_clamp, s.render.max_depth) = (clamp, 3);
        s.camera = look(Vec3::new(0.0, 0.5, 0.9), Vec3::new(0.0, -1.0, 0.0), 20.0);
        let m = s.diffuse(0.8);
        let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        // Near the ceiling: indirect samples that meet the ceiling are bright
        s.lights.push(point(Vec3::new(0.0, 0.98, 0.0), 1.0));
        render(&s)
    };
    let (free, bounded) = (with(None, 1), with(Some(0.01), 1));
    // One sample a pixel: two indirect events, each at most 0.01, on top of the same direct light
    let direct = {
        let mut s = scene(8, 8, 1);
        s.render.max_depth = 1;
        s.camera = look(Vec3::new(0.0, 0.5, 0.9), Vec3::new(0.0, -1.0, 0.0), 20.0);
        let m = s.diffuse(0.8);
        let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        s.lights.push(point(Vec3::new(0.0, 0.98, 0.0), 1.0));
        render(&s)
    };
    let over = |p: &dapple::film::Picture, i: usize| p.rgb[i][0] - direct.rgb[i][0];
    assert!((0..64).any(|i| over(&free, i) > 0.05), "nothing to clamp");
    for i in 0..64 {
        let o = over(&bounded, i);
        assert!((-1e-6..=0.02 + 1e-6).contains(&o), "pixel {i}: {o}");
    }
}

#[test]
fn unlit_is_seen_exactly() {
    let color = Vec3::new(0.25, 2.5, 0.7);
    let mut s = scene(8, 8, 16);
    s.environment = constant_environment(3.0);
    s.lights.push(point(Vec3::splat(0.9), 10.0));
    let m = s.unlit(Value::Constant(color));
    let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-1.0), Vec3::splat(1.0), true));
    s.place(mesh, m, Affine3A::IDENTITY);
    expect_every_pixel(&render(&s), [0.25, 2.5, f64::from(0.7_f32)], 3e-6);
    // Behind a mirror, times its reflectance
    let mirror = s.conductor(0.5, 0.0, Fresnel::None);
    s.quad(Vec3::new(-0.9, -0.9, -0.5), Vec3::X * 1.8, Vec3::Y * 1.8, mirror);
    s.camera.fov = 20.0;
    expect_every_pixel(&render(&s), [0.125, 1.25, 0.35], 6e-6);
}

#[test]
fn the_geometric_normal_vetoes_only_when_asked() {
    // A floor whose shading normals lean over to +x: light from below the horizon on that side reaches it by them
    let with = |veto, direction: Vec3| {
        let mut s = scene(4, 4, 4);
        (s.render.geometric_veto, s.render.max_depth) = (veto, 1);
        s.camera = look(Vec3::new(0.5, 2.0, 0.0), Vec3::ZERO, 0.02);
        let mut mesh = rectangle_mesh(Vec3::new(-1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::NEG_Z * 2.0);
        mesh.normals = vec![Vec3::new(1.0, 1.0, 0.0).normalize(); 4];
        let m = s.diffuse(1.0);
        let mesh = s.meshes.add("leaning", mesh);
        s.place(mesh, m, Affine3A::IDENTITY);
        s.lights.push(Light::Distant { direction, irradiance: Vec3::ONE });
        f64::from(render(&s).rgb[0][0])
    };
    // From above at +x: both see it, by the cosine with the shading normal
    let above = -Vec3::new(1.0, 1.0, 0.0).normalize();
    for veto in [false, true] {
        assert!((with(veto, above) - 1.0 / std::f64::consts::PI).abs() < 1e-6);
    }
    // From above at −x, behind the shading normal: nobody
    let behind = -Vec3::new(-1.0, 0.3, 0.0).normalize();
    for veto in [false, true] {
        assert_eq!(with(veto, behind), 0.0);
    }
    // From below at +x, before the shading normal: only without the veto, and nothing is in the way below
    let below = -Vec3::new(1.0, -0.3, 0.0).normalize();
    let cos = (1.0 - 0.3) / 2_f64.sqrt() / 1.09_f64.sqrt();
    assert!((with(false, below) - cos / std::f64::consts::PI).abs() < 1e-6);
    assert_eq!(with(true, below), 0.0);
}
