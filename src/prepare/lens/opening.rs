//! The picture of an opening as a table of cells.

use super::super::alias;
use super::super::atlas::Reader;
use super::LensTables;
use crate::layout::OpeningCell;
use crate::scene::{Image, Texels};
use crate::{Error, Result};
use std::f64::consts::PI;

/// Most columns and rows. A larger picture is averaged: a blur of so many points shows no finer shape.
const MOST_CELLS: u32 = 128;

/// Adds the table: an alias table for thin lenses, and what passes at each cell for those of several elements.
pub(super) fn prepare(image: &Image, name: &str, out: &mut LensTables) -> Result<()> {
    let decode = !matches!(image.texels, Texels::RgbaF32(_));
    let read = Reader { image, decode };
    let size = [image.width.min(MOST_CELLS), image.height.min(MOST_CELLS)];
    let mut brightness = Vec::with_capacity((size[0] * size[1]) as usize);
    for row in 0..size[1] {
        for column in 0..size[0] {
            brightness.push(mean(&read, [column, row], size));
        }
    }
    let sum: f64 = brightness.iter().sum();
    if !(sum > 0.0 && sum.is_finite()) {
        return Err(Error::scene(format!(
            "the opening of the lens lets no light through: picture `{name}` is black"
        ))
        .help("make it bright where the lens is open"));
    }
    let scale = PI / 4.0 * brightness.len() as f64 / sum;
    out.opening_cells = out.words.len() as u32;
    out.opening_size = size;
    let cells = alias::table(&brightness).into_iter().zip(&brightness).map(|(slot, value)| OpeningCell {
        accept: slot.accept,
        alias: slot.alias,
        weight: (value * scale) as f32,
        spare: 0,
    });
    out.words.extend(cells.map(bytemuck::cast::<_, [u32; 4]>));
    Ok(())
}

/// Mean brightness of the texels of a cell.
fn mean(read: &Reader<'_>, cell: [u32; 2], size: [u32; 2]) -> f64 {
    let texels = [read.image.width, read.image.height];
    let span = |axis: usize| {
        let edge = |i: u32| (u64::from(i) * u64::from(texels[axis]) / u64::from(size[axis])) as u32;
        edge(cell[axis])..edge(cell[axis] + 1)
    };
    let (columns, rows) = (span(0), span(1));
    let count = columns.len() * rows.len();
    let value = |x, y| {
        let [r, g, b, _] = read.linear(x, y);
        (f64::from(r) + f64::from(g) + f64::from(b)).max(0.0)
    };
    rows.flat_map(|y| columns.clone().map(move |x| (x, y))).map(|(x, y)| value(x, y)).sum::<f64>()
        / count as f64
}
