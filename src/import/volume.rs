//! Volumes of Mitsuba's grid format: `VOL`, version 3, 32-bit floats, x fastest.

use super::file::read_bytes;
use super::image::finite;
use crate::scene::{Image, Texels};
use crate::{Error, Result};
use std::path::Path;

/// Bytes before the numbers: magic and version, encoding, three sizes, channels, and a box that is passed over.
const HEAD_BYTES: usize = 48;
/// Most texels along an axis.
pub(super) const LARGEST_SIDE: u32 = 4096;

/// Reads a volume of 1 or 3 channels as slices across z, by growing z; the lowest row of a slice is at y = 0.
///
/// # Errors
/// A file that cannot be read, is of another format, is cut short, or has a number that is not finite.
pub fn read_volume(path: &Path) -> Result<Vec<Image>> {
    decode(&read_bytes(path)?).map_err(|error| error.in_file(path))
}

fn decode(bytes: &[u8]) -> Result<Vec<Image>> {
    let (head, data) = bytes.split_at_checked(HEAD_BYTES).unwrap_or((&[], &[]));
    if !head.starts_with(b"VOL\x03") {
        return Err(Error::scene("this is no volume").help("use slices, or Mitsuba's format VOL, version 3"));
    }
    let number = |i: usize| head[4 * i..].first_chunk().map_or(0, |four| u32::from_le_bytes(*four));
    let (encoding, [nx, ny, nz], channels) = (number(1), [number(2), number(3), number(4)], number(5));
    if encoding != 1 || !matches!(channels, 1 | 3) {
        return Err(Error::scene(format!("the volume has {channels} channels in encoding {encoding}"))
            .help("write 1 or 3 channels of 32-bit floats"));
    }
    if [nx, ny, nz].iter().any(|n| !(1..=LARGEST_SIDE).contains(n)) {
        return Err(Error::scene(format!(
            "the volume is {nx} x {ny} x {nz}, must be from 1 to {LARGEST_SIDE} along each axis"
        )));
    }
    let values = u64::from(nx) * u64::from(ny) * u64::from(nz) * u64::from(channels);
    if (data.len() as u64) < 4 * values {
        return Err(Error::scene("the volume ends too early"));
    }
    let numbers: Vec<f32> = data.as_chunks().0.iter().map(|four| f32::from_le_bytes(*four)).collect();
    let texel = |x: u32, y: u32, z: u32| {
        let at = ((u64::from(z) * u64::from(ny) + u64::from(y)) * u64::from(nx) + u64::from(x)) as usize;
        match channels {
            1 => [numbers[at], numbers[at], numbers[at], 1.0],
            _ => [numbers[3 * at], numbers[3 * at + 1], numbers[3 * at + 2], 1.0],
        }
    };
    let slice = |z| {
        let rows = (0..ny).rev().flat_map(|y| (0..nx).map(move |x| (x, y)));
        let texels = rows.map(|(x, y)| texel(x, y, z)).collect();
        finite(Image { width: nx, height: ny, texels: Texels::RgbaF32(texels) })
    };
    (0..nz).map(slice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(size: [u32; 3], channels: u32, values: &[f32]) -> Vec<u8> {
        let mut bytes = b"VOL\x03".to_vec();
        let head = [1, size[0], size[1], size[2], channels];
        bytes.extend(head.iter().flat_map(|n| n.to_le_bytes()));
        bytes.extend([0; 24]);
        bytes.extend(values.iter().flat_map(|x| x.to_le_bytes()));
        bytes
    }

    #[test]
    fn slices_have_the_lowest_row_last() {
        let slices = decode(&volume([1, 2, 2], 1, &[1.0, 2.0, 3.0, 4.0])).unwrap();
        let greys: Vec<_> = slices
            .iter()
            .map(|slice| match &slice.texels {
                Texels::RgbaF32(texels) => [texels[0][0], texels[1][0]],
                _ => [0.0; 2],
            })
            .collect();
        assert_eq!(greys, [[2.0, 1.0], [4.0, 3.0]]);
        let colors = decode(&volume([1, 1, 1], 3, &[0.5, 0.25, 2.0])).unwrap();
        assert_eq!(colors[0].texels, Texels::RgbaF32(vec![[0.5, 0.25, 2.0, 1.0]]));
    }

    #[test]
    fn what_is_no_volume_is_refused() {
        let message = |bytes: &[u8]| decode(bytes).unwrap_err().to_string();
        assert!(message(b"VOL\x03").starts_with("this is no volume"));
        assert!(
            message(&volume([1; 3], 2, &[0.0; 2])).starts_with("the volume has 2 channels in encoding 1")
        );
        assert!(message(&volume([1, 0, 1], 1, &[])).starts_with("the volume is 1 x 0 x 1"));
        assert_eq!(message(&volume([2; 3], 1, &[0.0; 7])), "the volume ends too early");
        assert!(message(&volume([1; 3], 1, &[f32::NAN])).contains("NaN"));
    }
}
