//! `[texture.NAME]`.

mod glsl;
mod image;
mod join;
mod mapping;
mod noise;
mod pattern;
mod stack;

use super::document::Entry;
use super::keys::TEXTURE;
use super::reader::Reader;
use super::text::{self, Limits};
use super::value;
use super::view::View;
use crate::scene::{Texture, Value};
use crate::{Error, Result};
use glam::Vec3;
use mapping::mapping;
use noise::veins;

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
        Ok(match kind {
            "constant" => Texture::Constant(value::color(view.need("color")?, Limits::Finite)?),
            "vertex_color" => Texture::VertexColor(image::channel(&view)?),
            "checker" => self.checker(&view)?,
            "noise" | "fbm" | "turbulence" | "ridged" | "windy" => self.noise(&view, kind)?,
            "value_noise" => self.value_noise(&view)?,
            "marble" | "wood" | "granite" => veins(&view, kind)?,
            "brick" => self.brick(&view)?,
            "dots" => self.dots(&view)?,
            "gradient" => self.gradient(&view)?,
            "worley" => self.worley(&view)?,
            "ramp" => self.ramp(&view)?,
            "curve" => self.curve(&view)?,
            "mix" => self.mix_texture(&view)?,
            "direction_mix" => Texture::DirectionMix {
                a: self.input_or(&view, "a", Vec3::ZERO)?,
                b: self.input_or(&view, "b", Vec3::ONE)?,
                direction: view.get("direction").map_or(Ok(Vec3::Y), |item| item.direction())?,
            },
            "add" => Texture::Add { a: self.input(&view, "a")?, b: self.input(&view, "b")? },
            "multiply" => Texture::Multiply { a: self.input(&view, "a")?, b: self.input(&view, "b")? },
            "scale" => Texture::Scale {
                value: self.input(&view, "value")?,
                factor: self.number(view.need("factor")?, Limits::Finite)?,
            },
            "invert" => Texture::Invert { value: self.input(&view, "value")? },
            "warp" => self.warp(&view)?,
            "glsl" => Texture::Glsl(self.glsl_texture(&view)?),
            "stack" => Texture::Stack(self.stack_texture(&view)?),
            "mapped" => {
                let mapping = mapping(&view)?
                    .ok_or_else(|| view.error(format!("`mapping` is missing in {}", view.what)))?;
                Texture::Mapped { value: self.input(&view, "value")?, mapping }
            }
            _ => {
                let image = Texture::Image(self.image_texture(&view)?);
                let Some(mapping) = mapping(&view)? else { return Ok(image) };
                let image = self.scene.textures.add(format!("picture of {}", entry.key), image);
                Texture::Mapped { value: Value::Texture(image), mapping }
            }
        })
    }

    /// A colour or texture that must be there.
    fn input(&self, view: &View<'_>, key: &str) -> Result<Value<Vec3>> {
        self.color(view.need(key)?, Limits::Finite)
    }

    /// A colour or texture, or what it is without the key.
    fn input_or(&self, view: &View<'_>, key: &str, default: Vec3) -> Result<Value<Vec3>> {
        match view.get(key) {
            Some(item) => self.color(item, Limits::Finite),
            None => Ok(Value::Constant(default)),
        }
    }
}
