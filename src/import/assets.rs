//! What the scene reader needs from the file system.

use crate::import::{Model, ModelChoice, Spacing};
use crate::scene::{Image, LensSystem, Mesh, Scene};
use crate::{Error, Result};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

/// Largest scene file in bytes. Meshes of that size belong into PLY files.
const MAX_TEXT_BYTES: u64 = 256 << 20;

/// The files that a scene names. The scene reader decides which file is wanted; this decides how it is read.
pub trait Assets {
    /// Reads a picture.
    ///
    /// # Errors
    /// When the file cannot be read or is no picture.
    fn image(&mut self, path: &Path) -> Result<Arc<Image>>;

    /// Reads a triangle mesh. The parts of the mesh carry names and no materials.
    ///
    /// # Errors
    /// When the file cannot be read or is no mesh.
    fn mesh(&mut self, path: &Path) -> Result<Mesh>;

    /// Reads a model into a scene.
    ///
    /// # Errors
    /// When the file cannot be read or is no model.
    fn model(&mut self, path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
        crate::import::read_model(path, choice, scene)
    }

    /// Reads a lens of several elements.
    ///
    /// # Errors
    /// When the file cannot be read or is no lens.
    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        crate::import::read_lens(path, spacing)
    }

    /// Reads a volume as slices of one size.
    ///
    /// # Errors
    /// When the file cannot be read or is no volume.
    fn volume(&mut self, path: &Path) -> Result<Vec<Arc<Image>>> {
        Ok(crate::import::read_volume(path)?.into_iter().map(Arc::new).collect())
    }

    /// Whether the file is there, so that a wrong name is reported at its place in the scene.
    fn exists(&mut self, path: &Path) -> bool {
        path.exists()
    }

    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// Those of [`read_text`].
    fn text(&mut self, path: &Path) -> Result<String> {
        read_text(path)
    }
}

/// Reads the text of a scene file (at most 256 MiB of UTF-8).
///
/// # Errors
/// When the file cannot be read, is too large or is not UTF-8.
pub fn read_text(path: &Path) -> Result<String> {
    let failed =
        |error: std::io::Error| Error::scene(format!("cannot read the scene: {error}")).in_file(path);
    let mut bytes = Vec::new();
    File::open(path).map_err(failed)?.take(MAX_TEXT_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > MAX_TEXT_BYTES {
        return Err(Error::scene("the scene is larger than 256 MiB")
            .help("put large meshes into PLY files")
            .in_file(path));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count() as u32;
        Error::scene("the scene is not text in UTF-8").at(path, line, 0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    struct Files;
    impl Assets for Files {
        fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
            Err(Error::scene("no picture").in_file(path))
        }
        fn mesh(&mut self, path: &Path) -> Result<Mesh> {
            Err(Error::scene("no mesh").in_file(path))
        }
    }

    #[test]
    fn text_comes_from_a_file_of_utf8() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("scene.toml");
        fs::write(&path, "[film]\n# é").unwrap();
        assert_eq!(Files.text(&path).unwrap(), "[film]\n# é");
        fs::write(&path, b"[film]\n# \xff").unwrap();
        let error = Files.text(&path).unwrap_err().to_string();
        assert_eq!(error, format!("{}:2: the scene is not text in UTF-8", path.display()));
        assert!(!Files.exists(&directory.path().join("other")));
        let error = Files.text(directory.path()).unwrap_err().to_string();
        assert!(error.starts_with(&format!("{}: cannot read the scene: ", directory.path().display())));
    }

    #[test]
    fn endless_files_are_refused() {
        let endless = Path::new("/dev/zero");
        if endless.exists() {
            assert!(Files.text(endless).unwrap_err().message.contains("larger than 256 MiB"));
        }
    }
}
