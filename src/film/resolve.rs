//! From exact sums to a picture of 32-bit floats.

use super::sums::PixelSums;
use super::{Film, Frame};
use crate::layout::AOV_BITS;

/// Means of the samples, one value a pixel of the window, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Size, window, units and seed of the film that it comes from.
    pub frame: Frame,
    /// Radiance, linear red, green, blue; of a transparent film without the sky behind the scene, so premultiplied.
    pub rgb: Vec<[f32; 3]>,
    /// Part of the samples whose camera ray hit something.
    pub alpha: Vec<f32>,
    /// Mean albedo from 0 to 1, red, green, blue; what shines counts as far as there is room.
    pub albedo: Vec<[f32; 3]>,
    /// Mean normal in world space, on the side that is seen; shorter than 1 where the normals of the samples differ.
    pub normal: Vec<[f32; 3]>,
    /// Mean distance from the camera, in scene units, over the samples that have one; infinite where none has.
    pub depth: Vec<f32>,
    /// Variance of `rgb`, from the squares of the samples as if these were independent: 0 below two samples.
    /// Conservative (too large) under Owen-scrambled Sobol and stratified samples, which err less than that.
    pub variance: Vec<[f32; 3]>,
    /// Number of samples.
    pub samples: Vec<u32>,
}

impl Picture {
    /// Takes the values of pixels without samples from another picture, if it is one of the same window.
    pub fn fill_gaps(&mut self, other: &Picture) {
        let place = |frame: &Frame| (frame.width, frame.height, frame.window);
        if place(&self.frame) != place(&other.frame) {
            return;
        }
        for i in (0..self.samples.len()).filter(|&i| self.samples[i] == 0) {
            (self.rgb[i], self.alpha[i]) = (other.rgb[i], other.alpha[i]);
            (self.albedo[i], self.normal[i], self.depth[i]) =
                (other.albedo[i], other.normal[i], other.depth[i]);
            self.variance[i] = other.variance[i];
        }
    }
}

impl Film {
    /// Means and variances of the samples so far. A pixel without samples is 0 with infinite depth.
    pub fn resolve(&self) -> Picture {
        let frame = self.frame;
        let radiance_unit = 2f64.powi(frame.radiance_exponent);
        let depth_unit = 2f64.powi(frame.depth_exponent);
        let aov_unit = 2f64.powi(-(AOV_BITS as i32));
        let each = |value: &dyn Fn(&PixelSums) -> f32| self.pixels.iter().map(value).collect::<Vec<_>>();
        let each3 = |value: &dyn Fn(&PixelSums, usize) -> f32| {
            self.pixels.iter().map(|p| [0, 1, 2].map(|c| value(p, c))).collect::<Vec<_>>()
        };
        Picture {
            frame,
            rgb: each3(&|p, c| mean(p.radiance[c], radiance_unit, p.samples)),
            alpha: each(&|p| mean(i64::from(p.covered), 1.0, p.samples)),
            albedo: each3(&|p, c| mean(p.albedo[c], aov_unit, p.samples)),
            normal: each3(&|p, c| mean(p.normal[c], aov_unit, p.samples)),
            depth: each(&|p| match p.depth_hits {
                0 => f32::INFINITY,
                hits => mean(p.depth, depth_unit, hits),
            }),
            variance: each3(&|p, c| {
                variance_of_mean(p.radiance[c], p.squares[c], p.samples, radiance_unit) as f32
            }),
            samples: self.pixels.iter().map(|p| p.samples).collect(),
        }
    }
}

/// Mean of `count` samples, 0 without samples.
fn mean(sum: i64, unit: f64, count: u32) -> f32 {
    if count == 0 { 0.0 } else { (sum as f64 * unit / f64::from(count)) as f32 }
}

/// Unbiased variance of the mean of `n` independent samples, `(Σx² - (Σx)²/n) / (n (n - 1))`.
///
/// `n Σx² - (Σx)²` is taken in whole numbers, because the two terms nearly cancel where noise is small. With
/// |Σx| < 2^63 and n <= 2^20 both fit; contradictory sums saturate and never give a negative variance.
fn variance_of_mean(sum: i64, squares: u128, n: u32, unit: f64) -> f64 {
    if n < 2 {
        return 0.0;
    }
    let square_of_sum = u128::from(sum.unsigned_abs()).pow(2);
    let spread = squares.saturating_mul(u128::from(n)).saturating_sub(square_of_sum);
    let n = f64::from(n);
    spread as f64 / (n * n * (n - 1.0)) * unit * unit
}

#[cfg(test)]
mod tests {
    use super::variance_of_mean;
    use proptest::prelude::*;

    #[test]
    fn variance_of_known_samples() {
        // 1, 2, 3, 4: sample variance 5/3, of the mean 5/12; in units of 1/2 everything is half as large
        assert_eq!(variance_of_mean(10, 30, 4, 1.0), 5.0 / 12.0);
        assert_eq!(variance_of_mean(10, 30, 4, 0.5), 5.0 / 48.0);
        assert_eq!(variance_of_mean(-10, 30, 4, 1.0), 5.0 / 12.0);
        assert_eq!(variance_of_mean(7, 49, 1, 1.0), 0.0);
        assert_eq!(variance_of_mean(0, 0, 0, 1.0), 0.0);
    }

    #[test]
    fn tiny_noise_on_a_bright_pixel_survives() {
        // Samples B and B + 1 by turns: n Σx² - (Σx)² = n²/4 exactly, lost if the terms were rounded to f64
        let (bright, n) = (1i64 << 42, 1u32 << 20);
        let half = i64::from(n / 2);
        let squares = half as u128 * ((bright as u128).pow(2) + (bright as u128 + 1).pow(2));
        let variance = variance_of_mean(half * (2 * bright + 1), squares, n, 1.0);
        assert_eq!(variance, 0.25 / f64::from(n - 1));
    }

    #[test]
    fn largest_and_contradictory_sums_are_not_negative() {
        for (sum, squares) in [(i64::MIN, 0), (i64::MIN, u128::MAX), (i64::MAX, 1), (0, u128::MAX)] {
            let variance = variance_of_mean(sum, squares, 1 << 20, 1.0);
            assert!(variance >= 0.0 && variance.is_finite(), "{sum} {squares}: {variance}");
        }
    }

    proptest! {
        #[test]
        fn agrees_with_two_passes_in_f64(xs in prop::collection::vec(-1_000_000i64..1_000_000, 2..200)) {
            let n = xs.len() as f64;
            let mean = xs.iter().map(|&x| x as f64).sum::<f64>() / n;
            let spread = xs.iter().map(|&x| (x as f64 - mean).powi(2)).sum::<f64>();
            let expected = spread / (n * (n - 1.0));
            let squares = xs.iter().map(|&x| (x * x) as u128).sum();
            let variance = variance_of_mean(xs.iter().sum(), squares, xs.len() as u32, 1.0);
            // Two-pass sums of 200 doubles are good to about 200 * 2^-53 of the spread
            prop_assert!((variance - expected).abs() <= 1e-12 * expected);
        }
    }
}
