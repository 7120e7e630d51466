//! The keys of a mapping, which image textures and `kind = "mapped"` share.

use crate::Result;
use crate::import::toml::keys::MAPPING;
use crate::import::toml::shape::axes;
use crate::import::toml::text::Limits;
use crate::import::toml::transform::{matrix_map, transform};
use crate::import::toml::view::View;
use crate::scene::{Mapping, MappingKind, MappingSpace};
use glam::{Affine3A, Mat3A, Vec3A};

const MAPPINGS: [(&str, MappingKind); 6] = [
    ("uv", MappingKind::Uv),
    ("spherical", MappingKind::Spherical),
    ("cylindrical", MappingKind::Cylindrical),
    ("planar", MappingKind::Planar),
    ("cube", MappingKind::Cube),
    ("triplanar", MappingKind::Triplanar),
];

/// The mapping of a texture, when one of its keys is there.
pub(super) fn mapping(view: &View<'_>) -> Result<Option<Mapping>> {
    let Some(first) = MAPPING.iter().find_map(|key| view.get(key)) else { return Ok(None) };
    let mut kind = view.choice_or("mapping", MappingKind::Uv, &MAPPINGS)?;
    for key in MAPPING.iter().filter(|key| !has_meaning(kind, key)) {
        if let Some(item) = view.get(key) {
            let name = MAPPINGS.iter().find(|(_, one)| *one == kind).map_or("", |(name, _)| name);
            return Err(item
                .error(format!("`{key}` has no meaning for the mapping \"{name}\""))
                .help("remove it, or choose another `mapping`"));
        }
    }
    if view.u32_or("uv_set", 0, 0, 1)? == 1 {
        kind = MappingKind::Uv1;
    }
    let spaces = [("object", MappingSpace::Object), ("world", MappingSpace::World)];
    let mapping = Mapping {
        kind,
        space: view.choice_or("mapping_space", MappingSpace::Object, &spaces)?,
        mapping_from_space: mapping_from_space(view, kind)?,
        pole_u: view.f32_or("pole_u", 0.0, Limits::Finite)?,
        seam_blend: view.f32_or("seam_blend", 0.0, Limits::From(0.0, 1.0))?,
        sharpness: view.f32_or("sharpness", 4.0, Limits::From(1.0, 64.0))?,
    };
    if !mapping.mapping_from_space.is_finite() {
        return Err(first.error("the mapping is too far away"));
    }
    Ok(Some(mapping))
}

/// The map from the space of a mapping to the mapping: as its matrix, or from where it is placed.
fn mapping_from_space(view: &View<'_>, kind: MappingKind) -> Result<Affine3A> {
    if let Some(item) = view.get("mapping_matrix") {
        return match ["mapping_transform", "pole", "meridian"].iter().find_map(|key| view.get(key)) {
            Some(other) => Err(other
                .error(format!("{} has no meaning beside `mapping_matrix`", other.name()))
                .help("keep one or the other")),
            None => matrix_map(item),
        };
    }
    let placed = view.get("mapping_transform").map_or(Ok(Affine3A::IDENTITY), transform)?;
    // z is the pole and x the meridian
    let turned = if turns(kind) {
        let [pole, meridian] = axes(view, "pole")?.map(Vec3A::from);
        Mat3A::from_cols(meridian, pole.cross(meridian), pole)
    } else {
        Mat3A::IDENTITY
    };
    Ok(Affine3A::from_mat3(turned.transpose().into()) * placed.inverse())
}

fn turns(kind: MappingKind) -> bool {
    matches!(kind, MappingKind::Spherical | MappingKind::Cylindrical)
}

fn has_meaning(kind: MappingKind, key: &str) -> bool {
    match key {
        "mapping" => true,
        "uv_set" => kind == MappingKind::Uv,
        "mapping_space" | "mapping_transform" | "mapping_matrix" => kind != MappingKind::Uv,
        "pole" | "meridian" | "pole_u" => turns(kind),
        "seam_blend" => turns(kind) || kind == MappingKind::Uv,
        _ => kind == MappingKind::Triplanar,
    }
}
