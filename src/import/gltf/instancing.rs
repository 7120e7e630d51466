//! EXT_mesh_gpu_instancing: a mesh of a node, many times.

use super::document::Document;
use super::json::Json;
use super::node::{Place, unit};
use crate::Result;
use glam::{DAffine3, Quat, Vec3};

/// The map to the world of each instance of a node; that of the node itself where it has no instances.
pub(super) fn maps(document: &Document<'_>, node: &Json<'_>, world: &DAffine3) -> Result<Vec<DAffine3>> {
    let Some(extension) = node.extension("EXT_mesh_gpu_instancing")? else { return Ok(vec![*world]) };
    let attributes = extension.need("attributes")?;
    let get = |key| attributes.get(key);
    let (translation, rotation, scale) = (get("TRANSLATION")?, get("ROTATION")?, get("SCALE")?);
    let mut count = None;
    for reference in [&translation, &rotation, &scale].into_iter().flatten() {
        let found = document.accessor(reference)?.1.count;
        if *count.get_or_insert(found) != found {
            return Err(reference.error("the attributes of the instances are not of one number of instances"));
        }
    }
    let Some(count) = count else { return Ok(vec![*world]) };
    document.budget.take(count, size_of::<DAffine3>())?;
    let translations = translation.map(|reference| document.floats::<3>(&reference)).transpose()?;
    let rotations = rotation.map(|reference| document.floats::<4>(&reference)).transpose()?;
    let scales = scale.map(|reference| document.floats::<3>(&reference)).transpose()?;
    let place = |i: usize| Place {
        translation: translations.as_ref().map_or(Vec3::ZERO, |all| all[i].into()),
        rotation: rotations.as_ref().map_or(Quat::IDENTITY, |all| unit(Quat::from_array(all[i]))),
        scale: scales.as_ref().map_or(Vec3::ONE, |all| all[i].into()),
    };
    Ok((0..count).map(|i| *world * place(i).map()).collect())
}
