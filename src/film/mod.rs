//! The exact film on the host: sums of samples, their merge, what they resolve to, and the files that hold it.
//!
//! Kernels add every sample as a whole number of a fixed unit, so addition is associative and the picture does
//! not depend on tiles, slices, or on how many machines shared the samples. No GPU type appears here: a band of
//! the picture arrives as plain words (see [`WORDS_PER_PIXEL`]).

mod exr;
mod grid;
mod meter;
mod png;
mod resolve;
mod sums;
mod tone;
mod write;

pub use grid::{Grid, write_grid};
pub use meter::gain;
pub use resolve::Picture;
pub use tone::srgb;
pub use write::{Format, Meta, check_target, encode, format_of, write, write_bytes};

use crate::layout::FILM_PLANES;
use crate::scene::{MAX_SAMPLES, Rect};
use crate::{Error, Result};
use sums::PixelSums;

/// Words of 32 bits that the device holds for a pixel: [`FILM_PLANES`] planes of 4.
///
/// A band of `n` pixels (rows from top to bottom) is `n` times as many. Word `w` of pixel `i`, one of the
/// `FILM_…` of [`crate::layout`], is at `(w / 4 * n + i) * 4 + w % 4`.
pub const WORDS_PER_PIXEL: usize = 4 * FILM_PLANES as usize;

/// What films must agree on to be parts of one picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame {
    /// Columns of the whole picture.
    pub width: u32,
    /// Rows of the whole picture.
    pub height: u32,
    /// The pixels that the film holds.
    pub window: Rect,
    /// The unit of radiance sums is 2 to this power; the unit of their squares is its square.
    pub radiance_exponent: i32,
    /// The unit of depth sums, in scene units, is 2 to this power.
    pub depth_exponent: i32,
    /// Seed of all random numbers.
    pub seed: u32,
}

/// Exact sums of the samples of every pixel of a window.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Film {
    frame: Frame,
    pixels: Vec<PixelSums>,
}

impl Film {
    /// A film without samples.
    ///
    /// # Errors
    ///
    /// When the window is empty or reaches out of the picture, or when the host has no memory for it
    /// (160 bytes a pixel).
    pub fn new(frame: Frame) -> Result<Self> {
        let window = frame.window;
        let inside = window.x0 < window.x1
            && window.x1 <= frame.width
            && window.y0 < window.y1
            && window.y1 <= frame.height;
        if !inside {
            return Err(Error::scene(format!(
                "the window {} is empty or not inside the picture of {} x {} pixels",
                show(window),
                frame.width,
                frame.height
            ))
            .help("give it as x0,y0,x1,y1 with x0 < x1 and y0 < y1, the last ones excluded"));
        }
        let no_memory = || {
            let mib = (window.area() >> 20).saturating_mul(size_of::<PixelSums>() as u64);
            Error::device(format!(
                "the film of {} x {} pixels needs {mib} MiB of host memory, which the system refuses",
                window.width(),
                window.height()
            ))
            .help("render a smaller picture, or parts of it with --crop")
        };
        let count = usize::try_from(window.area()).map_err(|_| no_memory())?;
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| no_memory())?;
        pixels.resize(count, PixelSums::default());
        Ok(Self { frame, pixels })
    }

    /// Size, window, units and seed.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Adds a band that came from the device: `rect` in pixels of the whole picture, `words` as
    /// [`WORDS_PER_PIXEL`] says.
    ///
    /// # Errors
    ///
    /// When `rect` is not inside the window, the number of words is not that of `rect`, or a pixel would have
    /// more than [`MAX_SAMPLES`] samples. The film is then as before.
    pub fn add(&mut self, rect: Rect, words: &[u32]) -> Result<()> {
        let window = self.frame.window;
        let inside = window.x0 <= rect.x0
            && rect.x0 <= rect.x1
            && rect.x1 <= window.x1
            && window.y0 <= rect.y0
            && rect.y0 <= rect.y1
            && rect.y1 <= window.y1;
        if !inside {
            return Err(Error::device(format!(
                "the band {} is not inside the window {} of the film",
                show(rect),
                show(window)
            )));
        }
        let count = rect.area() as usize;
        if words.len() != count * WORDS_PER_PIXEL {
            return Err(Error::device(format!(
                "the band {} came with {} words from the device, expected {}",
                show(rect),
                words.len(),
                count * WORDS_PER_PIXEL
            )));
        }
        for (source, target) in self.targets(rect).enumerate() {
            self.check_room(target, sums::samples_in(words, count, source))?;
        }
        for (source, target) in self.targets(rect).enumerate() {
            self.pixels[target].add(&PixelSums::from_words(words, count, source));
        }
        Ok(())
    }

    /// Adds the samples of another film of the same picture. The result does not depend on the order of merges.
    ///
    /// The caller sees to it that the two hold different samples; a sample in both would count twice.
    ///
    /// # Errors
    ///
    /// When size, window, units or seed differ, or a pixel would have more than [`MAX_SAMPLES`] samples. The
    /// film is then as before.
    pub fn merge(&mut self, other: &Film) -> Result<()> {
        let (a, b) = (&self.frame, &other.frame);
        let refuse = |what: &str, mine: String, theirs: String| {
            Err(Error::scene(format!("cannot merge films: {what} differs, {mine} and {theirs}"))
                .help("merge only films that were rendered from one scene with the same settings and seed"))
        };
        if (a.width, a.height) != (b.width, b.height) {
            let size = |f: &Frame| format!("{} x {}", f.width, f.height);
            return refuse("the size in pixels", size(a), size(b));
        }
        if a.window != b.window {
            return refuse("the window", show(a.window), show(b.window));
        }
        let unit = |exponent: i32| format!("2^{exponent}");
        if a.radiance_exponent != b.radiance_exponent {
            return refuse("the unit of radiance", unit(a.radiance_exponent), unit(b.radiance_exponent));
        }
        if a.depth_exponent != b.depth_exponent {
            return refuse("the unit of depth", unit(a.depth_exponent), unit(b.depth_exponent));
        }
        if a.seed != b.seed {
            return refuse("the seed", a.seed.to_string(), b.seed.to_string());
        }
        for (target, sums) in other.pixels.iter().enumerate() {
            self.check_room(target, sums.samples)?;
        }
        for (mine, theirs) in self.pixels.iter_mut().zip(&other.pixels) {
            mine.add(theirs);
        }
        Ok(())
    }

    /// Samples left out because a channel was not finite, over all pixels.
    pub fn left_out(&self) -> u64 {
        self.pixels.iter().map(|p| u64::from(p.left_out)).sum()
    }

    /// The first pixel, row by row, that left out a sample because a channel was not finite: column and row in the
    /// whole picture.
    pub fn first_left_out(&self) -> Option<[u32; 2]> {
        let (window, at) = (self.frame.window, self.pixels.iter().position(|p| p.left_out > 0)?);
        let columns = window.width() as usize;
        Some([window.x0 + (at % columns) as u32, window.y0 + (at / columns) as u32])
    }

    /// Samples clamped to what the sums can hold, over all pixels.
    pub fn clamped(&self) -> u64 {
        self.pixels.iter().map(|p| u64::from(p.clamped)).sum()
    }

    /// The largest number of samples of any pixel.
    pub fn samples_per_pixel(&self) -> u32 {
        self.pixels.iter().map(|p| p.samples).max().unwrap_or(0)
    }

    /// Indices of the pixels of `rect` in the window, row by row.
    fn targets(&self, rect: Rect) -> impl Iterator<Item = usize> + use<> {
        let window = self.frame.window;
        (rect.y0..rect.y1).flat_map(move |y| {
            let row = (y - window.y0) as usize * window.width() as usize;
            (rect.x0..rect.x1).map(move |x| row + (x - window.x0) as usize)
        })
    }

    /// Refuses more samples than the sums of a pixel can hold.
    fn check_room(&self, pixel: usize, more: u32) -> Result<()> {
        let total = u64::from(self.pixels[pixel].samples) + u64::from(more);
        if total <= u64::from(MAX_SAMPLES) {
            return Ok(());
        }
        Err(Error::device(format!("{total} samples in one pixel, the film holds at most {MAX_SAMPLES}"))
            .help("render with fewer samples a pixel (--spp)"))
    }
}

/// A rectangle as the command line takes it.
fn show(rect: Rect) -> String {
    format!("{},{},{},{}", rect.x0, rect.y0, rect.x1, rect.y1)
}

#[cfg(test)]
mod tests;
