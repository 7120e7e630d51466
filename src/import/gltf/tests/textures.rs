//! Pictures, samplers and where pictures are on surfaces.

use super::*;
use crate::scene::{ImageTexture, MappingKind, TexelFilter, Texels, Texture, Value, Wrap};
use base64::Engine;
use glam::Vec2;
use image::{ColorType, ImageEncoder};

/// A PNG of one pixel of a colour.
fn png(color: [u8; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.write_image(&color, 1, 1, ColorType::Rgba8.into()).unwrap();
    bytes
}

/// Texture 0 with a picture in a view of the buffer.
pub(super) fn add_picture(maker: &mut Maker) {
    let view = maker.view(&png([10, 20, 30, 255]));
    let image = maker.add("images", json!({ "bufferView": view, "mimeType": "image/png" }));
    maker.add("textures", json!({ "source": image }));
}

/// A triangle with a texture of base colour.
fn textured(info: serde_json::Value) -> Maker {
    let mut maker = Maker::with_material(json!({ "pbrMetallicRoughness": { "baseColorTexture": info } }));
    add_picture(&mut maker);
    maker
}

fn texture(maker: &Maker) -> ImageTexture {
    let read = maker.read().unwrap();
    let Value::Texture(handle) = principled(only_material(&read)).base_color else { panic!("no texture") };
    match &read.0.textures[handle] {
        Texture::Image(image) => image.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn transforms_of_textures_hold_when_v_runs_upwards() {
    // The specification of KHR_texture_transform: offset, rotation, scale of coordinates whose v runs downwards
    let cases = [
        ([0.0, 0.0], 0.0, [1.0, 1.0]),
        ([0.25, 0.5], 0.0, [1.0, 1.0]),
        ([0.0, 0.0], 0.0, [2.0, 3.0]),
        ([0.0, 0.0], 0.4, [1.0, 1.0]),
        ([0.5, -0.2], -1.3, [1.5, -0.5]),
    ];
    for (offset, rotation, scale) in cases {
        let transform = json!({ "offset": offset, "rotation": rotation, "scale": scale });
        let maker = textured(json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } }));
        let matrix = texture(&maker).uv.matrix();
        for point in [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::new(0.3, 0.8)] {
            let (sin, cos) = (rotation as f32).sin_cos();
            let scaled = Vec2::from(scale) * point;
            let turned = Vec2::new(cos * scaled.x + sin * scaled.y, -sin * scaled.x + cos * scaled.y);
            let expected = turned + Vec2::from(offset);
            let found = matrix.transform_point2(Vec2::new(point.x, 1.0 - point.y));
            let found = Vec2::new(found.x, 1.0 - found.y);
            assert!(
                found.distance(expected) < 1e-5,
                "{offset:?} {rotation} {scale:?}: {found}, expected {expected}"
            );
        }
    }
}

#[test]
fn textures_are_placed_by_either_set_of_coordinates() {
    let found = |info: serde_json::Value| {
        let mut maker = Maker::with_material(json!({ "normalTexture": info }));
        add_picture(&mut maker);
        let (scene, model) = maker.read().unwrap();
        let map = scene.materials[model.instances[0].material].detail.normal_map.unwrap();
        (scene.textures[map.texture].clone(), model.warnings)
    };
    let second = |texture: Texture| match texture {
        Texture::Mapped { mapping, .. } => mapping.kind == MappingKind::Uv1,
        Texture::Image(_) => false,
        other => panic!("{other:?}"),
    };
    let moved = |set: u32| json!({ "KHR_texture_transform": { "texCoord": set } });
    for (info, expected) in [
        (json!({ "index": 0, "texCoord": 0 }), false),
        (json!({ "index": 0, "texCoord": 1 }), true),
        (json!({ "index": 0, "texCoord": 0, "extensions": moved(1) }), true),
        (json!({ "index": 0, "texCoord": 1, "extensions": moved(0) }), false),
    ] {
        let (texture, warnings) = found(info);
        assert_eq!((second(texture), warnings.len()), (expected, 0));
    }
    let (texture, warnings) = found(json!({ "index": 0, "texCoord": 2 }));
    let expected =
        "/materials/0/normalTexture: the texture uses set 2 of texture coordinates, and is shown by set 0";
    assert!(!second(texture));
    assert_eq!(warnings, [expected]);
}

#[test]
fn samplers_say_how_to_wrap_and_filter() {
    let with = |sampler: serde_json::Value| {
        let mut maker = textured(json!({ "index": 0 }));
        maker.add("samplers", sampler);
        maker.root["textures"][0]["sampler"] = json!(0);
        let texture = texture(&maker);
        (texture.wrap, texture.filter)
    };
    let repeat = [Wrap::Repeat; 2];
    assert_eq!(with(json!({})), (repeat, TexelFilter::Trilinear));
    assert_eq!(with(json!({ "magFilter": 9728, "minFilter": 9987 })), (repeat, TexelFilter::Nearest));
    assert_eq!(with(json!({ "magFilter": 9729, "minFilter": 9729 })), (repeat, TexelFilter::Bilinear));
    assert_eq!(with(json!({ "minFilter": 9987 })), (repeat, TexelFilter::Trilinear));
    let (wrap, _) = with(json!({ "wrapS": 33071, "wrapT": 33648 }));
    assert_eq!(wrap, [Wrap::Clamp, Wrap::Mirror]);
    let mut maker = textured(json!({ "index": 0 }));
    maker.add("samplers", json!({ "wrapS": 1 }));
    maker.root["textures"][0]["sampler"] = json!(0);
    assert_eq!(maker.error(), "/samplers/0/wrapS: 1 is no way to wrap a texture");
}

#[test]
fn pictures_come_from_views_data_uris_and_files_in_the_folder() {
    let pixel = |(scene, _): &(Scene, Model)| match &scene.images.iter().next().unwrap().2.texels {
        Texels::Rgba8(texels) => texels[0],
        other => panic!("{other:?}"),
    };
    let mut maker = textured(json!({ "index": 0 }));
    assert_eq!(pixel(&maker.read().unwrap()), [10, 20, 30, 255]);
    let text = base64::engine::general_purpose::STANDARD.encode(png([1, 2, 3, 255]));
    maker.root["images"][0] = json!({ "uri": format!("data:image/png;base64,{text}") });
    assert_eq!(pixel(&maker.read().unwrap()), [1, 2, 3, 255]);

    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("a b")).unwrap();
    std::fs::create_dir(folder.path().join("model")).unwrap();
    std::fs::write(folder.path().join("a b/red.png"), png([9, 0, 0, 255])).unwrap();
    std::fs::write(folder.path().join("model/red.png"), png([8, 0, 0, 255])).unwrap();
    let at = |uri: &str, file: &str| {
        let mut maker = maker.clone();
        maker.root["images"][0] = json!({ "uri": uri });
        std::fs::write(folder.path().join(file), maker.glb()).unwrap();
        let mut scene = Scene::default();
        let model = read_model(&folder.path().join(file), &ModelChoice::default(), &mut scene)?;
        Ok::<_, crate::Error>(pixel(&(scene, model)))
    };
    assert_eq!(at("a%20b/red.png", "m.glb").unwrap(), [9, 0, 0, 255]);
    assert_eq!(at("./a b/red.png", "m.glb").unwrap(), [9, 0, 0, 255]);
    let absolute = folder.path().join("model/red.png").display().to_string();
    for uri in [
        "../a b/red.png",
        "..%2Fa%20b/red.png",
        "x/../../a b/red.png",
        &absolute,
        "file:///etc/passwd",
        "http://x/y.png",
        "",
    ] {
        let error = at(uri, "model/m.glb").unwrap_err().message;
        assert!(error.starts_with("/images/0/uri: ") && error.contains("read"), "{uri}: {error}");
        assert!(!error.contains("cannot be read"), "{uri} was looked for: {error}");
    }
    let error = at("none.png", "m.glb").unwrap_err().message;
    assert!(error.starts_with("/images/0/uri: none.png: the file cannot be read"), "{error}");
}

#[test]
fn webp_is_read_and_ktx2_is_refused_by_name() {
    let mut maker = textured(json!({ "index": 0 }));
    let mut bytes = Vec::new();
    let encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut bytes);
    encoder.write_image(&[50, 60, 70, 255], 1, 1, ColorType::Rgba8.into()).unwrap();
    let view = maker.view(&bytes);
    maker.add("images", json!({ "bufferView": view, "mimeType": "image/webp" }));
    maker.root["textures"][0] = json!({ "source": 0, "extensions": { "EXT_texture_webp": { "source": 1 } } });
    let (scene, _) = maker.read().unwrap();
    assert_eq!(scene.images.iter().next().unwrap().2.texels, Texels::Rgba8(vec![[50, 60, 70, 255]]));
    // Beside a picture of another format KTX2 is passed over
    maker.root["textures"][0] =
        json!({ "source": 0, "extensions": { "KHR_texture_basisu": { "source": 1 } } });
    maker.read().unwrap();
    maker.root["textures"][0] = json!({ "extensions": { "KHR_texture_basisu": { "source": 1 } } });
    assert!(maker.error().contains("KHR_texture_basisu"), "{}", maker.error());
}

#[test]
fn wrong_references_and_pictures_name_their_place() {
    let mut maker = textured(json!({ "index": 7 }));
    let place = "/materials/0/pbrMetallicRoughness/baseColorTexture/index";
    assert_eq!(maker.error(), format!("{place}: there is no /textures/7, the file has 1"));
    maker = textured(json!({ "index": 0 }));
    let view = maker.view(b"no picture");
    maker.root["images"][0] = json!({ "bufferView": view });
    assert_eq!(maker.error(), "/images/0: this is no picture of a known format");
}
