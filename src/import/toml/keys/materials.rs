//! Keys of materials.

use super::{Kinds, Rows};
use crate::scene::BSDFS;
use std::sync::LazyLock;

const COATED_CONDUCTOR: &[&str] = &[
    "reflectance",
    "fresnel",
    "eta",
    "k",
    "roughness",
    "alpha",
    "interface_ior",
    "interface_roughness",
    "interface_alpha",
];
const PRINCIPLED: &[&str] = &[
    "base_color",
    "metallic",
    "roughness",
    "alpha",
    "ior",
    "specular",
    "specular_color",
    "transmission",
    "abbe",
    "absorption",
    "thin",
    "clearcoat",
    "clearcoat_roughness",
    "sheen_color",
    "sheen_roughness",
];

const COMMON: &[&str] = &[
    "kind",
    "emission",
    "emission_scale",
    "two_sided",
    "opacity",
    "opacity_cutoff",
    "filter_color",
    "sides",
    "bump",
    "normal_map",
    "soften_terminator",
    "keep_visible",
];

/// Kinds with keys that take more than a row of the table.
const OWN: Rows = &[
    ("unlit", &["color"]),
    ("conductor", &["reflectance", "fresnel", "eta", "k", "roughness", "alpha"]),
    ("dielectric", &["ior", "abbe", "roughness", "alpha", "absorption", "thin"]),
    ("coated_diffuse", &["color", "ior", "roughness", "alpha"]),
    ("coated_conductor", COATED_CONDUCTOR),
    ("principled", PRINCIPLED),
    ("mix", &["a", "b", "amount"]),
];

pub(in super::super) static MATERIAL: LazyLock<Kinds> = LazyLock::new(|| {
    let table = BSDFS.iter().map(|bsdf| {
        let keys =
            bsdf.colors.iter().map(|color| color.key).chain(bsdf.numbers.iter().map(|number| number.key));
        (bsdf.name, keys.collect())
    });
    Kinds::listed(COMMON, table.chain(OWN.iter().map(|(kind, keys)| (*kind, keys.to_vec()))))
});
