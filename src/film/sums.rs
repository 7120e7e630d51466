//! The sums of one pixel: decoding from device words and exact addition.

/// Plane and word in the plane that hold the number of samples.
pub(super) const SAMPLES_WORD: (usize, usize) = (1, 2);

/// Unit of albedo and normal sums is 2 to this power.
pub(super) const AOV_EXPONENT: i32 = -20;

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
        let word = |plane: usize, c: usize| words[(plane * count + index) * 4 + c];
        let sum64 = |plane, c| (u64::from(word(plane, c)) | u64::from(word(plane, c + 1)) << 32) as i64;
        let sum96 = |plane| {
            u128::from(word(plane, 0)) | u128::from(word(plane, 1)) << 32 | u128::from(word(plane, 2)) << 64
        };
        Self {
            squares: [sum96(2), sum96(3), sum96(4)],
            radiance: [sum64(0, 0), sum64(0, 2), sum64(1, 0)],
            albedo: [sum64(5, 0), sum64(5, 2), sum64(6, 0)],
            normal: [sum64(7, 0), sum64(7, 2), sum64(8, 0)],
            depth: sum64(6, 2),
            samples: word(SAMPLES_WORD.0, SAMPLES_WORD.1),
            covered: word(1, 3),
            depth_hits: word(8, 2),
            left_out: word(2, 3),
            clamped: word(3, 3),
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
