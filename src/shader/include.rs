//! Answers glslang's `#include`: names relative to the root of the tree, each file once.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use glslang::include::{IncludeHandler, IncludeResult, IncludeType};

use crate::{Error, Result};

/// How deep includes may nest. The rooms of the tree form about six layers.
const MAX_DEPTH: usize = 32;

/// How much text may go into one kernel.
const MAX_TOTAL_BYTES: usize = 16 << 20;

/// How many operators, brackets and commas one statement may have. glslang turns a sum of n terms into a tree n
/// levels deep and walks it by recursion; 400,000 terms were measured to fit the stack of `stack.rs`. Not seen: what
/// macros expand to.
const MAX_OPERATORS: usize = 100_000;

/// Reads the text of a file by its name.
pub(super) type Read<'a> = &'a (dyn Fn(&str) -> Result<String> + Sync);

/// The files that go into one kernel while it is compiled.
pub(super) struct Includes<'a> {
    read: Read<'a>,
    total_bytes: usize,
    /// Every file that went in.
    pub(super) files: BTreeSet<String>,
    /// Why a name could not be included; glslang's log only says that it could not.
    pub(super) refused: BTreeMap<String, Error>,
}

impl<'a> Includes<'a> {
    pub(super) fn new(read: Read<'a>) -> Self {
        Self { read, total_bytes: 0, files: BTreeSet::new(), refused: BTreeMap::new() }
    }

    /// The text of a file as glslang gets it; empty when the file went in before.
    pub(super) fn take(&mut self, name: &str) -> Result<String> {
        if self.files.contains(name) {
            return Ok(String::new());
        }
        let text = (self.read)(name)?;
        self.total_bytes += text.len();
        if self.total_bytes > MAX_TOTAL_BYTES {
            let limit = MAX_TOTAL_BYTES >> 20;
            return Err(Error::device(format!("more than {limit} MiB of text go into one kernel")));
        }
        refuse_reserved_directives(name, &text)?;
        refuse_endless_statements(name, &text)?;
        self.files.insert(name.to_owned());
        Ok(plain_ascii(&text))
    }

    fn answer(&mut self, ty: IncludeType, name: &str, depth: usize) -> Result<String> {
        if ty == IncludeType::System {
            return Err(Error::device(format!("`<{name}>` is not a file of the shader tree"))
                .help(format!("write #include \"{name}\"")));
        }
        if depth > MAX_DEPTH {
            return Err(Error::device(format!("includes are nested deeper than {MAX_DEPTH}")));
        }
        self.take(name)
    }
}

impl IncludeHandler for Includes<'_> {
    fn include(
        &mut self,
        ty: IncludeType,
        header_name: &str,
        _includer_name: &str,
        include_depth: usize,
    ) -> Option<IncludeResult> {
        match self.answer(ty, header_name, include_depth) {
            Ok(data) => Some(IncludeResult { name: header_name.to_owned(), data }),
            Err(error) => {
                // A name in quotes that is refused is asked for again as one in angle brackets: keep the first.
                self.refused.entry(header_name.to_owned()).or_insert(error);
                None
            }
        }
    }
}

/// The first word of a preprocessor directive in a line, and what follows it.
pub(super) fn directive(line: &str) -> Option<(&str, &str)> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start();
    let end = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
    Some(rest.split_at(end))
}

fn refuse_reserved_directives(name: &str, text: &str) -> Result<()> {
    for (line, number) in text.lines().zip(1u32..) {
        if let Some((word @ ("version" | "extension"), _)) = directive(line) {
            return Err(Error::device(format!("a shader file must not have a line #{word}"))
                .at(Path::new(name), number, 0)
                .help("remove the line: the compiler writes the same one in front of every kernel"));
        }
    }
    Ok(())
}

fn refuse_endless_statements(name: &str, text: &str) -> Result<()> {
    let mut operators = 0;
    for (line, number) in text.lines().zip(1u32..) {
        for c in line.split("//").next().unwrap_or_default().chars() {
            match c {
                ';' | '{' | '}' => operators = 0,
                c if c.is_ascii_punctuation() && c != '_' => operators += 1,
                _ => {}
            }
            if operators > MAX_OPERATORS {
                return Err(Error::device(format!("one statement has more than {MAX_OPERATORS} operators"))
                    .at(Path::new(name), number, 0)
                    .help("split it, or give a large table as a buffer or a texture"));
            }
        }
    }
    Ok(())
}

/// GLSL outside comments is ASCII. Other characters become `@`, which is not a token of GLSL: they are ignored in
/// comments and reported in code, and glslang's log cannot cut one of them in half.
fn plain_ascii(text: &str) -> String {
    let plain = |c: char| {
        if c == '\n' || c == '\r' || c == '\t' || c == ' ' || c.is_ascii_graphic() { c } else { '@' }
    };
    text.chars().map(plain).collect()
}
