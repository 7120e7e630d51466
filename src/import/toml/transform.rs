//! `transform`: steps that place an object.

use super::keys::STEP;
use super::text::Limits;
use super::view::{Item, View};
use crate::Result;
use crate::import::affine::narrow;
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Mat3A};

/// The map of a list of steps; the first step is applied first.
pub(super) fn transform(item: Item<'_>) -> Result<Affine3A> {
    // The first is taken as it is: a product with 1 has no -0
    let mut whole: Option<DAffine3> = None;
    for step in item.list("a list of steps, such as [{ translate = [0, 1, 0] }]")? {
        let step = self::step(step)?;
        whole = Some(whole.map_or(step, |whole| step * whole));
    }
    narrow(&whole.unwrap_or(DAffine3::IDENTITY)).ok_or_else(|| {
        item.error(format!("{} cannot be inverted", item.name())).help("give every axis a size")
    })
}

fn step(item: Item<'_>) -> Result<DAffine3> {
    let view = View::new(item.sources, item.node, format!("step {}", item.name()), STEP)?;
    let kinds = ["translate", "rotate", "scale", "matrix"];
    let given: Vec<_> =
        kinds.into_iter().filter_map(|kind| view.get(kind).map(|item| (kind, item))).collect();
    let &[(kind, value)] = given.as_slice() else {
        return Err(item
            .error(format!("{} must have exactly one of `translate`, `rotate`, `scale`, `matrix`", view.what))
            .help("write one step after the other: [{ scale = 2 }, { translate = [0, 1, 0] }]"));
    };
    if let Some(angle) = view.get("angle").filter(|_| kind != "rotate") {
        return Err(angle.error(format!("`angle` has no meaning for `{kind}`")));
    }
    Ok(match kind {
        "translate" => DAffine3::from_translation(value.vec3(Limits::Finite)?.as_dvec3()),
        "rotate" => {
            let axis = value.direction()?.as_dvec3().normalize();
            let angle = f64::from(view.need("angle")?.f32(Limits::Finite)?).to_radians();
            DAffine3::from_quat(DQuat::from_axis_angle(axis, angle))
        }
        "scale" if value.is_number() => {
            DAffine3::from_scale(DVec3::splat(value.f32(Limits::NotZero)?.into()))
        }
        "scale" => DAffine3::from_scale(value.vec3(Limits::NotZero)?.as_dvec3()),
        _ => matrix(value)?,
    })
}

/// A map that need not have an inverse, as the rows of its matrix.
pub(super) fn matrix_map(item: Item<'_>) -> Result<Affine3A> {
    let map = matrix(item)?;
    let [x, y, z, translation] =
        [map.x_axis, map.y_axis, map.z_axis, map.translation].map(|column| column.as_vec3().into());
    Ok(Affine3A { matrix3: Mat3A::from_cols(x, y, z), translation })
}

/// Rows of a 4×4 matrix, or of its first three rows.
fn matrix(item: Item<'_>) -> Result<DAffine3> {
    let expected = "a list of 12 or 16 numbers, row by row";
    let items = item.list(expected)?;
    let mut m = [0.0_f32; 16];
    if items.len() != 12 && items.len() != 16 {
        return Err(item.mismatch(expected));
    }
    let has_last_row = items.len() == 16;
    for (value, item) in m.iter_mut().zip(items) {
        *value = item.f32(Limits::Finite)?;
    }
    if has_last_row && m[12..] != [0.0, 0.0, 0.0, 1.0] {
        let row = format!("[{}, {}, {}, {}]", m[12], m[13], m[14], m[15]);
        return Err(item.error(format!("the last row of {} is {row}, must be [0, 0, 0, 1]", item.name())));
    }
    let column = |i: usize| DVec3::new(m[i].into(), m[i + 4].into(), m[i + 8].into());
    Ok(DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) })
}
