//! What comes from files of others, at the edges of what they may say, is written so that it reads back equal.

use crate::same_again;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use dapple::export::write_scene;
use dapple::import::{ModelChoice, read_scene, read_scene_showing};
use dapple::scene::{Scene, Texture};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder with some files and a grey picture `i.png` in it.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    image::GrayImage::from_pixel(4, 4, image::Luma([90])).save(folder.path().join("i.png")).unwrap();
    folder
}

fn read(path: &Path) -> Scene {
    read_scene(path, &[]).unwrap_or_else(|error| panic!("{error}")).0
}

/// Reads the first of the files, writes, reads back, compares.
pub fn keeps(files: &[(&str, &str)]) -> Scene {
    let folder = folder(files);
    same_again(&read(&folder.path().join(files[0].0)), files[0].0)
}

/// A pbrt scene of a world.
fn pbrt(world: &str) -> String {
    format!(
        "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 12\nCamera \"perspective\"\nWorldBegin\n\
        LightSource \"infinite\" \"rgb L\" [1 1 1]\nTranslate 0 0 4\n{world}\n"
    )
}

/// A glTF model of a square in two triangles, changed.
fn gltf(change: impl Fn(&mut Value)) -> String {
    let floats = |list: &[f32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let positions = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    let normals = floats(&[0.0, 0.0, 1.0].repeat(4));
    let tangents = floats(&[2.0, 0.3, 0.0, 1.0].repeat(4));
    let uvs = floats(&[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
    let indices: Vec<u8> = [0_u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect();
    let parts = [positions, normals, tangents, uvs, indices];
    let mut views = Vec::new();
    let mut bytes = Vec::new();
    for part in &parts {
        views.push(json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": part.len()}));
        bytes.extend_from_slice(part);
    }
    let accessor = |view: usize, kind: &str, component: u32, count: usize| {
        json!({"bufferView": view, "componentType": component, "count": count, "type": kind,
               "min": [0, 0, 0], "max": [1, 1, 0]})
    };
    let mut model = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [
            {"mesh": 0, "rotation": [0.38268343, 0, 0, 0.92387953]},
            {"camera": 0, "translation": [0.3, 0.1, 4], "rotation": [0.1, 0.2, 0.05, 0.9733961]}
        ],
        "cameras": [{"name": "c", "type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 4}]}],
        "accessors": [
            accessor(0, "VEC3", 5126, 4), accessor(1, "VEC3", 5126, 4), accessor(2, "VEC4", 5126, 4),
            accessor(3, "VEC2", 5126, 4), accessor(4, "SCALAR", 5123, 6)
        ],
        "bufferViews": views,
        "buffers": [{
            "byteLength": bytes.len(),
            "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes))
        }]
    });
    for accessor in model["accessors"].as_array_mut().unwrap().iter_mut().skip(1) {
        let accessor = accessor.as_object_mut().unwrap();
        accessor.remove("min");
        accessor.remove("max");
    }
    change(&mut model);
    model.to_string()
}

#[test]
fn textures_of_roughness() {
    let world = "Texture \"r\" \"float\" \"checkerboard\" \"float tex1\" 0.1 \"float tex2\" 0.4\n\
        Material \"conductor\" \"texture roughness\" \"r\"\nShape \"sphere\"";
    keeps(&[("a.pbrt", &pbrt(world))]);
}

#[test]
fn normals_that_are_almost_of_unit_length() {
    let patch = "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] \
        \"normal N\" [0.1 0.2 -1 0.1 0.2 -1 0.1 0.2 -1 0.1 0.2 -1]";
    keeps(&[("a.pbrt", &pbrt(patch))]);
    keeps(&[("a.pbrt", &pbrt("ReverseOrientation\nShape \"sphere\""))]);
}

#[test]
fn lights_with_a_picture_whose_axes_are_not_square() {
    for light in ["infinite", "goniometric"] {
        for shear in ["0.3", "0.0005"] {
            let world = format!(
                "Film \"rgb\"\nCamera \"perspective\"\nWorldBegin\nTransform [1 0 0 0 {shear} 1 0 0 0 0 1 0 0 0 0 1]\n\
                LightSource \"{light}\" \"string filename\" \"i.png\"\nTranslate 0 0 4 Shape \"sphere\"\n"
            );
            keeps(&[("a.pbrt", &world)]);
        }
    }
}

#[test]
fn functions_that_include_others() {
    let scene = "[texture.t]\nkind = \"glsl\"\nfile = \"t.glsl\"\n[material.m]\nkind = \"diffuse\"\ncolor = { texture = \"t\" }\n\
        [[shape]]\nkind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
    let text = "#include \"inc.glsl\"\nvec4 color(TextureContext context) { return vec4(half_of(1.0)); }\n";
    let files =
        [("a.toml", scene), ("t.glsl", text), ("inc.glsl", "float half_of(float x) { return 0.5 * x; }\n")];
    let folder = folder(&files);
    let before = read(&folder.path().join("a.toml"));
    let out = folder.path().join("out.toml");
    write_scene(&before, &out, false, &mut |path| read_scene(path, &[]).map(|_| ())).unwrap();
    let after = read(&out);
    let Some((_, _, Texture::Glsl(texture))) = after.textures.iter().next() else { panic!("no texture") };
    assert!(texture.source.contains("half_of(float x)") && !texture.source.contains("#line"));
}

#[test]
fn models() {
    // A primitive that has an area, and one without
    let lines = |at: usize| {
        move |model: &mut Value| {
            let line = json!({"attributes": {"POSITION": 0}, "indices": 5});
            model["accessors"]
                .as_array_mut()
                .unwrap()
                .push(json!({"bufferView": 4, "componentType": 5123, "count": 2, "type": "SCALAR"}));
            model["meshes"][0]["primitives"].as_array_mut().unwrap().insert(at, line);
        }
    };
    for at in [0, 1] {
        let scene = keeps(&[("a.gltf", &gltf(lines(at)))]);
        assert_eq!(scene.meshes.iter().next().unwrap().2.parts.len(), 1);
    }
    // Tangents of any length
    let scene = keeps(&[(
        "a.gltf",
        &gltf(|model| {
            model["meshes"][0]["primitives"][0]["attributes"] =
                json!({"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3});
        }),
    )]);
    let tangent = scene.meshes.iter().next().unwrap().2.tangents[0];
    assert!((tangent.truncate().length() - 1.0).abs() < 1e-6 && tangent.w == 1.0);
    // A camera that is turned and stretched with its model
    let moved = "[[instance]]\nfile = \"m.gltf\"\ntransform = [{ scale = [1.1, 1.3, 0.7] }, { rotate = [0.3, 1, 0.1], angle = 31 }]\n";
    keeps(&[("a.toml", moved), ("m.gltf", &gltf(|_| {}))]);
}

#[test]
fn a_model_with_all_that_vertices_may_have() {
    let scene = keeps(&[(
        "a.gltf",
        &gltf(|model| {
            let png = {
                let mut bytes = std::io::Cursor::new(Vec::new());
                let picture =
                    image::RgbaImage::from_fn(4, 2, |x, y| image::Rgba([40 * x as u8, 90 * y as u8, 7, 200]));
                picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
                STANDARD.encode(bytes.into_inner())
            };
            model["images"] = json!([{"uri": format!("data:image/png;base64,{png}")}]);
            model["textures"] = json!([{"source": 0}]);
            model["materials"] = json!([{
                "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}},
                "normalTexture": {"index": 0, "scale": -300},
                "alphaMode": "MASK", "alphaCutoff": 1.5
            }]);
            // The four tangents stand for colours too
            model["meshes"][0]["primitives"][0] = json!({"material": 0, "indices": 4, "attributes": {
                "POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3, "TEXCOORD_1": 3, "COLOR_0": 2
            }});
        }),
    )]);
    let (_, _, mesh) = scene.meshes.iter().next().unwrap();
    assert!(
        [mesh.normals.len(), mesh.tangents.len(), mesh.uvs.len(), mesh.uvs1.len(), mesh.colors.len()]
            == [4; 5]
    );
    let (_, _, material) = scene.materials.iter().next().unwrap();
    assert_eq!(material.detail.opacity.cutoff, Some(1.5));
    assert_eq!(material.detail.normal_map.unwrap().strength, -100.0);
}

#[test]
fn pictures_that_are_drawn_out_without_end() {
    let scene = keeps(&[(
        "a.gltf",
        &gltf(|model| {
            model["images"] = json!([{"uri": "i.png"}]);
            model["textures"] = json!([{"source": 0}]);
            let placed = json!({"KHR_texture_transform": {"scale": [0, 2]}});
            model["materials"] =
                json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": placed}}}]);
            model["meshes"][0]["primitives"][0] = json!({"material": 0, "indices": 4, "attributes": {
                "POSITION": 0, "TEXCOORD_0": 3
            }});
        }),
    )]);
    let Some((_, _, Texture::Image(texture))) = scene.textures.iter().next() else { panic!("no picture") };
    assert_eq!(texture.uv.scale.x, 0.0);
    let texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"i.png\" \"float uscale\" 0\n\
        Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"";
    keeps(&[("a.pbrt", &pbrt(texture))]);
}

#[test]
fn numbers_of_pbrt_at_the_ends_of_their_ranges() {
    let sphere = |material: &str| pbrt(&format!("Material {material}\nShape \"sphere\""));
    for material in [
        "\"dielectric\" \"float eta\" 1 \"float roughness\" 0.3",
        "\"dielectric\" \"float eta\" 1e4",
        "\"coateddiffuse\" \"float eta\" 0.8 \"float roughness\" 0.2",
        "\"coateddiffuse\" \"float eta\" 1e4",
        "\"coatedconductor\" \"float interface.eta\" 1 \"float interface.roughness\" 0.2",
        "\"conductor\" \"rgb eta\" [0 0.5 200] \"rgb k\" [300 0 1]",
    ] {
        keeps(&[("a.pbrt", &sphere(material))]);
    }
    let marble = "Texture \"t\" \"spectrum\" \"marble\" \"float variation\" -0.5\n\
        Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"";
    keeps(&[("a.pbrt", &pbrt(marble))]);
    let sinc = format!("PixelFilter \"sinc\" \"float tau\" 100\n{}", pbrt("Shape \"sphere\""));
    keeps(&[("a.pbrt", &sinc)]);
}

#[test]
fn the_exposure_of_a_camera_that_is_replaced() {
    let scene = "[camera]\nf_number = 8\nfocus_distance = 3\nshutter = 0.01\n[environment]\ncolor = 1\n[[instance]]\nfile = \"m.gltf\"\n";
    let folder = folder(&[("a.toml", scene), ("m.gltf", &gltf(|_| {}))]);
    let choice = ModelChoice { camera: Some("c".into()), ..ModelChoice::default() };
    let (scene, _) = read_scene_showing(&folder.path().join("a.toml"), &[], &choice).unwrap();
    same_again(&scene, "replaced");
}

#[test]
fn surfaces_that_meet_back_to_back() {
    let scene = "[material.m]\nkind = \"diffuse\"\n[mesh.m]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n\
        triangles = [[0, 1, 2], [0, 2, 1]]\nsubdivision = \"loop\"\nlevels = 0\n[[instance]]\nmesh = \"m\"\nmaterial = \"m\"\n";
    keeps(&[("a.toml", scene)]);
}

#[test]
fn a_model_that_is_made_flat_is_refused() {
    let scene =
        "[environment]\ncolor = 1\n[[instance]]\nfile = \"m.gltf\"\ntransform = [{ scale = [1, 1, 1e-8] }]\n";
    let folder = folder(&[("a.toml", scene), ("m.gltf", &gltf(|_| {}))]);
    let error = read_scene(&folder.path().join("a.toml"), &[]).unwrap_err();
    assert!(error.message.contains("flat"), "{error}");
    assert_eq!(error.place.unwrap().line, 4);
}

#[test]
fn what_nothing_uses_is_left_out() {
    let pbrt = pbrt(
        "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\nMakeNamedMaterial \"b\" \"string type\" \"mix\" \"string materials\" [\"a\" \"a\"]\n\
        Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"i.png\"\nMaterial \"conductor\"\nShape \"sphere\"",
    );
    let lamp = "[texture.t]\nkind = \"image\"\nfile = \"i.png\"\n[material.m]\nkind = \"diffuse\"\nemission = { texture = \"t\" }\n\
        emission_scale = 2\n[[shape]]\nkind = \"sphere\"\nradius = 1\nmaterial = \"m\"\n";
    for (name, text, left) in [("a.pbrt", pbrt.as_str(), [0, 1]), ("a.toml", lamp, [1, 1])] {
        let folder = folder(&[(name, text)]);
        let out = folder.path().join("out.toml");
        write_scene(&read(&folder.path().join(name)), &out, false, &mut |_| Ok(())).unwrap();
        let (scene, warnings) = read_scene(&out, &[]).unwrap();
        assert_eq!([scene.textures.len(), scene.materials.len()], left, "{name}");
        assert!(warnings.is_empty(), "{name}: {warnings:?}");
    }
}

/// Names of all in a folder.
fn names(folder: &Path) -> Vec<PathBuf> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into()).collect();
    names.sort();
    names
}

#[test]
fn a_scene_that_does_not_pass_leaves_all_as_it_was() {
    let scene = "[texture.t]\nkind = \"image\"\nfile = \"i.png\"\n[material.m]\nkind = \"diffuse\"\ncolor = { texture = \"t\" }\n\
        [[shape]]\nkind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
    let folder = folder(&[("a.toml", scene)]);
    let out = folder.path().join("a.toml");
    let before = names(folder.path());
    let mut asked = 0;
    let refused = write_scene(&read(&out), &out, true, &mut |path| {
        asked += 1;
        // All is there, and reads
        read_scene(path, &[]).map(|_| ())?;
        Err(dapple::Error::output("no"))
    });
    assert_eq!((refused.unwrap_err().message.as_str(), asked), ("no", 1));
    assert_eq!(names(folder.path()), before);
    assert_eq!(fs::read_to_string(&out).unwrap(), scene);
}

#[cfg(unix)]
#[test]
fn links_that_lead_nowhere_are_in_the_way() {
    let folder = folder(&[]);
    let scene = Scene::default();
    let write =
        |name: &str, replace| write_scene(&scene, &folder.path().join(name), replace, &mut |_| Ok(()));
    std::os::unix::fs::symlink("/nonexistent", folder.path().join("a_files")).unwrap();
    assert!(write("a.toml", false).unwrap_err().message.contains("is there already"));
    assert!(write("a.toml", true).unwrap_err().message.contains("this is no folder"));
    std::os::unix::fs::symlink("/nonexistent", folder.path().join("b.toml")).unwrap();
    assert!(write("b.toml", false).unwrap_err().message.contains("is there already"));
}
