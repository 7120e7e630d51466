//! Lenses as tables of numbers.

use crate::scene::LensSystem;
use std::fmt::Write as _;

/// The file of a lens: radius, distance to the next row, index, diameter and Abbe number, in millimetres, with all digits. `spacing = "next"`.
pub(super) fn lens(system: &LensSystem) -> String {
    let mut text = String::new();
    for note in &system.notes {
        _ = writeln!(text, "# {note}");
    }
    let last = system.interfaces.len().saturating_sub(1);
    for (i, row) in system.interfaces.iter().enumerate() {
        let distance = if i == last { 0.0 } else { row.thickness };
        let abbe = row.abbe.unwrap_or(0.0);
        _ = writeln!(text, "{:?} {distance:?} {:?} {:?} {abbe:?}", row.radius, row.index, row.aperture);
    }
    text
}
