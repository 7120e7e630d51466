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
use crate::scene::{Environment, Light, LightKind, Value};
use glam::{DMat3, DVec3, Vec3};
use std::f32::consts::PI;
use std::rc::Rc;

/// The light of the shapes that follow.
#[derive(Debug, Clone)]
pub(super) struct AreaLight {
    pub radiance: Value<Vec3>,
    /// Mean luminance of what `power` is set against: that of an image, or 1.
    pub mean: f32,
    /// Emitted in all, for each shape, in place of what `radiance` gives.
    pub power: Option<f32>,
    pub two_sided: bool,
}

const KINDS: [&str; 6] = ["point", "spot", "goniometric", "projection", "distant", "infinite"];

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
    pub(super) fn light_color(&mut self, from: &Parameters, name: &'static str) -> Result<Vec3> {
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
        let kind = LightKind::spot(self.finite(from, position)?, cone_angle, falloff_angle);
        Ok(Light::new(kind, Value::Constant(self.finite(from, intensity)?)).along(direction))
    }

    fn distant(&mut self, from: &Parameters) -> Result<Light> {
        let irradiance = self.light_color(from, "L")? * self.photometric(from, "illuminance", 1.0)?;
        let (at, target) = (from.point_or("from", Vec3::ZERO)?, from.point_or("to", Vec3::Z)?);
        let direction = self.direction(from, target - at, "the light comes from where it goes to")?;
        Ok(Light::distant(direction, self.finite(from, irradiance)?))
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

    pub(super) fn area_light_source(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let (kind, from) = self.of_kind(lexer, "AreaLightSource", spot, Some(Target::Light))?;
        if kind != "diffuse" {
            return Err(self.unknown("AreaLightSource", &kind, &from, &["diffuse"]));
        }
        let (radiance, mean) = if from.file("filename")?.is_some() {
            self.lamp_image(&from)?
        } else {
            let color = self.light_color(&from, "L")?;
            (Value::Constant(self.finite(&from, color)?), 1.0)
        };
        let two_sided = from.bool_or("twosided", false)?;
        let power = from.float("power", Limits::Finite)?.filter(|power| *power > 0.0);
        from.finish()?;
        self.state.area_light = Some(Rc::new(AreaLight { radiance, mean, power, two_sided }));
        Ok(())
    }

    /// A point in the world.
    pub(super) fn in_world(&self, point: Vec3) -> DVec3 {
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

    pub(super) fn finite(&self, from: &Parameters, value: Vec3) -> Result<Vec3> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(from.error(format!("{} is too bright or too far away", from.what)).help("use smaller numbers"))
    }
}
