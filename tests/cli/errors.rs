//! What goes wrong, with its words and exit codes.

use crate::Room;
use std::fs::File;

#[test]
fn wrong_usage_exits_with_2() {
    let room = Room::new();
    room.run("").code(2).err_has("Usage: dapple");
    room.run("paint scene.toml").code(2).err_has("unrecognized subcommand 'paint'");
    room.run("render").code(2).err_has("<SCENE>");
    room.run("render scene.toml --size 0x4").code(2).err_has("width and height are from 1 to 16384 pixels");
    room.run("render scene.toml --size 16385x4")
        .code(2)
        .err_has("width and height are from 1 to 16384 pixels");
    room.run("render scene.toml --crop 4,4,4,8").code(2).err_has("the crop is empty");
    room.run("render scene.toml --set film").code(2).err_has("write key=value");
    room.run("render scene.toml --spp 0").code(2).err_has("0 is not in 1..=1048576");
    room.run("render scene.toml --time-limit -1").code(2);
    room.run("render scene.toml --view depths")
        .code(2)
        .err_has("[possible values: normals, uv, objects, materials,");
    room.run("render scene.toml --pixel 1,1 --crop 0,0,2,2").code(2).err_has("cannot be used with");
    room.run("render scene.toml --crop 0,0,17,2")
        .code(2)
        .err_has("error: --crop 0,0,17,2 is not inside the picture of 16 x 12 pixels");
    room.run("render scene.toml --pixel 16,0").code(2).err_has("error: --pixel 16,0 is not inside");
    room.run("render scene.toml --first-sample 4294967295").code(2).err_has("give a smaller --first-sample");
    room.run("render scene.toml --set render.spp=2000000")
        .code(2)
        .err_has("`spp` is 2000000, must be from 1 to 1048576");
    assert_eq!(room.names(), ["scene.toml"]);
}

#[test]
fn a_wrong_key_is_shown_in_its_line() {
    let room = Room::new();
    room.write("scene.toml", &crate::SCENE.replace("fov = 35", "  fvo = 35"));
    for command in ["render", "check"] {
        let ran = room.run(&format!("{command} scene.toml")).code(2);
        assert_eq!(ran.out, "");
        let ran = ran.err_has("error: scene.toml:11:3: unknown key `fvo` in [camera]");
        ran.err_has("11 │   fvo = 35\n    ·   ───\n").err_has("help: did you mean `fov`?");
        let ran = room.run(&format!("{command} scene.toml --json")).code(2);
        assert_eq!(ran.err, "");
        let error = ran.event("error");
        assert_eq!(error["message"], "unknown key `fvo` in [camera]");
        assert_eq!(error["help"], "did you mean `fov`?");
        assert_eq!(error["place"], serde_json::json!({ "file": "scene.toml", "line": 11, "column": 3 }));
    }
}

#[test]
fn glsl_of_ones_own_is_compiled_by_its_own_lines() {
    let room = Room::new();
    let texture = "\n[texture.own]\nkind = \"glsl\"\nfile = \"own.glsl\"\n";
    room.write(
        "scene.toml",
        &(crate::SCENE.replace("color = 0.6", "color = { texture = \"own\" }") + texture),
    );
    room.write("part.glsl", "float part(float x)\n{\n    return x * missing;\n}\n");
    let color = "vec4 color(TextureContext context) { return vec4(part(context.uv.x)); }\n";
    room.write("own.glsl", &format!("// first\n#include \"part.glsl\"\n{color}"));
    for command in ["render", "check"] {
        let ran = room.run(&format!("{command} scene.toml")).code(2);
        ran.err_has("error: part.glsl:3: 'missing': undeclared identifier");
    }
    room.write("part.glsl", "float part(float x) { return x; }\n");
    room.write("own.glsl", &format!("// first\n#include \"part.glsl\"\n{}", color.replace("uv.x", "uvw")));
    room.run("check scene.toml").code(2).err_has("error: own.glsl:3: ");
    room.write("own.glsl", &format!("#include \"part.glsl\"\n{color}"));
    room.run("check scene.toml").code(0);
}

#[test]
fn a_missing_scene_and_wrong_settings_exit_with_2() {
    let room = Room::new();
    room.run("render nowhere.toml").code(2).err_has("error: nowhere.toml: ");
    room.run("check nowhere.toml").code(2).err_has("error: nowhere.toml: ");
    room.run("render .").code(2);
    room.run("render scene.toml --set film.sise=[4,4]")
        .code(2)
        .err_has("error: --set film.sise=[4,4]: unknown key `sise` in [film]");
    std::fs::write(room.path("scene.toml"), b"[film]\n\xff\xfe\n").unwrap();
    room.run("render scene.toml").code(2).err_has("error: scene.toml");
}

#[test]
fn an_output_that_cannot_be_written_is_told_before_the_render() {
    let room = Room::new();
    room.run("render scene.toml -o a.bmp")
        .code(2)
        .err_has("error: a.bmp: no picture format has the extension `bmp`");
    room.run("render scene.toml -o /dev/full").code(2).err_has("end the name in .png or .exr");
    room.run("render scene.toml -o missing/a.png").code(1).err_has("make the folder first");
    std::fs::create_dir(room.path("folder.png")).unwrap();
    room.run("render scene.toml -o folder.png").code(1).err_has("name a file with -o, not a folder");
    let ran = room.run("render scene.toml -o missing/a.png --json").code(1);
    assert_eq!(ran.events().len(), 1, "nothing else was begun");
    assert_eq!(ran.event("error")["place"]["file"], "missing/a.png");
    assert_eq!(room.names(), ["folder.png", "scene.toml"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_standard_output_is_an_error_and_a_closed_one_is_none() {
    let room = Room::new();
    for arguments in
        ["render scene.toml --json", "render scene.toml --pixel 1,1", "devices", "check scene.toml"]
    {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = room.program(arguments).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments}");
        let err = String::from_utf8(output.stderr).unwrap();
        assert!(err.contains("error: cannot write to the standard output: No space left"), "{err}");

        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = room.program(arguments).stdout(writer).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments}");
    }
}

#[test]
fn errors_in_shaders_name_the_file_of_the_user() {
    let room = Room::new();
    room.run("render scene.toml --shaders nowhere").code(2).err_has("cannot open the folder of shaders");
    std::fs::create_dir_all(room.path("mine/camera")).unwrap();
    room.run("render scene.toml --shaders mine")
        .code(2)
        .err_has("error: mine: no file in this folder has the name of a shader of dapple")
        .err_has("with a file such as mine/base/");
    room.write("mine/camera/thin_lens.glsl", "// first line\nfloat f() { return lens_u10; }\n");
    room.run("render scene.toml --shaders mine")
        .code(1)
        .err_has("mine/camera/thin_lens.glsl:2: ")
        .err_has("lens_u10")
        .err_has("2 │ float f() { return lens_u10; }");
}

#[test]
fn shaders_of_the_user_keep_to_the_table_of_bindings() {
    let room = Room::new();
    let sound = include_str!("../../shaders/stages/advance.comp");
    let (head, body) = sound.split_once("void main()\n{").unwrap();
    let own = "layout(std430, set = 0, binding = 60) buffer Own { uint g_own[]; };";
    std::fs::create_dir_all(room.path("mine/stages")).unwrap();
    room.write("mine/stages/advance.comp", &format!("{head}{own}\nvoid main()\n{{ g_own[0] = 1u;{body}"));
    room.run("render scene.toml --shaders mine")
        .code(1)
        .err_has("mine/stages/advance.comp")
        .err_has("the kernel uses set 0, binding 60 as a storage buffer, but no such binding is bound")
        .err_has("shared/bindings.glsl");
}

#[test]
fn a_device_that_is_not_there_is_told_with_those_that_are() {
    let room = Room::new();
    room.run("bench --device nonsense").code(2).err_has("error: no device `nonsense`");
    room.run("render scene.toml --device nonsense")
        .code(2)
        .err_has("error: no device `nonsense`")
        .err_has("there are 0: ");
    room.run("render scene.toml --device 99").code(2).err_has("error: no device `99`");
    room.run("render scene.toml --device 0 --spp 1").code(0);
    let devices: serde_json::Value = serde_json::from_str(&room.run("devices --json").code(0).out).unwrap();
    let has_gpu =
        devices["devices"].as_array().unwrap().iter().any(|d| d["type"] != "CPU" && d["unfit"].is_null());
    if has_gpu {
        room.run("render scene.toml --require-gpu --spp 1").code(0);
    } else {
        room.run("render scene.toml --require-gpu").code(1).err_has("no fitting GPU on this machine");
    }
}
