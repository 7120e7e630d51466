//! A scene that is edited: from its files to a renderer, again and again. Each time is a transaction: what fails leaves the renderer
//! before as it is.

use super::Picks;
use super::files::Files;
use super::watch::names;
use crate::Result;
use crate::gpu::Gpu;
use crate::import::{ModelChoice, Warning, read_scene_with};
use crate::render::{Kept, Opened, Options, Renderer};
use crate::scene::{Camera, Film, Scene};
use crate::shader::{CacheOptions, Compiler, Sources};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Changes a scene after it was read, or refuses it for its warnings.
pub type Adjust = Box<dyn Fn(&mut Scene, &[Warning]) -> Result<()> + Send>;

/// What is shown.
pub struct Request {
    /// The scene.
    pub scene: PathBuf,
    /// Key and value, as in `--set`.
    pub overrides: Vec<(String, String)>,
    /// Time, camera and variant of models.
    pub choice: ModelChoice,
    /// Folder of shaders that come before those of the program.
    pub shaders: Option<PathBuf>,
    /// Where compiled kernels are kept.
    pub cache: CacheOptions,
    /// What else is changed.
    pub adjust: Adjust,
}

/// One state of the files, on the device.
pub struct Generation {
    /// Counts from 1.
    pub number: u64,
    /// The scene on the device.
    pub renderer: Arc<Renderer>,
    /// Size, exposure and tone curve.
    pub film: Film,
    /// The camera that is used.
    pub camera: Camera,
    /// What was read in another way than it was meant.
    pub warnings: Vec<Warning>,
    /// Seconds of reading the files.
    pub read_seconds: f64,
    /// What the rest took.
    pub opened: Opened,
}

/// Makes generations.
pub struct Studio {
    gpu: Arc<Gpu>,
    compiler: Compiler,
    request: Request,
    files: Files,
    kept: Kept,
    camera: Option<Camera>,
    number: u64,
    /// The last attempt failed, so that an edit of any shader may mend it.
    failed: bool,
}

impl Studio {
    /// Reads nothing yet.
    ///
    /// # Errors
    ///
    /// When the folder of shaders is not there or has none.
    pub fn new(gpu: Arc<Gpu>, request: Request) -> Result<Self> {
        let sources = match &request.shaders {
            Some(folder) => Sources::folder(folder)?,
            None => Sources::embedded(),
        };
        let compiler = Compiler::new(sources, request.cache.clone());
        let (files, kept) = (Files::default(), Kept::default());
        Ok(Self { gpu, compiler, request, files, kept, camera: None, number: 0, failed: false })
    }

    /// The files whose edits count, and a tree of folders in which all do.
    pub fn watched(&self) -> (&BTreeSet<PathBuf>, Option<&Path>) {
        (self.files.used(), self.request.shaders.as_deref())
    }

    /// Looks from elsewhere from now on; none = from where the scene says.
    pub fn set_camera(&mut self, camera: Option<Camera>) {
        self.camera = camera;
    }

    /// Whether it is looked at from elsewhere than the scene says.
    pub fn is_moved(&self) -> bool {
        self.camera.is_some()
    }

    /// Whether what is shown depends on one of these files, which were edited.
    pub fn touched_by(&mut self, edited: &BTreeSet<PathBuf>) -> bool {
        let of_scene: Vec<PathBuf> = self
            .files
            .used()
            .iter()
            .filter(|file| names(file).iter().any(|name| edited.contains(name)))
            .cloned()
            .collect();
        of_scene.iter().for_each(|file| self.files.forget(file));
        !of_scene.is_empty() || self.shader_touched_by(edited)
    }

    fn shader_touched_by(&self, edited: &BTreeSet<PathBuf>) -> bool {
        let Some(root) = self.request.shaders.as_ref().and_then(|root| root.canonicalize().ok()) else {
            return false;
        };
        let names = edited.iter().filter_map(|path| path.strip_prefix(&root).ok());
        names.map(|name| name.to_string_lossy().replace('\\', "/")).any(|name| {
            !self.compiler.dependents(&name).is_empty()
                || self.failed && self.compiler.sources().names().contains(&name)
        })
    }

    /// Reads the files and brings them onto the device.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong. Renderers from before go on as they were.
    pub fn generation(&mut self) -> Result<Generation> {
        let outcome = self.open();
        self.failed = outcome.is_err();
        outcome
    }

    /// Renders what is under the pixels of a generation, from the files as they are now.
    ///
    /// # Errors
    ///
    /// As [`Self::generation`].
    pub fn picks(&mut self, generation: u64) -> Result<Picks> {
        let (scene, _) = self.read()?;
        let Self { gpu, compiler, kept, .. } = self;
        Picks::new(generation, scene, |scene, view| {
            let options = Options { view: Some(view), ..Options::of(gpu) };
            Ok(Renderer::open_again(gpu.clone(), compiler, scene, options, kept)?.0)
        })
    }

    fn read(&mut self) -> Result<(Scene, Vec<Warning>)> {
        self.files.begin();
        let Request { scene, overrides, choice, .. } = &self.request;
        let read = read_scene_with(scene, overrides, choice, &mut self.files);
        self.files.end(read.is_ok());
        let (mut scene, warnings) = read?;
        (self.request.adjust)(&mut scene, &warnings)?;
        if let Some(camera) = &self.camera {
            scene.camera = camera.clone();
        }
        Ok((scene, warnings))
    }

    fn open(&mut self) -> Result<Generation> {
        let start = Instant::now();
        let (scene, warnings) = self.read()?;
        let (film, camera) = (scene.film.clone(), scene.camera.clone());
        let read_seconds = start.elapsed().as_secs_f64();
        let options = Options::of(&self.gpu);
        let opened =
            Renderer::open_again(self.gpu.clone(), &mut self.compiler, scene, options, &mut self.kept);
        let (renderer, opened) = opened.map_err(|error| self.compiler.sources().locate(error))?;
        self.number += 1;
        let renderer = Arc::new(renderer);
        Ok(Generation { number: self.number, renderer, film, camera, warnings, read_seconds, opened })
    }
}
