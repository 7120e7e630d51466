//! What a material does to the surface itself, whatever its light: how much of it is there.

use super::{Handle, Texture, Value};
use glam::Vec3;

/// Opacity of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Opacity {
    /// How much of the surface is there: 0 = nothing, 1 = all of it.
    pub value: Value<f32>,
    /// A point is there when its value is this or more; none = each point is there to the part that its value says.
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

/// What a material does to the surface itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Detail {
    /// How much of it is there.
    pub opacity: Opacity,
}
