//! `[texture.NAME]`.

mod image;
mod pattern;

use super::document::Entry;
use super::keys::TEXTURE;
use super::reader::Reader;
use super::text::{self, Limits};
use super::value;
use super::view::View;
use crate::scene::{Gradient, Metric, Noise, NoiseSum, Texture, Value, WorleyFeature};
use crate::{Error, Result};
use glam::Vec3;
use pattern::{FEATURES, GRADIENTS, METRICS, MOST_OCTAVES, space, stops};

impl Reader<'_> {
    /// All textures. They may be made of one another in any order, so each has its name before any is read.
    pub fn textures(&mut self, entries: &[Entry]) -> Result<()> {
        let mut handles = Vec::with_capacity(entries.len());
        for entry in entries {
            let handle = self.scene.textures.add(&entry.key, Texture::Constant(Vec3::ZERO));
            self.textures.add(&entry.key, entry.spot, handle);
            handles.push(handle);
        }
        for (entry, &handle) in entries.iter().zip(&handles) {
            self.scene.textures[handle] = self.texture(entry)?;
        }
        let Some(endless) = Texture::without_end(&self.scene.textures) else { return Ok(()) };
        let spot =
            entries.iter().zip(&handles).find(|(_, handle)| **handle == endless).map(|(entry, _)| entry.spot);
        let message = Texture::endless(&text::shown(self.scene.textures.name(endless)));
        Err(match spot {
            Some(spot) => self.sources.error(spot, message),
            None => Error::scene(message),
        })
    }

    fn texture(&mut self, entry: &Entry) -> Result<Texture> {
        let what = format!("texture `{}`", text::shown(&entry.key));
        let (view, kind) = View::of_kind(self.sources, &entry.node, what, &TEXTURE)?;
        let color = |key: &str, default: f32| match view.get(key) {
            Some(item) => self.color(item, Limits::Finite),
            None => Ok(Value::Constant(Vec3::splat(default))),
        };
        let need = |key: &str| self.color(view.need(key)?, Limits::Finite);
        Ok(match kind {
            "constant" => Texture::Constant(value::color(view.need("color")?, Limits::Finite)?),
            "checker" => {
                Texture::Checker { even: color("even", 1.0)?, odd: color("odd", 0.0)?, space: space(&view)? }
            }
            "noise" | "fbm" | "turbulence" => Texture::Noise(Noise {
                sum: if kind == "turbulence" { NoiseSum::Turbulence } else { NoiseSum::Fbm },
                octaves: if kind == "noise" { 1 } else { view.u32_or("octaves", 6, 1, MOST_OCTAVES)? },
                gain: view.f32_or("gain", 0.5, Limits::From(0.0, 1.0))?,
                lacunarity: view.f32_or("lacunarity", 2.0, Limits::From(1.0, 16.0))?,
                low: color("low", 0.0)?,
                high: color("high", 1.0)?,
                space: space(&view)?,
            }),
            "gradient" => Texture::Gradient {
                shape: view.choice_or("shape", Gradient::Linear, &GRADIENTS)?,
                low: color("low", 0.0)?,
                high: color("high", 1.0)?,
                space: space(&view)?,
            },
            "worley" => Texture::Worley {
                feature: view.choice_or("feature", WorleyFeature::F1, &FEATURES)?,
                metric: view.choice_or("metric", Metric::Euclidean, &METRICS)?,
                low: color("low", 0.0)?,
                high: color("high", 1.0)?,
                space: space(&view)?,
            },
            "ramp" => Texture::Ramp {
                value: self.number(view.need("value")?, Limits::Finite)?,
                stops: stops(view.need("stops")?)?,
                smooth: view.bool_or("smooth", false)?,
            },
            "mix" => Texture::Mix {
                a: color("a", 0.0)?,
                b: color("b", 1.0)?,
                amount: match view.get("amount") {
                    Some(item) => self.number(item, Limits::From(0.0, 1.0))?,
                    None => Value::Constant(0.5),
                },
            },
            "add" => Texture::Add { a: need("a")?, b: need("b")? },
            "multiply" => Texture::Multiply { a: need("a")?, b: need("b")? },
            "invert" => Texture::Invert { value: need("value")? },
            _ => Texture::Image(self.image_texture(&view)?),
        })
    }
}
