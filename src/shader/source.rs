//! The tree of shader sources: embedded in the program, in a folder, or handed in as text.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{ErrorKind as IoErrorKind, Read};
use std::path::{Path, PathBuf};

use super::graph::reachable;
use super::tree::{closest, embedded, embedded_names, list_folder, strangers};
use crate::{Error, Result};

/// The longest shader file that is read. The largest lookup table one would write in GLSL is far below.
pub(super) const MAX_FILE_BYTES: u64 = 4 << 20;

/// The longest name of a shader file.
const MAX_NAME_BYTES: usize = 200;

/// Where shader files come from. A name is looked for among the virtual files first, then in the folder, then
/// among the files embedded in the program.
///
/// Names are paths relative to the root of the tree with forward slashes, such as `base/math.glsl`.
#[derive(Debug, Clone, Default)]
pub struct Sources {
    virtual_files: BTreeMap<String, String>,
    folder: Option<PathBuf>,
    /// The folder as the user named it.
    named: PathBuf,
    embedded: bool,
}

impl Sources {
    /// The files that were embedded when the program was built.
    pub fn embedded() -> Self {
        Self { embedded: true, ..Self::default() }
    }

    /// The files in a folder; a file that is missing there is taken from the embedded ones.
    ///
    /// # Errors
    ///
    /// When there is no such folder, or none of its files stands for an embedded one: it would change nothing.
    pub fn folder(folder: &Path) -> Result<Self> {
        let sources = Self::any_folder(folder)?;
        let names = embedded_names();
        let root = sources.folder.as_deref().unwrap_or(folder);
        if names.iter().any(|name| root.join(name).exists()) {
            return Ok(sources);
        }
        let example = names.first().map_or_else(String::new, |name| folder.join(name).display().to_string());
        Err(Error::scene("no file in this folder has the name of a shader of dapple")
            .in_file(folder)
            .help(format!("give the folder that stands for `shaders/`, with a file such as {example}")))
    }

    /// As [`Self::folder`], with any files in it.
    pub(super) fn any_folder(folder: &Path) -> Result<Self> {
        let root = folder.canonicalize().map_err(|e| {
            Error::scene(format!("cannot open the folder of shaders: {e}"))
                .in_file(folder)
                .help("give a folder with the same layout as `shaders/` in the source of dapple")
        })?;
        if !root.is_dir() {
            return Err(Error::scene("this is a file, but shaders are read from a folder").in_file(folder));
        }
        Ok(Self { folder: Some(root), named: folder.to_path_buf(), ..Self::embedded() })
    }

    /// Only the given files: name and text.
    ///
    /// # Errors
    ///
    /// As [`Self::set_virtual`].
    pub fn from_map<N: Into<String>, T: Into<String>>(
        files: impl IntoIterator<Item = (N, T)>,
    ) -> Result<Self> {
        let mut sources = Self::default();
        for (name, text) in files {
            sources.set_virtual(name, text)?;
        }
        Ok(sources)
    }

    /// Adds a virtual file, or replaces its text. It hides a file of the same name in the folder.
    ///
    /// # Errors
    ///
    /// When the name is no plain relative path.
    pub fn set_virtual(&mut self, name: impl Into<String>, text: impl Into<String>) -> Result<()> {
        let name = name.into();
        check_name(&name)?;
        self.virtual_files.insert(name, text.into());
        Ok(())
    }

    /// An error in a file of the folder, with the path by which the user knows it.
    pub fn locate(&self, mut error: Error) -> Error {
        if let (Some(place), true) = (&mut error.place, self.folder.is_some()) {
            let file = self.named.join(&place.file);
            if file.is_file() {
                place.file = file;
            }
        }
        error
    }

    /// True when the file was handed in as text.
    pub fn is_virtual(&self, name: &str) -> bool {
        self.virtual_files.contains_key(name)
    }

    /// The names of all files, sorted. Unreadable folders count as empty.
    pub fn names(&self) -> BTreeSet<String> {
        let mut names: BTreeSet<String> = self.virtual_files.keys().cloned().collect();
        if self.embedded {
            names.extend(embedded_names());
        }
        if let Some(root) = &self.folder {
            list_folder(root, "", &mut names);
        }
        names
    }

    /// The files in the folder that stand for none of the embedded ones, each with the name that was perhaps meant. What has neither
    /// such a name nor that of a shader is left out.
    pub fn strangers(&self) -> Vec<(String, Option<String>)> {
        self.folder.as_deref().map_or_else(Vec::new, strangers)
    }

    /// The names that a kernel can ask for: its own, and whatever `#include` lines lead to, also those behind conditions.
    pub fn reachable(&self, kernel: &str) -> BTreeSet<String> {
        reachable(kernel, |name| self.read(name).ok(), |text| text.as_deref()).into_keys().collect()
    }

    /// The text of a file, without a byte order mark.
    ///
    /// # Errors
    ///
    /// When there is no such file, it cannot be read or is no text, or its name is no plain relative path.
    pub fn read(&self, name: &str) -> Result<String> {
        check_name(name)?;
        let bytes = match self.virtual_files.get(name) {
            Some(text) => text.as_bytes().to_vec(),
            None => match self.read_folder(name)? {
                Some(bytes) => bytes,
                None => self.read_embedded(name)?,
            },
        };
        decode(name, bytes)
    }

    fn read_embedded(&self, name: &str) -> Result<Vec<u8>> {
        let file = if self.embedded { embedded(name) } else { None };
        file.map(<[u8]>::to_vec).ok_or_else(|| {
            let error = Error::device(format!("there is no shader file `{name}`"));
            match closest(&self.names(), name) {
                Some(near) => error.help(format!("did you mean `{near}`?")),
                None => error.help("names are relative to the root of the shader tree"),
            }
        })
    }

    /// `None` when there is no folder or the file is missing in it.
    fn read_folder(&self, name: &str) -> Result<Option<Vec<u8>>> {
        let Some(root) = &self.folder else { return Ok(None) };
        let path = root.join(name);
        let unreadable = |e: std::io::Error| Error::device(format!("cannot read: {e}")).in_file(&path);
        match path.symlink_metadata() {
            Err(e) if e.kind() == IoErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(unreadable(e)),
            Ok(_) => {}
        }
        let real = path.canonicalize().map_err(unreadable)?;
        if !real.starts_with(root) {
            return Err(Error::device("this is a link out of the folder of shaders")
                .in_file(&path)
                .help("put a copy of the file into the folder"));
        }
        if !real.is_file() {
            return Err(Error::device("this is not a file").in_file(&path));
        }
        let mut bytes = Vec::new();
        let file = std::fs::File::open(&real).map_err(unreadable)?;
        // One byte more than allowed, so that a file that is too long shows.
        file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        Ok(Some(bytes))
    }
}

/// Names are plain: they are printed in logs and written between quotes into GLSL.
pub(super) fn check_name(name: &str) -> Result<()> {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let why = if name.len() > MAX_NAME_BYTES {
        return Err(Error::device(format!(
            "the name of a shader file is {} bytes long, at most {MAX_NAME_BYTES} are allowed",
            name.len()
        )));
    } else if name.starts_with('/') {
        "it is absolute"
    } else if name.split('/').any(|part| part.is_empty() || part == "." || part == "..") {
        "it has an empty part, `.` or `..`"
    } else if !name.split('/').all(|part| part.chars().all(plain)) {
        "it has a character other than letters, digits, `_`, `-`, `.` and `/`"
    } else {
        return Ok(());
    };
    Err(Error::device(format!("`{}` cannot name a shader file: {why}", name.escape_debug()))
        .help("names are relative to the root of the shader tree, such as `base/math.glsl`"))
}

/// Bytes to text that can be handed to a C compiler: UTF-8 and without NUL.
fn decode(name: &str, bytes: Vec<u8>) -> Result<String> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(Error::device(format!("the shader file is longer than {} MiB", MAX_FILE_BYTES >> 20))
            .in_file(Path::new(name)));
    }
    let mut text = String::from_utf8(bytes).map_err(|e| {
        let line = line_at(e.as_bytes(), e.utf8_error().valid_up_to());
        Error::device("the file is not text in UTF-8").at(Path::new(name), line, 0)
    })?;
    if let Some(at) = text.find('\0') {
        let line = line_at(text.as_bytes(), at);
        return Err(Error::device("there is a zero byte in the text").at(Path::new(name), line, 0));
    }
    if text.starts_with('\u{feff}') {
        text.remove(0);
    }
    Ok(text)
}

fn line_at(bytes: &[u8], at: usize) -> u32 {
    let breaks = bytes.iter().take(at).filter(|b| **b == b'\n').count();
    u32::try_from(breaks).map_or(0, |n| n.saturating_add(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn embedded_files_are_found_by_name() {
        let sources = Sources::embedded();
        let names = sources.names();
        assert!(!names.is_empty());
        for name in names {
            sources.read(&name).unwrap();
        }
    }

    #[test]
    fn names_cannot_leave_the_tree() {
        let sources = Sources::embedded();
        for name in
            ["", "/etc/passwd", "../Cargo.toml", "base/../x", "a//b", "./a", "C:/x", "a\\b", "a\"b", "é"]
        {
            assert!(sources.read(name).is_err(), "{name}");
        }
        assert!(sources.read(&"a/".repeat(1000)).unwrap_err().to_string().contains("2000 bytes"));
        assert!(Sources::from_map([("../a", "")]).is_err());
    }

    #[test]
    fn a_missing_file_suggests_a_near_name() {
        let sources = Sources::from_map([("base/math.glsl", "")]).unwrap();
        let error = sources.read("base/mathe.glsl").unwrap_err();
        assert_eq!(
            error.to_string(),
            "there is no shader file `base/mathe.glsl`; did you mean `base/math.glsl`?"
        );
    }

    #[test]
    fn a_folder_comes_before_the_embedded_files_and_virtual_files_before_both() {
        let folder = tempfile::tempdir().unwrap();
        let embedded = Sources::embedded().names().into_iter().next().unwrap();
        let own = folder.path().join("own");
        std::fs::create_dir(&own).unwrap();
        std::fs::write(own.join("a.glsl"), "folder").unwrap();
        let mut sources = Sources::any_folder(folder.path()).unwrap();
        assert_eq!(sources.read("own/a.glsl").unwrap(), "folder");
        assert!(!sources.is_virtual("own/a.glsl"));
        sources.read(&embedded).unwrap();
        sources.set_virtual("own/a.glsl", "virtual").unwrap();
        assert_eq!(sources.read("own/a.glsl").unwrap(), "virtual");
        assert!(sources.is_virtual("own/a.glsl"));
        assert!(sources.names().contains("own/a.glsl"));
        assert!(sources.read("own").is_err());
    }

    #[test]
    fn a_folder_that_is_missing_or_a_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Sources::folder(&folder.path().join("missing")).is_err());
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        assert!(Sources::folder(&file).unwrap_err().to_string().contains("this is a file"));
    }

    #[test]
    fn a_folder_that_changes_nothing_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        // One level too high
        let base = folder.path().join("shaders/base");
        std::fs::create_dir_all(&base).unwrap();
        std::fs::write(base.join("math.glsl"), "").unwrap();
        let error = Sources::folder(folder.path()).unwrap_err();
        assert_eq!(error.place.unwrap().file, folder.path());
        assert!(error.help.unwrap().contains(&folder.path().join("base/").display().to_string()));
        Sources::folder(&folder.path().join("shaders")).unwrap();
    }

    #[test]
    fn text_that_is_no_text_is_refused_with_its_line() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("latin.glsl"), b"a\nb\n\xe9").unwrap();
        std::fs::write(folder.path().join("zero.glsl"), b"a\n\0").unwrap();
        std::fs::write(folder.path().join("mark.glsl"), "\u{feff}a").unwrap();
        std::fs::write(folder.path().join("huge.glsl"), vec![b' '; 5 << 20]).unwrap();
        let sources = Sources::any_folder(folder.path()).unwrap();
        let text = |name: &str| sources.read(name).map_err(|e| e.to_string());
        assert_eq!(text("latin.glsl").unwrap_err(), "latin.glsl:3: the file is not text in UTF-8");
        assert_eq!(text("zero.glsl").unwrap_err(), "zero.glsl:2: there is a zero byte in the text");
        assert_eq!(text("mark.glsl").unwrap(), "a");
        assert_eq!(text("huge.glsl").unwrap_err(), "huge.glsl: the shader file is longer than 4 MiB");
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_folder_are_refused() {
        let outside = tempfile::tempdir().unwrap();
        std::fs::write(outside.path().join("secret"), "x").unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink(outside.path().join("secret"), folder.path().join("a.glsl")).unwrap();
        std::os::unix::fs::symlink(folder.path().join("gone"), folder.path().join("b.glsl")).unwrap();
        std::os::unix::fs::symlink(folder.path(), folder.path().join("loop")).unwrap();
        std::fs::write(folder.path().join("c.glsl"), "inside").unwrap();
        let sources = Sources::any_folder(folder.path()).unwrap();
        assert!(sources.read("a.glsl").unwrap_err().to_string().contains("link out of the folder"));
        assert!(sources.read("b.glsl").is_err());
        assert_eq!(sources.read("loop/c.glsl").unwrap(), "inside");
        assert!(sources.names().contains("c.glsl"));
    }
}
