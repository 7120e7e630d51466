//! Bounds of the exit pupil: where on the plane of the last vertex rays from the film must cross to get through the lens.
//!
//! As in pbrt-v4 they depend on the distance of the film point from the middle of the film; the pupil of another point is that of
//! one on the x axis, turned. pbrt throws a million rays for each; here the edge is found by bisection, because what gets through
//! is an intersection of images of disks whose centres are on the x axis: it meets the axis, and each line across it in one piece.

use super::trace::{LensRay, LensTrace};
use crate::layout::{PUPIL_INTERVALS, PupilBounds};
use glam::{DVec2, DVec3};

/// Rays along the x axis that look for the pupil.
const SCAN: u32 = 512;
/// Lines across the axis on which its edge is found.
const LINES: u32 = 33;
/// Halvings of an interval around an edge.
const HALVINGS: u32 = 16;
/// Columns and rows of the rays that look for parts which the lines have missed, and how far they look, in parts of the pupil.
const GRID: [u32; 2] = [24, 12];
const GRID_REACH: f64 = 0.25;
/// What is added on each side, in parts of the size: the edge is curved between lines and between radii.
const MARGIN: f64 = 0.01;
/// Radii that are looked at in an interval, one end left out.
const RADII: u32 = 2;

/// A rectangle on the plane of the last vertex, symmetric about the x axis.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rect {
    low: f64,
    high: f64,
    half_height: f64,
}

impl Rect {
    fn union(a: Option<Self>, b: Option<Self>) -> Option<Self> {
        match (a, b) {
            (Some(a), Some(b)) => Some(Self {
                low: a.low.min(b.low),
                high: a.high.max(b.high),
                half_height: a.half_height.max(b.half_height),
            }),
            (a, b) => a.or(b),
        }
    }

    fn include(&mut self, x: f64, y: f64) {
        (self.low, self.high) = (self.low.min(x), self.high.max(x));
        self.half_height = self.half_height.max(y);
    }

    fn grown(self, part: f64) -> Self {
        let along = part * (self.high - self.low);
        Self {
            low: self.low - along,
            high: self.high + along,
            half_height: self.half_height * (1.0 + 2.0 * part),
        }
    }
}

/// The bounds for a film whose corner is at `film_radius`, for light that the lens bends in any of these ways.
pub(super) fn bounds(traces: &[LensTrace], film_radius: f64) -> Vec<PupilBounds> {
    let at = |i: u32| {
        let radius = film_radius * f64::from(i) / f64::from(PUPIL_INTERVALS * RADII);
        traces.iter().map(|trace| pupil(trace, radius)).fold(None, Rect::union)
    };
    let found: Vec<_> = (0..=PUPIL_INTERVALS * RADII).map(at).collect();
    found
        .windows(RADII as usize + 1)
        .step_by(RADII as usize)
        .map(|pupils| record(pupils.iter().copied()))
        .collect()
}

fn record(pupils: impl Iterator<Item = Option<Rect>>) -> PupilBounds {
    let Some(all) = pupils.fold(None, Rect::union) else { return PupilBounds::default() };
    let Rect { low, high, half_height } = all.grown(MARGIN);
    PupilBounds { low: [low as f32, -half_height as f32], high: [high as f32, half_height as f32] }
}

/// The bounds for a film point on the x axis; None when no light comes through.
fn pupil(trace: &LensTrace, film: f64) -> Option<Rect> {
    let passes = |x: f64, y: f64| trace.to_scene(ray(trace, film, x, y)).is_some();
    let reach = reach(trace, film);
    let step = 2.0 * reach / f64::from(SCAN);
    let scan = |i: u32| -reach + (f64::from(i) + 0.5) * step;
    let hits: Vec<f64> = (0..SCAN).map(scan).filter(|&x| passes(x, 0.0)).collect();
    let center = || through_the_middle_of_the_stop(trace, film, scan).filter(|&x| passes(x, 0.0));
    let (first, last) = match (hits.first(), hits.last()) {
        (Some(&first), Some(&last)) => (first, last),
        _ => center().map(|x| (x, x))?,
    };
    let low = edge(first, first - step, |x| passes(x, 0.0));
    let high = edge(last, last + step, |x| passes(x, 0.0));
    let mut rect = Rect { low, high, half_height: 0.0 };
    for i in 0..LINES {
        let x = low + (high - low) * (f64::from(i) + 0.5) / f64::from(LINES);
        if passes(x, 0.0) {
            rect.include(x, edge(0.0, 2.0 * reach, |y| passes(x, y)));
        }
    }
    let wide = rect.grown(GRID_REACH);
    for row in 0..GRID[1] {
        for column in 0..GRID[0] {
            let x = wide.low + (wide.high - wide.low) * (f64::from(column) + 0.5) / f64::from(GRID[0]);
            let y = wide.half_height * (f64::from(row) + 0.5) / f64::from(GRID[1]);
            if passes(x, y) {
                rect.include(x, y);
            }
        }
    }
    Some(rect)
}

/// The ray from a point of the film through one of the plane of the last vertex.
fn ray(trace: &LensTrace, film: f64, x: f64, y: f64) -> LensRay {
    let direction = DVec3::new(x - film, y, trace.rear()).normalize();
    LensRay { origin: DVec3::new(film, 0.0, 0.0), direction }
}

/// How far from the axis a ray that meets the last surface may cross the plane of its vertex.
fn reach(trace: &LensTrace, film: f64) -> f64 {
    let (aperture, sag) = trace.last_surface();
    // On the line from the film point to the rim, and for a rim in front of the vertex
    let scale = |depth: f64| if depth > 0.0 { trace.rear() / depth } else { 4.0 };
    let crossing = |rim: f64, sag: f64| film + (rim - film) * scale(trace.rear() + sag).min(4.0);
    let ends = [crossing(aperture, sag), crossing(-aperture, sag), aperture];
    1.05 * ends.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// The edge between a place that passes and one that does not, on the side that passes not.
fn edge(passing: f64, failing: f64, passes: impl Fn(f64) -> bool) -> f64 {
    let (mut inside, mut outside) = (passing, failing);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if passes(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    outside
}

/// Where on the x axis the ray crosses that goes through the middle of the stop, however small it is.
fn through_the_middle_of_the_stop(trace: &LensTrace, film: f64, scan: impl Fn(u32) -> f64) -> Option<f64> {
    let height = |x: f64| trace.at_stop(ray(trace, film, x, 0.0)).map(|point: DVec2| point.x);
    (1..SCAN).find_map(|i| {
        let (before, x) = (scan(i - 1), scan(i));
        let (from, to) = (height(before)?, height(x)?);
        (from * to <= 0.0).then(|| {
            let (mut a, mut b) = (before, x);
            for _ in 0..48 {
                let middle = 0.5 * (a + b);
                match height(middle) {
                    Some(value) if (value <= 0.0) == (from <= 0.0) => a = middle,
                    _ => b = middle,
                }
            }
            0.5 * (a + b)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepare::lens::trace::Glass;
    use crate::scene::{LensInterface, LensSystem};

    fn interface(radius: f64, thickness: f64, index: f64, aperture: f64) -> LensInterface {
        LensInterface { radius, thickness, index, abbe: None, aperture }
    }

    /// A lens like a Cooke triplet, with a stop.
    fn triplet() -> LensSystem {
        let interfaces = vec![
            interface(26.2, 4.9, 1.6116, 22.0),
            interface(1200.0, 5.3, 1.0, 22.0),
            interface(-83.5, 1.5, 1.6053, 16.0),
            interface(25.6, 4.9, 1.0, 15.0),
            interface(0.0, 5.3, 1.0, 11.0),
            interface(302.6, 5.2, 1.6116, 18.0),
            interface(-54.8, 0.0, 1.0, 18.0),
        ];
        LensSystem { notes: Vec::new(), interfaces }
    }

    fn trace(stop: f64) -> LensTrace {
        LensTrace::new(&triplet(), 85.0, Some((4, stop)), Glass::LineD)
    }

    #[test]
    fn no_ray_that_passes_is_out_of_bounds_and_most_within_pass() {
        let trace = trace(5.5);
        let bounds = bounds(std::slice::from_ref(&trace), 21.6);
        assert_eq!(bounds.len(), PUPIL_INTERVALS as usize);
        // A lattice over more than the plane of the rear element, for radii within the intervals
        for (k, part) in [(0, 0.3), (10, 0.9), (31, 0.1), (50, 0.5), (63, 0.99)] {
            let film = 21.6 * (f64::from(k) + part) / 64.0;
            let PupilBounds { low, high } = bounds[k as usize];
            let (mut passing, mut inside) = (0, 0);
            for i in 0..400 {
                for j in 0..400 {
                    let at = |n: i32| (f64::from(n) + 0.5) / 400.0 * 30.0 - 15.0;
                    let (x, y) = (at(i), at(j));
                    let within = x as f32 >= low[0] && x as f32 <= high[0] && (y as f32).abs() <= high[1];
                    inside += i32::from(within);
                    if trace.to_scene(ray(&trace, film, x, y)).is_some() {
                        passing += 1;
                        assert!(within, "{film}: {x} {y} outside {low:?} {high:?}");
                    }
                }
            }
            assert!(
                passing > 500 && f64::from(passing) > 0.6 * f64::from(inside),
                "{k}: {passing} of {inside}"
            );
        }
    }

    #[test]
    fn a_pinhole_stop_is_found() {
        let trace = trace(1e-4);
        for bounds in bounds(std::slice::from_ref(&trace), 10.0) {
            let width = bounds.high[0] - bounds.low[0];
            assert!(width > 0.0 && width < 0.05, "{bounds:?}");
        }
    }

    #[test]
    fn far_from_the_middle_nothing_passes() {
        let bounds = bounds(&[trace(5.5)], 400.0);
        assert_eq!(bounds[63], PupilBounds::default());
        assert_ne!(bounds[0], PupilBounds::default());
    }
}
