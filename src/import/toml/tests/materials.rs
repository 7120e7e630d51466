//! Materials, with every key that they have.

use super::*;

#[test]
fn mixes_are_made_of_materials_and_send_out_what_those_do() {
    let scene = all();
    let texture = |name: &str| scene.textures.iter().find(|(_, other, _)| *other == name).unwrap();
    let material = |name: &str| scene.materials.iter().find(|found| found.1 == name).unwrap();
    let Surface::Mix(rusty) = &material("rusty").2.surface else { panic!() };
    assert_eq!((rusty.a, rusty.b), (material("car").0, material("glowing").0));
    let veins = Value::Texture(texture("veins").0);
    assert_eq!(rusty.amount, veins);
    let glow = |x| Value::Constant(Vec3::new(x, 2.0 * x, 3.0 * x));
    assert_eq!(material("glowing").2.emission.as_ref().unwrap().radiance, glow(1.5), "3/4 of that of chalk");
    let (handle, _, mixed) = texture("emission of rusty");
    assert_eq!(*mixed, Texture::Mix { a: Value::Constant(Vec3::ZERO), b: glow(1.5), amount: veins });
    assert_eq!(material("rusty").2.emission.as_ref().unwrap().radiance, Value::Texture(handle));
    assert!(material("car").2.emission.is_none());
}

#[test]
fn materials_take_every_key() {
    let scene = all();
    let texture = |name: &str| scene.textures.iter().find(|(_, other, _)| *other == name).unwrap().0;
    let material = |name: &str| scene.materials.iter().find(|found| found.1 == name).unwrap().2;
    let grey = |value| Value::Constant(Vec3::splat(value));
    assert_eq!(material("screen").surface, Surface::Unlit { color: grey(0.0) });
    let emission = material("screen").emission.as_ref().unwrap();
    assert_eq!(emission.radiance, Value::Texture(texture("emission of screen")));
    assert!(emission.two_sided);
    assert_eq!(material("chalk").surface, Surface::diffuse(Value::Texture(texture("squares"))));
    assert_eq!(
        material("chalk").emission.as_ref().unwrap().radiance,
        Value::Constant(Vec3::new(2.0, 4.0, 6.0))
    );
    let transmittance = Value::Texture(texture("plain"));
    let reflectance = Value::Constant(Vec3::new(0.125, 0.5, 0.0));
    assert_eq!(material("leaf").surface, Surface::diffuse_transmission(reflectance, transmittance));
    let opacity = &material("chalk").detail.opacity;
    assert_eq!((opacity.value, opacity.cutoff), (Value::Texture(texture("plain")), Some(0.75)));
    assert_eq!(opacity.filter, Value::Constant(Vec3::new(1.0, 0.5, 0.25)));
    let detail = &material("chalk").detail;
    let derivative = Derivative::Forward;
    let bump = Bump { texture: texture("squares"), height: 0.5, derivative, curvature: false };
    assert_eq!(detail.bump, Some(bump));
    let (texture_of_map, tangents) = (texture("plain"), Tangents::Uv);
    let map = NormalMap { texture: texture_of_map, green_down: true, strength: 0.25, tangents };
    assert_eq!(detail.normal_map, Some(map));
    assert!(!detail.soften_terminator && !detail.keep_visible);
    assert_eq!(material("paint").detail, Detail::default());
    assert_eq!(material("white").detail, Detail { sides: Sides::Front, ..Detail::default() });
    assert_eq!(
        material("paint").surface,
        Surface::phong(Value::Texture(texture("plain")), grey(0.25), Value::Texture(texture("wood")))
    );
    let Surface::Conductor(steel) = &material("steel").surface else { panic!("steel") };
    assert_eq!(
        (steel.reflectance, steel.fresnel),
        (Value::Constant(Vec3::new(0.75, 0.5, 0.25)), Fresnel::Schlick)
    );
    let same = |x| Roughness { u: Value::Constant(x), v: Value::Constant(x), squared: true };
    assert_eq!(steel.roughness, same(0.5));
    let Surface::Conductor(gold) = &material("gold").surface else { panic!("gold") };
    assert_eq!(gold.fresnel, Fresnel::Index { eta: grey(1.0), k: Value::Texture(texture("veins")) });
    assert_eq!(gold.roughness, Roughness::alphas(Value::Texture(texture("wood")), Value::Constant(0.125)));
    let Surface::Dielectric(glass) = &material("glass").surface else { panic!("glass") };
    assert_eq!(glass.ior, Value::Texture(texture("other")));
    assert_eq!((glass.absorption, glass.thin), (Vec3::new(0.0, 0.5, 1.0), false));
    assert_eq!(glass.abbe, Some(30.0));
    let (u, v) = (Value::Texture(texture("wood")), Value::Constant(0.25));
    assert_eq!(glass.roughness, Roughness { u, v, squared: true });
    let wood = Value::Texture(texture("wood"));
    let roughness = Roughness { u: wood, v: Value::Constant(0.25), squared: true };
    let color = Value::Texture(texture("plain"));
    let interface = Interface { ior: 1.25, roughness };
    assert_eq!(material("glaze").surface, Surface::CoatedDiffuse(CoatedDiffuse { color, interface }));
    let conductor =
        Conductor { reflectance: steel.reflectance, fresnel: Fresnel::None, roughness: same(0.5) };
    let interface = Interface { ior: 1.75, roughness: Roughness::alphas(Value::Constant(0.25), wood) };
    let coated =
        |conductor, interface| Surface::CoatedConductor(Box::new(CoatedConductor { conductor, interface }));
    assert_eq!(material("lacquer").surface, coated(conductor, interface));
    let fresnel = Fresnel::Index { eta: grey(2.0), k: grey(4.0) };
    let conductor = Conductor { reflectance: grey(1.0), fresnel, roughness: Roughness::alpha(0.5) };
    assert_eq!(material("tin").surface, coated(conductor, Interface { ior: 1.5, roughness: same(0.25) }));
    let Surface::Dielectric(pane) = &material("pane").surface else { panic!("pane") };
    let Surface::Principled(car) = &material("car").surface else { panic!("car") };
    let number = Value::Constant;
    let expected = Principled {
        base_color: Value::Texture(texture("plain")),
        metallic: Value::Texture(texture("wood")),
        roughness: same(0.25),
        ior: number(1.75),
        specular: number(0.75),
        specular_color: Value::Constant(Vec3::new(1.0, 0.5, 0.25)),
        transmission: number(0.5),
        abbe: Some(40.0),
        absorption: Vec3::splat(2.0),
        thin: false,
        clearcoat: number(1.0),
        clearcoat_roughness: Value::Texture(texture("wood")),
        sheen_color: Value::Constant(Vec3::new(0.5, 0.0, 0.0)),
        sheen_roughness: number(0.75),
    };
    assert_eq!(**car, expected);
    let (plain, _) = read("[material.p]\nkind = 'principled'").unwrap();
    let Some((_, _, plain)) = plain.materials.iter().next() else { panic!() };
    assert_eq!(plain.surface, Surface::Principled(Box::default()));
    assert!(pane.thin && pane.ior == Value::Constant(1.5) && pane.roughness.is_smooth());
}
