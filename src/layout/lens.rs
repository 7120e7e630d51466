//! The records of the lens of the camera.

use super::{Field, Record, RecordInfo};

records! {
    /// An interface of a lens, from the film to the scene. Lengths are in millimetres, z is the distance from the film.
    struct LensInterface {
        /// z of its vertex
        position: f32,
        /// 1 / radius, positive when the centre is on the side of the scene; 0 = flat
        curvature: f32,
        /// square of the radius of what is let through
        aperture_squared: f32,
        /// index of the medium towards the scene, at the d line
        index: f32,
        /// A and B of that index at other wavelengths: A + B / λ², λ in micrometres
        cauchy: [f32; 2],
        /// room
        spare: [f32; 2],
    }

    /// Where on the plane of the last vertex light comes through to film points on the x axis, in an interval of their distance
    /// from the middle. Millimetres; empty when no light does.
    struct PupilBounds {
        /// least x and y
        low: [f32; 2],
        /// greatest x and y
        high: [f32; 2],
    }

    /// A cell of a pixel filter, from its middle to its radius.
    struct FilterCell {
        /// share of the magnitude in the cells before
        below: f32,
        /// share of the magnitude in this one
        share: f32,
        /// 1, or -1 where the filter is negative
        sign: f32,
        /// room
        spare: u32,
    }

    /// A cell of the picture of an opening (alias method).
    struct OpeningCell {
        /// share of the slot that is its own
        accept: f32,
        /// the cell that has the rest
        alias: u32,
        /// what passes there, with a mean of π / 4
        weight: f32,
        /// room
        spare: u32,
    }
}
