//! Inverses of `base/sampling.glsl`: from the point back to the two numbers that it was drawn with.

use std::f64::consts::{FRAC_PI_4, TAU};

/// An angle as a share of a turn, in [0, 1).
pub fn turn(x: f64, y: f64) -> f64 {
    (y.atan2(x) / TAU).rem_euclid(1.0)
}

/// How far two shares of a turn are apart.
pub fn turns_apart(a: f64, b: f64) -> f64 {
    ((a - b + 0.5).rem_euclid(1.0) - 0.5).abs()
}

/// How far `disk_inverse` may be off. Vulkan allows sin and cos an absolute error of 2⁻¹¹; no driver known comes near, so
/// a tenth of that, of a square of side 2.
pub const DISK_ERROR: f64 = 2.5e-5;

/// Inverse of `disk_sample`: the radius is the greater of the two distances from the middle of the square, the angle
/// gives the other.
pub fn disk_inverse(x: f64, y: f64) -> [f64; 2] {
    let r = x.hypot(y);
    if r == 0.0 {
        return [0.5; 2];
    }
    let (a, b) = if x.abs() > y.abs() {
        let a = r * x.signum();
        (a, a * (y / x).atan() / FRAC_PI_4)
    } else {
        let b = r * y.signum();
        (b * (x / y).atan() / FRAC_PI_4, b)
    };
    [0.5 + 0.5 * a, 0.5 + 0.5 * b]
}

/// Inverse of `triangle_sample`.
pub fn triangle_inverse(b: f64, c: f64) -> [f64; 2] {
    if c > b { [2.0 * b, b + c] } else { [b + c, 2.0 * c] }
}

/// Inverse of `sphere_sample`; the turn means little near the poles.
pub fn sphere_inverse([x, y, z]: [f64; 3]) -> [f64; 2] {
    [0.5 - 0.5 * z, turn(x, y)]
}
