//! `[[shape]]` and `[[instance]]`.

use super::document::Node;
use super::keys::{INSTANCE, SHAPE};
use super::reader::Reader;
use super::text::Limits;
use super::transform::transform;
use super::view::{Item, View};
use crate::Result;
use crate::scene::{Extent, Instance, Patch, Quadric, Shape, ShapeKind, is_unit};
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
                if let ShapeKind::Quadric(_) = shape.kind {
                    return Err(item
                        .error("a part of a sphere cannot be displaced")
                        .help("displace all of it, or a mesh"));
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
        if let Some(file) = view.get("file") {
            return self.model_instance(&view, file);
        }
        if let Some(item) = ["time", "variant"].iter().find_map(|key| view.get(key)) {
            return Err(item
                .error(format!("{} needs a `file`", item.name()))
                .help("name a glTF model in `file`"));
        }
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

/// The keys of a shape.
pub(super) fn geometry(view: &View<'_>, kind: &str) -> Result<ShapeKind> {
    match kind {
        "sphere" => sphere(view),
        "disk" => disk(view),
        "cylinder" => cylinder(view),
        "patch" => patch(view),
        _ => quad(view),
    }
}

/// Centre and radius, and the angle up to which a shape about an axis is there.
struct Round {
    center: Vec3,
    radius: f32,
    phi_max: f32,
}

fn round(view: &View<'_>) -> Result<Round> {
    Ok(Round {
        center: view.vec3_or("center", Vec3::ZERO)?,
        radius: view.need("radius")?.f32(Limits::Above(0.0))?,
        phi_max: view.f32_or("phi_max", 360.0, Limits::AboveUpTo(0.0, 360.0))?,
    })
}

fn sphere(view: &View<'_>) -> Result<ShapeKind> {
    let [pole, meridian] = axes(view, "pole")?;
    let Round { center, radius, phi_max } = round(view)?;
    let [z_min, z_max] = heights(view, Some([-radius, radius]))?;
    if phi_max == 360.0 && z_min == -radius && z_max == radius {
        return Ok(ShapeKind::Sphere { center, radius, pole, meridian });
    }
    let extent = Extent::Sphere { z_min, z_max };
    Ok(ShapeKind::Quadric(Quadric { extent, center, radius, axis: pole, meridian, phi_max }))
}

fn disk(view: &View<'_>) -> Result<ShapeKind> {
    let [normal, meridian] = axes(view, "normal")?;
    let Round { center, radius, phi_max } = round(view)?;
    let inner_radius = view.f32_or("inner_radius", 0.0, Limits::AtLeast(0.0))?;
    if let Some(item) = view.get("inner_radius").filter(|_| inner_radius >= radius) {
        return Err(item.refuse(inner_radius, format!("below the radius, {radius}")));
    }
    if phi_max == 360.0 && inner_radius == 0.0 {
        return Ok(ShapeKind::Disk { center, normal, radius, meridian });
    }
    let extent = Extent::Disk { inner_radius };
    Ok(ShapeKind::Quadric(Quadric { extent, center, radius, axis: normal, meridian, phi_max }))
}

fn cylinder(view: &View<'_>) -> Result<ShapeKind> {
    let [axis, meridian] = axes(view, "axis")?;
    let Round { center, radius, phi_max } = round(view)?;
    let [z_min, z_max] = heights(view, None)?;
    let extent = Extent::Cylinder { z_min, z_max };
    Ok(ShapeKind::Quadric(Quadric { extent, center, radius, axis, meridian, phi_max }))
}

/// `z_min` and `z_max`: within `range`, whose ends are their defaults; without, both are needed.
fn heights(view: &View<'_>, range: Option<[f32; 2]>) -> Result<[f32; 2]> {
    let limits = range.map_or(Limits::Finite, |[low, high]| Limits::From(low, high));
    let height = |key: &str, default: Option<f32>| match (view.get(key), default) {
        (None, Some(default)) => Ok(default),
        _ => view.need(key)?.f32(limits),
    };
    let z_min = height("z_min", range.map(|[low, _]| low))?;
    let z_max = height("z_max", range.map(|[_, high]| high))?;
    if z_min >= z_max {
        let item = view.get("z_max").or(view.get("z_min"));
        let message = format!("`z_min`, {z_min}, is not below `z_max`, {z_max}");
        return Err(item.map_or_else(|| view.error(message.clone()), |item| item.error(message.clone())));
    }
    Ok([z_min, z_max])
}

/// An axis (default +y) and a meridian across it (default +x, or +y when the axis is along x), both unit vectors.
pub(super) fn axes(view: &View<'_>, key: &str) -> Result<[Vec3; 2]> {
    let axis = view.get(key).map_or(Ok(Vec3::Y), |item| item.direction())?.as_dvec3();
    let across = |v: Vec3| {
        let v = v.as_dvec3();
        // What is at a right angle within rounding stays as it is
        if is_unit(v.as_vec3()) && v.dot(axis).abs() <= 2.0 * f64::from(f32::EPSILON) {
            return Some(v);
        }
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

fn patch(view: &View<'_>) -> Result<ShapeKind> {
    let corner = |key: &str| view.need(key)?.vec3(Limits::Finite);
    let corners = [corner("p00")?, corner("p10")?, corner("p01")?, corner("p11")?];
    let mut patch = Patch::new(corners);
    if !patch.has_area() {
        let message = format!("{} has no area: its corners are on one line, or `p10` is `p01`", view.what);
        return Err(view.error(message));
    }
    if let Some(item) = view.get("normals") {
        patch.normals = Some(four(item, |normal| normal.direction())?);
    }
    if let Some(item) = view.get("uvs") {
        patch.uvs = four(item, |uv| uv.vec2(Limits::Finite))?;
    }
    Ok(ShapeKind::Patch(patch))
}

/// A value for each corner of a patch: p00, p10, p01, p11.
fn four<T: Copy>(item: Item<'_>, read: impl Fn(Item<'_>) -> Result<T>) -> Result<[T; 4]> {
    let expected = "a list of 4 values, those of p00, p10, p01 and p11";
    let values = item.list(expected)?.map(read).collect::<Result<Vec<_>>>()?;
    <[T; 4]>::try_from(values).map_err(|_| item.mismatch(expected))
}
