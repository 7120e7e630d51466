//! `scenes/README.md` explains the keys that the reader knows, and its example is a scene.

use super::super::keys::{self, Kinds};
use super::{ALL, read};
use std::collections::BTreeSet;

/// All keys of the language, with the table they are in.
fn every_key() -> BTreeSet<(&'static str, &'static str)> {
    let plain = [
        ("include", keys::TOP),
        ("[film]", keys::FILM),
        ("[render]", keys::RENDER),
        ("[mesh.NAME]", keys::MESH),
        ("[[instance]]", keys::INSTANCE),
        ("transform", keys::STEP),
        ("bump", keys::BUMP),
        ("displacement", keys::DISPLACEMENT),
        ("normal_map", keys::NORMAL_MAP),
        ("[environment]", keys::ENVIRONMENT),
    ];
    let kinds: [(&str, &Kinds); 5] = [
        ("[camera]", &keys::CAMERA),
        ("[texture.NAME]", &keys::TEXTURE),
        ("[material.NAME]", &keys::MATERIAL),
        ("[[shape]]", &keys::SHAPE),
        ("[[light]]", &keys::LIGHT),
    ];
    let mut all: BTreeSet<_> =
        plain.iter().flat_map(|(table, keys)| keys.iter().map(move |key| (*table, *key))).collect();
    for (table, kinds) in kinds {
        let own = kinds.kinds.iter().flat_map(|(_, keys)| keys.iter());
        all.extend(own.chain(kinds.common).map(|key| (table, *key)));
    }
    all
}

const MANUAL: &str = include_str!("../../../../scenes/README.md");

/// The text of the manual under the heading that names a table.
fn chapter(table: &str) -> &'static str {
    let heading = format!("\n## `{table}`");
    let start = MANUAL.find(&heading).unwrap_or_else(|| panic!("no chapter on {table}")) + heading.len();
    let rest = &MANUAL[start..];
    &rest[..rest.find("\n## ").unwrap_or(rest.len())]
}

#[test]
fn the_manual_explains_every_key() {
    for (table, key) in every_key() {
        let (chapter, row) = match table {
            "include" => (MANUAL, format!("`{key}`")),
            _ => (chapter(table), format!("\n| `{key}` | ")),
        };
        let tables =
            ["film", "render", "camera", "texture", "material", "mesh", "shape", "instance", "light"];
        if table == "include" && (tables.contains(&key) || key == "environment") {
            continue;
        }
        assert!(chapter.contains(&row), "{table}: no row for {key}");
    }
}

#[test]
fn the_manual_knows_no_other_keys() {
    let known = every_key();
    let tables: BTreeSet<_> =
        known.iter().map(|(table, _)| *table).filter(|table| *table != "include").collect();
    for table in tables {
        for row in chapter(table).lines().filter_map(|line| line.strip_prefix("| `")) {
            let key = row.split('`').next().unwrap();
            assert!(known.contains(&(table, key)), "{table} has no key {key}");
        }
    }
}

#[test]
fn the_example_of_the_manual_is_a_scene() {
    let start = MANUAL.find("```toml\n").unwrap() + "```toml\n".len();
    let text = &MANUAL[start..start + MANUAL[start..].find("```").unwrap()];
    let (scene, warnings) = read(text).unwrap_or_else(|error| panic!("{error}"));
    assert!(warnings.is_empty(), "{}", warnings[0]);
    assert!(!scene.shapes.is_empty());
}

#[test]
fn the_scene_of_all_keys_has_all_keys() {
    for (table, key) in every_key() {
        assert!(ALL.contains(key) || key == "include", "{table}: {key} is not in all_keys.toml");
    }
}
