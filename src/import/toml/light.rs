//! `[[light]]` and `[environment]`.

use super::camera::FOV_AXES;
use super::document::Node;
use super::keys::{ENVIRONMENT, LIGHT};
use super::reader::Reader;
use super::shape::{geometry, placed};
use super::text::Limits;
use super::transform::transform;
use super::value::color;
use super::view::View;
use crate::Result;
use crate::scene::{
    DirectionMapping, Emission, Environment, FovAxis, Handle, Light, LightKind, Material, Punctual,
    PunctualKind, Shape, Strength, Surface, Texture, Value, Wrap, facing, facing_upright,
};
use glam::{Mat3, Vec3};

/// How far a matrix may be from a rotation.
const ROTATION_TOLERANCE: f32 = 1e-4;

const MAPPINGS: [(&str, DirectionMapping); 2] =
    [("equirectangular", DirectionMapping::Equirectangular), ("equal_area", DirectionMapping::EqualArea)];

impl Reader<'_> {
    pub fn light(&mut self, index: usize, node: &Node) -> Result<()> {
        let name = format!("light {index}");
        let (view, kind) = View::of_kind(self.sources, node, name.clone(), &LIGHT)?;
        let strong = |key: &str| self.color(view.need(key)?, Limits::AtLeast(0.0));
        let intensity = || strong("intensity");
        let (kind, intensity, world_from_light) = match kind {
            "point" => {
                let mapping = view.choice_or("mapping", DirectionMapping::default(), &MAPPINGS)?;
                let position = view.need("position")?.vec3(Limits::Finite)?;
                let intensity = intensity()?;
                (LightKind::Point { position, mapping }, self.on_sphere(intensity, mapping), rotation(&view)?)
            }
            "projection" => {
                let (position, frame) = aimed(&view)?;
                let intensity = intensity()?;
                (self.projector(&view, position, &intensity)?, intensity, frame)
            }
            _ => match PunctualKind::named(kind) {
                Some(row) if row.shines.is_some() => {
                    let (position, frame) = aimed(&view)?;
                    (punctual(&view, row, position)?, intensity()?, frame)
                }
                Some(row) => (punctual(&view, row, Vec3::ZERO)?, strong("irradiance")?, from_afar(&view)?),
                None => return self.area_light(&view, kind, name),
            },
        };
        let strength = strength(&view)?;
        self.scene.lights.push(Light { kind, intensity, strength, world_from_light });
        Ok(())
    }

    /// A picture that is seen on a sphere goes on beyond its edges as the sphere does.
    fn on_sphere(&mut self, value: Value<Vec3>, mapping: DirectionMapping) -> Value<Vec3> {
        let Value::Texture(handle) = value else { return value };
        match &self.scene.textures[handle] {
            Texture::Image(image)
                if mapping == DirectionMapping::EqualArea && image.wrap == [Wrap::Repeat; 2] =>
            {
                let mut image = image.clone();
                image.wrap = [Wrap::Octahedral; 2];
                let name = format!("{} on a sphere", self.scene.textures.name(handle));
                Value::Texture(self.scene.textures.add(&name, Texture::Image(image)))
            }
            _ => value,
        }
    }

    fn projector(&self, view: &View<'_>, position: Vec3, intensity: &Value<Vec3>) -> Result<LightKind> {
        Ok(LightKind::Projection {
            position,
            fov: view.f32_or("fov", 40.0, Limits::Between(0.0, 180.0))?,
            fov_axis: view.choice_or("fov_axis", FovAxis::Vertical, &FOV_AXES)?,
            aspect: match view.get("aspect") {
                Some(item) => item.f32(Limits::Above(0.0))?,
                None => intensity.texture().map_or(1.0, |texture| self.aspect(texture)),
            },
        })
    }

    /// Width over height of the picture of a texture; 1 of others.
    fn aspect(&self, texture: Handle<Texture>) -> f32 {
        let Texture::Image(texture) = &self.scene.textures[texture] else { return 1.0 };
        let image = &self.scene.images[texture.image];
        image.width as f32 / image.height as f32
    }

    /// A shape that reflects nothing and shines.
    fn area_light(&mut self, view: &View<'_>, kind: &str, name: String) -> Result<()> {
        let radiance = self.color(view.need("radiance")?, Limits::AtLeast(0.0))?;
        let emission = Some(Emission { radiance, two_sided: view.bool_or("two_sided", false)? });
        let kind = geometry(view, kind)?;
        let (world_from_object, at_close) = placed(view)?;
        let surface = Surface::diffuse(Value::Constant(Vec3::ZERO));
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
        let mapping = view.choice_or("mapping", DirectionMapping::default(), &MAPPINGS)?;
        let radiance = self.on_sphere(radiance, mapping);
        let scale = view.f32_or("scale", 1.0, Limits::AtLeast(0.0))?;
        let world_from_environment = rotation(&view)?;
        self.scene.environment = Some(Environment { radiance, scale, world_from_environment, mapping });
        Ok(())
    }
}

/// What `rotate` or `transform` turns.
fn rotation(view: &View<'_>) -> Result<Mat3> {
    let Some(item) = view.either("rotate", "transform")? else { return Ok(Mat3::IDENTITY) };
    if view.get("rotate").is_some() {
        return Ok(Mat3::from_rotation_y(item.f32(Limits::Finite)?.to_radians()));
    }
    let map = transform(item)?;
    let turn = Mat3::from(map.matrix3);
    let turns = (turn * turn.transpose()).abs_diff_eq(Mat3::IDENTITY, ROTATION_TOLERANCE);
    if !turns || turn.determinant() < 0.0 || Vec3::from(map.translation) != Vec3::ZERO {
        return Err(item
            .error(format!("the `transform` of {} is more than a rotation", view.what))
            .help("use `rotate` steps only"));
    }
    Ok(turn)
}

fn strength(view: &View<'_>) -> Result<Strength> {
    Ok(match view.either("scale", "power")? {
        Some(item) if view.get("power").is_some() => Strength::Power(item.f32(Limits::AtLeast(0.0))?),
        Some(item) => Strength::Scale(item.f32(Limits::AtLeast(0.0))?),
        None => Strength::Scale(1.0),
    })
}

/// The rotation of `transform`, when it is there in place of `up` and the two keys that say where a light shines.
fn turned(view: &View<'_>, [a, b]: [&str; 2]) -> Result<Option<Mat3>> {
    if view.get("transform").is_none() {
        return Ok(None);
    }
    match [a, b, "up"].iter().find_map(|key| view.get(key)) {
        Some(item) => Err(item
            .error(format!(
                "{} has no meaning beside `transform`, which turns a light from −z with y up",
                item.name()
            ))
            .help("keep one or the other")),
        None => rotation(view).map(Some),
    }
}

/// The rotation of distant light.
fn from_afar(view: &View<'_>) -> Result<Mat3> {
    if let Some(frame) = turned(view, ["direction", "from"])? {
        return Ok(frame);
    }
    let along = view.need_either("direction", "from")?.direction()?;
    upright(view, if view.get("from").is_some() { -along } else { along })
}

/// Where a light is, and the rotation that aims it.
fn aimed(view: &View<'_>) -> Result<(Vec3, Mat3)> {
    let position = view.need("position")?.vec3(Limits::Finite)?;
    if let Some(frame) = turned(view, ["target", "direction"])? {
        return Ok((position, frame));
    }
    let item = view.need_either("target", "direction")?;
    let direction = if view.get("target").is_some() {
        let target = item.vec3(Limits::Finite)?;
        let along = (target.as_dvec3() - position.as_dvec3()).try_normalize();
        along.ok_or_else(|| item.error(format!("{} aims at its own position", view.what)))?.as_vec3()
    } else {
        item.direction()?
    };
    Ok((position, upright(view, direction)?))
}

/// The rotation of a light along a direction, with `up` up.
fn upright(view: &View<'_>, direction: Vec3) -> Result<Mat3> {
    match view.get("up") {
        Some(item) => facing(direction, item.direction()?).ok_or_else(|| {
            item.error("`up` is parallel to the direction of the light").help("turn one of them")
        }),
        None => Ok(facing_upright(direction)),
    }
}

/// A light of the table.
fn punctual(view: &View<'_>, kind: &'static PunctualKind, position: Vec3) -> Result<LightKind> {
    let mut numbers = [0.0; PunctualKind::MOST_NUMBERS];
    for (number, of) in numbers.iter_mut().zip(kind.numbers) {
        *number = view.f32_or(of.key, of.default, Limits::From(of.least, of.most))?;
    }
    Ok(LightKind::Punctual(Punctual { kind, position, numbers }))
}
