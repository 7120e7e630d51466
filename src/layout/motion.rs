//! The record of what moves while the shutter is open.

use super::{Field, Record, RecordInfo};

records! {
    /// A map to the world that moves: translation, rotation, and the stretch before them, when the shutter opens and when it
    /// closes. Rows are of 3×4 matrices.
    struct Motion {
        /// translation when it opens
        open_position: [f32; 3],
        /// half of the angle of the rotation until it closes, radians
        angle: f32,
        /// translation when it closes
        close_position: [f32; 3],
        /// room
        spare: f32,
        /// rotation when it opens, as a quaternion x, y, z, w
        turn: [f32; 4],
        /// unit quaternion at a right angle to it, on the way to the rotation when it closes; 0 = the same rotation
        turn_across: [f32; 4],
        /// row 0 of the stretch from object when it opens
        open_row0: [f32; 4],
        /// row 1 of it
        open_row1: [f32; 4],
        /// row 2 of it
        open_row2: [f32; 4],
        /// row 0 of the stretch from object when it closes
        close_row0: [f32; 4],
        /// row 1 of it
        close_row1: [f32; 4],
        /// row 2 of it
        close_row2: [f32; 4],
    }
}
