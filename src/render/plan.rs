//! The plan of a render, without a device: slices of tiles × samples.

use crate::layout::{TILE, WORKGROUP};
use crate::scene::Rect;

/// A run of tiles and samples that goes to the device at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slice {
    /// First tile, row by row in the window.
    pub first_tile: u32,
    /// Number of tiles.
    pub tiles: u32,
    /// First sample of each pixel.
    pub first_sample: u32,
    /// Number of samples.
    pub samples: u32,
}

impl Slice {
    /// Paths of the slice, those of tiles that reach beyond the window included.
    pub fn slots(&self) -> u32 {
        self.tiles * self.samples * WORKGROUP
    }
}

/// Tiles of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tiles {
    /// In a row.
    pub columns: u32,
    /// In a column.
    pub rows: u32,
}

impl Tiles {
    /// The tiles that cover a window.
    pub fn of(window: Rect) -> Self {
        Self { columns: window.width().div_ceil(TILE), rows: window.height().div_ceil(TILE) }
    }

    /// All tiles.
    pub fn count(&self) -> u32 {
        self.columns * self.rows
    }
}

/// Walks over a picture pass by pass: a pass gives every pixel the same number of samples.
///
/// The order is bands of tiles that fit the film on the device, then slices within a band. The pixels do not depend on
/// it: every sample is a function of (pixel, sample) and their sums are exact.
#[derive(Debug, Clone)]
pub struct Plan {
    tiles: u32,
    band: u32,
    end_sample: u32,
    next_tile: u32,
    next_sample: u32,
    pass_samples: u32,
    /// Samples of the next pass, while the picture is to be seen soon.
    soon: Option<u32>,
}

impl Plan {
    /// A plan for `tiles` tiles in bands of at most `band`, samples `first..first + spp`.
    pub fn new(tiles: u32, band: u32, first: u32, spp: u32) -> Self {
        Self {
            tiles,
            band: band.max(1),
            end_sample: first.saturating_add(spp),
            next_tile: 0,
            next_sample: first,
            pass_samples: 0,
            soon: None,
        }
    }

    /// The same, with a first pass of one sample, and each pass after it as long as all before, until they are as long as they get.
    pub fn soon(self) -> Self {
        Self { soon: Some(1), ..self }
    }

    /// The next slice of at most about `slots` paths; none when the picture is done.
    pub fn next(&mut self, slots: u32) -> Option<Slice> {
        if self.next_sample >= self.end_sample || self.tiles == 0 {
            return None;
        }
        let capacity = (slots / WORKGROUP).max(1);
        if self.next_tile == 0 {
            let most = self.soon.unwrap_or(u32::MAX).min(self.end_sample - self.next_sample);
            self.pass_samples = pass_samples(capacity, self.tiles).min(most);
            self.soon = self.soon.and_then(|now| now.checked_mul(2));
        }
        let band_end = (self.next_tile / self.band + 1).saturating_mul(self.band).min(self.tiles);
        let tiles = (capacity / self.pass_samples).max(1).min(band_end - self.next_tile);
        let slice = Slice {
            first_tile: self.next_tile,
            tiles,
            first_sample: self.next_sample,
            samples: self.pass_samples,
        };
        self.next_tile += tiles;
        if self.next_tile == self.tiles {
            self.next_tile = 0;
            self.next_sample += self.pass_samples;
        }
        Some(slice)
    }

    /// Whether every pixel has the same number of samples now.
    pub fn at_pass_end(&self) -> bool {
        self.next_tile == 0
    }

    /// The band that holds a tile: first tile and number of tiles.
    pub fn band_of(&self, tile: u32) -> (u32, u32) {
        let first = tile / self.band * self.band;
        (first, self.band.min(self.tiles - first))
    }
}

/// Samples of a pass: as many as fill a slice when the picture is small, at most [`MOST_PASS_SAMPLES`]; a few when it is
/// large, so that the rays of a pixel and the words of the film are used while they are near. Never more than fit a slice
/// of one tile: buffers are made for `capacity` workgroups.
fn pass_samples(capacity: u32, tiles: u32) -> u32 {
    (capacity / tiles).clamp(FEW_SAMPLES, MOST_PASS_SAMPLES).min(capacity)
}

const FEW_SAMPLES: u32 = 4;
const MOST_PASS_SAMPLES: u32 = 64;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_tile_and_sample_comes_once(
            tiles in 1..200_u32, band in 1..300_u32, first in 0..5_u32, spp in 1..70_u32,
            slots in prop::collection::vec(1..40_000_u32, 1..5), soon: bool,
        ) {
            let mut plan = Plan::new(tiles, band, first, spp);
            if soon {
                plan = plan.soon();
            }
            let mut seen = vec![0; (tiles * spp) as usize];
            let mut turn = 0;
            while let Some(slice) = plan.next(slots[turn % slots.len()]) {
                turn += 1;
                let (band_first, band_tiles) = plan.band_of(slice.first_tile);
                prop_assert!(slice.first_tile >= band_first);
                prop_assert!(slice.first_tile + slice.tiles <= band_first + band_tiles);
                for tile in slice.first_tile..slice.first_tile + slice.tiles {
                    for sample in slice.first_sample..slice.first_sample + slice.samples {
                        seen[(tile * spp + sample - first) as usize] += 1;
                    }
                }
                if plan.at_pass_end() {
                    // The samples so far are the same in every tile.
                    let row = |tile: u32| &seen[(tile * spp) as usize..((tile + 1) * spp) as usize];
                    prop_assert!((0..tiles).all(|tile| row(tile) == row(0)));
                }
            }
            prop_assert!(seen.iter().all(|&n| n == 1));
        }
    }

    proptest! {
        #[test]
        fn slices_fit_the_slots(tiles in 1..200_u32, spp in 1..70_u32, groups in 1..5000_u32) {
            let mut plan = Plan::new(tiles, tiles, 0, spp);
            while let Some(slice) = plan.next(groups * WORKGROUP) {
                prop_assert!(slice.slots() <= groups * WORKGROUP);
            }
        }
    }

    #[test]
    fn the_first_passes_are_short_when_they_are_wanted_soon() {
        let mut plan = Plan::new(2, 2, 0, 100).soon();
        let passes: Vec<u32> =
            std::iter::from_fn(|| plan.next(WORKGROUP * 16)).map(|slice| slice.samples).collect();
        assert_eq!(passes[..6], [1, 2, 4, 8, 8, 8]);
        assert_eq!(passes.iter().sum::<u32>(), 100);
    }

    #[test]
    fn a_window_is_covered_by_tiles() {
        let tiles = Tiles::of(Rect { x0: 3, y0: 0, x1: 20, y1: 8 });
        assert_eq!(tiles, Tiles { columns: 3, rows: 1 });
    }
}
