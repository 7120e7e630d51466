//! Lights without extent: their records, and their power.

use super::Features;
use super::lights::{Entry, mean};
use super::textures::{References, picture_mean};
use crate::layout::{LIGHT_POINT, LIGHT_PROJECTION, LIGHT_PUNCTUAL, Light, NONE};
use crate::scene::{
    self, DirectionMapping, LightKind, PUNCTUAL_LIGHTS, Punctual, PunctualKind, Scene, Strength, Value,
    half_frustum,
};
use glam::{DVec2, Vec2, Vec3};
use std::f64::consts::PI;

/// Share of the mean of a texture in the power by which its light is chosen. Filtering brings light from texels to where
/// their centres are not.
const EVEN_SHARE: f64 = 0.02;

/// What the kernels need for the lights of a scene.
pub(super) fn note(scene: &Scene, features: &mut Features) {
    for light in scene.lights.iter().filter(|light| light.intensity.texture().is_some()) {
        features.textured_lights = true;
        features.equal_area_lights |=
            matches!(light.kind, LightKind::Point { mapping: DirectionMapping::EqualArea, .. });
    }
}

/// The row of the table that a kind of light is.
pub(super) fn row(kind: u32) -> Option<&'static PunctualKind> {
    PUNCTUAL_LIGHTS.get(kind.checked_sub(LIGHT_PUNCTUAL)? as usize).copied()
}

/// A light before the table is built.
pub(super) fn entry(scene: &Scene, textures: &References, light: &scene::Light) -> Entry {
    let frame = light.world_from_light;
    let (intensity, texture) = match light.intensity {
        Value::Constant(color) => (color, NONE),
        Value::Texture(handle) => (Vec3::ONE, textures.reference(handle)),
    };
    let base = Light {
        texture,
        edge_u: (-frame.z_axis).to_array(),
        edge_v: frame.y_axis.to_array(),
        ..Light::default()
    };
    let placed = match light.kind {
        LightKind::Point { position, mapping } => Light {
            kind: LIGHT_POINT,
            position: position.to_array(),
            extra: u32::from(mapping == DirectionMapping::EqualArea),
            ..base
        },
        LightKind::Punctual(Punctual { kind, position, numbers: [a, b, c, d] }) => Light {
            kind: LIGHT_PUNCTUAL + kind.index() as u32,
            position: position.to_array(),
            a,
            b,
            uv0: [c, d],
            ..base
        },
        LightKind::Projection { position, fov, fov_axis, aspect } => {
            let half = half_frustum(fov, fov_axis, aspect);
            Light { kind: LIGHT_PROJECTION, position: position.to_array(), a: half.x, b: half.y, ..base }
        }
    };
    let scale = scale(scene, textures, light);
    let plain = plain_mean(textures, &light.intensity);
    let bright = solid_angle(&light.kind).map(|angle| {
        let mean = (1.0 - EVEN_SHARE) * mean_sent(scene, textures, light) + EVEN_SHARE * plain;
        angle * mean.max(0.0) * f64::from(scale)
    });
    Entry { light: Light { radiance: (scale * intensity).to_array(), ..placed }, power: bright }
}

/// The factor on the intensity of a light.
pub(super) fn scale(scene: &Scene, textures: &References, light: &scene::Light) -> f32 {
    match light.strength {
        Strength::Scale(scale) => scale,
        Strength::Power(watts) => {
            let one = solid_angle(&light.kind).unwrap_or(1.0) * mean_sent(scene, textures, light);
            if one > 0.0 { (f64::from(watts) / one).min(f64::from(f32::MAX)) as f32 } else { 0.0 }
        }
    }
}

/// The solid angle that a light fills in steradians, what is not full counted by what it lets through; none of light from infinity.
fn solid_angle(kind: &LightKind) -> Option<f64> {
    match *kind {
        LightKind::Point { .. } => Some(4.0 * PI),
        LightKind::Punctual(light) => light.solid_angle(),
        LightKind::Projection { fov, fov_axis, aspect, .. } => {
            let Vec2 { x, y } = half_frustum(fov, fov_axis, aspect);
            let (x, y) = (f64::from(x), f64::from(y));
            Some(4.0 * (x * y).atan2((1.0 + x * x + y * y).sqrt()))
        }
    }
}

fn plain_mean(textures: &References, intensity: &Value<Vec3>) -> f64 {
    match *intensity {
        Value::Constant(color) => mean(color),
        Value::Texture(handle) => textures.mean(handle),
    }
}

/// Mean of the intensity over the solid angle that a light fills: of a picture by its texels, of other textures without regard
/// to where they are seen.
fn mean_sent(scene: &Scene, textures: &References, light: &scene::Light) -> f64 {
    let Some(handle) = light.intensity.texture() else { return plain_mean(textures, &light.intensity) };
    let latitude = |uv: DVec2| (uv.y - 0.5) * PI;
    let weighed = match light.kind {
        LightKind::Point { mapping: DirectionMapping::EqualArea, .. } => picture_mean(scene, handle, |_| 1.0),
        LightKind::Point { .. } => picture_mean(scene, handle, |uv| latitude(uv).cos()),
        LightKind::Punctual(light) => picture_mean(scene, handle, |uv| {
            let toward = latitude(uv).cos() * (2.0 * PI * (uv.x - 0.5)).cos();
            light.shines(toward).map_or(1.0, |shines| latitude(uv).cos() * shines)
        }),
        LightKind::Projection { fov, fov_axis, aspect, .. } => {
            let half = half_frustum(fov, fov_axis, aspect).as_dvec2();
            picture_mean(scene, handle, |uv| (1.0 + ((2.0 * uv - 1.0) * half).length_squared()).powf(-1.5))
        }
    };
    weighed.unwrap_or_else(|| textures.mean(handle))
}
