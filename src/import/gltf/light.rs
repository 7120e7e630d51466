//! KHR_lights_punctual. Candela and lux are taken as W/sr and W/m², as emission in cd/m² is taken as radiance: a picture is as bright
//! as in viewers that have no other units.

use super::document::{Document, index_into};
use super::json::Json;
use crate::Result;
use crate::scene::{Light, LightKind, Value};
use glam::{DAffine3, Vec3};
use std::f32::consts::FRAC_PI_4;

const EXTENSION: &str = "KHR_lights_punctual";

/// All lights of the document.
pub(super) fn all<'a>(document: &Document<'a>) -> Result<Vec<Json<'a>>> {
    document.root.extension(EXTENSION)?.map_or(Ok(Vec::new()), |extension| extension.list("lights"))
}

/// The light that a node holds.
pub(super) fn of_node(lights: &[Json<'_>], node: &Json<'_>, world: &DAffine3) -> Result<Option<Light>> {
    let Some(extension) = node.extension(EXTENSION)? else { return Ok(None) };
    let index = index_into(&extension.need("light")?, "extensions/KHR_lights_punctual/lights", lights.len())?;
    if !world.translation.as_vec3().is_finite() {
        return Err(node.error("the node of the light is too far away"));
    }
    read(&lights[index], world).map(Some)
}

/// A light that shines along −z of its node.
fn read(json: &Json<'_>, world: &DAffine3) -> Result<Light> {
    let color = Vec3::from(json.numbers_or("color", [1.0; 3])?).max(Vec3::ZERO);
    let power = color * json.number_or("intensity", 1.0)?.max(0.0);
    if !power.is_finite() {
        return Err(json.error("the light is too bright"));
    }
    let direction = (-world.z_axis).normalize_or(glam::DVec3::NEG_Z).as_vec3();
    let position = world.translation.as_vec3();
    let kind = json.need("type")?;
    Ok(match kind.string()? {
        "directional" => Light::distant(direction, power),
        "point" => Light::point(position, power),
        "spot" => {
            let spot = json.need("spot")?;
            let outer = spot.number_or("outerConeAngle", FRAC_PI_4)?;
            let inner = spot.number_or("innerConeAngle", 0.0)?;
            if !(0.0 <= inner && inner < outer && outer <= std::f32::consts::FRAC_PI_2 + 1e-5) {
                return Err(spot.error(format!(
                    "the cones have angles of {inner} and {outer}, must be 0 ≤ inner < outer ≤ π/2"
                )));
            }
            let (cone_angle, falloff_angle) = (outer.to_degrees(), (outer - inner).to_degrees());
            let falloff_angle = falloff_angle.min(cone_angle);
            let kind = LightKind::spot(position, cone_angle, falloff_angle);
            Light::new(kind, Value::Constant(power)).along(direction)
        }
        _ => return Err(kind.error("a light is \"directional\", \"point\" or \"spot\"")),
    })
}
