//! `[texture.NAME]`.

use super::document::Entry;
use super::include::identity;
use super::keys::TEXTURE;
use super::reader::Reader;
use super::text::Limits;
use super::transform::transform;
use super::view::{Item, View};
use crate::scene::{
    Channel, ColorSpace, Coordinates, Gradient, Handle, Image, ImageTexture, Metric, Noise, NoiseSum,
    PatternSpace, TexelFilter, Texels, Texture, UvTransform, Value, WorleyFeature, Wrap,
};
use crate::{Error, Result};
use glam::{Affine3A, Vec2, Vec3};

/// Most stops of a colour map: each is looked at for every value.
const MOST_STOPS: usize = 64;
const GRADIENTS: [(&str, Gradient); 3] = [
    ("linear", Gradient::Linear),
    ("cylindrical", Gradient::Cylindrical),
    ("spherical", Gradient::Spherical),
];
const FEATURES: [(&str, WorleyFeature); 3] =
    [("f1", WorleyFeature::F1), ("f2", WorleyFeature::F2), ("f2_minus_f1", WorleyFeature::Difference)];
const METRICS: [(&str, Metric); 3] =
    [("euclidean", Metric::Euclidean), ("manhattan", Metric::Manhattan), ("chebyshev", Metric::Chebyshev)];
/// Most octaves of noise: the last has 2⁻³¹ of the size of the first.
const MOST_OCTAVES: u32 = 32;

const WRAPS: [(&str, Wrap); 4] =
    [("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp), ("mirror", Wrap::Mirror), ("black", Wrap::Black)];

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
        let message = Texture::endless(&super::text::shown(self.scene.textures.name(endless)));
        Err(match spot {
            Some(spot) => self.sources.error(spot, message),
            None => Error::scene(message),
        })
    }

    fn texture(&mut self, entry: &Entry) -> Result<Texture> {
        let what = format!("texture `{}`", super::text::shown(&entry.key));
        let (view, kind) = View::of_kind(self.sources, &entry.node, what, &TEXTURE)?;
        let color = |key: &str, default: f32| match view.get(key) {
            Some(item) => self.color(item, Limits::Finite),
            None => Ok(Value::Constant(Vec3::splat(default))),
        };
        let need = |key: &str| self.color(view.need(key)?, Limits::Finite);
        Ok(match kind {
            "constant" => Texture::Constant(super::value::color(view.need("color")?, Limits::Finite)?),
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

    fn image_texture(&mut self, view: &View<'_>) -> Result<ImageTexture> {
        let filters = [("bilinear", TexelFilter::Bilinear), ("nearest", TexelFilter::Nearest)];
        let channels = [
            ("rgb", Channel::Rgb),
            ("r", Channel::R),
            ("g", Channel::G),
            ("b", Channel::B),
            ("a", Channel::A),
        ];
        let spaces = [("srgb", ColorSpace::Srgb), ("linear", ColorSpace::Linear)];

        let file = view.need("file")?;
        let filter = view.choice_or("filter", TexelFilter::Bilinear, &filters)?;
        let wrap = view.get("wrap").map_or(Ok([Wrap::Repeat; 2]), wrap)?;
        let uv = UvTransform {
            scale: view.get("uv_scale").map_or(Ok(Vec2::ONE), uv_scale)?,
            rotate: view.f32_or("uv_rotate", 0.0, Limits::Finite)?,
            offset: view.get("uv_offset").map_or(Ok(Vec2::ZERO), |item| item.vec2(Limits::Finite))?,
        };
        let color_space = match view.get("color_space") {
            Some(item) => Some(item.choice(&spaces)?),
            None => None,
        };
        let channel = view.choice_or("channel", Channel::Rgb, &channels)?;
        let scale = view.f32_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let invert = view.bool_or("invert", false)?;

        let image = self.image(file)?;
        let color_space = color_space.unwrap_or(match self.scene.images[image].texels {
            Texels::Rgba8(_) | Texels::Rgba16(_) => ColorSpace::Srgb,
            Texels::RgbaF32(_) => ColorSpace::Linear,
        });
        Ok(ImageTexture { image, filter, wrap, uv, color_space, channel, scale, invert })
    }

    /// The picture of a file, loaded once.
    fn image(&mut self, file: Item<'_>) -> Result<Handle<Image>> {
        let path = file.path()?;
        let identity = identity(&path);
        if let Some(&handle) = self.images.get(&identity) {
            return Ok(handle);
        }
        self.need_file(file.node.spot, &path)?;
        let image = self.assets.image(&path).map_err(|error| self.sources.locate(file.node.spot, error))?;
        let handle = self.scene.images.add(path.display().to_string(), image);
        self.images.insert(identity, handle);
        Ok(handle)
    }
}

fn wrap(item: Item<'_>) -> Result<[Wrap; 2]> {
    if !item.is_list() {
        return item.choice(&WRAPS).map(|both| [both; 2]);
    }
    let choices: Vec<_> = item.list("a list")?.map(|one| one.choice(&WRAPS)).collect::<Result<_>>()?;
    <[Wrap; 2]>::try_from(choices).map_err(|_| item.mismatch("one word or two"))
}

fn uv_scale(item: Item<'_>) -> Result<Vec2> {
    if item.is_number() { item.f32(Limits::NotZero).map(Vec2::splat) } else { item.vec2(Limits::NotZero) }
}

/// Colours of a map: `[[0, "#000000"], [1, [1, 0.5, 0]]]`.
fn stops(item: Item<'_>) -> Result<Vec<(f32, Vec3)>> {
    let mut stops: Vec<(f32, Vec3)> = Vec::new();
    for stop in item.list("a list of stops, such as [[0, 0], [1, [1, 0.5, 0]]]")? {
        let parts: Vec<_> = stop.list("a place and a colour")?.collect();
        let [place, color] = parts.as_slice() else { return Err(stop.mismatch("a place and a colour")) };
        let at = place.f32(Limits::Finite)?;
        if stops.last().is_some_and(|(before, _)| at < *before) {
            return Err(place.error(format!("{} is less than the place before it", place.name())));
        }
        stops.push((at, super::value::color(*color, Limits::Finite)?));
    }
    if stops.is_empty() || stops.len() > MOST_STOPS {
        return Err(item.mismatch(&format!("from 1 to {MOST_STOPS} stops")));
    }
    Ok(stops)
}

/// Where a pattern is: `transform` moves it in the space that `space` names.
fn space(view: &View<'_>) -> Result<PatternSpace> {
    let spaces = [("uv", Coordinates::Uv), ("object", Coordinates::Object), ("world", Coordinates::World)];
    let coordinates = view.choice_or("space", Coordinates::Object, &spaces)?;
    let placed = view.get("transform").map_or(Ok(Affine3A::IDENTITY), transform)?;
    Ok(PatternSpace { coordinates, pattern_from_space: placed.inverse() })
}
