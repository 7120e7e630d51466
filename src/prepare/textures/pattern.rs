//! Patterns and noise: what their records hold.

use super::builder::{Builder, Node, Words};
use super::range::Range;
use super::rows;
use super::shape::{Input, NoiseShape, Place, Shape};
use crate::layout::{NodeNumber, NoiseSum as NoiseRecord, Pattern, ValueLattice, Wall};
use crate::scene::{Brick, Dots, Noise, NoiseSum, PatternSpace, Spread, Value, ValueNoise, VeinKind, Veins};
use glam::Vec3;

/// Mean of |n| of noise (pbrt, `Turbulence`) and of (1 − |n|)²; `texture/octaves.glsl` fades to the same.
pub(super) const MEAN_CREASED: f64 = 0.2;
pub(super) const MEAN_RIDGED: f64 = 0.63;

/// Octaves of the strength of the wind (pbrt, `windy`).
const WIND_OCTAVES: u32 = 3;

impl Builder<'_> {
    pub(super) fn noise(&mut self, noise: &Noise) -> Node {
        let sum = |octaves| amplitudes(octaves, noise.gain);
        let record = |octaves, scale: f64| NoiseRecord {
            octaves,
            gain: noise.gain,
            lacunarity: noise.lacunarity,
            scale: scale as f32,
        };
        let mut own = place(&noise.space, noise.w);
        let normalized = noise.normalize && noise.sum != NoiseSum::Windy;
        let whole = if normalized { 1.0 } else { sum(noise.octaves) };
        if noise.sum == NoiseSum::Windy {
            own.push(record(WIND_OCTAVES, 1.0));
        }
        own.push(record(noise.octaves, whole / sum(noise.octaves).max(f64::MIN_POSITIVE)));
        // Part of `high`: least, on average, most
        let shares = match noise.sum {
            NoiseSum::Fbm if normalized => [0.0, 0.5, 1.0],
            NoiseSum::Fbm => [-whole, 0.0, whole],
            NoiseSum::Turbulence => [0.0, MEAN_CREASED * whole, whole],
            NoiseSum::Ridged => [0.0, MEAN_RIDGED * whole, whole],
            NoiseSum::Windy => {
                let most = whole * sum(WIND_OCTAVES);
                [-most, 0.0, most]
            }
        };
        let shape = NoiseShape { sum: noise.sum, perlin: noise.perlin, normalized };
        let (at, inputs) = (Place::from(&noise.space), [&noise.low, &noise.high]);
        self.pattern(own, inputs, shares, |inputs| Shape::Noise(shape, at, inputs))
    }

    pub(super) fn value_noise(&mut self, noise: &ValueNoise) -> Node {
        let ValueNoise { dimensions, length, amplitude, frequency, octaves, low, high, space } = noise;
        let mut own = place(space, [0.0; 2]);
        own.push(ValueLattice {
            points: *length,
            amplitude: *amplitude,
            frequency: *frequency,
            octaves: *octaves,
        });
        let most = 0.5 * f64::from(*amplitude).abs() * amplitudes(*octaves, 0.5);
        let (at, shares) = (Place::from(space), [0.5 - most, 0.5, 0.5 + most]);
        self.pattern(own, [low, high], shares, |inputs| Shape::ValueNoise(*dimensions, at, inputs))
    }

    pub(super) fn brick(&mut self, wall: &Brick) -> Node {
        let Brick { brick, mortar, size, joint, offset, variation, space } = wall;
        let mut own = place(space, [0.0; 2]);
        own.push(Wall { size: size.to_array(), joint: *joint, offset: *offset });
        own.push(number(*variation));
        let at = Place::from(space);
        let mut node = self.pattern(own, [brick, mortar], [0.0, 0.2, 1.0], |of| Shape::Brick(at, of));
        let most = 1.0 + f64::from(variation.abs());
        node.range.max = node.range.max.max(node.range.max * most);
        node.range.min = node.range.min.min(node.range.min * most);
        node
    }

    pub(super) fn dots(&mut self, dots: &Dots) -> Node {
        let mut own = place(&dots.space, [0.0; 2]);
        own.push(number(dots.radius));
        let share = 0.5 * std::f64::consts::PI * f64::from(dots.radius).powi(2);
        let (at, inputs) = (Place::from(&dots.space), [&dots.outside, &dots.inside]);
        self.pattern(own, inputs, [0.0, share, 1.0], |inputs| Shape::Dots(at, inputs))
    }

    pub(super) fn veins(&mut self, veins: &Veins) -> Node {
        let mut own = place(&veins.space, [0.0; 2]);
        own.push(number(veins.variation));
        own.push(NoiseRecord {
            octaves: veins.octaves,
            gain: veins.gain,
            lacunarity: veins.lacunarity,
            scale: if veins.kind == VeinKind::Granite { veins.variation } else { 1.0 },
        });
        let shape = Shape::Veins(veins.kind, Place::from(&veins.space));
        let value = self.keep(shape, own, None, Range { min: 0.0, mean: 0.5, max: 1.0 });
        match &veins.colors {
            Spread::Stops(stops) => self.ramp(value, stops, false),
            Spread::Spline(colors) => self.spline(value, colors),
        }
    }

    /// A pattern that has nothing but its place, between two inputs, of which the second has `share` on average.
    pub(super) fn between(
        &mut self,
        space: &PatternSpace,
        inputs: [&Value<Vec3>; 2],
        share: f64,
        shape: impl FnOnce(Place, [Input; 2]) -> Shape,
    ) -> Node {
        let at = Place::from(space);
        self.pattern(place(space, [0.0; 2]), inputs, [0.0, share, 1.0], |inputs| shape(at, inputs))
    }

    /// A pattern between two inputs, of which the second has a part of `shares`: least, mean and most. `own` are the words of
    /// its record before those of its inputs.
    pub(super) fn pattern(
        &mut self,
        own: Words,
        inputs: [&Value<Vec3>; 2],
        shares: [f64; 3],
        shape: impl FnOnce([Input; 2]) -> Shape,
    ) -> Node {
        let [a, b] = inputs.map(|input| self.input(input));
        self.join(shape([a.input(), b.input()]), own, &[a, b], a.range.along(b.range, shares))
    }
}

/// The words of the place of a pattern; `w` is that of noise in four dimensions.
pub(super) fn place(space: &PatternSpace, [w, w_rate]: [f32; 2]) -> Words {
    let [row0, row1, row2] = rows(&space.pattern_from_space.as_daffine3());
    let mut words = Words::default();
    words.push(Pattern { row0, row1, row2, filter_width: space.filter_width, w, w_rate, spare: 0 });
    words
}

pub(super) fn number(number: f32) -> NodeNumber {
    NodeNumber { number, spare: [0; 3] }
}

/// Sum of the amplitudes of octaves.
fn amplitudes(octaves: u32, gain: f32) -> f64 {
    (0..octaves).map(|i| f64::from(gain).powi(i as i32)).sum()
}
