//! The tree of shaders in the program, and a folder that stands for it.

use std::collections::BTreeSet;
use std::path::Path;

use include_dir::{Dir, include_dir};

use super::source::check_name;

static EMBEDDED: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/shaders");

/// The files that were embedded when the program was built: name and bytes.
pub fn embedded_files() -> impl Iterator<Item = (String, &'static [u8])> {
    embedded_names().into_iter().filter_map(|name| {
        let bytes = embedded(&name)?;
        Some((name, bytes))
    })
}

/// The bytes of an embedded file.
pub(super) fn embedded(name: &str) -> Option<&'static [u8]> {
    EMBEDDED.get_file(name).map(|file| file.contents())
}

pub(super) fn embedded_names() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    list_embedded(&EMBEDDED, &mut names);
    names
}

/// The files in a folder that stand for none of the embedded ones, with the names that were perhaps meant.
pub(super) fn strangers(root: &Path) -> Vec<(String, Option<String>)> {
    let (mut own, known) = (BTreeSet::new(), embedded_names());
    list_folder(root, "", &mut own);
    let strange = own.difference(&known).map(|name| {
        let last = |name: &str| name.rsplit('/').next().unwrap_or(name).to_owned();
        let same_file = || known.iter().find(|known| last(known) == last(name)).cloned();
        (name.clone(), closest(&known, name).or_else(same_file))
    });
    let is_shader = |name: &str| [".glsl", ".comp"].iter().any(|end| name.ends_with(end));
    strange.filter(|(name, near)| near.is_some() || is_shader(name)).collect()
}

/// The name that was perhaps meant.
pub(super) fn closest(names: &BTreeSet<String>, name: &str) -> Option<String> {
    let rated = names.iter().map(|n| (strsim::damerau_levenshtein(n, name), n));
    // Three edits: a slip of the keyboard or a wrong extension, not another file.
    rated.filter(|(distance, _)| *distance <= 3).min().map(|(_, n)| n.clone())
}

fn list_embedded(dir: &Dir<'_>, names: &mut BTreeSet<String>) {
    for file in dir.files() {
        // Embedded paths are relative to the root and, on Windows, may have backslashes.
        names.insert(file.path().to_string_lossy().replace('\\', "/"));
    }
    for dir in dir.dirs() {
        list_embedded(dir, names);
    }
}

pub(super) fn list_folder(folder: &Path, prefix: &str, names: &mut BTreeSet<String>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        // The kind of the entry itself, so that links are never followed: they may lead in a circle.
        match entry.file_type() {
            Ok(kind) if kind.is_dir() => list_folder(&entry.path(), &format!("{name}/"), names),
            Ok(kind) if kind.is_file() && check_name(&name).is_ok() => {
                names.insert(name);
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Sources;

    #[test]
    fn files_that_stand_for_none_are_found_with_the_name_that_was_meant() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(folder.path().join("base")).unwrap();
        for name in
            ["base/math.glsl", "base/maht.glsl", "math.glsl", "mine.glsl", "notes.txt", "base/math.gls"]
        {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let meant = || Some("base/math.glsl".to_owned());
        let expected = [
            ("base/maht.glsl", meant()),
            ("base/math.gls", meant()),
            ("math.glsl", meant()),
            ("mine.glsl", None),
        ];
        let found = Sources::any_folder(folder.path()).unwrap().strangers();
        assert_eq!(found, expected.map(|(name, near)| (name.to_owned(), near)));
        assert!(Sources::embedded().strangers().is_empty());
    }
}
