//! Twins of `base/fixed.glsl`.

/// The nearest integer, halves away from zero.
pub fn fixed_from_float(x: f32) -> i64 {
    // f64 holds every f32 plus one half, and i64 every result
    let x = f64::from(x);
    (if x < 0.0 { (x - 0.5).ceil() } else { (x + 0.5).floor() }) as i64
}

pub fn fixed_words(value: i64) -> [u32; 2] {
    [value as u32, (value >> 32) as u32]
}

/// The integer part.
pub fn fixed_wide_from_float(x: f32) -> u128 {
    x as u128
}

pub fn fixed_wide_words(value: u128) -> [u32; 3] {
    [value as u32, (value >> 32) as u32, (value >> 64) as u32]
}
