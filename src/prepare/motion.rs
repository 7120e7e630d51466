//! Motion between two places, where a thing is when the shutter opens and where it is when it closes.
//!
//! Each map is taken apart into a stretch, a rotation and a translation that follow one another (Shoemake and Duff 1992).
//! Translation and stretch change linearly, the rotation turns steadily the shorter way (pbrt-v3, section 2.9.3).

use super::bounds::Bounds;
use super::rows;
use super::triangles::mirrors;
use crate::layout;
use crate::{Error, Result};
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Vec3};

/// Rounds of Newton's iteration: a matrix of 32-bit floats of any size has converged long before.
const ROUNDS: u32 = 200;
/// Sine of half of an angle below which nothing turns: less than a float can tell.
const NO_TURN: f64 = 1e-9;
/// Places for which the box around what turns is found exactly.
const STEPS: u32 = 32;
/// Angle by which a rotation may be off on a device: Vulkan demands of sine and cosine an error of no more than 2⁻¹¹, and
/// both are those of half of the angle.
const TURN_ERROR: f64 = 2.0 * std::f64::consts::SQRT_2 / 2048.0;

/// A place taken apart: map = translation · turn · stretch.
struct Key {
    translation: DVec3,
    turn: DQuat,
    stretch: DMat3,
}

impl Key {
    /// The polar decomposition by Newton's iteration (Higham 1986). A map that mirrors has a stretch that does.
    fn of(map: &Affine3A) -> Self {
        let map = map.as_daffine3();
        let mut turn = map.matrix3;
        for _ in 0..ROUNDS {
            let next = 0.5 * (turn + turn.inverse().transpose());
            let done = turn.abs_diff_eq(next, 1e-15);
            turn = next;
            if done {
                break;
            }
        }
        if turn.determinant() < 0.0 {
            turn = -turn;
        }
        let stretch = turn.transpose() * map.matrix3;
        Self { translation: map.translation, turn: DQuat::from_mat3(&turn).normalize(), stretch }
    }

    /// The stretch, after a map that is the same at all times.
    fn stretch_after(&self, first: &DAffine3) -> DAffine3 {
        DAffine3 { matrix3: self.stretch, translation: DVec3::ZERO } * *first
    }
}

/// How something moves while the shutter is open.
pub(super) struct Motion {
    open: Key,
    close: Key,
    /// At a right angle to the rotation of `open`, on the way to that of `close`; 0 = it does not turn.
    across: DQuat,
    /// Half of the angle of the rotation.
    angle: f64,
}

impl Motion {
    /// The motion from one map to another; none when they are equal.
    pub fn between(name: &str, open: &Affine3A, close: Option<&Affine3A>) -> Result<Option<Self>> {
        let Some(close) = close.filter(|close| *close != open) else { return Ok(None) };
        if mirrors(open) != mirrors(close) {
            return Err(Error::scene(format!("{name} is mirrored at one end of its motion only"))
                .help("a thing that moves cannot be turned inside out"));
        }
        let (open, close) = (Key::of(open), Key::of(close));
        // A quaternion and its negative are the same rotation: the nearer of them
        let cosine = open.turn.dot(close.turn);
        let nearer = if cosine < 0.0 { -close.turn } else { close.turn };
        let across = nearer - open.turn * cosine.abs();
        let sine = across.length();
        let (across, angle) = if sine > NO_TURN {
            (across * (1.0 / sine), sine.atan2(cosine.abs()))
        } else {
            (DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), 0.0)
        };
        Ok(Some(Self { open, close, across, angle }))
    }

    /// The map to world space at a time in 0..=1, of a thing that `first` places before it moves.
    fn at(&self, time: f64, first: &DAffine3) -> DAffine3 {
        let (sine, cosine) = (self.angle * time).sin_cos();
        let turn = (self.open.turn * cosine + self.across * sine).normalize();
        let (a, b) = (self.open.stretch_after(first), self.close.stretch_after(first));
        let stretch = DAffine3 {
            matrix3: a.matrix3 * (1.0 - time) + b.matrix3 * time,
            translation: a.translation.lerp(b.translation, time),
        };
        let translation = self.open.translation.lerp(self.close.translation, time);
        DAffine3::from_rotation_translation(turn, translation) * stretch
    }

    /// As kernels read it.
    pub fn record(&self, first: &Affine3A) -> layout::Motion {
        let first = first.as_daffine3();
        let [open_row0, open_row1, open_row2] = rows(&self.open.stretch_after(&first));
        let [close_row0, close_row1, close_row2] = rows(&self.close.stretch_after(&first));
        layout::Motion {
            open_position: self.open.translation.as_vec3().to_array(),
            angle: self.angle as f32,
            close_position: self.close.translation.as_vec3().to_array(),
            spare: 0.0,
            turn: self.open.turn.as_quat().to_array(),
            turn_across: self.across.as_quat().to_array(),
            open_row0,
            open_row1,
            open_row2,
            close_row0,
            close_row1,
            close_row2,
        }
    }

    /// A box around a thing at all times. The thing is within `object`, and `place` gives a box around it for a map to the
    /// world.
    ///
    /// Between two times a point is off the chord by an eighth of the squared step times its largest acceleration, which for a
    /// rotation of speed ω about the origin of a point a that moves by a' is at most ω² |a| + 2 ω |a'|.
    pub fn bounds(&self, first: &Affine3A, object: &Bounds, place: impl Fn(&Affine3A) -> Bounds) -> Bounds {
        if object.min.x > object.max.x {
            // There is nothing in it
            return *object;
        }
        let first = first.as_daffine3();
        let steps = if self.angle > 0.0 { STEPS } else { 1 };
        let mut all = Bounds::default();
        for i in 0..=steps {
            let map = self.at(f64::from(i) / f64::from(steps), &first);
            all.join(&place(&narrow(&map)));
        }
        let (a, b) = (self.open.stretch_after(&first), self.close.stretch_after(&first));
        let (mut far, mut change) = (0.0_f64, 0.0_f64);
        for corner in object.corners() {
            let (p, q) = (a.transform_point3(corner.as_dvec3()), b.transform_point3(corner.as_dvec3()));
            far = far.max(p.length()).max(q.length());
            change = change.max(p.distance(q));
        }
        let (speed, step) = (2.0 * self.angle, 1.0 / f64::from(steps));
        let bend = step * step / 8.0 * (speed * speed * far + 2.0 * speed * change);
        let off = if self.angle > 0.0 { TURN_ERROR * far } else { 0.0 };
        let size = far + self.open.translation.length().max(self.close.translation.length());
        all.grown((bend + off + 16.0 * f64::from(f32::EPSILON) * size) as f32)
    }
}

/// The box of a thing that may move: `frame` places it before it moves, `map` is where it is when it does not.
pub(super) fn bounds_over_time(
    motion: Option<&Motion>,
    frame: &Affine3A,
    map: &Affine3A,
    object: &Bounds,
    place: impl Fn(&Affine3A) -> Bounds,
) -> Bounds {
    motion.map_or_else(|| place(map), |motion| motion.bounds(frame, object, &place))
}

fn narrow(map: &DAffine3) -> Affine3A {
    let column = |v: DVec3| -> Vec3 { v.as_vec3() };
    Affine3A::from_cols(
        column(map.x_axis).into(),
        column(map.y_axis).into(),
        column(map.z_axis).into(),
        column(map.translation).into(),
    )
}

#[cfg(test)]
#[path = "motion_tests.rs"]
mod tests;
