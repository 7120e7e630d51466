//! Textures: functions of a surface point that give a colour or a number.

use super::{Handle, Store};
use glam::{Affine2, Affine3A, Mat2, Vec2, Vec3};

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
    /// The same everywhere.
    Constant(Vec3),
    /// Unit squares or cubes in turn, the one that begins at the origin even.
    Checker {
        /// Where the sum of the whole parts of the coordinates is even.
        even: Value<Vec3>,
        /// Where it is odd.
        odd: Value<Vec3>,
        /// Where the pattern is.
        space: PatternSpace,
    },
    /// Perlin's improved noise and sums of it.
    Noise(Noise),
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
    /// (1 − amount) · a + amount · b.
    Mix {
        /// For an amount of 0.
        a: Value<Vec3>,
        /// For an amount of 1.
        b: Value<Vec3>,
        /// 0 to 1.
        amount: Value<f32>,
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
}

impl Texture {
    /// The textures that this one is made of.
    pub fn inputs(&self) -> impl Iterator<Item = Handle<Texture>> {
        let inputs = match self {
            Self::Image(_) | Self::Constant(_) => [None; 3],
            Self::Checker { even: a, odd: b, .. } | Self::Noise(Noise { low: a, high: b, .. }) => {
                [a.texture(), b.texture(), None]
            }
            Self::Gradient { low, high, .. } | Self::Worley { low, high, .. } => {
                [low.texture(), high.texture(), None]
            }
            Self::Ramp { value, .. } => [value.texture(), None, None],
            Self::Mix { a, b, amount } => [a.texture(), b.texture(), amount.texture()],
            Self::Add { a, b } | Self::Multiply { a, b } => [a.texture(), b.texture(), None],
            Self::Invert { value } => [value.texture(), None, None],
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

/// The coordinates that a pattern is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// u, v and 0.
    Uv,
    /// Position in the object space of the shape or instance. On spheres and disks that is where their radius is 1.
    Object,
    /// Position in the world.
    World,
}

/// Where a pattern is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternSpace {
    /// What it is a function of.
    pub coordinates: Coordinates,
    /// From these to those of the pattern.
    pub pattern_from_space: Affine3A,
}

/// A distance to scattered points, of those in the 27 cells around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum WorleyFeature {
    /// To the nearest.
    F1,
    /// To the one after the nearest.
    F2,
    /// The difference of both: 0 where two cells meet.
    Difference,
}

/// How a distance is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Metric {
    /// √(x² + y² + z²).
    Euclidean,
    /// |x| + |y| + |z|.
    Manhattan,
    /// The largest of |x|, |y| and |z|.
    Chebyshev,
}

/// The distance of a gradient.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Gradient {
    /// x.
    Linear,
    /// From the z axis.
    Cylindrical,
    /// From the origin.
    Spherical,
}

/// How octaves of noise are summed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NoiseSum {
    /// n itself.
    Fbm,
    /// |n|: creases where the noise changes its sign (Perlin 1985).
    Turbulence,
}

/// Σ gainⁱ n(lacunarityⁱ p) / Σ gainⁱ over octaves, with n the improved noise (Perlin 2002), which is within −1 and 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// What is summed.
    pub sum: NoiseSum,
    /// Number of octaves; 1 is noise alone.
    pub octaves: u32,
    /// Factor on the amplitude from one octave to the next.
    pub gain: f32,
    /// Factor on the frequency from one octave to the next.
    pub lacunarity: f32,
    /// For a sum of −1, or of 0 where absolute values are summed.
    pub low: Value<Vec3>,
    /// For a sum of 1.
    pub high: Value<Vec3>,
    /// Where the pattern is; a cell of the lattice of the first octave has a side of 1.
    pub space: PatternSpace,
}

/// How a value between texels is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TexelFilter {
    /// The texel that holds the point.
    Nearest,
    /// Bilinear between the four texels around the point; texel centres are at (i + ½) / n.
    Bilinear,
}

/// What lies outside [0, 1) of a texture coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The picture again.
    Repeat,
    /// The texel at the edge.
    Clamp,
    /// The picture and its mirror image in turn.
    Mirror,
    /// Zero, also in alpha.
    Black,
}

/// How stored numbers become linear light. Alpha is always linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ColorSpace {
    /// IEC 61966-2-1.
    Srgb,
    /// As they are.
    Linear,
}

/// Which channel of a picture a texture gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The colour.
    Rgb,
    /// Red, as grey.
    R,
    /// Green, as grey.
    G,
    /// Blue, as grey.
    B,
    /// Alpha, as grey.
    A,
}

/// Scale, then rotation, then offset of texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UvTransform {
    /// Factors on u and v.
    pub scale: Vec2,
    /// Counter-clockwise rotation about (0, 0) in degrees.
    pub rotate: f32,
    /// Added last.
    pub offset: Vec2,
}

impl Default for UvTransform {
    fn default() -> Self {
        Self { scale: Vec2::ONE, rotate: 0.0, offset: Vec2::ZERO }
    }
}

impl UvTransform {
    /// The same as a matrix.
    pub fn matrix(&self) -> Affine2 {
        let linear = Mat2::from_angle(self.rotate.to_radians()) * Mat2::from_diagonal(self.scale);
        Affine2::from_mat2_translation(linear, self.offset)
    }
}

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageTexture {
    /// The picture.
    pub image: Handle<Image>,
    /// Between texels.
    pub filter: TexelFilter,
    /// Outside the picture, along u and v.
    pub wrap: [Wrap; 2],
    /// From the uv of the surface to the uv of the picture.
    pub uv: UvTransform,
    /// How the stored numbers are meant.
    pub color_space: ColorSpace,
    /// The channel that is given.
    pub channel: Channel,
    /// Factor on the value, after `invert`.
    pub scale: f32,
    /// Give 1 − value.
    pub invert: bool,
}

/// Texels as they were stored, row 0 on top. Grey is repeated in R, G, B; missing alpha is opaque.
#[derive(Debug, Clone, PartialEq)]
pub enum Texels {
    /// 8 bits a channel.
    Rgba8(Vec<[u8; 4]>),
    /// 16 bits a channel.
    Rgba16(Vec<[u16; 4]>),
    /// 32-bit floats.
    RgbaF32(Vec<[f32; 4]>),
}

/// A picture in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` texels, row by row from the top.
    pub texels: Texels,
}
