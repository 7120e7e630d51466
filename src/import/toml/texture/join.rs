//! What joins textures, and colour maps.

use super::noise::{fractal, octaves};
use super::pattern::space;
use crate::Result;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::Limits;
use crate::import::toml::value;
use crate::import::toml::view::{Item, View};
use crate::scene::{Texture, Value, Warp};
use glam::Vec3;

/// Keys of the noise of a warp, which another texture replaces.
const WARP_NOISE: [&str; 6] = ["octaves", "gain", "lacunarity", "space", "transform", "filter_width"];

impl Reader<'_> {
    pub(super) fn ramp(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::Ramp {
            value: self.number(view.need("value")?, Limits::Finite)?,
            stops: stops(view.need("stops")?)?,
            smooth: view.bool_or("smooth", false)?,
        })
    }

    pub(super) fn curve(&self, view: &View<'_>) -> Result<Texture> {
        let what =
            Map { list: "points, such as [[0, 0], [0.5, 0.8], [1, 1]]", one: "two numbers", many: "points" };
        let number = |item: Item<'_>| item.f32(Limits::Finite);
        Ok(Texture::Curve {
            value: self.input(view, "value")?,
            points: what.read(view.need("points")?, number)?,
            smooth: view.bool_or("smooth", false)?,
        })
    }

    pub(super) fn mix_texture(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::Mix {
            a: self.input_or(view, "a", Vec3::ZERO)?,
            b: self.input_or(view, "b", Vec3::ONE)?,
            amount: match view.get("amount") {
                Some(item) => self.number(item, Limits::From(0.0, 1.0))?,
                None => Value::Constant(0.5),
            },
        })
    }

    pub(super) fn warp(&self, view: &View<'_>) -> Result<Texture> {
        let value = self.input(view, "value")?;
        let amount = view.f32_or("amount", 1.0, Limits::Finite)?;
        let Some(by) = view.get("by") else {
            let [gain, lacunarity] = fractal(view)?;
            let (octaves, space) = (octaves(view, 6)?, space(view)?);
            return Ok(Texture::Warp(Warp::Noise { value, amount, octaves, gain, lacunarity, space }));
        };
        if let Some(item) = WARP_NOISE.iter().find_map(|key| view.get(key)) {
            return Err(item.error(format!("{} is of the noise that `by` replaces", item.name())));
        }
        Ok(Texture::Warp(Warp::By { value, by: self.color(by, Limits::Finite)?, amount }))
    }
}

/// Colours of a map: `[[0, "#000000"], [1, [1, 0.5, 0]]]`.
pub(super) fn stops(item: Item<'_>) -> Result<Vec<(f32, Vec3)>> {
    let what = Map {
        list: "a list of stops, such as [[0, 0], [1, [1, 0.5, 0]]]",
        one: "a place and a colour",
        many: "stops",
    };
    what.read(item, |item| value::color(item, Limits::Finite))
}

/// A list of places and what is there: how it is called.
struct Map {
    list: &'static str,
    one: &'static str,
    many: &'static str,
}

impl Map {
    fn read<'a, T>(&self, item: Item<'a>, read: impl Fn(Item<'a>) -> Result<T>) -> Result<Vec<(f32, T)>> {
        let mut stops: Vec<(f32, T)> = Vec::new();
        for stop in item.list(self.list)? {
            let parts: Vec<_> = stop.list(self.one)?.collect();
            let [place, what] = parts.as_slice() else { return Err(stop.mismatch(self.one)) };
            let at = place.f32(Limits::Finite)?;
            if stops.last().is_some_and(|(before, _)| at < *before) {
                return Err(place.error(format!("{} is less than the place before it", place.name())));
            }
            stops.push((at, read(*what)?));
        }
        if stops.is_empty() || stops.len() > Texture::MOST_STOPS {
            return Err(item.mismatch(&format!("from 1 to {} {}", Texture::MOST_STOPS, self.many)));
        }
        Ok(stops)
    }
}
