//! A floor under lights, with what it must show in closed form or by quadrature.

use crate::common::render::*;
use dapple::scene::*;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// Where the camera of `floor_scene` stands; it looks at the origin.
pub(super) const EYE: Vec3 = Vec3::new(3.0, 2.0, 1.0);

/// A floor that a narrow camera looks at: all pixels see one point, the origin. One scattering event.
pub(super) fn floor_scene(surface: Surface, spp: u32) -> Scene {
    let mut s = scene(8, 8, spp);
    s.camera = look(EYE, Vec3::ZERO, 0.02);
    s.render.max_depth = 1;
    let material = s.material(surface, None);
    s.floor(material);
    s
}

pub(super) fn white() -> Surface {
    Surface::diffuse(grey(1.0))
}

/// Irradiance at the origin, facing +y, of a polygon of radiance 1 that is wholly above the horizon (Lambert 1760): half the
/// sum over edges of the angle that each fills times the cosine of its plane.
pub(super) fn polygon_irradiance(corners: &[DVec3]) -> f64 {
    let edge = |a: DVec3, b: DVec3| {
        let (a, b) = (a.normalize(), b.normalize());
        a.dot(b).clamp(-1.0, 1.0).acos() * a.cross(b).normalize_or_zero().y
    };
    let n = corners.len();
    0.5 * (0..n).map(|i| edge(corners[i], corners[(i + 1) % n])).sum::<f64>().abs()
}

pub(super) fn quad_corners(origin: Vec3, u: Vec3, v: Vec3) -> [DVec3; 4] {
    [origin, origin + u, origin + u + v, origin + v].map(|p| p.as_dvec3())
}

/// Radiance that leaves the origin of a floor towards the camera under a rectangle of radiance `light(u, v)`, by quadrature.
/// `bsdf(wo, wi)` is in a frame with y up.
pub(super) fn under_quad(
    origin: Vec3,
    u: Vec3,
    v: Vec3,
    light: impl Fn(f64, f64) -> f64,
    bsdf: impl Fn(DVec3, DVec3) -> f64,
) -> f64 {
    let (o, u, v) = (origin.as_dvec3(), u.as_dvec3(), v.as_dvec3());
    let (normal, wo) = (u.cross(v), EYE.as_dvec3().normalize());
    integrate_square(600, |a, b| {
        let p = o + u * a + v * b;
        let wi = p.normalize();
        light(a, b) * bsdf(wo, wi) * wi.y.max(0.0) * wi.dot(normal).abs() / p.length_squared()
    })
}

/// Modified Phong about +y.
pub(super) fn phong(kd: f64, ks: f64, n: f64) -> impl Fn(DVec3, DVec3) -> f64 {
    move |wo, wi| {
        let mirrored = DVec3::new(-wo.x, wo.y, -wo.z);
        let cos = mirrored.dot(wi);
        kd / PI + if cos > 0.0 { ks * (n + 2.0) / (2.0 * PI) * cos.powf(n) } else { 0.0 }
    }
}

/// Isotropic GGX about +y with height-correlated Smith masking, reflectance 1.
pub(super) fn ggx(alpha: f64) -> impl Fn(DVec3, DVec3) -> f64 {
    move |wo, wi| {
        let m = (wo + wi).normalize();
        let a2 = alpha * alpha;
        let lambda = |w: DVec3| 0.5 * ((1.0 + a2 * (1.0 / (w.y * w.y) - 1.0)).sqrt() - 1.0);
        let t = m.y * m.y * (a2 - 1.0) + 1.0;
        a2 / (PI * t * t) / (1.0 + lambda(wo) + lambda(wi)) / (4.0 * wo.y * wi.y)
    }
}

/// Part of the light from everywhere that a surface sends towards `wo`.
pub(super) fn albedo(wo: DVec3, bsdf: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    // Directions at equal steps of elevation and angle, fine enough for lobes of a few degrees
    2.0 * PI
        * integrate_square(1500, |a, b| {
            let (elevation, phi) = (0.5 * PI * a, 2.0 * PI * b);
            let (y, r) = (elevation.sin(), elevation.cos());
            bsdf(wo, DVec3::new(r * phi.cos(), y, r * phi.sin())) * y * r * 0.5 * PI
        })
}

pub(super) fn rough(alpha: f32) -> Surface {
    conductor(1.0, alpha, Fresnel::None)
}

pub(super) fn shiny(kd: f32, ks: f32, n: f32) -> Surface {
    Surface::phong(grey(kd), grey(ks), Value::Constant(n))
}

/// Surfaces with the value of their BSDF.
#[allow(clippy::type_complexity, reason = "a table of two columns")]
pub(super) fn surfaces() -> [(Surface, Box<dyn Fn(DVec3, DVec3) -> f64>); 4] {
    [
        (Surface::diffuse(grey(0.7)), Box::new(|_, _| 0.7 / PI)),
        (shiny(0.3, 0.6, 30.0), Box::new(phong(0.3, 0.6, 30.0))),
        (rough(0.25), Box::new(ggx(0.25))),
        (rough(0.6), Box::new(ggx(0.6))),
    ]
}

/// Rectangles and a parallelogram above the origin, all facing down.
pub(super) const QUADS: [(Vec3, Vec3, Vec3); 7] = [
    (Vec3::new(-1.0, 2.0, -1.0), Vec3::new(1.5, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.5)),
    (Vec3::new(-4.0, 0.5, -5.0), Vec3::new(6.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 9.0)),
    // From far below to far above the solid angle at which the sampling changes
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.01, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.02)),
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.02, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.04)),
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.07, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.07)),
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.2)),
    (Vec3::new(-1.0, 1.5, -1.0), Vec3::new(1.5, 0.5, 0.3), Vec3::new(0.4, 0.2, 2.0)),
];
