//! The files of a scene: which they are, and what was in those that take long to read.

use crate::Result;
use crate::import::{self, Assets, Model, ModelChoice, Spacing};
use crate::scene::{Image, LensSystem, Mesh, Scene};
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// Files that are read again only when they changed.
#[derive(Default)]
pub(super) struct Files {
    known: HashMap<PathBuf, (Stamp, Kept)>,
    used: BTreeSet<PathBuf>,
    before: BTreeSet<PathBuf>,
}

/// What tells a file from what it was before.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Stamp {
    bytes: u64,
    modified: Option<SystemTime>,
}

/// What was in a file.
#[derive(Clone)]
enum Kept {
    Image(Arc<Image>),
    Mesh(Arc<Mesh>),
    Volume(Vec<Arc<Image>>),
}

impl Stamp {
    fn of(path: &Path) -> Option<Self> {
        let found = path.metadata().ok()?;
        Some(Self { bytes: found.len(), modified: found.modified().ok() })
    }
}

impl Files {
    /// Begins to read a scene.
    pub fn begin(&mut self) {
        self.before = std::mem::take(&mut self.used);
    }

    /// Ends it. What a whole scene does not name is forgotten; one with an error may name again what it named before.
    pub fn end(&mut self, whole: bool) {
        let before = std::mem::take(&mut self.before);
        if whole {
            self.known.retain(|path, _| self.used.contains(path));
        } else {
            self.used.extend(before);
        }
    }

    /// The files that the scene names, those among them that are not there.
    pub fn used(&self) -> &BTreeSet<PathBuf> {
        &self.used
    }

    /// Forgets what was in a file.
    pub fn forget(&mut self, path: &Path) {
        self.known.remove(path);
    }

    fn use_file(&mut self, path: &Path) {
        self.used.insert(path.to_path_buf());
    }

    /// What was in a file, or else is.
    fn kept(&mut self, path: &Path, read: impl FnOnce() -> Result<Kept>) -> Result<Kept> {
        self.use_file(path);
        // Looked at before it is read: one that changes meanwhile is read again
        let stamp = Stamp::of(path);
        if let Some((known, kept)) = self.known.get(path)
            && Some(*known) == stamp
        {
            return Ok(kept.clone());
        }
        let kept = read()?;
        if let Some(stamp) = stamp {
            self.known.insert(path.to_path_buf(), (stamp, kept.clone()));
        }
        Ok(kept)
    }
}

impl Assets for Files {
    fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
        match self.kept(path, || Ok(Kept::Image(import::read_image(path)?.into())))? {
            Kept::Image(image) => Ok(image),
            _ => Ok(import::read_image(path)?.into()),
        }
    }

    fn mesh(&mut self, path: &Path) -> Result<Mesh> {
        match self.kept(path, || Ok(Kept::Mesh(import::read_mesh(path)?.into())))? {
            Kept::Mesh(mesh) => Ok(Mesh::clone(&mesh)),
            _ => import::read_mesh(path),
        }
    }

    fn model(&mut self, path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
        self.use_file(path);
        let model = import::read_model(path, choice, scene)?;
        self.used.extend(model.files.iter().cloned());
        Ok(model)
    }

    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        self.use_file(path);
        import::read_lens(path, spacing)
    }

    fn volume(&mut self, path: &Path) -> Result<Vec<Arc<Image>>> {
        let read = || import::read_volume(path).map(|slices| slices.into_iter().map(Arc::new).collect());
        match self.kept(path, || Ok(Kept::Volume(read()?)))? {
            Kept::Volume(slices) => Ok(slices),
            _ => read(),
        }
    }

    fn exists(&mut self, path: &Path) -> bool {
        self.use_file(path);
        path.exists()
    }

    fn text(&mut self, path: &Path) -> Result<String> {
        self.use_file(path);
        import::read_text(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn save(path: &Path, grey: u8) {
        image::GrayImage::from_pixel(1 + u32::from(grey) / 100, 1, image::Luma([grey])).save(path).unwrap();
    }

    #[test]
    fn a_picture_is_read_again_when_it_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        save(&path, 10);
        let mut files = Files::default();
        files.begin();
        let first = files.image(&path).unwrap();
        files.end(true);
        files.begin();
        assert!(Arc::ptr_eq(&first, &files.image(&path).unwrap()));
        files.end(true);
        save(&path, 200);
        files.begin();
        assert_eq!(files.image(&path).unwrap().width, 3);
        // The same file as a mesh: what was kept of it is of no use
        assert!(files.mesh(&path).is_err());
        files.end(true);
        assert_eq!(files.used().len(), 1);
    }

    #[test]
    fn what_is_forgotten_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        save(&path, 10);
        let mut files = Files::default();
        let first = files.image(&path).unwrap();
        files.forget(&path);
        assert!(!Arc::ptr_eq(&first, &files.image(&path).unwrap()));
    }

    #[test]
    fn a_scene_with_an_error_is_followed_as_before() {
        let folder = tempfile::tempdir().unwrap();
        let [scene, picture] = ["a.toml", "b.png"].map(|name| folder.path().join(name));
        fs::write(&scene, "").unwrap();
        let mut files = Files::default();
        files.begin();
        files.text(&scene).unwrap();
        assert!(!files.exists(&picture));
        files.end(true);
        files.begin();
        files.text(&scene).unwrap();
        files.end(false);
        assert!(files.used().contains(&picture));
        files.begin();
        files.text(&scene).unwrap();
        files.end(true);
        assert!(!files.used().contains(&picture));
    }
}
