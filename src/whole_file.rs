//! Files that appear whole or not at all: they are written under another name in the same folder, and renamed when they are safe on
//! the disk.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

/// Writes a file. What is there already is replaced only with `replace`.
///
/// # Errors
///
/// What the system says; a file of that name is then as before. [`reason`] puts it into words.
pub fn write(path: &Path, bytes: &[u8], replace: bool) -> io::Result<()> {
    write_with(path, replace, |file| fill(file, bytes))
}

/// The words of an error, without the name of the file that was to be renamed, which says nothing to the user.
pub fn reason(error: &io::Error) -> String {
    let reason = error.to_string();
    reason.split_once(" at path ").map_or(reason.as_str(), |(reason, _)| reason).to_owned()
}

/// Makes `path` with what `content` writes, once it is complete.
pub(crate) fn write_with(
    path: &Path,
    replace: bool,
    content: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = new_beside(path)?;
    content(file.as_file_mut())?;
    let kept = if replace { file.persist(path) } else { file.persist_noclobber(path) };
    kept.map(|_| ()).map_err(|refused| refused.error)
}

/// Writes all bytes and waits until the disk has them.
pub(crate) fn fill(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    file.write_all(bytes)?;
    file.sync_all()
}

/// A new file in the folder of `path`, removed again unless it is renamed.
pub(crate) fn new_beside(path: &Path) -> io::Result<tempfile::NamedTempFile> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".dapple-").suffix(".tmp");
    // As any new file: readable by all but for what the umask of the user takes away
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
