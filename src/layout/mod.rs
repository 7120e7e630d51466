//! The only definition of what host and kernels share: records, enum numbers, constants and bindings.
//!
//! [`layout_glsl`] and [`bindings_glsl`] write `shaders/shared/layout.glsl` and `shaders/shared/bindings.glsl`,
//! which are committed; a test compares them. Every record is a whole number of 16-byte words. All but the uniform block are
//! read as `uvec4` and unpacked with `uintBitsToFloat`, because a float format may flush small integers as denormals.

#[macro_use]
mod declare;

mod bindings;
mod constants;
mod glsl;
mod lens;
mod motion;
mod patterns;
mod records;
mod textures;

pub use bindings::{BINDINGS, Backend, Binding, BindingKind, bindings_glsl};
pub use constants::*;
pub use glsl::layout_glsl;
pub use lens::{FilterCell, LensInterface, OpeningCell, PupilBounds};
pub use motion::Motion;
pub use patterns::*;
pub use records::*;
pub use textures::*;

/// Bytes of the word that kernels read.
pub const WORD_BYTES: u64 = 16;
/// An item of the buffer of trees: a [`Node`], a [`Triangle`], or the number of an instance in the first place.
pub type Item = [[u32; 4]; ITEM_WORDS as usize];
const _: () = assert!(Node::WORDS == ITEM_WORDS && Triangle::WORDS == ITEM_WORDS);

/// A material in its buffer.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Material {
    /// What it is.
    pub head: MaterialHead,
    /// Its inputs: that of `INPUT_…` i is word i − 1 here.
    pub inputs: [[u32; 4]; MATERIAL_WORDS as usize - 1],
}

/// A record in device memory: plain data, a whole number of words.
pub trait Record: bytemuck::Pod {
    /// Name in GLSL.
    const NAME: &'static str;
    /// Fields in order: name in GLSL, type in GLSL, offset in 4-byte units.
    const FIELDS: &'static [Field];
    /// Number of 16-byte words.
    const WORDS: u32;
}

/// A field of a [`Record`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// Name, the same in Rust and GLSL.
    pub name: &'static str,
    /// Its doc comment.
    pub doc: &'static str,
    /// Type in GLSL.
    pub glsl_type: &'static str,
    /// Position in 4-byte units.
    pub offset: u32,
}

/// What the writer of `layout.glsl` needs to know of a record.
#[derive(Debug, Clone, Copy)]
pub struct RecordInfo {
    /// Name in GLSL.
    pub name: &'static str,
    /// Fields in order.
    pub fields: &'static [Field],
    /// Words; 0 for the uniform block, which is not unpacked.
    pub words: u32,
}

impl RecordInfo {
    /// `Frame` is the one record in a uniform block: its fields keep to std140 by their order.
    const fn of<T: Record>() -> Self {
        let (name, frame) = (T::NAME.as_bytes(), b"Frame");
        let uniform = name.len() == frame.len() && name[0] == frame[0] && name[4] == frame[4];
        Self { name: T::NAME, fields: T::FIELDS, words: if uniform { 0 } else { T::WORDS } }
    }
}

/// Every record, in the order of `layout.glsl`.
pub fn records() -> impl Iterator<Item = &'static RecordInfo> {
    [records::ALL, textures::ALL, patterns::ALL, lens::ALL, motion::ALL].into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares a committed file with what the table writes; `BLESS=layout` rewrites it.
    fn check_written(file: &str, text: &str) {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/shared").join(file);
        if std::env::var("BLESS").is_ok_and(|what| what == "layout") {
            std::fs::write(&path, text).unwrap();
        }
        let committed = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            committed == text,
            "{file} differs from src/layout; accept with BLESS=layout cargo test layout"
        );
    }

    #[test]
    fn committed_layout_is_what_the_records_say() {
        check_written("layout.glsl", &layout_glsl());
    }

    #[test]
    fn committed_bindings_are_what_the_table_says() {
        check_written("bindings.glsl", &bindings_glsl());
    }

    #[test]
    fn at_most_24_storage_buffers_and_no_number_twice() {
        let mut numbers: Vec<u32> =
            BINDINGS.iter().flat_map(|b| [Some(b.number), b.view]).flatten().collect();
        numbers.sort_unstable();
        assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "{numbers:?}");
        let storage = BINDINGS.iter().filter(|b| b.kind != BindingKind::Uniform).count();
        assert!(storage <= 24, "{storage} storage buffers");
    }
}
