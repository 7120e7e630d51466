//! Textures: functions of a surface point that give a colour or a number.

pub mod glsl;
mod image;
mod mapping;
mod noise;
mod pattern;
mod stack;

pub use glsl::{GlslTexture, Parameter};
pub use image::{Channel, ColorSpace, Image, ImageTexture, TexelFilter, Texels, UvTransform, Wrap};
pub use mapping::{Mapping, MappingKind, MappingSpace};
pub use noise::{Noise, NoiseSum, Perlin, PerlinVariant, Spread, ValueNoise, VeinKind, Veins, Warp};
pub use pattern::{Brick, Coordinates, Dots, Gradient, Metric, PatternSpace, WorleyFeature};
pub use stack::StackTexture;

use super::{Handle, Store};
use glam::Vec3;

/// A constant, or a texture that gives the value at each point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value<T> {
    /// The same everywhere.
    Constant(T),
    /// From a texture. Where a number is wanted, the mean of red, green and blue, unless the texture picks a channel.
    Texture(Handle<Texture>),
}

impl<T> Value<T> {
    /// The texture, when there is one.
    pub fn texture(&self) -> Option<Handle<Texture>> {
        match self {
            Self::Constant(_) => None,
            Self::Texture(handle) => Some(*handle),
        }
    }
}

/// A texture: a tree, whose leaves are pictures, patterns and constants.
#[derive(Debug, Clone, PartialEq)]
pub enum Texture {
    /// A picture, placed by the uv of the surface.
    Image(ImageTexture),
    /// A function of the user's own.
    Glsl(GlslTexture),
    /// A volume of texels.
    Stack(StackTexture),
    /// The same everywhere.
    Constant(Vec3),
    /// The colour of the vertices of a mesh, linear between them; white on what has none.
    VertexColor(Channel),
    /// Unit squares or cubes in turn, the one that begins at the origin even.
    Checker {
        /// 2 for squares in x and y, 3 for cubes.
        dimensions: u32,
        /// Where the sum of the whole parts of the coordinates is even.
        even: Value<Vec3>,
        /// Where it is odd.
        odd: Value<Vec3>,
        /// Where the pattern is.
        space: PatternSpace,
    },
    /// Perlin's noise and sums of it.
    Noise(Noise),
    /// Values on a lattice, and sums of them.
    ValueNoise(ValueNoise),
    /// Marble, wood and granite.
    Veins(Veins),
    /// A wall.
    Brick(Brick),
    /// Dots at random places.
    Dots(Dots),
    /// From `low` where the distance is 0 to `high` where it is 1 and beyond.
    Gradient {
        /// What the distance is.
        shape: Gradient,
        /// For a distance of 0 or less.
        low: Value<Vec3>,
        /// For a distance of 1 or more.
        high: Value<Vec3>,
        /// Where the pattern is.
        space: PatternSpace,
    },
    /// Distances to points that are scattered one in each unit cube (Worley 1996), cut off at 1.
    Worley {
        /// Which distance.
        feature: WorleyFeature,
        /// How a distance is measured.
        metric: Metric,
        /// For a distance of 0.
        low: Value<Vec3>,
        /// For a distance of 1 or more.
        high: Value<Vec3>,
        /// Where the pattern is.
        space: PatternSpace,
    },
    /// A colour map.
    Ramp {
        /// Where in the map.
        value: Value<f32>,
        /// Places and colours, by growing place; one at least.
        stops: Vec<(f32, Vec3)>,
        /// Whether colours between stops follow 3t² − 2t³ in place of t.
        smooth: bool,
    },
    /// A tone curve, on each channel.
    Curve {
        /// What it is applied to.
        value: Value<Vec3>,
        /// Values and what they become, by growing value; one at least. Beyond the ends the curve is flat.
        points: Vec<(f32, f32)>,
        /// Whether it follows 3t² − 2t³ between points in place of t.
        smooth: bool,
    },
    /// value · factor.
    Scale {
        /// What is scaled.
        value: Value<Vec3>,
        /// By how much.
        factor: Value<f32>,
    },
    /// A texture at points that are moved.
    Warp(Warp),
    /// (1 − amount) · a + amount · b.
    Mix {
        /// For an amount of 0.
        a: Value<Vec3>,
        /// For an amount of 1.
        b: Value<Vec3>,
        /// 0 to 1.
        amount: Value<f32>,
    },
    /// Of two textures, |normal · direction| of the first and the rest of the second (pbrt, `directionmix`).
    DirectionMix {
        /// Where the surface faces the direction or its opposite.
        a: Value<Vec3>,
        /// Where the direction is along the surface.
        b: Value<Vec3>,
        /// In the world, of unit length. The normal is that of shading.
        direction: Vec3,
    },
    /// a + b.
    Add {
        /// One.
        a: Value<Vec3>,
        /// The other.
        b: Value<Vec3>,
    },
    /// a · b, channel by channel.
    Multiply {
        /// One.
        a: Value<Vec3>,
        /// The other.
        b: Value<Vec3>,
    },
    /// 1 − value.
    Invert {
        /// What is inverted.
        value: Value<Vec3>,
    },
    /// Another texture at other texture coordinates.
    Mapped {
        /// What is seen there.
        value: Value<Vec3>,
        /// Where.
        mapping: Mapping,
    },
}

impl Texture {
    /// Most stops of a ramp and points of a curve: each is looked at for every value.
    pub const MOST_STOPS: usize = 64;

    /// The textures that this one is made of.
    pub fn inputs(&self) -> impl Iterator<Item = Handle<Texture>> {
        let two = |a: &Value<Vec3>, b: &Value<Vec3>| [a.texture(), b.texture(), None];
        let inputs = match self {
            Self::Image(_)
            | Self::Glsl(_)
            | Self::Stack(_)
            | Self::Constant(_)
            | Self::VertexColor(_)
            | Self::Veins(_) => [None; 3],
            Self::Checker { even: a, odd: b, .. }
            | Self::Noise(Noise { low: a, high: b, .. })
            | Self::ValueNoise(ValueNoise { low: a, high: b, .. })
            | Self::Brick(Brick { brick: a, mortar: b, .. })
            | Self::Dots(Dots { outside: a, inside: b, .. })
            | Self::Gradient { low: a, high: b, .. }
            | Self::Worley { low: a, high: b, .. }
            | Self::DirectionMix { a, b, .. }
            | Self::Add { a, b }
            | Self::Multiply { a, b } => two(a, b),
            Self::Ramp { value, .. } => [value.texture(), None, None],
            Self::Mix { a, b, amount } => [a.texture(), b.texture(), amount.texture()],
            Self::Curve { value, .. } | Self::Invert { value } | Self::Mapped { value, .. } => {
                [value.texture(), None, None]
            }
            Self::Scale { value, factor } => [value.texture(), factor.texture(), None],
            Self::Warp(Warp::By { value, by, .. }) => two(value, by),
            Self::Warp(Warp::Noise { value, .. }) => [value.texture(), None, None],
        };
        inputs.into_iter().flatten()
    }

    /// Most textures on the way from a texture to a leaf of its tree.
    pub const DEEPEST: u32 = 64;

    /// What is wrong with a texture that [`Self::without_end`] finds.
    pub fn endless(name: &str) -> String {
        let most = Self::DEEPEST;
        format!("texture `{name}` is made of itself, or of more than {most} textures one in the other")
    }

    /// A texture that is made of itself, or of more than [`Self::DEEPEST`] others one in the other.
    pub fn without_end(textures: &Store<Self>) -> Option<Handle<Self>> {
        let mut depths: Vec<Option<u32>> = vec![None; textures.len()];
        for (handle, ..) in textures.iter() {
            let mut open = vec![handle];
            while let Some(&at) = open.last() {
                if open.len() > Self::DEEPEST as usize {
                    return Some(handle);
                }
                // One input after the other: the way down is never longer than the stack
                let missing = textures[at].inputs().find(|input| depths[input.index()].is_none());
                if let Some(input) = missing {
                    open.push(input);
                    continue;
                }
                let deepest = textures[at].inputs().filter_map(|input| depths[input.index()]).max();
                let depth = deepest.map_or(1, |below| below + 1);
                if depth > Self::DEEPEST {
                    return Some(handle);
                }
                depths[at.index()] = Some(depth);
                open.pop();
            }
        }
        None
    }
}
