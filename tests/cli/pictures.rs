//! What comes out of `dapple render`.

use crate::{Planes, Ran, Room, png_size};

#[test]
fn a_png_is_named_after_the_scene() {
    let room = Room::new();
    let ran = room.run("render scene.toml").code(0).err_has("scene.png: 16 x 12 pixels, 8 samples a pixel");
    assert_eq!(ran.out, "");
    assert_eq!(png_size(&room.path("scene.png")), (16, 12));
    assert_eq!(room.names(), ["scene.png", "scene.toml"]);
}

#[test]
fn the_extension_chooses_exr() {
    let room = Room::new();
    room.run("render scene.toml -o a.EXR").code(0);
    let exr = Planes::read(&room.path("a.EXR"));
    assert_eq!((exr.width, exr.height), (16, 12));
    assert!(exr.plane("samples").iter().all(|&n| n == 8.0));
    assert!(exr.plane("G").iter().all(|&g| g.is_finite() && g > 0.0));
}

#[test]
fn the_same_command_gives_the_same_bytes() {
    let room = Room::new();
    for name in ["a.exr", "b.exr", "a.png", "b.png"] {
        room.run(&format!("render scene.toml -o {name} --spp 8")).code(0);
    }
    room.run("render scene.toml -o c.exr --seed 7").code(0);
    let bytes = |name: &str| std::fs::read(room.path(name)).unwrap();
    assert_eq!(bytes("a.exr"), bytes("b.exr"));
    assert_eq!(bytes("a.png"), bytes("b.png"));
    assert_ne!(bytes("a.exr"), bytes("c.exr"), "the seed changes nothing");
}

#[test]
fn first_sample_continues_where_another_render_ended() {
    let room = Room::new();
    room.run("render scene.toml -o all.exr --spp 8 --quiet").code(0);
    room.run("render scene.toml -o a.exr --spp 4 --quiet").code(0);
    room.run("render scene.toml -o b.exr --spp 4 --first-sample 4 --quiet").code(0);
    let [all, a, b] = ["all.exr", "a.exr", "b.exr"].map(|name| Planes::read(&room.path(name)));
    let (all, a, b) = (all.plane("R"), a.plane("R"), b.plane("R"));
    assert_ne!(a, b);
    for i in 0..all.len() {
        // Means of four halve the mean of eight exactly but for the rounding of each to a float.
        let error = (all[i] - 0.5 * (a[i] + b[i])).abs();
        assert!(error <= 2.0 * f32::EPSILON * all[i], "pixel {i}: off by {error}");
    }
}

#[test]
fn size_and_crop_change_the_picture() {
    let room = Room::new();
    room.run("render scene.toml --size 24x10 -o size.png --spp 1").code(0);
    assert_eq!(png_size(&room.path("size.png")), (24, 10));
    room.run("render scene.toml -o full.exr").code(0);
    room.run("render scene.toml -o crop.exr --crop 3,2,13,11").code(0);
    let [full, crop] = ["full.exr", "crop.exr"].map(|name| Planes::read(&room.path(name)));
    assert_eq!((crop.width, crop.height), (10, 9));
    for y in 0..crop.height {
        let at = (y + 2) * full.width + 3;
        assert_eq!(crop.plane("R")[y * 10..y * 10 + 10], full.plane("R")[at..at + 10], "row {y}");
    }
}

#[test]
fn a_pixel_is_that_of_the_whole_picture() {
    let room = Room::new();
    room.run("render scene.toml -o full.exr").code(0);
    let full = Planes::read(&room.path("full.exr"));
    // On the sphere, and in the sky, where depth is infinite.
    for (x, y) in [(8, 5), (0, 0)] {
        let words = room.run(&format!("render scene.toml --pixel {x},{y} --quiet")).code(0);
        let ran = room.run(&format!("render scene.toml --pixel {x},{y} --json")).code(0);
        let (event, at) = (ran.event("pixel"), y * full.width + x);
        let number = |value: &serde_json::Value| value.as_f64().unwrap() as f32;
        let triples = [
            ("rgb", ["R", "G", "B"]),
            ("albedo", ["albedo.R", "albedo.G", "albedo.B"]),
            ("normal", ["normal.X", "normal.Y", "normal.Z"]),
            ("variance", ["variance.R", "variance.G", "variance.B"]),
        ];
        for (key, planes) in triples {
            let expected = full.three(planes, at);
            assert_eq!([0, 1, 2].map(|c| number(&event[key][c])), expected, "{key}");
            assert_eq!(word_values(&words, key), expected, "{key}");
        }
        assert_eq!(event["samples"], 8);
        let depth = full.plane("depth.Z")[at];
        assert_eq!(word_values(&words, "depth"), [depth]);
        assert_eq!(event["depth"].as_f64().map_or(f32::INFINITY, |d| d as f32), depth);
    }
    assert_eq!(room.names(), ["full.exr", "scene.toml"], "a picture was not asked for");
    room.run("render scene.toml --pixel 8,5 --quiet -o pixel.png").code(0);
    assert_eq!(png_size(&room.path("pixel.png")), (1, 1));
}

/// The numbers of a row of the text of `--pixel`.
fn word_values(ran: &Ran, key: &str) -> Vec<f32> {
    let row = ran.out.lines().find(|line| line.starts_with(key)).unwrap();
    row.split_whitespace().skip(1).map(|word| word.parse().unwrap()).collect()
}

/// An orange ball that needs no light in front of a bright sky: edges, and pixels of one kind each.
const BALL: &str = r#"
[film]
size = [16, 12]
transparent = true
filter = "gaussian"

[camera]
position = [0, 0, 5]
target = [0, 0, 0]

[material.ball]
kind = "unlit"
color = [0.5, 0.25, 0.125]

[[shape]]
kind = "sphere"
radius = 1
material = "ball"

[environment]
color = 20
"#;

#[test]
fn a_transparent_film_has_no_sky_in_it() {
    let room = Room::new();
    room.write("ball.toml", BALL);
    for name in ["ball.exr", "ball.png"] {
        room.run(&format!("render ball.toml -o {name} --spp 16")).code(0);
    }
    let (exr, png) = (Planes::read(&room.path("ball.exr")), image::open(room.path("ball.png")).unwrap());
    let png = png.as_rgba8().unwrap();
    let mut kinds = [0; 3];
    for (i, pixel) in png.pixels().enumerate() {
        let (alpha, rgb) = (exr.plane("A")[i], exr.three(["R", "G", "B"], i));
        // Premultiplied in the EXR
        for (c, color) in [0.5, 0.25, 0.125].into_iter().enumerate() {
            assert!((rgb[c] - alpha * color).abs() < 1e-6, "pixel {i}: {rgb:?} at alpha {alpha}");
        }
        // Straight in the PNG: the same colour wherever there is any. 0.5 is 188, 0.25 is 137, 0.125 is 99
        let [r, g, b, a] = pixel.0;
        assert_eq!(f32::from(a), (alpha * 255.0).round(), "pixel {i}");
        assert_eq!([r, g, b], if alpha > 0.0 { [188, 137, 99] } else { [0; 3] }, "pixel {i}");
        kinds[if alpha == 0.0 {
            0
        } else if alpha < 1.0 {
            1
        } else {
            2
        }] += 1;
    }
    assert!(kinds.iter().all(|&n| n >= 10), "sky, edges, ball: {kinds:?}");

    // What the sky lights and what a mirror shows of it stays
    let mirror = BALL
        .replace("kind = \"unlit\"\ncolor = [0.5, 0.25, 0.125]", "kind = \"conductor\"\nfresnel = \"none\"");
    room.write("ball.toml", &mirror);
    room.run("render ball.toml -o ball.exr --spp 4").code(0);
    let exr = Planes::read(&room.path("ball.exr"));
    for (rgb, alpha) in exr.plane("G").iter().zip(exr.plane("A")) {
        assert!((rgb - alpha * 18.0).abs() < 1e-4, "{rgb} at alpha {alpha}");
    }
    // An opaque film shows it everywhere
    room.run("render ball.toml -o ball.exr --spp 4 --set film.transparent=false").code(0);
    assert_eq!(Planes::read(&room.path("ball.exr")).plane("G")[0], 20.0);
}

#[test]
fn settings_change_the_scene() {
    let room = Room::new();
    let ran = room.run("render scene.toml --set film.size=[5,4] --set render.spp=3 --json").code(0);
    assert_eq!(ran.event("start")["size"], serde_json::json!([5, 4]));
    assert_eq!(ran.event("done")["spp"], 3);
    assert_eq!(png_size(&room.path("scene.png")), (5, 4));
}

#[test]
fn events_tell_the_whole_render() {
    let room = Room::new();
    let ran = room.run("render scene.toml --json -o a.png --seed 3").code(0);
    let kinds: Vec<String> =
        ran.events().iter().map(|event| event["event"].as_str().unwrap().to_owned()).collect();
    assert_eq!(kinds.first().unwrap(), "start");
    assert_eq!(kinds.last().unwrap(), "done");
    assert!(kinds.iter().any(|kind| kind == "progress"));
    let start = ran.event("start");
    assert!(!start["device"].as_str().unwrap().is_empty() && !start["driver"].as_str().unwrap().is_empty());
    assert_eq!(start["seed"], 3);
    let done = ran.event("done");
    assert_eq!((&done["file"], &done["spp"]), (&"a.png".into(), &8.into()));
    assert_eq!((&done["left_out"], &done["clamped"]), (&0.into(), &0.into()));
    assert!(done["seconds"].as_f64().unwrap() > 0.0 && done["stopped_by"].is_null());
}

#[test]
fn quiet_says_nothing() {
    let room = Room::new();
    room.write("scene.toml", &scene_with_warning());
    let ran = room.run("render scene.toml --quiet").code(0);
    assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", ""));
    room.run("render scene.toml").code(0).err_has("warning: scene.toml:");
    let ran = room.run("render scene.toml --json").code(0);
    assert_eq!(ran.event("warning")["place"]["file"], "scene.toml");
}

/// A material that nothing uses.
fn scene_with_warning() -> String {
    format!("{}\n[material.unused]\nkind = \"diffuse\"\n", crate::SCENE)
}

#[test]
fn samples_that_are_not_finite_are_counted() {
    let room = Room::new();
    let sound = include_str!("../../shaders/stages/film.glsl");
    let line = "vec3 radiance = uintBitsToFloat(word.xyz) * frame.radiance_scale;";
    assert!(sound.contains(line), "the film kernel has changed: choose another line to break");
    std::fs::create_dir_all(room.path("shaders/stages")).unwrap();
    room.write(
        "shaders/stages/film.glsl",
        &sound.replace(line, "vec3 radiance = vec3(uintBitsToFloat(0x7fc00000u));"),
    );
    room.run("render scene.toml --shaders shaders")
        .code(0)
        .err_has("warning: 1536 of 1536 samples were not finite");
    let ran = room.run("render scene.toml --shaders shaders --json").code(0);
    assert_eq!(ran.event("done")["left_out"], 1536);
    assert!(ran.event("done")["stopped_by"].is_null());
}

#[test]
fn the_first_pixel_that_is_not_finite_comes_with_its_command() {
    let room = Room::new();
    let sound = include_str!("../../shaders/stages/film.glsl");
    let line = "vec3 radiance = uintBitsToFloat(word.xyz) * frame.radiance_scale;";
    let broken = "vec3 radiance = uintBitsToFloat(word.xyz) * frame.radiance_scale;
        uvec2 at = slot_place(slot).pixel;
        if (at == uvec2(5u, 7u) || at == uvec2(2u, 9u)) radiance.y = uintBitsToFloat(0x7fc00000u);";
    assert!(sound.contains(line), "the film kernel has changed: choose another line to break");
    std::fs::create_dir_all(room.path("shaders/stages")).unwrap();
    room.write("shaders/stages/film.glsl", &sound.replace(line, broken));
    let arguments = "render scene.toml --shaders shaders --crop 1,2,15,12 --first-sample 3 -o a.png";
    let repeat = "dapple render scene.toml --shaders shaders --pixel 5,7 --first-sample 3";
    let ran = room.run(arguments).code(0);
    let ran =
        ran.err_has("16 of 1120 samples were not finite and are left out, the first of them in pixel 5,7");
    ran.err_has(&format!("repeat with: {repeat}\n"));
    assert_eq!(
        room.run(&format!("{arguments} --json")).code(0).event("done")["repeat"],
        repeat.replace("--shaders shaders", "--shaders shaders --json")
    );
    // The command does what it says, and writes no picture
    std::fs::remove_file(room.path("a.png")).unwrap();
    room.run(repeat.strip_prefix("dapple ").unwrap()).code(0).err_has("8 of 8 samples were not finite");
    assert_eq!(room.names(), ["scene.toml", "shaders"]);
    assert!(room.run("render scene.toml --json").code(0).event("done")["repeat"].is_null());
}

#[test]
fn a_view_is_a_picture_of_its_own() {
    let room = Room::new();
    let dark = "--set film.exposure=-9 --set film.tone_curve=agx --set film.transparent=true";
    room.run(&format!("render scene.toml --view normals {dark} --spp 1 --quiet")).code(0);
    assert_eq!(room.names(), ["scene.normals.png", "scene.toml"]);
    let picture = image::open(room.path("scene.normals.png")).unwrap();
    assert_eq!(picture.color(), image::ColorType::Rgb8);
    // The floor looks up: 0.5, 1, 0.5 by the curve of sRGB
    assert_eq!(picture.to_rgb8().get_pixel(0, 11).0, [188, 255, 188]);
    // One pixel of it, by its values
    let ran = room.run("render scene.toml --view normals --pixel 0,11 --spp 1 --quiet").code(0);
    assert!(ran.out.contains("rgb      0.5 1 0.5"), "{}", ran.out);
}

#[test]
fn the_view_of_samples_that_are_not_finite_has_all_of_them() {
    let room = Room::new();
    let sound = include_str!("../../shaders/stages/shade.comp");
    let line = "path.flags |= PATH_COVERED;";
    assert!(sound.contains(line), "the kernel has changed: choose another line to break");
    std::fs::create_dir_all(room.path("shaders/stages")).unwrap();
    let broken = format!("{line} path.radiance.y = uintBitsToFloat(0x7fc00000u);");
    room.write("shaders/stages/shade.comp", &sound.replace(line, &broken));
    let arguments = "render scene.toml --shaders shaders --crop 0,10,16,12 -o a.png";
    room.run(arguments).code(0).err_has("256 of 256 samples were not finite and are left out");
    let view = format!("{arguments} --view non-finite");
    room.run(&view).code(0).err_has("256 of 256 samples were not finite and are marked");
    assert_eq!(image::open(room.path("a.png")).unwrap().to_rgb8().get_pixel(3, 1).0, [255, 0, 255]);
    assert!(room.run(&format!("{view} --json")).code(0).event("done")["stopped_by"].is_null());
}
