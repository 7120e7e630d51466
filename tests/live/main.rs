//! A scene that is edited while it is shown: with real files, on a device, under the validation layer where `DAPPLE_VALIDATION` is set.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by a panic, in its helpers too")]

mod browser;
mod edits;
mod leaks;
mod page;
mod server;
mod stage;

use dapple::gpu::{DeviceChoice, Gpu, validation_from_environment};
use dapple::live::{Live, Request, State, Studio};
use dapple::shader::CacheOptions;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use tempfile::TempDir;

const SCENE: &str = r#"
film.size = [16, 12]
render.max_depth = 2

[camera]
position = [0, 1, 5]
fov = 35

[texture.picture]
kind = "image"
file = "picture.png"

[material.clay]
kind = "diffuse"
color = 0.6

[material.papered]
kind = "diffuse"
color = { texture = "picture" }

[mesh.triangle]
file = "triangle.ply"

[[instance]]
mesh = "triangle"
material = "papered"

[[shape]]
kind = "sphere"
center = [0, 1, 0]
radius = 1
material = "clay"

[[light]]
kind = "point"
position = [3, 5, 3]
intensity = 40

[environment]
color = 0.2
"#;

const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n-3 0 -1\n3 0 -1\n0 3 -1\n3 0 1 2\n";

/// How long a test waits for what must come.
const LIMIT: Duration = Duration::from_secs(40);

/// A folder with a scene, its files, and a copy of the shaders.
struct Room {
    folder: TempDir,
}

impl Room {
    fn new() -> Self {
        let room = Self { folder: tempfile::tempdir().unwrap() };
        room.write("scene.toml", SCENE);
        room.write("triangle.ply", TRIANGLE);
        room.paint("picture.png", 90);
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &room.path("shaders"));
        room
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Saves a file in one step, so that nobody finds half of it.
    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let aside = self.path("aside");
        std::fs::write(&aside, bytes).unwrap();
        std::fs::rename(aside, self.path(name)).unwrap();
    }

    fn paint(&self, name: &str, grey: u8) {
        let mut file = std::io::Cursor::new(Vec::new());
        let picture = image::GrayImage::from_pixel(2, 2, image::Luma([grey]));
        picture.write_to(&mut file, image::ImageFormat::Png).unwrap();
        self.write(name, file.into_inner());
    }

    /// Puts another text in the place of one that is there.
    fn edit(&self, name: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path(name)).unwrap();
        assert!(text.contains(from), "{name} has no `{from}`");
        self.write(name, text.replacen(from, to, 1));
    }

    fn request(&self, cache: CacheOptions) -> Request {
        Request {
            scene: self.path("scene.toml"),
            overrides: Vec::new(),
            choice: dapple::import::ModelChoice::default(),
            shaders: Some(self.path("shaders")),
            cache,
            adjust: Box::new(|_, _| Ok(())),
        }
    }

    fn studio(&self, gpu: &Arc<Gpu>, cache: CacheOptions) -> Studio {
        Studio::new(gpu.clone(), self.request(cache)).unwrap()
    }

    fn live(&self, spp: u32) -> Live {
        Live::start(gpu(), self.request(cache()), spp).unwrap()
    }
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// A device of its own for each test, so that its objects can be counted.
fn gpu() -> Arc<Gpu> {
    let validation = validation_from_environment();
    Arc::new(Gpu::open(&DeviceChoice { validation, ..DeviceChoice::default() }).unwrap())
}

/// Kernels are cached for all tests together.
fn cache() -> CacheOptions {
    CacheOptions::Folder(Path::new(env!("CARGO_TARGET_TMPDIR")).join("kernels"))
}

/// The state, once it is one that is wanted.
fn wait(live: &Live, what: &str, wanted: impl Fn(&State) -> bool) -> State {
    let state = live.show().wait(LIMIT, |state| wanted(state));
    assert!(wanted(&state), "waited for {what}; the error is {:?}", state.error);
    state
}

/// The state when pixels of a generation are there.
fn wait_for(live: &Live, generation: u64) -> State {
    wait(live, &format!("generation {generation}"), |state| {
        state.shot.as_ref().is_some_and(|shot| shot.generation.number >= generation)
    })
}
