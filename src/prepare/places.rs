//! The maps of shapes from the unit things of the kernels, and the sizes that things can have.

use crate::scene::Shape;
use crate::{Error, Result};
use glam::Affine3A;

/// Largest and smallest axes of spheres, disks and meshes with a tree of their own: the squares of both, and of what
/// divides by them, are floats.
const LARGEST: f64 = 5e18;
const SMALLEST: f64 = 2e-19;

/// Checks the size of a thing where it is, or at both ends of its motion.
pub(super) fn check_sizes(name: &str, open: &Affine3A, close: Option<&Affine3A>) -> Result<()> {
    check_size(name, open)?;
    close.map_or(Ok(()), |close| check_size(name, close))
}

/// Refuses what is so large or small that kernels, which square lengths in the object's space, leave the range of floats.
fn check_size(name: &str, map: &Affine3A) -> Result<()> {
    let world = map.as_daffine3().matrix3;
    let longest = |m: glam::DMat3| m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
    let (largest, smallest) = (longest(world), 1.0 / longest(world.inverse()));
    let refuse = |size: f64, what: &str, next: &str| {
        Err(Error::scene(format!("{name} has a size of {size:.1e}, too {what} for 32-bit floats")).help(next))
    };
    if largest > LARGEST {
        return refuse(largest, "large", "scale the scene down");
    }
    if smallest < SMALLEST || smallest.is_nan() {
        return refuse(smallest, "small", "scale the scene up, or leave it out");
    }
    Ok(())
}

/// From the unit sphere, disk or square of the kernels to the world.
pub(super) fn shape_frame(shape: &Shape) -> Affine3A {
    shape.world_from_object * shape.kind.frame()
}
