//! `[texture.NAME]`: patterns, and where they are.

use super::Writer;
use super::keys::{Keys, matrix, pair};
use crate::scene::{Brick, Coordinates, Dots, Gradient, Metric, PatternSpace, Value, WorleyFeature};
use glam::{Affine3A, Vec2, Vec3};

impl Writer<'_> {
    pub(super) fn checker(
        &self,
        dimensions: u32,
        even: &Value<Vec3>,
        odd: &Value<Vec3>,
        space: &PatternSpace,
    ) -> Keys {
        let mut keys = Keys::of_kind("checker");
        keys.count("dimensions", dimensions, 3);
        self.put_color(&mut keys, "even", even, 1.0);
        self.put_color(&mut keys, "odd", odd, 0.0);
        keys.space(space);
        keys
    }

    pub(super) fn brick(&self, wall: &Brick) -> Keys {
        let mut keys = Keys::of_kind("brick");
        for (key, value, usual) in
            [("brick", &wall.brick, Brick::CLAY), ("mortar", &wall.mortar, Brick::LIME)]
        {
            if *value != Value::Constant(usual) {
                keys.set(key, self.color(value));
            }
        }
        if wall.size != Vec2::new(3.0, 1.0) {
            keys.set("size", pair(wall.size));
        }
        keys.number("joint", wall.joint, 0.13);
        keys.number("offset", wall.offset, 0.5);
        keys.number("variation", wall.variation, 0.25);
        keys.space(&wall.space);
        keys
    }

    pub(super) fn dots(&self, dots: &Dots) -> Keys {
        let mut keys = Keys::of_kind("dots");
        self.put_color(&mut keys, "inside", &dots.inside, 1.0);
        self.put_color(&mut keys, "outside", &dots.outside, 0.0);
        keys.number("radius", dots.radius, 0.35);
        keys.space(&dots.space);
        keys
    }

    pub(super) fn gradient(
        &self,
        shape: Gradient,
        low: &Value<Vec3>,
        high: &Value<Vec3>,
        space: &PatternSpace,
    ) -> Keys {
        let mut keys = Keys::of_kind("gradient");
        let word = match shape {
            Gradient::Linear => "linear",
            Gradient::Cylindrical => "cylindrical",
            Gradient::Spherical => "spherical",
        };
        keys.word("shape", word, "linear");
        self.low_and_high(&mut keys, low, high);
        keys.space(space);
        keys
    }

    pub(super) fn worley(
        &self,
        feature: WorleyFeature,
        metric: Metric,
        low: &Value<Vec3>,
        high: &Value<Vec3>,
        space: &PatternSpace,
    ) -> Keys {
        let mut keys = Keys::of_kind("worley");
        let word = match feature {
            WorleyFeature::F1 => "f1",
            WorleyFeature::F2 => "f2",
            WorleyFeature::Difference => "f2_minus_f1",
            WorleyFeature::Edge => "edge",
        };
        keys.word("feature", word, "f1");
        let word = match metric {
            Metric::Euclidean => "euclidean",
            Metric::Manhattan => "manhattan",
            Metric::Chebyshev => "chebyshev",
        };
        keys.word("metric", word, "euclidean");
        self.low_and_high(&mut keys, low, high);
        keys.space(space);
        keys
    }

    pub(super) fn low_and_high(&self, keys: &mut Keys, low: &Value<Vec3>, high: &Value<Vec3>) {
        self.put_color(keys, "low", low, 0.0);
        self.put_color(keys, "high", high, 1.0);
    }
}

impl Keys {
    /// Where a pattern is.
    pub(super) fn space(&mut self, space: &PatternSpace) {
        let word = match space.coordinates {
            Coordinates::Uv => "uv",
            Coordinates::Object => "object",
            Coordinates::World => "world",
        };
        self.word("space", word, "object");
        if space.pattern_from_space != Affine3A::IDENTITY {
            self.set("matrix", matrix(&space.pattern_from_space));
        }
        self.number("filter_width", space.filter_width, 1.0);
    }

    /// Gain and lacunarity.
    pub(super) fn fractal(&mut self, gain: f32, lacunarity: f32) {
        self.number("gain", gain, 0.5);
        self.number("lacunarity", lacunarity, 2.0);
    }
}
