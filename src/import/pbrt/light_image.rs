//! Lights with images: goniometric and projection lights, the environment, and images of area lights.

use super::parameter::Type;
use super::parameters::Parameters;
use super::reader::Reader;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::Limits;
use crate::scene::{
    Channel, ColorSpace, DirectionMapping, Environment, FovAxis, Image, ImageTexture, Light, LightKind,
    TexelFilter, Texels, Texture, UvTransform, Value, Wrap, facing,
};
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::PI;

/// What is wrong with a transform that turns an axis into nothing.
const FLAT: &str = "the transform of the light is flat";
/// Luminance of red, green and blue (ITU-R BT.709).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

impl Reader<'_> {
    /// A point light whose intensity is a picture of all directions: +y is in the middle of it, +x to the right and +z below.
    /// Only the mean of its channels counts.
    pub(super) fn goniometric(&mut self, from: &Parameters) -> Result<Light> {
        let picture = self.light_image(from, TexelFilter::Nearest)?;
        let position = self.in_world(Vec3::ZERO).as_vec3();
        let position = self.finite(from, position)?;
        let mean = self.mean_over(&picture, |rgb, _| rgb.iter().sum::<f32>() / 3.0);
        let power = from.float("power", Limits::Finite)?.filter(|power| *power > 0.0);
        let factor = power.map_or(1.0, |power| share(power, 4.0 * PI * mean));
        let color = self.light_color(from, "I")? * factor;
        let value = Value::Constant(self.finite(from, color)?);
        let [x, y, z] = self.square_axes(from)?;
        // The map of dapple has +z above its middle
        let (world_from_light, picture) = turned([x, y, -z], picture);
        let factor = Value::Texture(self.part(Texture::Image(picture)));
        let intensity = Value::Texture(self.part(Texture::Scale { value, factor }));
        let kind = LightKind::Point { position, mapping: DirectionMapping::EqualArea };
        Ok(Light { world_from_light, ..Light::new(kind, intensity) })
    }

    /// A picture that is thrown along +z, with +y up and +x to the right.
    pub(super) fn projection(&mut self, from: &Parameters) -> Result<Light> {
        let picture = self.light_image(from, TexelFilter::Nearest)?;
        let image = &self.scene.images[picture.image];
        let aspect = image.width as f32 / image.height as f32;
        let fov = from.float_or("fov", 90.0, Limits::Between(0.0, 180.0))?;
        let position = self.in_world(Vec3::ZERO).as_vec3();
        let position = self.finite(from, position)?;
        let [right, up, along] = self.axes(from)?;
        let world_from_light =
            facing(along, up).ok_or_else(|| from.error(FLAT).help("give every axis a size"))?;
        let scale = from.float_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let scale = match from.float("power", Limits::Finite)?.filter(|power| *power > 0.0) {
            Some(power) => {
                let half = Vec2::new(aspect.max(1.0), 1.0 / aspect.min(1.0)) * (0.5 * fov).to_radians().tan();
                // A texel is seen from the light in proportion to the cube of the cosine
                let mean = self.mean_over(&picture, |rgb, at| {
                    luminance(rgb) * (half * (2.0 * at - 1.0)).extend(1.0).length_recip().powi(3)
                });
                scale * share(power, 4.0 * half.x * half.y * mean)
            }
            None => scale,
        };
        // Where +x is to the left, seen along the light, the picture is mirrored
        let picture = if right.dot(along.cross(up)) < 0.0 { flipped(picture) } else { picture };
        let intensity = self.tinted(from, picture, scale)?;
        let kind = LightKind::Projection { position, fov, fov_axis: FovAxis::Smaller, aspect };
        Ok(Light { world_from_light, ..Light::new(kind, intensity) })
    }

    /// A picture of all directions, whose texels are looked up as they are: +z is in the middle of it, +x to the right and +y
    /// below.
    pub(super) fn infinite_image(&mut self, from: &Parameters) -> Result<()> {
        if self.scene.environment.is_some() {
            self.unsupported(Unsupported::SecondEnvironment, &from.spot);
        }
        let picture = self.light_image(from, TexelFilter::Nearest)?;
        let scale = from.float_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let scale = match from.float("illuminance", Limits::Finite)?.filter(|wanted| *wanted > 0.0) {
            Some(wanted) => {
                let mean = self.mean_over(&picture, |rgb, at| luminance(rgb) * height(at).max(0.0));
                // As in pbrt, where a texel counts as 2π / n and not as 4π / n
                scale * share(wanted, 2.0 * PI * mean)
            }
            None => scale,
        };
        let [x, y, z] = self.square_axes(from)?;
        // The map of dapple has +y in its middle and +z above
        let (world_from_environment, picture) = turned([x, z, -y], picture);
        let radiance = Value::Texture(self.part(Texture::Image(picture)));
        let mapping = DirectionMapping::EqualArea;
        self.scene.environment = Some(Environment { radiance, scale, world_from_environment, mapping });
        Ok(())
    }

    /// The radiance of an area light with an image, and its mean luminance without the scale.
    pub(super) fn lamp_image(&mut self, from: &Parameters) -> Result<(Value<Vec3>, f32)> {
        if let Some(spot) = from.has("L") {
            let message = format!("{} has both `L` and `filename`", from.what);
            return Err(spot.error(message).help("keep one of them"));
        }
        let picture = self.light_image(from, TexelFilter::Bilinear)?;
        let mean = self.mean_over(&picture, |rgb, _| luminance(rgb));
        let scale = from.float_or("scale", 1.0, Limits::AtLeast(0.0))?;
        Ok((self.tinted(from, picture, scale)?, mean))
    }

    /// The picture of a light.
    fn light_image(&mut self, from: &Parameters, filter: TexelFilter) -> Result<ImageTexture> {
        let (spot, path) = from.file("filename")?.ok_or_else(|| from.missing("filename", Type::String))?;
        let (image, _) = self.image(&spot, &path)?;
        let color_space = match self.scene.images[image].texels {
            Texels::Rgba8(_) | Texels::Rgba16(_) => ColorSpace::Srgb,
            Texels::RgbaF32(_) => ColorSpace::Linear,
        };
        let (wrap, uv, channel) = ([Wrap::Clamp; 2], UvTransform::default(), Channel::Rgb);
        Ok(ImageTexture { image, filter, wrap, uv, color_space, channel, scale: 1.0, invert: false })
    }

    /// Mean over the texels of a picture, of their linear colour and where they are: from (0, 0) at the upper left to (1, 1).
    fn mean_over(&self, picture: &ImageTexture, value: impl Fn([f32; 3], Vec2) -> f32) -> f32 {
        let image: &Image = &self.scene.images[picture.image];
        let (width, count) = (image.width as usize, image.width as usize * image.height as usize);
        let size = Vec2::new(image.width as f32, image.height as f32);
        let sum: f64 = (0..count)
            .map(|i| {
                let [r, g, b, _] = image.linear(i, picture.color_space);
                let at = (Vec2::new((i % width) as f32, (i / width) as f32) + 0.5) / size;
                f64::from(value([r, g, b], at))
            })
            .sum();
        (sum / count.max(1) as f64) as f32
    }

    /// A picture times a number.
    fn tinted(&mut self, from: &Parameters, picture: ImageTexture, scale: f32) -> Result<Value<Vec3>> {
        let picture = Value::Texture(self.part(Texture::Image(picture)));
        if scale == 1.0 {
            return Ok(picture);
        }
        let scale = self.finite(from, Vec3::splat(scale))?.x;
        let scaled = Texture::Scale { value: picture, factor: Value::Constant(scale) };
        Ok(Value::Texture(self.part(scaled)))
    }

    /// The axes of the current transform in the world, of unit length.
    fn axes(&self, from: &Parameters) -> Result<[Vec3; 3]> {
        let axis = |axis| self.direction(from, axis, FLAT);
        Ok([axis(Vec3::X)?, axis(Vec3::Y)?, axis(Vec3::Z)?])
    }

    /// The same, with a warning unless they are at right angles.
    fn square_axes(&mut self, from: &Parameters) -> Result<[Vec3; 3]> {
        let axes = self.axes(from)?;
        let turn = Mat3::from_cols(axes[0], axes[1], axes[2]);
        if !(turn * turn.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-3) {
            self.unsupported(Unsupported::ShearedLight, &from.spot);
        }
        // At right angles exactly, the last as it was and the middle one as near as it can be
        let [_, y, z] = axes.map(|axis| axis.as_dvec3());
        let side = turn.determinant().signum();
        let x = y.cross(z).try_normalize().ok_or_else(|| from.error(FLAT).help("give every axis a size"))?;
        Ok([x * f64::from(side), z.cross(x).normalize(), z].map(|axis| axis.as_vec3()))
    }
}

/// The rotation of an equal-area map whose right, middle and upper edge are at these directions, and its picture; left and right are
/// swapped where the directions are left-handed.
fn turned([x, y, z]: [Vec3; 3], picture: ImageTexture) -> (Mat3, ImageTexture) {
    let picture = ImageTexture { wrap: [Wrap::Octahedral; 2], ..picture };
    if Mat3::from_cols(x, y, z).determinant() < 0.0 {
        return (Mat3::from_cols(-x, y, z), flipped(picture));
    }
    (Mat3::from_cols(x, y, z), picture)
}

/// A picture with left and right swapped.
fn flipped(picture: ImageTexture) -> ImageTexture {
    let uv = UvTransform { scale: Vec2::new(-1.0, 1.0), rotate: 0.0, offset: Vec2::X };
    ImageTexture { uv, ..picture }
}

/// The factor that makes `has` what is wanted; 0 where there is nothing.
fn share(wanted: f32, has: f32) -> f32 {
    if has > 0.0 { (wanted / has).min(f32::MAX) } else { 0.0 }
}

fn luminance(rgb: [f32; 3]) -> f32 {
    rgb.iter().zip(LUMINANCE).map(|(channel, weight)| channel * weight).sum()
}

/// Cosine to the direction in the middle of an equal-area map (Clarberg 2008); from 0 down on the outer half.
fn height(at: Vec2) -> f32 {
    let inside = 1.0 - (2.0 * at - 1.0).abs().element_sum();
    if inside > 0.0 { 1.0 - (1.0 - inside) * (1.0 - inside) } else { 0.0 }
}
