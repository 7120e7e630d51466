//! Scenes that are written as TOML and read again are the same scenes.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

mod common;

use common::references;
use dapple::export::write_scene;
use dapple::import::read_scene;
use dapple::scene::{
    GlslTexture, Handle, Image, ImageTexture, MeshPart, Noise, NoiseSum, Scene, Store, Texture,
};
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::fs;
use std::path::{Path, PathBuf};

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
    same("camera", camera_a == camera_b);
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
    stores.extend(first_unlike("mesh", &a.meshes, &b.meshes, |mesh, _| {
        let mut mesh = mesh.clone();
        mesh.parts = mesh.parts.into_iter().map(|part| MeshPart { name: String::new(), ..part }).collect();
        mesh
    }));
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
            all.extend(contents(&path).into_iter().map(|(name, bytes)| (Path::new(path.file_name().unwrap()).join(name), bytes)));
        } else {
            all.insert(path.file_name().unwrap().into(), fs::read(&path).unwrap());
        }
    }
    all
}

/// Writes a scene, reads it, compares; and the same again, for the same files.
fn same_again(scene: &Scene, name: &str) -> Scene {
    let [first, second] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [a, b] = [&first, &second].map(|folder| folder.path().join("out.toml"));
    write_scene(scene, &a, false).unwrap_or_else(|error| panic!("{name}: {error}"));
    let (read, _) = read_scene(&a, &[]).unwrap_or_else(|error| {
        panic!("{name}: {error}\n{}", fs::read_to_string(&a).unwrap());
    });
    if let Some(what) = difference(scene, &read) {
        panic!("{name}: {what}");
    }
    write_scene(&read, &b, false).unwrap();
    let [before, after] = [&first, &second].map(|folder| contents(folder.path()));
    let text = |files: &BTreeMap<PathBuf, Vec<u8>>| String::from_utf8_lossy(&files[Path::new("out.toml")]).into_owned();
    assert_eq!(text(&before), text(&after), "{name}");
    assert!(before == after, "{name}: other files");
    read
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
