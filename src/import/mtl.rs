//! Wavefront MTL files: the materials of OBJ files, as they are written. `scenes/obj.md` says what becomes of them.

use super::text::{closest, shown};
use crate::{Error, Result};
use glam::{Vec2, Vec3};
use std::path::Path;

/// A picture that a statement names.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Map {
    /// As it is written, with slashes.
    pub file: String,
    /// Line and column of the name.
    pub at: [u32; 2],
    /// `-s`: factor on texture coordinates.
    pub scale: Vec2,
    /// `-o`: added to them after that.
    pub offset: Vec2,
    /// `-clamp on`.
    pub clamp: bool,
    /// `-bm`: factor on heights.
    pub multiplier: f32,
}

/// A material with what its statements say.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Mtl {
    pub name: String,
    pub diffuse: Option<Vec3>,
    pub specular: Option<Vec3>,
    pub exponent: Option<f32>,
    pub ior: Option<f32>,
    /// 1 is opaque.
    pub dissolve: Option<f32>,
    pub transmission: Option<Vec3>,
    pub emission: Option<Vec3>,
    pub roughness: Option<f32>,
    pub metallic: Option<f32>,
    /// Number of the illumination model.
    pub illumination: Option<u32>,
    pub diffuse_map: Option<Map>,
    pub dissolve_map: Option<Map>,
    pub emission_map: Option<Map>,
    pub bump_map: Option<Map>,
    pub normal_map: Option<Map>,
    pub roughness_map: Option<Map>,
    pub metallic_map: Option<Map>,
}

/// Statements that are passed over without a word: a path tracer finds ambient light itself.
const NO_MEANING: [&str; 3] = ["Ka", "map_Ka", "sharpness"];
/// Statements that are read.
const KNOWN: [&str; 22] = [
    "newmtl", "Kd", "Ks", "Ke", "Tf", "Ns", "Ni", "d", "Tr", "illum", "Pr", "Pm", "map_Kd", "map_d",
    "map_Ke", "map_Bump", "bump", "norm", "map_Pr", "map_Pm", "Ka", "map_Ka",
];
/// Options that are left out, and how many words each has at most.
const OPTIONS_LEFT_OUT: [(&str, usize); 9] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

/// Reads the materials of a file, and what of it is left out.
///
/// # Errors
/// With line and column: statements before the first `newmtl`, missing or wrong numbers, numbers that are not finite, and pictures
/// without a name.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<(Vec<Mtl>, Vec<String>)> {
    let text = String::from_utf8_lossy(bytes);
    let (mut materials, mut warnings) = (Vec::new(), Vec::new());
    for (i, line) in text.lines().enumerate() {
        let mut line = Line { path, number: u32::try_from(i + 1).unwrap_or(u32::MAX), text: line, at: 0 };
        let Some(keyword) = line.word() else { continue };
        if keyword.text == "newmtl" {
            materials.push(Mtl { name: line.rest().text.to_owned(), ..Mtl::default() });
            continue;
        }
        let Some(material) = materials.last_mut() else {
            if NO_MEANING.contains(&keyword.text) {
                continue;
            }
            let message = format!("`{}` comes before the first newmtl", shown(keyword.text));
            return Err(line.error(keyword.column, message).help("begin the file with newmtl and a name"));
        };
        material.statement(&keyword, &mut line, &mut warnings)?;
    }
    Ok((materials, warnings))
}

impl Mtl {
    fn statement(
        &mut self,
        keyword: &Word<'_>,
        line: &mut Line<'_>,
        warnings: &mut Vec<String>,
    ) -> Result<()> {
        match keyword.text {
            "Kd" => self.diffuse = line.color(keyword, warnings)?,
            "Ks" => self.specular = line.color(keyword, warnings)?,
            "Ke" => self.emission = line.color(keyword, warnings)?,
            "Tf" => self.transmission = line.color(keyword, warnings)?,
            "Ns" => self.exponent = Some(line.number(keyword)?.max(0.0)),
            "Ni" => self.ior = Some(line.number(keyword)?),
            "d" => self.dissolve = Some(line.number(keyword)?.clamp(0.0, 1.0)),
            "Tr" => self.dissolve = Some(1.0 - line.number(keyword)?.clamp(0.0, 1.0)),
            "Pr" => self.roughness = Some(line.number(keyword)?.clamp(0.0, 1.0)),
            "Pm" => self.metallic = Some(line.number(keyword)?.clamp(0.0, 1.0)),
            "illum" => self.illumination = Some(line.number(keyword)?.clamp(0.0, 255.0) as u32),
            "map_Kd" => self.diffuse_map = Some(line.map(keyword, warnings)?),
            "map_d" => self.dissolve_map = Some(line.map(keyword, warnings)?),
            "map_Ke" => self.emission_map = Some(line.map(keyword, warnings)?),
            "map_Bump" | "map_bump" | "bump" => self.bump_map = Some(line.map(keyword, warnings)?),
            "norm" | "map_norm" => self.normal_map = Some(line.map(keyword, warnings)?),
            "map_Pr" => self.roughness_map = Some(line.map(keyword, warnings)?),
            "map_Pm" => self.metallic_map = Some(line.map(keyword, warnings)?),
            known if NO_MEANING.contains(&known) => {}
            other => {
                let meant = closest(other, KNOWN.into_iter());
                let meant = meant.map(|name| format!("; did you mean `{name}`?")).unwrap_or_default();
                warnings
                    .push(line.warning(keyword.column, &format!("`{}` is left out{meant}", shown(other))));
            }
        }
        Ok(())
    }
}

/// A word and the column where it begins, from 1.
struct Word<'a> {
    text: &'a str,
    column: u32,
}

/// A line that is read from left to right.
struct Line<'a> {
    path: &'a Path,
    number: u32,
    text: &'a str,
    /// Bytes that are read.
    at: usize,
}

impl<'a> Line<'a> {
    fn error(&self, column: u32, message: impl Into<String>) -> Error {
        Error::scene(message).at(self.path, self.number, column)
    }

    fn warning(&self, column: u32, message: &str) -> String {
        let file = self.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        format!("{}:{}:{column}: {message}", shown(&file), self.number)
    }

    fn left(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Column of what is read next.
    fn column(&self) -> u32 {
        let before = self.text.get(..self.at).unwrap_or_default();
        u32::try_from(before.chars().count() + 1).unwrap_or(u32::MAX)
    }

    fn skip_space(&mut self) {
        self.at = self.text.len() - self.left().trim_start().len();
    }

    /// The next word before a comment.
    fn peek(&mut self) -> Option<Word<'a>> {
        self.skip_space();
        let text = self.left().split_whitespace().next().filter(|word| !word.starts_with('#'))?;
        Some(Word { text, column: self.column() })
    }

    fn word(&mut self) -> Option<Word<'a>> {
        let word = self.peek()?;
        self.at += word.text.len();
        Some(word)
    }

    /// All that is left: names have blanks.
    fn rest(&mut self) -> Word<'a> {
        self.skip_space();
        let rest = Word { text: self.left().trim_end(), column: self.column() };
        self.at = self.text.len();
        rest
    }

    /// A number, when the next word is one.
    fn optional_number(&mut self) -> Result<Option<f32>> {
        let Some(word) = self.peek() else { return Ok(None) };
        let Ok(number) = word.text.parse::<f32>() else { return Ok(None) };
        if !number.is_finite() {
            let message = format!("`{}` is not a finite number", shown(word.text));
            return Err(self.error(word.column, message));
        }
        self.at += word.text.len();
        Ok(Some(number))
    }

    fn number(&mut self, of: &Word<'_>) -> Result<f32> {
        if let Some(number) = self.optional_number()? {
            return Ok(number);
        }
        let found = match self.peek() {
            Some(word) => format!("found `{}`", shown(word.text)),
            None => "found nothing".to_owned(),
        };
        let message = format!("`{}` must have a number, {found}", of.text);
        Err(self.error(self.column(), message))
    }

    /// One number, or three that are not negative.
    fn color(&mut self, of: &Word<'_>, warnings: &mut Vec<String>) -> Result<Option<Vec3>> {
        if let Some(word) = self.peek().filter(|word| ["spectral", "xyz"].contains(&word.text)) {
            let message =
                format!("`{} {}` is left out: colours are read as red, green and blue", of.text, word.text);
            warnings.push(self.warning(word.column, &message));
            return Ok(None);
        }
        let red = self.number(of)?;
        let color = match self.peek() {
            Some(_) => Vec3::new(red, self.number(of)?, self.number(of)?),
            None => Vec3::splat(red),
        };
        Ok(Some(color.max(Vec3::ZERO)))
    }

    /// Up to three numbers, of which u and v count.
    fn uv(&mut self, of: &Word<'_>, default: f32) -> Result<Vec2> {
        let u = self.number(of)?;
        let v = self.optional_number()?;
        self.optional_number()?;
        Ok(Vec2::new(u, v.unwrap_or(default)))
    }

    /// Options, and the name of a picture.
    fn map(&mut self, of: &Word<'_>, warnings: &mut Vec<String>) -> Result<Map> {
        let mut map = Map {
            file: String::new(),
            at: [0; 2],
            scale: Vec2::ONE,
            offset: Vec2::ZERO,
            clamp: false,
            multiplier: 1.0,
        };
        while let Some(option) = self.peek().filter(|word| word.text.starts_with('-')) {
            self.at += option.text.len();
            match option.text {
                "-s" => map.scale = self.uv(&option, 1.0)?,
                "-o" => map.offset = self.uv(&option, 0.0)?,
                "-bm" => map.multiplier = self.number(&option)?,
                "-clamp" => map.clamp = self.word().is_some_and(|word| word.text == "on"),
                other => self.leave_out(other, option.column, warnings)?,
            }
        }
        let name = self.rest();
        if name.text.is_empty() || name.text.contains('\0') {
            return Err(self.error(name.column, format!("`{}` must have the name of a picture", of.text)));
        }
        map.file = name.text.replace('\\', "/");
        map.at = [self.number, name.column];
        Ok(map)
    }

    fn leave_out(&mut self, option: &str, column: u32, warnings: &mut Vec<String>) -> Result<()> {
        let Some((_, most)) = OPTIONS_LEFT_OUT.iter().find(|(known, _)| *known == option) else {
            return Err(self.error(column, format!("`{}` is no option of a picture", shown(option))));
        };
        warnings.push(self.warning(column, &format!("the option `{option}` is left out")));
        // Words or else numbers, of which the last may be missing
        if self.optional_number()?.is_none() {
            self.word();
        }
        for _ in 1..*most {
            self.optional_number()?;
        }
        Ok(())
    }
}

#[cfg(test)]
#[path = "mtl_tests.rs"]
mod tests;
