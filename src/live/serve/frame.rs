//! Pictures on their way to the page: halves of floats, taken apart by their bytes so that they become small, and deflated.

use super::message::{Aov, FrameHead, Want};
use crate::film::Picture;
use crate::live::Shot;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use half::f16;
use std::io::{self, Write};

/// A binary message: the length of the head, the head, the picture.
pub(super) fn encode(shot: &Shot, want: &Want) -> io::Result<Vec<u8>> {
    let picture = &shot.picture;
    let window = picture.frame.window;
    let small = Shrink {
        width: window.width() as usize,
        height: window.height() as usize,
        by: usize::from(want.scale),
    };
    let planes = planes(picture, want.aov, &small);
    // A depth has more digits than a half
    let bytes = if want.aov == Aov::Depth { 4 } else { 2 };
    let head = FrameHead {
        serial: shot.serial,
        generation: shot.generation.number,
        spp: shot.spp,
        width: small.columns(),
        height: small.rows(),
        scale: want.scale,
        aov: want.aov,
        which: want.which,
        channels: planes.len(),
        bytes,
    };
    let head = serde_json::to_vec(&head)?;
    let mut message = (head.len() as u32).to_le_bytes().to_vec();
    message.extend_from_slice(&head);
    let mut packer = ZlibEncoder::new(message, Compression::fast());
    for plane in &planes {
        for byte in 0..bytes {
            let values = plane.iter().map(|&value| match bytes {
                4 => value.to_le_bytes()[byte],
                _ => half_of(value).to_le_bytes()[byte],
            });
            packer.write_all(&values.collect::<Vec<u8>>())?;
        }
    }
    packer.finish()
}

/// The nearest half; what is too large becomes the largest, so that it stays a colour.
fn half_of(value: f32) -> f16 {
    f16::from_f32(value.clamp(f16::MIN.to_f32(), f16::MAX.to_f32()))
}

/// The channels of what is wanted.
fn planes(picture: &Picture, aov: Aov, small: &Shrink) -> Vec<Vec<f32>> {
    let three = |list: &[[f32; 3]]| [0, 1, 2].map(|channel| small.plane(&|i| list[i][channel])).to_vec();
    match aov {
        Aov::Color => three(&picture.rgb),
        Aov::Albedo => three(&picture.albedo),
        Aov::Normal => three(&picture.normal),
        Aov::Variance => three(&picture.variance),
        Aov::Depth => vec![small.plane(&|i| picture.depth[i])],
        Aov::Alpha => vec![small.plane(&|i| picture.alpha[i])],
    }
}

/// Means of squares of pixels.
struct Shrink {
    width: usize,
    height: usize,
    by: usize,
}

impl Shrink {
    fn columns(&self) -> usize {
        self.width.div_ceil(self.by)
    }

    fn rows(&self) -> usize {
        self.height.div_ceil(self.by)
    }

    fn plane(&self, value: &dyn Fn(usize) -> f32) -> Vec<f32> {
        let mut means = Vec::with_capacity(self.columns() * self.rows());
        for row in 0..self.rows() {
            for column in 0..self.columns() {
                let (mut sum, mut count) = (0.0_f32, 0.0_f32);
                for y in row * self.by..((row + 1) * self.by).min(self.height) {
                    for x in column * self.by..((column + 1) * self.by).min(self.width) {
                        sum += value(y * self.width + x);
                        count += 1.0;
                    }
                }
                means.push(sum / count);
            }
        }
        means
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_of_pixels_become_their_means() {
        let small = Shrink { width: 3, height: 2, by: 2 };
        // 0 1 2 / 3 4 5
        assert_eq!(small.plane(&|i| i as f32), [2.0, 3.5]);
        assert_eq!(Shrink { by: 1, ..small }.plane(&|i| i as f32), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    }

    #[test]
    fn halves_are_near_and_finite() {
        assert_eq!(half_of(1.0).to_f32(), 1.0);
        assert_eq!(half_of(1e9), f16::MAX);
        assert_eq!(half_of(f32::NEG_INFINITY), f16::MIN);
        assert!((half_of(0.18).to_f32() / 0.18 - 1.0).abs() < 5e-4);
    }
}
