//! Numbers of sRGB to linear light.

/// IEC 61966-2-1.
pub(super) fn linear_from_srgb(value: f32) -> f32 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}
