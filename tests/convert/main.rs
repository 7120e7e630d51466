//! Scenes that are written as TOML and read again are the same scenes.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

#[path = "../common/mod.rs"]
mod common;
mod files;
mod kept;
mod kinds;

use common::references;
use dapple::Result;
use dapple::export::write_scene;
use dapple::import::{Assets, Model, ModelChoice, read_scene, read_scene_with};
use dapple::scene::{
    GlslTexture, Handle, Image, ImageTexture, Instance, Material, Mesh, MeshPart, Noise, NoiseSum, Scene,
    Shape, ShapeKind, Store, Surface, Texels, Texture, Value,
};
use glam::{Affine3A, Vec3};
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The first thing in which two scenes differ, names and what has no meaning aside.
fn difference(a: &Scene, b: &Scene) -> Option<String> {
    let mut found = Vec::new();
    let mut same = |what: &str, same: bool| found.extend((!same).then(|| what.to_owned()));
    same("film", a.film == b.film);
    same("render", a.render == b.render);
    let [mut camera_a, mut camera_b] = [a.camera.clone(), b.camera.clone()];
    same("opening", opening(a) == opening(b));
    for camera in [&mut camera_a, &mut camera_b] {
        strip_opening(camera);
    }
    same(&format!("camera:\n{camera_a:?}\n{camera_b:?}"), camera_a == camera_b);
    same("environment", a.environment == b.environment);
    same("lights", a.lights == b.lights);
    let named = |n: usize| format!("number {n}");
    let mut shapes = [a.shapes.clone(), b.shapes.clone()];
    shapes.iter_mut().flatten().for_each(|shape| shape.name.clear());
    let mut instances = [a.instances.clone(), b.instances.clone()];
    instances.iter_mut().flatten().for_each(|instance| instance.name.clear());
    same("shapes", shapes[0] == shapes[1]);
    same("instances", instances[0] == instances[1]);
    let mut stores = Vec::new();
    stores.extend(first_unlike("material", &a.materials, &b.materials, |m, _| m.clone()));
    stores.extend(first_unlike("mesh", &a.meshes, &b.meshes, |mesh, _| mesh.clone()));
    let [pictures_a, pictures_b] = [a, b].map(|scene| pictures(scene));
    if pictures_a != pictures_b {
        let at = pictures_a.iter().zip(&pictures_b).position(|(a, b)| a != b);
        stores.push(format!("picture {}", named(at.unwrap_or(pictures_a.len().min(pictures_b.len())))));
    }
    let none = first_image(a).or(first_image(b));
    stores.extend(first_unlike("texture", &a.textures, &b.textures, |texture, _| plain(texture, none)));
    found.into_iter().chain(stores).next()
}

/// A picture that stands for all: which handle a picture has does not count.
fn first_image(scene: &Scene) -> Option<Handle<Image>> {
    scene.images.iter().next().map(|(handle, ..)| handle)
}

fn plain(texture: &Texture, image: Option<Handle<Image>>) -> Texture {
    match texture.clone() {
        Texture::Image(texture) => Texture::Image(ImageTexture { image: image.unwrap(), ..texture }),
        Texture::Stack(mut stack) => {
            stack.slices.iter_mut().for_each(|slice| *slice = image.unwrap());
            Texture::Stack(stack)
        }
        Texture::Glsl(glsl) => Texture::Glsl(GlslTexture { file: PathBuf::new(), line: 0, ..glsl }),
        // Wind over water knows no normalised sum
        Texture::Noise(noise) if noise.sum == NoiseSum::Windy => {
            Texture::Noise(Noise { normalize: true, ..noise })
        }
        other => other,
    }
}

/// The pictures of the textures, in the order of these.
fn pictures(scene: &Scene) -> Vec<&Image> {
    let of = |texture: &Texture| match texture {
        Texture::Image(texture) => vec![texture.image],
        Texture::Stack(stack) => stack.slices.clone(),
        _ => Vec::new(),
    };
    let handles = scene.textures.iter().flat_map(|(_, _, texture)| of(texture));
    handles.map(|handle| &scene.images[handle]).collect()
}

fn opening(scene: &Scene) -> Option<&Image> {
    scene.camera.opening().and_then(|opening| opening.image).map(|image| &scene.images[image])
}

fn strip_opening(camera: &mut dapple::scene::Camera) {
    match &mut camera.projection {
        dapple::scene::Projection::Perspective(view) => {
            if let Some(lens) = &mut view.lens {
                lens.opening.image = None;
            }
        }
        dapple::scene::Projection::Lens(lens) => lens.opening.image = None,
        _ => {}
    }
}

fn first_unlike<T, U: PartialEq + Debug>(
    what: &str,
    a: &Store<T>,
    b: &Store<T>,
    plain: impl Fn(&T, &str) -> U,
) -> Option<String> {
    if a.len() != b.len() {
        return Some(format!("{} and {} of {what}", a.len(), b.len()));
    }
    a.iter().zip(b.iter()).find_map(|((_, name, a), (_, other, b))| {
        let [a, b] = [plain(a, name), plain(b, other)];
        let short = |value: &U| format!("{value:?}").chars().take(2000).collect::<String>();
        (a != b).then(|| format!("{what} `{name}`:\n{}\n{}", short(&a), short(&b)))
    })
}

/// All files under a folder with their bytes.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(
                contents(&path)
                    .into_iter()
                    .map(|(name, bytes)| (Path::new(path.file_name().unwrap()).join(name), bytes)),
            );
        } else {
            all.insert(path.file_name().unwrap().into(), fs::read(&path).unwrap());
        }
    }
    all
}

/// The scene with a use of each of its objects: what nothing uses is not written.
fn all_used(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let textures: Vec<_> = scene.textures.iter().map(|(handle, ..)| handle).collect();
    for texture in textures {
        let surface = Surface::Unlit { color: Value::Texture(texture) };
        scene.materials.add("a use", Material::new(surface, None));
    }
    let center = Vec3::new(0.0, 1e6, 0.0);
    let kind = ShapeKind::Sphere { center, radius: 1.0, pole: Vec3::Y, meridian: Vec3::X };
    let world_from_object = Affine3A::IDENTITY;
    for (material, ..) in scene.materials.iter() {
        scene.shapes.push(Shape { name: String::new(), kind, material, world_from_object, at_close: None });
    }
    let Some((material, ..)) = scene.materials.iter().next() else { return scene };
    for (mesh, ..) in scene.meshes.iter() {
        scene.instances.push(Instance {
            name: String::new(),
            mesh,
            material,
            world_from_object,
            at_close: None,
        });
    }
    scene
}

/// Writes a scene, reads it, compares; and the same again, for the same files.
pub fn same_again(scene: &Scene, name: &str) -> Scene {
    let scene = &all_used(scene);
    let [first, second] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [a, b] = [&first, &second].map(|folder| folder.path().join("out.toml"));
    write_scene(scene, &a, false, &mut |_| Ok(())).unwrap_or_else(|error| panic!("{name}: {error}"));
    let (read, warnings) = read_scene(&a, &[]).unwrap_or_else(|error| {
        panic!("{name}: {error}\n{}", fs::read_to_string(&a).unwrap());
    });
    let unused = warnings.iter().find(|warning| warning.message.contains("nothing uses"));
    assert!(unused.is_none(), "{name}: {unused:?}");
    if let Some(what) = difference(scene, &read) {
        panic!("{name}: {what}");
    }
    write_scene(&read, &b, false, &mut |_| Ok(())).unwrap();
    let [before, after] = [&first, &second].map(|folder| contents(folder.path()));
    let text = |files: &BTreeMap<PathBuf, Vec<u8>>| {
        String::from_utf8_lossy(&files[Path::new("out.toml")]).into_owned()
    };
    assert_eq!(text(&before), text(&after), "{name}");
    let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&before), names(&after), "{name}");
    read
}

/// The scene that uses every key, with files in memory.
struct Memory;

impl Assets for Memory {
    fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
        let level = path.to_string_lossy().len();
        let texels = match path.extension().is_some_and(|extension| extension == "exr") {
            true => Texels::RgbaF32(vec![[0.1 * level as f32, 2.5, 0.0, 1.0]; 2]),
            false => Texels::Rgba8(vec![[level as u8, 2, 3, 255], [0, 255, 9, 255]]),
        };
        Ok(Arc::new(Image { width: 2, height: 1, texels }))
    }

    fn mesh(&mut self, path: &Path) -> Result<Mesh> {
        let triangles = vec![[0, 1, 2], [0, 2, 3]];
        let part = |name: &str, triangles| MeshPart { name: name.into(), triangles, material: None };
        let parts = match path.ends_with("plain.ply") {
            true => vec![part("", 0..2)],
            false => vec![part("steel", 0..1), part("tin", 1..2)],
        };
        Ok(Mesh { triangles, parts, ..Mesh::square() })
    }

    fn model(&mut self, _: &Path, _: &ModelChoice, _: &mut Scene) -> Result<Model> {
        Ok(Model::default())
    }

    fn exists(&mut self, path: &Path) -> bool {
        path.extension().is_none_or(|extension| extension != "glsl")
    }

    fn text(&mut self, _: &Path) -> Result<String> {
        Ok(ALL_KEYS.into())
    }
}

const ALL_KEYS: &str = include_str!("../../src/import/toml/tests/all_keys.toml");

fn all_keys() -> Scene {
    let path = Path::new("scene.toml");
    read_scene_with(path, &[], &ModelChoice::default(), &mut Memory)
        .unwrap_or_else(|error| panic!("{error}"))
        .0
}

#[test]
fn every_key_is_written() {
    same_again(&all_keys(), "all keys");
}

#[test]
fn a_scene_that_is_changed_is_another() {
    let scene = all_keys();
    assert_eq!(difference(&scene, &scene), None);
    type Change = fn(&mut Scene);
    let changes: [(&str, Change); 10] = [
        ("film", |scene| scene.film.png_bits = 8),
        ("render", |scene| scene.render.seed += 1),
        ("camera", |scene| scene.camera.mirrored ^= true),
        ("environment", |scene| scene.environment = None),
        ("lights", |scene| _ = scene.lights.pop()),
        ("shapes", |scene| scene.shapes[0].world_from_object.translation.x += 1e-6),
        ("instances", |scene| scene.instances[0].at_close = Some(glam::Affine3A::IDENTITY)),
        ("mesh", |scene| {
            let handle = scene.meshes.iter().next().unwrap().0;
            scene.meshes[handle].positions[0].x = 1e-7;
        }),
        ("texture", |scene| {
            let handle = scene.textures.iter().next().unwrap().0;
            scene.textures[handle] = Texture::Constant(glam::Vec3::ONE);
        }),
        ("material", |scene| {
            let handle = scene.materials.iter().next().unwrap().0;
            scene.materials[handle].detail.keep_visible ^= true;
        }),
    ];
    for (what, change) in changes {
        let mut other = scene.clone();
        change(&mut other);
        let found = difference(&scene, &other).unwrap_or_else(|| panic!("{what}: no difference"));
        // A texture less is a picture less
        assert!(
            found.starts_with(what) || (what == "texture" && found.starts_with("picture")),
            "{what}: {found}"
        );
    }
}

#[test]
fn numbers_are_read_as_they_were() {
    let mut scene = Scene::default();
    let numbers = [0.1, -0.0, 1.0, 16_777_216.0, 1e-40, f32::MAX, 1.0 / 3.0, f32::MIN_POSITIVE, -7e9];
    for (i, x) in numbers.into_iter().enumerate() {
        scene
            .textures
            .add(format!("a \"b\"\n{i}"), Texture::Constant(glam::Vec3::new(x, 1.0, x.next_down())));
    }
    let read = same_again(&scene, "numbers");
    let bits = |scene: &Scene| {
        let values = scene.textures.iter().map(|(_, name, texture)| {
            let Texture::Constant(value) = texture else { panic!() };
            (name.to_owned(), value.to_array().map(f32::to_bits))
        });
        values.collect::<Vec<_>>()
    };
    assert_eq!(bits(&scene), bits(&read));
}

#[test]
fn what_is_there_is_kept_and_names_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let scene = Scene::default();
    let refused = |path: &Path| write_scene(&scene, path, false, &mut |_| Ok(())).unwrap_err().to_string();
    assert!(
        refused(&at("a.pbrt"))
            .contains("no scene can be written with the extension `pbrt`; end the name in .toml")
    );
    assert!(refused(&at("toml")).contains("the name of the scene has no extension"));
    assert!(refused(&at("none/a.toml")).contains("there is no folder"));
    fs::write(at("a.toml"), "before").unwrap();
    assert!(
        refused(&at("a.toml")).contains(
            "a.toml: this is there already and is not replaced; name another file, or give --force"
        )
    );
    assert_eq!(fs::read_to_string(at("a.toml")).unwrap(), "before");
    let written = write_scene(&scene, &at("a.toml"), true, &mut |_| Ok(())).unwrap();
    assert_eq!(written.files, [at("a.toml")]);
    assert_eq!(written.bytes, fs::metadata(at("a.toml")).unwrap().len());
    fs::create_dir(at("b_files")).unwrap();
    assert!(refused(&at("b.toml")).contains("b_files: this is there already"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

fn read(path: &Path) -> Scene {
    read_scene(path, &[]).unwrap_or_else(|error| panic!("{error}")).0
}

/// Files of a folder with an extension, sorted.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|found| found == extension));
    files.sort();
    assert!(!files.is_empty(), "no .{extension} in {}", folder.display());
    files
}

#[test]
fn scenes_of_the_project_are_the_same() {
    for file in files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes"), "toml") {
        same_again(&read(&file), &file.display().to_string());
    }
}

#[test]
fn scenes_of_pbrt_are_the_same() {
    let Some(folder) = references::folder().unwrap() else { return };
    for file in files(&folder.join("pbrt"), "pbrt") {
        same_again(&read(&file), &file.display().to_string());
    }
}
