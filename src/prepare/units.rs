//! Units of the fixed-point sums of the film.

use super::{Bounds, Prepared, punctual, textures};
use crate::layout::{LIGHT_POINT, LIGHT_PROJECTION, Light};
use crate::scene::{Scene, Surface, Value};
use glam::Vec3;

/// Steps of the unit, as a power of two, up to the brightest thing; a sample may be 2⁸ times as bright.
const STEPS_TO_BRIGHTEST: i32 = 30;
/// Steps that what is lit has at least. It decides for lamps that are small where anything is lit by them: then the clamp is
/// at 2²² times what is lit, and only a lamp that fills less than 10⁻⁶ of the half space is brighter.
const STEPS_TO_LIT: i32 = 16;
/// Steps of the depth to the far end of the scene.
const STEPS_TO_FAR: i32 = 24;

/// Chooses the units. `receivers` holds all that is lit, `lamps` is what surfaces that shine bring there.
pub(super) fn choose(
    scene: &Scene,
    textures: &textures::References,
    receivers: &Bounds,
    lamps: f64,
    out: &mut Prepared,
) {
    let of = |value: &Value<Vec3>| match value {
        Value::Constant(color) => color.max_element(),
        Value::Texture(texture) => textures.max(*texture),
    };
    let environment = scene.environment.as_ref().map_or(0.0, |e| of(&e.radiance) * e.scale);
    let unlit = scene.materials.iter().map(|(_, _, material)| match &material.surface {
        Surface::Unlit { color } => of(color),
        _ => 0.0,
    });
    let emitted = scene.materials.iter().filter_map(|(_, _, material)| material.emission.as_ref());
    let size = out.bounds.diagonal().max(f32::MIN_POSITIVE);
    // They are the last of the table, unless nothing in it shines
    let first = out.lights.len().saturating_sub(scene.lights.len());
    let punctual = scene.lights.iter().zip(&out.lights[first..]).map(|(light, record)| {
        let most = of(&light.intensity) * punctual::scale(scene, textures, light);
        punctual_radiance(most, record, scene.camera.position, size, receivers)
    });
    let lit = punctual.chain(unlit).fold(environment.max(1.0), f32::max);
    let brightest = emitted.map(|emission| of(&emission.radiance)).fold(lit, f32::max);
    let lit = lit.max(lamps.min(f64::from(f32::MAX)) as f32);
    let exponent = |radiance: f32| radiance.log2().ceil().min(100.0) as i32;
    let unit = (exponent(brightest) - STEPS_TO_BRIGHTEST).min(exponent(lit) - STEPS_TO_LIT);
    out.radiance_exponent = unit.clamp(-60, 60);
    let size = out.bounds.diagonal();
    let middle = 0.5 * (out.bounds.min + out.bounds.max);
    let away = if size > 0.0 {
        super::lights::camera_positions(scene).map(|position| position.distance(middle)).fold(0.0, f32::max)
    } else {
        0.0
    };
    let far = (away + size).clamp(1e-6, f32::MAX);
    out.depth_exponent = (far.log2().ceil() as i32 - STEPS_TO_FAR).clamp(-60, 60);
}

/// What a light without extent of this intensity at most brings to a sample near it. Near is a quarter of the distance at which the camera is
/// likely to look: as far from the light as the camera is, but between 1/64 and 1/8 of the scene; farther where nothing is
/// so near. A sample stands for all lights, so a light that is rarely chosen counts for more.
fn punctual_radiance(intensity: f32, light: &Light, camera: Vec3, size: f32, receivers: &Bounds) -> f32 {
    if light.chance == 0.0 {
        return 0.0;
    }
    let all = intensity / light.chance.max(1e-9);
    let has_place = match light.kind {
        LIGHT_POINT | LIGHT_PROJECTION => true,
        kind => match punctual::row(kind) {
            Some(row) => row.shines.is_some(),
            None => return 0.0,
        },
    };
    if !has_place {
        return all;
    }
    let position = light.position.into();
    let distance = 0.25 * camera.distance(position).clamp(size / 64.0, size / 8.0);
    let distance = distance.max(receivers.distance(position));
    all / (distance * distance)
}
