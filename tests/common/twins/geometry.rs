//! Twins of `geometry/triangle.glsl` and `geometry/quadric.glsl`, in f64.

use super::math::{cross, dot, length, sub};

/// A hit, and how far it is from being none.
pub struct Meeting {
    pub t: f64,
    /// Barycentric coordinates of the second and third vertex.
    pub bary: [f64; 2],
    /// Least of the three barycentric coordinates: below 0 outside.
    pub inside: f64,
    /// Sine of the angle between ray and plane.
    pub sine: f64,
}

/// Ray against triangle (Möller and Trumbore 1997); `None` when they are parallel or there is no area.
pub fn triangle_hit([a, b, c]: [[f64; 3]; 3], origin: [f64; 3], direction: [f64; 3]) -> Option<Meeting> {
    let (e1, e2) = (sub(b, a), sub(c, a));
    let p = cross(direction, e2);
    let determinant = dot(e1, p);
    if determinant == 0.0 {
        return None;
    }
    let s = sub(origin, a);
    let u = dot(s, p) / determinant;
    let q = cross(s, e1);
    let v = dot(direction, q) / determinant;
    let t = dot(e2, q) / determinant;
    let area = length(cross(e1, e2));
    let sine = determinant.abs() / (area * length(direction));
    Some(Meeting { t, bary: [u, v], inside: u.min(v).min(1.0 - u - v), sine })
}

/// Both roots of a ray against the unit sphere, the smaller first, and the distance of the ray's line from the centre.
pub fn sphere_hit(origin: [f64; 3], direction: [f64; 3]) -> (Option<[f64; 2]>, f64) {
    let a = dot(direction, direction);
    let b = dot(origin, direction);
    let c = dot(origin, origin) - 1.0;
    let miss = length(cross(origin, direction)) / a.sqrt();
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return (None, miss);
    }
    let root = discriminant.sqrt();
    (Some([(-b - root) / a, (-b + root) / a]), miss)
}
