//! Directions of unit length.

use glam::Vec3;

/// Whether a vector has unit length within the rounding of its coordinates. Readers leave such a one as it is, so that what is written
/// is read as it was.
pub fn is_unit(vector: Vec3) -> bool {
    (vector.as_dvec3().length_squared() - 1.0).abs() <= f64::from(f32::EPSILON)
}

/// A vector with unit length, or none when it gives no direction.
pub fn unit(vector: Vec3) -> Option<Vec3> {
    if is_unit(vector) {
        return Some(vector);
    }
    vector.as_dvec3().try_normalize().map(|unit| unit.as_vec3())
}
