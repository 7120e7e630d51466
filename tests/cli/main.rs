//! The command line, end to end with the built binary: each test in a folder of its own, small pictures, and the
//! validation layer loaded.
//!
//! These tests need a Vulkan driver and the validation layer; `tools/test` installs both.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by a panic, in its helpers too")]

mod bake;
mod bench;
mod checks;
mod convert;
mod diff;
mod display;
mod drivers;
mod errors;
mod models;
mod pictures;
mod shaders;
mod stopping;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// A sphere on a floor under a sky: 16 x 12 pixels, 8 samples.
const SCENE: &str = r#"
[film]
size = [16, 12]

[render]
spp = 8

[camera]
position = [0, 1.5, 5]
target = [0, 0.8, 0]
fov = 35

[material.clay]
kind = "diffuse"
color = 0.6

[[shape]]
kind = "quad"
center = [0, 0, 0]
edge_u = [10, 0, 0]
edge_v = [0, 0, -10]
material = "clay"

[[shape]]
kind = "sphere"
center = [0, 1, 0]
radius = 1
material = "clay"

[[light]]
kind = "sphere"
center = [3, 5, 3]
radius = 0.5
radiance = 40

[environment]
color = 0.2
"#;

/// A folder with `scene.toml` in it, and the program that runs there.
struct Room {
    folder: TempDir,
}

/// What a run left: exit code and both streams.
struct Ran {
    code: Option<i32>,
    out: String,
    err: String,
}

impl Room {
    fn new() -> Self {
        let room = Self { folder: tempfile::tempdir().unwrap() };
        room.write("scene.toml", SCENE);
        room
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// Names of the files in the folder, sorted.
    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The program in this folder. Kernels are cached for all tests together.
    fn program(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dapple"));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        command.env("DAPPLE_VALIDATION", "1").env("NO_COLOR", "1").env_remove("DAPPLE_CACHE");
        command.env("DAPPLE_CACHE_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("kernels"));
        command
    }

    fn run(&self, arguments: &str) -> Ran {
        Ran::from(self.program(arguments).output().unwrap())
    }

    /// The same with the driver of a manifest alone.
    fn run_on(&self, manifest: &str, arguments: &str) -> Ran {
        let mut command = self.program(arguments);
        // The loader takes the first where it knows it, the second in older versions.
        command.env("VK_DRIVER_FILES", manifest).env("VK_ICD_FILENAMES", manifest);
        Ran::from(command.env_remove("VK_ADD_DRIVER_FILES").output().unwrap())
    }
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }
}

impl Ran {
    /// Checks the exit code, and shows both streams when it is another.
    fn code(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "stdout: {}\nstderr: {}", self.out, self.err);
        self
    }

    /// Checks that stderr has a text.
    fn err_has(self, text: &str) -> Self {
        assert!(self.err.contains(text), "no `{text}` in stderr: {}", self.err);
        self
    }

    /// The events on stdout, all of which must be JSON.
    fn events(&self) -> Vec<Value> {
        self.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    /// The one event of a kind.
    fn event(&self, kind: &str) -> Value {
        let mut found: Vec<Value> = self.events().into_iter().filter(|e| e["event"] == kind).collect();
        assert_eq!(found.len(), 1, "events `{kind}` in {}", self.out);
        found.remove(0)
    }
}

/// An EXR, read back: size of the data window and planes by name.
struct Planes {
    width: usize,
    height: usize,
    planes: Vec<(String, Vec<f32>)>,
}

impl Planes {
    fn read(path: &Path) -> Self {
        use exr::prelude::*;
        let image = read_first_flat_layer_from_file(path).unwrap();
        let size = image.layer_data.size;
        let plane = |channel: &AnyChannel<FlatSamples>| {
            (channel.name.to_string(), channel.sample_data.values_as_f32().collect())
        };
        let planes = image.layer_data.channel_data.list.iter().map(plane).collect();
        Self { width: size.0, height: size.1, planes }
    }

    fn plane(&self, name: &str) -> &[f32] {
        &self.planes.iter().find(|(plane, _)| plane == name).unwrap_or_else(|| panic!("no plane {name}")).1
    }

    /// Three planes of a pixel.
    fn three(&self, names: [&str; 3], pixel: usize) -> [f32; 3] {
        names.map(|name| self.plane(name)[pixel])
    }
}

/// Columns and rows of a PNG.
fn png_size(path: &Path) -> (u32, u32) {
    image::image_dimensions(path).unwrap()
}
