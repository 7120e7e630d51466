//! Scenes of pbrt with numbers that nobody expects: an error of the reader or of the preparation, and never a panic.

use super::Memory;
use dapple::Result;
use dapple::import::{ModelChoice, read_scene_with};
use dapple::prepare::{Prepared, prepare};
use proptest::prelude::*;
use std::path::Path;

/// A scene that has all that the reader knows.
const ALL: &str = include_str!("../../src/import/pbrt/tests/all.pbrt");

/// Words of the scene, with its pictures as those that are there.
fn words() -> Vec<String> {
    let lines = ALL.lines().filter(|line| !line.trim_start().starts_with('#'));
    lines.flat_map(str::split_ascii_whitespace).map(|word| word.replace(".exr\"", ".png\"")).collect()
}

fn prepared(words: &[String]) -> Result<Prepared> {
    let text = words.join(" ");
    let mut files = Memory([("scene.pbrt", text)].into());
    let (scene, _) = read_scene_with(Path::new("scene.pbrt"), &[], &ModelChoice::default(), &mut files)?;
    prepare(&scene)
}

#[test]
fn a_scene_with_everything_is_prepared() {
    prepared(&words()).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn strange_numbers_never_panic(
        places in prop::collection::vec(any::<prop::sample::Index>(), 1..4),
        value in prop::sample::select(vec!["0", "-1", "1e38", "-1e38", "1e-40", "1e19", "2147483647", "-2147483648"]),
    ) {
        let mut words = words();
        let number = |word: &str| word.trim_matches(['[', ']']).parse::<f64>().is_ok();
        let numbers: Vec<usize> = (0..words.len()).filter(|i| number(&words[*i])).collect();
        for place in places {
            let word = &mut words[*place.get(&numbers)];
            *word = word.replace(word.trim_matches(['[', ']']), value);
        }
        let _ = prepared(&words);
    }
}
