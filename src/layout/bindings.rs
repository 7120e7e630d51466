//! The table of bindings, and `shaders/shared/bindings.glsl` written from it.

use std::fmt::Write as _;

/// How kernels read words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Backend {
    /// Uniform texel buffers of R32G32B32A32_UINT: fastest on lavapipe.
    Texel,
    /// Storage buffers: fastest on GPUs, and what naga can read and translate.
    Storage,
}

/// What a binding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BindingKind {
    /// The uniform block `Frame`.
    Uniform,
    /// Words that kernels only read, by the back end in use.
    Read,
    /// Words that one kernel writes and a later one reads: written through a storage buffer, read by the back end in
    /// use. A kernel must not read through `fetch_…` what the same dispatch wrote.
    ReadWrite,
    /// Single `uint`s in a storage buffer, read, written and counted atomically.
    Uints,
}

/// A row of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Binding {
    /// Binding number in descriptor set 0: of the uniform block, or of the storage buffer.
    pub number: u32,
    /// Binding number of the texel view, which kernels use in place of reading the storage buffer on the back end
    /// [`Backend::Texel`].
    pub view: Option<u32>,
    /// Stem of the GLSL names: `fetch_NAME(i)`, `store_NAME(i, word)`, or the array `NAME` of uints.
    pub name: &'static str,
    /// Kind.
    pub kind: BindingKind,
}

const fn row(number: u32, name: &'static str, kind: BindingKind) -> Binding {
    let view = match kind {
        BindingKind::Read | BindingKind::ReadWrite => Some(number + 32),
        BindingKind::Uniform | BindingKind::Uints => None,
    };
    Binding { number, view, name, kind }
}

/// All bindings of all kernels, in descriptor set 0. A kernel declares those that it uses.
pub const BINDINGS: &[Binding] = &[
    row(0, "frame", BindingKind::Uniform),
    row(1, "tree", BindingKind::Read),
    row(2, "schedule", BindingKind::ReadWrite),
    row(3, "instances", BindingKind::Read),
    row(4, "faces", BindingKind::Read),
    row(5, "vertices", BindingKind::Read),
    row(6, "materials", BindingKind::Read),
    row(7, "textures", BindingKind::Read),
    row(8, "texels", BindingKind::Read),
    row(9, "lights", BindingKind::Read),
    row(10, "environment", BindingKind::Read),
    row(11, "rays", BindingKind::ReadWrite),
    row(12, "hits", BindingKind::ReadWrite),
    row(13, "paths", BindingKind::ReadWrite),
    row(14, "shadows", BindingKind::ReadWrite),
    row(15, "aovs", BindingKind::ReadWrite),
    row(16, "queue", BindingKind::Uints),
    row(17, "counters", BindingKind::Uints),
    row(18, "film", BindingKind::Uints),
    row(19, "parked", BindingKind::Uints),
    row(20, "points", BindingKind::Read),
    row(21, "values", BindingKind::ReadWrite),
    row(22, "lens", BindingKind::Read),
    row(23, "details", BindingKind::Read),
];

/// The text of `shaders/shared/bindings.glsl`. Its macros are in `shared/fetch.glsl`.
pub fn bindings_glsl() -> String {
    let mut out = String::from(
        "// Written by src/layout; do not edit. The only lines with binding numbers.\n\
         #include \"shared/layout.glsl\"\n#include \"shared/fetch.glsl\"\n\n",
    );
    for binding in BINDINGS {
        let Binding { number, name, .. } = *binding;
        _ = match (binding.kind, binding.view) {
            (BindingKind::Uniform, _) => {
                writeln!(
                    out,
                    "layout(std140, set = 0, binding = {number}) uniform FrameBlock {{ Frame {name}; }};"
                )
            }
            (BindingKind::Read, Some(view)) => {
                writeln!(
                    out,
                    "READ_WORDS({number}, {view}, Words_{name}, words_{name}, texels_{name}, fetch_{name})"
                )
            }
            (BindingKind::ReadWrite, Some(view)) => writeln!(
                out,
                "READ_WRITE_WORDS({number}, {view}, Words_{name}, words_{name}, texels_{name}, fetch_{name}, store_{name})"
            ),
            _ => {
                writeln!(
                    out,
                    "layout(std430, set = 0, binding = {number}) buffer Uints_{name} {{ uint {name}[]; }};"
                )
            }
        };
    }
    out
}
