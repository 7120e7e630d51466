//! Inputs of what is a row of a table: [`BSDFS`](super::BSDFS) and [`PUNCTUAL_LIGHTS`](super::PUNCTUAL_LIGHTS).

/// A colour: a part of the light, in [0, 1]. Two of a row are scaled down where together they are more than 1, so that no energy is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputColor {
    /// Its key in a scene, and its field in GLSL.
    pub key: &'static str,
    /// What it is where nothing is said; grey.
    pub default: f32,
}

/// A number, in the unit that its row says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputNumber {
    /// Its key in a scene, and its field in GLSL.
    pub key: &'static str,
    /// What it is where nothing is said.
    pub default: f32,
    /// The least that it may be. What a texture gives below it counts as this.
    pub least: f32,
    /// The most that it may be. What a texture gives above it counts as this.
    pub most: f32,
}
