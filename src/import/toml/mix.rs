//! `[material.NAME]` of kind `mix`.

use super::document::Entry;
use super::reader::Reader;
use super::text::{Limits, shown};
use super::view::View;
use crate::Result;
use crate::scene::{Emission, Handle, Material, Mix, Surface, Texture, Value};
use glam::Vec3;

impl Reader<'_> {
    pub(super) fn mix(&self, view: &View<'_>) -> Result<Mix> {
        Ok(Mix {
            a: self.materials.find(view.need("a")?)?,
            b: self.materials.find(view.need("b")?)?,
            amount: self.number_or(view, "amount", 0.5, Limits::From(0.0, 1.0))?,
        })
    }

    /// Gives each mix without an emission of its own that of its parts, mixed by the same amount; those of least depth first.
    pub(super) fn mixed_emission(&mut self, entries: &[Entry], handles: &[Handle<Material>]) -> Result<()> {
        let mut mixes = Vec::new();
        for (entry, &handle) in entries.iter().zip(handles) {
            match Material::mix_depth(&self.scene.materials, handle) {
                None => return Err(self.sources.error(entry.spot, Material::endless(&shown(&entry.key)))),
                Some(0) => {}
                Some(depth) => mixes.push((depth, entry, handle)),
            }
        }
        mixes.retain(|(_, _, handle)| self.scene.materials[*handle].emission.is_none());
        mixes.sort_by_key(|(depth, ..)| *depth);
        for (_, entry, handle) in mixes {
            let Surface::Mix(mix) = self.scene.materials[handle].surface.clone() else { continue };
            self.scene.materials[handle].emission = self.mixed(entry, &mix)?;
        }
        Ok(())
    }

    fn mixed(&mut self, entry: &Entry, mix: &Mix) -> Result<Option<Emission>> {
        let [a, b] = [mix.a, mix.b].map(|part| self.scene.materials[part].emission.clone());
        let two_sided = match (&a, &b) {
            (None, None) => return Ok(None),
            (Some(a), Some(b)) if a.two_sided != b.two_sided => {
                let message = format!("one part of material `{}` shines from both sides", shown(&entry.key));
                return Err(self.sources.error(entry.spot, message).help("give both the same `two_sided`"));
            }
            (Some(part), _) | (None, Some(part)) => part.two_sided,
        };
        let radiance =
            |part: Option<Emission>| part.map_or(Value::Constant(Vec3::ZERO), |part| part.radiance);
        let (a, b) = (radiance(a), radiance(b));
        let radiance = match (a, b, mix.amount) {
            (Value::Constant(a), Value::Constant(b), Value::Constant(amount)) => {
                Value::Constant(a.lerp(b, amount))
            }
            (a, b, amount) => {
                let mixed = Texture::Mix { a, b, amount };
                Value::Texture(self.scene.textures.add(format!("emission of {}", entry.key), mixed))
            }
        };
        Ok(Some(Emission { radiance, two_sided }))
    }
}
