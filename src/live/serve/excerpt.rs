//! The lines of a file around an error.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// Lines on each side.
const AROUND: u32 = 3;
/// Nothing further in is looked for.
const MOST_BYTES: u64 = 16 << 20;
/// Longer lines are cut.
const MOST_CHARS: usize = 300;

/// Numbers and texts of the lines around one; none when it is not known, or the file is not there or no text.
pub(super) fn around(file: &Path, line: u32) -> Vec<(u32, String)> {
    if line == 0 || !file.is_file() {
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
        let numbers = |line| around(&path, line).iter().map(|(n, text)| (*n, text.clone())).collect::<Vec<_>>();
        assert_eq!(numbers(5).first(), Some(&(2, "2".into())));
        assert_eq!(numbers(5).last(), Some(&(8, "8".into())));
        assert_eq!(numbers(1).len(), 4);
        assert!(numbers(100).is_empty() && numbers(0).is_empty());
        std::fs::write(&path, b"a\n\xff\n").unwrap();
        assert_eq!(numbers(2).len(), 1);
        assert!(around(folder.path(), 1).is_empty());
    }
}
