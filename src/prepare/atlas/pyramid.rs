//! Pictures of half the size, in linear light.

use super::{Reader, half_size};
use crate::scene::{Image, Texels};

/// A picture half as wide and half as high, rounded up: each of its texels is the mean of what it covers, so that the mean of
/// the whole stays. At odd sizes a texel covers parts of others.
pub(super) fn halved(below: &Reader<'_>) -> Image {
    let size = [below.image.width, below.image.height];
    let [width, height] = half_size(size);
    let columns: Vec<_> = (0..width).map(|x| covered(x, width, size[0])).collect();
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let rows = covered(y, height, size[1]);
        for columns in &columns {
            let mut mean = [0.0_f64; 4];
            for &(row, of_row) in &rows {
                for &(column, of_column) in columns {
                    for (sum, value) in mean.iter_mut().zip(below.linear(column, row)) {
                        *sum += of_row * of_column * f64::from(value);
                    }
                }
            }
            texels.push(mean.map(|value| value as f32));
        }
    }
    Image { width, height, texels: Texels::RgbaF32(texels) }
}

/// The texels of `n` that texel `i` of `half` covers, three at most, and the share of each in it.
fn covered(i: u32, half: u32, n: u32) -> Vec<(u32, f64)> {
    let width = f64::from(n) / f64::from(half);
    let (from, to) = (f64::from(i) * width, f64::from(i + 1) * width);
    let share = |at: u32| (to.min(f64::from(at + 1)) - from.max(f64::from(at))) / width;
    // A share of rounding is none
    (from as u32..(to.ceil() as u32).min(n))
        .map(|at| (at, share(at)))
        .filter(|(_, share)| *share > 1e-9)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(image: &Image) -> f64 {
        let read = Reader { image, decode: false };
        let texels = (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y)));
        let sum: f64 = texels.map(|(x, y)| f64::from(read.linear(x, y)[0])).sum();
        sum / f64::from(image.width * image.height)
    }

    #[test]
    fn shares_add_up_to_one_and_each_texel_counts_alike() {
        for n in 1..40_u32 {
            let half = n.div_ceil(2);
            let mut counts = vec![0.0; n as usize];
            for i in 0..half {
                let covered = covered(i, half, n);
                assert!(covered.len() <= 3);
                assert!((covered.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
                covered.into_iter().for_each(|(at, share)| counts[at as usize] += share);
            }
            let expected = f64::from(half) / f64::from(n);
            assert!(counts.iter().all(|count| (count - expected).abs() < 1e-12), "{n}: {counts:?}");
        }
    }

    #[test]
    fn the_mean_stays_down_to_one_texel() {
        for [width, height] in [[1, 1], [2, 2], [7, 3], [1, 9], [13, 1], [8, 8], [5, 11]] {
            let texels = (0..width * height).map(|i| [((i * 37 + 11) % 101) as f32; 4]).collect();
            let mut image = Image { width, height, texels: Texels::RgbaF32(texels) };
            let expected = mean(&image);
            while image.width * image.height > 1 {
                image = halved(&Reader { image: &image, decode: false });
                assert!((mean(&image) / expected - 1.0).abs() < 1e-6, "{} x {}", image.width, image.height);
            }
        }
    }

    #[test]
    fn light_is_averaged_and_not_its_code() {
        let texels = Texels::Rgba8(vec![[0, 0, 0, 0], [255, 255, 255, 255]]);
        let image = Image { width: 2, height: 1, texels };
        let half = halved(&Reader { image: &image, decode: true });
        assert_eq!(Reader { image: &half, decode: false }.linear(0, 0), [0.5; 4]);
    }
}
