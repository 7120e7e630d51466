//! Lights that are no surfaces, and the environment.

use super::camera::half_height;
use super::{FovAxis, Handle, Punctual, Texture, Value};
use glam::{Affine3A, Mat3, Vec2, Vec3};

/// How a direction becomes a place in a picture. y is up in the space of the light.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum DirectionMapping {
    /// Longitude and latitude: the middle row is the horizon and the middle column looks along −z, u grows towards +x there,
    /// and the top row is +y.
    #[default]
    Equirectangular,
    /// The octahedral square of equal areas (Clarberg 2008; pbrt-v4, section 3.8.3): the middle is +y, the middles of the
    /// right and the upper edge are +x and +z, and the corners are −y.
    EqualArea,
}

/// A light without extent.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// What it does.
    pub kind: LightKind,
    /// Radiant intensity in W/sr; of distant light the irradiance on a surface that faces it, in W/m². A texture sees the
    /// direction in the space of the light as the position in object space, and that in the world as the position in the
    /// world; of distant light both are the point that is lit.
    pub intensity: Value<Vec3>,
    /// Factor on it.
    pub strength: Strength,
    /// Rotation from the space of the light, which shines along −z with y up, to the world.
    pub world_from_light: Mat3,
}

/// How strong a light is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Strength {
    /// A factor on the intensity.
    Scale(f32),
    /// The factor that makes the mean of red, green and blue of all that is sent out so many watts. The mean of a texture that
    /// is no plain picture is estimated. Not for distant light.
    Power(f32),
}

/// The kinds of lights without extent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// Shines in all directions from a point.
    Point {
        /// Position.
        position: Vec3,
        /// How a direction becomes the uv of a texture.
        mapping: DirectionMapping,
    },
    /// One of the table [`PUNCTUAL_LIGHTS`](super::PUNCTUAL_LIGHTS).
    Punctual(Punctual),
    /// A picture thrown from a point through a rectangle (pbrt-v4, section 12.2.3): uv is (0, 0) at its lower left corner and
    /// (1, 1) at its upper right, seen from the light. Outside is no light.
    Projection {
        /// Position.
        position: Vec3,
        /// Field of view in degrees, in (0, 180).
        fov: f32,
        /// Direction in which `fov` is measured.
        fov_axis: FovAxis,
        /// Width of the rectangle over its height.
        aspect: f32,
    },
}

impl Light {
    /// A light of factor 1 that shines along −z.
    pub fn new(kind: LightKind, intensity: Value<Vec3>) -> Self {
        Self { kind, intensity, strength: Strength::Scale(1.0), world_from_light: Mat3::IDENTITY }
    }

    /// A point light of an intensity in W/sr.
    pub fn point(position: Vec3, intensity: Vec3) -> Self {
        let mapping = DirectionMapping::default();
        Self::new(LightKind::Point { position, mapping }, Value::Constant(intensity))
    }

    /// Parallel light of an irradiance in W/m², which travels along a unit vector.
    pub fn distant(direction: Vec3, irradiance: Vec3) -> Self {
        Self::new(LightKind::distant(0.0), Value::Constant(irradiance)).along(direction)
    }

    /// The same light in a space that is mapped to the world: its place and directions are, its strength is not.
    #[must_use]
    pub fn moved(mut self, map: &Affine3A) -> Self {
        match &mut self.kind {
            LightKind::Point { position, .. } | LightKind::Projection { position, .. } => {
                *position = map.transform_point3(*position);
            }
            LightKind::Punctual(light) if light.kind.shines.is_some() => {
                light.position = map.transform_point3(light.position);
            }
            LightKind::Punctual(_) => {}
        }
        let [direction, up] = [-self.world_from_light.z_axis, self.world_from_light.y_axis]
            .map(|axis| map.transform_vector3(axis).try_normalize().unwrap_or(axis));
        let frame = facing(direction, up);
        self.world_from_light = frame.unwrap_or(self.world_from_light);
        self
    }

    /// The same light along a unit vector, with +y up, or −z where the direction is along y.
    #[must_use]
    pub fn along(self, direction: Vec3) -> Self {
        let frame = facing(direction, Vec3::Y).or_else(|| facing(direction, Vec3::NEG_Z));
        Self { world_from_light: frame.unwrap_or(Mat3::IDENTITY), ..self }
    }
}

/// The rotation that takes −z to the unit vector `direction`, and y as near to `up` as can be; none when they are along one
/// another.
pub fn facing(direction: Vec3, up: Vec3) -> Option<Mat3> {
    /// Sine of the least angle between direction and up: below it 32-bit vectors do not tell left from right.
    const MIN_SINE: f64 = 1e-6;
    let (back, up) = (-direction.as_dvec3(), up.as_dvec3().try_normalize()?);
    let right = Some(up.cross(back)).filter(|right| right.length() > MIN_SINE)?.normalize();
    Some(Mat3::from_cols(right.as_vec3(), back.cross(right).as_vec3(), -direction))
}

/// The same with +y up, or −z where light goes along y.
pub fn facing_upright(direction: Vec3) -> Mat3 {
    facing(direction, Vec3::Y).or_else(|| facing(direction, Vec3::NEG_Z)).unwrap_or_default()
}

/// Tangents of half the angles that a projection fills to the right and upward.
pub(crate) fn half_frustum(fov: f32, fov_axis: FovAxis, aspect: f32) -> Vec2 {
    let half_y = half_height(fov_axis, (0.5 * fov).to_radians().tan(), aspect);
    Vec2::new(half_y * aspect, half_y)
}

/// Radiance from infinity.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Radiance: a colour, or a texture looked up by direction.
    pub radiance: Value<Vec3>,
    /// Factor on the radiance.
    pub scale: f32,
    /// Rotation from the directions of the texture to world directions.
    pub world_from_environment: Mat3,
    /// How a direction becomes the uv of a texture.
    pub mapping: DirectionMapping,
}

impl Environment {
    /// An environment of factor 1 that is not turned.
    pub fn new(radiance: Value<Vec3>) -> Self {
        let (world_from_environment, mapping) = (Mat3::IDENTITY, DirectionMapping::default());
        Self { radiance, scale: 1.0, world_from_environment, mapping }
    }

    /// The texture, when there is one.
    pub fn texture(&self) -> Option<Handle<Texture>> {
        self.radiance.texture()
    }
}
