//! The lines of a file around an error.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// Lines on each side.
const AROUND: u32 = 3;
/// Nothing further in is looked for.
const MOST_BYTES: u64 = 16 << 20;
/// Longer lines are cut.
const MOST_CHARS: usize = 300;

/// Numbers and texts of the lines around one; none when it is not known, or the file is not below one of the folders, or no text.
pub(super) fn around(file: &Path, line: u32, roots: &[PathBuf]) -> Vec<(u32, String)> {
    let Ok(file) = file.canonicalize() else { return Vec::new() };
    if line == 0 || !file.is_file() || !roots.iter().any(|root| file.starts_with(root)) {
        return Vec::new();
    }
    let Ok(file) = File::open(file) else { return Vec::new() };
    let lines = BufReader::new(file.take(MOST_BYTES)).lines();
    let first = line.saturating_sub(AROUND).max(1);
    let last = line.saturating_add(AROUND);
    (1..=last)
        .zip(lines)
        .skip(first as usize - 1)
        .map_while(|(number, text)| Some((number, text.ok()?.chars().take(MOST_CHARS).collect())))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_on_both_sides_are_shown() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "1\n2\n3\n4\n5\n6\n7\n8\n").unwrap();
        let roots = [folder.path().canonicalize().unwrap()];
        let numbers =
            |line| around(&path, line, &roots).iter().map(|(n, text)| (*n, text.clone())).collect::<Vec<_>>();
        assert_eq!(numbers(5).first(), Some(&(2, "2".into())));
        assert_eq!(numbers(5).last(), Some(&(8, "8".into())));
        assert_eq!(numbers(1).len(), 4);
        assert!(numbers(100).is_empty() && numbers(0).is_empty());
        std::fs::write(&path, b"a\n\xff\n").unwrap();
        assert_eq!(numbers(2).len(), 1);
        assert!(around(folder.path(), 1, &roots).is_empty());
    }

    #[test]
    fn files_elsewhere_are_not_shown() {
        let [inside, outside] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let roots = [inside.path().canonicalize().unwrap()];
        let secret = outside.path().join("secret");
        std::fs::write(&secret, "1\n2\n").unwrap();
        assert!(around(&secret, 1, &roots).is_empty());
        let way = inside.path().join("..").join(outside.path().file_name().unwrap()).join("secret");
        assert!(way.exists() && around(&way, 1, &roots).is_empty());
        #[cfg(unix)]
        {
            let link = inside.path().join("link");
            std::os::unix::fs::symlink(&secret, &link).unwrap();
            assert!(around(&link, 1, &roots).is_empty());
        }
    }
}
