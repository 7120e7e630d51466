//! Lights that are no surfaces, and the environment.

use super::{Handle, Texture, Value};
use glam::{Mat3, Vec3};

/// A light without extent.
#[derive(Debug, Clone, PartialEq)]
pub enum Light {
    /// Shines alike in all directions from a point.
    Point {
        /// Position.
        position: Vec3,
        /// Radiant intensity, W/sr.
        intensity: Vec3,
    },
    /// A cone of light: full inside `cone_angle − falloff_angle`, smoothstep in the cosine to 0 at `cone_angle`.
    Spot {
        /// Position.
        position: Vec3,
        /// Direction of the axis, unit length.
        direction: Vec3,
        /// Radiant intensity on the axis, W/sr.
        intensity: Vec3,
        /// Half-angle of the cone in degrees, in (0, 180).
        cone_angle: f32,
        /// Width of the soft edge inside the cone, in degrees, in [0, cone_angle].
        falloff_angle: f32,
    },
    /// Parallel light from infinitely far away.
    Distant {
        /// Direction in which the light travels, unit length.
        direction: Vec3,
        /// Irradiance on a surface that faces the light, W/m².
        irradiance: Vec3,
    },
}

/// Radiance from infinity. An image is equirectangular: its middle row is the horizon and its middle column
/// looks along −z, u grows towards +x there, and its top row is +y.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Radiance: a colour, or a texture looked up by direction.
    pub radiance: Value<Vec3>,
    /// Factor on the radiance.
    pub scale: f32,
    /// Rotation from the directions of the image to world directions.
    pub world_from_environment: Mat3,
}

impl Environment {
    /// The texture, when there is one.
    pub fn texture(&self) -> Option<Handle<Texture>> {
        self.radiance.texture()
    }
}
