//! Whole files in memory.

use crate::{Error, Result};
use std::path::{Component, Path, PathBuf};

/// Reads a file. Only regular files are read: a device or a pipe could go on for ever.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>> {
    let failed = |e: std::io::Error| {
        Error::scene(format!("the file cannot be read: {e}"))
            .help("check its name and permissions")
            .in_file(path)
    };
    let metadata = std::fs::metadata(path).map_err(failed)?;
    if !metadata.is_file() {
        return Err(Error::scene("this is not a regular file").help("name a file").in_file(path));
    }
    std::fs::read(path).map_err(failed)
}

/// A file name that stays in the folder that it is relative to; none for another.
pub(super) fn inside(name: &str) -> Option<PathBuf> {
    let path = Path::new(name);
    let stays = path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    (stays && !name.is_empty() && !name.contains('\0')).then(|| path.to_path_buf())
}

/// Bytes of a file for a message: at most 40 characters, without any that control a terminal.
pub(super) fn shown(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes.get(..160).unwrap_or(bytes));
    let mut chars = text.trim_end().chars();
    let start: String = chars.by_ref().take(40).flat_map(char::escape_debug).collect();
    if chars.next().is_none() { start } else { format!("{start}…") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_binary_words_are_shown_short_and_plain() {
        assert_eq!(shown(b"uint \n"), "uint");
        assert_eq!(shown(b"a\x1b[1m\0"), "a\\u{1b}[1m\\0");
        assert_eq!(shown(&[b'x'; 1000]), format!("{}…", "x".repeat(40)));
    }

    #[test]
    fn missing_files_and_folders_are_errors_with_their_name() {
        let missing = Path::new("/nonexistent/bunny.ply");
        let error = read_bytes(missing).unwrap_err();
        assert!(error.to_string().starts_with("/nonexistent/bunny.ply: the file cannot be read"), "{error}");
        let folder = std::env::temp_dir();
        assert!(read_bytes(&folder).unwrap_err().message.contains("not a regular file"));
    }
}
