//! Noise, and what is made of it.

use super::join::stops;
use super::pattern::space;
use crate::Result;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::Limits;
use crate::import::toml::view::View;
use crate::scene::{Noise, NoiseSum, Perlin, PerlinVariant, Spread, Texture, ValueNoise, VeinKind, Veins};
use glam::Vec3;

/// Most points of the lattice of value noise along an axis.
const LONGEST_LATTICE: u32 = 1 << 20;

const VARIANTS: [(&str, PerlinVariant); 3] = [
    ("improved", PerlinVariant::Improved),
    ("classic", PerlinVariant::Classic),
    ("pbrt", PerlinVariant::Pbrt),
];
const WOOD: [(f32, [f32; 3]); 3] =
    [(0.0, [0.62, 0.38, 0.18]), (0.45, [0.45, 0.23, 0.09]), (1.0, [0.2, 0.08, 0.03])];
const GRANITE: [(f32, [f32; 3]); 6] = [
    (0.0, [0.03, 0.03, 0.035]),
    (0.24, [0.08, 0.075, 0.08]),
    (0.34, [0.35, 0.3, 0.28]),
    (0.5, [0.6, 0.46, 0.4]),
    (0.6, [0.68, 0.6, 0.56]),
    (0.8, [0.85, 0.83, 0.8]),
];

impl Reader<'_> {
    pub(super) fn noise(&self, view: &View<'_>, kind: &str) -> Result<Texture> {
        let sum = match kind {
            "turbulence" => NoiseSum::Turbulence,
            "ridged" => NoiseSum::Ridged,
            "windy" => NoiseSum::Windy,
            _ => NoiseSum::Fbm,
        };
        let [gain, lacunarity] = fractal(view)?;
        Ok(Texture::Noise(Noise {
            perlin: if kind == "windy" { Perlin::PBRT } else { perlin(view)? },
            sum,
            octaves: if kind == "noise" { 1 } else { octaves(view, 6)? },
            gain,
            lacunarity: if kind == "windy" { Noise::PBRT_LACUNARITY } else { lacunarity },
            normalize: view.bool_or("normalize", true)?,
            w: [view.f32_or("w", 0.0, Limits::Finite)?, view.f32_or("w_rate", 0.0, Limits::Finite)?],
            low: self.input_or(view, "low", Vec3::ZERO)?,
            high: self.input_or(view, "high", Vec3::ONE)?,
            space: space(view)?,
        }))
    }

    pub(super) fn value_noise(&self, view: &View<'_>) -> Result<Texture> {
        Ok(Texture::ValueNoise(ValueNoise {
            dimensions: view.u32_or("dimensions", 3, 1, 3)?,
            length: view.u32_or("length", 256, 1, LONGEST_LATTICE)?,
            amplitude: view.f32_or("amplitude", 1.0, Limits::AtLeast(0.0))?,
            frequency: view.f32_or("frequency", 1.0, Limits::Above(0.0))?,
            octaves: octaves(view, 1)?,
            low: self.input_or(view, "low", Vec3::ZERO)?,
            high: self.input_or(view, "high", Vec3::ONE)?,
            space: space(view)?,
        }))
    }
}

/// Number of octaves.
pub(super) fn octaves(view: &View<'_>, default: u32) -> Result<u32> {
    view.u32_or("octaves", default, 1, Noise::MOST_OCTAVES)
}

/// Gain and lacunarity.
pub(super) fn fractal(view: &View<'_>) -> Result<[f32; 2]> {
    let gain = view.f32_or("gain", 0.5, Limits::From(0.0, 1.0))?;
    Ok([gain, view.f32_or("lacunarity", 2.0, Limits::From(1.0, 16.0))?])
}

fn perlin(view: &View<'_>) -> Result<Perlin> {
    let dimensions = view.u32_or("dimensions", 3, 1, 4)?;
    if let Some(item) = view.get("w").or_else(|| view.get("w_rate"))
        && dimensions != 4
    {
        return Err(item
            .error(format!("{} is for noise in 4 dimensions", item.name()))
            .help("add `dimensions = 4`"));
    }
    let variant = view.choice_or("variant", PerlinVariant::Improved, &VARIANTS)?;
    if let (PerlinVariant::Pbrt, Some(item)) = (variant, view.get("dimensions"))
        && dimensions != 3
    {
        return Err(item.refuse(dimensions, "3 for the variant \"pbrt\""));
    }
    Ok(Perlin { variant, dimensions })
}

/// Marble, wood and granite.
pub(super) fn veins(view: &View<'_>, kind: &str) -> Result<Texture> {
    let map = |stops: &[(f32, [f32; 3])]| {
        Spread::Stops(stops.iter().map(|&(place, color)| (place, Vec3::from_array(color))).collect())
    };
    let (kind, octaves_alone, variation, colors) = match kind {
        "marble" => (VeinKind::Marble, 8, 0.2, Spread::Spline(Veins::MARBLE.map(Vec3::from_array).to_vec())),
        "wood" => (VeinKind::Wood, 3, 0.8, map(&WOOD)),
        _ => (VeinKind::Granite, 6, 1.0, map(&GRANITE)),
    };
    let [gain, lacunarity] = fractal(view)?;
    Ok(Texture::Veins(Veins {
        kind,
        octaves: octaves(view, octaves_alone)?,
        gain,
        lacunarity,
        variation: view.f32_or("variation", variation, Limits::Finite)?,
        colors: view.get("stops").map_or(Ok(colors), |item| stops(item).map(Spread::Stops))?,
        space: space(view)?,
    }))
}
