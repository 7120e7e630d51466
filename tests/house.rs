//! The rooms of the house keep to their rows: which room uses which, where `unsafe` and `ash` may be, and how long a
//! file may get. The table of rooms is explained in `ARCHITECTURE.md`.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests may panic: that is how they fail"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms in `src/` and the rooms that each may name with `crate::`. All may use `error`.
const RUST_ROOMS: &[(&str, &[&str])] = &[
    ("lib", ALL),
    ("error", &[]),
    ("whole_file", &[]),
    ("layout", &[]),
    ("scene", &[]),
    ("import", &["scene"]),
    ("prepare", &["scene", "layout"]),
    ("shader", &[]),
    ("gpu", &["layout", "shader"]),
    ("export", &["scene", "whole_file"]),
    ("film", &["scene", "layout", "whole_file"]),
    ("diff", &["film", "import", "scene"]),
    ("render", &["prepare", "shader", "gpu", "film", "layout", "scene"]),
    ("live", &["import", "render", "shader", "gpu", "scene", "film"]),
    // The program: its own modules, and the public items of the library as `dapple::`.
    ("main", &["cli"]),
    ("cli", &["cli"]),
];

/// A row that may use every room.
const ALL: &[&str] = &["*"];

/// Rooms in `shaders/` and the rooms that each may include.
const SHADER_ROOMS: &[(&str, &[&str])] = &[
    ("stages", ALL),
    ("views", ALL),
    ("probe.comp", ALL),
    ("shared", &[]),
    ("base", &[]),
    ("geometry", &["base", "shared", "texture", "generated", "detail"]),
    ("camera", &["base", "shared", "texture", "generated"]),
    ("texture", &["base", "shared"]),
    ("generated", &["base", "shared", "texture"]),
    ("material", &["base", "shared", "texture", "generated"]),
    ("light", &["base", "shared", "texture", "generated", "detail"]),
    ("detail", &["base", "shared", "texture", "generated"]),
];

const MOST_GLSL_LINES: usize = 150;
const MOST_RUST_LINES: usize = 400;

/// Files that are longer, how long they may be, and why.
const LONG_FILES: &[(&str, usize, &str)] =
    &[("shaders/shared/layout.glsl", 1000, "written from src/layout; nobody reads it from top to bottom")];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Files under `folder` whose extension is one of `extensions`, sorted, with their path from the root.
fn files(folder: &str, extensions: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
            let path: PathBuf = entry.unwrap().path();
            if path.is_dir() {
                // What the fuzz targets are built into is not ours
                folders.extend((!path.ends_with("target")).then_some(path));
            } else if path.extension().is_some_and(|e| extensions.iter().any(|x| e == *x)) {
                let text = fs::read_to_string(&path).unwrap();
                let name = path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
                found.push((name, text));
            }
        }
    }
    found.sort();
    assert!(!found.is_empty(), "no files in {folder}");
    found
}

/// The room of a file: the first part of its path in `src/` or `shaders/`, without `.rs`.
fn room_of(file: &str) -> &str {
    let inside = file.split_once('/').map_or(file, |(_, rest)| rest);
    let first = inside.split('/').next().unwrap_or(inside);
    first.strip_suffix(".rs").unwrap_or(first)
}

/// Rust source without comments and string literals; lines stay where they are.
fn code_of(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        if rest.starts_with("//") {
            rest = rest.find('\n').map_or("", |end| &rest[end..]);
        } else if rest.starts_with("/*") {
            let end = rest.find("*/").map_or(rest.len(), |end| end + 2);
            out.extend(rest[..end].chars().filter(|c| *c == '\n'));
            rest = &rest[end..];
        } else if rest.starts_with("r#\"") {
            let end = rest[3..].find("\"#").map_or(rest.len(), |end| end + 5);
            out.extend(rest[..end].chars().filter(|c| *c == '\n'));
            rest = &rest[end..];
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\") {
            // A character: a quote, or an escape
            let end = rest[2..].find('\'').map_or(rest.len(), |end| end + 3);
            rest = &rest[end..];
        } else if c == '"' {
            let mut escaped = false;
            let end = rest[1..].find(|c| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            let end = end.map_or(rest.len(), |end| end + 2);
            out.extend(rest[..end].chars().filter(|c| *c == '\n'));
            rest = &rest[end..];
        } else {
            out.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}

/// Modules of the crate that Rust code names: `crate::room` and the members of `crate::{…}`, with their lines.
/// Names that begin with a capital are items of the crate's root (`Result`, `Error`).
fn rust_uses(code: &str) -> Vec<(usize, String)> {
    let mut uses = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let before = code[..at].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_') {
            continue;
        }
        let rest = &code[at + "crate::".len()..];
        for name in names_after(rest) {
            if name.starts_with(|c: char| c.is_lowercase()) {
                uses.push((line_of(code, at), name));
            }
        }
    }
    uses
}

/// First names of a path, or of every path of a group in braces.
fn names_after(path: &str) -> Vec<String> {
    let word =
        |text: &str| -> String { text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect() };
    let Some(group) = path.strip_prefix('{') else { return vec![word(path)] };
    let (mut names, mut depth, mut start) = (Vec::new(), 0, 0);
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(word(group[start..i].trim_start()));
                start = i + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// Rooms that GLSL source includes, with their lines.
fn glsl_includes(text: &str) -> Vec<(usize, String)> {
    let mut includes = Vec::new();
    for (i, line) in text.lines().enumerate() {
        if let Some(rest) = line.trim_start().strip_prefix("#include") {
            let name = rest.trim().trim_matches(['"', '<', '>']);
            includes.push((i + 1, name.split('/').next().unwrap_or(name).to_owned()));
        }
    }
    includes
}

/// What is wrong with the uses of one file.
fn violations(
    file: &str,
    uses: &[(usize, String)],
    rooms: &BTreeMap<&str, &[&str]>,
    free: &[&str],
) -> Vec<String> {
    let room = room_of(file);
    let Some(allowed) = rooms.get(room) else {
        return vec![format!("{file}: the room `{room}` has no row in tests/house.rs")];
    };
    let open = |used: &str| {
        used == room || free.contains(&used) || allowed.contains(&"*") || allowed.contains(&used)
    };
    uses.iter()
        .filter(|(_, used)| !open(used))
        .map(|(line, used)| format!("{file}:{line}: `{room}` may not use `{used}`"))
        .collect()
}

fn table(
    rows: &[(&'static str, &'static [&'static str])],
) -> BTreeMap<&'static str, &'static [&'static str]> {
    rows.iter().copied().collect()
}

/// Lines outside `src/gpu` that have the word `unsafe`, or name the crate `ash`.
fn stray_vulkan(file: &str, code: &str) -> Vec<String> {
    if room_of(file) == "gpu" {
        return Vec::new();
    }
    let words = |line: &str, wanted: &str| {
        line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == wanted)
    };
    let mut found = Vec::new();
    for (i, line) in code.lines().enumerate() {
        for word in ["unsafe", "ash"] {
            if words(line, word) {
                found.push(format!("{file}:{}: `{word}` belongs to src/gpu", i + 1));
            }
        }
    }
    found
}

fn report(problems: &[String]) {
    assert!(problems.is_empty(), "the house is not in order:\n{}", problems.join("\n"));
}

#[test]
fn rust_rooms_use_only_what_their_rows_allow() {
    let rooms = table(RUST_ROOMS);
    let mut problems = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        problems.extend(violations(&file, &rust_uses(&code_of(&text)), &rooms, &["error"]));
    }
    report(&problems);
}

#[test]
fn shader_rooms_include_only_what_their_rows_allow() {
    let rooms = table(SHADER_ROOMS);
    let mut problems = Vec::new();
    for (file, text) in files("shaders", &["glsl", "comp"]) {
        problems.extend(violations(&file, &glsl_includes(&text), &rooms, &[]));
    }
    report(&problems);
}

#[test]
fn unsafe_code_and_vulkan_are_in_one_room() {
    let mut problems = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        problems.extend(stray_vulkan(&file, &code_of(&text)));
    }
    report(&problems);
}

#[test]
fn every_room_has_a_row_and_every_row_a_room() {
    for (folder, rows, extensions, virtual_rooms) in [
        ("src", RUST_ROOMS, ["rs"].as_slice(), ["cli"].as_slice()),
        ("shaders", SHADER_ROOMS, ["glsl", "comp"].as_slice(), ["generated", "probe.comp"].as_slice()),
    ] {
        let names = files(folder, extensions);
        let rooms: BTreeSet<&str> = names.iter().map(|(file, _)| room_of(file)).collect();
        let rows: BTreeSet<&str> = rows.iter().map(|(room, _)| *room).collect();
        let missing: Vec<_> = rooms.difference(&rows).collect();
        assert!(missing.is_empty(), "{folder}: rooms without a row in tests/house.rs: {missing:?}");
        let empty: Vec<_> = rows.difference(&rooms).filter(|room| !virtual_rooms.contains(room)).collect();
        assert!(empty.is_empty(), "{folder}: rows of tests/house.rs without a room: {empty:?}");
    }
}

#[test]
fn a_file_is_one_idea() {
    let limits: BTreeMap<&str, usize> = LONG_FILES.iter().map(|(file, lines, _)| (*file, *lines)).collect();
    let mut problems = Vec::new();
    let mut all = files("shaders", &["glsl", "comp"]);
    all.extend(files("src", &["rs"]));
    all.extend(files("tests", &["rs"]));
    for (file, text) in &all {
        let usual = if file.ends_with(".rs") { MOST_RUST_LINES } else { MOST_GLSL_LINES };
        let (lines, most) = (text.lines().count(), limits.get(file.as_str()).copied().unwrap_or(usual));
        if lines > most {
            problems.push(format!("{file}: {lines} lines, at most {most}"));
        } else if lines <= usual && limits.contains_key(file.as_str()) {
            problems.push(format!("{file}: {lines} lines, needs no exception any more"));
        }
    }
    for (file, _, _) in LONG_FILES {
        if !all.iter().any(|(name, _)| name == file) {
            problems.push(format!("{file}: has an exception and is not there"));
        }
    }
    report(&problems);
}

#[test]
fn the_readers_of_this_test_see_what_is_there() {
    let source = "//! crate::gpu\nuse crate::{Error, scene::{Mesh, x}, layout};\nlet s = \"crate::film\";\n\
                  let q = '\"'; crate::prepare::run(mycrate::gpu); /* crate::gpu */ let t = r#\"crate::gpu\"#;\n";
    let uses = rust_uses(&code_of(source));
    let expected = [(2, "scene"), (2, "layout"), (4, "prepare")];
    assert_eq!(uses, expected.map(|(line, room)| (line, room.to_owned())));
    assert_eq!(
        glsl_includes("// x\n#include \"base/math.glsl\"\n  #include <shared/fetch.glsl>\n"),
        [(2, "base".to_owned()), (3, "shared".to_owned())]
    );
    assert_eq!(room_of("src/error.rs"), "error");
    assert_eq!(room_of("src/import/toml/mod.rs"), "import");
    assert_eq!(room_of("shaders/probe.comp"), "probe.comp");
}

#[test]
fn a_house_in_disorder_is_refused() {
    let rooms = table(RUST_ROOMS);
    let wrong = violations("src/scene/mesh.rs", &rust_uses("use crate::gpu::Gpu;"), &rooms, &["error"]);
    assert_eq!(wrong, ["src/scene/mesh.rs:1: `scene` may not use `gpu`"]);
    assert_eq!(violations("src/cellar/a.rs", &[], &rooms, &[]).len(), 1);
    let shaders = table(SHADER_ROOMS);
    let wrong =
        violations("shaders/base/math.glsl", &glsl_includes("#include \"light/light.glsl\""), &shaders, &[]);
    assert_eq!(wrong, ["shaders/base/math.glsl:1: `base` may not use `light`"]);
    assert_eq!(
        stray_vulkan("src/render/mod.rs", "use ash::vk;\nunsafe { f() }\nlet unsafely = crash;").len(),
        2
    );
    assert!(stray_vulkan("src/gpu/mod.rs", "use ash::vk;").is_empty());
}

#[test]
fn every_crate_has_its_reason() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let (mut wanted, mut section) = (BTreeSet::new(), "");
    for line in manifest.lines() {
        if line.starts_with('[') {
            section = line.trim();
        } else if section.ends_with("dependencies]")
            && let Some((name, _)) = line.split_once(" = ")
        {
            wanted.insert(name.to_owned());
        }
    }
    assert!(wanted.contains("ash") && wanted.contains("proptest"), "{wanted:?}");
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let (_, crates) = text.split_once("\n## Crates\n").expect("ARCHITECTURE.md has a section Crates");
    let rows = crates.lines().skip_while(|line| !line.starts_with("|---")).skip(1);
    let given: BTreeSet<String> =
        rows.filter_map(|row| row.split('|').nth(1)).map(|name| name.trim().to_owned()).collect();
    assert_eq!(given, wanted, "the table in ARCHITECTURE.md and Cargo.toml differ");
}
