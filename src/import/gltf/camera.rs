//! Cameras.

use super::json::Json;
use crate::Result;
use crate::scene::{Camera, FovAxis, Perspective, Projection};
use glam::DAffine3;

/// A camera of the scene, and its width divided by its height where the file says it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelCamera {
    /// Name, or `camera` and its number.
    pub name: String,
    /// The camera.
    pub camera: Camera,
    /// Width divided by height.
    pub aspect: Option<f32>,
}

/// A camera that looks along −z of its node, with y up. What is nearer or farther than its planes is seen too.
pub(super) fn read(json: &Json<'_>, index: usize, world: &DAffine3) -> Result<ModelCamera> {
    let kind = json.need("type")?;
    let above_zero = |object: &Json<'_>, key: &str| {
        let value = object.need(key)?;
        let number = value.number()?;
        if number > 0.0 { Ok(number) } else { Err(value.error(format!("this is {number}, must be above 0"))) }
    };
    let (projection, aspect) = match kind.string()? {
        "perspective" => {
            let view = json.need("perspective")?;
            let fov = above_zero(&view, "yfov")?.to_degrees();
            if fov >= 180.0 {
                return Err(view.error("`yfov` must be less than π"));
            }
            let aspect = view.get("aspectRatio")?.map(|_| above_zero(&view, "aspectRatio")).transpose()?;
            (Projection::Perspective(Perspective { fov, fov_axis: FovAxis::Vertical, lens: None }), aspect)
        }
        "orthographic" => {
            let view = json.need("orthographic")?;
            let (xmag, ymag) = (above_zero(&view, "xmag")?, above_zero(&view, "ymag")?);
            if !(2.0 * ymag).is_finite() {
                return Err(view.error("`ymag` is too large"));
            }
            (Projection::Orthographic { size: 2.0 * ymag, axis: FovAxis::Vertical }, Some(xmag / ymag))
        }
        _ => return Err(kind.error("a camera is \"perspective\" or \"orthographic\"")),
    };
    let back = world.z_axis.try_normalize().filter(|back| back.is_finite());
    let up = world.y_axis.try_normalize().filter(|up| up.is_finite());
    let (Some(back), Some(up)) = (back, up) else {
        return Err(json.error("the node of the camera has no size"));
    };
    let position = world.translation;
    if !position.as_vec3().is_finite() {
        return Err(json.error("the node of the camera is too far away"));
    }
    // Far enough for the target to be another point in 32 bits
    let target = position - back * position.length().max(1.0);
    let camera = Camera {
        position: position.as_vec3(),
        target: target.as_vec3(),
        up: up.as_vec3(),
        mirrored: world.matrix3.determinant() < 0.0,
        projection,
        at_close: None,
    };
    Ok(ModelCamera { name: json.name("camera", index)?, camera, aspect })
}
