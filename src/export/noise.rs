//! `[texture.NAME]`: noise, and what is made of it.

use super::Writer;
use super::keys::Keys;
use super::texture::stops;
use crate::scene::{Handle, Noise, NoiseSum, PerlinVariant, Spread, Texture, ValueNoise, VeinKind, Veins};
use crate::{Error, Result};

impl Writer<'_> {
    pub(super) fn noise(&self, noise: &Noise) -> Keys {
        let alone = noise.octaves == 1 && noise.gain == 0.5 && noise.lacunarity == 2.0;
        let windy = noise.sum == NoiseSum::Windy;
        let mut keys = Keys::of_kind(match noise.sum {
            NoiseSum::Fbm if alone => "noise",
            NoiseSum::Fbm => "fbm",
            NoiseSum::Turbulence => "turbulence",
            NoiseSum::Ridged => "ridged",
            NoiseSum::Windy => "windy",
        });
        self.low_and_high(&mut keys, &noise.low, &noise.high);
        if !(alone && noise.sum == NoiseSum::Fbm) {
            keys.count("octaves", noise.octaves, 6);
        }
        if !windy {
            keys.fractal(noise.gain, noise.lacunarity);
            let variant = match noise.perlin.variant {
                PerlinVariant::Improved => "improved",
                PerlinVariant::Classic => "classic",
                PerlinVariant::Pbrt => "pbrt",
            };
            keys.word("variant", variant, "improved");
            keys.count("dimensions", noise.perlin.dimensions, 3);
            keys.number("w", noise.w[0], 0.0);
            keys.number("w_rate", noise.w[1], 0.0);
            keys.flag("normalize", noise.normalize, true);
        }
        keys.space(&noise.space);
        keys
    }

    pub(super) fn value_noise(&self, noise: &ValueNoise) -> Keys {
        let mut keys = Keys::of_kind("value_noise");
        self.low_and_high(&mut keys, &noise.low, &noise.high);
        keys.count("dimensions", noise.dimensions, 3);
        keys.count("length", noise.length, 256);
        keys.number("amplitude", noise.amplitude, 1.0);
        keys.number("frequency", noise.frequency, 1.0);
        keys.count("octaves", noise.octaves, 1);
        keys.space(&noise.space);
        keys
    }

    pub(super) fn veins(&self, handle: Handle<Texture>, veins: &Veins) -> Result<Keys> {
        let (kind, octaves, variation) = match veins.kind {
            VeinKind::Marble => ("marble", 8, 0.2),
            VeinKind::Wood => ("wood", 3, 0.8),
            VeinKind::Granite => ("granite", 6, 1.0),
        };
        let mut keys = Keys::of_kind(kind);
        keys.count("octaves", veins.octaves, octaves);
        keys.fractal(veins.gain, veins.lacunarity);
        keys.number("variation", veins.variation, variation);
        match &veins.colors {
            Spread::Stops(colors) => keys.set("stops", stops(colors)),
            Spread::Spline(colors) => {
                let usual = colors.iter().map(|color| color.to_array()).eq(Veins::MARBLE);
                if veins.kind != VeinKind::Marble || !usual {
                    let name = self.textures.name(handle);
                    let error = Error::output(format!("texture `{name}` has a spline of colours of its own"));
                    return Err(error.help("change that in the scene that is converted"));
                }
            }
        }
        keys.space(&veins.space);
        Ok(keys)
    }
}
