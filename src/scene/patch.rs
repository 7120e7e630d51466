//! Bilinear patches.

use glam::{DVec3, Vec2, Vec3};

/// A bilinear patch: position = (1−u)(1−v) p₀₀ + u(1−v) p₁₀ + (1−u)v p₀₁ + uv p₁₁, with its front towards ∂p/∂u × ∂p/∂v. Four
/// values in a row are those of p₀₀, p₁₀, p₀₁, p₁₁.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Corners, not all on one line.
    pub corners: [Vec3; 4],
    /// Normals of the corners, for smooth shading; none = those of the surface.
    pub normals: Option<[Vec3; 4]>,
    /// Texture coordinates of the corners.
    pub uvs: [Vec2; 4],
}

impl Patch {
    /// Texture coordinates that are u and v themselves.
    pub const UVS: [Vec2; 4] = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];

    /// Whether its corners span an area: one of the triangles at opposite corners has one.
    pub fn has_area(&self) -> bool {
        /// Sine of the angle below which two edges count as parallel.
        const MIN_SINE: f64 = 1e-6;
        let [p00, p10, p01, p11] = self.corners.map(|corner| corner.as_dvec3());
        let at = |p: DVec3, a: DVec3, b: DVec3| {
            let (a, b) = (a - p, b - p);
            a.cross(b).length() > MIN_SINE * a.length() * b.length()
        };
        at(p00, p10, p01) || at(p11, p01, p10)
    }

    /// A patch without normals, whose texture coordinates are u and v.
    pub fn new(corners: [Vec3; 4]) -> Self {
        Self { corners, normals: None, uvs: Self::UVS }
    }
}
