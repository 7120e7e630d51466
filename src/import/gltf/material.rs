//! Materials: metallic-roughness and its extensions as the principled material, which has the same parameters.

use super::json::Json;
use super::reader::Reader;
use super::texture::{VECTOR, number_in};
use crate::Result;
use crate::scene::{
    Channel, Detail, Dielectric, Emission, Handle, Material, NormalMap, Opacity, Principled, Roughness,
    Sides, Surface, Tangents, Value,
};
use glam::{Vec3, Vec4};

/// Extensions of materials that are left out.
const LEFT_OUT: [&str; 4] = [
    "KHR_materials_anisotropy",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
];

impl<'a> Reader<'a> {
    /// A material of the document, or the default of the specification, for vertices with colours or without. Each is read once.
    pub fn material(&mut self, index: Option<usize>, colored: bool) -> Result<Handle<Material>> {
        if let Some(known) = self.known_materials.get(&(index, colored)) {
            return Ok(*known);
        }
        let handle = match index {
            None => {
                let white = Principled {
                    base_color: self.dyed(Value::Constant(Vec3::ONE), Channel::Rgb, colored),
                    metallic: Value::Constant(1.0),
                    roughness: roughness(Value::Constant(1.0)),
                    ..Principled::default()
                };
                let surface = Surface::Principled(Box::new(white));
                let detail = Detail { sides: Sides::Front, ..Detail::default() };
                self.scene.materials.add("default material", Material { surface, emission: None, detail })
            }
            Some(index) => {
                let json = self.materials[index].clone();
                let material = self.read_material(&json, colored)?;
                self.scene.materials.add(json.name("material", index)?, material)
            }
        };
        self.known_materials.insert((index, colored), handle);
        Ok(handle)
    }

    fn read_material(&mut self, json: &Json<'a>, colored: bool) -> Result<Material> {
        for name in LEFT_OUT {
            if json.extension(name)?.is_some() {
                self.warn(json, &format!("the material is seen without {name}"));
            }
        }
        let double_sided = json.flag("doubleSided")?;
        let (base_color, opacity) = self.base(json, colored)?;
        let sides = if double_sided { Sides::Both } else { Sides::Front };
        let mut detail = Detail { opacity, sides, normal_map: self.normal_map(json)?, ..Detail::default() };
        if json.extension("KHR_materials_unlit")?.is_some() {
            return Ok(Material { surface: Surface::Unlit { color: base_color }, emission: None, detail });
        }
        let mut principled = Principled { base_color, ..Principled::default() };
        self.metallic_roughness(json, &mut principled)?;
        self.layers(json, &mut principled)?;
        if principled.transmission != Value::Constant(0.0) {
            // Light leaves through what is met from behind
            detail.sides = Sides::Both;
        }
        let emission = self.emission(json, double_sided)?;
        Ok(Material { surface: Surface::Principled(Box::new(principled)), emission, detail })
    }

    /// Base colour and opacity, and colours of vertices as a factor on both.
    fn base(&mut self, json: &Json<'a>, colored: bool) -> Result<(Value<Vec3>, Opacity)> {
        let (mut factor, mut texture) = (Vec4::ONE, None);
        let pbr = json.get("pbrMetallicRoughness")?;
        let color = match &pbr {
            Some(pbr) => {
                factor = self.clamped(pbr, "baseColorFactor", [1.0; 4])?.into();
                texture = pbr.get("baseColorTexture")?;
                self.color(pbr, factor.truncate(), "baseColorTexture")?
            }
            None => Value::Constant(Vec3::ONE),
        };
        let color = self.dyed(color, Channel::Rgb, colored);
        let mode = json.get("alphaMode")?;
        let cutoff = match mode.as_ref().map(Json::string).transpose()? {
            None | Some("OPAQUE") => return Ok((color, Opacity::default())),
            Some("MASK") => Some(json.number_or("alphaCutoff", 0.5)?.max(0.0)),
            Some("BLEND") => None,
            Some(_) => return Err(json.error("`alphaMode` is none of OPAQUE, MASK and BLEND")),
        };
        let value = match texture {
            Some(info) => self.scaled(&info, number_in(Channel::A), factor.w)?,
            None => Value::Constant(factor.w),
        };
        let value = self.dyed(value, Channel::A, colored);
        Ok((color, Opacity { value, cutoff, ..Opacity::default() }))
    }

    fn metallic_roughness(&mut self, json: &Json<'a>, principled: &mut Principled) -> Result<()> {
        let key = "metallicRoughnessTexture";
        (principled.metallic, principled.roughness) = match json.get("pbrMetallicRoughness")? {
            Some(pbr) => (
                self.number(&pbr, "metallicFactor", 1.0, key, Channel::B)?,
                roughness(self.number(&pbr, "roughnessFactor", 1.0, key, Channel::G)?),
            ),
            None => (Value::Constant(1.0), roughness(Value::Constant(1.0))),
        };
        Ok(())
    }

    fn normal_map(&mut self, json: &Json<'a>) -> Result<Option<NormalMap>> {
        let Some(info) = json.get("normalTexture")? else { return Ok(None) };
        let most = NormalMap::MOST_STRENGTH;
        let strength = info.number_or("scale", 1.0)?.clamp(-most, most);
        let texture = self.picture(&info, VECTOR)?;
        let map =
            |texture| NormalMap { texture, green_down: false, strength, tangents: Tangents::MikkTSpace };
        Ok(texture.map(map))
    }

    fn emission(&mut self, json: &Json<'a>, two_sided: bool) -> Result<Option<Emission>> {
        let strength = match json.extension("KHR_materials_emissive_strength")? {
            Some(extension) => extension.number_or("emissiveStrength", 1.0)?.max(0.0),
            None => 1.0,
        };
        let factor = Vec3::from(self.clamped(json, "emissiveFactor", [0.0; 3])?) * strength;
        if !factor.is_finite() {
            return Err(json.error("the emission is too large"));
        }
        if factor == Vec3::ZERO {
            return Ok(None);
        }
        let radiance = self.color(json, factor, "emissiveTexture")?;
        Ok(Some(Emission { radiance, two_sided }))
    }

    /// What extensions add to the model.
    fn layers(&mut self, json: &Json<'a>, principled: &mut Principled) -> Result<()> {
        if let Some(ior) = json.extension("KHR_materials_ior")? {
            let ior = ior.number_or("ior", 1.5)?;
            // 0 means one without end
            let ior =
                if ior == 0.0 { Dielectric::MOST_INDEX } else { ior.clamp(1.0, Dielectric::MOST_INDEX) };
            principled.ior = Value::Constant(ior);
        }
        if let Some(specular) = json.extension("KHR_materials_specular")? {
            principled.specular =
                self.number(&specular, "specularFactor", 1.0, "specularTexture", Channel::A)?;
            let factor = Vec3::from(specular.numbers_or("specularColorFactor", [1.0; 3])?).max(Vec3::ZERO);
            principled.specular_color = self.color(&specular, factor, "specularColorTexture")?;
        }
        if let Some(coat) = json.extension("KHR_materials_clearcoat")? {
            principled.clearcoat =
                self.number(&coat, "clearcoatFactor", 0.0, "clearcoatTexture", Channel::R)?;
            let (factor, texture) = ("clearcoatRoughnessFactor", "clearcoatRoughnessTexture");
            principled.clearcoat_roughness = self.number(&coat, factor, 0.0, texture, Channel::G)?;
            if let Some(normals) = coat.get("clearcoatNormalTexture")? {
                self.warn(&normals, "the coat has the normals of the surface");
            }
        }
        if let Some(sheen) = json.extension("KHR_materials_sheen")? {
            let factor = self.clamped(&sheen, "sheenColorFactor", [0.0; 3])?.into();
            principled.sheen_color = self.color(&sheen, factor, "sheenColorTexture")?;
            let texture = "sheenRoughnessTexture";
            principled.sheen_roughness =
                self.number(&sheen, "sheenRoughnessFactor", 0.0, texture, Channel::A)?;
        }
        self.transmission(json, principled)
    }

    /// Without a volume, what lets light through is a thin sheet.
    fn transmission(&mut self, json: &Json<'a>, principled: &mut Principled) -> Result<()> {
        let Some(transmission) = json.extension("KHR_materials_transmission")? else { return Ok(()) };
        let texture = "transmissionTexture";
        principled.transmission =
            self.number(&transmission, "transmissionFactor", 0.0, texture, Channel::R)?;
        principled.thin = true;
        let Some(volume) = json.extension("KHR_materials_volume")? else { return Ok(()) };
        if volume.number_or("thicknessFactor", 0.0)? <= 0.0 {
            return Ok(());
        }
        principled.thin = false;
        if let Some(dispersion) = json.extension("KHR_materials_dispersion")? {
            // 20 over the Abbe number
            let dispersion = dispersion.number_or("dispersion", 0.0)?;
            principled.abbe = Dielectric::abbe_within(20.0 / dispersion).filter(|_| dispersion > 0.0);
        }
        let color = Vec3::from(self.clamped(&volume, "attenuationColor", [1.0; 3])?);
        let distance = volume.number_or("attenuationDistance", f32::INFINITY)?;
        if distance <= 0.0 {
            return Err(volume.error("`attenuationDistance` must be above 0"));
        }
        // A colour that is black in a channel lets none of it through: e⁻⁸⁸ is the least that 32 bits hold
        let depth = color.map(|c| (-c.max(f32::MIN_POSITIVE).ln()).max(0.0));
        principled.absorption = (depth / distance).min(Vec3::splat(f32::MAX));
        Ok(())
    }
}

/// The same in all directions.
fn roughness(value: Value<f32>) -> Roughness {
    Roughness { u: value, v: value, squared: true }
}
