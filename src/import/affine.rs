//! Maps in 32 bits.

use glam::{Affine3A, DAffine3, Mat3A, Vec3A};

/// Volume of three columns against a box with the same edges: below this the map is flat within 32-bit rounding.
const MIN_VOLUME: f64 = 1e-7;

/// A map in 32 bits; none when it cannot be inverted there.
pub(super) fn narrow(whole: &DAffine3) -> Option<Affine3A> {
    let columns = [whole.x_axis, whole.y_axis, whole.z_axis, whole.translation];
    let [x, y, z, translation] = columns.map(|column| Vec3A::from(column.as_vec3()));
    let narrow = Affine3A { matrix3: Mat3A::from_cols(x, y, z), translation };
    let edges = whole.x_axis.length() * whole.y_axis.length() * whole.z_axis.length();
    let volume = whole.matrix3.determinant().abs();
    let inverse = narrow.as_daffine3().inverse();
    let holds =
        [inverse.x_axis, inverse.y_axis, inverse.z_axis].iter().all(|column| column.as_vec3().is_finite());
    // NaN is not above the limit
    (volume > MIN_VOLUME * edges && narrow.is_finite() && holds).then_some(narrow)
}
