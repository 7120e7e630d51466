//! The sums of one pixel: decoding from device words and exact addition.

use crate::layout::{
    FILM_ALBEDO, FILM_CLAMPED, FILM_COVERED, FILM_DEPTH, FILM_DEPTH_HITS, FILM_LEFT_OUT, FILM_NORMAL,
    FILM_RADIANCE, FILM_SAMPLES, FILM_SQUARES,
};

/// Word `word` of pixel `index` of a band of `count` pixels.
fn word_at(words: &[u32], count: usize, index: usize, word: u32) -> u32 {
    let (plane, lane) = (word as usize / 4, word as usize % 4);
    words[(plane * count + index) * 4 + lane]
}

/// Samples of pixel `index` of a band of `count` pixels.
pub(super) fn samples_in(words: &[u32], count: usize, index: usize) -> u32 {
    word_at(words, count, index, FILM_SAMPLES)
}

/// Sums over the samples of a pixel, in the units of its film. Colours are red, green, blue.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct PixelSums {
    /// Squares of the radiance of each sample, in the squared radiance unit.
    pub squares: [u128; 3],
    /// Radiance.
    pub radiance: [i64; 3],
    /// Albedo of the first surface that is not mirror or clear glass.
    pub albedo: [i64; 3],
    /// Normal there.
    pub normal: [i64; 3],
    /// Distance to it, over the samples that have one.
    pub depth: i64,
    /// Samples added.
    pub samples: u32,
    /// Samples whose camera ray hit something.
    pub covered: u32,
    /// Samples that have a depth.
    pub depth_hits: u32,
    /// Samples left out because they were not finite.
    pub left_out: u32,
    /// Samples clamped to what the sums can hold.
    pub clamped: u32,
}

impl PixelSums {
    /// Sums of pixel `index` of a band of `count` pixels; `words` has the layout of
    /// [`super::WORDS_PER_PIXEL`] and its full length.
    pub fn from_words(words: &[u32], count: usize, index: usize) -> Self {
        let word = |word| word_at(words, count, index, word);
        let sum64 = |first| (u64::from(word(first)) | u64::from(word(first + 1)) << 32) as i64;
        let sum96 = |first| {
            u128::from(word(first)) | u128::from(word(first + 1)) << 32 | u128::from(word(first + 2)) << 64
        };
        Self {
            squares: [0, 1, 2].map(|c| sum96(FILM_SQUARES + 4 * c)),
            radiance: [0, 1, 2].map(|c| sum64(FILM_RADIANCE + 2 * c)),
            albedo: [0, 1, 2].map(|c| sum64(FILM_ALBEDO + 2 * c)),
            normal: [0, 1, 2].map(|c| sum64(FILM_NORMAL + 2 * c)),
            depth: sum64(FILM_DEPTH),
            samples: word(FILM_SAMPLES),
            covered: word(FILM_COVERED),
            depth_hits: word(FILM_DEPTH_HITS),
            left_out: word(FILM_LEFT_OUT),
            clamped: word(FILM_CLAMPED),
        }
    }

    /// Adds the samples of `other`. Sums wrap as they do on the device and counts stop at their largest value,
    /// so the result never depends on the order of additions.
    pub fn add(&mut self, other: &Self) {
        for c in 0..3 {
            self.squares[c] = self.squares[c].wrapping_add(other.squares[c]);
            self.radiance[c] = self.radiance[c].wrapping_add(other.radiance[c]);
            self.albedo[c] = self.albedo[c].wrapping_add(other.albedo[c]);
            self.normal[c] = self.normal[c].wrapping_add(other.normal[c]);
        }
        self.depth = self.depth.wrapping_add(other.depth);
        self.samples = self.samples.saturating_add(other.samples);
        self.covered = self.covered.saturating_add(other.covered);
        self.depth_hits = self.depth_hits.saturating_add(other.depth_hits);
        self.left_out = self.left_out.saturating_add(other.left_out);
        self.clamped = self.clamped.saturating_add(other.clamped);
    }
}
