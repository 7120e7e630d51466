//! Materials to records.

use super::interface::Interfaces;
use super::textures::References;
use super::{Features, Prepared};
use crate::layout::{
    ColorInput, DIELECTRIC_SOLID, DIELECTRIC_THIN, FRESNEL_EXACT, FRESNEL_INDEX, FRESNEL_NONE,
    FRESNEL_SCHLICK, INPUT_ABSORPTION, INPUT_CLEARCOAT, INPUT_COLOR, INPUT_EMISSION, INPUT_INDEX,
    INPUT_INTERFACE, INPUT_METALLIC, INPUT_MIX, INPUT_ROUGHNESS, INPUT_SHEEN, INPUT_SHEEN_ROUGHNESS,
    INPUT_SPECULAR, MATERIAL_BSDFS, MATERIAL_COATED_CONDUCTOR, MATERIAL_COATED_DIFFUSE, MATERIAL_CONDUCTOR,
    MATERIAL_DIELECTRIC, MATERIAL_FRONT_ONLY, MATERIAL_INTERFACE_SQUARED, MATERIAL_MIX, MATERIAL_PRINCIPLED,
    MATERIAL_SQUARED, MATERIAL_TWO_SIDED, MATERIAL_UNLIT, MATERIAL_WORDS, Material, MaterialHead, MixInput,
    NONE, NumberInputs,
};
use crate::scene::{
    self, Bsdf, CoatedConductor, CoatedDiffuse, Conductor, Dielectric, Fresnel, Interface, Mix, Principled,
    Roughness, Scene, Sides, Surface, Value,
};
use crate::{Error, Result};
use glam::Vec3;

/// The number of a material that has none.
const NO_NUMBER: Value<f32> = Value::Constant(0.0);
/// Interfaces of an index below it bend nothing, and reflect nothing.
const LEAST_INDEX: f32 = 1.0001;

/// Fills `materials`, and the features that they switch on.
pub(super) fn prepare(scene: &Scene, textures: &References, out: &mut Prepared) -> Result<()> {
    let words = scene.materials.len() as u32 * MATERIAL_WORDS;
    let mut interfaces = Interfaces::new(&mut out.interfaces, words);
    for (handle, name, material) in scene.materials.iter() {
        let Some(depth) = scene::Material::mix_depth(&scene.materials, handle) else {
            return Err(Error::scene(scene::Material::endless(name)));
        };
        out.features.mix_depth = out.features.mix_depth.max(depth);
        let mut builder =
            Builder { textures, interfaces: &mut interfaces, features: &mut out.features, record: empty() };
        builder.surface(&material.surface);
        builder.emission(material);
        builder.sides(material.detail.sides);
        let record = builder.record;
        out.features.material_kinds |= 1 << record.head.kind;
        out.materials.push(record);
    }
    Ok(())
}

fn empty() -> Material {
    let black = ColorInput { value: [0.0; 3], texture: NONE };
    let inputs = [bytemuck::cast(black); MATERIAL_WORDS as usize - 1];
    Material { head: MaterialHead::default(), inputs }
}

/// A material in the making.
struct Builder<'a, 'b> {
    textures: &'a References,
    interfaces: &'a mut Interfaces<'b>,
    features: &'a mut Features,
    record: Material,
}

impl Builder<'_, '_> {
    fn surface(&mut self, surface: &Surface) {
        match surface {
            Surface::Unlit { color } => {
                self.kind(MATERIAL_UNLIT);
                self.color(INPUT_COLOR, color);
            }
            Surface::Bsdf(bsdf) => self.bsdf(bsdf),
            Surface::Conductor(conductor) => self.conductor(conductor),
            Surface::Dielectric(dielectric) => self.dielectric(dielectric),
            Surface::CoatedDiffuse(coated) => self.coated_diffuse(coated),
            Surface::CoatedConductor(coated) => self.coated_conductor(coated),
            Surface::Principled(principled) => self.principled(principled),
            Surface::Mix(mix) => self.mix(mix),
        }
    }

    fn bsdf(&mut self, bsdf: &Bsdf) {
        self.kind(MATERIAL_BSDFS + bsdf.kind.index() as u32);
        for (input, color) in [INPUT_COLOR, INPUT_SPECULAR].into_iter().zip(&bsdf.colors) {
            self.color(input, color);
        }
        let number = |i: usize| bsdf.numbers.get(i).copied().unwrap_or(NO_NUMBER);
        self.numbers(INPUT_INDEX, [number(0), number(1)]);
    }

    fn conductor(&mut self, conductor: &Conductor) {
        self.kind(MATERIAL_CONDUCTOR);
        self.roughness(INPUT_ROUGHNESS, MATERIAL_SQUARED, &conductor.roughness);
        if let Fresnel::Index { eta, k } = &conductor.fresnel {
            self.features.metal_index = true;
            self.color(INPUT_SPECULAR, eta);
            self.color(INPUT_ABSORPTION, k);
        } else {
            self.color(INPUT_COLOR, &conductor.reflectance);
        }
        self.record.head.mode = match conductor.fresnel {
            Fresnel::Index { .. } => FRESNEL_INDEX,
            Fresnel::Exact => FRESNEL_EXACT,
            Fresnel::Schlick => FRESNEL_SCHLICK,
            Fresnel::None => FRESNEL_NONE,
        };
    }

    fn coated_diffuse(&mut self, coated: &CoatedDiffuse) {
        self.kind(MATERIAL_COATED_DIFFUSE);
        self.color(INPUT_COLOR, &coated.color);
        self.interface(INPUT_ROUGHNESS, MATERIAL_SQUARED, &coated.interface, false);
    }

    fn coated_conductor(&mut self, coated: &CoatedConductor) {
        self.conductor(&coated.conductor);
        self.kind(MATERIAL_COATED_CONDUCTOR);
        // Its index is relative to the interface, not to air
        self.features.metal_index |= coated.conductor.fresnel == Fresnel::Exact;
        // Metal under a rough interface is rough
        let rough = !(coated.conductor.roughness.is_smooth() && coated.interface.roughness.is_smooth());
        self.interface(INPUT_CLEARCOAT, MATERIAL_INTERFACE_SQUARED, &coated.interface, rough);
    }

    fn interface(&mut self, input: u32, squared: u32, interface: &Interface, rough_base: bool) {
        let ior = interface.ior.max(1.0);
        let rough = !interface.roughness.is_smooth() && ior >= LEAST_INDEX;
        let roughness = if rough { interface.roughness } else { Roughness::alpha(0.0) };
        self.roughness(input, squared, &roughness);
        self.numbers(INPUT_INDEX, [Value::Constant(ior), NO_NUMBER]);
        let record = self.interfaces.input(ior, rough, rough_base);
        self.put(INPUT_INTERFACE, bytemuck::cast(record));
    }

    fn dielectric(&mut self, dielectric: &Dielectric) {
        self.kind(MATERIAL_DIELECTRIC);
        self.record.head.mode = if dielectric.thin { DIELECTRIC_THIN } else { DIELECTRIC_SOLID };
        self.numbers(INPUT_INDEX, [dielectric.ior, NO_NUMBER]);
        self.roughness(INPUT_ROUGHNESS, MATERIAL_SQUARED, &dielectric.roughness);
        self.color(INPUT_ABSORPTION, &Value::Constant(dielectric.absorption));
        self.features.medium |= dielectric.absorption != Vec3::ZERO;
        self.dispersion(dielectric.abbe.filter(|_| !dielectric.thin));
    }

    fn principled(&mut self, principled: &Principled) {
        let solid = principled.has_inside();
        self.kind(MATERIAL_PRINCIPLED);
        // What no light goes through has two sides that are alike, as a sheet has
        self.record.head.mode = if solid { DIELECTRIC_SOLID } else { DIELECTRIC_THIN };
        self.color(INPUT_COLOR, &principled.base_color);
        self.roughness(INPUT_ROUGHNESS, MATERIAL_SQUARED, &principled.roughness);
        self.numbers(INPUT_METALLIC, [principled.metallic, principled.transmission]);
        self.numbers(INPUT_INDEX, [principled.ior, principled.specular]);
        self.color(INPUT_SPECULAR, &principled.specular_color);
        self.color(INPUT_ABSORPTION, &Value::Constant(principled.absorption));
        self.numbers(INPUT_CLEARCOAT, [principled.clearcoat, principled.clearcoat_roughness]);
        self.color(INPUT_SHEEN, &principled.sheen_color);
        self.numbers(INPUT_SHEEN_ROUGHNESS, [principled.sheen_roughness, NO_NUMBER]);
        self.features.medium |= solid && principled.absorption != Vec3::ZERO;
        self.dispersion(principled.abbe.filter(|_| solid));
        self.features.transmission |= principled.transmission != NO_NUMBER;
        self.features.clearcoat |= principled.clearcoat != NO_NUMBER;
        self.features.sheen |= principled.sheen_color != Value::Constant(Vec3::ZERO);
    }

    fn dispersion(&mut self, abbe: Option<f32>) {
        self.features.dispersion |= abbe.is_some();
        self.record.head.dispersion = abbe.map_or(0.0, f32::recip);
    }

    fn mix(&mut self, mix: &Mix) {
        self.kind(MATERIAL_MIX);
        let (amount, amount_texture) = self.number(mix.amount);
        self.note(INPUT_MIX, 0, amount_texture);
        let [first, second] = [mix.a, mix.b].map(|part| part.index() as u32);
        self.put(INPUT_MIX, bytemuck::cast(MixInput { amount, amount_texture, first, second }));
    }

    fn emission(&mut self, material: &scene::Material) {
        let Some(emission) = &material.emission else { return };
        self.color(INPUT_EMISSION, &emission.radiance);
        self.record.head.flags |= if material.shines_behind() { MATERIAL_TWO_SIDED } else { 0 };
    }

    fn sides(&mut self, sides: Sides) {
        self.record.head.flags |= if sides == Sides::Front { MATERIAL_FRONT_ONLY } else { 0 };
    }

    fn kind(&mut self, kind: u32) {
        self.record.head.kind = kind;
    }

    fn roughness(&mut self, input: u32, flag: u32, roughness: &Roughness) {
        let Roughness { u, v, squared } = *roughness;
        self.features.anisotropic |= u != v;
        match (u, v) {
            (Value::Constant(u), Value::Constant(v)) if squared => {
                self.numbers(input, [Value::Constant(u * u), Value::Constant(v * v)]);
            }
            _ => {
                self.numbers(input, [u, v]);
                self.record.head.flags |= if squared { flag } else { 0 };
            }
        }
    }

    fn color(&mut self, input: u32, value: &Value<Vec3>) {
        let (value, texture) = match value {
            Value::Constant(color) => (*color, NONE),
            Value::Texture(handle) => (Vec3::ONE, self.textures.reference(*handle)),
        };
        self.note(input, 0, texture);
        self.put(input, bytemuck::cast(ColorInput { value: value.to_array(), texture }));
    }

    fn numbers(&mut self, input: u32, values: [Value<f32>; 2]) {
        let [(first, first_texture), (second, second_texture)] = values.map(|value| self.number(value));
        self.note(input, 0, first_texture);
        self.note(input, 1, second_texture);
        self.put(input, bytemuck::cast(NumberInputs { first, first_texture, second, second_texture }));
    }

    fn number(&self, value: Value<f32>) -> (f32, u32) {
        match value {
            Value::Constant(number) => (number, NONE),
            Value::Texture(handle) => (1.0, self.textures.reference(handle)),
        }
    }

    fn put(&mut self, input: u32, word: [u32; 4]) {
        self.record.inputs[input as usize - 1] = word;
    }

    /// Switches a texture on for an input, or for one of its two numbers.
    fn note(&mut self, input: u32, which: u32, texture: u32) {
        self.features.textured_inputs |= u32::from(texture != NONE) << (2 * input + which);
    }
}
