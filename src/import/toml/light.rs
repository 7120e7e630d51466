//! `[[light]]` and `[environment]`.

use super::document::Node;
use super::keys::{ENVIRONMENT, LIGHT};
use super::reader::Reader;
use super::shape::{geometry, placed};
use super::text::Limits;
use super::transform::transform;
use super::value::color;
use super::view::View;
use crate::Result;
use crate::scene::{Emission, Environment, Light, Material, Shape, Surface, Value};
use glam::{Mat3, Vec3};

/// How far a matrix may be from a rotation.
const ROTATION_TOLERANCE: f32 = 1e-4;

impl Reader<'_> {
    pub fn light(&mut self, index: usize, node: &Node) -> Result<()> {
        let name = format!("light {index}");
        let (view, kind) = View::of_kind(self.sources, node, name.clone(), &LIGHT)?;
        let power = |key| color(view.need(key)?, Limits::AtLeast(0.0));
        let light = match kind {
            "point" => Light::Point {
                position: view.need("position")?.vec3(Limits::Finite)?,
                intensity: power("intensity")?,
            },
            "spot" => spot(&view, power("intensity")?)?,
            "distant" => {
                let item = view.need_either("direction", "from")?;
                let along = item.direction()?;
                let direction = if view.get("from").is_some() { -along } else { along };
                Light::Distant { direction, irradiance: power("irradiance")? }
            }
            _ => return self.area_light(&view, kind, name),
        };
        self.scene.lights.push(light);
        Ok(())
    }

    /// A shape that reflects nothing and shines.
    fn area_light(&mut self, view: &View<'_>, kind: &str, name: String) -> Result<()> {
        let radiance = self.color(view.need("radiance")?, Limits::AtLeast(0.0))?;
        let emission = Some(Emission { radiance, two_sided: view.bool_or("two_sided", false)? });
        let kind = geometry(view, kind)?;
        let (world_from_object, at_close) = placed(view)?;
        let surface = Surface::Diffuse { color: Value::Constant(Vec3::ZERO) };
        let material = self.scene.materials.add(name.as_str(), Material::new(surface, emission));
        self.scene.shapes.push(Shape { name, kind, material, world_from_object, at_close });
        Ok(())
    }

    pub fn environment(&mut self, node: &Node) -> Result<()> {
        let view = View::new(self.sources, node, "[environment]".into(), ENVIRONMENT)?;
        let item = view.need_either("color", "texture")?;
        let radiance = match view.get("texture") {
            Some(name) => Value::Texture(self.textures.find(name)?),
            None => Value::Constant(color(item, Limits::AtLeast(0.0))?),
        };
        let scale = view.f32_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let world_from_environment = match view.either("rotate", "transform")? {
            None => Mat3::IDENTITY,
            Some(item) if view.get("rotate").is_some() => {
                Mat3::from_rotation_y(item.f32(Limits::Finite)?.to_radians())
            }
            Some(item) => {
                let map = transform(item)?;
                let turn = Mat3::from(map.matrix3);
                let turns = (turn * turn.transpose()).abs_diff_eq(Mat3::IDENTITY, ROTATION_TOLERANCE);
                if !turns || turn.determinant() < 0.0 || Vec3::from(map.translation) != Vec3::ZERO {
                    return Err(item
                        .error("the `transform` of the environment is more than a rotation")
                        .help("use `rotate` steps only"));
                }
                turn
            }
        };
        self.scene.environment = Some(Environment { radiance, scale, world_from_environment });
        Ok(())
    }
}

fn spot(view: &View<'_>, intensity: Vec3) -> Result<Light> {
    let position = view.need("position")?.vec3(Limits::Finite)?;
    let item = view.need_either("target", "direction")?;
    let direction = if view.get("target").is_some() {
        let target = item.vec3(Limits::Finite)?;
        let along = (target.as_dvec3() - position.as_dvec3()).try_normalize();
        along.ok_or_else(|| item.error("the spot light aims at its own position"))?.as_vec3()
    } else {
        item.direction()?
    };
    let cone_angle = view.f32_or("cone_angle", 30.0, Limits::Between(0.0, 180.0))?;
    let falloff_angle = view.f32_or("falloff_angle", cone_angle.min(5.0), Limits::From(0.0, cone_angle))?;
    Ok(Light::Spot { position, direction, intensity, cone_angle, falloff_angle })
}
