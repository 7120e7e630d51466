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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::{Spacing, read_lens};
    use crate::scene::LensInterface;

    #[test]
    fn a_lens_is_read_back_as_it_was() {
        let row =
            |radius, thickness, index, abbe| LensInterface { radius, thickness, index, abbe, aperture: 9.1 };
        let system = LensSystem {
            notes: vec!["A triplet".into(), "of three rows".into()],
            interfaces: vec![
                row(50.1, 1.0 / 3.0, 1.5168, Some(64.17)),
                row(0.0, 2.5, 1.7, None),
                row(-1e3, 0.0, 1.0, None),
            ],
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lens.dat");
        std::fs::write(&path, lens(&system)).unwrap();
        assert_eq!(read_lens(&path, Spacing::Next).unwrap(), system);
    }
}
