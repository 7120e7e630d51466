//! The planes beside the colour: what denoisers are given.

use crate::common::render::*;
use dapple::film::Picture;
use dapple::scene::*;
use glam::Vec3;

/// A wall at z = −2 with a material, facing the camera or turned away from it.
fn wall(material: Material, turned: bool) -> Picture {
    let mut s = scene(4, 4, 4);
    s.camera.projection = Projection::pinhole(40.0);
    let material = s.materials.add("wall", material);
    let (u, v) = if turned { (Vec3::Y, Vec3::X) } else { (Vec3::X, Vec3::Y) };
    s.quad(Vec3::new(-5.0, -5.0, -2.0), u * 10.0, v * 10.0, material);
    render(&s)
}

/// Demands an albedo of every pixel. Sums are whole numbers of 2⁻²⁰.
#[track_caller]
fn expect_albedo(picture: &Picture, expected: [f32; 3]) {
    for albedo in &picture.albedo {
        let off = (0..3).map(|c| (albedo[c] - expected[c]).abs()).fold(0.0, f32::max);
        assert!(off < 2e-6, "{albedo:?}, expected {expected:?}");
    }
}

const BRIGHT: Vec3 = Vec3::new(3.0, 0.5, 0.0);

fn shining(color: f32, two_sided: bool) -> Material {
    let emission = Some(Emission { radiance: Value::Constant(BRIGHT), two_sided });
    Material::new(Surface::diffuse(grey(color)), emission)
}

#[test]
fn albedo_is_a_reflectance_or_light_up_to_1() {
    let plain = |surface| Material::new(surface, None);
    expect_albedo(&wall(plain(Surface::diffuse(grey(0.25))), false), [0.25; 3]);
    let phong = Surface::phong(grey(0.9), grey(0.6), Value::Constant(10.0));
    expect_albedo(&wall(plain(phong), false), [1.0; 3]);
    expect_albedo(&wall(plain(Surface::Unlit { color: Value::Constant(BRIGHT) }), false), [1.0, 0.5, 0.0]);
    // A lamp shows its light, on top of what it reflects; its dark back shows only that
    expect_albedo(&wall(shining(0.0, false), false), [1.0, 0.5, 0.0]);
    expect_albedo(&wall(shining(0.25, false), false), [1.0, 0.75, 0.25]);
    expect_albedo(&wall(shining(0.25, false), true), [0.25; 3]);
    expect_albedo(&wall(shining(0.25, true), true), [1.0, 0.75, 0.25]);
}

#[test]
fn normals_look_at_the_camera_from_both_sides() {
    for turned in [false, true] {
        let picture = wall(shining(0.5, false), turned);
        assert!(picture.normal.iter().all(|n| *n == [0.0, 0.0, 1.0]), "{turned}: {:?}", picture.normal);
    }
}

#[test]
fn depth_is_the_distance_to_the_camera() {
    let mut s = scene(5, 1, 4);
    s.render.sampler = Sampler::Center;
    let m = s.diffuse(0.5);
    s.quad(Vec3::new(-50.0, -50.0, -2.0), Vec3::X * 100.0, Vec3::Y * 100.0, m);
    let picture = render(&s);
    for x in 0..5 {
        let (_, direction) = center_ray(&s, x, 0);
        let (depth, expected) = (f64::from(picture.depth[x as usize]), 2.0 / -direction.z);
        // Steps of 2⁻²⁴ of the size of the scene
        assert!((depth - expected).abs() < 1e-4, "{x}: {depth}, expected {expected}");
    }
    assert!(picture.depth[0] > 2.0 * picture.depth[2], "seen from the side it is farther away");
}
