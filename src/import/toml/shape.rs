//! `[[shape]]` and `[[instance]]`.

use super::document::Node;
use super::keys::{INSTANCE, SHAPE};
use super::reader::Reader;
use super::text::Limits;
use super::transform::transform;
use super::view::View;
use crate::Result;
use crate::scene::{Instance, Shape, ShapeKind};
use glam::{Affine3A, Vec3};

/// Sine of the angle below which two directions count as parallel.
const MIN_SINE: f64 = 1e-6;

impl Reader<'_> {
    pub fn shape(&mut self, index: usize, node: &Node) -> Result<()> {
        let name = format!("shape {index}");
        let (view, kind) = View::of_kind(self.sources, node, name.clone(), &SHAPE)?;
        let kind = geometry(&view, kind)?;
        let (world_from_object, at_close) = placed(&view)?;
        let shape = Shape {
            kind,
            world_from_object,
            at_close,
            material: self.materials.find(view.need("material")?)?,
            name,
        };
        match view.get("displacement") {
            Some(item) => {
                let displacement = self.displacement(item)?;
                if shape.at_close.is_some() {
                    return Err(item
                        .error("a shape that moves cannot be displaced")
                        .help("displace a mesh, and move its instance"));
                }
                self.displaced_shape(shape, displacement);
            }
            None => self.scene.shapes.push(shape),
        }
        Ok(())
    }

    pub fn instance(&mut self, index: usize, node: &Node) -> Result<()> {
        let name = format!("instance {index}");
        let view = View::new(self.sources, node, name.clone(), INSTANCE)?;
        let mesh = self.meshes.find(view.need("mesh")?)?;
        let parts = &self.scene.meshes[mesh].parts;
        let material = match (view.get("material"), parts.first().and_then(|part| part.material)) {
            (Some(item), _) => self.materials.find(item)?,
            // No part asks for it, so that of any part will do.
            (None, Some(first)) if parts.iter().all(|part| part.material.is_some()) => first,
            (None, _) => {
                let bare = parts.iter().find(|part| part.material.is_none() && !part.name.is_empty());
                let why = bare.map_or(String::new(), |part| {
                    format!(", and part `{}` of the mesh has none", super::text::shown(&part.name))
                });
                return Err(view.error(format!("`material` is missing in {}{why}", view.what)));
            }
        };
        let (world_from_object, at_close) = placed(&view)?;
        self.scene.instances.push(Instance { name, mesh, material, world_from_object, at_close });
        Ok(())
    }
}

/// The `transform` of an object, and its `transform_close`.
pub(super) fn placed(view: &View<'_>) -> Result<(Affine3A, Option<Affine3A>)> {
    let open = view.get("transform").map_or(Ok(Affine3A::IDENTITY), transform)?;
    let Some(item) = view.get("transform_close") else { return Ok((open, None)) };
    let close = transform(item)?;
    let mirrors = |map: &Affine3A| map.as_daffine3().matrix3.determinant() < 0.0;
    if mirrors(&open) != mirrors(&close) {
        let message = "of `transform` and `transform_close` only one mirrors";
        return Err(item.error(message).help("a thing that moves cannot be turned inside out"));
    }
    Ok((open, Some(close)))
}

/// The keys of a sphere, a disk or a quad.
pub(super) fn geometry(view: &View<'_>, kind: &str) -> Result<ShapeKind> {
    match kind {
        "sphere" => {
            let [pole, meridian] = axes(view, "pole")?;
            let radius = view.need("radius")?.f32(Limits::Above(0.0))?;
            Ok(ShapeKind::Sphere { center: view.vec3_or("center", Vec3::ZERO)?, radius, pole, meridian })
        }
        "disk" => {
            let [normal, meridian] = axes(view, "normal")?;
            let radius = view.need("radius")?.f32(Limits::Above(0.0))?;
            Ok(ShapeKind::Disk { center: view.vec3_or("center", Vec3::ZERO)?, normal, radius, meridian })
        }
        _ => quad(view),
    }
}

/// An axis (default +y) and a meridian across it (default +x, or +y when the axis is along x), both unit vectors.
pub(super) fn axes(view: &View<'_>, key: &str) -> Result<[Vec3; 2]> {
    let axis = view.get(key).map_or(Ok(Vec3::Y), |item| item.direction())?.as_dvec3();
    let across = |v: Vec3| {
        let v = v.as_dvec3();
        (v - axis * v.dot(axis) / axis.length_squared())
            .try_normalize()
            .filter(|_| v.cross(axis).length() > MIN_SINE)
    };
    let meridian = match view.get("meridian") {
        Some(item) => across(item.direction()?).ok_or_else(|| {
            item.error(format!("`meridian` is parallel to `{key}`")).help("turn one of them")
        })?,
        None => across(Vec3::X).or(across(Vec3::Y)).unwrap_or_default(),
    };
    Ok([axis.as_vec3(), meridian.as_vec3()])
}

fn quad(view: &View<'_>) -> Result<ShapeKind> {
    let [u, v] = [view.need("edge_u")?, view.need("edge_v")?];
    let [edge_u, edge_v] = [u.vec3(Limits::Finite)?, v.vec3(Limits::Finite)?];
    for (item, edge) in [(u, edge_u), (v, edge_v)] {
        if edge == Vec3::ZERO {
            return Err(item.error(format!("{} is the zero vector", item.name())));
        }
    }
    let [du, dv] = [edge_u.as_dvec3(), edge_v.as_dvec3()];
    if du.cross(dv).length() <= MIN_SINE * du.length() * dv.length() {
        return Err(v.error("`edge_v` is parallel to `edge_u`, so that the quad has no area"));
    }
    let corner = view.need_either("origin", "center")?;
    let point = corner.vec3(Limits::Finite)?;
    let origin = if view.get("center").is_some() { point - 0.5 * (edge_u + edge_v) } else { point };
    if !origin.is_finite() {
        return Err(corner.error("the corner of the quad is too far away"));
    }
    Ok(ShapeKind::Quad { origin, edge_u, edge_v })
}
