//! Patterns: where they are and of what kind, and colour maps.

use crate::Result;
use crate::import::toml::text::Limits;
use crate::import::toml::transform::transform;
use crate::import::toml::value;
use crate::import::toml::view::{Item, View};
use crate::scene::{Coordinates, Gradient, Metric, PatternSpace, WorleyFeature};
use glam::{Affine3A, Vec3};

/// Most stops of a colour map: each is looked at for every value.
const MOST_STOPS: usize = 64;
pub(super) const GRADIENTS: [(&str, Gradient); 3] = [
    ("linear", Gradient::Linear),
    ("cylindrical", Gradient::Cylindrical),
    ("spherical", Gradient::Spherical),
];
pub(super) const FEATURES: [(&str, WorleyFeature); 3] =
    [("f1", WorleyFeature::F1), ("f2", WorleyFeature::F2), ("f2_minus_f1", WorleyFeature::Difference)];
pub(super) const METRICS: [(&str, Metric); 3] =
    [("euclidean", Metric::Euclidean), ("manhattan", Metric::Manhattan), ("chebyshev", Metric::Chebyshev)];
/// Most octaves of noise: the last has 2⁻³¹ of the size of the first.
pub(super) const MOST_OCTAVES: u32 = 32;

/// Colours of a map: `[[0, "#000000"], [1, [1, 0.5, 0]]]`.
pub(super) fn stops(item: Item<'_>) -> Result<Vec<(f32, Vec3)>> {
    let mut stops: Vec<(f32, Vec3)> = Vec::new();
    for stop in item.list("a list of stops, such as [[0, 0], [1, [1, 0.5, 0]]]")? {
        let parts: Vec<_> = stop.list("a place and a colour")?.collect();
        let [place, color] = parts.as_slice() else { return Err(stop.mismatch("a place and a colour")) };
        let at = place.f32(Limits::Finite)?;
        if stops.last().is_some_and(|(before, _)| at < *before) {
            return Err(place.error(format!("{} is less than the place before it", place.name())));
        }
        stops.push((at, value::color(*color, Limits::Finite)?));
    }
    if stops.is_empty() || stops.len() > MOST_STOPS {
        return Err(item.mismatch(&format!("from 1 to {MOST_STOPS} stops")));
    }
    Ok(stops)
}

/// Where a pattern is: `transform` moves it in the space that `space` names.
pub(super) fn space(view: &View<'_>) -> Result<PatternSpace> {
    let spaces = [("uv", Coordinates::Uv), ("object", Coordinates::Object), ("world", Coordinates::World)];
    let coordinates = view.choice_or("space", Coordinates::Object, &spaces)?;
    let placed = view.get("transform").map_or(Ok(Affine3A::IDENTITY), transform)?;
    Ok(PatternSpace { coordinates, pattern_from_space: placed.inverse() })
}
