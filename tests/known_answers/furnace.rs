//! Rooms and skies of one radiance, in which what is seen is the reflectance.

use super::floor::*;
use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

/// Light that is seen after at most `depth` events in a closed room of emission 1 and reflectance rho.
fn furnace(rho: f64, depth: u32) -> f64 {
    (1.0 - rho.powi(depth as i32 + 1)) / (1.0 - rho)
}

fn glowing(surface: Surface) -> Material {
    Material::new(surface, Some(Emission { radiance: grey(1.0), two_sided: true }))
}

#[test]
fn furnace_of_a_diffuse_box() {
    for (rho, depth, roulette) in [(0.5, 3, false), (0.5, 40, true), (0.8, 60, true)] {
        let mut s = scene(8, 8, 256);
        (s.render.max_depth, s.render.russian_roulette) = (depth, roulette);
        let m = s.materials.add("glow", glowing(Surface::diffuse(grey(rho))));
        let mesh = s.meshes.add("box", box_mesh(Vec3::new(-1.0, -0.7, -2.0), Vec3::new(1.5, 0.9, 1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        expect_grey(mean(&render(&s)), furnace(f64::from(rho), depth), 0.0);
    }
}

#[test]
fn furnace_of_a_diffuse_sphere_seen_from_inside() {
    let mut s = scene(8, 8, 256);
    s.render.max_depth = 30;
    let m = s.materials.add("glow", glowing(Surface::diffuse(grey(0.5))));
    s.sphere(Vec3::new(0.2, 0.1, 0.3), 2.0, m);
    expect_grey(mean(&render(&s)), furnace(0.5, 30), 0.0);
}

#[test]
fn furnace_of_a_mirror_box_is_exact() {
    let mut s = scene(16, 16, 4);
    (s.render.max_depth, s.render.russian_roulette) = (7, false);
    let m = s.materials.add("glow", glowing(conductor(0.5, 0.0, Fresnel::None)));
    let mesh = s.meshes.add("box", box_mesh(Vec3::new(-1.0, -0.7, -2.0), Vec3::new(1.5, 0.9, 1.0), true));
    s.place(mesh, m, Affine3A::IDENTITY);
    // Sums of halves: floats hold them exactly
    expect_every_pixel(&render(&s), [furnace(0.5, 7); 3], 1e-6);
}

#[test]
fn constant_environment_shows_the_albedo_of_a_sphere_and_itself() {
    let mut s = scene(16, 16, 256);
    s.environment = constant_environment(1.0);
    let m = s.diffuse(0.6);
    s.sphere(Vec3::new(0.0, 0.0, -4.0), 2.0, m);
    let p = render(&s);
    let (sky, ball): (Vec<usize>, Vec<usize>) =
        (0..256).filter(|&i| p.alpha[i] == 0.0 || p.alpha[i] == 1.0).partition(|&i| p.alpha[i] == 0.0);
    assert!(sky.len() > 50 && ball.len() > 30, "{} {}", sky.len(), ball.len());
    assert!(sky.iter().all(|&i| p.rgb[i] == [1.0; 3] && p.depth[i] == f32::INFINITY));
    expect_grey(mean_of(&p, ball), 0.6, 0.0);
}

#[test]
fn phong_and_rough_metal_lose_what_their_lobes_lose() {
    let wo = EYE.as_dvec3().normalize();
    let cases: [(Surface, f64); 5] = [
        (shiny(0.5, 0.5, 0.0), albedo(wo, phong(0.5, 0.5, 0.0))),
        (shiny(0.3, 0.7, 20.0), albedo(wo, phong(0.3, 0.7, 20.0))),
        // Above 1 both are scaled down together
        (shiny(0.9, 0.9, 5.0), albedo(wo, phong(0.5, 0.5, 5.0))),
        (rough(0.2), albedo(wo, ggx(0.2))),
        (rough(0.8), albedo(wo, ggx(0.8))),
    ];
    for (surface, expected) in cases {
        assert!(expected > 0.5 && expected < 1.0, "{expected}");
        let mut s = floor_scene(surface, 1024);
        s.environment = constant_environment(1.0);
        // The quadrature is good to 1e-4
        expect_grey(mean(&render(&s)), expected, 1e-4);
    }
}
