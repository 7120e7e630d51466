//! Lens files: a row for each interface, from the front to the film.
//!
//! A row has the radius of curvature, a distance, the index of refraction behind it, the diameter that is let through, and
//! perhaps the Abbe number of the medium behind it; lengths are in millimetres. Radius 0 is flat. `#` begins a comment.
//! The distance is that to the next row (its last is 0), or that from the row before (its first is 0).

use super::file::{read_bytes, shown};
use crate::scene::{LensInterface, LensSystem};
use crate::{Error, Result};
use std::path::Path;

/// Most rows. A zoom lens has 40; each costs time for every sample.
const MOST_ROWS: usize = 128;
/// Most bytes of a file: far more than rows and comments need.
const MOST_BYTES: usize = 1 << 20;
/// The range of lengths in millimetres, radii and diameters.
const LENGTHS: std::ops::RangeInclusive<f64> = 1e-3..=1e7;
/// The largest index of refraction: above that of any glass or crystal that is clear.
const LARGEST_INDEX: f64 = 5.0;

/// What the second column of a lens file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// What fits: the end of the column that is 0 shows it.
    Detect,
    /// The distance to the next row; what the last row says does not count.
    Next,
    /// The distance from the row before; what the first row says does not count.
    Previous,
}

/// Reads a lens.
///
/// # Errors
/// A file that cannot be read or is no lens, with the line.
pub fn read_lens(path: &Path, spacing: Spacing) -> Result<LensSystem> {
    let bytes = read_bytes(path)?;
    if bytes.len() > MOST_BYTES {
        return Err(Error::scene("this is no lens file: it is larger than 1 MiB").in_file(path));
    }
    parse(&String::from_utf8_lossy(&bytes), spacing, path)
}

/// A row as it is written, with its line.
struct Row {
    line: u32,
    numbers: Vec<f64>,
}

/// Reads the text of a lens file; `path` is for messages.
pub(super) fn parse(text: &str, spacing: Spacing, path: &Path) -> Result<LensSystem> {
    let (mut notes, mut rows) = (Vec::new(), Vec::new());
    for (line, text) in (1..).zip(text.lines()) {
        let (numbers, note) = text.split_once('#').map_or((text, None), |(row, note)| (row, Some(note)));
        if !numbers.trim().is_empty() {
            rows.push(Row { line, numbers: row(numbers).map_err(|error| error.at(path, line, 0))? });
        } else if let Some(note) = note.map(str::trim).filter(|note| rows.is_empty() && !note.is_empty()) {
            notes.push(note.to_owned());
        }
        if rows.len() > MOST_ROWS {
            return Err(Error::scene(format!("the lens has more than {MOST_ROWS} rows")).at(path, line, 0));
        }
    }
    let distances = distances(&rows, spacing).map_err(|error| error.in_file(path))?;
    let mut system = LensSystem { notes, interfaces: Vec::with_capacity(rows.len()) };
    for (row, thickness) in rows.iter().zip(distances) {
        let before = system.interfaces.last().map_or((1.0, None), |last| (last.index, last.abbe));
        system.interfaces.push(interface(row, thickness, before).map_err(|e| e.at(path, row.line, 0))?);
    }
    whole(&system, &rows).map_err(|(line, error)| error.at(path, line, 0))?;
    Ok(system)
}

/// The four or five numbers of a row.
fn row(text: &str) -> Result<Vec<f64>> {
    let numbers: Vec<f64> = text
        .split_whitespace()
        .map(|word| match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(number) => Err(Error::scene(format!("a number is {number}, must be finite"))),
            Err(_) => Err(Error::scene(format!("`{}` is not a number", shown(word.as_bytes())))),
        })
        .collect::<Result<_>>()?;
    match numbers.len() {
        4 | 5 => Ok(numbers),
        count => Err(Error::scene(format!("a row of {count} numbers, must be 4 or 5"))
            .help("write radius, distance, index, diameter, and perhaps the Abbe number")),
    }
}

/// The distances from each row to the next.
fn distances(rows: &[Row], spacing: Spacing) -> Result<Vec<f64>> {
    let column: Vec<f64> = rows.iter().map(|row| row.numbers[1]).collect();
    let [first, .., last] = column.as_slice() else {
        return Err(Error::scene("a lens has two rows at least").help("write a row for each surface"));
    };
    let next = match spacing {
        Spacing::Next => true,
        Spacing::Previous => false,
        Spacing::Detect if *first != 0.0 && *last == 0.0 => true,
        Spacing::Detect if *first == 0.0 && *last != 0.0 => false,
        Spacing::Detect => {
            let ends = if *first == 0.0 { "both ends of it are" } else { "neither end of it is" };
            return Err(Error::scene(format!(
                "it is unclear what the second column is: {ends} 0, where one should be"
            ))
            .help("say `spacing = \"next\"` for distances to the next row, or \"previous\""));
        }
    };
    let skipped = usize::from(!next);
    let mut distances: Vec<f64> = column[skipped..column.len() - 1 + skipped].to_vec();
    distances.push(0.0);
    Ok(distances)
}

/// A row as an interface; `before` is the medium in front of it.
fn interface(row: &Row, thickness: f64, before: (f64, Option<f64>)) -> Result<LensInterface> {
    let refuse = |what: &str, value: f64, rule: &str| {
        Err(Error::scene(format!("the {what} is {value}, must be {rule}")))
    };
    let numbers = &row.numbers;
    let (radius, index, aperture, abbe) = (numbers[0], numbers[2], numbers[3], numbers.get(4).copied());
    if radius != 0.0 && !LENGTHS.contains(&radius.abs()) {
        return refuse("radius", radius, "0, or from 0.001 to 10000000 mm, with any sign");
    }
    if !(0.0..=*LENGTHS.end()).contains(&thickness) {
        return refuse("distance", thickness, "from 0 to 10000000 mm");
    }
    if index != 0.0 && !(1.0..=LARGEST_INDEX).contains(&index) {
        return refuse("index", index, "from 1 to 5, or 0 for the medium before");
    }
    if !LENGTHS.contains(&aperture) {
        return refuse("diameter", aperture, "from 0.001 to 10000000 mm");
    }
    if let Some(abbe) = abbe.filter(|abbe| *abbe != 0.0 && !(5.0..=200.0).contains(abbe)) {
        return refuse("Abbe number", abbe, "from 5 to 200, or 0 where it is not known");
    }
    let (index, abbe) = match index {
        0.0 => before,
        1.0 => (1.0, None),
        _ => (index, abbe.filter(|abbe| *abbe != 0.0)),
    };
    Ok(LensInterface { radius, thickness, index, abbe, aperture })
}

/// What the rows must be together; with the line of the one that is wrong.
fn whole(system: &LensSystem, rows: &[Row]) -> std::result::Result<(), (u32, Error)> {
    if let Some(second) = system.stops().nth(1) {
        let message = "a second stop: only one flat row may have the same medium on both sides";
        return Err((rows[second].line, Error::scene(message).help("remove one of them")));
    }
    match system.interfaces.last() {
        Some(last) if last.index != 1.0 => {
            let message = format!("behind the last row the index is {}, must be that of air, 1", last.index);
            Err((rows[rows.len() - 1].line, Error::scene(message)))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BICONVEX: &str = "# A singlet\n#\n# by hand \n50 4 1.5 20 60 # crown\n-50 2 1 20\n0 0 0 9\n";

    fn read(text: &str) -> Result<LensSystem> {
        parse(text, Spacing::Detect, Path::new("a.dat"))
    }

    #[test]
    fn rows_and_notes_are_kept() {
        let lens = read(BICONVEX).unwrap();
        assert_eq!(lens.notes, ["A singlet", "by hand"]);
        let row = |radius, thickness, index, abbe, aperture| LensInterface {
            radius,
            thickness,
            index,
            abbe,
            aperture,
        };
        let rows = [
            row(50.0, 4.0, 1.5, Some(60.0), 20.0),
            row(-50.0, 2.0, 1.0, None, 20.0),
            row(0.0, 0.0, 1.0, None, 9.0),
        ];
        assert_eq!(lens.interfaces, rows);
        assert_eq!(lens.stops().collect::<Vec<_>>(), [2]);
        assert_eq!(lens.length(), 6.0);
    }

    #[test]
    fn both_dialects_are_the_same_lens() {
        let shifted = "50 0 1.5 20 60\n-50 4 1 20\n0 2 0 9\n";
        assert_eq!(read(shifted).unwrap().interfaces, read(BICONVEX).unwrap().interfaces);
        let told = |text, spacing| parse(text, spacing, Path::new("a.dat")).map(|lens| lens.length());
        let thin = "50 0 1.5 20\n-50 0 1 20\n";
        assert_eq!(told(thin, Spacing::Next).unwrap(), 0.0);
        assert_eq!(told("50 3 1.5 20\n-50 4 1 20\n", Spacing::Next).unwrap(), 3.0);
        assert_eq!(told("50 3 1.5 20\n-50 4 1 20\n", Spacing::Previous).unwrap(), 4.0);
    }

    #[test]
    fn what_is_no_lens_is_refused_with_its_line() {
        let many = "1 1 1.5 1\n".repeat(2000);
        for (text, expected) in [
            ("", "a.dat: a lens has two rows at least; write a row for each surface"),
            ("# nothing\n", "a.dat: a lens has two rows at least; write a row for each surface"),
            ("50 4 1.5 20\n", "a.dat: a lens has two rows at least; write a row for each surface"),
            ("\n50 4 x 20\n", "a.dat:2: `x` is not a number"),
            ("50 4 nan 20\n", "a.dat:1: a number is NaN, must be finite"),
            ("50 1e999 1 20\n", "a.dat:1: a number is inf, must be finite"),
            (
                "50 4 1.5\n",
                "a.dat:1: a row of 3 numbers, must be 4 or 5; write radius, distance, index, diameter, and perhaps the Abbe number",
            ),
            (
                "50 4 1.5 20\n-50 4 1 20\n",
                "a.dat: it is unclear what the second column is: neither end of it is 0, where one should be; say `spacing = \"next\"` for distances to the next row, or \"previous\"",
            ),
            (
                "50 0 1.5 20\n-50 0 1 20\n",
                "a.dat: it is unclear what the second column is: both ends of it are 0, where one should be; say `spacing = \"next\"` for distances to the next row, or \"previous\"",
            ),
            (
                "50 4 0.5 20\n-50 0 1 20\n",
                "a.dat:1: the index is 0.5, must be from 1 to 5, or 0 for the medium before",
            ),
            ("50 -4 1.5 20\n-50 0 1 20\n", "a.dat:1: the distance is -4, must be from 0 to 10000000 mm"),
            ("50 4 1.5 -20\n-50 0 1 20\n", "a.dat:1: the diameter is -20, must be from 0.001 to 10000000 mm"),
            (
                "1e-9 4 1.5 20\n-50 0 1 20\n",
                "a.dat:1: the radius is 0.000000001, must be 0, or from 0.001 to 10000000 mm, with any sign",
            ),
            (
                "50 4 1.5 20 1\n-50 0 1 20\n",
                "a.dat:1: the Abbe number is 1, must be from 5 to 200, or 0 where it is not known",
            ),
            (
                "50 4 1.5 20\n-50 0 1.5 20\n",
                "a.dat:2: behind the last row the index is 1.5, must be that of air, 1",
            ),
            (
                "0 1 0 9\n50 4 1.5 20\n-50 2 1 20\n0 0 0 9\n",
                "a.dat:4: a second stop: only one flat row may have the same medium on both sides; remove one of them",
            ),
            (&many, "a.dat:129: the lens has more than 128 rows"),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), expected);
        }
    }

    #[test]
    fn files_that_are_not_text_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.dat");
        std::fs::write(&path, [0x89, b'P', 0xff, 0]).unwrap();
        let error = read_lens(&path, Spacing::Detect).unwrap_err().to_string();
        assert!(error.starts_with(&format!("{}:1: `", path.display())), "{error}");
        std::fs::write(&path, vec![b' '; MOST_BYTES + 1]).unwrap();
        assert!(read_lens(&path, Spacing::Detect).unwrap_err().message.contains("larger than 1 MiB"));
    }
}
