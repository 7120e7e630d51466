//! `LightSource` and `AreaLightSource`.

use super::lexer::Lexer;
use super::parameter::Type;
use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::spectrum::Role;
use super::state::Target;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::Limits;
use crate::scene::{
    Channel, ColorSpace, DirectionMapping, Environment, FovAxis, ImageTexture, Light, LightKind, Strength,
    TexelFilter, Texels, Texture, UvTransform, Value, Wrap, facing,
};
use glam::{DMat3, DVec3, Mat3, Vec2, Vec3};
use std::f32::consts::PI;
use std::rc::Rc;

/// The light of the shapes that follow.
#[derive(Debug, Clone)]
pub(super) struct AreaLight {
    pub radiance: Vec3,
    /// Emitted in all, for each shape, in place of what `radiance` gives.
    pub power: Option<f32>,
    pub two_sided: bool,
}

const KINDS: [&str; 6] = ["point", "spot", "goniometric", "projection", "distant", "infinite"];

/// What is wrong with a transform that turns an axis into nothing.
const FLAT: &str = "the transform of the light is flat";

impl Reader<'_> {
    pub(super) fn light_source(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let (kind, from) = self.of_kind(lexer, "LightSource", spot, Some(Target::Light))?;
        if self.state.maps[0] != self.state.maps[1] {
            self.unsupported(Unsupported::MovingLight, spot);
        }
        let light = match kind.as_str() {
            "point" => self.point(&from)?,
            "spot" => self.spot(&from)?,
            "distant" => self.distant(&from)?,
            "goniometric" => self.goniometric(&from)?,
            "projection" => self.projection(&from)?,
            "infinite" => {
                self.infinite(&from)?;
                return from.finish();
            }
            _ => return Err(self.unknown("LightSource", &kind, &from, &KINDS)),
        };
        self.scene.lights.push(light);
        from.finish()
    }

    /// A colour times `scale`. Where `name` is of type `spectrum` or `blackbody`, a scale of 1 is a luminance of 1.
    fn light_color(&mut self, from: &Parameters, name: &'static str) -> Result<Vec3> {
        let color = self.rgb_or(from, name, Role::Light, Vec3::ONE)?;
        Ok(color * from.float_or("scale", 1.0, Limits::AtLeast(0.0))?)
    }

    /// The factor of a photometric quantity: what is wanted over what a light of colour 1 has.
    fn photometric(&self, from: &Parameters, name: &'static str, has: f32) -> Result<f32> {
        // pbrt takes those that are not above 0 for none
        let wanted = from.float(name, Limits::Finite)?.filter(|wanted| *wanted > 0.0);
        Ok(wanted.map_or(1.0, |wanted| wanted / has))
    }

    fn point(&mut self, from: &Parameters) -> Result<Light> {
        let intensity = self.light_color(from, "I")? * self.photometric(from, "power", 4.0 * PI)?;
        let position = self.in_world(from.point_or("from", Vec3::ZERO)?).as_vec3();
        Ok(Light::point(self.finite(from, position)?, self.finite(from, intensity)?))
    }

    fn spot(&mut self, from: &Parameters) -> Result<Light> {
        let cone_angle = from.float_or("coneangle", 30.0, Limits::Between(0.0, 180.0))?;
        let falloff_angle = from.float_or("conedeltaangle", 5.0, Limits::AtLeast(0.0))?.min(cone_angle);
        let [edge, full] = [cone_angle, cone_angle - falloff_angle].map(|angle| angle.to_radians().cos());
        let solid_angle = 2.0 * PI * ((1.0 - full) + 0.5 * (full - edge));
        let intensity = self.light_color(from, "I")? * self.photometric(from, "power", solid_angle)?;
        let (at, target) = (from.point_or("from", Vec3::ZERO)?, from.point_or("to", Vec3::Z)?);
        let direction = self.direction(from, target - at, "the spot light aims at its own position")?;
        let position = self.in_world(at).as_vec3();
        let kind = LightKind::Spot { position: self.finite(from, position)?, cone_angle, falloff_angle };
        Ok(Light::new(kind, Value::Constant(self.finite(from, intensity)?)).along(direction))
    }

    fn distant(&mut self, from: &Parameters) -> Result<Light> {
        let irradiance = self.light_color(from, "L")? * self.photometric(from, "illuminance", 1.0)?;
        let (at, target) = (from.point_or("from", Vec3::ZERO)?, from.point_or("to", Vec3::Z)?);
        let direction = self.direction(from, target - at, "the light comes from where it goes to")?;
        Ok(Light::distant(direction, self.finite(from, irradiance)?))
    }

    /// A point light whose intensity is a picture of all directions.
    fn goniometric(&mut self, from: &Parameters) -> Result<Light> {
        let picture = self.light_picture(from, TexelFilter::Bilinear)?;
        let (world_from_light, mirrored) = self.sphere_turn(from)?;
        let position = self.in_world(Vec3::ZERO).as_vec3();
        let position = self.finite(from, position)?;
        let color = self.light_color(from, "I")?;
        let intensity = self.tinted(from, on_sphere(picture, mirrored), color)?;
        let kind = LightKind::Point { position, mapping: DirectionMapping::EqualArea };
        Ok(Light { strength: self.strength(from)?, world_from_light, ..Light::new(kind, intensity) })
    }

    /// A picture that is thrown along +z, with y up.
    fn projection(&mut self, from: &Parameters) -> Result<Light> {
        let picture = self.light_picture(from, TexelFilter::Nearest)?;
        let image = &self.scene.images[picture.image];
        let aspect = image.width as f32 / image.height as f32;
        let fov = from.float_or("fov", 90.0, Limits::Between(0.0, 180.0))?;
        let position = self.in_world(Vec3::ZERO).as_vec3();
        let position = self.finite(from, position)?;
        let [right, up, along] = self.axes(from)?;
        let world_from_light =
            facing(along, up).ok_or_else(|| from.error(FLAT).help("give every axis a size"))?;
        // Where +x of pbrt is to the left, seen along the light, the picture is mirrored
        let picture = if right.dot(along.cross(up)) < 0.0 { flipped(picture) } else { picture };
        let color = Vec3::splat(from.float_or("scale", 1.0, Limits::AtLeast(0.0))?);
        let intensity = self.tinted(from, picture, color)?;
        let kind = LightKind::Projection { position, fov, fov_axis: FovAxis::Smaller, aspect };
        Ok(Light { strength: self.strength(from)?, world_from_light, ..Light::new(kind, intensity) })
    }

    /// What `power` asks for, or a factor of 1.
    fn strength(&self, from: &Parameters) -> Result<Strength> {
        let power = from.float("power", Limits::Finite)?.filter(|power| *power > 0.0);
        Ok(power.map_or(Strength::Scale(1.0), Strength::Power))
    }

    /// The picture of a light.
    fn light_picture(&mut self, from: &Parameters, filter: TexelFilter) -> Result<ImageTexture> {
        let (spot, path) = from.file("filename")?.ok_or_else(|| from.missing("filename", Type::String))?;
        let (image, _) = self.image(&spot, &path)?;
        let color_space = match self.scene.images[image].texels {
            Texels::Rgba8(_) | Texels::Rgba16(_) => ColorSpace::Srgb,
            Texels::RgbaF32(_) => ColorSpace::Linear,
        };
        let (wrap, uv, channel) = ([Wrap::Clamp; 2], UvTransform::default(), Channel::Rgb);
        Ok(ImageTexture { image, filter, wrap, uv, color_space, channel, scale: 1.0, invert: false })
    }

    /// A picture times a colour.
    fn tinted(&mut self, from: &Parameters, picture: ImageTexture, color: Vec3) -> Result<Value<Vec3>> {
        let a = Value::Texture(self.part(Texture::Image(picture)));
        let b = Value::Constant(self.finite(from, color)?);
        Ok(Value::Texture(self.part(Texture::Multiply { a, b })))
    }

    /// The axes of the current transform in the world, of unit length.
    fn axes(&self, from: &Parameters) -> Result<[Vec3; 3]> {
        let axis = |axis| self.direction(from, axis, FLAT);
        Ok([axis(Vec3::X)?, axis(Vec3::Y)?, axis(Vec3::Z)?])
    }

    /// From the directions of an equal-area picture to those of the world, and whether it is mirrored along x before. pbrt has
    /// +z in the middle of the picture and +y below it, where dapple has +y and -z.
    fn sphere_turn(&mut self, from: &Parameters) -> Result<(Mat3, bool)> {
        let [x, y, z] = self.axes(from)?;
        let turn = Mat3::from_cols(x, y, z);
        if !(turn * turn.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-3) {
            self.unsupported(Unsupported::ShearedLight, &from.spot);
        }
        let mirrored = turn.determinant() < 0.0;
        let turn = if mirrored { Mat3::from_cols(-x, y, z) } else { turn };
        Ok((turn * Mat3::from_rotation_x(0.5 * PI), mirrored))
    }

    /// Light from all directions. Colours add up.
    fn infinite(&mut self, from: &Parameters) -> Result<()> {
        if from.array::<12>("portal", Type::Point3)?.is_some() {
            self.unsupported(Unsupported::Portal, &from.spot);
        }
        if from.file("filename")?.is_some() {
            return self.infinite_image(from);
        }
        let radiance = self.light_color(from, "L")? * self.photometric(from, "illuminance", PI)?;
        let before = match self.scene.environment.as_ref().map(|environment| environment.radiance) {
            Some(Value::Constant(color)) => color,
            Some(Value::Texture(_)) => {
                self.unsupported(Unsupported::SecondEnvironment, &from.spot);
                return Ok(());
            }
            None => Vec3::ZERO,
        };
        let radiance = Value::Constant(self.finite(from, before + radiance)?);
        self.scene.environment = Some(Environment::new(radiance));
        Ok(())
    }

    /// A picture of all directions, whose texels are looked up as they are.
    fn infinite_image(&mut self, from: &Parameters) -> Result<()> {
        if self.scene.environment.is_some() {
            self.unsupported(Unsupported::SecondEnvironment, &from.spot);
        }
        if from.float("illuminance", Limits::Finite)?.is_some_and(|wanted| wanted > 0.0) {
            self.unsupported(Unsupported::ImageIlluminance, &from.spot);
        }
        let picture = self.light_picture(from, TexelFilter::Nearest)?;
        let (world_from_environment, mirrored) = self.sphere_turn(from)?;
        let radiance = Value::Texture(self.part(Texture::Image(on_sphere(picture, mirrored))));
        let scale = from.float_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let mapping = DirectionMapping::EqualArea;
        self.scene.environment = Some(Environment { radiance, scale, world_from_environment, mapping });
        Ok(())
    }

    pub(super) fn area_light_source(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let (kind, from) = self.of_kind(lexer, "AreaLightSource", spot, Some(Target::Light))?;
        if kind != "diffuse" {
            return Err(self.unknown("AreaLightSource", &kind, &from, &["diffuse"]));
        }
        let radiance = self.light_color(&from, "L")?;
        let radiance = self.finite(&from, radiance)?;
        let two_sided = from.bool_or("twosided", false)?;
        let power = from.float("power", Limits::Finite)?.filter(|power| *power > 0.0);
        if let Some((spot, path)) = from.file("filename")? {
            self.need_file(&spot, &path)?;
            self.unsupported(Unsupported::LampImage, &from.spot);
        }
        from.finish()?;
        self.state.area_light = Some(Rc::new(AreaLight { radiance, power, two_sided }));
        Ok(())
    }

    /// A point in the world.
    fn in_world(&self, point: Vec3) -> DVec3 {
        self.state.maps[0].transform_point3(point.as_dvec3())
    }

    /// A direction in the world, of unit length. Normals of planes of light turn with the inverse, as in pbrt, which is the same
    /// for turns and even scales.
    pub(super) fn direction(&self, from: &Parameters, along: Vec3, zero: &str) -> Result<Vec3> {
        let turn: DMat3 = self.state.maps[0].matrix3;
        let direction = (turn * along.as_dvec3()).try_normalize();
        direction
            .map(|direction| direction.as_vec3())
            .ok_or_else(|| from.error(zero).help("move `from` or `to`"))
    }

    fn finite(&self, from: &Parameters, value: Vec3) -> Result<Vec3> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(from.error(format!("{} is too bright or too far away", from.what)).help("use smaller numbers"))
    }
}

/// A picture that goes on beyond its edges as a sphere does.
fn on_sphere(picture: ImageTexture, mirrored: bool) -> ImageTexture {
    let picture = ImageTexture { wrap: [Wrap::Octahedral; 2], ..picture };
    if mirrored { flipped(picture) } else { picture }
}

/// A picture with left and right swapped.
fn flipped(picture: ImageTexture) -> ImageTexture {
    let uv = UvTransform { scale: Vec2::new(-1.0, 1.0), rotate: 0.0, offset: Vec2::X };
    ImageTexture { uv, ..picture }
}
