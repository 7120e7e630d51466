//! `[material.NAME]`.

use super::document::Entry;
use super::keys::MATERIAL;
use super::reader::Reader;
use super::text::{Limits, number as number_text, shown};
use super::view::{Item, View};
use crate::scene::{
    Bsdf, BsdfKind, CoatedConductor, CoatedDiffuse, Conductor, Dielectric, Emission, Fresnel, ImageTexture,
    InputColor, InputNumber, Interface, Material, Principled, Roughness, Surface, Texture, Value,
};
use crate::{Error, Result};
use glam::Vec3;

/// What a reflectance may be.
const REFLECTANCE: Limits = Limits::From(0.0, 1.0);
/// The GGX widths of a surface, squared and as they are.
const WIDTHS: [&str; 2] = ["roughness", "alpha"];

impl Reader<'_> {
    /// All materials. Mixes may be made of others in any order, so each has its name before any is read.
    pub fn materials(&mut self, entries: &[Entry]) -> Result<()> {
        for entry in entries {
            let surface = Surface::diffuse(Value::Constant(Vec3::ZERO));
            let handle = self.scene.materials.add(&entry.key, Material::new(surface, None));
            self.materials.add(&entry.key, entry.spot, handle);
        }
        let handles: Vec<_> = self.scene.materials.iter().map(|(handle, ..)| handle).collect();
        for (entry, &handle) in entries.iter().zip(&handles) {
            self.scene.materials[handle] = self.material(entry)?;
        }
        self.mixed_emission(entries, &handles)
    }

    fn material(&mut self, entry: &Entry) -> Result<Material> {
        let name = shown(&entry.key);
        let (view, kind) = View::of_kind(self.sources, &entry.node, format!("material `{name}`"), &MATERIAL)?;
        let surface = match kind {
            "unlit" => Surface::Unlit { color: self.color(view.need("color")?, Limits::AtLeast(0.0))? },
            "conductor" => Surface::Conductor(self.conductor(&view)?),
            "dielectric" => Surface::Dielectric(self.dielectric(&view)?),
            "coated_diffuse" => Surface::CoatedDiffuse(CoatedDiffuse {
                color: self.color_or(&view, "color", 0.5, REFLECTANCE)?,
                interface: self.interface(&view, "ior", WIDTHS)?,
            }),
            "coated_conductor" => Surface::CoatedConductor(Box::new(CoatedConductor {
                conductor: self.conductor(&view)?,
                interface: self.interface(
                    &view,
                    "interface_ior",
                    ["interface_roughness", "interface_alpha"],
                )?,
            })),
            "principled" => Surface::Principled(Box::new(self.principled(&view)?)),
            "mix" => Surface::Mix(self.mix(&view)?),
            bsdf => self.bsdf(entry, &view, bsdf)?,
        };
        let emission = self.emission(&view, &entry.key)?;
        let detail = self.detail(&view)?;
        Ok(Material { surface, emission, detail })
    }

    /// A BSDF of the table.
    fn bsdf(&mut self, entry: &Entry, view: &View<'_>, kind: &str) -> Result<Surface> {
        let kind = BsdfKind::named(kind).ok_or_else(|| view.error(format!("there is no BSDF `{kind}`")))?;
        let color = |of: &InputColor| self.color_or(view, of.key, of.default, REFLECTANCE);
        let colors: Vec<_> = kind.colors.iter().map(color).collect::<Result<_>>()?;
        let number =
            |of: &InputNumber| self.number_or(view, of.key, of.default, Limits::From(of.least, of.most));
        let numbers = kind.numbers.iter().map(number).collect::<Result<_>>()?;
        let constant = |color: &Value<Vec3>| match color {
            Value::Constant(color) => Some(*color),
            Value::Texture(_) => None,
        };
        let sum = colors.iter().map(constant).sum::<Option<Vec3>>().map_or(0.0, Vec3::max_element);
        if sum > 1.0 {
            let keys: Vec<_> = kind.colors.iter().map(|of| format!("`{}`", of.key)).collect();
            let (keys, sum, what) = (keys.join(" + "), number_text(f64::from(sum)), &view.what);
            self.warn(entry.spot, format!("{keys} reaches {sum} in {what}; it is scaled down to 1"));
        }
        Ok(Surface::Bsdf(Bsdf { kind, colors, numbers }))
    }

    fn color_or(&self, view: &View<'_>, key: &str, default: f32, limits: Limits) -> Result<Value<Vec3>> {
        let default = Value::Constant(Vec3::splat(default));
        view.get(key).map_or(Ok(default), |item| self.color(item, limits))
    }

    pub(super) fn number_or(
        &self,
        view: &View<'_>,
        key: &str,
        default: f32,
        limits: Limits,
    ) -> Result<Value<f32>> {
        view.get(key).map_or(Ok(Value::Constant(default)), |item| self.number(item, limits))
    }

    fn conductor(&self, view: &View<'_>) -> Result<Conductor> {
        let roughness = self.roughness(view, WIDTHS)?;
        if view.get("eta").is_none() && view.get("k").is_none() {
            let models = [("exact", Fresnel::Exact), ("schlick", Fresnel::Schlick), ("none", Fresnel::None)];
            let reflectance = self.color_or(view, "reflectance", 0.9, REFLECTANCE)?;
            let fresnel = view.choice_or("fresnel", Fresnel::Exact, &models)?;
            return Ok(Conductor { reflectance, fresnel, roughness });
        }
        for key in ["reflectance", "fresnel"] {
            if let Some(item) = view.get(key) {
                return Err(item
                    .error(format!("`{key}` has no meaning beside `eta` and `k`"))
                    .help("keep one or the other"));
            }
        }
        let eta = self.color(view.need("eta")?, Limits::From(0.0, Dielectric::MOST_INDEX))?;
        let k = self.color(view.need("k")?, Limits::From(0.0, Dielectric::MOST_INDEX))?;
        let reflectance = Value::Constant(Vec3::ONE);
        Ok(Conductor { reflectance, fresnel: Fresnel::Index { eta, k }, roughness })
    }

    fn dielectric(&self, view: &View<'_>) -> Result<Dielectric> {
        let ior = self.number_or(view, "ior", 1.5, Limits::AboveUpTo(0.0, Dielectric::MOST_INDEX))?;
        let roughness = self.roughness(view, WIDTHS)?;
        let thin = view.bool_or("thin", false)?;
        let absorption = absorption(view, thin)?;
        let rough = view.either(WIDTHS[0], WIDTHS[1])?.filter(|_| !roughness.is_smooth());
        if let Some(item) = rough {
            if thin {
                return Err(item
                    .error("a thin sheet must be smooth")
                    .help(format!("remove {}", item.name())));
            }
            if ior == Value::Constant(1.0) {
                return Err(bends_nothing(item, "ior"));
            }
        }
        Ok(Dielectric { ior, roughness, abbe: abbe(view, thin)?, absorption, thin })
    }

    /// A dielectric over an opaque base.
    fn interface(&self, view: &View<'_>, index: &str, widths: [&str; 2]) -> Result<Interface> {
        let ior = view.f32_or(index, 1.5, Limits::From(1.0, Dielectric::MOST_INDEX))?;
        let roughness = self.roughness(view, widths)?;
        match view.either(widths[0], widths[1])? {
            Some(item) if ior == 1.0 && !roughness.is_smooth() => Err(bends_nothing(item, index)),
            _ => Ok(Interface { ior, roughness }),
        }
    }

    fn principled(&self, view: &View<'_>) -> Result<Principled> {
        let part = Limits::From(0.0, 1.0);
        let default = Principled::default();
        let rough = view.get("roughness").or(view.get("alpha"));
        let thin = view.bool_or("thin", false)?;
        let principled = Principled {
            base_color: self.color_or(view, "base_color", 0.5, REFLECTANCE)?,
            metallic: self.number_or(view, "metallic", 0.0, part)?,
            roughness: if rough.is_some() { self.roughness(view, WIDTHS)? } else { default.roughness },
            ior: self.number_or(view, "ior", 1.5, Limits::From(1.0, Dielectric::MOST_INDEX))?,
            specular: self.number_or(view, "specular", 1.0, part)?,
            specular_color: self.color_or(view, "specular_color", 1.0, Limits::AtLeast(0.0))?,
            transmission: self.number_or(view, "transmission", 0.0, part)?,
            abbe: abbe(view, thin)?,
            absorption: absorption(view, thin)?,
            thin,
            clearcoat: self.number_or(view, "clearcoat", 0.0, part)?,
            clearcoat_roughness: self.number_or(view, "clearcoat_roughness", 0.0, part)?,
            sheen_color: self.color_or(view, "sheen_color", 0.0, REFLECTANCE)?,
            sheen_roughness: self.number_or(view, "sheen_roughness", 0.5, part)?,
        };
        match view.get("absorption").or(view.get("abbe")) {
            Some(item) if !principled.has_inside() => Err(item
                .error(format!("{} has no meaning without `transmission`", item.name()))
                .help("add `transmission`")),
            _ => Ok(principled),
        }
    }

    /// GGX widths from a key of roughness (squared) or one of widths (as they are).
    fn roughness(&self, view: &View<'_>, [roughness, alpha]: [&str; 2]) -> Result<Roughness> {
        let Some(item) = view.either(roughness, alpha)? else {
            return Ok(Roughness::alpha(0.0));
        };
        let [u, v] = pair(item, |one| self.number(one, Limits::From(0.0, 1.0)))?;
        Ok(Roughness { u, v, squared: view.get(roughness).is_some() })
    }

    fn emission(&mut self, view: &View<'_>, name: &str) -> Result<Option<Emission>> {
        let Some(item) = view.get("emission") else {
            return match ["emission_scale", "two_sided"].iter().find_map(|key| view.get(key)) {
                Some(item) => {
                    Err(item.error(format!("{} needs `emission`", item.name())).help("add `emission`"))
                }
                None => Ok(None),
            };
        };
        let scale = view.f32_or("emission_scale", 1.0, Limits::AtLeast(0.0))?;
        let two_sided = view.bool_or("two_sided", false)?;
        let radiance = match self.color(item, Limits::AtLeast(0.0))? {
            Value::Constant(color) => {
                let scaled = color * scale;
                if !scaled.is_finite() {
                    return Err(item.error("`emission` times `emission_scale` is too large"));
                }
                Value::Constant(scaled)
            }
            Value::Texture(texture) if scale == 1.0 => Value::Texture(texture),
            Value::Texture(texture) => {
                let scaled = match &self.scene.textures[texture] {
                    Texture::Image(image) => {
                        let scale = image.scale * scale;
                        if !scale.is_finite() {
                            let message = "the `scale` of the texture times `emission_scale` is too large";
                            return Err(item.error(message));
                        }
                        Texture::Image(ImageTexture { scale, ..image.clone() })
                    }
                    _ => Texture::Multiply {
                        a: Value::Texture(texture),
                        b: Value::Constant(Vec3::splat(scale)),
                    },
                };
                Value::Texture(self.scene.textures.add(format!("emission of {name}"), scaled))
            }
        };
        Ok(Some(Emission { radiance, two_sided }))
    }
}

/// A rough boundary of nothing.
fn bends_nothing(item: Item<'_>, index: &str) -> Error {
    item.error(format!("a rough surface needs an `{index}` other than 1"))
        .help(format!("change `{index}` or remove {}", item.name()))
}

/// What only glass with an inside has.
fn of_inside<'a>(view: &View<'a>, key: &str, thin: bool) -> Result<Option<Item<'a>>> {
    match view.get(key) {
        Some(item) if thin => {
            Err(item.error(format!("`{key}` has no meaning for a thin sheet")).help("remove it"))
        }
        item => Ok(item),
    }
}

/// What the inside of glass absorbs.
fn absorption(view: &View<'_>, thin: bool) -> Result<Vec3> {
    let item = of_inside(view, "absorption", thin)?;
    item.map_or(Ok(Vec3::ZERO), |item| super::value::color(item, Limits::AtLeast(0.0)))
}

/// The Abbe number of glass.
fn abbe(view: &View<'_>, thin: bool) -> Result<Option<f32>> {
    let item = of_inside(view, "abbe", thin)?;
    item.map(|item| item.f32(Limits::From(Dielectric::LEAST_ABBE, Dielectric::MOST_ABBE))).transpose()
}

/// One value for both directions, or a list of two.
fn pair<T: Copy>(item: Item<'_>, read: impl Fn(Item<'_>) -> Result<T>) -> Result<[T; 2]> {
    if !item.is_list() {
        return read(item).map(|both| [both; 2]);
    }
    let values: Vec<_> = item.list("a list of two")?.map(read).collect::<Result<_>>()?;
    <[T; 2]>::try_from(values).map_err(|_| item.mismatch("one value or two"))
}
