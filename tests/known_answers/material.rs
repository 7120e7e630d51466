//! Materials that are mixed, and numbers of materials that come from textures.

use super::floor::*;
use crate::common::render::*;
use dapple::scene::*;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// A grey texture of one texel, so that it is no constant that is folded.
fn paper(s: &mut Scene, value: f32) -> dapple::scene::Handle<Texture> {
    let texels = Texels::RgbaF32(vec![[value, value, value, 1.0]]);
    s.picture(Image { width: 1, height: 1, texels }, |_| {})
}

/// What a floor of a surface shows under a rectangle, with the textures that a closure adds.
fn under_a_quad(make: impl FnOnce(&mut Scene) -> Surface) -> Measured {
    let mut s = floor_scene(white(), 1024);
    let surface = make(&mut s);
    let floor = s.shapes[0].material;
    s.materials[floor].surface = surface;
    let (origin, u, v) = QUADS[0];
    let light = s.emitter(grey(1.0), false);
    s.quad(origin, u, v, light);
    mean(&render(&s))
}

fn expected_under_a_quad(bsdf: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    let (origin, u, v) = QUADS[0];
    under_quad(origin, u, v, |_, _| 1.0, bsdf)
}

#[test]
fn numbers_from_textures_are_those_numbers() {
    let texture = |s: &mut Scene, value| Value::Texture(paper(s, value));
    let expected = expected_under_a_quad(ggx(0.25));
    // A texture of roughness is squared, one of the width is not
    for (squared, value) in [(true, 0.5), (false, 0.25)] {
        let measured = under_a_quad(|s| {
            let both = texture(s, value);
            let roughness = Roughness { u: both, v: both, squared };
            Surface::Conductor(Conductor { reflectance: grey(1.0), fresnel: Fresnel::None, roughness })
        });
        expect_grey(measured, expected, 1e-3);
    }
    // One number from a texture beside one that is constant
    let measured = under_a_quad(|s| {
        let roughness = Roughness { u: texture(s, 0.5), v: Value::Constant(0.5), squared: true };
        Surface::Conductor(Conductor { reflectance: grey(1.0), fresnel: Fresnel::None, roughness })
    });
    expect_grey(measured, expected, 1e-3);
    let measured = under_a_quad(|s| {
        let exponent = texture(s, 30.0);
        Surface::phong(grey(0.3), grey(0.6), exponent)
    });
    expect_grey(measured, expected_under_a_quad(phong(0.3, 0.6, 30.0)), 1e-3);
}

/// What a surface shows in a sky of radiance 1.
fn in_the_sky(make: impl FnOnce(&mut Scene) -> Surface) -> [f64; 3] {
    let mut s = floor_scene(white(), 64);
    let surface = make(&mut s);
    let floor = s.shapes[0].material;
    s.materials[floor].surface = surface;
    s.environment = constant_environment(1.0);
    mean(&render(&s)).mean
}

#[test]
fn paper_scatters_to_both_sides() {
    let paper = |s: &mut Scene| {
        let transmittance = Value::Texture(paper(s, 0.6));
        Surface::diffuse_transmission(grey(0.3), transmittance)
    };
    // In a sky of 1, all that is scattered is seen, and where it would be more than all, all
    assert!((in_the_sky(paper)[0] - 0.9).abs() < 3e-3);
    let whiter = in_the_sky(|_| Surface::diffuse_transmission(grey(0.9), grey(0.9)));
    assert!((whiter[0] - 1.0).abs() < 3e-3, "{whiter:?}");
    // A lamp behind it: T E / π, and before it: R E / π
    for (height, part) in [(-2.0, 0.6), (2.0, 0.3)] {
        let mut s = floor_scene(white(), 16);
        let surface = paper(&mut s);
        let floor = s.shapes[0].material;
        s.materials[floor].surface = surface;
        s.lights.push(point(Vec3::new(1.0, height, 0.0), 40.0));
        let irradiance = 40.0 * 2.0 / 5.0_f64.powf(1.5);
        // The pixels see a small piece of the floor
        expect_grey(mean(&render(&s)), part * irradiance / PI, 1e-3);
    }
}

#[test]
fn an_index_from_textures_is_that_index() {
    // Mirrors and clear glass: what is seen does not depend on chance where one number decides
    let (eta, k) = (0.2_f32, 3.9_f32);
    let metal = |eta, k| {
        let fresnel = Fresnel::Index { eta, k };
        Surface::Conductor(Conductor { reflectance: grey(1.0), fresnel, roughness: Roughness::alpha(0.0) })
    };
    let constant = in_the_sky(|_| metal(grey(eta), grey(k)));
    let textured = in_the_sky(|s| {
        let [eta, k] = [eta, k].map(|value| Value::Texture(paper(s, value)));
        metal(eta, k)
    });
    assert!(constant[0] > 0.8 && constant[0] < 1.0, "{constant:?}");
    assert_eq!(constant, textured);
    // Glass over black: only what is reflected is seen
    let glass = |ior| {
        let (absorption, roughness) = (Vec3::ZERO, Roughness::alpha(0.0));
        Surface::Dielectric(Dielectric { ior, roughness, abbe: None, absorption, thin: false })
    };
    let seen = |make: &dyn Fn(&mut Scene) -> Value<f32>| {
        in_the_sky(|s| {
            let ior = make(s);
            let black = s.black();
            s.quad(Vec3::new(-200.0, -1.0, 200.0), Vec3::X * 400.0, Vec3::NEG_Z * 400.0, black);
            glass(ior)
        })
    };
    let constant = seen(&|_| Value::Constant(1.5));
    assert!(constant[0] > 0.03 && constant[0] < 0.2, "{constant:?}");
    assert_eq!(constant, seen(&|s| Value::Texture(paper(s, 1.5))));
}

#[test]
fn a_mix_is_the_mean_of_its_parts() {
    let mixed = |s: &mut Scene, amount: Value<f32>| {
        let a = s.material(Surface::diffuse(grey(0.2)), None);
        let b = s.material(rough(0.25), None);
        let c = s.material(Surface::diffuse(grey(0.9)), None);
        let inner = s.material(Surface::Mix(Mix { a: b, b: c, amount: Value::Constant(0.3) }), None);
        Surface::Mix(Mix { a, b: inner, amount })
    };
    let lobe = ggx(0.25);
    let expected =
        expected_under_a_quad(|wo, wi| 0.25 * 0.2 / PI + 0.75 * (0.7 * lobe(wo, wi) + 0.3 * 0.9 / PI));
    expect_grey(under_a_quad(|s| mixed(s, Value::Constant(0.75))), expected, 1e-3);
    let textured = under_a_quad(|s| {
        let amount = Value::Texture(paper(s, 0.75));
        mixed(s, amount)
    });
    expect_grey(textured, expected, 1e-3);
}

#[test]
fn a_mix_is_one_of_its_parts_at_its_ends() {
    for (amount, expected) in [(0.0, 0.25), (1.0, 0.75)] {
        let seen = in_the_sky(|s| {
            let [a, b] = [0.25, 0.75].map(|rho| s.diffuse(rho));
            Surface::Mix(Mix { a, b, amount: Value::Constant(amount) })
        });
        assert!((seen[0] - expected).abs() < 3e-3, "{seen:?}");
    }
}

#[test]
fn a_mix_that_glows_lights_the_floor_as_it_is_seen() {
    // A quad that is half lamp, half black: seen and as a light it has half the radiance, by light sampling and by chance
    let text = "
        [material.lamp]
        kind = 'diffuse'
        color = 0
        emission = 2
        [material.dark]
        kind = 'diffuse'
        color = 0
        [material.half]
        kind = 'mix'
        a = 'lamp'
        b = 'dark'
        amount = 0.5
    ";
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), text).unwrap();
    let (read, _) = dapple::import::read_scene(file.path(), &[]).unwrap();
    let (half, _, material) = read.materials.iter().find(|(_, name, _)| *name == "half").unwrap();
    assert_eq!(material.emission.as_ref().unwrap().radiance, grey(1.0));
    let (origin, u, v) = QUADS[0];
    let mut s = floor_scene(white(), 256);
    let floor = s.materials[s.shapes[0].material].clone();
    s.materials = read.materials.clone();
    s.shapes[0].material = s.materials.add("floor", floor);
    s.quad(origin, u, v, half);
    let expected = polygon_irradiance(&quad_corners(origin, u, v)) / PI;
    expect_grey(mean(&render(&s)), expected, 1e-3);
    s.camera = look(Vec3::new(-0.2, 0.5, 0.2), Vec3::new(-0.2, 2.0, 0.21), 5.0);
    expect_every_pixel(&render(&s), [1.0; 3], 0.0);
}

#[test]
fn a_mix_of_itself_is_an_error() {
    let mut s = scene(8, 8, 1);
    let a = s.diffuse(0.5);
    let m = s.material(Surface::Mix(Mix { a, b: a, amount: Value::Constant(0.5) }), None);
    s.materials[m].surface = Surface::Mix(Mix { a, b: m, amount: Value::Constant(0.5) });
    let error = dapple::prepare::prepare(&s).err().unwrap().to_string();
    assert!(error.contains("is a mix of itself"), "{error}");
}
