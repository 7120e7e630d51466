//! A picture under way: the sums so far, and the slices that are on the device.

use super::plan::{Plan, Slice, Tiles};
use super::slicing::{FIRST_SLOTS, LEAST_SLOTS};
use super::wave::Wave;
use super::{Measured, Progress, Renderer, frame};
use crate::film::Film;
use crate::gpu::{Buffer, Command, Place};
use crate::layout::{FILM_PLANES, Frame, TILE, WORD_BYTES, WORKGROUP};
use crate::scene::Rect;
use crate::{Error, Result};
use std::ops::Deref;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Bytes of film that are kept on the device at once.
const MOST_FILM_BYTES: u64 = 1 << 30;

/// Most paths of the first slice of a picture that is wanted soon.
const SOON_SLOTS: u32 = 1 << 13;

/// A picture that grows slice by slice, while it is looked at. Two slices are under way at a time.
///
/// `R` is `&Renderer`, or `Arc<Renderer>` for a picture that keeps its renderer alive.
pub struct Accumulation<R> {
    renderer: R,
    plan: Plan,
    first_sample: u32,
    waves: [Wave; 2],
    frames: [Frame; 2],
    /// The wave that takes the next slice.
    turn: usize,
    /// The slice that is under way in the other one.
    before: Option<Slice>,
    sums: Film,
    device_film: Arc<Buffer>,
    host_film: Arc<Buffer>,
    /// The band whose sums are on the device: first tile, tiles.
    dirty: Option<(u32, u32)>,
    /// Paths of the whole picture, those sent to the device, and those of them that are known to be done.
    work: u64,
    samples: u64,
    computed: u64,
    most_slots: u32,
    slots: u32,
    begun: Instant,
    last: Instant,
}

impl<R: Deref<Target = Renderer>> Accumulation<R> {
    /// Makes the buffers for samples `first_sample..first_sample + spp` of every pixel.
    ///
    /// # Errors
    ///
    /// When host or device have no memory for film and waves.
    pub fn new(renderer: R, first_sample: u32, spp: u32) -> Result<Self> {
        let gpu = &renderer.gpu;
        let tiles = Tiles::of(renderer.film_frame.window).count();
        let tile_bytes = u64::from(FILM_PLANES) * WORD_BYTES * u64::from(WORKGROUP);
        let most = (gpu.info().limits.storage_buffer_bytes.min(MOST_FILM_BYTES) / tile_bytes).max(1);
        let band = tiles.min(u32::try_from(most).unwrap_or(u32::MAX));
        let device_film = gpu.buffer("film", u64::from(band) * tile_bytes, Place::Device)?;
        let host_film = gpu.buffer("film (host)", device_film.bytes(), Place::Readback)?;
        let clear = Command::Fill { buffer: &device_film, bytes: device_film.bytes(), value: 0 };
        gpu.run(&[clear, Command::Barrier])?;
        let work = u64::from(tiles) * u64::from(WORKGROUP) * u64::from(spp);
        let most_slots = slots_within_limits(&renderer, work);
        let wave = || {
            Wave::new(gpu, &renderer.kernels, &renderer.resident, &device_film, &renderer.frame, most_slots)
        };
        let now = Instant::now();
        Ok(Self {
            plan: Plan::new(tiles, band, first_sample, spp),
            first_sample,
            waves: [wave()?, wave()?],
            frames: [renderer.frame; 2],
            turn: 0,
            before: None,
            sums: Film::new(renderer.film_frame)?,
            device_film,
            host_film,
            dirty: None,
            work,
            samples: 0,
            computed: 0,
            most_slots,
            slots: most_slots.min(FIRST_SLOTS),
            begun: now,
            last: now,
            renderer,
        })
    }

    /// The same, with first passes and slices that are short, so that there soon is something to see.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn soon(renderer: R, first_sample: u32, spp: u32) -> Result<Self> {
        let mut picture = Self::new(renderer, first_sample, spp)?;
        picture.plan = picture.plan.clone().soon();
        picture.slots = picture.slots.min(SOON_SLOTS);
        Ok(picture)
    }

    /// Has the driver do now what it puts off until a kernel is dispatched for the first time: lavapipe makes half of its code then.
    ///
    /// # Errors
    ///
    /// When the device fails.
    pub fn warm(&self) -> Result<Duration> {
        let start = Instant::now();
        self.waves[0].warm(&self.renderer.gpu, &self.renderer.kernels)?;
        Ok(start.elapsed())
    }

    /// Sends the next slice to the device and waits for the one before; none when all have been sent.
    ///
    /// # Errors
    ///
    /// When the device fails.
    pub fn step(&mut self) -> Result<Option<Progress>> {
        let Some(slice) = self.plan.next(self.slots) else { return Ok(None) };
        let band = self.plan.band_of(slice.first_tile);
        if self.dirty.is_some_and(|dirty| dirty != band) {
            self.bring_home()?;
        }
        self.start(&slice, band)?;
        // The slice before this one has been computed meanwhile.
        self.finish(1 - self.turn)?;
        if let Some(before) = self.before.replace(slice) {
            self.computed += u64::from(before.slots());
            self.adapt(before.slots());
        }
        self.last = Instant::now();
        self.turn = 1 - self.turn;
        self.samples += u64::from(slice.slots());
        let whole = if self.plan.at_pass_end() { slice.samples } else { 0 };
        Ok(Some(Progress {
            spp: slice.first_sample - self.first_sample + whole,
            done: self.samples as f64 / self.work.max(1) as f64,
            samples: self.samples,
            computed: self.computed,
            elapsed: self.begun.elapsed(),
        }))
    }

    /// Whether every pixel has the same number of samples, once what is under way is done.
    pub fn at_pass_end(&self) -> bool {
        self.plan.at_pass_end()
    }

    /// The sums of all that was sent: waits for it.
    ///
    /// # Errors
    ///
    /// When the device fails.
    pub fn film(&mut self) -> Result<&Film> {
        self.bring_home()?;
        Ok(&self.sums)
    }

    /// The same, when no more is wanted.
    ///
    /// # Errors
    ///
    /// As [`Self::film`].
    pub fn into_film(mut self) -> Result<Film> {
        self.bring_home()?;
        Ok(self.sums)
    }

    /// Renders what is left stage by stage, and says what each took.
    pub(super) fn measure(mut self) -> Result<Measured> {
        let mut measured = Measured::default();
        while let Some(slice) = self.plan.next(self.most_slots) {
            let band = self.plan.band_of(slice.first_tile);
            let Renderer { gpu, kernels, frame, .. } = &*self.renderer;
            self.frames[0] = frame::of_slice(frame, &slice, band);
            self.waves[0].measure(gpu, kernels, &self.frames[0], &mut measured)?;
            self.finish(0)?;
        }
        Ok(measured)
    }

    fn start(&mut self, slice: &Slice, band: (u32, u32)) -> Result<()> {
        self.dirty = Some(band);
        let Renderer { gpu, kernels, frame, .. } = &*self.renderer;
        self.frames[self.turn] = frame::of_slice(frame, slice, band);
        self.waves[self.turn].start(gpu, kernels, &self.frames[self.turn])
    }

    fn finish(&mut self, turn: usize) -> Result<()> {
        self.waves[turn].finish(&self.renderer.gpu, &self.renderer.kernels, &self.frames[turn])
    }

    /// Follows the time budget by steps of two, so that slices keep to few sizes.
    fn adapt(&mut self, slots: u32) {
        let next = self.renderer.slicing.next(self.slots, slots, self.last.elapsed());
        self.slots = next.clamp(LEAST_SLOTS.min(self.most_slots), self.most_slots);
    }

    /// Adds the sums on the device to those of the host, and clears them.
    fn bring_home(&mut self) -> Result<()> {
        self.finish(0)?;
        self.finish(1)?;
        self.before = None;
        self.computed = self.samples;
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

/// Slots of a wave, a whole number of workgroups: no more than the work, and no buffer beyond the limits.
fn slots_within_limits(renderer: &Renderer, work: u64) -> u32 {
    let limit = renderer.gpu.info().limits.storage_buffer_bytes / Wave::slot_bytes(&renderer.frame);
    let slots = u64::from(renderer.slicing.slots).min(limit).min(work.max(1));
    (slots as u32).next_multiple_of(WORKGROUP).max(WORKGROUP)
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
