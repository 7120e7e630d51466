//! `dapple shaders`.

use crate::Room;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Once;

/// Files below a folder: name and bytes.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let (mut found, mut open) = (BTreeMap::new(), vec![folder.to_owned()]);
    while let Some(at) = open.pop() {
        for entry in std::fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_string_lossy().replace('\\', "/");
                found.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    found
}

fn own(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(name)).unwrap()
}

/// How many kernels there are.
fn kernels() -> usize {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let files =
        ["stages", "views"].into_iter().flat_map(|room| std::fs::read_dir(shaders.join(room)).unwrap());
    files.filter(|file| file.as_ref().unwrap().path().extension().is_some_and(|kind| kind == "comp")).count()
}

/// The files of the program are sound, and all that is known of them is in the cache from then on.
fn check_the_exported() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let room = Room::new();
        room.run("shaders export mine").code(0);
        let ran = room.run("shaders check mine").code(0).err_has(" variants, 0 errors, ");
        assert_eq!(ran.out, "");
        assert!(ran.err.starts_with(&format!("{} kernels, ", kernels())), "{}", ran.err);
    });
}

/// A room with some files of the program in `mine`, changed.
fn room(files: &[(&str, &str, &str)]) -> Room {
    check_the_exported();
    let room = Room::new();
    for (name, from, to) in files {
        let text = own(name);
        assert_eq!(text.matches(from).count(), 1, "{name}: {from}");
        let path = room.path("mine").join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text.replace(from, to)).unwrap();
    }
    room
}

/// Line and column of a text in a file of the program, as it is after a change.
fn place(files: &[(&str, &str, &str)], name: &str, word: &str) -> String {
    let (_, from, to) = files.iter().find(|(file, ..)| *file == name).unwrap();
    let text = own(name).replace(from, to);
    let before = text.split_once(word).unwrap().0;
    let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
    format!("mine/{name}:{}:{column}", before.matches('\n').count() + 1)
}

#[test]
fn what_is_exported_is_what_is_in_the_program_and_sound() {
    check_the_exported();
    let room = Room::new();
    let sound = tree(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"));
    let count = format!("wrote {} files into mine/shaders, ", sound.len());
    room.run("shaders export mine/shaders").code(0).err_has(&count).err_has("--shaders mine/shaders");
    assert_eq!(tree(&room.path("mine/shaders")), sound);
    room.write("mine/shaders/base/math.glsl", "// changed");
    std::fs::remove_file(room.path("mine/shaders/stages/film.comp")).unwrap();
    room.run("shaders export mine/shaders").code(1).err_has("this is there already and is not replaced");
    assert_eq!(std::fs::read(room.path("mine/shaders/base/math.glsl")).unwrap(), b"// changed");
    assert!(!room.path("mine/shaders/stages/film.comp").exists());
    room.run("shaders export mine/shaders --force").code(0);
    assert_eq!(tree(&room.path("mine/shaders")), sound);
    room.run("shaders export scene.toml").code(1).err_has("cannot make the folder");
}

#[test]
fn an_error_in_a_file_that_every_kernel_has_is_told_once() {
    let line = "const float PI = ";
    let files = [("base/math.glsl", line, "cosnt float PI = ")];
    let ran = room(&files).run("shaders check mine").code(1).err_has(" variants, 1 error, ");
    let place = place(&files, "base/math.glsl", "cosnt").rsplit_once(':').unwrap().0.to_owned();
    assert_eq!(ran.out.lines().count(), 1, "{}", ran.out);
    assert!(ran.out.starts_with(&format!("{place}:")) && ran.out.contains(": error: "), "{}", ran.out);
}

#[test]
fn all_errors_are_told_and_files_that_nothing_reads() {
    let (ray, sampling) = ("#include \"camera/ray.glsl\"", "#include \"base/sampling.glsl\"");
    let a = format!("{ray}\nfloat a() {{ return 1.0 + wrong_a; }}");
    let b = format!("{sampling}\n/* ä */ float b() {{ return wrong_b; }}");
    let files = [("camera/panorama.glsl", ray, a.as_str()), ("camera/opening.glsl", sampling, b.as_str())];
    let room = room(&files);
    room.write("mine/camera/apenture.glsl", "");
    room.write("mine/camera/thinlens.glsl", "");
    room.write("mine/notes.txt", "");
    let ran = room.run("shaders check mine").code(1);
    let error = |name: &str, word: &str| {
        format!("{}: error: '{word}': undeclared identifier", place(&files, name, word))
    };
    let expected = [
        error("camera/opening.glsl", "wrong_b"),
        error("camera/panorama.glsl", "wrong_a"),
        "mine/camera/apenture.glsl:1:1: warning: no kernel reads this file".to_owned(),
        "mine/camera/thinlens.glsl:1:1: warning: no kernel reads this file; did you mean `camera/thin_lens.glsl`?"
            .to_owned(),
    ];
    assert_eq!(ran.out.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn an_include_of_nothing_names_the_line_that_asks_for_it() {
    let line = "#include \"stages/film.glsl\"";
    let files = [("stages/film.comp", line, "#include \"stages/film.glsl\"\n#include \"base/gone.glsl\"")];
    let room = room(&files);
    let ran = room.run("shaders check mine --json").code(1);
    let problem = ran.event("problem");
    let found = format!("{}:{}:{}", problem["file"].as_str().unwrap(), problem["line"], problem["column"]);
    assert_eq!(found, place(&files, "stages/film.comp", "base/gone.glsl"));
    assert_eq!(problem["severity"], "error");
    assert!(problem["message"].as_str().unwrap().starts_with("cannot include `base/gone.glsl`: "));
    assert!(problem["kernel"].as_str().unwrap().starts_with("stages/film.comp "));
    let checked = ran.event("checked");
    assert_eq!(
        (&checked["kernels"], &checked["errors"], &checked["warnings"]),
        (&json!(kernels()), &json!(1), &json!(0))
    );
    assert!(checked["variants"].as_u64().unwrap() > 300);
    assert_eq!(ran.events().last().map(|last: &Value| last["event"].clone()), Some(json!("error")));
}

#[test]
fn what_is_checked_is_also_what_kernels_may_use() {
    let own =
        "layout(std430, set = 0, binding = 60) buffer Own { uint g_own[]; };\nvoid main()\n{ g_own[0] = 1u;";
    let room = room(&[("stages/advance.comp", "void main()\n{", own)]);
    let ran = room.run("shaders check mine").code(1);
    let expected = "mine/stages/advance.comp:1:1: error: the kernel uses set 0, binding 60 as a storage buffer, but no such";
    assert!(ran.out.starts_with(expected), "{}", ran.out);
    let ran = room.run("shaders check nowhere").code(2).err_has("cannot open the folder of shaders");
    assert_eq!(ran.out, "");
}

#[test]
fn check_needs_no_driver() {
    check_the_exported();
    let room = room(&[("stages/advance.comp", "void main()", "void main()")]);
    let mut program = room.program("shaders check mine");
    let output = program.env("VK_DRIVER_FILES", "/no").env("VK_ICD_FILENAMES", "/no").output().unwrap();
    crate::Ran::from(output).code(0);
}
