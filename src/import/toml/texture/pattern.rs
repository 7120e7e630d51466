//! Patterns without octaves, and where a pattern is.

use crate::Result;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::Limits;
use crate::import::toml::transform::{matrix_map, transform};
use crate::import::toml::view::View;
use crate::scene::{Brick, Coordinates, Dots, Gradient, Metric, PatternSpace, Texture, WorleyFeature};
use glam::{Affine3A, Vec2, Vec3};

const GRADIENTS: [(&str, Gradient); 3] = [
    ("linear", Gradient::Linear),
    ("cylindrical", Gradient::Cylindrical),
    ("spherical", Gradient::Spherical),
];
const FEATURES: [(&str, WorleyFeature); 4] = [
    ("f1", WorleyFeature::F1),
    ("f2", WorleyFeature::F2),
    ("f2_minus_f1", WorleyFeature::Difference),
    ("edge", WorleyFeature::Edge),
];
const METRICS: [(&str, Metric); 3] =
    [("euclidean", Metric::Euclidean), ("manhattan", Metric::Manhattan), ("chebyshev", Metric::Chebyshev)];

impl Reader<'_> {
    pub(super) fn checker(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::Checker {
            dimensions: view.u32_or("dimensions", 3, 2, 3)?,
            even: self.input_or(view, "even", Vec3::ONE)?,
            odd: self.input_or(view, "odd", Vec3::ZERO)?,
            space: space(view)?,
        })
    }

    pub(super) fn gradient(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::Gradient {
            shape: view.choice_or("shape", Gradient::Linear, &GRADIENTS)?,
            low: self.input_or(view, "low", Vec3::ZERO)?,
            high: self.input_or(view, "high", Vec3::ONE)?,
            space: space(view)?,
        })
    }

    pub(super) fn worley(&self, view: &View<'_>) -> Result<Texture> {
        let feature = view.choice_or("feature", WorleyFeature::F1, &FEATURES)?;
        let metric = view.choice_or("metric", Metric::Euclidean, &METRICS)?;
        if let (WorleyFeature::Edge, Some(item)) = (feature, view.get("metric"))
            && metric != Metric::Euclidean
        {
            return Err(
                item.error("an `edge` is the distance to a plane, which only the metric \"euclidean\" has")
            );
        }
        let (low, high) = (self.input_or(view, "low", Vec3::ZERO)?, self.input_or(view, "high", Vec3::ONE)?);
        Ok(Texture::Worley { feature, metric, low, high, space: space(view)? })
    }

    pub(super) fn brick(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::Brick(Brick {
            brick: self.input_or(view, "brick", Brick::CLAY)?,
            mortar: self.input_or(view, "mortar", Brick::LIME)?,
            size: match view.get("size") {
                Some(item) => item.vec2(Limits::Above(0.0))?,
                None => Vec2::new(3.0, 1.0),
            },
            joint: view.f32_or("joint", 0.13, Limits::AtLeast(0.0))?,
            offset: view.f32_or("offset", 0.5, Limits::Finite)?,
            variation: view.f32_or("variation", 0.25, Limits::From(0.0, 1.0))?,
            space: space(view)?,
        }))
    }

    pub(super) fn dots(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::Dots(Dots {
            inside: self.input_or(view, "inside", Vec3::ONE)?,
            outside: self.input_or(view, "outside", Vec3::ZERO)?,
            radius: view.f32_or("radius", 0.35, Limits::AboveUpTo(0.0, 0.5))?,
            space: space(view)?,
        }))
    }
}

/// Where a pattern is: `transform` moves it in the space that `space` names, or `matrix` is the map from there to the pattern.
pub(super) fn space(view: &View<'_>) -> Result<PatternSpace> {
    let spaces = [("uv", Coordinates::Uv), ("object", Coordinates::Object), ("world", Coordinates::World)];
    let coordinates = view.choice_or("space", Coordinates::Object, &spaces)?;
    let pattern_from_space = match view.either("transform", "matrix")? {
        Some(item) if view.get("matrix").is_some() => matrix_map(item)?,
        Some(item) => transform(item)?.inverse(),
        None => Affine3A::IDENTITY,
    };
    // Kinds that are not filtered have no such key
    let filter_width = view.f32_or("filter_width", 1.0, Limits::AtLeast(0.0))?;
    Ok(PatternSpace { coordinates, pattern_from_space, filter_width })
}
