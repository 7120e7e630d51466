//! Files that name others, and what bounds them.

use super::{read, read_files};
use crate::scene::Value;
use glam::Vec3;

#[test]
fn included_files_change_the_state_and_imported_ones_do_not() {
    let with = |word: &str| {
        let scene = format!("WorldBegin {word} \"parts/a.pbrt\" Shape \"sphere\"");
        let (scene, _) =
            read_files(&[("s/scene.pbrt", &scene), ("s/parts/a.pbrt", "Translate 0 1 0")]).unwrap();
        Vec3::from(scene.shapes[0].world_from_object.translation)
    };
    assert_eq!([with("Include"), with("Import")], [Vec3::Y, Vec3::ZERO]);
}

#[test]
fn files_that_include_themselves_or_too_many_are_refused() {
    let error =
        read_files(&[("a.pbrt", "\nInclude \"b.pbrt\""), ("b.pbrt", "Include \"a.pbrt\"")]).unwrap_err();
    assert_eq!(error.to_string(), "b.pbrt:1:1: the file a.pbrt includes itself; check what is included");
    // Each file includes the next one ten times: 10¹⁰ without a bound
    let files: Vec<(String, String)> =
        (0..11).map(|i| (format!("{i}.pbrt"), format!("Include \"{}.pbrt\" ", i + 1).repeat(10))).collect();
    let mut files: Vec<(&str, &str)> =
        files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    files.push(("11.pbrt", ""));
    let error = read_files(&files).unwrap_err().to_string();
    assert!(error.contains("more than 10000 files are included"), "{error}");
    let error = read_files(&[("a.pbrt", "Include \"c.pbrt\"")]).unwrap_err().to_string();
    assert_eq!(error, "a.pbrt:1:1: there is no file c.pbrt; check what is included");
}

#[test]
fn objects_of_many_things_placed_many_times_are_refused() {
    let text = format!(
        "WorldBegin ObjectBegin \"o\" {} ObjectEnd {}",
        "Shape \"sphere\" ".repeat(2000),
        "ObjectInstance \"o\" ".repeat(2000)
    );
    let error = read(&text).unwrap_err().to_string();
    assert!(error.contains("more than 1048576 shapes"), "{error}");
}

#[test]
fn spectra_come_from_names_lists_and_files() {
    let reflectance = |value: &str| {
        let text =
            format!("WorldBegin Material \"diffuse\" \"spectrum reflectance\" {value} Shape \"sphere\"");
        let files = [("scene.pbrt", text.as_str()), ("grey.spd", "# nm value\n400 0.25\n700 0.25\n")];
        let (scene, _) = read_files(&files)?;
        let crate::scene::Surface::Bsdf(diffuse) = &scene.materials[scene.shapes[0].material].surface else {
            panic!();
        };
        match diffuse.colors[0] {
            Value::Constant(color) => Ok::<_, crate::Error>(color),
            Value::Texture(_) => panic!(),
        }
    };
    assert!(reflectance("[400 0.5 700 0.5]").unwrap().abs_diff_eq(Vec3::splat(0.5), 1e-5));
    assert!(reflectance("\"grey.spd\"").unwrap().abs_diff_eq(Vec3::splat(0.25), 1e-5));
    let error = reflectance("\"metal-Gold-eta\"").unwrap_err().to_string();
    assert!(error.contains("is neither a named spectrum nor a file"), "{error}");
    let error = reflectance("[700 1 400 1]").unwrap_err().to_string();
    assert!(error.contains("wavelengths that grow"), "{error}");
}

#[test]
fn settings_change_film_and_render_alone() {
    let set = |key: &str, value: &str| {
        let texts =
            [("scene.pbrt".to_owned(), "Film \"rgb\" \"integer xresolution\" 8 WorldBegin".to_owned())];
        let pair = [(key.to_owned(), value.to_owned())];
        let mut files = super::Memory { texts: texts.into() };
        crate::import::read_scene_with(
            std::path::Path::new("scene.pbrt"),
            &pair,
            &crate::import::ModelChoice::default(),
            &mut files,
        )
    };
    let (scene, _) = set("render.spp", "3").unwrap();
    assert_eq!((scene.render.spp, scene.render.max_depth, scene.film.width), (3, 5, 8));
    let (scene, _) = set("film.tone_curve", "aces").unwrap();
    assert_eq!((scene.film.width, scene.film.filter.radius), (8, 1.5));
    let error = set("camera.fov", "3").unwrap_err().to_string();
    assert!(error.contains("[camera] of this scene cannot be set"), "{error}");
}

#[test]
fn pictures_that_are_not_there_are_reported_where_they_are_named() {
    let text = "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"missing.png\"";
    let error = read(text).unwrap_err().to_string();
    assert!(error.starts_with("scene.pbrt:2:35: there is no file missing.png; "), "{error}");
}
