//! The files of a scene: their names, and how they come to the disk.

use super::names::Names;
use crate::{Error, Result, whole_file};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Longest part of the name of an object that goes into the name of its file.
const LONGEST_NAME: usize = 48;

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// All files, the scene last.
    pub files: Vec<PathBuf>,
    /// Bytes of all of them.
    pub bytes: u64,
}

/// A scene file that is not there yet, and the folder of what it names. All is written into a folder of its own first, and moved from
/// there when it is complete: what fails before leaves everything as it was.
pub(super) struct Files {
    scene: PathBuf,
    /// Name of the folder beside the scene.
    folder: String,
    replace: bool,
    /// Where they are written first; removed at the end.
    aside: TempDir,
    /// Names that are given, in small letters: some file systems take both as one.
    taken: Names,
    written: Vec<String>,
    bytes: u64,
}

impl Files {
    /// None yet, for a scene file.
    ///
    /// # Errors
    /// A name without `.toml`, no folder for it, and what is there already unless it is to be replaced.
    pub fn beside(scene: &Path, replace: bool) -> Result<Self> {
        check_name(scene)?;
        let stem = scene.file_stem().and_then(|stem| stem.to_str());
        let stem = stem.ok_or_else(|| {
            Error::scene("the name of the scene is no text in UTF-8").help("name another").in_file(scene)
        })?;
        let folder = format!("{stem}_files");
        let home = match scene.parent() {
            Some(home) if home != Path::new("") => home,
            _ => Path::new("."),
        };
        if !home.is_dir() {
            let message = format!("there is no folder {}", home.display());
            return Err(Error::output(message).help("make it first, or name another").in_file(scene));
        }
        if scene.is_dir() {
            return Err(Error::output("this is a folder").help("name a file").in_file(scene));
        }
        check_free(scene, &scene.with_file_name(&folder), replace)?;
        let aside = tempfile::Builder::new().prefix(".dapple-").tempdir_in(home);
        let aside = aside.map_err(|error| refusal(scene, &error))?;
        let (taken, written) = (Names::default(), Vec::new());
        Ok(Self { scene: scene.to_path_buf(), folder, replace, aside, taken, written, bytes: 0 })
    }

    /// Writes a file into the folder and gives its name as the scene says it. `stem` is the name of the object, `noun` what it is.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add(&mut self, stem: &str, noun: &str, extension: &str, bytes: &[u8]) -> Result<String> {
        let name = self.name(stem, noun, extension);
        let folder = self.aside.path().join(&self.folder);
        std::fs::create_dir_all(&folder).map_err(|error| self.refused(&name, &error))?;
        std::fs::write(folder.join(&name), bytes).map_err(|error| self.refused(&name, &error))?;
        self.bytes += bytes.len() as u64;
        self.written.push(name.clone());
        Ok(format!("{}/{name}", self.folder))
    }

    /// Writes the scene, has it checked, and moves all of it to where it belongs; the scene, which is complete with the rest, comes last.
    ///
    /// # Errors
    /// When it cannot be written or moved, and those of `check`.
    pub fn finish(mut self, text: &str, check: &mut dyn FnMut(&Path) -> Result<()>) -> Result<Written> {
        let first = self.aside.path().join(self.scene.file_name().unwrap_or_default());
        std::fs::write(&first, text).map_err(|error| refusal(&self.scene, &error))?;
        self.bytes += text.len() as u64;
        check(&first)?;
        let (from, to) = (self.aside.path().join(&self.folder), self.scene.with_file_name(&self.folder));
        if !self.written.is_empty() {
            self.move_folder(&from, &to).map_err(|error| refusal(&to, &error))?;
        }
        let moved = whole_file::write(&self.scene, text.as_bytes(), self.replace);
        moved.map_err(|error| refusal(&self.scene, &error))?;
        let files = self.written.iter().map(|name| to.join(name)).chain([self.scene]).collect();
        Ok(Written { files, bytes: self.bytes })
    }

    /// Moves the folder, or what is in it into one that is there. What has another name stays.
    fn move_folder(&self, from: &Path, to: &Path) -> io::Result<()> {
        if !to.is_dir() {
            return std::fs::rename(from, to);
        }
        self.written.iter().try_for_each(|name| std::fs::rename(from.join(name), to.join(name)))
    }

    fn refused(&self, name: &str, error: &io::Error) -> Error {
        refusal(&self.scene.with_file_name(&self.folder).join(name), error)
    }

    /// A name of letters, digits, `-`, `_` and `.` that no file has yet.
    fn name(&mut self, stem: &str, noun: &str, extension: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let stem: String = stem.chars().map(plain).take(LONGEST_NAME).collect();
        let stem = stem.trim_matches(|c| c == '_' || c == '.');
        let stem = if stem.is_empty() { noun } else { stem };
        let first = format!("{stem}.{extension}");
        if self.taken.take(&first.to_ascii_lowercase()) {
            return first;
        }
        let key = first.to_ascii_lowercase();
        self.taken.next(&key, 2, |number| format!("{stem}-{number}.{extension}"), str::to_ascii_lowercase)
    }
}

/// Checks that nothing is in the way.
fn check_free(scene: &Path, folder: &Path, replace: bool) -> Result<()> {
    // A link that leads nowhere is there, too
    let there = |path: &Path| path.symlink_metadata().is_ok();
    for path in [scene, folder] {
        if !replace && there(path) {
            let error = Error::output("this is there already and is not replaced");
            return Err(error.help("name another file, or give --force").in_file(path));
        }
    }
    if there(folder) && !folder.is_dir() {
        let error = Error::output("this is no folder, and that of the files of the scene has its name");
        return Err(error.help("move it away, or name another scene").in_file(folder));
    }
    Ok(())
}

/// Checks that a scene of this name can be written.
fn check_name(scene: &Path) -> Result<()> {
    if scene.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
        return Ok(());
    }
    let message = match scene.extension() {
        Some(extension) => format!("no scene can be written with the extension `{}`", extension.display()),
        None => "the name of the scene has no extension".to_owned(),
    };
    Err(Error::scene(message).help("end the name in .toml, the language that is written").in_file(scene))
}

/// The error for a file that could not be written, with the next step.
fn refusal(path: &Path, error: &io::Error) -> Error {
    let help = match error.kind() {
        ErrorKind::AlreadyExists => "name another file, or give --force",
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "make room on the disk, or name a file on another"
        }
        _ => "name a file in a folder that you may write to",
    };
    let reason = whole_file::reason(error);
    Error::output(format!("the file cannot be written: {reason}")).in_file(path).help(help)
}
