//! `[camera]`: where it stands, and which projection it has. Lenses are read in [`super::lens`].

use super::document::Node;
use super::keys::CAMERA;
use super::reader::Reader;
use super::text::Limits;
use super::view::View;
use crate::Result;
use crate::scene::{self, Camera, FisheyeMapping, FovAxis, Perspective, Projection};
use glam::DVec3;

/// Sine of the angle below which `up` counts as parallel to the view.
const MIN_SINE: f64 = 1e-6;
const MAPPINGS: [(&str, FisheyeMapping); 2] =
    [("equidistant", FisheyeMapping::Equidistant), ("equisolid", FisheyeMapping::Equisolid)];

pub(super) const FOV_AXES: [(&str, FovAxis); 3] =
    [("vertical", FovAxis::Vertical), ("horizontal", FovAxis::Horizontal), ("smaller", FovAxis::Smaller)];

/// Where the camera stands and looks, in 64 bits.
pub(super) struct Stand {
    pub position: DVec3,
    /// Of unit length.
    pub forward: DVec3,
}

impl Reader<'_> {
    pub fn camera(&mut self, node: &Node) -> Result<()> {
        let (view, kind) = View::of_kind_or(self.sources, node, "[camera]".into(), &CAMERA, "perspective")?;
        let default = Camera::default();
        let mut camera = Camera {
            position: view.vec3_or("position", default.position)?,
            target: view.vec3_or("target", default.target)?,
            up: view.get("up").map_or(Ok(default.up), |item| item.direction())?,
            mirrored: view.bool_or("mirrored", default.mirrored)?,
            projection: default.projection,
            at_close: None,
        };
        let open = scene::Stand { position: camera.position, target: camera.target, up: camera.up };
        let forward = forward(&view, &open, ["up", "target", "position"])?;
        camera.at_close = stand_at_close(&view, &open)?;
        let stand = Stand { position: camera.position.as_dvec3(), forward };
        camera.projection = self.projection(&view, kind, &stand)?;
        self.shot(&view, &camera)?;
        self.scene.camera = camera;
        Ok(())
    }

    fn projection(&mut self, view: &View<'_>, kind: &str, stand: &Stand) -> Result<Projection> {
        let axis = view.choice_or("fov_axis", FovAxis::Vertical, &FOV_AXES)?;
        Ok(match kind {
            "orthographic" => {
                Projection::Orthographic { size: view.f32_or("view_size", 2.0, Limits::Above(0.0))?, axis }
            }
            "equirectangular" => Projection::Equirectangular,
            "fisheye" => Projection::Fisheye {
                mapping: view.choice_or("mapping", FisheyeMapping::Equidistant, &MAPPINGS)?,
                fov: view.f32_or("fov", 180.0, Limits::AboveUpTo(0.0, 360.0))?,
                axis,
            },
            "lens" => Projection::Lens(Box::new(self.lens_camera(view, stand)?)),
            _ => Projection::Perspective(Perspective {
                fov: view.f32_or("fov", 40.0, Limits::Between(0.0, 180.0))?,
                fov_axis: axis,
                lens: self.thin_lens(view, stand)?,
            }),
        })
    }
}

/// Where the camera looks, as a unit vector. The place of a mistake is the first of `keys`, those of up, target and position,
/// that was written.
fn forward(view: &View<'_>, stand: &scene::Stand, keys: [&str; 3]) -> Result<DVec3> {
    let fail = |keys: &[&str], message: String| match keys.iter().find_map(|key| view.get(key)) {
        Some(item) => Err(item.error(message)),
        None => Err(view.error(message)),
    };
    // Differences are taken as the camera takes them, in 32 bits.
    let Some(forward) = (stand.target - stand.position).as_dvec3().try_normalize() else {
        return fail(&keys[1..], "the camera looks at its own position".into());
    };
    if stand.up.as_dvec3().cross(forward).length() < MIN_SINE {
        return fail(&keys, format!("`{}` is parallel to the view", keys[0]));
    }
    Ok(forward)
}

/// Where the camera is when the shutter closes, if it moves: what is not said stays.
fn stand_at_close(view: &View<'_>, open: &scene::Stand) -> Result<Option<scene::Stand>> {
    let keys = ["up_close", "target_close", "position_close"];
    if keys.iter().all(|key| view.get(key).is_none()) {
        return Ok(None);
    }
    let stand = scene::Stand {
        position: view.vec3_or("position_close", open.position)?,
        target: view.vec3_or("target_close", open.target)?,
        up: view.get("up_close").map_or(Ok(open.up), |item| item.direction())?,
    };
    forward(view, &stand, keys)?;
    Ok(Some(stand))
}
