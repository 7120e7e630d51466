//! `[[light]]` and `[environment]`. Lamps that are surfaces are shapes whose material shines.

use super::Writer;
use super::camera::axis;
use super::keys::{Keys, color, number, vector};
use crate::scene::{
    DirectionMapping, Environment, Light, LightKind, Strength, Value, facing, facing_upright, is_unit,
};
use glam::{Affine3A, Mat3, Vec3};

impl Writer<'_> {
    pub(super) fn light(&self, light: &Light) -> Keys {
        let frame = &light.world_from_light;
        let mut keys;
        match light.kind {
            LightKind::Point { position, mapping } => {
                keys = self.shining("point", position, light);
                map(&mut keys, mapping);
                keys.transform("transform", &Affine3A::from_mat3(*frame));
            }
            LightKind::Projection { position, fov, fov_axis, aspect } => {
                keys = self.shining("projection", position, light);
                aim(&mut keys, frame);
                keys.number("fov", fov, 40.0);
                axis(&mut keys, fov_axis);
                keys.set("aspect", number(aspect));
            }
            LightKind::Punctual(of) => {
                if of.kind.shines.is_some() {
                    keys = self.shining(of.kind.name, of.position, light);
                } else {
                    keys = Keys::of_kind(of.kind.name);
                    keys.set("irradiance", self.color(&light.intensity));
                    strength(&mut keys, light.strength);
                }
                aim(&mut keys, frame);
                for (input, number) in of.kind.numbers.iter().zip(of.numbers) {
                    keys.number(input.key, number, input.default);
                }
            }
        }
        keys
    }

    fn shining(&self, kind: &str, position: Vec3, light: &Light) -> Keys {
        let mut keys = Keys::of_kind(kind);
        keys.set("position", vector(position));
        keys.set("intensity", self.color(&light.intensity));
        strength(&mut keys, light.strength);
        keys
    }

    pub(super) fn environment(&self, environment: &Environment) -> Keys {
        let mut keys = Keys::new();
        match environment.radiance {
            Value::Constant(radiance) => keys.set("color", color(radiance)),
            Value::Texture(texture) => keys.set("texture", self.textures.refer(texture)),
        }
        map(&mut keys, environment.mapping);
        keys.number("scale", environment.scale, 1.0);
        keys.transform("transform", &Affine3A::from_mat3(environment.world_from_environment));
        keys
    }
}

fn strength(keys: &mut Keys, strength: Strength) {
    match strength {
        Strength::Scale(scale) => keys.number("scale", scale, 1.0),
        Strength::Power(power) => keys.set("power", number(power)),
    }
}

fn map(keys: &mut Keys, mapping: DirectionMapping) {
    if mapping == DirectionMapping::EqualArea {
        keys.set("mapping", "equal_area");
    }
}

/// Where a light shines: by direction and up where these give the same frame, else by the frame itself.
fn aim(keys: &mut Keys, frame: &Mat3) {
    let (direction, up) = (-frame.z_axis, frame.y_axis);
    let is = |found: Option<Mat3>| is_unit(direction) && found == Some(*frame);
    if is(Some(facing_upright(direction))) {
        keys.set("direction", vector(direction));
    } else if is(facing(direction, up)) {
        keys.set("direction", vector(direction));
        keys.set("up", vector(up));
    } else {
        keys.transform("transform", &Affine3A::from_mat3(*frame));
    }
}
