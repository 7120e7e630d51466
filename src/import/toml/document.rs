//! A TOML document as a tree of values that know their place.

use super::text::shown;
use crate::{Error, Place, Result};
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Deepest nesting that a scene can need, with room to spare; it bounds all recursion over the tree.
const MAX_DEPTH: u32 = 16;

/// Where a value stands: a source and a byte in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Spot {
    /// Index in [`Sources`].
    pub source: u32,
    /// Offset in bytes.
    pub offset: u32,
}

/// A value and its place.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub spot: Spot,
    pub data: Data,
}

/// A TOML value.
#[derive(Debug, Clone)]
pub(super) enum Data {
    Bool(bool),
    Integer(i64),
    Float(f64),
    String(String),
    Time,
    List(Vec<Node>),
    Table(Table),
}

impl Data {
    /// What this is, for messages.
    pub fn type_name(&self) -> String {
        match self {
            Self::Bool(_) => "a boolean".into(),
            Self::Integer(_) => "a whole number".into(),
            Self::Float(_) => "a decimal number".into(),
            Self::String(_) => "a string".into(),
            Self::Time => "a date or time".into(),
            Self::List(items) if items.is_empty() => "an empty list".into(),
            Self::List(items) => format!("a list of {}", items.len()),
            Self::Table(_) => "a table".into(),
        }
    }
}

/// Keys and values in the order of the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    pub entries: Vec<Entry>,
}

/// A key, its place, and its value.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub key: String,
    pub spot: Spot,
    pub node: Node,
}

impl Table {
    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }
    pub fn get_mut(&mut self, key: &str) -> Option<&mut Entry> {
        self.entries.iter_mut().find(|entry| entry.key == key)
    }
}

/// A scene file, or one `--set` of the command line.
struct Source {
    path: PathBuf,
    directory: PathBuf,
    /// None for `--set` and what no text says, where no line can be given.
    text: Option<String>,
}

/// Everything that scene text came from.
#[derive(Default)]
pub(super) struct Sources {
    sources: Vec<Source>,
}

impl Sources {
    /// Adds a file and gives its index.
    pub fn add_file(&mut self, path: &Path, text: String) -> u32 {
        let directory = path.parent().unwrap_or(Path::new("")).to_path_buf();
        self.add(Source { path: path.to_path_buf(), directory, text: Some(text) })
    }

    /// Adds a `--set key=value` for the scene `path` and gives its index.
    pub fn add_setting(&mut self, path: &Path, key: &str, value: &str) -> u32 {
        let directory = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let path = PathBuf::from(format!("--set {}={}", shown(key), shown(value)));
        self.add(Source { path, directory, text: None })
    }

    /// Adds a document that no text says, about a file, and gives its index.
    pub fn add_implied(&mut self, path: &Path) -> u32 {
        let directory = path.parent().unwrap_or(Path::new("")).to_path_buf();
        self.add(Source { path: path.to_path_buf(), directory, text: None })
    }

    fn add(&mut self, source: Source) -> u32 {
        self.sources.push(source);
        (self.sources.len() - 1) as u32
    }

    /// File, line and column of a spot.
    pub fn place(&self, spot: Spot) -> Place {
        let Some(source) = self.sources.get(spot.source as usize) else {
            return Place { file: PathBuf::new(), line: 0, column: 0 };
        };
        let (line, column) =
            source.text.as_deref().map_or((0, 0), |text| line_and_column(text, spot.offset as usize));
        Place { file: source.path.clone(), line, column }
    }

    /// Where the text of a string begins: in three quotes a line end at its beginning is not a part of it.
    pub fn text_place(&self, spot: Spot) -> Place {
        let mut place = self.place(spot);
        let text = self.sources.get(spot.source as usize).and_then(|source| source.text.as_deref());
        let literal = text.and_then(|text| text.get(spot.offset as usize..)).unwrap_or("");
        let starts =
            |quotes| literal.strip_prefix(quotes).is_some_and(|text: &str| text.starts_with(['\n', '\r']));
        if starts("\"\"\"") || starts("'''") {
            place.line += 1;
        }
        place
    }

    /// A scene error at a spot.
    pub fn error(&self, spot: Spot, message: impl Into<String>) -> Error {
        self.locate(spot, Error::scene(message))
    }

    /// Adds the place of a spot to an error that has none.
    pub fn locate(&self, spot: Spot, error: Error) -> Error {
        let place = self.place(spot);
        error.at(&place.file, place.line, place.column)
    }

    /// A file name that was written at a spot, relative to the file it was written in.
    pub fn resolve(&self, spot: Spot, name: &str) -> PathBuf {
        self.sources.get(spot.source as usize).map_or_else(|| PathBuf::from(name), |s| s.directory.join(name))
    }

    /// Parses a source that was added as a file.
    pub fn parse(&self, source: u32) -> Result<Table> {
        let text = self.sources.get(source as usize).and_then(|s| s.text.as_deref()).unwrap_or("");
        let start = Spot { source, offset: 0 };
        let table = DeTable::parse(text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let spot = Spot { offset: span.start as u32, ..start };
            let message = error.message().lines().next().unwrap_or("not TOML");
            match text.get(span) {
                Some(key) if message == "duplicate key" => {
                    self.error(spot, format!("`{}` is given twice", shown(key)))
                }
                _ => self.error(spot, message),
            }
        })?;
        self.convert_table(table.get_ref(), start, true, 0)
    }

    /// Turns a parsed value into a node. Without `offsets` all of it stands at `start`.
    pub fn convert(
        &self,
        value: &Spanned<DeValue<'_>>,
        start: Spot,
        offsets: bool,
        depth: u32,
    ) -> Result<Node> {
        let spot = if offsets { Spot { offset: value.span().start as u32, ..start } } else { start };
        if depth > MAX_DEPTH {
            return Err(self.error(spot, format!("the value is nested more than {MAX_DEPTH} levels deep")));
        }
        let data = match value.get_ref() {
            DeValue::Boolean(value) => Data::Bool(*value),
            DeValue::String(text) => Data::String(text.to_string()),
            DeValue::Datetime(_) => Data::Time,
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(value) => Data::Integer(value),
                Err(_) => {
                    let text = shown(&integer.to_string());
                    return Err(self.error(spot, format!("the whole number {text} needs more than 64 bits")));
                }
            },
            DeValue::Float(float) => match float.as_str().parse() {
                Ok(value) => Data::Float(value),
                Err(_) => return Err(self.error(spot, "not a number")),
            },
            DeValue::Array(items) => Data::List(
                items
                    .iter()
                    .map(|item| self.convert(item, spot, offsets, depth + 1))
                    .collect::<Result<_>>()?,
            ),
            DeValue::Table(table) => Data::Table(self.convert_table(table, spot, offsets, depth + 1)?),
        };
        Ok(Node { spot, data })
    }

    fn convert_table(&self, table: &DeTable<'_>, start: Spot, offsets: bool, depth: u32) -> Result<Table> {
        let mut entries = Vec::with_capacity(table.len());
        for (key, value) in table {
            let spot = if offsets { Spot { offset: key.span().start as u32, ..start } } else { start };
            let node = self.convert(value, start, offsets, depth)?;
            entries.push(Entry { key: key.get_ref().to_string(), spot, node });
        }
        // The crate keeps keys in alphabetical order.
        entries.sort_by_key(|entry| entry.spot);
        Ok(Table { entries })
    }
}

/// Line and column of a byte, both counted from 1, the column in characters.
fn line_and_column(text: &str, offset: usize) -> (u32, u32) {
    let mut end = offset.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.bytes().filter(|&byte| byte == b'\n').count();
    let column = 1 + before[line_start..].trim_start_matches('\u{feff}').chars().count();
    (line as u32, column as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let text = "\u{feff}a = 1\r\nbé = 'ü'\n";
        let at = |needle: &str| line_and_column(text, text.find(needle).unwrap());
        assert_eq!(at("a"), (1, 1));
        assert_eq!(at("="), (1, 3));
        assert_eq!(at("bé"), (2, 1));
        assert_eq!(at("'ü"), (2, 6));
        assert_eq!(line_and_column(text, 999), (3, 1));
    }

    #[test]
    fn keeps_the_order_of_the_file() {
        let mut sources = Sources::default();
        let source = sources.add_file(Path::new("a.toml"), "z = 1\na = 2\n[m]\n[c]\n".into());
        let table = sources.parse(source).unwrap();
        let keys: Vec<_> = table.entries.iter().map(|entry| entry.key.as_str()).collect();
        assert_eq!(keys, ["z", "a", "m", "c"]);
    }
}
