//! Keys of analytic shapes, and of lamps that have their form.

use super::Kinds;

const SPHERE: &[&str] =
    &["center", "radius", "pole", "meridian", "z_min", "z_max", "phi_max", "displacement"];
const DISK: &[&str] = &["center", "normal", "radius", "meridian", "inner_radius", "phi_max"];
const CYLINDER: &[&str] = &["center", "radius", "axis", "meridian", "z_min", "z_max", "phi_max"];
const PATCH: &[&str] = &["p00", "p10", "p01", "p11", "normals", "uvs"];
const QUAD: &[&str] = &["origin", "center", "edge_u", "edge_v", "displacement"];

pub(in super::super) const SHAPE: Kinds = Kinds {
    common: &["kind", "material", "transform", "transform_close"],
    kinds: &[("sphere", SPHERE), ("disk", DISK), ("quad", QUAD), ("cylinder", CYLINDER), ("patch", PATCH)],
};

pub(super) const SPHERE_LIGHT: &[&str] = &[
    "center",
    "radius",
    "pole",
    "meridian",
    "z_min",
    "z_max",
    "phi_max",
    "radiance",
    "two_sided",
    "transform",
    "transform_close",
];
pub(super) const DISK_LIGHT: &[&str] = &[
    "center",
    "normal",
    "radius",
    "meridian",
    "inner_radius",
    "phi_max",
    "radiance",
    "two_sided",
    "transform",
    "transform_close",
];
pub(super) const QUAD_LIGHT: &[&str] =
    &["origin", "center", "edge_u", "edge_v", "radiance", "two_sided", "transform", "transform_close"];
pub(super) const CYLINDER_LIGHT: &[&str] = &[
    "center",
    "radius",
    "axis",
    "meridian",
    "z_min",
    "z_max",
    "phi_max",
    "radiance",
    "two_sided",
    "transform",
    "transform_close",
];
pub(super) const PATCH_LIGHT: &[&str] =
    &["p00", "p10", "p01", "p11", "normals", "uvs", "radiance", "two_sided", "transform", "transform_close"];
