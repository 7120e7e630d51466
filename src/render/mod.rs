//! [`Resident`] → [`Film`]: the plan and its execution.

mod camera;
mod check;
mod evaluate;
mod frame;
mod kernels;
pub mod plan;
mod resident;
mod slicing;
mod wave;

pub use check::{Checked, check_kernels};
pub use evaluate::{Evaluator, displace};
pub use kernels::{Kernels, key};
pub use resident::Resident;
pub use slicing::Slicing;

use crate::film::{self, Film};
use crate::gpu::{Buffer, Command, DeviceType, Gpu, Place};
use crate::layout::{Backend, FILM_PLANES, Frame, TILE, WORD_BYTES, WORKGROUP};
use crate::prepare::{self, Prepared, Stage};
use crate::scene::{Rect, Scene};
use crate::shader::Compiler;
use crate::{Error, Result};
use plan::{Plan, Slice, Tiles};
use slicing::{FIRST_SLOTS, LEAST_SLOTS};
use std::sync::Arc;
use std::time::{Duration, Instant};
use wave::Wave;

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
}

impl Options {
    /// What suits a device.
    pub fn of(gpu: &Gpu) -> Self {
        Self { backend: backend_of(gpu), slicing: Slicing::of(gpu) }
    }
}

/// The back end that is fastest on a device.
pub fn backend_of(gpu: &Gpu) -> Backend {
    if gpu.info().kind == DeviceType::Cpu { Backend::Texel } else { Backend::Storage }
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
    /// Prepares a scene, compiles its kernels and puts it on the device: all the way from [`Scene`] in one step. It is used up, so that
    /// host and device do not both hold its pictures.
    ///
    /// # Errors
    ///
    /// As [`prepare::prepare`], [`Kernels::new`] and [`Self::new`].
    pub fn open(gpu: Arc<Gpu>, compiler: &mut Compiler, mut scene: Scene, options: Options) -> Result<Self> {
        displace(&gpu, compiler, &mut scene, options.backend)?;
        let prepared = prepare::prepare(&scene)?;
        let kernels = Kernels::new(&gpu, compiler, &scene, &prepared, options.backend)?;
        Self::new(gpu, kernels, scene, prepared, options.slicing)
    }

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
        let frame = frame::of_scene(&scene, &prepared, threads_of(&gpu));
        let film_frame = film::Frame {
            width: scene.film.width,
            height: scene.film.height,
            window: scene.film.window(),
            radiance_exponent: prepared.radiance_exponent,
            depth_exponent: prepared.depth_exponent,
            seed: scene.render.seed,
        };
        let resident = Resident::upload(&gpu, prepared, scene.images)?;
        Ok(Self { gpu, kernels, resident, frame, film_frame, slicing })
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
        let mut run = self.start(spp)?;
        let mut plan = Plan::new(run.tiles, run.band, first_sample, spp);
        run.all(&mut plan, first_sample, watch)?;
        Ok(run.sums)
    }

    /// Makes the buffers of a render.
    fn start(&self, spp: u32) -> Result<Run<'_>> {
        let tiles = Tiles::of(self.film_frame.window).count();
        let tile_bytes = u64::from(FILM_PLANES) * WORD_BYTES * u64::from(WORKGROUP);
        let most = (self.gpu.info().limits.storage_buffer_bytes.min(MOST_FILM_BYTES) / tile_bytes).max(1);
        let band = tiles.min(u32::try_from(most).unwrap_or(u32::MAX));
        let film = self.gpu.buffer("film", u64::from(band) * tile_bytes, Place::Device)?;
        let host = self.gpu.buffer("film (host)", film.bytes(), Place::Readback)?;
        self.gpu.run(&[Command::Fill { buffer: &film, bytes: film.bytes(), value: 0 }, Command::Barrier])?;
        let work = u64::from(tiles) * u64::from(WORKGROUP) * u64::from(spp);
        let most_slots = self.slots_within_limits(work);
        Ok(Run {
            renderer: self,
            waves: [self.wave(&film, most_slots)?, self.wave(&film, most_slots)?],
            frames: [self.frame; 2],
            sums: Film::new(self.film_frame)?,
            device_film: film,
            host_film: host,
            dirty: None,
            tiles,
            band,
            work,
            most_slots,
            slots: most_slots.min(FIRST_SLOTS),
        })
    }

    /// Renders `spp` samples stage by stage, waiting after each. For measurements: the waiting makes it slower than
    /// [`Self::render`].
    ///
    /// # Errors
    ///
    /// As [`Self::render`].
    pub fn measure(&self, spp: u32) -> Result<Measured> {
        let mut run = self.start(spp)?;
        let mut plan = Plan::new(run.tiles, run.band, 0, spp);
        let mut measured = Measured::default();
        while let Some(slice) = plan.next(run.most_slots) {
            run.frames[0] = frame::of_slice(&self.frame, &slice, plan.band_of(slice.first_tile));
            run.waves[0].measure(&self.gpu, &self.kernels, &run.frames[0], &mut measured)?;
            run.finish(0)?;
        }
        Ok(measured)
    }

    fn wave(&self, film: &Arc<Buffer>, slots: u32) -> Result<Wave> {
        Wave::new(&self.gpu, &self.kernels, &self.resident, film, &self.frame, slots)
    }

    /// Slots of a wave, a whole number of workgroups: no more than the work, and no buffer beyond the limits.
    fn slots_within_limits(&self, work: u64) -> u32 {
        let limit = self.gpu.info().limits.storage_buffer_bytes / Wave::slot_bytes(&self.frame);
        let slots = u64::from(self.slicing.slots).min(limit).min(work.max(1));
        (slots as u32).next_multiple_of(WORKGROUP).max(WORKGROUP)
    }
}

/// Bytes of film that are kept on the device at once.
const MOST_FILM_BYTES: u64 = 1 << 30;

/// A render under way.
struct Run<'a> {
    renderer: &'a Renderer,
    waves: [Wave; 2],
    frames: [Frame; 2],
    sums: Film,
    device_film: Arc<Buffer>,
    host_film: Arc<Buffer>,
    /// The band whose sums are on the device: first tile, tiles.
    dirty: Option<(u32, u32)>,
    /// Tiles of the picture, and of a band of it that the film on the device holds.
    tiles: u32,
    band: u32,
    /// Paths of the whole render.
    work: u64,
    most_slots: u32,
    slots: u32,
}

impl Run<'_> {
    fn all(
        &mut self,
        plan: &mut Plan,
        first_sample: u32,
        watch: &mut dyn FnMut(&Progress) -> Next,
    ) -> Result<()> {
        let start = Instant::now();
        let (mut samples, mut computed, mut stop, mut turn) = (0_u64, 0_u64, false, 0_usize);
        let (mut last, mut before): (_, Option<Slice>) = (start, None);
        while let Some(slice) = plan.next(self.slots) {
            let band = plan.band_of(slice.first_tile);
            if self.dirty.is_some_and(|dirty| dirty != band) {
                self.bring_home()?;
            }
            self.start(turn, &slice, band)?;
            // The slice before this one has been computed meanwhile.
            self.finish(1 - turn)?;
            if let Some(before) = before.replace(slice) {
                computed += u64::from(before.slots());
                self.adapt(before.slots(), last.elapsed());
            }
            last = Instant::now();
            turn = 1 - turn;
            samples += u64::from(slice.slots());
            let progress = Progress {
                spp: slice.first_sample - first_sample + if plan.at_pass_end() { slice.samples } else { 0 },
                done: samples as f64 / self.work.max(1) as f64,
                samples,
                computed,
                elapsed: start.elapsed(),
            };
            stop |= watch(&progress) == Next::Stop;
            if stop && plan.at_pass_end() {
                break;
            }
        }
        self.bring_home()
    }

    fn start(&mut self, turn: usize, slice: &Slice, band: (u32, u32)) -> Result<()> {
        self.dirty = Some(band);
        self.frames[turn] = frame::of_slice(&self.renderer.frame, slice, band);
        self.waves[turn].start(&self.renderer.gpu, &self.renderer.kernels, &self.frames[turn])
    }

    fn finish(&mut self, turn: usize) -> Result<()> {
        self.waves[turn].finish(&self.renderer.gpu, &self.renderer.kernels, &self.frames[turn])
    }

    /// Follows the time budget by steps of two, so that slices keep to few sizes.
    fn adapt(&mut self, slots: u32, took: Duration) {
        let next = self.renderer.slicing.next(self.slots, slots, took);
        self.slots = next.clamp(LEAST_SLOTS.min(self.most_slots), self.most_slots);
    }

    /// Adds the sums on the device to those of the host, and clears them.
    fn bring_home(&mut self) -> Result<()> {
        self.finish(0)?;
        self.finish(1)?;
        let Some((first, count)) = self.dirty.take() else { return Ok(()) };
        let gpu = &self.renderer.gpu;
        let bytes = u64::from(count) * u64::from(WORKGROUP) * u64::from(FILM_PLANES) * WORD_BYTES;
        gpu.run(&[
            Command::Barrier,
            Command::Copy { from: &self.device_film, to: &self.host_film, at: 0, bytes },
            Command::Barrier,
            Command::Fill { buffer: &self.device_film, bytes: self.device_film.bytes(), value: 0 },
            Command::Barrier,
        ])?;
        let window = self.renderer.film_frame.window;
        let sums = &mut self.sums;
        self.host_film.read(bytes, |words| add_tiles(sums, window, first, count, words))?
    }
}

/// Adds tiles to the film. Each has its pixels row by row; each plane holds all tiles.
fn add_tiles(sums: &mut Film, window: Rect, first: u32, count: u32, words: &[u32]) -> Result<()> {
    let columns = Tiles::of(window).columns;
    let pixels = count as usize * WORKGROUP as usize;
    if words.len() != pixels * FILM_PLANES as usize * 4 {
        return Err(Error::device("the film on the device has the wrong length"));
    }
    let mut tile_words = Vec::new();
    for tile in 0..count {
        let at = first + tile;
        let (x0, y0) = (window.x0 + at % columns * TILE, window.y0 + at / columns * TILE);
        let rect = Rect { x0, y0, x1: (x0 + TILE).min(window.x1), y1: (y0 + TILE).min(window.y1) };
        tile_words.clear();
        for plane in 0..FILM_PLANES as usize {
            for y in 0..rect.height() {
                for x in 0..rect.width() {
                    let pixel = plane * pixels + (tile * WORKGROUP + y * TILE + x) as usize;
                    tile_words.extend_from_slice(&words[4 * pixel..4 * pixel + 4]);
                }
            }
        }
        sums.add(rect, &tile_words)?;
    }
    Ok(())
}
