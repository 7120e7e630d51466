//! Patterns, noise and colour maps: what their records hold.

use super::builder::{Builder, Node, Words};
use super::glsl::{Input, Shape};
use super::range::Range;
use super::rows;
use crate::layout::{NoiseSum as NoiseRecord, Pattern, Ramp, RampStop};
use crate::scene::{Noise, NoiseSum, PatternSpace, Value};
use glam::Vec3;

impl Builder<'_> {
    pub(super) fn noise(&mut self, noise: &Noise) -> Node {
        let amplitudes = (0..noise.octaves).map(|i| f64::from(noise.gain).powi(i as i32)).sum::<f64>();
        let mut own = Words::default();
        own.push(NoiseRecord {
            octaves: noise.octaves,
            gain: noise.gain,
            lacunarity: noise.lacunarity,
            scale: (1.0 / amplitudes.max(f64::MIN_POSITIVE)) as f32,
        });
        // The mean of |n| is about 0.2, and of n it is 0
        let share = if noise.sum == NoiseSum::Turbulence { 0.2 } else { 0.5 };
        let shape = |inputs| Shape::Noise(noise.sum, noise.space.coordinates, inputs);
        self.pattern(&noise.space, [&noise.low, &noise.high], share, own, shape)
    }

    /// A pattern in space between two inputs, of which the second has `share` on average. `own` are the words of its record
    /// after those of its place.
    pub(super) fn pattern(
        &mut self,
        space: &PatternSpace,
        inputs: [&Value<Vec3>; 2],
        share: f64,
        own: Words,
        shape: impl FnOnce([Input; 2]) -> Shape,
    ) -> Node {
        let [a, b] = inputs.map(|input| self.input(input));
        let [row0, row1, row2] = rows(&space.pattern_from_space.as_daffine3());
        let mut words = Words::default();
        words.push(Pattern { row0, row1, row2 });
        words.0.extend(own.0);
        self.join(shape([a.input(), b.input()]), words, &[a, b], a.range.mixed(b.range, share))
    }

    pub(super) fn ramp(&mut self, value: Value<f32>, stops: &[(f32, Vec3)], smooth: bool) -> Node {
        let input = self.number(value);
        let ranges = stops.iter().map(|(_, color)| Range::of(*color));
        let whole =
            ranges.reduce(|a, b| a.zip(b, f64::min, |a, b| a + b, f64::max)).unwrap_or(Range::of(Vec3::ZERO));
        let range = Range { mean: whole.mean / stops.len().max(1) as f64, ..whole };
        let mut words = Words::default();
        words.push(Ramp { count: stops.len() as u32, smooth_stops: u32::from(smooth), spare: [0; 2] });
        words.push(input.record());
        // A map without stops is black
        let black = [(0.0, Vec3::ZERO)];
        for &(place, color) in if stops.is_empty() { &black[..] } else { stops } {
            words.push(RampStop { color: color.to_array(), place });
        }
        self.keep(Shape::Ramp([input.input()]), words, None, range)
    }
}
