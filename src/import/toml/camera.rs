//! `[camera]`.

use super::document::Node;
use super::keys::CAMERA;
use super::reader::Reader;
use super::text::{Limits, number};
use super::view::View;
use crate::Result;
use crate::scene::{Aperture, Camera, FovAxis, Lens};
use glam::DVec3;

const MAX_BLADES: u32 = 64;
/// Height of a full-frame sensor in metres.
const SENSOR_HEIGHT: f32 = 0.024;
/// Sine of the angle below which `up` counts as parallel to the view.
const MIN_SINE: f64 = 1e-6;

impl Reader<'_> {
    pub fn camera(&mut self, node: &Node) -> Result<()> {
        let view = View::new(self.sources, node, "[camera]".into(), CAMERA)?;
        let default = Camera::default();
        let axes = [
            ("vertical", FovAxis::Vertical),
            ("horizontal", FovAxis::Horizontal),
            ("smaller", FovAxis::Smaller),
        ];
        let mut camera = Camera {
            position: view.vec3_or("position", default.position)?,
            target: view.vec3_or("target", default.target)?,
            up: view.get("up").map_or(Ok(default.up), |item| item.direction())?,
            fov: view.f32_or("fov", default.fov, Limits::Between(0.0, 180.0))?,
            fov_axis: view.choice_or("fov_axis", default.fov_axis, &axes)?,
            mirrored: view.bool_or("mirrored", default.mirrored)?,
            lens: None,
        };
        // The place of a mistake is the key that was written, if any was.
        let fail = |keys: &[&str], message: &str| match keys.iter().find_map(|key| view.get(key)) {
            Some(item) => Err(item.error(message)),
            None => Err(view.error(message)),
        };
        // Differences are taken as the camera takes them, in 32 bits.
        let Some(forward) = (camera.target - camera.position).as_dvec3().try_normalize() else {
            return fail(&["target", "position"], "the camera looks at its own position");
        };
        if camera.up.as_dvec3().cross(forward).length() < MIN_SINE {
            return fail(&["up", "target", "position"], "`up` is parallel to the view");
        }
        camera.lens = lens(&view, camera.position.as_dvec3(), forward)?;
        self.scene.camera = camera;
        Ok(())
    }
}

fn lens(view: &View<'_>, position: DVec3, forward: DVec3) -> Result<Option<Lens>> {
    let Some(opening) = view.either("lens_radius", "f_number")? else {
        let orphans = ["sensor_height", "focus_distance", "focus_point", "blades", "blade_rotation"];
        return match orphans.iter().find_map(|key| view.get(key)) {
            Some(item) => Err(item
                .error(format!("{} needs a lens, and the camera is a pinhole", item.name()))
                .help("add `lens_radius` or `f_number`")),
            None => Ok(None),
        };
    };
    let aperture = match view.get("f_number") {
        Some(item) => Aperture::FNumber {
            number: item.f32(Limits::Above(0.0))?,
            sensor_height: view.f32_or("sensor_height", SENSOR_HEIGHT, Limits::Above(0.0))?,
        },
        None => {
            if let Some(item) = view.get("sensor_height") {
                return Err(item
                    .error("`sensor_height` has no meaning with `lens_radius`")
                    .help("remove it"));
            }
            Aperture::Radius(opening.f32(Limits::AtLeast(0.0))?)
        }
    };
    let Some(focus) = view.either("focus_distance", "focus_point")? else {
        return Err(opening
            .error(format!("{} needs a plane of focus", opening.name()))
            .help("add `focus_distance` or `focus_point`"));
    };
    let focus_distance = if view.get("focus_point").is_some() {
        let along = (focus.vec3(Limits::Finite)?.as_dvec3() - position).dot(forward) as f32;
        if !(along > 0.0 && along.is_finite()) {
            let distance = number(f64::from(along));
            return Err(focus.error(format!(
                "{} is {distance} in front of the camera along the view, must be above 0",
                focus.name()
            )));
        }
        along
    } else {
        focus.f32(Limits::Above(0.0))?
    };
    let blades = view.u32_or("blades", 0, 0, MAX_BLADES)?;
    if let Some(item) = view.get("blades").filter(|_| blades == 1 || blades == 2) {
        return Err(item.refuse(blades, format!("0 for a circle, or from 3 to {MAX_BLADES}")));
    }
    let blade_rotation = view.f32_or("blade_rotation", 0.0, Limits::Finite)?;
    // A lens without width is a pinhole.
    let open = aperture != Aperture::Radius(0.0);
    Ok(open.then_some(Lens { aperture, focus_distance, blades, blade_rotation }))
}
