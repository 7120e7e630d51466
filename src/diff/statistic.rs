//! The statistical test of a picture against a reference by another renderer.
//!
//! Both carry noise of known variance, so a difference counts only where it is larger than noise explains
//! (Student's t, Šidák's correction for many pixels, as the render tests of Mitsuba 3 do). Three questions are
//! asked, since noise of single pixels hides small offsets: pixels, blocks of 8 x 8, and the whole picture.

use std::fmt;

use super::Estimate;
use super::student::{critical_value, level_of_each};

/// Chance that a test over all pixels finds one that is too far off in a correct picture.
const LEVEL: f64 = 0.01;
/// Difference in radiance that does not count: half a step of 10 bits.
const ABSOLUTE: f64 = 5e-4;
/// Degrees of freedom of the variance of a reference pixel: it comes from 16 renders.
const PIXEL_DOF: u32 = 15;
/// Degrees of freedom of the variance of a block: that of 64 pixels, which are not all independent.
const BLOCK_DOF: u32 = 200;
/// Side of a block in pixels.
const BLOCK: usize = 8;
/// Part of the pixels that must agree (Mitsuba's render tests use the same).
const PIXELS_NEEDED: f64 = 0.9975;
/// Part of the blocks that must agree.
const BLOCKS_NEEDED: f64 = 0.99;
/// Standard errors that the mean of the picture may be off.
const MEAN_ERRORS: f64 = 4.0;
/// Part of the median of its 3 x 3 neighbours below which no variance is believed: all 16 renders may have
/// missed a rare event.
const NEIGHBOUR_PART: f64 = 0.25;
/// Keeps pixels without noise from dividing by zero.
const VARIANCE_FLOOR: f64 = 1e-10;

/// What a comparison found.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The pictures cannot be compared, which counts as failure.
    Refused(String),
    /// They can, and differ by so much.
    Measured(Measured),
}

/// Numbers of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Part of the pixels that agree in all channels.
    pub pixels: f64,
    /// Part of the 8 x 8 blocks that agree in all channels.
    pub blocks: f64,
    /// Largest relative difference of the mean of a channel.
    pub mean_off: f64,
    /// Whether the means agree in all channels.
    pub mean_agrees: bool,
    /// Relative mean squared error, see [`relative_mse`].
    pub relative_mse: f64,
    /// The same less what the noise of both pictures explains.
    pub relative_mse_less_noise: f64,
}

impl Measured {
    fn pixels_agree(&self) -> bool {
        self.pixels >= PIXELS_NEEDED
    }
    fn blocks_agree(&self) -> bool {
        self.blocks >= BLOCKS_NEEDED
    }
}

impl Verdict {
    /// Whether the picture passes.
    pub fn accepted(&self) -> bool {
        match self {
            Self::Refused(_) => false,
            Self::Measured(m) => m.pixels_agree() && m.blocks_agree() && m.mean_agrees,
        }
    }
}

/// One line; `!` follows each number that fails.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.accepted() { "pass " } else { "FAIL " })?;
        let mark = |agrees: bool| if agrees { ' ' } else { '!' };
        match self {
            Self::Refused(reason) => f.write_str(reason),
            Self::Measured(m) => write!(
                f,
                "pixels {:7.3} %{} blocks {:6.2} %{} mean off {:6.3} %{} relMSE {:.2e} (less noise {:+.1e})",
                100.0 * m.pixels,
                mark(m.pixels_agree()),
                100.0 * m.blocks,
                mark(m.blocks_agree()),
                100.0 * m.mean_off,
                mark(m.mean_agrees),
                m.relative_mse,
                m.relative_mse_less_noise
            ),
        }
    }
}

/// Tests `test` against `reference`; relative differences up to `systematic` do not count.
pub fn compare(reference: &Estimate, test: &Estimate, systematic: f64) -> Verdict {
    if let Some(reason) = reason_to_refuse(reference, test) {
        return Verdict::Refused(reason);
    }
    let (width, height) = (reference.width, reference.height);
    let variance = joint_variance(reference, test);
    let agreeing = |r: &[[f64; 3]], t: &[[f64; 3]], v: &[[f64; 3]], dof: u32| {
        let critical = critical_value(level_of_each(LEVEL, r.len()), dof);
        let agree = |i: &usize| {
            (0..3).all(|c| {
                let excess = (t[*i][c] - r[*i][c]).abs() - systematic * r[*i][c].abs() - ABSOLUTE;
                excess <= critical * v[*i][c].sqrt()
            })
        };
        (0..r.len()).filter(agree).count() as f64 / r.len() as f64
    };

    let blocks = |values: &[[f64; 3]]| block_means(values, width, height);
    let mut block_variance = blocks(&variance);
    block_variance.iter_mut().flatten().for_each(|v| *v /= (BLOCK * BLOCK) as f64);

    let (reference_mean, test_mean) = (mean(&reference.mean), mean(&test.mean));
    let off = [0, 1, 2].map(|c| (test_mean[c] - reference_mean[c]).abs());
    let error = mean(&variance).map(|v| (v / variance.len() as f64).sqrt());
    let mean_agrees =
        (0..3).all(|c| off[c] <= systematic * reference_mean[c] + MEAN_ERRORS * error[c] + ABSOLUTE);

    let relative_mse = relative_mse(&reference.mean, &test.mean);
    let noise = weighted_mean(&reference.mean, |i, c| variance[i][c]);
    Verdict::Measured(Measured {
        pixels: agreeing(&reference.mean, &test.mean, &variance, PIXEL_DOF),
        blocks: agreeing(&blocks(&reference.mean), &blocks(&test.mean), &block_variance, BLOCK_DOF),
        mean_off: (0..3).map(|c| off[c] / reference_mean[c]).fold(0.0, f64::max),
        mean_agrees,
        relative_mse,
        relative_mse_less_noise: relative_mse - noise,
    })
}

/// Mean of `(t - r)² / (r² + 0.01)` over all pixels and channels.
pub fn relative_mse(reference: &[[f64; 3]], test: &[[f64; 3]]) -> f64 {
    weighted_mean(reference, |i, c| (test[i][c] - reference[i][c]).powi(2))
}

/// Mean over pixels and channels of a squared quantity relative to the reference.
fn weighted_mean(reference: &[[f64; 3]], square: impl Fn(usize, usize) -> f64) -> f64 {
    let sum: f64 = (0..reference.len())
        .flat_map(|i| [0, 1, 2].map(|c| (i, c)))
        .map(|(i, c)| square(i, c) / (reference[i][c].powi(2) + 0.01))
        .sum();
    sum / (3 * reference.len()) as f64
}

/// Why no verdict on these two would mean anything.
fn reason_to_refuse(reference: &Estimate, test: &Estimate) -> Option<String> {
    let size = |e: &Estimate| format!("{} x {}", e.width, e.height);
    if size(reference) != size(test) {
        return Some(format!("size differs: reference {}, test {}", size(reference), size(test)));
    }
    if reference.width < BLOCK || reference.height < BLOCK {
        return Some(format!("{} is smaller than one block of {BLOCK} x {BLOCK}", size(reference)));
    }
    for (name, estimate) in [("reference", reference), ("test", test)] {
        let pixels = estimate.width * estimate.height;
        if estimate.mean.len() != pixels || estimate.variance.len() != pixels {
            return Some(format!("{name} has planes of a length that is not its size"));
        }
        let bad = |v: &[f64; 3]| v.iter().any(|v| !v.is_finite());
        if let Some(i) = estimate.mean.iter().position(bad) {
            let (x, y) = (i % estimate.width, i / estimate.width);
            return Some(format!("{name} has non-finite pixels, the first at {x},{y}"));
        }
        if estimate.variance.iter().any(|v| bad(v) || v.iter().any(|&v| v < 0.0)) {
            return Some(format!("{name} has a variance that is negative or not finite"));
        }
    }
    None
}

/// Variance of the difference of the two means.
fn joint_variance(reference: &Estimate, test: &Estimate) -> Vec<[f64; 3]> {
    let (width, height) = (reference.width, reference.height);
    let pixel = |i: usize| {
        let (x, y) = (i % width, i / width);
        [0, 1, 2].map(|c| {
            // Pixels beyond the border count as those on it
            let mut around = [0.0; 9];
            for (k, value) in around.iter_mut().enumerate() {
                let x = (x + k % 3).clamp(1, width) - 1;
                let y = (y + k / 3).clamp(1, height) - 1;
                *value = reference.variance[y * width + x][c];
            }
            around.sort_by(f64::total_cmp);
            reference.variance[i][c].max(NEIGHBOUR_PART * around[4]) + test.variance[i][c] + VARIANCE_FLOOR
        })
    };
    (0..width * height).map(pixel).collect()
}

/// Means of the whole blocks of a picture.
fn block_means(values: &[[f64; 3]], width: usize, height: usize) -> Vec<[f64; 3]> {
    let (columns, rows) = (width / BLOCK, height / BLOCK);
    let block = |b: usize| {
        let corner = (b / columns * width + b % columns) * BLOCK;
        let pixels: Vec<_> =
            (0..BLOCK).flat_map(|y| values[corner + y * width..][..BLOCK].iter().copied()).collect();
        mean(&pixels)
    };
    (0..columns * rows).map(block).collect()
}

/// Mean of each channel.
fn mean(values: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|c| values.iter().map(|v| v[c]).sum::<f64>() / values.len() as f64)
}
