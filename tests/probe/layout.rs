//! Records by value: what the generated GLSL reads in each field is what Rust put there.

use crate::common::probe::{Probe, UNWRITTEN, Word};
use dapple::layout::{Backend, Field, Frame, RecordInfo, records};
use std::fmt::Write as _;

/// Number of 4-byte units that a field takes, and how to turn it to uints.
fn components(field: &Field) -> (u32, bool) {
    let size = match field.glsl_type.chars().last() {
        Some('2') => 2,
        Some('3') => 3,
        Some('4') => 4,
        _ => 1,
    };
    (size, field.glsl_type.starts_with("float") || field.glsl_type.starts_with("vec"))
}

/// GLSL that writes the n-th component of a record `r` to word n.
fn write_back(record: &RecordInfo) -> (String, Vec<u32>) {
    let (mut glsl, mut offsets) = (String::new(), Vec::new());
    for field in record.fields {
        let (size, float) = components(field);
        for i in 0..size {
            let lane = if size == 1 { String::new() } else { format!("[{i}]") };
            let value = format!("r.{}{lane}", field.name);
            let value = if float { format!("floatBitsToUint({value})") } else { value };
            _ = writeln!(glsl, "    store_values({}u, uvec4({value}));", offsets.len());
            offsets.push(field.offset + i);
        }
    }
    (glsl, offsets)
}

fn check(record: &RecordInfo, offsets: &[u32], values: &[Word]) {
    // One word more than there are components: the kernel wrote what it should and nothing else
    assert_eq!(values.last(), Some(&[UNWRITTEN; 4]), "{}", record.name);
    for (offset, value) in offsets.iter().zip(values) {
        assert_eq!(value, &[*offset; 4], "{} at unit {offset}", record.name);
    }
}

#[test]
fn unpacked_fields_are_where_rust_has_them() {
    let mut seen = 0;
    for record in records().filter(|r| r.words > 0) {
        let snake: String = record.name.char_indices().fold(String::new(), |mut out, (i, c)| {
            if c.is_uppercase() && i > 0 {
                out.push('_');
            }
            out.extend(c.to_lowercase());
            out
        });
        let words: Vec<String> = (0..record.words).map(|w| format!("fetch_points({w}u)")).collect();
        let (body, offsets) = write_back(record);
        let glsl = format!(
            "void probe(uint i)\n{{\n    {} r = {snake}_unpack({});\n{body}}}\n",
            record.name,
            words.join(", ")
        );
        assert_eq!(offsets.len(), record.words as usize * 4, "{} has holes", record.name);
        let inputs: Vec<Word> = (0..record.words).map(|w| [4 * w, 4 * w + 1, 4 * w + 2, 4 * w + 3]).collect();
        check(record, &offsets, &Probe::new().both(&glsl, &inputs, 1, offsets.len() + 1));
        seen += 1;
    }
    assert_eq!(seen, records().count() - 1, "all but the uniform block");
}

#[test]
fn the_uniform_block_is_where_std140_has_it() {
    let record = records().find(|r| r.name == "Frame").unwrap();
    let units: Vec<u32> = (0..size_of::<Frame>() as u32 / 4).collect();
    let frame: Frame = bytemuck::pod_read_unaligned(bytemuck::cast_slice(&units));
    let (body, offsets) = write_back(record);
    // The number of points is what its place says; only the first writes
    let glsl = format!("void probe(uint i)\n{{\n    if (i > 0u) return;\n    Frame r = frame;\n{body}}}\n");
    for backend in [Backend::Texel, Backend::Storage] {
        let values = Probe::new().run_with_frame(&glsl, backend, &frame, &[], offsets.len() + 1);
        check(record, &offsets, &values);
    }
}
