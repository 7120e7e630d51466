//! Very large and very small things look like any other, or are refused.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Quat, Vec3};

/// A ball, a stretched ball and a disk before the sky, with a lamp of each kind among them.
fn round_things(size: f32) -> Scene {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z) * size;
    let mut s = scene(24, 24, 4);
    s.camera = look(at(0.2, 0.3, 4.0), Vec3::ZERO, 50.0);
    s.render.max_depth = 3;
    s.environment = constant_environment(0.5);
    let (white, lamp) = (s.diffuse(0.8), s.emitter(grey(2.0), true));
    let brushed = Surface::Conductor(Conductor {
        reflectance: grey(0.8),
        fresnel: Fresnel::None,
        roughness: Roughness::alphas(Value::Constant(0.1), Value::Constant(0.5)),
    });
    let brushed = s.material(brushed, None);
    s.sphere(at(0.0, 0.0, 0.0), size, white);
    s.disk(at(1.2, 0.0, 0.5), Vec3::new(-1.0, 0.3, 1.0), 0.7 * size, brushed);
    s.sphere(Vec3::ZERO, 0.5 * size, brushed).world_from_object = Affine3A::from_scale_rotation_translation(
        Vec3::new(1.0, -0.5, 0.7),
        Quat::from_rotation_z(0.4),
        at(-1.2, 0.4, 1.0),
    );
    s.sphere(at(0.5, 1.5, 0.0), 0.2 * size, lamp);
    s.sphere(Vec3::ZERO, 0.3 * size, lamp).world_from_object = Affine3A::from_scale_rotation_translation(
        Vec3::new(1.0, 0.5, 2.0),
        Quat::IDENTITY,
        at(-1.0, -1.0, 1.0),
    );
    s.disk(at(0.6, -1.2, 1.0), Vec3::new(-0.5, 1.0, 0.3), 0.3 * size, lamp);
    s
}

#[test]
fn spheres_and_disks_of_all_sizes_look_the_same() {
    let expected = render(&round_things(1.0));
    assert!(expected.alpha.iter().filter(|alpha| **alpha == 1.0).count() > 150);
    // Powers of two scale all numbers exactly: 10⁻¹⁷, 10⁻¹⁴, 10⁻⁴, 10⁵, 10¹³ and 10¹⁷
    for exponent in exact_scales(&[-57, -47, -13, 17, 44, 57], 50) {
        let picture = render(&round_things((exponent as f32).exp2()));
        assert!(picture.rgb == expected.rgb, "rgb at 2^{exponent}");
        assert!(picture.normal == expected.normal, "normals at 2^{exponent}");
        assert!(picture.alpha == expected.alpha, "alpha at 2^{exponent}");
    }
    // A texture on a lamp is where it was, too: its place comes from the inverse map
    let textured = |size: f32| {
        let mut s = round_things(size);
        let image =
            Image { width: 2, height: 1, texels: Texels::RgbaF32(vec![[1.0; 4], [4.0, 2.0, 1.0, 1.0]]) };
        let texture = s.picture(image, |_| {});
        let lamp = s.emitter(Value::Texture(texture), true);
        s.sphere(Vec3::new(1.0, 1.0, 1.0) * size, 0.3 * size, lamp);
        render(&s)
    };
    let expected = textured(1.0);
    for exponent in [-50, 50] {
        assert!(textured((exponent as f32).exp2()).rgb == expected.rgb, "textured lamp at 2^{exponent}");
    }
}

#[test]
fn sizes_beyond_floats_are_refused_by_name() {
    let refused = |build: &dyn Fn(&mut Scene, Handle<Material>)| {
        let mut s = scene(1, 1, 1);
        let m = s.diffuse(0.5);
        build(&mut s, m);
        dapple::prepare::prepare(&s).err().map(|error| error.to_string())
    };
    let small = "has a size of 1.0e-20, too small for 32-bit floats; scale the scene up, or leave it out";
    let large = "has a size of 1.0e19, too large for 32-bit floats; scale the scene down";
    let sphere = |radius| refused(&|s, m| _ = s.sphere(Vec3::ZERO, radius, m));
    assert_eq!(sphere(1e-20), Some(format!("shape 0 {small}")));
    assert_eq!(sphere(1e19), Some(format!("shape 0 {large}")));
    assert_eq!((sphere(1e-18), sphere(4e18)), (None, None));
    let disk = refused(&|s, m| {
        s.sphere(Vec3::ZERO, 1.0, m);
        s.disk(Vec3::ZERO, Vec3::Y, 1e-20, m);
    });
    assert_eq!(disk, Some(format!("shape 1 {small}")));
    let flat = refused(&|s, m| {
        s.sphere(Vec3::ZERO, 1.0, m).world_from_object = Affine3A::from_scale(Vec3::new(1.0, 1e-20, 1.0));
    });
    assert_eq!(flat, Some(format!("shape 0 {small}")));
    let copies = refused(&|s, m| {
        let mesh = s.meshes.add("box", box_mesh(Vec3::ZERO, Vec3::ONE, false));
        s.place(mesh, m, Affine3A::IDENTITY);
        s.place(mesh, m, Affine3A::from_scale(Vec3::splat(1e-20)));
    });
    assert_eq!(copies, Some(format!("instance 1 {small}")));
}
