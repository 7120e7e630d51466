//! `[material.NAME]`.

use super::Writer;
use super::keys::{Keys, color, number, one_or_two};
use crate::Result;
use crate::scene::{
    Bsdf, Conductor, Derivative, Detail, Dielectric, Emission, Fresnel, Handle, Interface, Material, Mix,
    Opacity, Principled, Roughness, Sides, Surface, Tangents,
};
use glam::Vec3;

/// The keys of GGX widths: squared, and as they are.
const WIDTHS: [&str; 2] = ["roughness", "alpha"];

impl Writer<'_> {
    pub(super) fn material(&mut self, _: Handle<Material>, material: &Material) -> Result<Keys> {
        let mut keys = self.surface(&material.surface);
        match &material.emission {
            Some(emission) => self.emission(&mut keys, emission, material.detail.sides),
            // Of a mix nothing said would be what its parts send out
            None => {
                if let Surface::Mix(mix) = &material.surface
                    && [mix.a, mix.b].iter().any(|part| self.scene.materials[*part].emission.is_some())
                {
                    keys.set("emission", 0);
                }
            }
        }
        self.detail(&mut keys, &material.detail);
        Ok(keys)
    }

    fn surface(&self, surface: &Surface) -> Keys {
        let mut keys;
        match surface {
            Surface::Unlit { color } => {
                keys = Keys::of_kind("unlit");
                keys.set("color", self.color(color));
            }
            Surface::Bsdf(bsdf) => keys = self.bsdf(bsdf),
            Surface::Conductor(conductor) => {
                keys = Keys::of_kind("conductor");
                self.conductor(&mut keys, conductor);
            }
            Surface::Dielectric(dielectric) => keys = self.dielectric(dielectric),
            Surface::CoatedDiffuse(coated) => {
                keys = Keys::of_kind("coated_diffuse");
                self.put_color(&mut keys, "color", &coated.color, 0.5);
                self.interface(&mut keys, "ior", WIDTHS, &coated.interface);
            }
            Surface::CoatedConductor(coated) => {
                keys = Keys::of_kind("coated_conductor");
                self.conductor(&mut keys, &coated.conductor);
                let widths = ["interface_roughness", "interface_alpha"];
                self.interface(&mut keys, "interface_ior", widths, &coated.interface);
            }
            Surface::Principled(principled) => keys = self.principled(principled),
            Surface::Mix(mix) => keys = self.mix(mix),
        }
        keys
    }

    fn bsdf(&self, bsdf: &Bsdf) -> Keys {
        let mut keys = Keys::of_kind(bsdf.kind.name);
        for (of, color) in bsdf.kind.colors.iter().zip(&bsdf.colors) {
            self.put_color(&mut keys, of.key, color, of.default);
        }
        for (of, number) in bsdf.kind.numbers.iter().zip(&bsdf.numbers) {
            self.put_amount(&mut keys, of.key, number, of.default);
        }
        keys
    }

    fn conductor(&self, keys: &mut Keys, conductor: &Conductor) {
        match &conductor.fresnel {
            Fresnel::Index { eta, k } => {
                keys.set("eta", self.color(eta));
                keys.set("k", self.color(k));
            }
            Fresnel::Exact => self.reflectance(keys, conductor, "exact"),
            Fresnel::Schlick => self.reflectance(keys, conductor, "schlick"),
            Fresnel::None => self.reflectance(keys, conductor, "none"),
        }
        self.widths(keys, WIDTHS, &conductor.roughness, &Roughness::alpha(0.0));
    }

    fn reflectance(&self, keys: &mut Keys, conductor: &Conductor, model: &str) {
        self.put_color(keys, "reflectance", &conductor.reflectance, 0.9);
        keys.word("fresnel", model, "exact");
    }

    fn dielectric(&self, dielectric: &Dielectric) -> Keys {
        let mut keys = Keys::of_kind("dielectric");
        self.put_amount(&mut keys, "ior", &dielectric.ior, 1.5);
        self.widths(&mut keys, WIDTHS, &dielectric.roughness, &Roughness::alpha(0.0));
        keys.flag("thin", dielectric.thin, false);
        inside(&mut keys, !dielectric.thin, dielectric.abbe, dielectric.absorption);
        keys
    }

    fn interface(&self, keys: &mut Keys, index: &str, widths: [&str; 2], interface: &Interface) {
        keys.number(index, interface.ior, 1.5);
        self.widths(keys, widths, &interface.roughness, &Roughness::alpha(0.0));
    }

    fn principled(&self, principled: &Principled) -> Keys {
        let mut keys = Keys::of_kind("principled");
        let p = principled;
        self.put_color(&mut keys, "base_color", &p.base_color, 0.5);
        self.put_amount(&mut keys, "metallic", &p.metallic, 0.0);
        self.widths(&mut keys, WIDTHS, &p.roughness, &Principled::default().roughness);
        self.put_amount(&mut keys, "ior", &p.ior, 1.5);
        self.put_amount(&mut keys, "specular", &p.specular, 1.0);
        self.put_color(&mut keys, "specular_color", &p.specular_color, 1.0);
        self.put_amount(&mut keys, "transmission", &p.transmission, 0.0);
        keys.flag("thin", p.thin, false);
        inside(&mut keys, p.has_inside(), p.abbe, p.absorption);
        self.put_amount(&mut keys, "clearcoat", &p.clearcoat, 0.0);
        self.put_amount(&mut keys, "clearcoat_roughness", &p.clearcoat_roughness, 0.0);
        self.put_color(&mut keys, "sheen_color", &p.sheen_color, 0.0);
        self.put_amount(&mut keys, "sheen_roughness", &p.sheen_roughness, 0.5);
        keys
    }

    fn mix(&self, mix: &Mix) -> Keys {
        let mut keys = Keys::of_kind("mix");
        keys.set("a", self.materials.refer(mix.a));
        keys.set("b", self.materials.refer(mix.b));
        self.put_amount(&mut keys, "amount", &mix.amount, 0.5);
        keys
    }

    fn widths(&self, keys: &mut Keys, names: [&str; 2], widths: &Roughness, default: &Roughness) {
        if widths != default {
            let key = if widths.squared { names[0] } else { names[1] };
            keys.set(key, one_or_two([self.amount(&widths.u), self.amount(&widths.v)]));
        }
    }

    fn emission(&self, keys: &mut Keys, emission: &Emission, sides: Sides) {
        keys.set("emission", self.color(&emission.radiance));
        // What is not there from behind sends nothing out there
        keys.flag("two_sided", emission.two_sided && sides == Sides::Both, false);
    }

    fn detail(&self, keys: &mut Keys, detail: &Detail) {
        if detail.opacity != Opacity::default() {
            keys.set("opacity", self.amount(&detail.opacity.value));
            if let Some(cutoff) = detail.opacity.cutoff {
                keys.set("opacity_cutoff", number(cutoff));
            }
            self.put_color(keys, "filter_color", &detail.opacity.filter, 1.0);
        }
        if detail.sides == Sides::Front {
            keys.set("sides", "front");
        }
        if let Some(bump) = &detail.bump {
            let mut table = Keys::new();
            table.set("texture", self.textures.refer(bump.texture));
            table.number("height", bump.height, 1.0);
            let derivative = match bump.derivative {
                Derivative::Kernel => "kernel",
                Derivative::Forward => "forward",
                Derivative::Analytic => "analytic",
            };
            table.word("derivative", derivative, "kernel");
            table.flag("curvature_term", bump.curvature, true);
            keys.set("bump", table.inline());
        }
        if let Some(map) = &detail.normal_map {
            let mut table = Keys::new();
            table.set("texture", self.textures.refer(map.texture));
            table.word("green", if map.green_down { "down" } else { "up" }, "up");
            table.number("strength", map.strength, 1.0);
            table.word(
                "tangents",
                if map.tangents == Tangents::Uv { "uv" } else { "mikktspace" },
                "mikktspace",
            );
            keys.set("normal_map", table.inline());
        }
        if detail.bump.is_some() || detail.normal_map.is_some() {
            keys.flag("soften_terminator", detail.soften_terminator, true);
            keys.flag("keep_visible", detail.keep_visible, true);
        }
    }
}

/// What only a material with an inside has.
fn inside(keys: &mut Keys, has_inside: bool, abbe: Option<f32>, absorption: Vec3) {
    if !has_inside {
        return;
    }
    if let Some(abbe) = abbe {
        keys.set("abbe", number(abbe));
    }
    if absorption != Vec3::ZERO {
        keys.set("absorption", color(absorption));
    }
}
