//! How long slices are.

use crate::gpu::{DeviceType, Gpu};
use std::time::Duration;

/// How a render is cut into slices. The pixels do not depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slicing {
    /// Most paths of a slice.
    pub slots: u32,
    /// Time that a slice should take. The number of paths begins at 65,536, or at `slots` when that is less, and follows
    /// the time.
    pub budget: Duration,
}

/// Most paths of the first slice: before anything was measured, a device that also draws a screen must not be kept for
/// long.
pub(super) const FIRST_SLOTS: u32 = 1 << 16;

/// Fewest paths of a slice: below it, starting kernels takes longer than running them.
pub(super) const LEAST_SLOTS: u32 = 4096;

impl Slicing {
    /// What suits a device.
    pub fn of(gpu: &Gpu) -> Self {
        let slots = if gpu.info().kind == DeviceType::Cpu { 1 << 16 } else { 1 << 20 };
        Self { slots, budget: Duration::from_millis(60) }
    }

    /// Paths of a slice from now on, when it was `now` and a slice of `slots` paths took some time. Slices of the size
    /// before may still be under way, so it is what was measured that is doubled or halved.
    ///
    /// A slice that was cut short, by the end of the picture, is no reason to change.
    pub(super) fn next(&self, now: u32, slots: u32, took: Duration) -> u32 {
        // Kernels run on whole tiles, so slices are a little below their size.
        let size = slots.next_power_of_two();
        if took > self.budget * 2 && slots >= now / 2 {
            now.min(size / 2)
        } else if took < self.budget / 4 {
            now.max(size.saturating_mul(2))
        } else {
            now
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_follow_the_time_of_a_slice_that_was_measured() {
        let slicing = Slicing { slots: 1 << 20, budget: Duration::from_millis(60) };
        let next = |now, slots, ms| slicing.next(now, slots, Duration::from_millis(ms));
        assert_eq!(next(65_536, 65_536, 10), 131_072);
        assert_eq!(next(65_536, 65_280, 10), 131_072);
        assert_eq!(next(65_536, 65_536, 60), 65_536);
        assert_eq!(next(65_536, 65_536, 121), 32_768);
        // A slice from before the last step: it was the reason for that step.
        assert_eq!(next(131_072, 65_536, 14), 131_072);
        assert_eq!(next(32_768, 65_536, 121), 32_768);
        // The rest of a picture
        assert_eq!(next(65_536, 640, 1), 65_536);
        assert_eq!(next(65_536, 640, 500), 65_536);
    }

    #[test]
    fn no_slice_is_longer_than_twice_the_longest_that_was_fast() {
        let slicing = Slicing { slots: 1 << 20, budget: Duration::from_millis(60) };
        // Two slices are under way: what is measured is one behind.
        let (mut before, mut now, mut longest) = (FIRST_SLOTS, FIRST_SLOTS, 0);
        for _ in 0..8 {
            let took = Duration::from_micros(u64::from(before) / 20);
            if took < slicing.budget {
                longest = longest.max(before);
            }
            (before, now) = (now, slicing.next(now, before, took));
            assert!(now <= 2 * longest, "{now} after {longest}");
        }
        // 20 paths a microsecond: 2^19 take 26 ms, and that is neither too long nor short enough for more.
        assert_eq!(now, 1 << 19);
    }
}
