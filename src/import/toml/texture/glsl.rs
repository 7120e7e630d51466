//! `kind = "glsl"`.

use crate::import::toml::document::Data;
use crate::import::toml::include::identity;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::{Limits, shown};
use crate::import::toml::value;
use crate::import::toml::view::{Item, View};
use crate::scene::{GlslTexture, Parameter, glsl};
use crate::{Error, Result};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Most parameters of a texture.
const MOST_PARAMETERS: usize = 64;
/// How deep files may include one another.
const DEEPEST: usize = 16;

impl Reader<'_> {
    pub(super) fn glsl_texture(&mut self, view: &View<'_>) -> Result<GlslTexture> {
        let item = view.need_either("file", "source")?;
        let mut texture = GlslTexture {
            source: String::new(),
            file: PathBuf::new(),
            line: 1,
            parameters: view.get("parameters").map_or(Ok(Vec::new()), parameters)?,
            max: view.f32_or("max", 1.0, Limits::Above(0.0))?,
        };
        if view.get("file").is_some() {
            texture.file = item.path()?;
            self.need_file(item.node.spot, &texture.file)?;
            let text = self.assets.text(&texture.file)?;
            texture.source = self.expanded(&text, &texture.file, 1, &mut vec![identity(&texture.file)])?;
        } else {
            let place = self.sources.text_place(item.node.spot);
            (texture.file, texture.line) = (place.file, place.line.max(1));
            let mut open = vec![PathBuf::new()];
            texture.source = self.expanded(item.string()?, &texture.file, texture.line, &mut open)?;
        }
        if !glsl::declared(&texture.source).contains(glsl::ENTRY) {
            let message = format!(
                "the GLSL of {} has no function `vec4 {}(TextureContext context)`",
                view.what,
                glsl::ENTRY
            );
            return Err(item.error(message).help("add it: it gives the value of the texture"));
        }
        Ok(texture)
    }

    /// A text with the files in it that it includes from its own folder. What is not there is left to the shaders of the program.
    fn expanded(&mut self, text: &str, file: &Path, line: u32, seen: &mut Vec<PathBuf>) -> Result<String> {
        if let Some((at, message)) = glsl::problem(text) {
            return Err(Error::scene(message).at(file, line + at, 0));
        }
        let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
        let mut out = String::with_capacity(text.len());
        for (row, number) in text.lines().zip(line..) {
            let name = included(row);
            let path = name.map(|name| folder.join(name));
            let Some(path) = path.filter(|path| self.assets.exists(path)) else {
                _ = writeln!(out, "{row}");
                continue;
            };
            let outside = |part: &str| part == ".." || part.contains([':', '\\']);
            if name.is_some_and(|name| name.starts_with('/') || name.split('/').any(outside)) {
                let message = "a texture may include files of its own folder only";
                return Err(Error::scene(message).at(file, number, 0).help("put the file there"));
            }
            if seen.len() > DEEPEST * DEEPEST {
                return Err(Error::scene("a texture includes too many files").at(file, number, 0));
            }
            if seen.contains(&identity(&path)) {
                out.push('\n');
                continue;
            }
            seen.push(identity(&path));
            let inner = self.assets.text(&path)?;
            let inner = self.expanded(&inner, &path, 1, seen)?;
            let name = |path: &Path| path.display().to_string().replace('\\', "/").replace('"', "'");
            _ = write!(out, "#line 1 \"{}\"\n{inner}#line {} \"{}\"\n", name(&path), number + 1, name(file));
        }
        Ok(out)
    }
}

/// The name in an `#include "name"`.
fn included(row: &str) -> Option<&str> {
    let rest = row.trim_start().strip_prefix('#')?.trim_start().strip_prefix("include")?;
    rest.trim_start().strip_prefix('"')?.split_once('"').map(|(name, _)| name)
}

/// `{ scale = 3, tint = [1, 0.5, 0.25] }`.
fn parameters(item: Item<'_>) -> Result<Vec<(String, Parameter)>> {
    let Data::Table(table) = &item.node.data else {
        return Err(item.mismatch("a table of numbers and colours"));
    };
    if table.entries.len() > MOST_PARAMETERS {
        return Err(item.error(format!("there are more than {MOST_PARAMETERS} parameters")));
    }
    let mut names = BTreeSet::new();
    let mut found = Vec::new();
    for entry in &table.entries {
        let item = Item::of_entry(item.sources, entry);
        let name = entry.key.as_str();
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let word = name.chars().all(plain) && name.starts_with(|c: char| c.is_ascii_lowercase());
        if !word
            || name.contains("__")
            || name.starts_with("gl_")
            || name == glsl::ENTRY
            || !names.insert(name)
        {
            return Err(item
                .sources
                .error(entry.spot, format!("`{}` cannot be the name of a parameter", shown(name)))
                .help("use small letters, digits and single `_`, and begin with a letter"));
        }
        let value = if item.is_number() {
            Parameter::Number(item.f32(Limits::Finite)?)
        } else {
            Parameter::Color(value::color(item, Limits::Finite)?)
        };
        found.push((name.to_owned(), value));
    }
    Ok(found)
}
