//! Size of the picture, pixel filter, samples and depth.

use super::{Exposure, ToneCurve};

/// Largest width and height of a picture, in pixels.
pub const MAX_SIDE: u32 = 16384;

/// Most samples a pixel: the sums of a film have room for so many of the largest sample.
pub const MAX_SAMPLES: u32 = 1 << 20;

/// A rectangle of pixels, half-open: columns `x0..x1`, rows `y0..y1`, row 0 on top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rect {
    /// First column.
    pub x0: u32,
    /// First row.
    pub y0: u32,
    /// One past the last column.
    pub x1: u32,
    /// One past the last row.
    pub y1: u32,
}

impl Rect {
    /// Columns.
    pub fn width(&self) -> u32 {
        self.x1 - self.x0
    }
    /// Rows.
    pub fn height(&self) -> u32 {
        self.y1 - self.y0
    }
    /// The number of a pixel, row by row; none outside.
    pub fn index(&self, x: u32, y: u32) -> Option<usize> {
        let inside = (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y);
        inside.then(|| ((y - self.y0) * self.width() + x - self.x0) as usize)
    }
    /// Number of pixels.
    pub fn area(&self) -> u64 {
        u64::from(self.width()) * u64::from(self.height())
    }
}

/// Shape of the pixel filter (pbrt-v4, section 8.8). All are sampled in proportion to their magnitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilterKind {
    /// Constant within the radius.
    Box,
    /// Falls linearly to 0 at the radius.
    Tent,
    /// Gaussian with `sigma = radius / 3`, less its value at the radius.
    Gaussian,
    /// Blackman-Harris window over the radius.
    BlackmanHarris,
    /// Two cubics, the outer one negative in part, over twice the half of the radius (Mitchell and Netravali 1988).
    Mitchell {
        /// Blur, 0 to 1.
        b: f32,
        /// Ringing, 0 to 1.
        c: f32,
    },
    /// sinc(x) · sinc(x / tau), x in pixels, cut off at the radius (Lanczos).
    Sinc {
        /// Width of the window, pixels.
        tau: f32,
    },
}

impl FilterKind {
    /// Value at a distance of `x` of the radius, 0 to 1, for those kinds that may be negative; none for the others.
    pub fn signed_value(self, x: f64, radius: f64) -> Option<f64> {
        match self {
            Self::Mitchell { b, c } => Some(mitchell(2.0 * x, b.into(), c.into())),
            Self::Sinc { tau } => Some(sinc(x * radius) * sinc(x * radius / f64::from(tau))),
            Self::Box | Self::Tent | Self::Gaussian | Self::BlackmanHarris => None,
        }
    }
}

/// The filter of Mitchell and Netravali (1988, equation 8) for 0 ≤ x ≤ 2.
fn mitchell(x: f64, b: f64, c: f64) -> f64 {
    let cubic = if x < 1.0 {
        [12.0 - 9.0 * b - 6.0 * c, -18.0 + 12.0 * b + 6.0 * c, 0.0, 6.0 - 2.0 * b]
    } else {
        [-b - 6.0 * c, 6.0 * b + 30.0 * c, -12.0 * b - 48.0 * c, 8.0 * b + 24.0 * c]
    };
    cubic.iter().fold(0.0, |sum, factor| sum * x + factor) / 6.0
}

/// sin(π x) / (π x).
fn sinc(x: f64) -> f64 {
    let angle = std::f64::consts::PI * x;
    if angle.abs() < 1e-6 { 1.0 } else { angle.sin() / angle }
}

/// Pixel reconstruction filter, separable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    /// Shape.
    pub kind: FilterKind,
    /// Half-width in pixels, the same in x and y.
    pub radius: f32,
}

impl Filter {
    /// Largest radius in pixels: wider filters only blur.
    pub const MOST_RADIUS: f32 = 64.0;
}

/// Size and encoding of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Columns of pixels.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    /// Part of the picture to render; all of it when absent.
    pub crop: Option<Rect>,
    /// Pixel filter.
    pub filter: Filter,
    /// How bright the picture is in a PNG.
    pub exposure: Exposure,
    /// The curve on the way to PNG.
    pub tone_curve: ToneCurve,
    /// Bits a channel in a PNG: 8 or 16.
    pub png_bits: u32,
    /// Leave out the sky behind the scene and write the coverage as alpha, with colour premultiplied in EXR and not
    /// in PNG.
    pub transparent: bool,
}

impl Film {
    /// The pixels that are rendered.
    pub fn window(&self) -> Rect {
        self.crop.unwrap_or(Rect { x0: 0, y0: 0, x1: self.width, y1: self.height })
    }
}

impl Default for Film {
    fn default() -> Self {
        Self {
            width: 640,
            height: 480,
            crop: None,
            filter: Filter { kind: FilterKind::Box, radius: 0.5 },
            exposure: Exposure::default(),
            tone_curve: ToneCurve::Srgb,
            png_bits: 8,
            transparent: false,
        }
    }
}

/// Where the random numbers of a sample come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampler {
    /// Every sample in the middle of its pixel; the other dimensions are random.
    Center,
    /// Samples on the grid of strata, without jitter; the other dimensions are random.
    Regular,
    /// Independent uniform numbers in all dimensions.
    Random,
    /// One jittered sample a stratum; lens and light are stratified alike, in a random order of their own.
    Stratified,
    /// Owen-scrambled Sobol points by hashing (Burley 2020).
    Sobol,
}

/// How paths are traced.
#[derive(Debug, Clone, PartialEq)]
pub struct Render {
    /// Samples a pixel.
    pub spp: u32,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Source of random numbers.
    pub sampler: Sampler,
    /// Strata of a pixel in x and y, for `regular` and `stratified`.
    pub strata: [u32; 2],
    /// Most scattering events on a path (1 = direct light only, as pbrt counts).
    pub max_depth: u32,
    /// Most scattering events that are not mirror or smooth glass and are followed further; none = no limit, 0
    /// = the classical recursive ray tracer (Whitted 1980).
    pub diffuse_bounces: Option<u32>,
    /// End paths of small throughput at random, without changing the mean.
    pub russian_roulette: bool,
    /// Largest radiance that one sample may add after its first scattering event; none = no clamp.
    pub firefly_clamp: Option<f32>,
    /// Light that comes from below the geometric surface is cut off even where the shading normal sees it.
    pub geometric_veto: bool,
}

impl Render {
    /// Most scattering events that a scene may ask for.
    pub const MOST_DEPTH: u32 = 1000;
    /// Most strata of a pixel along an axis.
    pub const MOST_STRATA: u32 = 4096;
}

impl Default for Render {
    fn default() -> Self {
        Self {
            spp: 64,
            seed: 0,
            sampler: Sampler::Sobol,
            strata: [4, 4],
            max_depth: 8,
            diffuse_bounces: None,
            russian_roulette: true,
            firefly_clamp: None,
            geometric_veto: false,
        }
    }
}
