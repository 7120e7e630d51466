//! Materials to records.

use super::Prepared;
use super::textures::References;
use crate::layout::{
    DIELECTRIC_SOLID, DIELECTRIC_THIN, FRESNEL_EXACT, FRESNEL_INDEX, FRESNEL_NONE, FRESNEL_SCHLICK,
    MATERIAL_CONDUCTOR, MATERIAL_DIELECTRIC, MATERIAL_DIFFUSE, MATERIAL_PHONG, MATERIAL_UNLIT, Material,
    NONE,
};
use crate::scene::{self, Fresnel, Scene, Surface, Value};
use glam::Vec3;

/// Fills `materials`, and the features that they switch on.
pub(super) fn prepare(scene: &Scene, textures: &References, out: &mut Prepared) {
    for (_, _, material) in scene.materials.iter() {
        let record = record(material, textures);
        out.features.material_kinds |= 1 << record.kind;
        out.features.textured_color |= record.color_texture != NONE;
        out.features.textured_specular |= record.specular_texture != NONE;
        out.features.textured_exponent |= record.exponent_texture != NONE;
        out.features.textured_alpha |= record.alpha_u_texture != NONE || record.alpha_v_texture != NONE;
        out.features.textured_emission |= record.emission_texture != NONE;
        out.features.medium |= record.kind == MATERIAL_DIELECTRIC && record.specular != [0.0; 3];
        out.materials.push(record);
    }
}

fn record(material: &scene::Material, textures: &References) -> Material {
    let color = |value: &Value<Vec3>| match value {
        Value::Constant(c) => (c.to_array(), NONE),
        Value::Texture(handle) => ([1.0; 3], textures.reference(*handle)),
    };
    let number = |value: &Value<f32>| match value {
        Value::Constant(x) => (*x, NONE),
        Value::Texture(handle) => (1.0, textures.reference(*handle)),
    };
    let mut r = Material {
        color_texture: NONE,
        specular_texture: NONE,
        emission_texture: NONE,
        alpha_u_texture: NONE,
        alpha_v_texture: NONE,
        exponent_texture: NONE,
        ior: 1.0,
        ..Material::default()
    };
    match &material.surface {
        Surface::Unlit { color: c } => {
            r.kind = MATERIAL_UNLIT;
            (r.color, r.color_texture) = color(c);
        }
        Surface::Diffuse { color: c } => {
            r.kind = MATERIAL_DIFFUSE;
            (r.color, r.color_texture) = color(c);
        }
        Surface::Phong { diffuse, specular, exponent } => {
            r.kind = MATERIAL_PHONG;
            (r.color, r.color_texture) = color(diffuse);
            (r.specular, r.specular_texture) = color(specular);
            (r.exponent, r.exponent_texture) = number(exponent);
        }
        Surface::Conductor(conductor) => {
            r.kind = MATERIAL_CONDUCTOR;
            (r.color, r.color_texture) = color(&conductor.reflectance);
            (r.alpha_u, r.alpha_u_texture) = number(&conductor.alpha_u);
            (r.alpha_v, r.alpha_v_texture) = number(&conductor.alpha_v);
            r.mode = match conductor.fresnel {
                Fresnel::Index { eta, k } => {
                    (r.specular, r.k) = (eta.to_array(), k.to_array());
                    FRESNEL_INDEX
                }
                Fresnel::Exact => FRESNEL_EXACT,
                Fresnel::Schlick => FRESNEL_SCHLICK,
                Fresnel::None => FRESNEL_NONE,
            };
        }
        Surface::Dielectric(dielectric) => {
            r.kind = MATERIAL_DIELECTRIC;
            r.ior = dielectric.ior;
            r.mode = if dielectric.thin { DIELECTRIC_THIN } else { DIELECTRIC_SOLID };
            (r.alpha_u, r.alpha_u_texture) = number(&dielectric.alpha_u);
            (r.alpha_v, r.alpha_v_texture) = number(&dielectric.alpha_v);
            r.specular = dielectric.absorption.to_array();
        }
    }
    if let Some(emission) = &material.emission {
        (r.emission, r.emission_texture) = color(&emission.radiance);
        r.two_sided = u32::from(emission.two_sided);
    }
    r
}
