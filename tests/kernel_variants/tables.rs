//! What the manual says of a new BSDF and a new light: one line of a table, and one file.

use crate::common::probe::{cache, sources};
use dapple::layout::{Backend, INPUT_COLOR, INPUT_INDEX, INPUT_SPECULAR};
use dapple::prepare::{Stage, generated, prepare};
use dapple::render::key;
use dapple::scene::{
    BSDFS, Bsdf, BsdfKind, InputColor, InputNumber, Light, LightKind, Material, PUNCTUAL_LIGHTS, Punctual,
    PunctualKind, Scene, Surface, Value,
};
use dapple::shader::Compiler;
use glam::Vec3;
use std::collections::BTreeSet;

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
    for switch in ["HAS_BSDF_MINNAERT", "HAS_LIGHT_BEAM"] {
        let with =
            compiler.kernel(&shade.clone().define(switch, 1)).unwrap_or_else(|e| panic!("{switch}: {e}"));
        assert!(with.words().len() > plain.words().len(), "{switch} adds nothing");
    }
}

static FULL_BSDF: BsdfKind = BsdfKind {
    name: "full_bsdf",
    colors: &[InputColor { key: "first", default: 0.5 }, InputColor { key: "second", default: 0.5 }],
    numbers: &[
        InputNumber { key: "one", default: 1.0, least: 0.0, most: 9.0 },
        InputNumber { key: "two", default: 2.0, least: 0.0, most: 9.0 },
    ],
};

const fn number(key: &'static str) -> InputNumber {
    InputNumber { key, default: 0.0, least: 0.0, most: 9.0 }
}

static FULL_LIGHT: PunctualKind = PunctualKind {
    name: "full_light",
    numbers: &[number("one"), number("two"), number("three"), number("four")],
    shines: Some(|_, _| 1.0),
};

#[test]
fn inputs_are_where_the_kernels_look_for_them() {
    let mut scene = Scene::default();
    let [first, second] = [0.1, 0.2].map(|grey| Value::Constant(Vec3::splat(grey)));
    let numbers = vec![Value::Constant(3.0), Value::Constant(4.0)];
    let surface = Surface::Bsdf(Bsdf { kind: &FULL_BSDF, colors: vec![first, second], numbers });
    scene.materials.add("full", Material::new(surface, None));
    let light = Punctual { kind: &FULL_LIGHT, position: Vec3::ONE, numbers: [5.0, 6.0, 7.0, 8.0] };
    scene.lights.push(Light::new(LightKind::Punctual(light), Value::Constant(Vec3::ONE)));
    let prepared = prepare(&scene).unwrap();
    let inputs = prepared.materials[0].inputs.map(|word| word.map(f32::from_bits));
    let at = |input: u32| inputs[input as usize - 1];
    assert_eq!((at(INPUT_COLOR)[0], at(INPUT_SPECULAR)[0]), (0.1, 0.2));
    assert_eq!((at(INPUT_INDEX)[0], at(INPUT_INDEX)[2]), (3.0, 4.0));
    let light = prepared.lights[0];
    assert_eq!((light.a, light.b, light.uv0), (5.0, 6.0, [7.0, 8.0]));

    let text = |file: &str| {
        let all = generated("", &[&FULL_BSDF], &[&FULL_LIGHT]);
        all.into_iter().find(|(name, _)| *name == file).unwrap().1
    };
    let inputs = text("material/generated/inputs.glsl");
    assert!(
        inputs.contains("struct FullBsdf { vec3 first; vec3 second; float one; float two; };"),
        "{inputs}"
    );
    let values = "FullBsdf(b.color, b.specular, bsdf_number(b.numbers.x, 0u, 0.0, 9.0), bsdf_number(b.numbers.y, 1u, 0.0, 9.0))";
    assert!(inputs.contains(values), "{inputs}");
    let inputs = text("light/generated/inputs.glsl");
    assert!(
        inputs.contains("struct FullLight { float one; float two; float three; float four; };"),
        "{inputs}"
    );
    assert!(inputs.contains("FullLight(light.a, light.b, light.uv0.x, light.uv0.y)"), "{inputs}");
}

#[test]
fn names_of_rows_are_theirs_alone() {
    let bsdfs: BTreeSet<_> = BSDFS.iter().map(|row| row.name).collect();
    let lights: BTreeSet<_> = PUNCTUAL_LIGHTS.iter().map(|row| row.name).collect();
    assert_eq!((bsdfs.len(), lights.len()), (BSDFS.len(), PUNCTUAL_LIGHTS.len()));
    // Their structs are in one kernel
    assert!(bsdfs.is_disjoint(&lights));
    let others =
        ["unlit", "conductor", "dielectric", "coated_diffuse", "coated_conductor", "principled", "mix"];
    assert!(others.iter().all(|kind| !bsdfs.contains(kind)));
    let others = ["point", "projection", "sphere", "disk", "quad", "cylinder", "patch", "triangle", "part"];
    assert!(others.iter().all(|kind| !lights.contains(kind)));
}
