//! `transform`: steps that place an object.

use super::keys::STEP;
use super::text::Limits;
use super::view::{Item, View};
use crate::Result;
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Mat3A, Vec3A};

/// Volume of three columns against a box with the same edges: below this the map is flat within 32-bit rounding.
const MIN_VOLUME: f64 = 1e-7;

/// The map of a list of steps; the first step is applied first.
pub(super) fn transform(item: Item<'_>) -> Result<Affine3A> {
    let mut whole = DAffine3::IDENTITY;
    for step in item.list("a list of steps, such as [{ translate = [0, 1, 0] }]")? {
        whole = self::step(step)? * whole;
    }
    let columns = [whole.x_axis, whole.y_axis, whole.z_axis, whole.translation];
    let [x, y, z, translation] = columns.map(|column| Vec3A::from(column.as_vec3()));
    let narrow = Affine3A { matrix3: Mat3A::from_cols(x, y, z), translation };
    let edges = whole.x_axis.length() * whole.y_axis.length() * whole.z_axis.length();
    let volume = whole.matrix3.determinant().abs();
    let inverse = narrow.as_daffine3().inverse();
    let holds =
        [inverse.x_axis, inverse.y_axis, inverse.z_axis].iter().all(|column| column.as_vec3().is_finite());
    // Negated, so that NaN counts as singular.
    let invertible = volume > MIN_VOLUME * edges && narrow.is_finite() && holds;
    if !invertible {
        return Err(item.error(format!("{} cannot be inverted", item.name())).help("give every axis a size"));
    }
    Ok(narrow)
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
