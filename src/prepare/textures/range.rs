//! How bright textures are.

use glam::Vec3;

/// Least, mean and largest of the values of a texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    pub min: f64,
    pub mean: f64,
    pub max: f64,
}

impl Range {
    /// Of a constant.
    pub(super) fn of(color: Vec3) -> Self {
        Self {
            min: f64::from(color.min_element()),
            mean: f64::from(mean(color)),
            max: f64::from(color.max_element()),
        }
    }

    /// Of values between those of two textures, of which the second has `share` on average.
    pub(super) fn mixed(self, other: Self, share: f64) -> Self {
        self.zip(other, f64::min, |a, b| (1.0 - share) * a + share * b, f64::max)
    }

    /// Of (1 − t) a + t b, with t between the first and the last of `shares` and the second of them on average.
    pub(super) fn along(self, other: Self, [least, share, most]: [f64; 3]) -> Self {
        let at = |t: f64| {
            let part =
                |range: Self, factor: f64| range.times(Self { min: factor, mean: factor, max: factor });
            let sum = |a: f64, b: f64| a + b;
            part(self, 1.0 - t).zip(part(other, t), sum, sum, sum)
        };
        let (low, middle, high) = (at(least), at(share), at(most));
        Self { min: low.min.min(high.min), mean: middle.mean, max: low.max.max(high.max) }
    }

    /// Of products.
    pub(super) fn times(self, other: Self) -> Self {
        let ends = [self.min * other.min, self.min * other.max, self.max * other.min, self.max * other.max];
        Self {
            min: ends.into_iter().fold(f64::INFINITY, f64::min),
            mean: self.mean * other.mean,
            max: ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
        }
    }

    pub(super) fn zip(
        self,
        other: Self,
        min: impl Fn(f64, f64) -> f64,
        mean: impl Fn(f64, f64) -> f64,
        max: impl Fn(f64, f64) -> f64,
    ) -> Self {
        Self {
            min: min(self.min, other.min),
            mean: mean(self.mean, other.mean),
            max: max(self.max, other.max),
        }
    }
}

/// Of the channels of a colour.
pub(super) fn mean(color: Vec3) -> f32 {
    color.element_sum() / 3.0
}
