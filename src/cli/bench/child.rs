//! What a start costs, measured in processes of their own: only there the driver has not compiled anything yet, and its
//! cache on disk can be another one.

use dapple::{Error, Result};
use std::path::Path;
use std::process::Command;

/// Tells a process its task: the task and the name of the scene.
const VARIABLE: &str = "DAPPLE_BENCH_TASK";

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Task {
    /// Compiling the kernels of a wave and dispatching each once.
    Kernels,
    /// From the start of the command to the end of the first slice.
    FirstSlice,
}

const TASKS: [(&str, Task); 2] = [("kernels", Task::Kernels), ("first-slice", Task::FirstSlice)];

/// The task of this process and its scene, when it is one that [`Caches::seconds`] started.
pub(super) fn own_task() -> Option<(Task, String)> {
    let text = std::env::var(VARIABLE).ok()?;
    let (task, scene) = text.split_once(':')?;
    let task = TASKS.iter().find(|(name, _)| *name == task)?.1;
    Some((task, scene.to_owned()))
}

/// Caches of kernels on disk, ours and the driver's: empty at first, filled by the processes that use them.
pub(super) struct Caches(tempfile::TempDir);

impl Caches {
    pub(super) fn new() -> Result<Self> {
        let folder = tempfile::tempdir().map_err(|error| {
            Error::output(format!("cannot make a folder for caches: {error}"))
                .help("point TMPDIR to a folder that you may write to")
        })?;
        Ok(Self(folder))
    }

    /// Runs this command again with a task, and returns the seconds that it measures.
    pub(super) fn seconds(&self, task: Task, scene: &str) -> Result<f64> {
        let name = TASKS.iter().find(|(_, known)| *known == task).map_or("", |(name, _)| name);
        let failed = |why: &str| {
            Error::device(format!("measuring `{name}` of {scene} in a process of its own failed: {why}"))
                .help("look whether `dapple render` works with the same device and shaders")
        };
        let folder = |name: &str| -> std::path::PathBuf { Path::join(self.0.path(), name) };
        let program = std::env::current_exe().map_err(|error| failed(&error.to_string()))?;
        let output = Command::new(program)
            .args(std::env::args_os().skip(1))
            .env(VARIABLE, format!("{name}:{scene}"))
            .env_remove("DAPPLE_CACHE")
            .env("DAPPLE_CACHE_DIR", folder("kernels"))
            .env("MESA_SHADER_CACHE_DIR", folder("mesa"))
            .env("__GL_SHADER_DISK_CACHE_PATH", folder("nvidia"))
            .output()
            .map_err(|error| failed(&error.to_string()))?;
        if !output.status.success() {
            return Err(failed(String::from_utf8_lossy(&output.stderr).trim()));
        }
        let text = String::from_utf8_lossy(&output.stdout);
        text.trim().parse().map_err(|_| failed(&format!("it printed `{}`", text.trim())))
    }
}
