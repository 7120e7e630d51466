//! What a material does to the surface itself, whatever its light: how much of it is there, and where its normals look.

use super::{Handle, Texture, Value};
use glam::Vec3;

/// Opacity of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Opacity {
    /// How much of the surface is there: 0 = nothing, 1 = all of it.
    pub value: Value<f32>,
    /// A point is there when its value is this, at least 0, or more; none = each point is there to the part that its value says.
    pub cutoff: Option<f32>,
    /// Colour that light has which goes straight through, where the surface is not there.
    pub filter: Value<Vec3>,
}

impl Default for Opacity {
    fn default() -> Self {
        Self { value: Value::Constant(1.0), cutoff: None, filter: Value::Constant(Vec3::ONE) }
    }
}

impl Opacity {
    /// Whether all of the surface is there.
    pub fn is_whole(&self) -> bool {
        match self.value {
            Value::Constant(value) => value >= self.cutoff.unwrap_or(1.0),
            Value::Texture(_) => false,
        }
    }

    /// The textures that drive it.
    pub fn textures(&self) -> impl Iterator<Item = Handle<Texture>> {
        [self.value.texture(), self.filter.texture()].into_iter().flatten()
    }
}

/// From where a surface is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sides {
    /// From both sides.
    #[default]
    Both,
    /// From its front: what meets it from behind goes straight through (glTF 2.0, `doubleSided = false`).
    Front,
}

/// How the derivative of a height is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Derivative {
    /// From the 3 × 3 texels around the point: the difference of the rows, and of the columns, a sixth of it for each texel
    /// (Prewitt 1970).
    Kernel,
    /// A step of 0.0005 in u and one in v (pbrt-v4, section 10.5.3, where nothing filters textures).
    Forward,
    /// The derivative of the surface that bilinear interpolation makes between texels, as Mitsuba 3 does; of a texture without a
    /// picture, which has no formula for it, central differences.
    Analytic,
}

/// Bumps: a height over the surface, along its normal (Blinn 1978).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bump {
    /// The height; the mean of red, green and blue.
    pub texture: Handle<Texture>,
    /// Height of a value of 1, in scene units.
    pub height: f32,
    /// How its derivative is found.
    pub derivative: Derivative,
    /// Count the bend of the surface itself, times the height: ∂Q/∂u = ∂P/∂u + ∂h/∂u n + h ∂n/∂u.
    pub curvature: bool,
}

/// Where the x and y of a normal map are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tangents {
    /// Tangents of the vertices as MikkTSpace makes them; along ∂p/∂u where there is no mesh.
    MikkTSpace,
    /// Along ∂p/∂u of each triangle.
    Uv,
}

/// Normals from a picture: (2 r − 1, 2 g − 1, 2 b − 1) along tangent, bitangent and normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalMap {
    /// The picture, in linear numbers.
    pub texture: Handle<Texture>,
    /// Green is down, as DirectX has it, and not up as OpenGL has it.
    pub green_down: bool,
    /// Factor on x and y.
    pub strength: f32,
    /// Where x and y are.
    pub tangents: Tangents,
}

impl NormalMap {
    /// Most that x and y are stretched by, either way.
    pub const MOST_STRENGTH: f32 = 100.0;
}

/// What a material does to the surface itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Detail {
    /// How much of it is there.
    pub opacity: Opacity,
    /// From where it is there.
    pub sides: Sides,
    /// Bumps, on top of a normal map where there are both.
    pub bump: Option<Bump>,
    /// Normals from a picture.
    pub normal_map: Option<NormalMap>,
    /// Soften the light at the edge of the shadow that a bump casts on itself (Estevez, Lecocq and Stein 2019).
    pub soften_terminator: bool,
    /// Turn a normal back that bumps or a normal map have turned away from the viewer.
    pub keep_visible: bool,
}

impl Default for Detail {
    fn default() -> Self {
        Self {
            opacity: Opacity::default(),
            sides: Sides::Both,
            bump: None,
            normal_map: None,
            soften_terminator: true,
            keep_visible: true,
        }
    }
}
