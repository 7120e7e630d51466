//! Axis-aligned boxes of what a scene is made of.

use crate::layout::Triangle;
use glam::{Affine3A, Vec3};

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least corner.
    pub min: Vec3,
    /// Greatest corner.
    pub max: Vec3,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY }
    }
}

impl Bounds {
    /// Grows the box to hold a point.
    pub fn add(&mut self, p: Vec3) {
        self.min = self.min.min(p);
        self.max = self.max.max(p);
    }

    /// Grows the box to hold another.
    pub fn join(&mut self, other: &Self) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    /// What both boxes hold.
    pub fn common(&self, other: &Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Its eight corners.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> + use<> {
        let (min, max) = (self.min, self.max);
        (0..8).map(move |i| {
            let pick = |bit: u32, axis: usize| if i & bit == 0 { min[axis] } else { max[axis] };
            Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
        })
    }

    /// The box with more on every side.
    pub fn grown(&self, margin: f32) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Distance of a point from the box; 0 inside.
    pub fn distance(&self, p: Vec3) -> f32 {
        (self.min - p).max(p - self.max).max(Vec3::ZERO).length()
    }

    /// Length of the diagonal; 0 when the box is empty.
    pub fn diagonal(&self) -> f32 {
        if self.min.x <= self.max.x { (self.max - self.min).length() } else { 0.0 }
    }
}

pub(super) fn triangle_bounds(t: &Triangle) -> Bounds {
    let mut bounds = Bounds::default();
    for p in [t.a, t.b, t.c] {
        bounds.add(p.into());
    }
    bounds
}

pub(super) fn bounds_of(triangles: &[Triangle]) -> Bounds {
    triangles.iter().map(triangle_bounds).fold(Bounds::default(), |mut all, b| {
        all.join(&b);
        all
    })
}

pub(super) fn transformed(bounds: &Bounds, map: &Affine3A) -> Bounds {
    let mut out = Bounds::default();
    for corner in bounds.corners() {
        out.add(map.transform_point3(corner));
    }
    widened(out)
}

/// Half-extent of a mapped unit sphere along an axis is the length of that row of the matrix.
pub(super) fn ellipsoid_bounds(map: &Affine3A) -> Bounds {
    let rows = map.matrix3.transpose();
    let half = Vec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length());
    let center = Vec3::from(map.translation);
    widened(Bounds { min: center - half, max: center + half })
}

pub(super) fn disk_bounds(map: &Affine3A) -> Bounds {
    let rows = map.matrix3.transpose();
    let length = |row: glam::Vec3A| row.truncate().length();
    let half = Vec3::new(length(rows.x_axis), length(rows.y_axis), length(rows.z_axis));
    let center = Vec3::from(map.translation);
    widened(Bounds { min: center - half, max: center + half })
}

/// The tube of radius 1 about z from 0 to 1: disks at both ends.
pub(super) fn tube_bounds(map: &Affine3A) -> Bounds {
    let mut bounds = disk_bounds(map);
    bounds.join(&disk_bounds(&(*map * Affine3A::from_translation(Vec3::Z))));
    bounds
}

/// A little more, for the rounding of the map.
pub(super) fn widened(bounds: Bounds) -> Bounds {
    let margin = (bounds.min.abs().max(bounds.max.abs())) * 4.0 * f32::EPSILON;
    Bounds { min: bounds.min - margin, max: bounds.max + margin }
}
