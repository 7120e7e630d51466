//! Parts of quadrics, and patches, to records of lights.

use super::shapes;
use crate::layout::{LIGHT_CYLINDER, LIGHT_DISK_PART, LIGHT_PATCH, LIGHT_SPHERE_PART, Light};
use crate::scene::{Extent, Patch, Quadric};
use glam::{Affine3A, Vec3};
use std::f64::consts::PI;

/// The third axis of a quadric, or the twist of a patch.
pub(super) fn set_third(light: &mut Light, z: Vec3) {
    (light.uv0, light.uv1) = ([z.x, z.y], [z.z, 0.0]);
}

/// Makes a light with the axes of a quadric a part of it. Gives its area.
pub(super) fn set_part(light: &mut Light, quadric: &Quadric, map: &Affine3A) -> f64 {
    let part = shapes::part(quadric);
    set_third(light, Vec3::from(map.matrix3.z_axis));
    light.uv1[1] = part.turn;
    let (low, high) = (part.z_min.max(-1.0), part.z_max.min(1.0));
    let inner = f64::from(part.inner_radius);
    let turn = 2.0 * PI * f64::from(part.turn);
    let (kind, unit_area) = match quadric.extent {
        Extent::Sphere { .. } => {
            light.uv2 = [low, high];
            (LIGHT_SPHERE_PART, turn * f64::from(high - low))
        }
        Extent::Disk { .. } => {
            light.uv2 = [part.inner_radius, 0.0];
            (LIGHT_DISK_PART, 0.5 * turn * (1.0 - inner * inner))
        }
        Extent::Cylinder { .. } => (LIGHT_CYLINDER, turn),
    };
    light.kind = kind;
    // By how much the map enlarges the surface where its normal is n; the same everywhere, unless it is stretched
    let m = map.matrix3.as_dmat3();
    let (vw, wu, uv) = (m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    let growth = |s: f64, t: f64| {
        let (sin, cos) = (turn * t).sin_cos();
        let (across, z) = match quadric.extent {
            Extent::Sphere { .. } => {
                let z = f64::from(low) + s * f64::from(high - low);
                ((1.0 - z * z).max(0.0).sqrt(), z)
            }
            Extent::Disk { .. } => (0.0, 1.0),
            Extent::Cylinder { .. } => (1.0, 0.0),
        };
        (vw * (across * cos) + wu * (across * sin) + uv * z).length()
    };
    unit_area * mean_over_square(growth)
}

/// Makes a light a patch, or a quad when that is what it is. Gives its area.
pub(super) fn set_patch(light: &mut Light, patch: &Patch, map: &Affine3A) -> f64 {
    let [p00, p10, p01, p11] = patch.corners.map(|corner| map.transform_point3(corner));
    let (u, v) = (p10 - p00, p01 - p00);
    let twist = (p11 - p10) - v;
    light.position = p00.to_array();
    let is_quad = twist.length() <= 1e-6 * u.length().max(v.length()) && patch.uvs == Patch::UVS;
    (light.edge_u, light.edge_v) = (u.to_array(), v.to_array());
    if !is_quad {
        light.kind = LIGHT_PATCH;
        set_third(light, twist);
    }
    let (u, v, twist) = (u.as_dvec3(), v.as_dvec3(), twist.as_dvec3());
    mean_over_square(|s, t| (u + twist * t).cross(v + twist * s).length())
}

/// Mean of a function over the unit square, by midpoints: to a part in 10⁴ for what is as smooth as areas are.
fn mean_over_square(f: impl Fn(f64, f64) -> f64) -> f64 {
    const SIDE: u32 = 32;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let values = (0..SIDE * SIDE).map(|i| f(at(i / SIDE), at(i % SIDE)));
    values.sum::<f64>() / f64::from(SIDE * SIDE)
}
