//! Parts of spheres and disks, and tubes.

use glam::{Affine3A, Mat3A, Vec3};

/// A part of a sphere, a part of a disk, or a tube, about an axis: u is the angle about the axis from `meridian` towards
/// axis × meridian, divided by `phi_max`. In the words of pbrt, z runs along `axis` and x along `meridian`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadric {
    /// What it is a part of.
    pub extent: Extent,
    /// Centre.
    pub center: Vec3,
    /// Radius, above 0.
    pub radius: f32,
    /// Direction of z: towards the north pole of a sphere, the normal of the front of a disk.
    pub axis: Vec3,
    /// Direction of angle 0, made orthogonal to `axis`.
    pub meridian: Vec3,
    /// Angle up to which it is there, in degrees, in (0, 360].
    pub phi_max: f32,
}

/// What a [`Quadric`] is a part of, and how much of it there is. z is measured from the centre, in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// A sphere: v = (latitude − that at `z_min`) / (that at `z_max` − that at `z_min`).
    Sphere {
        /// Least z, at least −radius.
        z_min: f32,
        /// Greatest z, above `z_min` and at most the radius.
        z_max: f32,
    },
    /// A disk: v = 1 at `inner_radius` and 0 at the rim.
    Disk {
        /// Radius of the hole, in [0, radius).
        inner_radius: f32,
    },
    /// A tube, open at both ends, with its front outside: v = 0 at `z_min` and 1 at `z_max`.
    Cylinder {
        /// Least z.
        z_min: f32,
        /// Greatest z, above `z_min`.
        z_max: f32,
    },
}

impl Quadric {
    /// From the unit sphere about the origin, the unit disk in z = 0, or the tube of radius 1 from z = 0 to 1, to the quadric;
    /// each with its axis along +z and its meridian along +x.
    pub fn frame(&self) -> Affine3A {
        let frame = around(self.axis, self.meridian, self.radius, self.center);
        let Extent::Cylinder { z_min, z_max } = self.extent else { return frame };
        let z = self.axis.normalize();
        let m = frame.matrix3;
        let along = z * (z_max - z_min);
        Affine3A {
            matrix3: Mat3A::from_cols(m.x_axis, m.y_axis, along.into()),
            translation: (self.center + z * z_min).into(),
        }
    }
}

/// The map that scales, turns z to one direction and x near to another, and moves.
pub(super) fn around(z: Vec3, along: Vec3, scale: f32, at: Vec3) -> Affine3A {
    let z = z.normalize();
    let x = along.reject_from_normalized(z).normalize();
    let m = Mat3A::from_cols((x * scale).into(), (z.cross(x) * scale).into(), (z * scale).into());
    Affine3A { matrix3: m, translation: at.into() }
}
