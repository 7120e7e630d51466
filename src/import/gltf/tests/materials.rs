//! What materials become.

use super::*;
use crate::scene::{Channel, Emission, Roughness, Sides, Texture, Value};
use glam::Vec3;
use serde_json::Value as Json;

fn constant(x: f32, y: f32, z: f32) -> Value<Vec3> {
    Value::Constant(Vec3::new(x, y, z))
}

fn warnings(material: Json) -> Vec<String> {
    Maker::with_material(material).read().unwrap().1.warnings
}

#[test]
fn the_default_material_is_that_of_the_specification() {
    for maker in [Maker::triangle(), Maker::with_material(json!({}))] {
        let read = maker.read().unwrap();
        let material = only_material(&read);
        let found = principled(material);
        assert_eq!((found.base_color, found.metallic), (constant(1.0, 1.0, 1.0), Value::Constant(1.0)));
        let rough = Value::Constant(1.0);
        assert_eq!(found.roughness, Roughness { u: rough, v: rough, squared: true });
        assert!(material.emission.is_none() && material.detail.opacity.is_whole());
        assert_eq!(material.detail.sides, Sides::Front);
    }
}

#[test]
fn factors_of_the_core_and_of_all_extensions_are_read() {
    let read = Maker::with_material(json!({
        "name": "lacquer",
        "doubleSided": true,
        "pbrMetallicRoughness": { "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6 },
        "emissiveFactor": [1.0, 0.5, 0.0],
        "extensions": {
            "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 },
            "KHR_materials_ior": { "ior": 1.7 },
            "KHR_materials_specular": { "specularFactor": 0.8, "specularColorFactor": [0.9, 1.5, 0.1] },
            "KHR_materials_clearcoat": { "clearcoatFactor": 0.7, "clearcoatRoughnessFactor": 0.2 },
            "KHR_materials_sheen": { "sheenColorFactor": [0.3, 0.2, 0.1], "sheenRoughnessFactor": 0.9 },
            "KHR_materials_transmission": { "transmissionFactor": 0.25 },
        },
    }))
    .read()
    .unwrap();
    let material = only_material(&read);
    let found = principled(material);
    assert_eq!(found.base_color, constant(0.1, 0.2, 0.3));
    assert_eq!((found.metallic, found.roughness.u), (Value::Constant(0.5), Value::Constant(0.6)));
    assert_eq!((found.ior, found.specular), (Value::Constant(1.7), Value::Constant(0.8)));
    assert_eq!(found.specular_color, constant(0.9, 1.5, 0.1));
    assert_eq!((found.clearcoat, found.clearcoat_roughness), (Value::Constant(0.7), Value::Constant(0.2)));
    assert_eq!((found.sheen_color, found.sheen_roughness), (constant(0.3, 0.2, 0.1), Value::Constant(0.9)));
    assert_eq!((found.transmission, found.thin), (Value::Constant(0.25), true));
    assert_eq!(material.emission, Some(Emission { radiance: constant(8.0, 4.0, 0.0), two_sided: true }));
    // Opaque: alpha has no meaning
    assert!(material.detail.opacity.is_whole());
    assert_eq!(read.0.materials.name(read.1.instances[0].material), "lacquer");
}

#[test]
fn a_volume_has_an_inside_that_absorbs() {
    let glass = |volume: Json| {
        let extensions = json!({ "KHR_materials_transmission": { "transmissionFactor": 1.0 }, "KHR_materials_volume": volume });
        let read = Maker::with_material(json!({ "extensions": extensions })).read().unwrap();
        let found = principled(only_material(&read));
        (found.thin, found.absorption)
    };
    assert_eq!(glass(json!({})), (true, Vec3::ZERO), "without a thickness it is a sheet");
    assert_eq!(glass(json!({ "thicknessFactor": 1.0 })), (false, Vec3::ZERO));
    let (thin, absorption) = glass(json!({
        "thicknessFactor": 0.1, "attenuationDistance": 2.0, "attenuationColor": [1.0, 0.5, 0.0],
    }));
    assert!(!thin && absorption.x == 0.0 && absorption.z > 40.0);
    assert!((absorption.y - 0.5 * 2.0_f32.ln()).abs() < 1e-6, "half of the light is left after two units");
}

#[test]
fn dispersion_is_twenty_over_the_abbe_number_of_a_volume() {
    let abbe = |volume: Json, dispersion: f32| {
        let extensions = json!({
            "KHR_materials_transmission": { "transmissionFactor": 1.0 }, "KHR_materials_volume": volume,
            "KHR_materials_dispersion": { "dispersion": dispersion },
        });
        let read = Maker::with_material(json!({ "extensions": extensions })).read().unwrap();
        principled(only_material(&read)).abbe
    };
    let thick = || json!({ "thicknessFactor": 1.0 });
    assert_eq!([abbe(thick(), 0.5), abbe(thick(), 0.0)], [Some(40.0), None]);
    assert_eq!(abbe(json!({}), 0.5), None, "a sheet bends nothing");
    assert_eq!(abbe(thick(), 1e6), Some(1.0));
}

#[test]
fn alpha_modes_become_opacity() {
    let opacity = |mode: Json| {
        let mut material = json!({ "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.25] } });
        material.as_object_mut().unwrap().extend(mode.as_object().unwrap().clone());
        let read = Maker::with_material(material).read().unwrap();
        let opacity = &only_material(&read).detail.opacity;
        (opacity.value, opacity.cutoff)
    };
    assert_eq!(opacity(json!({ "alphaMode": "OPAQUE" })), (Value::Constant(1.0), None));
    assert_eq!(opacity(json!({ "alphaMode": "BLEND" })), (Value::Constant(0.25), None));
    assert_eq!(opacity(json!({ "alphaMode": "MASK" })), (Value::Constant(0.25), Some(0.5)));
    assert_eq!(
        opacity(json!({ "alphaMode": "MASK", "alphaCutoff": 0.1 })),
        (Value::Constant(0.25), Some(0.1))
    );
    let error = Maker::with_material(json!({ "alphaMode": "GLASS" })).error();
    assert_eq!(error, "/materials/0: `alphaMode` is none of OPAQUE, MASK and BLEND");
}

#[test]
fn what_is_not_double_sided_has_a_front_alone_unless_light_goes_through() {
    let sides = |material: Json| {
        let read = Maker::with_material(material).read().unwrap();
        only_material(&read).detail.sides
    };
    let transmission =
        |factor: f32| json!({ "KHR_materials_transmission": { "transmissionFactor": factor } });
    assert_eq!(sides(json!({ "doubleSided": true })), Sides::Both);
    assert_eq!(sides(json!({ "doubleSided": false, "alphaMode": "BLEND" })), Sides::Front);
    assert_eq!(sides(json!({ "extensions": { "KHR_materials_unlit": {} } })), Sides::Front);
    assert_eq!(
        sides(json!({ "doubleSided": true, "extensions": { "KHR_materials_unlit": {} } })),
        Sides::Both
    );
    assert_eq!(sides(json!({ "extensions": transmission(0.0) })), Sides::Front);
    assert_eq!(sides(json!({ "extensions": transmission(0.5) })), Sides::Both);
}

#[test]
fn colours_of_vertices_are_a_factor_on_the_materials_of_those_that_have_them() {
    let mut maker = Maker::with_material(json!({
        "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [0.1, 0.2, 0.3, 0.4] },
    }));
    let colors = maker.floats(&[[1.0, 0.0, 0.0]; 3]);
    let dyed = json!({ "attributes": { "POSITION": 0, "COLOR_0": colors }, "material": 0 });
    let plain = json!({ "attributes": { "POSITION": 0, "COLOR_0": colors } });
    let primitives = maker.root["meshes"][0]["primitives"].as_array_mut().unwrap();
    primitives.extend([dyed.clone(), dyed, plain]);
    let (scene, model) = maker.read().unwrap();
    assert_eq!(scene.materials.len(), 3, "one as it is, and that and the default with colours");
    assert_eq!(model.instances.len(), 2);
    let parts = |i: usize| &scene.meshes[model.instances[i].mesh].parts;
    let material = |i: usize, part: usize| &scene.materials[parts(i)[part].material.unwrap()];
    assert_eq!(principled(material(0, 0)).base_color, constant(0.1, 0.2, 0.3));
    assert_eq!(material(0, 0).detail.opacity.value, Value::Constant(0.4));
    assert_eq!(parts(1)[0].material, parts(1)[1].material);
    let texture = |texture: Option<crate::scene::Handle<Texture>>| scene.textures[texture.unwrap()].clone();
    let product = |found: Texture, channel: Channel, factor: Value<Vec3>| {
        let Texture::Multiply { a, b } = found else { panic!("{found:?}") };
        assert_eq!((a, texture(b.texture())), (factor, Texture::VertexColor(channel)));
    };
    let dyed = material(1, 0);
    product(texture(principled(dyed).base_color.texture()), Channel::Rgb, constant(0.1, 0.2, 0.3));
    product(texture(dyed.detail.opacity.value.texture()), Channel::A, constant(0.4, 0.4, 0.4));
    let white = principled(material(1, 2)).base_color.texture();
    assert_eq!(texture(white), Texture::VertexColor(Channel::Rgb));
}

#[test]
fn unlit_materials_show_their_base_color() {
    let read = Maker::with_material(json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 0.0, 1.0] },
        "extensions": { "KHR_materials_unlit": {} },
    }))
    .read()
    .unwrap();
    assert_eq!(only_material(&read).surface, Surface::Unlit { color: constant(0.5, 0.25, 0.0) });
}

#[test]
fn channels_of_one_picture_are_textures_of_one_image() {
    let mut maker = Maker::with_material(json!({
        "pbrMetallicRoughness": {
            "metallicRoughnessTexture": { "index": 0 }, "metallicFactor": 0.5,
            "baseColorTexture": { "index": 0 }, "baseColorFactor": [1.0, 0.5, 0.25, 1.0],
        },
        "normalTexture": { "index": 0, "scale": 0.75 },
        "occlusionTexture": { "index": 0 },
    }));
    textures::add_picture(&mut maker);
    let (scene, model) = maker.read().unwrap();
    assert_eq!(scene.images.len(), 1);
    let material = &scene.materials[model.instances[0].material];
    let found = principled(material);
    let image = |texture: Option<crate::scene::Handle<Texture>>| match &scene.textures[texture.unwrap()] {
        Texture::Image(image) => image.clone(),
        other => panic!("{other:?}"),
    };
    let (metallic, roughness) = (image(found.metallic.texture()), image(found.roughness.u.texture()));
    assert_eq!((metallic.channel, metallic.scale), (Channel::B, 0.5));
    assert_eq!((roughness.channel, roughness.scale), (Channel::G, 1.0));
    let Texture::Multiply { a, b } = &scene.textures[found.base_color.texture().unwrap()] else {
        panic!("{:?}", found.base_color)
    };
    assert_eq!((image(a.texture()).channel, *b), (Channel::Rgb, constant(1.0, 0.5, 0.25)));
    let map = material.detail.normal_map.unwrap();
    assert_eq!((map.strength, map.green_down), (0.75, false));
}

#[test]
fn variants_choose_materials() {
    let mut maker = Maker::with_material(json!({ "name": "own" }));
    maker.add("materials", json!({ "name": "red" }));
    maker.root.insert(
        "extensions".into(),
        json!({ "KHR_materials_variants": { "variants": [{ "name": "dawn" }, { "name": "dusk" }] } }),
    );
    maker.root["meshes"][0]["primitives"][0]["extensions"] =
        json!({ "KHR_materials_variants": { "mappings": [{ "material": 1, "variants": [1] }] } });
    let shown = |variant: Option<&str>| {
        let choice = ModelChoice { variant: variant.map(str::to_owned), ..ModelChoice::default() };
        let (scene, model) = maker.show(&choice)?;
        Ok::<_, crate::Error>(scene.materials.name(model.instances[0].material).to_owned())
    };
    assert_eq!(shown(None).unwrap(), "own");
    assert_eq!(shown(Some("dawn")).unwrap(), "own");
    assert_eq!(shown(Some("dusk")).unwrap(), "red");
    let error = shown(Some("noon")).unwrap_err();
    assert_eq!(error.message, "the model has no variant \"noon\"");
    assert_eq!(error.help.as_deref(), Some("there are \"dawn\", \"dusk\""));
}

#[test]
fn what_is_not_read_is_named() {
    let found = warnings(json!({ "extensions": { "KHR_materials_iridescence": {} } }));
    assert_eq!(found, ["/materials/0: the material is seen without KHR_materials_iridescence"]);
    let found = warnings(json!({ "pbrMetallicRoughness": { "metallicFactor": 1.5 } }));
    assert_eq!(found, ["/materials/0/pbrMetallicRoughness: `metallicFactor` is 1.5, and is taken as 1"]);
    let mut maker = Maker::triangle();
    maker.root.insert("extensionsUsed".into(), json!(["VENDOR_magic", "KHR_materials_ior"]));
    assert_eq!(maker.read().unwrap().1.warnings, ["the extension VENDOR_magic is left out"]);
    maker.root.insert("extensionsRequired".into(), json!(["KHR_materials_ior", "VENDOR_magic"]));
    let error = maker.read().unwrap_err().to_string();
    let expected = "/extensionsRequired/1: the model requires the extension VENDOR_magic, which dapple does not read; export the \
                    model without it";
    assert!(error.ends_with(expected), "{error}");
}
