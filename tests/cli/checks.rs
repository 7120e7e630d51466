//! The commands that render nothing.

use crate::Room;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

#[test]
fn check_tells_what_is_in_a_scene() {
    let room = Room::new();
    let ran = room.run("check scene.toml").code(0);
    assert_eq!(ran.err, "");
    for row in [
        "film           16 x 12 pixels",
        "samples        8 a pixel",
        "triangles      2",
        "scene records",
        "warnings       0",
    ] {
        assert!(ran.out.contains(row), "no `{row}` in {}", ran.out);
    }
    let ran = room.run("check scene.toml --json --set film.size=[4,3]").code(0);
    let contents: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(contents["size"], json!([4, 3]));
    assert_eq!(contents["window"], json!([0, 0, 4, 3]));
    // Quad, sphere, and the sphere of the light.
    assert_eq!(contents["shapes"], 3);
    assert_eq!((&contents["triangles"], &contents["lights"]), (&json!(2), &json!(1)));
    assert!(contents["scene_bytes"].as_u64().unwrap() > 0);
    assert_eq!(contents["warnings"], json!([]));
    assert_eq!(room.names(), ["scene.toml"]);
}

#[test]
fn a_scene_of_pbrt_is_rendered_and_strict_refuses_what_is_not_supported() {
    let room = Room::new();
    let text = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 6\nWorldBegin\n\
        LightSource \"infinite\" \"rgb L\" [1 1 1]\nShape \"curve\"\n";
    std::fs::write(room.path("scene.pbrt"), text).unwrap();
    let warning = "scene.pbrt:4:1: not supported: Shape \"curve\": left out";
    let ran = room.run("check scene.pbrt").code(0);
    assert!(ran.out.contains("8 x 6 pixels") && ran.err.contains(warning), "{} {}", ran.out, ran.err);
    for command in ["check scene.pbrt --strict", "render scene.pbrt --strict -o strict.png"] {
        let ran = room.run(command).code(2);
        assert!(ran.err.contains("not supported: Shape \"curve\""), "{}", ran.err);
    }
    room.run("render scene.pbrt --set render.spp=1 -o white.png").code(0);
    assert_eq!(room.names(), ["scene.pbrt", "scene.toml", "white.png"]);
}

/// Files of a folder below scenes/ that have an extension, sorted.
fn files_of(folder: &str, extension: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(folder);
    let files = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files.filter(|file| file.extension().is_some_and(|e| e == extension)).collect();
    files.sort();
    assert!(files.len() >= 2, "{}", folder.display());
    files
}

#[test]
fn the_scenes_that_come_with_the_program_are_sound() {
    for scene in files_of("", "toml") {
        let ran = Room::new().run(&format!("check {} --json", scene.display())).code(0);
        let contents: Value = serde_json::from_str(&ran.out).unwrap();
        assert_eq!(contents["warnings"], json!([]), "{}", scene.display());
    }
}

#[test]
fn every_scene_is_in_the_gallery() {
    let names = |files: Vec<PathBuf>| -> Vec<String> {
        files.iter().map(|file| file.file_stem().unwrap().to_string_lossy().into_owned()).collect()
    };
    let (scenes, pictures) = (names(files_of("", "toml")), files_of("gallery", "png"));
    assert_eq!(scenes, names(pictures.clone()), "run tools/gallery, and commit what it writes");
    let manual = include_str!("../../scenes/README.md").split_once("\n## Gallery\n").unwrap().1;
    for (name, picture) in scenes.iter().zip(&pictures) {
        let (width, height) = crate::png_size(picture);
        let bytes = std::fs::metadata(picture).unwrap().len();
        assert!(width <= 320 && height <= 320 && bytes < 60_000, "{name}: {width} x {height}, {bytes} bytes");
        assert!(
            manual.contains(&format!("(gallery/{name}.png)]({name}.toml)")),
            "the manual does not show {name}; run tools/gallery"
        );
    }
}

#[test]
fn check_needs_no_driver() {
    let room = Room::new();
    let ran = room
        .program("check scene.toml")
        .env("VK_DRIVER_FILES", "/no")
        .env("VK_ICD_FILENAMES", "/no")
        .output();
    assert!(ran.unwrap().status.success());
}

#[test]
fn devices_are_listed_with_the_variables_of_the_loader() {
    let room = Room::new();
    let output = room.program("devices").env("VK_LOADER_DEBUG", "none").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    for word in ["0: ", "driver", "Vulkan", "storage buffer", "VK_LOADER_DEBUG=none"] {
        assert!(text.contains(word), "no `{word}` in {text}");
    }
    let output = room.program("devices --json").env("VK_LOADER_DEBUG", "none").output().unwrap();
    let list: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(list["variables"]["VK_LOADER_DEBUG"], "none");
    let device = &list["devices"][0];
    assert_eq!(device["index"], 0);
    assert!(device["limits"]["storage_buffer_bytes"].as_u64().unwrap() >= 1 << 27);
    assert!(!device["name"].as_str().unwrap().is_empty());
}

#[test]
fn a_lens_is_printed_and_drawn() {
    let room = Room::new();
    room.write("lens.dat", "# A singlet\n50 4 1.5 20 60\n-50 2 1 20\n0 0 0 9\n");
    let ran = room.run("lens lens.dat --focus 1000 --f-number 8 --svg lens.svg").code(0);
    for row in [
        "# A singlet",
        "surfaces               3",
        "focal length           50.6757 mm",
        "f-number               8.0000",
        "stop                   row 3, diameter 5.9",
        "focused on             1000.0000 mm from the film",
    ] {
        assert!(ran.out.contains(row), "no `{row}` in {}", ran.out);
    }
    let drawing = std::fs::read_to_string(room.path("lens.svg")).unwrap();
    assert!(drawing.starts_with("<svg ") && drawing.trim_end().ends_with("</svg>"));
    // An element, two fans of nine rays, the blades, the axis, the film, two principal planes
    assert_eq!(drawing.matches("<polygon ").count(), 1);
    assert!(drawing.matches("<polyline ").count() >= 23, "{drawing}");
    assert!(!drawing.contains("NaN") && !drawing.contains("inf"), "{drawing}");
    let ran = room.run("lens lens.dat --json").code(0);
    let lens: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(
        (&lens["stop_row"], &lens["dispersion"], &lens["focus"]),
        (&json!(3), &json!(true), &Value::Null)
    );
    assert!((lens["focal_length"].as_f64().unwrap() - 50.675_675_675).abs() < 1e-6);
    room.run("lens lens.dat --focus 10")
        .code(2)
        .err_has("the lens cannot focus on 10 mm in front of the film");
    room.run("lens lens.dat --f-number 1").code(2).err_has("the lens opens to f/");
    room.run("lens scene.toml").code(2).err_has("scene.toml:2: `[film]` is not a number");
    room.run("lens lens.dat --focus nan").code(2).err_has("write a number above 0");
}

#[test]
fn the_version_names_the_driver() {
    let room = Room::new();
    for flag in ["--version", "-V"] {
        let out = room.run(flag).code(0).out;
        assert!(out.starts_with(concat!("dapple ", env!("CARGO_PKG_VERSION"), "\ndevice: ")), "{out}");
        assert!(out.contains(", driver "), "{out}");
    }
}

#[test]
fn a_machine_without_a_driver_is_told_so() {
    let room = Room::new();
    let run = |arguments: &str| room.run_on("/nowhere.json", arguments);
    assert!(run("--version").code(0).out.contains("no Vulkan driver on this machine"));
    let ran = run("devices").code(1).err_has("error: no Vulkan driver on this machine");
    assert!(ran.out.contains("VK_DRIVER_FILES=/nowhere.json"), "{}", ran.out);
    assert_eq!(run("devices --json").code(1).event("error")["message"], "no Vulkan driver on this machine");
    run("render scene.toml").code(1).err_has("error: no Vulkan driver on this machine");
}
