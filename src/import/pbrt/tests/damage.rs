//! Text that is no scene gives an error and never a panic.

use super::{ALL, read};
use proptest::prelude::*;

/// Words of scenes, and some that are none.
const WORDS: &[&str] = &[
    "WorldBegin",
    "AttributeBegin",
    "AttributeEnd",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "Shape",
    "Material",
    "Texture",
    "LightSource",
    "AreaLightSource",
    "Attribute",
    "NamedMaterial",
    "MakeNamedMaterial",
    "Camera",
    "Film",
    "LookAt",
    "Scale",
    "Rotate",
    "Translate",
    "Transform",
    "ReverseOrientation",
    "\"sphere\"",
    "\"disk\"",
    "\"cylinder\"",
    "\"trianglemesh\"",
    "\"bilinearmesh\"",
    "\"loopsubdiv\"",
    "\"diffuse\"",
    "\"conductor\"",
    "\"mix\"",
    "\"float\"",
    "\"spectrum\"",
    "\"imagemap\"",
    "\"checkerboard\"",
    "\"string filename\"",
    "\"a.png\"",
    "\"float radius\"",
    "\"point3 P\"",
    "\"integer indices\"",
    "\"float power\"",
    "\"rgb L\"",
    "\"spectrum eta\"",
    "\"texture reflectance\"",
    "\"string type\"",
    "\"string materials\"",
    "\"shape\"",
    "[",
    "]",
    "0",
    "1",
    "2",
    "3",
    "-1",
    "0.5",
    "1e30",
    "1e-40",
    "nan",
    "true",
    "\"x\"",
    "\"\"",
    "\"",
    "#",
    "\n",
    "é",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn random_words_never_panic(words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..60)) {
        let _ = read(&words.join(" "));
        let _ = read(&format!("WorldBegin {}", words.join(" ")));
    }

    #[test]
    fn random_text_never_panics(text in "\\PC{0,80}") {
        let _ = read(&text);
    }

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

    /// Single numbers of a valid scene are replaced by others.
    #[test]
    fn strange_numbers_never_panic(
        place in 0..ALL.split_ascii_whitespace().count(),
        value in prop::sample::select(vec!["0", "-1", "1e38", "-1e38", "1e-40", "2147483647", "-2147483648", "1e300", "inf"]),
    ) {
        let words = ALL.lines().filter(|line| !line.trim_start().starts_with('#')).flat_map(str::split_ascii_whitespace);
        let changed = words.enumerate().map(|(i, word)| match word.trim_matches(['[', ']']).parse::<f64>() {
            Ok(_) if i == place => word.replace(word.trim_matches(['[', ']']), value),
            _ => word.to_owned(),
        });
        let _ = read(&changed.collect::<Vec<_>>().join(" "));
    }
}
