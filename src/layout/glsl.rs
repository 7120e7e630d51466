//! Writes `shaders/shared/layout.glsl`.

use super::constants::CONSTANTS;
use super::{RecordInfo, records};
use std::fmt::Write as _;

/// The text of `shaders/shared/layout.glsl`: constants, then each record with its unpacking function.
pub fn layout_glsl() -> String {
    let mut out =
        String::from("// Written by src/layout; do not edit. Records are whole numbers of uvec4 words.\n\n");
    for (name, value, doc) in CONSTANTS {
        _ = writeln!(out, "const uint {name} = {value}u; // {doc}");
    }
    for record in records() {
        write_record(&mut out, record);
    }
    out
}

fn write_record(out: &mut String, record: &RecordInfo) {
    _ = writeln!(out, "\nstruct {} {{", record.name);
    for field in record.fields {
        _ = writeln!(out, "    {} {}; // {}", field.glsl_type, field.name, field.doc);
    }
    _ = writeln!(out, "}};");
    if record.words > 0 {
        write_unpack(out, record);
    }
}

fn write_unpack(out: &mut String, record: &RecordInfo) {
    let snake = snake_case(record.name);
    let words: Vec<String> = (0..record.words).map(|w| format!("uvec4 w{w}")).collect();
    _ = writeln!(out, "const uint {}_WORDS = {}u;", snake.to_uppercase(), record.words);
    _ = writeln!(out, "{} {snake}_unpack({})\n{{\n    {} r;", record.name, words.join(", "), record.name);
    for field in record.fields {
        let lanes: Vec<String> = (0..components(field.glsl_type))
            .map(|i| {
                format!(
                    "w{}.{}",
                    (field.offset + i) / 4,
                    ["x", "y", "z", "w"][((field.offset + i) % 4) as usize]
                )
            })
            .collect();
        let value = match field.glsl_type {
            "uint" => lanes[0].clone(),
            "float" => format!("uintBitsToFloat({})", lanes[0]),
            vector if vector.starts_with("uvec") => format!("{vector}({})", lanes.join(", ")),
            vector => format!("uintBitsToFloat(u{vector}({}))", lanes.join(", ")),
        };
        _ = writeln!(out, "    r.{} = {value};", field.name);
    }
    _ = writeln!(out, "    return r;\n}}");
}

fn components(glsl_type: &str) -> u32 {
    match glsl_type.chars().last() {
        Some('2') => 2,
        Some('3') => 3,
        Some('4') => 4,
        _ => 1,
    }
}

pub(super) fn snake_case(name: &str) -> String {
    let mut out = String::new();
    for (i, c) in name.chars().enumerate() {
        if c.is_uppercase() && i > 0 {
            out.push('_');
        }
        out.extend(c.to_lowercase());
    }
    out
}
