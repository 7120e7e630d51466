//! `Texture`.

use super::lexer::Lexer;
use super::parameter::Type;
use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::spectrum::Role;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::{Limits, shown, suggest};
use crate::scene::{Handle, Noise, NoiseSum, Perlin, Spread, Texture, Value, VeinKind, Veins};
use glam::Vec3;
use std::collections::BTreeMap;

/// What values of a texture are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Number {
    Float,
    Spectrum,
}

/// Textures by their names, of which each type has its own.
#[derive(Debug, Default)]
pub(super) struct Textures {
    known: BTreeMap<(Number, String), Handle<Texture>>,
    spots: Vec<(Handle<Texture>, Spot)>,
}

const CLASSES: [&str; 13] = [
    "constant",
    "scale",
    "mix",
    "directionmix",
    "bilerp",
    "imagemap",
    "checkerboard",
    "dots",
    "fbm",
    "wrinkled",
    "windy",
    "marble",
    "ptex",
];

impl Reader<'_> {
    pub(super) fn texture(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let ([name, kind, class], from) = self.texture_head(lexer, spot)?;
        let number = match kind.as_str() {
            "float" => Number::Float,
            "spectrum" => Number::Spectrum,
            _ => {
                let message = format!("the type of texture \"{}\" is \"{}\"", shown(&name), shown(&kind));
                return Err(spot.error(message).help("write \"float\" or \"spectrum\""));
            }
        };
        if self.textures.known.contains_key(&(number, name.clone())) {
            let message = format!("there is a {kind} texture \"{}\" already", shown(&name));
            return Err(spot.error(message).help("choose another name"));
        }
        let texture = self.of_class(&class, number, &from)?;
        from.finish()?;
        let handle = self.scene.textures.add(name.as_str(), texture);
        self.textures.known.insert((number, name), handle);
        self.textures.spots.push((handle, spot.clone()));
        Ok(())
    }

    fn of_class(&mut self, class: &str, number: Number, from: &Parameters) -> Result<Texture> {
        Ok(match class {
            "constant" => Texture::Constant(self.constant(from, number)?),
            "scale" => self.scale(from, number)?,
            "mix" => {
                let (a, b) = (self.input(from, "tex1", number, 0.0)?, self.input(from, "tex2", number, 1.0)?);
                let amount = self.input(from, "amount", Number::Float, 0.5)?;
                self.blend(a, b, amount)
            }
            "directionmix" => {
                let (a, b) = (self.input(from, "tex1", number, 0.0)?, self.input(from, "tex2", number, 1.0)?);
                let direction =
                    self.direction(from, from.vector_or("dir", Vec3::Y)?, "dir is the zero vector")?;
                Texture::DirectionMix { a, b, direction }
            }
            "bilerp" => self.bilerp(from, number)?,
            "imagemap" => self.image_map(from, number)?,
            "checkerboard" => self.checkerboard(from, number)?,
            "dots" => self.dots(from, number)?,
            "fbm" | "wrinkled" | "windy" if number == Number::Float => self.noise(from, class)?,
            "marble" if number == Number::Spectrum => self.marble(from)?,
            "ptex" => {
                self.unsupported(Unsupported::Ptex, &from.spot);
                from.ignore(&["filename", "encoding", "scale"]);
                Texture::Constant(Vec3::splat(0.5))
            }
            "fbm" | "wrinkled" | "windy" | "marble" => {
                let other = if number == Number::Float { "spectrum" } else { "float" };
                let message = format!("{} is for {other} textures alone", from.what);
                return Err(from.error(message).help(format!("change its type to \"{other}\"")));
            }
            _ => return Err(self.unknown("Texture", class, from, &CLASSES)),
        })
    }

    /// Checks that no texture is made of too many, one in the other.
    pub(super) fn check_textures(&self) -> Result<()> {
        let Some(endless) = Texture::without_end(&self.scene.textures) else { return Ok(()) };
        let message = Texture::endless(&shown(self.scene.textures.name(endless)));
        let error = crate::Error::scene(message).help("use fewer textures of textures");
        Err(match self.textures.spots.iter().find(|(handle, _)| *handle >= endless) {
            Some((_, spot)) => spot.locate(error),
            None => error,
        })
    }

    /// A texture without a name of its own.
    pub(super) fn part(&mut self, texture: Texture) -> Handle<Texture> {
        self.scene.textures.add("a part of a texture", texture)
    }

    /// A texture by its name.
    fn known(
        &self,
        from: &Parameters,
        name: &'static str,
        number: Number,
    ) -> Result<Option<Handle<Texture>>> {
        let Some((parameter, text)) = from.one_string(name, Type::Texture)? else { return Ok(None) };
        match self.textures.known.get(&(number, text.to_owned())) {
            Some(handle) => Ok(Some(*handle)),
            None => {
                let kind = if number == Number::Float { "float" } else { "spectrum" };
                let names = self.textures.known.keys().filter(|(one, _)| *one == number);
                let help = suggest(text, names.map(|(_, name)| name.as_str()), &format!("{kind} textures"));
                let message = format!("no {kind} texture is named \"{}\"", shown(text));
                Err(parameter.spot.error(message).help(help))
            }
        }
    }

    /// A number or a texture of numbers; none when it is not there.
    pub(super) fn float_texture(
        &self,
        from: &Parameters,
        name: &'static str,
        limits: Limits,
    ) -> Result<Option<Value<f32>>> {
        match self.known(from, name, Number::Float)? {
            Some(handle) => Ok(Some(Value::Texture(handle))),
            None => Ok(from.float(name, limits)?.map(Value::Constant)),
        }
    }

    /// A spectrum or a texture of spectra; none when it is not there.
    pub(super) fn spectrum_texture(
        &mut self,
        from: &Parameters,
        name: &'static str,
        role: Role,
    ) -> Result<Option<Value<Vec3>>> {
        match self.known(from, name, Number::Spectrum)? {
            Some(handle) => Ok(Some(Value::Texture(handle))),
            None => Ok(self.spectrum(from, name)?.map(|spectrum| Value::Constant(spectrum.rgb(role)))),
        }
    }

    /// What a texture is made of.
    pub(super) fn input(
        &mut self,
        from: &Parameters,
        name: &'static str,
        number: Number,
        default: f32,
    ) -> Result<Value<Vec3>> {
        let found = match number {
            Number::Float => self.float_texture(from, name, Limits::Finite)?.map(splat),
            Number::Spectrum => self.spectrum_texture(from, name, Role::Albedo)?,
        };
        Ok(found.unwrap_or(Value::Constant(Vec3::splat(default))))
    }

    fn constant(&mut self, from: &Parameters, number: Number) -> Result<Vec3> {
        match number {
            Number::Float => Ok(Vec3::splat(from.float_or("value", 1.0, Limits::Finite)?)),
            Number::Spectrum => self.rgb_or(from, "value", Role::Albedo, Vec3::ONE),
        }
    }

    fn scale(&mut self, from: &Parameters, number: Number) -> Result<Texture> {
        let value = self.input(from, "tex", number, 1.0)?;
        let factor = self.float_texture(from, "scale", Limits::Finite)?.unwrap_or(Value::Constant(1.0));
        Ok(Texture::Scale { value, factor })
    }

    /// (1 − amount) · a + amount · b, where an amount may be below 0 and above 1.
    pub(super) fn blend(&mut self, a: Value<Vec3>, b: Value<Vec3>, amount: Value<Vec3>) -> Texture {
        match amount {
            Value::Constant(amount) if (0.0..=1.0).contains(&amount.x) => {
                Texture::Mix { a, b, amount: Value::Constant(amount.x) }
            }
            Value::Texture(handle) => match &self.scene.textures[handle] {
                // Noise goes on in a straight line by itself
                Texture::Noise(noise) if noise.low == ZERO && noise.high == ONE => {
                    Texture::Noise(Noise { low: a, high: b, ..noise.clone() })
                }
                Texture::Checker { even, odd, .. } if within(even) && within(odd) => {
                    Texture::Mix { a, b, amount: Value::Texture(handle) }
                }
                Texture::Image(image) if image.scale <= 1.0 => {
                    Texture::Mix { a, b, amount: Value::Texture(handle) }
                }
                _ => self.sum(a, b, amount),
            },
            Value::Constant(_) => self.sum(a, b, amount),
        }
    }

    /// The same, without the end at 0 and 1 that a mix has.
    pub(super) fn sum(&mut self, a: Value<Vec3>, b: Value<Vec3>, amount: Value<Vec3>) -> Texture {
        let rest = Value::Texture(self.part(Texture::Invert { value: amount }));
        let a = Value::Texture(self.part(Texture::Multiply { a, b: rest }));
        let b = Value::Texture(self.part(Texture::Multiply { a: b, b: amount }));
        Texture::Add { a, b }
    }

    fn noise(&mut self, from: &Parameters, class: &str) -> Result<Texture> {
        let sum = match class {
            "windy" => NoiseSum::Windy,
            "wrinkled" => NoiseSum::Turbulence,
            _ => NoiseSum::Fbm,
        };
        let windy = sum == NoiseSum::Windy;
        Ok(Texture::Noise(Noise {
            perlin: Perlin::PBRT,
            sum,
            octaves: if windy { Noise::WAVE_OCTAVES } else { octaves(from)? },
            gain: if windy { 0.5 } else { gain(from)? },
            lacunarity: Noise::PBRT_LACUNARITY,
            normalize: false,
            w: [0.0; 2],
            low: ZERO,
            high: ONE,
            space: self.solid(from, 1.0)?,
        }))
    }

    fn marble(&mut self, from: &Parameters) -> Result<Texture> {
        let scale = from.float_or("scale", 1.0, Limits::Finite)?;
        Ok(Texture::Veins(Veins {
            kind: VeinKind::Marble,
            octaves: octaves(from)?,
            gain: gain(from)?,
            lacunarity: Noise::PBRT_LACUNARITY,
            variation: from.float_or("variation", 0.2, Limits::Finite)?,
            colors: Spread::Spline(Veins::MARBLE.map(Vec3::from_array).to_vec()),
            space: self.solid(from, scale)?,
        }))
    }
}

const ZERO: Value<Vec3> = Value::Constant(Vec3::ZERO);
const ONE: Value<Vec3> = Value::Constant(Vec3::ONE);

/// Whether a value is a constant that an amount of a mix may be.
fn within(value: &Value<Vec3>) -> bool {
    matches!(value, Value::Constant(v) if v.min_element() >= 0.0 && v.max_element() <= 1.0)
}

/// A number as a grey.
fn splat(value: Value<f32>) -> Value<Vec3> {
    match value {
        Value::Constant(number) => Value::Constant(Vec3::splat(number)),
        Value::Texture(handle) => Value::Texture(handle),
    }
}

fn octaves(from: &Parameters) -> Result<u32> {
    from.integer_or("octaves", 8, 1, Noise::MOST_OCTAVES)
}

/// Factor on the amplitude from one octave to the next.
fn gain(from: &Parameters) -> Result<f32> {
    from.float_or("roughness", 0.5, Limits::From(0.0, 1.0))
}
