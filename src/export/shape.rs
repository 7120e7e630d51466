//! `[[shape]]` and `[[instance]]`.

use super::Writer;
use super::keys::{Keys, matrix, number, one_key, pair, rows, vector};
use crate::scene::{Extent, Instance, Patch, Quadric, Shape, ShapeKind};
use glam::{Affine3A, Vec3};
use toml_edit::Value;

impl Writer<'_> {
    pub(super) fn shape(&self, shape: &Shape) -> Keys {
        let mut keys;
        match shape.kind {
            ShapeKind::Sphere { center, radius, pole, meridian } => {
                keys = round("sphere", center, radius);
                axes(&mut keys, "pole", pole, meridian);
            }
            ShapeKind::Disk { center, normal, radius, meridian } => {
                keys = round("disk", center, radius);
                axes(&mut keys, "normal", normal, meridian);
            }
            ShapeKind::Quad { origin, edge_u, edge_v } => {
                keys = Keys::of_kind("quad");
                keys.set("origin", vector(origin));
                keys.set("edge_u", vector(edge_u));
                keys.set("edge_v", vector(edge_v));
            }
            ShapeKind::Quadric(quadric) => keys = self::quadric(&quadric),
            ShapeKind::Patch(patch) => keys = self::patch(&patch),
        }
        keys.set("material", self.materials.refer(shape.material));
        placed(&mut keys, &shape.world_from_object, shape.at_close.as_ref());
        keys
    }

    pub(super) fn instance(&self, instance: &Instance) -> Keys {
        let mut keys = Keys::new();
        keys.set("mesh", self.meshes.refer(instance.mesh));
        keys.set("material", self.materials.refer(instance.material));
        placed(&mut keys, &instance.world_from_object, instance.at_close.as_ref());
        keys
    }
}

fn round(kind: &str, center: Vec3, radius: f32) -> Keys {
    let mut keys = Keys::of_kind(kind);
    keys.vector("center", center, Vec3::ZERO);
    keys.set("radius", number(radius));
    keys
}

/// An axis and a meridian, which the reader takes for +y and +x where they are left out.
fn axes(keys: &mut Keys, key: &str, axis: Vec3, meridian: Vec3) {
    keys.vector(key, axis, Vec3::Y);
    if axis != Vec3::Y || meridian != Vec3::X {
        keys.set("meridian", vector(meridian));
    }
}

fn quadric(quadric: &Quadric) -> Keys {
    let Quadric { extent, center, radius, axis, meridian, phi_max } = *quadric;
    let (kind, key) = match extent {
        Extent::Sphere { .. } => ("sphere", "pole"),
        Extent::Disk { .. } => ("disk", "normal"),
        Extent::Cylinder { .. } => ("cylinder", "axis"),
    };
    let mut keys = round(kind, center, radius);
    axes(&mut keys, key, axis, meridian);
    match extent {
        Extent::Sphere { z_min, z_max } => {
            keys.number("z_min", z_min, -radius);
            keys.number("z_max", z_max, radius);
        }
        Extent::Disk { inner_radius } => keys.number("inner_radius", inner_radius, 0.0),
        Extent::Cylinder { z_min, z_max } => {
            keys.set("z_min", number(z_min));
            keys.set("z_max", number(z_max));
        }
    }
    keys.number("phi_max", phi_max, 360.0);
    keys
}

fn patch(patch: &Patch) -> Keys {
    let mut keys = Keys::of_kind("patch");
    for (key, corner) in ["p00", "p10", "p01", "p11"].into_iter().zip(patch.corners) {
        keys.set(key, vector(corner));
    }
    if let Some(normals) = patch.normals {
        keys.set("normals", rows(normals.into_iter().map(vector)));
    }
    if patch.uvs != Patch::UVS {
        keys.set("uvs", rows(patch.uvs.into_iter().map(pair)));
    }
    keys
}

fn placed(keys: &mut Keys, open: &Affine3A, close: Option<&Affine3A>) {
    keys.transform("transform", open);
    if let Some(close) = close {
        keys.set("transform_close", [one_key("matrix", matrix(close))].into_iter().collect::<Value>());
    }
}
