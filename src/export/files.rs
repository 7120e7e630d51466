//! The files of a scene: their names, and how they come to the disk.

use crate::{Error, Result, whole_file};
use std::collections::BTreeSet;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

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

/// A scene file that is not there yet, and the folder of what it names.
pub(super) struct Files {
    scene: PathBuf,
    /// Name of the folder beside the scene.
    folder: String,
    replace: bool,
    /// Names that are given, in small letters: some file systems take both as one.
    taken: BTreeSet<String>,
    written: Written,
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
        let files = Self {
            scene: scene.to_path_buf(),
            folder: format!("{stem}_files"),
            replace,
            taken: BTreeSet::new(),
            written: Written { files: Vec::new(), bytes: 0 },
        };
        let beside = scene.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = beside.filter(|folder| !folder.is_dir()) {
            let message = format!("there is no folder {}", folder.display());
            return Err(Error::output(message).help("make it first, or name another").in_file(scene));
        }
        if scene.is_dir() {
            return Err(Error::output("this is a folder").help("name a file").in_file(scene));
        }
        for path in [scene, &files.folder()] {
            if !replace && path.exists() {
                let error = Error::output("this is there already and is not replaced");
                return Err(error.help("name another file, or give --force").in_file(path));
            }
        }
        Ok(files)
    }

    fn folder(&self) -> PathBuf {
        self.scene.with_file_name(&self.folder)
    }

    /// Writes a file into the folder and gives its name as the scene says it. `stem` is the name of the object, `noun` what it is.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add(&mut self, stem: &str, noun: &str, extension: &str, bytes: &[u8]) -> Result<String> {
        let name = self.name(stem, noun, extension);
        let folder = self.folder();
        match std::fs::create_dir(&folder) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(refusal(&folder, &error)),
            _ => {}
        }
        self.write(&folder.join(&name), bytes)?;
        Ok(format!("{}/{name}", self.folder))
    }

    /// Writes the scene, which is complete with it.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(mut self, text: &str) -> Result<Written> {
        let path = self.scene.clone();
        self.write(&path, text.as_bytes())?;
        Ok(self.written)
    }

    /// A name of letters, digits, `-`, `_` and `.` that no file has yet.
    fn name(&mut self, stem: &str, noun: &str, extension: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let stem: String = stem.chars().map(plain).take(LONGEST_NAME).collect();
        let stem = stem.trim_matches(|c| c == '_' || c == '.');
        let stem = if stem.is_empty() { noun } else { stem };
        let mut name = format!("{stem}.{extension}");
        let mut number = 2;
        while !self.taken.insert(name.to_ascii_lowercase()) {
            name = format!("{stem}-{number}.{extension}");
            number += 1;
        }
        name
    }

    /// Makes a file once it is complete.
    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<()> {
        whole_file::write(path, bytes, self.replace).map_err(|error| refusal(path, &error))?;
        self.written.bytes += bytes.len() as u64;
        self.written.files.push(path.to_path_buf());
        Ok(())
    }
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
