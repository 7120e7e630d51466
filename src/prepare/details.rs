//! What materials do to surfaces, to records.

use super::Prepared;
use super::textures::References;
use crate::layout::{Detail, NONE};
use crate::scene::{self, Handle, Material, Mesh, Scene, Value};
use glam::Vec3;

/// Fills `details`, and the features that they switch on.
pub(super) fn prepare(scene: &Scene, textures: &References, out: &mut Prepared) {
    for (_, _, material) in scene.materials.iter() {
        let opacity = &material.detail.opacity;
        out.features.opacity |= !opacity.is_whole();
        out.features.filter |= !opacity.is_whole() && opacity.filter != Value::Constant(Vec3::ONE);
        out.details.push(record(&material.detail, textures));
    }
}

fn record(detail: &scene::Detail, textures: &References) -> Detail {
    let opacity = &detail.opacity;
    let (value, opacity_texture) = match opacity.value {
        Value::Constant(value) => (value, NONE),
        Value::Texture(handle) => (1.0, textures.reference(handle)),
    };
    let (filter, filter_texture) = match opacity.filter {
        Value::Constant(color) => (color, NONE),
        Value::Texture(handle) => (Vec3::ONE, textures.reference(handle)),
    };
    Detail {
        opacity: value,
        opacity_texture,
        cutoff: opacity.cutoff.unwrap_or(-1.0),
        filter_texture,
        filter_color: filter.to_array(),
        spare: 0,
    }
}

/// Which triangles of a mesh rays may go through, when it is placed with some materials; empty when none.
pub(super) fn lets_through(
    scene: &Scene,
    mesh: &Mesh,
    placed_with: impl IntoIterator<Item = Handle<Material>>,
) -> Vec<bool> {
    let open = |material: Handle<Material>| !scene.materials[material].detail.opacity.is_whole();
    let rest = placed_with.into_iter().map(open).fold(false, |any, open| any | open);
    let parts = mesh.parts.iter().filter_map(|part| part.material);
    if !rest && !parts.into_iter().any(open) {
        return Vec::new();
    }
    let own = super::triangles::part_materials(mesh);
    let of = |i: usize| own.get(i).copied().flatten().map_or(rest, open);
    (0..mesh.triangles.len()).map(of).collect()
}
