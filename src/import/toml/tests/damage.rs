//! Text that is no scene gives an error and never a panic.

use super::{ALL, read, read_set};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Bytes of a valid scene are overwritten, removed, or repeated elsewhere.
    #[test]
    fn damaged_scenes_never_panic(
        edits in prop::collection::vec((0..ALL.len(), 0..3u8, any::<u8>(), 0..ALL.len(), 0..40usize), 1..4)
    ) {
        let mut bytes = ALL.as_bytes().to_vec();
        for (at, edit, byte, from, count) in edits {
            let at = at.min(bytes.len());
            match edit {
                0 if at < bytes.len() => bytes[at] = byte & 127,
                1 => drop(bytes.drain(at..(at + count).min(bytes.len()))),
                _ => {
                    let from = from.min(bytes.len());
                    let copy = bytes[from..(from + count).min(bytes.len())].to_vec();
                    bytes.splice(at..at, copy);
                }
            }
        }
        let _ = read(&String::from_utf8_lossy(&bytes));
    }

    /// Single values are replaced by values of other types and sizes.
    #[test]
    fn strange_values_never_panic(line in 0..ALL.lines().count(), value in prop::sample::select(STRANGE.to_vec())) {
        let lines = ALL.lines().enumerate().map(|(i, text)| match text.split_once('=') {
            Some((key, _)) if i == line => format!("{key} = {value}\n"),
            _ => format!("{text}\n"),
        });
        let _ = read(&lines.collect::<String>());
    }

    #[test]
    fn strange_settings_never_panic(key in "[a-z.'\"=#\\[\\]\n0-9]{0,20}", value in ".{0,20}") {
        let _ = read_set(ALL, &[(&key, &value)]);
    }
}

const STRANGE: [&str; 22] = [
    "0",
    "-1",
    "1e30",
    "-1e38",
    "1e-40",
    "1e300",
    "nan",
    "-inf",
    "9223372036854775807",
    "'x'",
    "''",
    "true",
    "[]",
    "[[]]",
    "{}",
    "[0, 0, 0]",
    "[1e38, 1e38, -1e38]",
    "[1e-40, 0, 0]",
    "[nan, 0, 0]",
    "1979-05-27",
    "[1, 2]",
    "{ texture = 3 }",
];
