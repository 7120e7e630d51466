//! The reader as a whole, on files in memory. Here: what a scene says, in plain values.

mod damage;
mod errors;
mod files;
mod lights;
mod manual;
mod shapes;

use super::read_pbrt;
use crate::import::{Assets, Spacing, Warning};
use crate::scene::*;
use crate::{Error, Result};
use glam::{Affine3A, Vec2, Vec3};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Files in memory. Pictures end in `.png` (8 bits) or `.exr` (floats), meshes in `.ply`, lenses in `.dat`.
#[derive(Default)]
struct Memory {
    texts: BTreeMap<String, String>,
}

impl Assets for Memory {
    fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
        if path.ends_with("two.png") {
            // Black above white, and in the middle grey
            let texels = Texels::Rgba8(vec![[0, 0, 0, 255], [128, 128, 128, 255], [255, 255, 255, 255]]);
            return Ok(Arc::new(Image { width: 1, height: 3, texels }));
        }
        let texels = match path.extension().and_then(|ext| ext.to_str()) {
            Some("png") => Texels::Rgba8(vec![[255; 4]]),
            Some("exr") => Texels::RgbaF32(vec![[1.0, 1.0, 1.0, 0.5]]),
            _ => return Err(Error::scene("not a picture")),
        };
        Ok(Arc::new(Image { width: 1, height: 1, texels }))
    }

    fn mesh(&mut self, _: &Path) -> Result<Mesh> {
        let part = MeshPart { name: String::new(), triangles: 0..1, material: None };
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        Ok(Mesh { positions, triangles: vec![[0, 1, 2]], parts: vec![part], ..Mesh::default() })
    }

    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        let text = "# A singlet\n50 4 1.5 20\n0 1 0 10\n-50 60 1 20\n";
        crate::import::lens::parse(text, spacing, path)
    }

    fn exists(&mut self, path: &Path) -> bool {
        let binary = ["png", "exr", "ply", "dat"];
        let extension = path.extension().and_then(|ext| ext.to_str());
        !path.ends_with("missing.png") && extension.is_some_and(|ext| binary.contains(&ext))
            || self.texts.contains_key(&path.display().to_string())
    }

    fn text(&mut self, path: &Path) -> Result<String> {
        let missing = || Error::scene("no such file").in_file(path);
        self.texts.get(&path.display().to_string()).cloned().ok_or_else(missing)
    }
}

/// Reads the first of some files.
fn read_files(files: &[(&str, &str)]) -> Result<(Scene, Vec<Warning>)> {
    let texts = files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
    read_pbrt(Path::new(files[0].0), &mut Memory { texts })
}

fn read(text: &str) -> Result<(Scene, Vec<Warning>)> {
    read_files(&[("scene.pbrt", text)])
}

/// A scene that has no warnings.
fn scene(text: &str) -> Scene {
    let (scene, warnings) = read(text).unwrap_or_else(|error| panic!("{error}"));
    assert!(warnings.is_empty(), "{warnings:?}");
    scene
}

/// A world with nothing before it.
fn world(text: &str) -> Scene {
    scene(&format!("WorldBegin\n{text}"))
}

/// A scene that has what the reader knows.
const ALL: &str = include_str!("all.pbrt");

#[test]
fn a_scene_with_everything_is_read() {
    let (_, warnings) = read(ALL).unwrap_or_else(|error| panic!("{error}"));
    assert!(warnings.iter().all(|warning| warning.message.starts_with("not supported: ")));
    assert!(warnings.len() >= 20, "{}", warnings.len());
}

#[test]
fn what_is_not_said_is_that_of_pbrt() {
    let scene = scene("WorldBegin");
    assert_eq!((scene.film.width, scene.film.height), (1280, 720));
    assert_eq!(scene.film.filter, Filter { kind: FilterKind::Gaussian, radius: 1.5 });
    assert_eq!((scene.render.spp, scene.render.max_depth), (16, 5));
    assert_eq!(
        scene.camera.projection,
        Projection::Perspective(Perspective { fov: 90.0, fov_axis: FovAxis::Smaller, lens: None })
    );
    // Along +z, with x to the right
    assert_eq!((scene.camera.position, scene.camera.target, scene.camera.up), (Vec3::ZERO, Vec3::Z, Vec3::Y));
    assert!(scene.camera.mirrored);
}

#[test]
fn the_camera_stands_where_look_at_says() {
    let at = |more: &str| {
        scene(&format!(
            "{more} LookAt 1 2 3  1 2 9  0 1 0 Camera \"perspective\" \"float fov\" 50 WorldBegin"
        ))
    };
    let camera = at("").camera;
    assert!(camera.position.abs_diff_eq(Vec3::new(1.0, 2.0, 3.0), 1e-6), "{}", camera.position);
    assert!((camera.target - camera.position).normalize().abs_diff_eq(Vec3::Z, 1e-6));
    assert!(camera.mirrored);
    // Scale -1 1 1 before it swaps left and right
    assert!(!at("Scale -1 1 1").camera.mirrored);
}

#[test]
fn transforms_apply_from_the_last_to_the_first() {
    let scene = world(
        "Translate 1 0 0 Scale 2 2 2 CoordinateSystem \"here\" AttributeBegin Rotate 90 0 0 1 Shape \"sphere\" AttributeEnd \
         Identity Shape \"sphere\" CoordSysTransform \"here\" ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 3 0 1] Shape \"sphere\"",
    );
    let at = |i: usize, p: Vec3| scene.shapes[i].world_from_object.transform_point3(p);
    assert!(at(0, Vec3::X).abs_diff_eq(Vec3::new(1.0, 2.0, 0.0), 1e-6), "{}", at(0, Vec3::X));
    assert_eq!(scene.shapes[1].world_from_object, Affine3A::IDENTITY);
    assert!(at(2, Vec3::ZERO).abs_diff_eq(Vec3::new(1.0, 6.0, 0.0), 1e-6), "{}", at(2, Vec3::ZERO));
}

#[test]
fn things_move_between_the_active_transforms() {
    let scene =
        world("ActiveTransform EndTime Translate 0 2 0 ActiveTransform All Translate 1 0 0 Shape \"sphere\"");
    let [shape] = scene.shapes.as_slice() else { panic!("{:?}", scene.shapes) };
    assert_eq!(Vec3::from(shape.world_from_object.translation), Vec3::X);
    assert_eq!(shape.at_close.map(|map| Vec3::from(map.translation)), Some(Vec3::new(1.0, 2.0, 0.0)));
}

#[test]
fn objects_are_placed_by_both_transforms() {
    let scene = world(
        "ObjectBegin \"o\" Translate 0 1 0 Shape \"sphere\" Shape \"plymesh\" \"string filename\" \"a.ply\" ObjectEnd \
         AttributeBegin Scale 1 3 1 ObjectInstance \"o\" AttributeEnd ObjectInstance \"o\"",
    );
    assert_eq!((scene.shapes.len(), scene.instances.len(), scene.meshes.len()), (2, 2, 1));
    assert_eq!(Vec3::from(scene.shapes[0].world_from_object.translation), Vec3::new(0.0, 3.0, 0.0));
    assert_eq!(Vec3::from(scene.instances[1].world_from_object.translation), Vec3::Y);
}

#[test]
fn light_and_opacity_of_shapes_become_those_of_materials() {
    let scene = world(
        "NamedMaterial \"later\" AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2 \"bool twosided\" true \
         Shape \"sphere\" \"float alpha\" 0.25 Shape \"sphere\" \"float alpha\" 0.25 Shape \"disk\" \
         MakeNamedMaterial \"later\" \"string type\" \"diffuse\" \"rgb reflectance\" [.1 .2 .3]",
    );
    let [a, b, c] = scene.shapes.as_slice() else { panic!("{:?}", scene.shapes) };
    assert_eq!(a.material, b.material);
    let material = |shape: &Shape| &scene.materials[shape.material];
    for shape in [a, c] {
        let emission = material(shape).emission.as_ref().unwrap();
        assert_eq!(emission.radiance, Value::Constant(Vec3::new(2.0, 4.0, 6.0)));
        assert!(emission.two_sided);
        let color = Value::Constant(Vec3::new(0.1, 0.2, 0.3));
        assert_eq!(material(shape).surface, Surface::diffuse(color));
    }
    assert_eq!(material(a).detail.opacity.value, Value::Constant(0.25));
    assert_eq!(material(c).detail.opacity.value, Value::Constant(1.0));
}

#[test]
fn power_is_spread_over_area_and_sides() {
    let radiance = |text: &str| {
        let scene = world(text);
        let material = match scene.shapes.first() {
            Some(shape) => shape.material,
            None => scene.meshes.iter().next().unwrap().2.parts[0].material.unwrap(),
        };
        match scene.materials[material].emission.as_ref().unwrap().radiance {
            Value::Constant(color) => color.x,
            Value::Texture(_) => panic!(),
        }
    };
    let pi = std::f32::consts::PI;
    let light = "AreaLightSource \"diffuse\" \"float power\" 8 ";
    let sphere = radiance(&format!("{light} Shape \"sphere\" \"float radius\" 2"));
    assert!((sphere - 8.0 / (16.0 * pi * pi)).abs() < 1e-5, "{sphere}");
    // A triangle of half a square
    let triangle = radiance(&format!(
        "{light} \"bool twosided\" true Scale 2 2 2 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]"
    ));
    assert!((triangle - 8.0 / (2.0 * 2.0 * pi)).abs() < 1e-5, "{triangle}");
}

#[test]
fn the_front_of_a_mesh_is_where_pbrt_has_it() {
    let mesh = |text: &str| {
        let scene = world(text);
        scene.meshes.iter().next().unwrap().2.clone()
    };
    let front = |mesh: &Mesh| {
        let [a, b, c] = mesh.triangles[0].map(|i| mesh.positions[i as usize]);
        (b - a).cross(c - a).z
    };
    const MESH: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] ";
    assert!(front(&mesh(MESH)) > 0.0);
    let reversed = mesh(&format!("ReverseOrientation {MESH}"));
    assert!(front(&reversed) < 0.0);
    // Texture coordinates stay those of the corners as they were written
    assert_eq!(reversed.uvs[reversed.triangles[0][1] as usize], Vec2::ONE);
    let by_normals = mesh(&format!("{MESH} \"normal N\" [0 0 -1 0 0 -1 0 0 -1]"));
    assert!(front(&by_normals) < 0.0);
    assert_eq!(by_normals.normals[0], Vec3::NEG_Z);
    let twice = mesh(&format!("ReverseOrientation {MESH} \"normal N\" [0 0 -1 0 0 -1 0 0 -1]"));
    assert!(front(&twice) > 0.0 && twice.normals[0] == Vec3::Z);
}

#[test]
fn attributes_give_parameters_to_what_follows() {
    let scene = world(
        "Attribute \"shape\" \"float radius\" 3 AttributeBegin Attribute \"shape\" \"float radius\" 4 Shape \"sphere\" \
         AttributeEnd Shape \"sphere\" Shape \"sphere\" \"float radius\" 5 Attribute \"light\" \"float scale\" 2 \
         LightSource \"point\" \"rgb I\" [1 1 1]",
    );
    let radius = |shape: &Shape| match shape.kind {
        ShapeKind::Sphere { radius, .. } => radius,
        _ => 0.0,
    };
    assert_eq!(scene.shapes.iter().map(radius).collect::<Vec<_>>(), [4.0, 3.0, 5.0]);
    assert_eq!(scene.lights[0].intensity, Value::Constant(Vec3::splat(2.0)));
}

#[test]
fn lights_have_the_power_that_is_asked_for() {
    let scene = world(
        "LightSource \"point\" \"float power\" 12.566371 LightSource \"distant\" \"float illuminance\" 3 \
         LightSource \"infinite\" \"float illuminance\" 3.1415927 LightSource \"infinite\" \"rgb L\" [1 2 3] \
         LightSource \"point\" \"blackbody I\" 6500 \"float scale\" 5",
    );
    let Value::Constant(intensity) = scene.lights[0].intensity else { panic!() };
    assert!(intensity.abs_diff_eq(Vec3::ONE, 1e-5), "{intensity}");
    let Value::Constant(irradiance) = scene.lights[1].intensity else { panic!() };
    assert!(irradiance.abs_diff_eq(Vec3::splat(3.0), 1e-5), "{irradiance}");
    let Value::Constant(radiance) = scene.environment.unwrap().radiance else { panic!() };
    assert!(radiance.abs_diff_eq(Vec3::new(2.0, 3.0, 4.0), 1e-5), "{radiance}");
    let Value::Constant(intensity) = scene.lights[2].intensity else { panic!() };
    let luminance = intensity.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    assert!((luminance - 5.0).abs() < 0.1, "{intensity}");
}

#[test]
fn roughness_is_a_square_root_unless_it_is_none() {
    let width = |more: &str| {
        let scene = world(&format!("Material \"dielectric\" {more} Shape \"sphere\""));
        match &scene.materials[scene.shapes[0].material].surface {
            Surface::Dielectric(glass) => glass.roughness.u,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(width("\"float roughness\" 0.25"), Value::Constant(0.5));
    assert_eq!(width("\"float roughness\" 0.25 \"bool remaproughness\" false"), Value::Constant(0.25));
    assert_eq!(width("\"float uroughness\" 1e-7"), Value::Constant(0.0));
}

#[test]
fn glasses_and_spectra_that_fall_have_an_abbe_number() {
    let glass = |more: &str| {
        let scene = world(&format!("Material {more} Shape \"sphere\""));
        match &scene.materials[scene.shapes[0].material].surface {
            Surface::Dielectric(glass) => (glass.ior, glass.abbe),
            other => panic!("{other:?}"),
        }
    };
    let index = Value::Constant;
    assert_eq!(glass("\"dielectric\" \"spectrum eta\" \"glass-F11\""), (index(1.7847), Some(25.76)));
    assert_eq!(glass("\"thindielectric\" \"spectrum eta\" \"glass-F11\""), (index(1.7847), None));
    assert_eq!(glass("\"dielectric\" \"float eta\" 1.4"), (index(1.4), None));
    assert_eq!(glass("\"dielectric\" \"spectrum eta\" [400 1.5 700 1.5]"), (index(1.5), None));
    // A straight line, 0.0005 / nm: 0.5938 at the d line, 0.0851 from F to C
    let (Value::Constant(ior), Some(abbe)) = glass("\"dielectric\" \"spectrum eta\" [400 1.6 700 1.45]")
    else {
        panic!("a spectrum that falls")
    };
    assert!((ior - 1.506_22).abs() < 1e-5 && (abbe - 0.506_219 / 0.085_07).abs() < 1e-2, "{ior} {abbe}");
}
