//! [`Resident`] → [`Film`]: the plan and its execution.

mod accumulate;
mod camera;
mod check;
mod displace;
mod evaluate;
mod frame;
mod kernels;
mod open;
pub mod plan;
mod resident;
mod slicing;
mod uploads;
mod wave;

pub use accumulate::Accumulation;
pub use check::{Checked, check_kernels};
pub use displace::displace;
pub use evaluate::Evaluator;
pub use kernels::{Kernels, add_generated, key};
pub use open::{Kept, Opened};
pub use resident::Resident;
pub use slicing::Slicing;
pub use uploads::Uploads;

pub use crate::prepare::View;

use crate::Result;
use crate::film::{self, Film};
use crate::gpu::{DeviceInfo, DeviceType, Gpu};
use crate::layout::{Backend, Frame, WORD_BYTES};
use crate::prepare::{Prepared, Stage};
use crate::scene::Scene;
use std::sync::Arc;
use std::time::Duration;

/// What a render did so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Samples a pixel that every pixel has.
    pub spp: u32,
    /// Share of the work that is done, 0..=1.
    pub done: f64,
    /// Paths that were sent to the device.
    pub samples: u64,
    /// Those of them that are known to be done.
    pub computed: u64,
    /// Since the first slice began.
    pub elapsed: Duration,
}

/// Whether a render goes on. It is asked after every slice; it stops at the end of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// Go on.
    Continue,
    /// Stop when every pixel has the same number of samples.
    Stop,
}

/// Rays and the time that they took.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rays {
    /// Number of rays.
    pub count: u64,
    /// Seconds of the kernel that traced them.
    pub seconds: f64,
}

impl Rays {
    fn add(&mut self, count: u32, seconds: f64) {
        self.count += u64::from(count);
        self.seconds += seconds;
    }

    /// Millions a second; 0 when there were none.
    pub fn mega_per_second(&self) -> f64 {
        if self.seconds > 0.0 { self.count as f64 / self.seconds / 1e6 } else { 0.0 }
    }
}

/// What the stages of a render took.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Measured {
    /// Seconds of each stage, in the order of [`Stage::WAVE`].
    pub seconds: [f64; Stage::WAVE.len()],
    /// First rays of the paths.
    pub camera: Rays,
    /// Their other rays.
    pub bounce: Rays,
    /// Shadow rays.
    pub shadow: Rays,
}

/// A scene on a device, ready to render.
pub struct Renderer {
    gpu: Arc<Gpu>,
    kernels: Kernels,
    resident: Resident,
    frame: Frame,
    film_frame: film::Frame,
    slicing: Slicing,
}

/// How a scene is brought onto a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// How kernels read.
    pub backend: Backend,
    /// How the work is cut.
    pub slicing: Slicing,
    /// What is shown in place of the picture.
    pub view: Option<View>,
}

impl Options {
    /// What suits a device: the picture.
    pub fn of(gpu: &Gpu) -> Self {
        Self { backend: backend_of(gpu), slicing: Slicing::of(gpu), view: None }
    }
}

/// The back end that is fastest on a device: texels on lavapipe. The texel buffers of SwiftShader end at 1 MiB, which no scene fits in.
pub fn backend_of(gpu: &Gpu) -> Backend {
    let DeviceInfo { kind, limits, .. } = gpu.info();
    let are_long = limits.texel_buffer_elements.saturating_mul(WORD_BYTES) >= limits.storage_buffer_bytes;
    if *kind == DeviceType::Cpu && are_long { Backend::Texel } else { Backend::Storage }
}

/// Threads among which a driver cuts a dispatch into contiguous parts.
fn threads_of(gpu: &Gpu) -> u32 {
    if gpu.info().kind != DeviceType::Cpu {
        return 1;
    }
    let named = std::env::var("LP_NUM_THREADS").ok().and_then(|text| text.parse().ok());
    named.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, |n| n.get() as u32)).clamp(1, 1024)
}

impl Renderer {
    /// Puts a scene on the device, with the kernels that were made for it.
    ///
    /// # Errors
    ///
    /// When the scene is larger than the memory or the buffers of the device.
    pub fn new(
        gpu: Arc<Gpu>,
        kernels: Kernels,
        scene: Scene,
        prepared: Prepared,
        slicing: Slicing,
    ) -> Result<Self> {
        Self::place(gpu, kernels, scene, prepared, slicing, &mut Uploads::default())
    }

    fn place(
        gpu: Arc<Gpu>,
        kernels: Kernels,
        scene: Scene,
        prepared: Prepared,
        slicing: Slicing,
        uploads: &mut Uploads,
    ) -> Result<Self> {
        let frame = frame::of_scene(&scene, &prepared, threads_of(&gpu));
        let film_frame = film::Frame {
            width: scene.film.width,
            height: scene.film.height,
            window: scene.film.window(),
            radiance_exponent: prepared.radiance_exponent,
            depth_exponent: prepared.depth_exponent,
            seed: scene.render.seed,
        };
        let resident = Resident::upload(&gpu, prepared, scene.images, uploads)?;
        Ok(Self { gpu, kernels, resident, frame, film_frame, slicing })
    }

    /// The device that it is on.
    pub fn device(&self) -> &DeviceInfo {
        self.gpu.info()
    }

    /// The kernels of the scene. Who holds a copy of them spares the next renderer that needs the same ones compiling them.
    pub fn kernels(&self) -> &Kernels {
        &self.kernels
    }

    /// Renders samples `first_sample..first_sample + spp` of every pixel. `watch` is told after every slice.
    ///
    /// # Errors
    ///
    /// When host or device have no memory for film and waves, or the device fails.
    pub fn render(
        &self,
        first_sample: u32,
        spp: u32,
        watch: &mut dyn FnMut(&Progress) -> Next,
    ) -> Result<Film> {
        let mut picture = Accumulation::new(self, first_sample, spp)?;
        let mut stop = false;
        while !(stop && picture.at_pass_end())
            && let Some(progress) = picture.step()?
        {
            stop |= watch(&progress) == Next::Stop;
        }
        picture.into_film()
    }

    /// Renders `spp` samples stage by stage, waiting after each. For measurements: the waiting makes it slower than
    /// [`Self::render`].
    ///
    /// # Errors
    ///
    /// As [`Self::render`].
    pub fn measure(&self, spp: u32) -> Result<Measured> {
        Accumulation::new(self, 0, spp)?.measure()
    }
}
