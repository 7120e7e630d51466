//! Paths: how they go on, and when they end.

use crate::common::render::*;
use crate::common::twins::fresnel::fresnel_dielectric;
use dapple::scene::*;
use glam::{Affine3A, Vec3};
use std::f64::consts::FRAC_1_SQRT_2;

#[test]
fn max_depth_counts_scattering_events() {
    // A closed box of emission 1 and reflectance ½: 1, 1.5, 1.75 for 0, 1, 2 events
    for (depth, expected) in [(0, 1.0), (1, 1.5), (2, 1.75), (3, 1.875)] {
        let mut s = scene(8, 8, 256);
        s.render.max_depth = depth;
        let m =
            s.material(Surface::diffuse(grey(0.5)), Some(Emission { radiance: grey(1.0), two_sided: false }));
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
        let m =
            s.material(Surface::diffuse(grey(0.5)), Some(Emission { radiance: grey(1.0), two_sided: true }));
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
fn the_last_diffuse_event_still_mirrors_in_a_smooth_coat() {
    // Varnish over black, seen at 45°, sends what Fresnel says to the sky behind
    let mut s = scene(4, 4, 4096);
    s.render.diffuse_bounces = Some(0);
    let interface = Interface { ior: 1.5, roughness: Roughness::alpha(0.0) };
    let varnish = s.material(Surface::CoatedDiffuse(CoatedDiffuse { color: grey(0.0), interface }), None);
    s.quad(Vec3::new(4.0, 1.0, -1.0), Vec3::new(2.0, -2.0, 0.0), Vec3::Z * 2.0, varnish);
    s.camera = look(Vec3::ZERO, Vec3::X, 0.02);
    s.environment = Some(Environment::new(grey(1.0)));
    expect_every_pixel(&render(&s), [fresnel_dielectric(FRAC_1_SQRT_2, 1.5); 3], 1e-3);
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
    s.camera.projection = Projection::pinhole(20.0);
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
        s.lights.push(Light::distant(direction, Vec3::ONE));
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
