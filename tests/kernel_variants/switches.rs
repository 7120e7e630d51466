//! The variants that `dapple shaders check` compiles have every switch and every file of the shaders.

use dapple::prepare::{Variant, Variants, variants};
use dapple::render::add_generated;
use dapple::shader::Sources;
use std::collections::BTreeSet;

/// Words of a line of GLSL.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// The text of every file, those of the scene's textures too.
fn texts() -> Vec<String> {
    let sources = Sources::embedded();
    let files = sources.names().into_iter().map(|name| sources.read(&name).unwrap());
    files.chain(variants().unwrap().into_iter().map(|set| set.texture_glsl)).collect()
}

/// Names that conditions ask for and that no file defines.
fn switches() -> BTreeSet<String> {
    let (mut asked, mut defined) = (BTreeSet::new(), BTreeSet::new());
    for text in texts() {
        for line in text.lines().filter_map(|line| line.trim_start().strip_prefix('#')) {
            let mut words = words(line);
            match words.next() {
                Some("if" | "elif" | "ifdef" | "ifndef") => asked.extend(words.map(str::to_owned)),
                Some("define") => defined.extend(words.next().map(str::to_owned)),
                _ => {}
            }
        }
    }
    asked.retain(|name| name != "defined" && !defined.contains(name));
    asked
}

fn all() -> Vec<Variant> {
    variants().unwrap().into_iter().flat_map(|set| set.kernels).collect()
}

#[test]
fn every_switch_is_on_and_off() {
    let (switches, all) = (switches(), all());
    assert!(switches.len() > 60 && switches.contains("HAS_BUMP") && switches.contains("FILTER"));
    for switch in &switches {
        let set = |variant: &&Variant| variant.defines.contains_key(switch);
        let on: Vec<_> = all.iter().filter(set).collect();
        assert!(!on.is_empty(), "no variant has {switch}: add what sets it to src/prepare/variants");
        // A kernel that has it has another variant without, or with another value; numbers of menus are constant
        let of = |variant: &Variant| (variant.file, variant.backend);
        let differs = |other: &Variant| {
            on.iter().any(|v| of(v) == of(other) && v.defines.get(switch) != other.defines.get(switch))
        };
        let is_number = all.iter().any(|variant| {
            variant.defines.iter().any(|(menu, _)| {
                switch.strip_prefix(menu.as_str()).is_some_and(|rest| rest.starts_with('_') && rest.len() > 1)
            })
        });
        let by_stage = ["TEXEL_FETCH", "PARKING"].contains(&switch.as_str());
        assert!(is_number || by_stage || all.iter().any(differs), "every variant has {switch}");
    }
}

#[test]
fn every_choice_of_a_menu_is_taken() {
    let all = all();
    for menu in ["SAMPLER", "FILTER", "CAMERA", "OPENING"] {
        let named = |name: &str| name.strip_prefix(menu).is_some_and(|rest| rest.starts_with('_'));
        let (mut there, mut taken) = (BTreeSet::new(), BTreeSet::new());
        for variant in &all {
            there.extend(variant.defines.iter().filter(|(name, _)| named(name)).map(|(_, value)| value));
            taken.extend(variant.defines.get(menu));
        }
        assert!(there.len() > 2, "{menu}");
        assert_eq!(there, taken, "{menu}");
    }
}

#[test]
fn every_file_goes_into_a_kernel() {
    let embedded = Sources::embedded().names();
    let mut reached = BTreeSet::new();
    for Variants { texture_glsl, kernels } in variants().unwrap() {
        let mut sources = Sources::embedded();
        add_generated(&mut sources, &texture_glsl).unwrap();
        let files: BTreeSet<_> = kernels.iter().map(|variant| variant.file).collect();
        reached.extend(files.into_iter().flat_map(|file| sources.reachable(file)));
    }
    let missing: Vec<_> = embedded.difference(&reached).collect();
    assert_eq!(missing, ["probe.comp"], "files that `dapple shaders check` does not compile");
}

#[test]
fn no_variant_comes_twice() {
    let all = all();
    let keys: BTreeSet<_> = all.iter().map(|v| (v.file, &v.defines)).collect();
    assert_eq!(keys.len(), all.len());
}
