//! Files of shaders that are generated from tables: what is a row there needs a file of its own, and nothing else.

mod lights;
mod materials;

pub use lights::lights;
pub use materials::materials;

use crate::scene::{BsdfKind, PunctualKind};
use std::fmt::Write as _;

/// Virtual files that are generated, with their texts: from the tables, and the functions of a scene's textures.
pub fn generated(
    texture_glsl: &str,
    bsdfs: &[&'static BsdfKind],
    punctual_lights: &[&'static PunctualKind],
) -> [(&'static str, String); 5] {
    [
        ("generated/textures.glsl", texture_glsl.to_owned()),
        ("material/generated/inputs.glsl", materials::inputs_glsl(bsdfs)),
        ("material/generated/menu.glsl", materials::menu_glsl(bsdfs)),
        ("light/generated/inputs.glsl", lights::inputs_glsl(punctual_lights)),
        ("light/generated/menu.glsl", lights::menu_glsl(punctual_lights)),
    ]
}

/// Writes a function that says whether a kind is one of some, each with its switch and its number.
fn write_test(out: &mut String, doc: &str, name: &str, kinds: impl Iterator<Item = [String; 2]>) {
    _ = writeln!(out, "\n// {doc}\nbool {name}(uint kind)\n{{\n    bool found = false;");
    for [switch, constant] in kinds {
        _ = writeln!(out, "#ifdef {switch}\n    found = found || kind == {constant};\n#endif");
    }
    out.push_str("    return found;\n}\n");
}

/// Writes the struct of the inputs of a row, and the function that takes them out of its parameter: type and name of each field, and the
/// value of each.
fn write_inputs(out: &mut String, row: &str, parameter: &str, fields: &[(&str, &str)], values: &[String]) {
    let name = camel_case(row);
    let fields: Vec<_> = fields.iter().map(|(of, key)| format!("{of} {key};")).collect();
    _ = writeln!(out, "\nstruct {name} {{ {} }};", fields.join(" "));
    _ = writeln!(out, "{name} {row}_inputs({parameter}) {{ return {name}({}); }}", values.join(", "));
}

/// `CamelCase` of `snake_case`.
fn camel_case(name: &str) -> String {
    let capital = |word: &str| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_uppercase() + rest
    };
    name.split('_').map(capital).collect()
}
