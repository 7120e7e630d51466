//! Lights and the environment.

use super::{all, read};
use crate::scene::*;
use glam::{Mat3, Vec3};

#[test]
fn lights_take_every_key() {
    let scene = all();
    let [point, spot, other, distant, from, lamp, slide] = &scene.lights[..] else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!(*point, Light { strength: Strength::Scale(2.0), ..Light::point(Vec3::Y, Vec3::splat(3.0)) });
    let cone = |cone_angle, falloff_angle| {
        Light::new(LightKind::spot(Vec3::Y, cone_angle, falloff_angle), Value::Constant(Vec3::ONE))
    };
    // Downward, −z is up unless the scene says otherwise
    let frame = facing(-Vec3::Y, Vec3::X).unwrap();
    assert_eq!(*spot, Light { strength: Strength::Power(9.0), world_from_light: frame, ..cone(20.0, 3.0) });
    assert_eq!(*other, cone(30.0, 5.0).along(Vec3::X));
    let straight = Light::distant(-Vec3::Y, Vec3::ONE);
    assert_eq!(straight.world_from_light.y_axis, -Vec3::Z);
    assert_eq!(*distant, Light { strength: Strength::Scale(0.5), ..straight.clone() });
    let sun = Light::new(LightKind::distant(0.5), straight.intensity);
    assert_eq!(*from, Light { world_from_light: frame, ..sun });

    let mapping = DirectionMapping::EqualArea;
    assert_eq!(lamp.kind, LightKind::Point { position: Vec3::Y, mapping });
    assert_eq!(lamp.strength, Strength::Power(60.0));
    assert!((lamp.world_from_light * -Vec3::Z).abs_diff_eq(-Vec3::X, 1e-6));
    // Without a word on it the picture goes on at its edges as the sphere does, where it is seen so
    let wrap = |texture: Handle<Texture>| match &scene.textures[texture] {
        Texture::Image(image) => image.wrap,
        other => panic!("{other:?}"),
    };
    assert_eq!(wrap(lamp.intensity.texture().unwrap()), [Wrap::Octahedral; 2]);
    assert_eq!(
        wrap(scene.textures.iter().find(|(_, name, _)| *name == "plain").unwrap().0),
        [Wrap::Repeat; 2]
    );

    let expected =
        LightKind::Projection { position: Vec3::Y, fov: 30.0, fov_axis: FovAxis::Smaller, aspect: 1.5 };
    assert_eq!(slide.kind, expected);
    assert_eq!(slide.strength, Strength::Scale(40.0));
    let areas = &scene.shapes[9..12];
    for area in areas {
        let material = &scene.materials[area.material];
        assert_eq!(material.surface, Surface::diffuse(Value::Constant(Vec3::ZERO)));
        assert_eq!(material.emission.as_ref().unwrap().radiance, Value::Constant(Vec3::splat(9.0)));
        assert!(material.emission.as_ref().unwrap().two_sided);
    }
    assert_eq!(areas[0].name, "light 8");
    let environment = scene.environment.unwrap();
    assert_eq!(environment.scale, 2.0);
    assert_eq!(environment.mapping, mapping);
    assert_eq!(wrap(environment.radiance.texture().unwrap()), [Wrap::Clamp; 2]);
    // Seen from above, counter-clockwise takes −z (ahead) to −x (left).
    assert!((environment.world_from_environment * -Vec3::Z).abs_diff_eq(-Vec3::X, 1e-6));
    let (scene, _) =
        read("[environment]\ncolor = 2\ntransform = [{ rotate = [0, 2, 0], angle = 90 }]").unwrap();
    let same = scene.environment.unwrap();
    assert_eq!(same.radiance, Value::Constant(Vec3::splat(2.0)));
    assert!(
        same.world_from_environment.abs_diff_eq(Mat3::from_rotation_y(std::f32::consts::FRAC_PI_2), 1e-6)
    );
}

#[test]
fn a_projection_is_as_wide_as_its_picture_and_lies_across_its_direction() {
    let light = "[[light]]\nkind = \"projection\"\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n";
    let (scene, _) = read(&format!("{light}intensity = 2")).unwrap();
    let expected = LightKind::Projection {
        position: Vec3::Z * 5.0,
        fov: 40.0,
        fov_axis: FovAxis::Vertical,
        aspect: 1.0,
    };
    assert_eq!(scene.lights[0].kind, expected);
    assert_eq!(scene.lights[0].world_from_light, Mat3::IDENTITY);
    let error = read(&format!("{light}intensity = 2\nup = [0, 0, 1]")).unwrap_err().to_string();
    assert!(error.contains("`up` is parallel to the direction"), "{error}");
}
