//! Bilinear patches.

use glam::{Vec2, Vec3};

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

    /// A patch without normals, whose texture coordinates are u and v.
    pub fn new(corners: [Vec3; 4]) -> Self {
        Self { corners, normals: None, uvs: Self::UVS }
    }
}
