//! What joins textures: constants are folded.

use super::builder::{Builder, Node, Words};
use super::pattern::{number, place};
use super::range::{Range, mean};
use super::shape::{Place, Shape};
use crate::layout::{NoiseSum as NoiseRecord, Ramp, RampStop, TextureInput};
use crate::scene::{Value, Warp};
use glam::Vec3;

impl Builder<'_> {
    pub(super) fn mix(&mut self, a: &Value<Vec3>, b: &Value<Vec3>, amount: Value<f32>) -> Node {
        let [a, b, t] = [self.input(a), self.input(b), self.number(amount)];
        let share = t.range.mean.clamp(0.0, 1.0);
        if let (Some(x), Some(y), Some(t)) = (a.constant, b.constant, t.constant) {
            return self.constant(x.lerp(y, mean(t).clamp(0.0, 1.0)));
        }
        let shape = Shape::Mix([a.input(), b.input(), t.input()]);
        self.join(shape, Words::default(), &[a, b, t], a.range.mixed(b.range, share))
    }

    pub(super) fn direction_mix(&mut self, a: &Value<Vec3>, b: &Value<Vec3>, direction: Vec3) -> Node {
        let [a, b] = [self.input(a), self.input(b)];
        let mut own = Words::default();
        own.push(TextureInput { value: direction.to_array(), at: 0 });
        // Over all directions of the normal the mean of |cos| is ½
        let range = a.range.mixed(b.range, 0.5);
        self.join(Shape::DirectionMix([a.input(), b.input()]), own, &[a, b], range)
    }

    pub(super) fn add(&mut self, a: &Value<Vec3>, b: &Value<Vec3>) -> Node {
        let [a, b] = [self.input(a), self.input(b)];
        if let (Some(x), Some(y)) = (a.constant, b.constant) {
            return self.constant(x + y);
        }
        let sum = |a: f64, b: f64| a + b;
        let range = a.range.zip(b.range, sum, sum, sum);
        self.join(Shape::Add([a.input(), b.input()]), Words::default(), &[a, b], range)
    }

    pub(super) fn multiply(&mut self, a: &Value<Vec3>, b: &Value<Vec3>) -> Node {
        let [a, b] = [self.input(a), self.input(b)];
        if let (Some(x), Some(y)) = (a.constant, b.constant) {
            return self.constant(x * y);
        }
        let shape = Shape::Multiply([a.input(), b.input()]);
        self.join(shape, Words::default(), &[a, b], a.range.times(b.range))
    }

    pub(super) fn scale(&mut self, value: &Value<Vec3>, factor: Value<f32>) -> Node {
        let [a, b] = [self.input(value), self.number(factor)];
        if let (Some(x), Some(y)) = (a.constant, b.constant) {
            return self.constant(x * mean(y));
        }
        let shape = Shape::Scale([a.input(), b.input()]);
        self.join(shape, Words::default(), &[a, b], a.range.times(b.range))
    }

    pub(super) fn invert(&mut self, value: &Value<Vec3>) -> Node {
        let a = self.input(value);
        if let Some(value) = a.constant {
            return self.constant(Vec3::ONE - value);
        }
        let Range { min, mean, max } = a.range;
        let range = Range { min: 1.0 - max, mean: 1.0 - mean, max: 1.0 - min };
        self.join(Shape::Invert([a.input()]), Words::default(), &[a], range)
    }

    /// What is the same everywhere is the same wherever it is looked at.
    pub(super) fn warp(&mut self, warp: &Warp) -> Node {
        let (Warp::By { value, .. } | Warp::Noise { value, .. }) = warp;
        let value = self.input(value);
        if let Some(color) = value.constant {
            return self.constant(color);
        }
        match warp {
            Warp::By { by, amount, .. } => {
                let by = self.input(by);
                let mut own = Words::default();
                own.push(number(*amount));
                self.join(Shape::WarpBy([value.input(), by.input()]), own, &[value, by], value.range)
            }
            Warp::Noise { amount, octaves, gain, lacunarity, space, .. } => {
                let mut own = place(space, [0.0; 2]);
                own.push(number(*amount));
                let (octaves, gain, lacunarity) = (*octaves, *gain, *lacunarity);
                own.push(NoiseRecord { octaves, gain, lacunarity, scale: 1.0 });
                self.join(Shape::WarpNoise(Place::from(space), [value.input()]), own, &[value], value.range)
            }
        }
    }

    pub(super) fn ramp(&mut self, value: Node, stops: &[(f32, Vec3)], smooth: bool) -> Node {
        let (words, range) = map(value, stops, smooth);
        self.keep(Shape::Ramp([value.input()]), words, None, range)
    }

    pub(super) fn curve(&mut self, value: &Value<Vec3>, points: &[(f32, f32)], smooth: bool) -> Node {
        let value = self.input(value);
        let stops: Vec<_> = points.iter().map(|&(place, to)| (place, Vec3::splat(to))).collect();
        let (words, range) = map(value, &stops, smooth);
        self.keep(Shape::Curve([value.input()]), words, None, range)
    }

    /// With fewer than four colours there is no segment: black.
    pub(super) fn spline(&mut self, value: Node, colors: &[Vec3]) -> Node {
        let black = [Vec3::ZERO; 4];
        let colors = if colors.len() < 4 { &black[..] } else { colors };
        let stops: Vec<_> = colors.iter().map(|&color| (0.0, color)).collect();
        let (words, range) = map(value, &stops, false);
        self.keep(Shape::Spline([value.input()]), words, None, range)
    }
}

/// The record of a map, and the range of what it gives. One without stops is black.
fn map(value: Node, stops: &[(f32, Vec3)], smooth: bool) -> (Words, Range) {
    let black = [(0.0, Vec3::ZERO)];
    let stops = if stops.is_empty() { &black[..] } else { stops };
    let ranges = stops.iter().map(|(_, color)| Range::of(*color));
    let whole =
        ranges.reduce(|a, b| a.zip(b, f64::min, |a, b| a + b, f64::max)).unwrap_or(Range::of(Vec3::ZERO));
    let range = Range { mean: whole.mean / stops.len() as f64, ..whole };
    let mut words = Words::default();
    words.push(Ramp { count: stops.len() as u32, smooth_stops: u32::from(smooth), spare: [0; 2] });
    words.push(value.record());
    for &(place, color) in stops {
        words.push(RampStop { color: color.to_array(), place });
    }
    (words, range)
}
