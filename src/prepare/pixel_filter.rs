//! Pixel filters that are negative in places, as a table by which the kernels sample their magnitude.

use super::lens::LensTables;
use crate::layout::{FILTER_CELLS, FilterCell};
use crate::scene::Filter;
use crate::{Error, Result};

/// Points of a cell at which the filter is looked at.
const POINTS: usize = 16;

/// Adds the table of a filter that may be negative; nothing for others. Both axes have the same.
///
/// # Errors
/// A filter whose mean is not above 0, by which nothing can be weighted.
pub(super) fn prepare(filter: &Filter, out: &mut LensTables) -> Result<()> {
    let Some(means) = means(filter) else { return Ok(()) };
    let magnitude: f64 = means.iter().map(|mean| mean.abs()).sum();
    let whole: f64 = means.iter().sum();
    if whole <= 1e-3 * magnitude {
        return Err(
            Error::scene("the pixel filter weighs as much below 0 as above").help("change its radius")
        );
    }
    out.filter_cells = out.words.len() as u32;
    out.filter_weight = (magnitude / whole).powi(2) as f32;
    let mut below = 0.0;
    for mean in means {
        let share = mean.abs() / magnitude;
        let cell =
            FilterCell { below: below as f32, share: share as f32, sign: mean.signum() as f32, spare: 0 };
        out.words.push(bytemuck::cast(cell));
        below += share;
    }
    Ok(())
}

/// Mean of the filter in each cell from its middle to its radius.
fn means(filter: &Filter) -> Option<Vec<f64>> {
    let count = (FILTER_CELLS as usize * POINTS) as f64;
    let value = |i: usize| filter.kind.signed_value((i as f64 + 0.5) / count, filter.radius.into());
    let values = (0..FILTER_CELLS as usize * POINTS).map(value).collect::<Option<Vec<f64>>>()?;
    Some(values.chunks_exact(POINTS).map(|points| points.iter().sum::<f64>() / POINTS as f64).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::FilterKind;

    fn table(kind: FilterKind, radius: f32) -> (LensTables, Vec<FilterCell>) {
        let mut out = LensTables::default();
        prepare(&Filter { kind, radius }, &mut out).unwrap();
        let cells = out.words.iter().map(|word| bytemuck::cast(*word)).collect();
        (out, cells)
    }

    #[test]
    fn mitchell_is_negative_where_its_cubic_is() {
        let (tables, cells) = table(FilterKind::Mitchell { b: 1.0 / 3.0, c: 1.0 / 3.0 }, 2.0);
        assert_eq!(cells.len(), FILTER_CELLS as usize);
        // (x − 2)² (−7/3 x + 8/3) / 6 changes its sign at 8/7 of half of the radius
        let first = cells.iter().position(|cell| cell.sign < 0.0).unwrap();
        assert_eq!(first, (f64::from(FILTER_CELLS) * 4.0 / 7.0).round() as usize);
        assert!(cells[first..].iter().all(|cell| cell.sign < 0.0));
        let last = cells.last().unwrap();
        assert!((last.below + last.share - 1.0).abs() < 1e-6);
        // The whole is 1; of the negative part, ∫ from 8/7 to 2, (7/18) ∫ s² (s − 6/7) ds from 0 to 6/7 = −(7/18)(6/7)⁴ / 12
        let negative = 7.0 / 18.0 * (6.0_f64 / 7.0).powi(4) / 12.0;
        let expected = (1.0 + 4.0 * negative).powi(2);
        assert!(
            (f64::from(tables.filter_weight) - expected).abs() < 1e-4,
            "{} {expected}",
            tables.filter_weight
        );
    }

    #[test]
    fn filters_that_are_never_negative_have_no_table() {
        assert!(table(FilterKind::Gaussian, 1.5).1.is_empty());
    }

    #[test]
    fn sinc_changes_its_sign_at_whole_pixels() {
        let (_, cells) = table(FilterKind::Sinc { tau: 3.0 }, 4.0);
        let pixel = FILTER_CELLS as usize / 4;
        for (i, cell) in cells.iter().enumerate() {
            // The window is positive up to 3 pixels, negative beyond; sinc by turns
            let expected = [1.0, -1.0, 1.0, 1.0][i / pixel];
            assert_eq!(cell.sign, expected, "cell {i}");
        }
    }
}
