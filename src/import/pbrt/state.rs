//! The graphics state: what directives change for those after them.

use super::color_space::ColorSpace;
use super::light::AreaLight;
use super::parameter::Parameter;
use super::place::Spot;
use crate::scene::{Handle, Material};
use glam::DAffine3;
use std::rc::Rc;

/// The maps when the shutter opens and when it closes.
pub(super) type Maps = [DAffine3; 2];

/// One map after another: `a` of `b`.
pub(super) fn after(a: &Maps, b: &Maps) -> Maps {
    [a[0] * b[0], a[1] * b[1]]
}

/// What `Attribute` gives parameters to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    Shape,
    Light,
    Material,
    Medium,
    Texture,
}

/// Parameters that directives inherit, by [`Target`].
pub(super) type Attributes = [Rc<Vec<Rc<Parameter>>>; 5];

/// The graphics state.
#[derive(Debug, Clone)]
pub(super) struct State {
    /// From where things are described to the world; before `WorldBegin`, from the world to the camera.
    pub maps: Maps,
    /// Which of both transforms change.
    pub active: [bool; 2],
    pub reverse: bool,
    /// None is that of pbrt: diffuse, 0.5.
    pub material: Option<Handle<Material>>,
    pub area_light: Option<Rc<AreaLight>>,
    pub attributes: Attributes,
    pub color_space: ColorSpace,
}

impl Default for State {
    fn default() -> Self {
        Self {
            maps: [DAffine3::IDENTITY; 2],
            active: [true; 2],
            reverse: false,
            material: None,
            area_light: None,
            attributes: Default::default(),
            color_space: ColorSpace::Srgb,
        }
    }
}

/// What an `…End` ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Block {
    Attribute,
    /// Only the transforms are brought back.
    Transform,
    Object,
}

impl Block {
    /// As it is written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Attribute => "Attribute",
            Self::Transform => "Transform",
            Self::Object => "Object",
        }
    }
}

/// A state that an `…End` brings back.
#[derive(Debug)]
pub(super) struct Saved {
    pub block: Block,
    pub state: State,
    /// Where the block began.
    pub spot: Spot,
}
