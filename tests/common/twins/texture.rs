//! Twins of `texture/image.glsl`.

use dapple::scene::Wrap;

/// IEC 61966-2-1.
pub fn srgb_decode(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// Index inside 0..n, and whether the picture is black there.
pub fn wrap_index(i: i32, n: i32, mode: u32) -> (i32, bool) {
    use dapple::layout::{WRAP_BLACK, WRAP_MIRROR, WRAP_REPEAT};
    match mode {
        WRAP_REPEAT => (i.rem_euclid(n), false),
        WRAP_MIRROR => {
            let at = i.rem_euclid(2 * n);
            (if at < n { at } else { 2 * n - 1 - at }, false)
        }
        mode => (i.clamp(0, n - 1), mode == WRAP_BLACK && !(0..n).contains(&i)),
    }
}

/// Index inside 0..n by the mode of a scene; none where the picture is black.
pub fn wrapped(i: i64, n: i64, wrap: Wrap) -> Option<usize> {
    let inside = match wrap {
        Wrap::Repeat => i.rem_euclid(n),
        // Of an octahedral picture u and v are folded together first
        Wrap::Clamp | Wrap::Octahedral => i.clamp(0, n - 1),
        Wrap::Mirror => {
            let j = i.rem_euclid(2 * n);
            if j < n { j } else { 2 * n - 1 - j }
        }
        Wrap::Black => return (0..n).contains(&i).then_some(i as usize),
    };
    Some(inside as usize)
}
