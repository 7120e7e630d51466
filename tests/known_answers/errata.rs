//! Four formulas of the lecture that are not what they should be: pictures follow the corrected form, and the literal one differs.

use crate::common::render::*;
use dapple::scene::*;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// Distance of two unit vectors.
fn apart(a: DVec3, b: DVec3) -> f64 {
    a.normalize().distance(b.normalize())
}

/// A picture of which the red is u and the green is v, to the size of a texel.
fn coordinates(s: &mut Scene) -> Handle<Texture> {
    let texel = |i: u32| [(i % 256) as f32 / 255.0, 1.0 - (i / 256) as f32 / 255.0, 0.0, 1.0];
    let texels = Texels::RgbaF32((0..256 * 256).map(texel).collect());
    s.picture(Image { width: 256, height: 256, texels }, |texture| texture.filter = TexelFilter::Nearest)
}

#[test]
fn u_of_a_sphere_is_its_longitude_and_v_its_latitude() {
    // The lecture has the latitude in both. A turn about the pole changes u alone.
    let seen = |turn: f32| {
        let mut s = scene(9, 9, 1);
        s.render.sampler = Sampler::Center;
        s.camera = look(Vec3::new(0.0, 1.0, 6.0), Vec3::ZERO, 10.0);
        let texture = coordinates(&mut s);
        let m = s.unlit(Value::Texture(texture));
        s.sphere(Vec3::ZERO, 2.0, m).world_from_object = glam::Affine3A::from_rotation_y(turn);
        render(&s).rgb
    };
    for (a, b) in seen(0.0).iter().zip(seen(0.6)) {
        assert!((a[1] - b[1]).abs() < 0.005, "v is {} and {}", a[1], b[1]);
        let turned = f64::from(a[0] - b[0]);
        assert!((turned - 0.6 / (2.0 * PI)).abs() < 0.01, "u is {} and {}", a[0], b[0]);
        // Literally, u would be the same function of the latitude as v
        assert!((a[0] - a[1]).abs() > 0.05 || (b[0] - b[1]).abs() > 0.05);
    }
}

/// The normal in the middle of a parallelogram with a height that has a slope along u and v, per unit of uv.
fn bumped(edge_u: Vec3, edge_v: Vec3, slope: [f32; 2]) -> DVec3 {
    let mut s = scene(5, 5, 1);
    s.render.sampler = Sampler::Center;
    s.camera.projection = Projection::pinhole(4.0);
    let n = 64;
    let at = |i: u32| (i as f32 + 0.5) / n as f32;
    let texel = |i: u32| [slope[0] * at(i % n) + slope[1] * at(n - 1 - i / n); 4];
    let texels = Texels::RgbaF32((0..n * n).map(texel).collect());
    let texture = s.picture(Image { width: n, height: n, texels }, |texture| texture.wrap = [Wrap::Clamp; 2]);
    let m = s.diffuse(0.5);
    let derivative = Derivative::Kernel;
    s.materials[m].detail.bump = Some(Bump { texture, height: 1.0, derivative, curvature: false });
    s.quad(-0.5 * (edge_u + edge_v) - Vec3::Z * 4.0, edge_u, edge_v, m);
    DVec3::from_array(render(&s).normal[12].map(f64::from))
}

#[test]
fn the_cross_product_of_a_bump_tilts_against_its_slope() {
    let (b_u, b_w) = (0.5_f32, 0.2_f32);
    let n = bumped(Vec3::X, Vec3::Y, [b_u, b_w]);
    let (b_u, b_w) = (f64::from(b_u), f64::from(b_w));
    assert!(apart(n, DVec3::new(-b_u, -b_w, 1.0)) < 2e-3, "{n}");
    // P_u × P_w + b_u P_u × n + b_w P_w × n, as written, is turned by 90°
    assert!(apart(n, DVec3::new(b_w, -b_u, 1.0)) > 0.3, "{n}");
}

#[test]
fn derivatives_are_along_unit_directions_that_need_not_be_at_right_angles() {
    // A height that grows along the second of two edges at 45°: its gradient is at right angles to the first
    let n = bumped(Vec3::X, Vec3::new(1.0, 1.0, 0.0), [0.0, 0.5]);
    assert!(apart(n, DVec3::new(0.0, -0.5, 1.0)) < 2e-3, "{n}");
    // With P_u and P_w as if they were at right angles, without the sine of the corner
    let along = DVec3::new(1.0, 1.0, 0.0).normalize() * (0.5 / 2.0_f64.sqrt());
    assert!(apart(n, DVec3::Z - along) > 0.1, "{n}");
}

#[test]
fn the_kernel_of_a_slope_is_a_sixth_of_the_differences_that_it_sums() {
    let n = bumped(Vec3::X, Vec3::Y, [0.3, 0.0]);
    assert!(apart(n, DVec3::new(-0.3, 0.0, 1.0)) < 2e-3, "{n}");
    // As written, the rows and columns are summed and not divided by anything: per texel, of which there are 64
    assert!(apart(n, DVec3::new(-0.3 * 6.0 / 64.0, 0.0, 1.0)) > 0.1, "{n}");
    assert!(apart(n, DVec3::new(-0.3 * 6.0, 0.0, 1.0)) > 0.3, "{n}");
}
