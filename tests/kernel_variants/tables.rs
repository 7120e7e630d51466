//! What the manual says of a new BSDF and a new light: one line of a table, and one file.

use crate::common::probe::{cache, sources};
use dapple::layout::Backend;
use dapple::prepare::{Stage, generated, prepare};
use dapple::render::key;
use dapple::scene::{BSDFS, BsdfKind, InputColor, InputNumber, PUNCTUAL_LIGHTS, PunctualKind, Scene};
use dapple::shader::Compiler;

const MANUAL: &str = include_str!("../../scenes/live.md");

static MINNAERT: BsdfKind = BsdfKind {
    name: "minnaert",
    colors: &[InputColor { key: "color", default: 0.5 }],
    numbers: &[InputNumber { key: "darkness", default: 2.0, least: 1.0, most: 10.0 }],
};

static BEAM: PunctualKind = PunctualKind {
    name: "beam",
    numbers: &[InputNumber { key: "focus", default: 20.0, least: 1.0, most: 1000.0 }],
    shines: Some(|cosine, [focus, ..]| cosine.max(0.0).powf(focus)),
};

/// The code that follows a line of the manual, without its margin.
fn code_after(text: &str, language: &str) -> String {
    let (_, rest) = MANUAL.split_once(text).unwrap();
    let (_, code) = rest.split_once(&format!("```{language}\n")).unwrap();
    let (code, _) = code.split_once("```").unwrap();
    code.lines()
        .map(|line| line.strip_prefix("   ").unwrap_or(line))
        .fold(String::new(), |text, line| text + line + "\n")
}

fn numbers(of: &[InputNumber]) -> String {
    let one = |n: &InputNumber| format!("{} = {:?} in {:?}..={:?}", n.key, n.default, n.least, n.most);
    of.iter().map(one).collect::<Vec<_>>().join(", ")
}

#[test]
fn a_line_and_a_file_of_the_manual_are_a_bsdf_and_a_light() {
    let [color] = MINNAERT.colors else { panic!() };
    let line = format!("minnaert({} = {:?}; {});", color.key, color.default, numbers(MINNAERT.numbers));
    let said = code_after("## A BSDF of your own", "rust");
    assert!(said.trim_end().ends_with(&line), "{said} is not {line}");
    let line =
        format!("beam({}) shines |cosine, [focus, ..]| cosine.max(0.0).powf(focus);", numbers(BEAM.numbers));
    let said = code_after("## A light of your own", "rust");
    assert!(said.trim_end().ends_with(&line), "{said} is not {line}");

    let scene = Scene::default();
    let prepared = prepare(&scene).unwrap();
    let bsdfs = [BSDFS, &[&MINNAERT]].concat();
    let lights = [PUNCTUAL_LIGHTS, &[&BEAM]].concat();
    let mut sources = sources().unwrap();
    for (name, text) in generated(&prepared.texture_glsl, &bsdfs, &lights) {
        sources.set_virtual(name, text).unwrap();
    }
    sources
        .set_virtual("material/minnaert.glsl", code_after("`shaders/material/minnaert.glsl`", "glsl"))
        .unwrap();
    sources.set_virtual("light/beam.glsl", code_after("`shaders/light/beam.glsl`", "glsl")).unwrap();
    let compiler = Compiler::new(sources, cache());
    let shade = key(&scene, &prepared, Stage::Shade, None, Backend::Storage).define("HAS_LIGHTS", 1);
    let plain = compiler.kernel(&shade).unwrap();
    for switch in ["HAS_MINNAERT", "HAS_LIGHT_BEAM"] {
        let with =
            compiler.kernel(&shade.clone().define(switch, 1)).unwrap_or_else(|e| panic!("{switch}: {e}"));
        assert!(with.words().len() > plain.words().len(), "{switch} adds nothing");
    }
}
