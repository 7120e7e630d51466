//! Where a line meets a shape in the shape's object space, in 64 bits.

use super::shapes;
use crate::scene::{Extent, Patch, Quadric, ShapeKind};
use glam::DVec3;

/// A place on the line o + t d, and whether the line goes along the normal there: it leaves what the front encloses.
pub(super) struct Meeting {
    pub t: f64,
    pub leaves: bool,
}

/// Meetings of a line with a shape, in no order.
pub(super) fn meet(kind: &ShapeKind, o: DVec3, d: DVec3) -> Vec<Meeting> {
    match kind {
        ShapeKind::Sphere { .. } => sphere(o, d).into(),
        ShapeKind::Disk { .. } => plane(o, d, |p| p.truncate().length_squared() <= 1.0),
        ShapeKind::Quad { .. } => {
            plane(o, d, |p| p.truncate().min_element() >= 0.0 && p.truncate().max_element() <= 1.0)
        }
        ShapeKind::Quadric(quadric) => part(quadric, o, d),
        ShapeKind::Patch(patch) => bilinear(patch, o, d),
    }
    .into_iter()
    .filter(|meeting| meeting.t.is_finite())
    .collect()
}

/// The unit sphere; not finite where the line misses it.
fn sphere(o: DVec3, d: DVec3) -> [Meeting; 2] {
    let (a, b, c) = (d.dot(d), d.dot(o), o.dot(o) - 1.0);
    let root = (b * b - a * c).sqrt();
    [Meeting { t: (-b - root) / a, leaves: false }, Meeting { t: (-b + root) / a, leaves: true }]
}

fn plane(o: DVec3, d: DVec3, inside: impl Fn(DVec3) -> bool) -> Vec<Meeting> {
    let t = -o.z / d.z;
    if inside(o + t * d) { vec![Meeting { t, leaves: d.z > 0.0 }] } else { Vec::new() }
}

fn part(quadric: &Quadric, o: DVec3, d: DVec3) -> Vec<Meeting> {
    let part = shapes::part(quadric);
    let is_there = |p: DVec3| {
        let turn = p.y.atan2(p.x).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        p.z >= f64::from(part.z_min) && p.z <= f64::from(part.z_max) && turn <= f64::from(part.turn)
    };
    let flat = DVec3::new(1.0, 1.0, 0.0);
    match quadric.extent {
        Extent::Sphere { .. } => sphere(o, d).into_iter().filter(|m| is_there(o + m.t * d)).collect(),
        Extent::Cylinder { .. } => {
            sphere(o * flat, d * flat).into_iter().filter(|m| is_there(o + m.t * d)).collect()
        }
        Extent::Disk { .. } => plane(o, d, |p| {
            let radius = p.truncate().length();
            radius <= 1.0 && radius >= f64::from(part.inner_radius) && is_there(p)
        }),
    }
}

/// As `base/bilinear.glsl`.
fn bilinear(patch: &Patch, o: DVec3, d: DVec3) -> Vec<Meeting> {
    let [p00, p10, p01, p11] = patch.corners.map(|corner| corner.as_dvec3());
    let (along_u, along_v, twist) = (p10 - p00, p01 - p00, p11 - p10 - p01 + p00);
    let q = p00 - o;
    let (v_across, twist_across) = (along_v.cross(d), twist.cross(d));
    let (c, b, a) = (q.dot(v_across), along_u.dot(v_across) + q.dot(twist_across), along_u.dot(twist_across));
    let k = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
    let at = |u: f64| {
        let (from, line) = (q + u * along_u, along_v + u * twist);
        let across = line.cross(d);
        let v = -from.cross(d).dot(across) / across.length_squared();
        let normal = (along_u + v * twist).cross(line);
        let is_there = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        let t = normal.dot(from + v * line) / normal.dot(d);
        is_there.then(|| Meeting { t, leaves: normal.dot(d) > 0.0 })
    };
    [k / a, c / k].into_iter().filter_map(at).collect()
}

#[cfg(test)]
#[path = "meet_tests.rs"]
mod tests;
