//! What kernels read of analytic shapes, and the boxes around these.

use super::Prepared;
use super::bounds::{Bounds, disk_bounds, ellipsoid_bounds, transformed, tube_bounds, widened};
use crate::layout::{
    BilinearPatch, INSTANCE_CYLINDER, INSTANCE_DISK, INSTANCE_DISK_PART, INSTANCE_MESH, INSTANCE_PATCH,
    INSTANCE_SOUP, INSTANCE_SPHERE, INSTANCE_SPHERE_PART, Instance, Motion, NONE, PatchNormals, QuadricPart,
    Record,
};
use crate::scene::{Extent, Patch, Quadric, ShapeKind};
use glam::{Affine3A, Vec3};
use std::f64::consts::PI;

/// Instances with a [`QuadricPart`].
pub(super) const PARTS: [u32; 3] = [INSTANCE_SPHERE_PART, INSTANCE_DISK_PART, INSTANCE_CYLINDER];

/// z beyond all of a unit sphere.
const BEYOND: f32 = 2.0;

pub(super) fn instance_kind(kind: &ShapeKind, moves: bool) -> u32 {
    match kind {
        ShapeKind::Sphere { .. } => INSTANCE_SPHERE,
        ShapeKind::Disk { .. } => INSTANCE_DISK,
        ShapeKind::Quad { .. } if moves => INSTANCE_MESH,
        ShapeKind::Quad { .. } => INSTANCE_SOUP,
        ShapeKind::Quadric(quadric) => match quadric.extent {
            Extent::Sphere { .. } => INSTANCE_SPHERE_PART,
            Extent::Disk { .. } => INSTANCE_DISK_PART,
            Extent::Cylinder { .. } => INSTANCE_CYLINDER,
        },
        ShapeKind::Patch(_) => INSTANCE_PATCH,
    }
}

/// What there is of the unit shape of a quadric.
pub(super) fn part(quadric: &Quadric) -> QuadricPart {
    let radius = f64::from(quadric.radius);
    let turn = (f64::from(quadric.phi_max) / 360.0) as f32;
    let whole = QuadricPart {
        z_min: -BEYOND,
        z_max: BEYOND,
        inner_radius: 0.0,
        turn,
        v_min: 0.0,
        v_range: 1.0,
        spare: [0.0; 2],
    };
    match quadric.extent {
        Extent::Sphere { z_min, z_max } => {
            let [low, high] = [z_min, z_max].map(|z| (f64::from(z) / radius).clamp(-1.0, 1.0));
            let [v_min, v_max] = [low, high].map(|z| 0.5 + z.asin() / PI);
            QuadricPart {
                z_min: if low > -1.0 { low as f32 } else { -BEYOND },
                z_max: if high < 1.0 { high as f32 } else { BEYOND },
                v_min: v_min as f32,
                v_range: (v_max - v_min) as f32,
                ..whole
            }
        }
        Extent::Disk { inner_radius } => {
            let inner = (f64::from(inner_radius) / radius) as f32;
            QuadricPart { inner_radius: inner, v_range: 1.0 - inner, ..whole }
        }
        Extent::Cylinder { .. } => QuadricPart { z_min: 0.0, z_max: 1.0, ..whole },
    }
}

/// Scale of a shape in its object space, up to a factor of 2.
pub(super) fn size(kind: &ShapeKind) -> Vec3 {
    let ShapeKind::Patch(patch) = kind else { return Vec3::ONE };
    Vec3::splat(patch_size(patch))
}

/// A power of two from which no coordinate of a corner is larger than 2.
fn patch_size(patch: &Patch) -> f32 {
    let most = patch.corners.iter().fold(0.0, |most: f32, corner| most.max(corner.abs().max_element()));
    most.log2().floor().clamp(-100.0, 100.0).exp2()
}

/// Appends what a shape has beside its instance. Gives where, or NONE.
pub(super) fn push_words(kind: &ShapeKind, words: &mut Vec<[u32; 4]>) -> u32 {
    let first = words.len() as u32;
    match kind {
        ShapeKind::Quadric(quadric) => words.extend(bytemuck::cast::<_, [[u32; 4]; 2]>(part(quadric))),
        ShapeKind::Patch(patch) => {
            let size = patch_size(patch);
            let [p00, p10, p01, p11] = patch.corners.map(|corner| (corner / size).to_array());
            let [uv00, uv10, uv01, uv11] = patch.uvs.map(|uv| uv.to_array());
            let has_normals = u32::from(patch.normals.is_some());
            let (spare01, spare11) = (0.0, 0.0);
            let record = BilinearPatch {
                p00,
                size,
                p10,
                has_normals,
                p01,
                spare01,
                p11,
                spare11,
                uv00,
                uv10,
                uv01,
                uv11,
            };
            words.extend(bytemuck::cast::<_, [[u32; 4]; 6]>(record));
            if let Some(normals) = patch.normals {
                let [n00, n10, n01, n11] = normals.map(|normal| normal.to_array());
                let normals = PatchNormals { n00, n10, n01, n11, ..PatchNormals::default() };
                words.extend(bytemuck::cast::<_, [[u32; 4]; 4]>(normals));
            }
        }
        _ => return NONE,
    }
    first
}

/// The words lie behind the instances and the motions, when all of these are known.
pub(super) fn place_words(out: &mut Prepared) {
    let before = out.instances.len() as u32 * Instance::WORDS + out.motions.len() as u32 * Motion::WORDS;
    let has_words =
        |instance: &&mut Instance| PARTS.contains(&instance.kind) || instance.kind == INSTANCE_PATCH;
    out.instances.iter_mut().filter(has_words).for_each(|instance| instance.root += before);
}

/// A box around a shape in its object space.
pub(super) fn object_bounds(kind: &ShapeKind) -> Bounds {
    match kind {
        ShapeKind::Disk { .. } => Bounds { min: Vec3::new(-1.0, -1.0, 0.0), max: Vec3::new(1.0, 1.0, 0.0) },
        ShapeKind::Quadric(quadric) => part_bounds(quadric),
        ShapeKind::Patch(patch) => {
            let mut bounds = Bounds::default();
            patch.corners.iter().for_each(|corner| bounds.add(*corner));
            bounds
        }
        _ => Bounds { min: Vec3::NEG_ONE, max: Vec3::ONE },
    }
}

fn part_bounds(quadric: &Quadric) -> Bounds {
    let part = part(quadric);
    let (low, high) = (part.z_min.max(-1.0), part.z_max.min(1.0));
    let around = |z: f32| (1.0 - z * z).max(0.0).sqrt();
    let (inner, outer, low, high) = match quadric.extent {
        Extent::Sphere { .. } => {
            let widest = if low < 0.0 && high > 0.0 { 1.0 } else { around(low).max(around(high)) };
            (around(low).min(around(high)), widest, low, high)
        }
        Extent::Disk { .. } => (part.inner_radius, 1.0, 0.0, 0.0),
        Extent::Cylinder { .. } => (1.0, 1.0, 0.0, 1.0),
    };
    let mut bounds = Bounds::default();
    let mut add = |turn: f32, radius: f32| {
        let (sin, cos) = (std::f32::consts::TAU * turn).sin_cos();
        bounds.add(Vec3::new(radius * cos, radius * sin, low));
        bounds.add(Vec3::new(radius * cos, radius * sin, high));
    };
    // Both straight edges, and where the rim is farthest along an axis
    for turn in [0.0, part.turn] {
        add(turn, inner);
        add(turn, outer);
    }
    [0.25, 0.5, 0.75].into_iter().filter(|turn| *turn < part.turn).for_each(|turn| add(turn, outer));
    bounds.grown(4.0 * f32::EPSILON)
}

/// A box around a shape in the world; `object` is that in its object space.
pub(super) fn bounds(kind: &ShapeKind, object: &Bounds, map: &Affine3A) -> Bounds {
    match kind {
        ShapeKind::Sphere { .. } => ellipsoid_bounds(map),
        ShapeKind::Disk { .. } => disk_bounds(map),
        ShapeKind::Quad { .. } => transformed(object, map),
        ShapeKind::Quadric(quadric) => {
            let whole = match quadric.extent {
                Extent::Sphere { .. } => ellipsoid_bounds(map),
                Extent::Disk { .. } => disk_bounds(map),
                Extent::Cylinder { .. } => tube_bounds(map),
            };
            whole.common(&transformed(object, map))
        }
        ShapeKind::Patch(patch) => {
            let mut bounds = Bounds::default();
            patch.corners.iter().for_each(|corner| bounds.add(map.transform_point3(*corner)));
            widened(bounds)
        }
    }
}
