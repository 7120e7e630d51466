//! The generated files of the room of lights: what those of the table read, and a switch over them.

use super::{write_inputs, write_test};
use crate::layout::LIGHT_PUNCTUAL;
use crate::scene::{PUNCTUAL_LIGHTS, PunctualKind};
use std::fmt::Write as _;

/// A light of the table.
pub struct LightRow {
    /// Its number.
    pub number: u32,
    kind: &'static PunctualKind,
}

// A scene says in the bits of a word which kinds it has
const _: () = assert!(LIGHT_PUNCTUAL as usize + PUNCTUAL_LIGHTS.len() <= u32::BITS as usize);

/// Every light of the table.
pub fn lights(kinds: &[&'static PunctualKind]) -> impl Iterator<Item = LightRow> {
    (LIGHT_PUNCTUAL..).zip(kinds).map(|(number, kind)| LightRow { number, kind })
}

impl LightRow {
    /// The switch of the kernels that leaves it in.
    pub fn switch(&self) -> String {
        format!("HAS_{}", self.constant())
    }

    /// Its number in GLSL.
    fn constant(&self) -> String {
        format!("LIGHT_{}", self.kind.name.to_uppercase())
    }
}

/// The first words of both.
const HEAD: &str = "// Written by src/prepare/menus from the table in src/scene/punctual.rs.\n";

/// For each its number, a struct of its numbers by name, and the function that takes them out of a `Light`.
pub(super) fn inputs_glsl(kinds: &[&'static PunctualKind]) -> String {
    let mut out = format!("{HEAD}#include \"light/sample.glsl\"\n");
    for row in lights(kinds) {
        _ = writeln!(out, "const uint {} = {}u;", row.constant(), row.number);
    }
    let far = lights(kinds).filter(|row| row.kind.shines.is_none());
    let far = far.map(|row| [row.switch(), row.constant()]);
    write_test(&mut out, "Whether it is infinitely far away.", "punctual_is_far", far);
    for LightRow { kind, .. } in lights(kinds).filter(|row| !row.kind.numbers.is_empty()) {
        let fields: Vec<_> = kind.numbers.iter().map(|number| ("float", number.key)).collect();
        let lanes = ["light.a", "light.b", "light.uv0.x", "light.uv0.y"].map(str::to_owned);
        write_inputs(&mut out, kind.name, "Light light", &fields, &lanes[..fields.len()]);
    }
    out
}

/// The verb of all of them. Those that the scene does not use are left out by switches: `HAS_LIGHT_` and the name in capitals.
pub(super) fn menu_glsl(kinds: &[&'static PunctualKind]) -> String {
    let mut out = format!("{HEAD}#include \"light/generated/inputs.glsl\"\n");
    for row in lights(kinds) {
        _ = writeln!(out, "#ifdef {}\n#include \"light/{}.glsl\"\n#endif", row.switch(), row.kind.name);
    }
    out += "\nLightSample punctual_sample(Light light, vec3 from, vec2 u01)\n{\n    switch (light.kind) {\n";
    for row in lights(kinds) {
        let (switch, constant, name) = (row.switch(), row.constant(), row.kind.name);
        let numbers =
            if row.kind.numbers.is_empty() { String::new() } else { format!("{name}_inputs(light), ") };
        _ = writeln!(
            out,
            "#ifdef {switch}\n    case {constant}: return {name}_sample(light, {numbers}from, u01);\n#endif"
        );
    }
    out + "    default: return LIGHT_NOTHING;\n    }\n}\n"
}
