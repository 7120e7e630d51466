//! Keys of materials.

use super::Kinds;

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

pub(in super::super) const MATERIAL: Kinds = Kinds {
    common: &[
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
    ],
    kinds: &[
        ("unlit", &["color"]),
        ("diffuse", &["color"]),
        ("diffuse_transmission", &["color", "transmittance"]),
        ("phong", &["diffuse", "specular", "exponent"]),
        ("conductor", &["reflectance", "fresnel", "eta", "k", "roughness", "alpha"]),
        ("dielectric", &["ior", "abbe", "roughness", "alpha", "absorption", "thin"]),
        ("coated_diffuse", &["color", "ior", "roughness", "alpha"]),
        ("coated_conductor", COATED_CONDUCTOR),
        ("principled", PRINCIPLED),
        ("mix", &["a", "b", "amount"]),
    ],
};
