//! The generated files of the room of materials: what BSDFs of the table read, and one switch a verb over all kinds.

use super::{write_inputs, write_test};
use crate::layout::{
    MATERIAL_BSDFS, MATERIAL_COATED_CONDUCTOR, MATERIAL_COATED_DIFFUSE, MATERIAL_CONDUCTOR,
    MATERIAL_DIELECTRIC, MATERIAL_PRINCIPLED,
};
use crate::scene::{BSDFS, BsdfKind, InputNumber};
use std::fmt::Write as _;

/// A kind of material that scatters.
pub struct MaterialRow {
    /// Its number.
    pub number: u32,
    /// Before the names of its verbs.
    name: &'static str,
    /// File with its verbs, in `material/`.
    file: &'static str,
    /// What it reads, when it is one of the table.
    bsdf: Option<&'static BsdfKind>,
}

/// Kinds that read more than colours and numbers.
const OWN: [(u32, &str, &str); 5] = [
    (MATERIAL_CONDUCTOR, "conductor", "conductor"),
    (MATERIAL_DIELECTRIC, "dielectric", "dielectric"),
    (MATERIAL_COATED_DIFFUSE, "coated_diffuse", "coated_diffuse"),
    (MATERIAL_COATED_CONDUCTOR, "coated_conductor", "coated_conductor"),
    (MATERIAL_PRINCIPLED, "principled", "principled_verbs"),
];

// A scene says in the bits of a word which kinds it has
const _: () = assert!(MATERIAL_BSDFS as usize + BSDFS.len() <= u32::BITS as usize);

/// Every kind that scatters.
pub fn materials(bsdfs: &[&'static BsdfKind]) -> impl Iterator<Item = MaterialRow> {
    let bsdfs = (MATERIAL_BSDFS..).zip(bsdfs).map(|(number, bsdf)| MaterialRow {
        number,
        name: bsdf.name,
        file: bsdf.name,
        bsdf: Some(bsdf),
    });
    bsdfs.chain(OWN.map(|(number, name, file)| MaterialRow { number, name, file, bsdf: None }))
}

impl MaterialRow {
    /// The switch of the kernels that leaves it in.
    pub fn switch(&self) -> String {
        let table = if self.bsdf.is_some() { "BSDF_" } else { "" };
        format!("HAS_{table}{}", self.name.to_uppercase())
    }

    /// Its number in GLSL.
    fn constant(&self) -> String {
        format!("MATERIAL_{}", self.name.to_uppercase())
    }

    /// What its verbs take, of a `Bsdf b`.
    fn inputs(&self) -> String {
        self.bsdf.map_or_else(|| "b".to_owned(), |bsdf| format!("{}_inputs(b)", bsdf.name))
    }
}

/// The first words of both.
const HEAD: &str = "// Written by src/prepare/menus from the table in src/scene/bsdf.rs.\n";

/// What those of the table read: for each its number, a struct of its inputs by name, and the function that takes them out of a
/// `Bsdf`.
pub(super) fn inputs_glsl(bsdfs: &[&'static BsdfKind]) -> String {
    let mut out = format!("{HEAD}#include \"material/bsdf.glsl\"\n#include \"material/input.glsl\"\n");
    let rows = || materials(bsdfs).filter_map(|row| row.bsdf.map(|bsdf| (row, bsdf)));
    for (row, _) in rows() {
        _ = writeln!(out, "const uint {} = {}u;", row.constant(), row.number);
    }
    let parts = rows().filter(|(_, bsdf)| bsdf.colors.len() > 1);
    let parts = parts.map(|(row, _)| [row.switch(), row.constant()]);
    write_test(&mut out, "Whether it has two colours, each a part of the light.", "bsdf_has_parts", parts);
    for (_, bsdf) in rows() {
        let colors = bsdf.colors.iter().map(|of| ("vec3", of.key));
        let fields: Vec<_> = colors.chain(bsdf.numbers.iter().map(|of| ("float", of.key))).collect();
        let colors = ["b.color", "b.specular"].map(str::to_owned).into_iter().take(bsdf.colors.len());
        let number = |(i, (lane, of)): (usize, (&str, &InputNumber))| {
            format!("bsdf_number(b.numbers.{lane}, {i}u, {:?}, {:?})", of.least, of.most)
        };
        let numbers = ["x", "y"].into_iter().zip(bsdf.numbers).enumerate().map(number);
        let values: Vec<_> = colors.chain(numbers).collect();
        write_inputs(&mut out, bsdf.name, "Bsdf b", &fields, &values);
    }
    out
}

/// The verbs of all kinds that scatter. Those that the scene does not use are left out by switches: `HAS_`, or `HAS_BSDF_` of the table, and
/// the name in capitals.
pub(super) fn menu_glsl(bsdfs: &[&'static BsdfKind]) -> String {
    let mut out = format!("{HEAD}#include \"material/generated/inputs.glsl\"\n");
    for row in materials(bsdfs) {
        _ = writeln!(out, "#ifdef {}\n#include \"material/{}.glsl\"\n#endif", row.switch(), row.file);
    }
    let verbs = [
        ("// Value of the BSDF, without the cosine.", "vec3", "eval", "vec3 wi", "wi", "vec3(0.0)"),
        (
            "// Density with which bsdf_sample chooses wi, over solid angle.",
            "float",
            "pdf",
            "vec3 wi",
            "wi",
            "0.0",
        ),
        ("", "BsdfSample", "sample", "float lobe, vec2 u01", "lobe, u01", "BSDF_ABSORBED"),
    ];
    for (doc, of, verb, parameters, arguments, nothing) in verbs {
        _ = writeln!(
            out,
            "\n{doc}\n{of} bsdf_{verb}(Bsdf b, vec3 wo, {parameters})\n{{\n    switch (b.kind) {{"
        );
        for row in materials(bsdfs) {
            let (switch, constant, name, inputs) = (row.switch(), row.constant(), row.name, row.inputs());
            _ = writeln!(
                out,
                "#ifdef {switch}\n    case {constant}: return {name}_{verb}({inputs}, wo, {arguments});\n#endif"
            );
        }
        _ = writeln!(out, "    default: return {nothing};\n    }}\n}}");
    }
    out
}
