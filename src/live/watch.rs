//! Which files were edited. Editors save in many ways: they write into the file, or write another and give it the name. So it is
//! folders that are watched, and names that are looked for.

use crate::{Error, Result};
use notify::event::{AccessKind, AccessMode, MetadataKind, ModifyKind};
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;

/// Watches the folders of some files.
pub struct Watch {
    watcher: RecommendedWatcher,
    folders: BTreeMap<PathBuf, RecursiveMode>,
}

impl Watch {
    /// Sends the paths that events name to `edits`, as `tell` wraps them.
    ///
    /// # Errors
    ///
    /// When the system has no way to watch files, or no room for one watch more.
    pub fn new<T: Send + 'static>(edits: Sender<T>, tell: fn(Vec<PathBuf>) -> T) -> Result<Self> {
        let watcher = notify::recommended_watcher(move |event: notify::Result<Event>| match event {
            // A receiver that is gone wants to know nothing
            Ok(event) if writes(&event.kind) || event.need_rescan() => _ = edits.send(tell(event.paths)),
            _ => {}
        });
        Ok(Self { watcher: watcher.map_err(|e| refused(&e, Path::new("")))?, folders: BTreeMap::new() })
    }

    /// Watches the folders of these files, and a tree of folders, and no others.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]. A folder that is not there is left out.
    pub fn follow(&mut self, files: &BTreeSet<PathBuf>, tree: Option<&Path>) -> Result<()> {
        let mut wanted: BTreeMap<PathBuf, RecursiveMode> = files
            .iter()
            .flat_map(|file| homes(file))
            .map(|home| (home, RecursiveMode::NonRecursive))
            .collect();
        wanted.extend(
            tree.and_then(|tree| tree.canonicalize().ok()).map(|tree| (tree, RecursiveMode::Recursive)),
        );
        let watcher = &mut self.watcher;
        self.folders.retain(|folder, mode| {
            let stays = wanted.get(folder) == Some(mode);
            if !stays {
                // One that was removed is watched no more
                _ = watcher.unwatch(folder);
            }
            stays
        });
        for (folder, mode) in wanted {
            if !self.folders.contains_key(&folder) {
                self.watcher.watch(&folder, mode).map_err(|error| refused(&error, &folder))?;
                self.folders.insert(folder, mode);
            }
        }
        Ok(())
    }
}

/// Whether it may be that a file has other contents now. Reads are no edits: ours would be among them.
fn writes(kind: &EventKind) -> bool {
    match kind {
        EventKind::Access(AccessKind::Close(AccessMode::Write)) => true,
        EventKind::Access(_) => false,
        EventKind::Modify(ModifyKind::Metadata(kind)) => *kind == MetadataKind::Any,
        _ => true,
    }
}

fn refused(error: &notify::Error, folder: &Path) -> Error {
    let error = Error::device(format!("cannot watch for edits: {error}"));
    let error = if folder == Path::new("") { error } else { error.in_file(folder) };
    error.help("on Linux, raise fs.inotify.max_user_watches")
}

/// The names under which events tell of a file: that in its folder, and where it is a link, that of what it leads to.
pub(super) fn names(file: &Path) -> Vec<PathBuf> {
    let name = file.file_name().map(Path::new).unwrap_or(Path::new(""));
    let folder = match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut all: Vec<PathBuf> =
        folder.canonicalize().ok().map(|folder| folder.join(name)).into_iter().collect();
    all.extend(file.canonicalize().ok().filter(|real| !all.contains(real)));
    all
}

/// The folders that they are in.
fn homes(file: &Path) -> Vec<PathBuf> {
    names(file).iter().filter_map(|name| Some(name.parent()?.to_path_buf())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::process::Command;
    use std::sync::mpsc::{Receiver, channel};
    use std::time::Duration;

    struct Room {
        folder: tempfile::TempDir,
        watch: Watch,
        edits: Receiver<Vec<PathBuf>>,
    }

    impl Room {
        fn new() -> Self {
            let (sender, edits) = channel();
            let folder = tempfile::tempdir().unwrap();
            fs::write(folder.path().join("a"), "1").unwrap();
            let mut watch = Watch::new(sender, |paths| paths).unwrap();
            watch.follow(&BTreeSet::from([folder.path().join("a")]), None).unwrap();
            Self { folder, watch, edits }
        }

        fn path(&self, name: &str) -> PathBuf {
            self.folder.path().canonicalize().unwrap().join(name)
        }

        /// Waits until an edit of a file is told.
        fn wait(&self, name: &str) {
            let path = self.path(name);
            let limit = Duration::from_secs(20);
            while !self.edits.recv_timeout(limit).unwrap().contains(&path) {}
        }

        /// Whether anything is told before an edit of another file is.
        fn is_silent(&self) -> bool {
            fs::write(self.path("mark"), "").unwrap();
            let limit = Duration::from_secs(20);
            let first = self.edits.recv_timeout(limit).unwrap();
            self.wait_for_quiet();
            first.contains(&self.path("mark"))
        }

        fn wait_for_quiet(&self) {
            while self.edits.recv_timeout(Duration::from_millis(50)).is_ok() {}
        }
    }

    #[test]
    fn all_ways_of_saving_are_seen() {
        let room = Room::new();
        let a = room.path("a");
        let ways: [&dyn Fn(); 4] = [
            &|| fs::write(&a, "2").unwrap(),
            // As sed -i and VS Code with atomic saves do
            &|| {
                fs::write(room.path("b"), "3").unwrap();
                fs::rename(room.path("b"), &a).unwrap();
            },
            // As vim does: the old file is moved away, a new one is made, the old one is removed
            &|| {
                fs::rename(&a, room.path("a~")).unwrap();
                fs::write(&a, "4").unwrap();
                fs::remove_file(room.path("a~")).unwrap();
            },
            &|| assert!(Command::new("sed").args(["-i", "s/4/5/"]).arg(&a).status().unwrap().success()),
        ];
        for way in ways {
            way();
            room.wait("a");
            room.wait_for_quiet();
        }
        fs::remove_file(&a).unwrap();
        room.wait("a");
    }

    #[test]
    fn reading_is_no_edit() {
        let room = Room::new();
        fs::read(room.path("a")).unwrap();
        assert!(room.is_silent());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed_to_what_it_leads_to() {
        let mut room = Room::new();
        let other = tempfile::tempdir().unwrap();
        let link = other.path().join("link");
        std::os::unix::fs::symlink(room.path("a"), &link).unwrap();
        room.watch.follow(&BTreeSet::from([link.clone()]), None).unwrap();
        fs::write(room.path("a"), "2").unwrap();
        let seen = room.edits.recv_timeout(Duration::from_secs(20)).unwrap();
        assert!(names(&link).iter().any(|name| seen.contains(name)), "{seen:?}");
    }

    #[test]
    fn folders_that_are_no_longer_wanted_are_silent() {
        let mut room = Room::new();
        let other = tempfile::tempdir().unwrap();
        fs::write(other.path().join("c"), "").unwrap();
        room.watch.follow(&BTreeSet::from([other.path().join("c")]), None).unwrap();
        fs::write(room.path("a"), "2").unwrap();
        fs::write(other.path().join("c"), "1").unwrap();
        let c = other.path().canonicalize().unwrap().join("c");
        assert!(room.edits.recv_timeout(Duration::from_secs(20)).unwrap().contains(&c));
    }
}
