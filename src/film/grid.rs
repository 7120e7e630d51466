//! Numbers on a grid as a file: an image of a texture, which is no picture of a scene.

use std::io;
use std::path::Path;

use ::exr::prelude::{AnyChannel, FlatSamples};
use ::png::{BitDepth, ColorType};

use super::write::{Format, format_of, write_file};
use super::{Frame, exr, png};
use crate::Result;
use crate::scene::Rect;

/// Colours and alpha of texels, linear and straight.
#[derive(Debug, Clone, Copy)]
pub struct Grid<'a> {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and alpha, row by row from the top.
    pub texels: &'a [[f32; 4]],
    /// Whether alpha is written.
    pub alpha: bool,
}

impl Grid<'_> {
    fn channels(&self) -> usize {
        if self.alpha { 4 } else { 3 }
    }
}

/// Writes numbers in the format that the extension of `path` asks for: a linear PNG of 16 bits, where 0 to 1 are from nothing to the
/// most and what is outside is clamped, or an EXR of 32-bit floats. The same input gives the same bytes.
///
/// # Errors
///
/// As [`super::write`].
pub fn write_grid(path: &Path, grid: &Grid<'_>) -> Result<()> {
    let bytes = match format_of(path)? {
        Format::Png => png_file(grid),
        Format::Exr => exr_file(grid),
    };
    write_file(path, bytes)
}

fn png_file(grid: &Grid<'_>) -> io::Result<Vec<u8>> {
    let numbers = grid.texels.iter().flat_map(|texel| &texel[..grid.channels()]);
    let bytes: Vec<u8> = numbers.flat_map(|&v| png::quantize(f64::from(v), 65535.0).to_be_bytes()).collect();
    let head = png::Head {
        width: grid.width,
        height: grid.height,
        color: if grid.alpha { ColorType::Rgba } else { ColorType::Rgb },
        depth: BitDepth::Sixteen,
        linear: true,
        texts: &[png::software()],
    };
    png::file(&head, &bytes)
}

fn exr_file(grid: &Grid<'_>) -> io::Result<Vec<u8>> {
    let (width, height) = (grid.width, grid.height);
    let frame = Frame {
        width,
        height,
        window: Rect { x0: 0, y0: 0, x1: width, y1: height },
        radiance_exponent: 0,
        depth_exponent: 0,
        seed: 0,
    };
    let plane = |c: usize| FlatSamples::F32(grid.texels.iter().map(|texel| texel[c]).collect());
    let names = ["R", "G", "B", "A"].into_iter().take(grid.channels()).enumerate();
    exr::file(&frame, names.map(|(c, name)| AnyChannel::new(name, plane(c))).collect(), [])
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::exr::prelude::read_first_rgba_layer_from_file;

    const TEXELS: [[f32; 4]; 2] = [[0.25, -3.5, 1e-6, 0.5], [1.0, 7.0, 0.5, 1.0]];

    fn grid(alpha: bool) -> Grid<'static> {
        Grid { width: 1, height: 2, texels: &TEXELS, alpha }
    }

    #[test]
    fn a_png_is_linear_and_clamped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        write_grid(&path, &grid(false)).unwrap();
        let image = image::open(&path).unwrap().into_rgb16();
        assert_eq!(image.dimensions(), (1, 2));
        assert_eq!(image.into_raw(), [16384, 0, 0, 65535, 65535, 32768]);
        let reader = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
        let reader = ::png::Decoder::new(reader).read_info().unwrap();
        assert_eq!(reader.info().srgb, None);
        assert_eq!(reader.info().gama_chunk.map(|gamma| gamma.into_scaled()), Some(100_000));
        write_grid(&path, &grid(true)).unwrap();
        assert_eq!(image::open(&path).unwrap().into_rgba16().into_raw()[3..5], [32768, 65535]);
    }

    #[test]
    fn an_exr_has_the_numbers() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        for alpha in [true, false] {
            write_grid(&path, &grid(alpha)).unwrap();
            let first = std::fs::read(&path).unwrap();
            write_grid(&path, &grid(alpha)).unwrap();
            assert!(first == std::fs::read(&path).unwrap());
            let image = read_first_rgba_layer_from_file(
                &path,
                |size, _| vec![[0.0f32; 4]; size.area()],
                |texels, at, (r, g, b, a): (f32, f32, f32, f32)| texels[at.y()] = [r, g, b, a],
            );
            let texels = image.unwrap().layer_data.channel_data.pixels;
            let expected = TEXELS.map(|[r, g, b, a]| [r, g, b, if alpha { a } else { 1.0 }]);
            assert_eq!(texels, expected);
        }
    }
}
