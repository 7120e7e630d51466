//! What the fuzz targets share: bytes become a file in a folder of their own, and a reader reads it. An error is fine; a panic, a
//! hang or a lack of memory is a find.

use std::path::Path;
use std::sync::OnceLock;
use tempfile::TempDir;

/// Gives the bytes to a reader as the file `name`.
pub fn read<T>(name: &str, bytes: &[u8], reader: impl Fn(&Path) -> dapple::Result<T>) {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    // In memory where there is such a place
    let shared = Path::new("/dev/shm");
    let folder = FOLDER.get_or_init(|| {
        if shared.is_dir() { TempDir::new_in(shared) } else { TempDir::new() }.expect("a folder for the file")
    });
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("room for the file");
    if let Err(error) = reader(&path) {
        // Messages are made of input: they must come out whole too
        let _ = error.to_string();
    }
}

/// Reads a scene, and all that it names in the folder.
pub fn scene(name: &str, bytes: &[u8]) {
    read(name, bytes, |path| dapple::import::read_scene(path, &[]));
}
