//! The header of a PLY file: which elements follow, and what their values are.

use super::file::shown;
use crate::{Error, Result};

/// How the values after the header are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    /// Words of text, a line for each row.
    Ascii,
    /// Bytes, least significant first.
    LittleEndian,
    /// Bytes, most significant first.
    BigEndian,
}

/// Type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(word: &str) -> Result<Self> {
        Ok(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => {
                return Err(Error::scene(format!("unknown type `{}` of a property", shown(word.as_bytes())))
                    .help("use char, uchar, short, ushort, int, uint, float or double"));
            }
        })
    }

    /// Size in a binary file.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// A value of each row of an element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    /// Type of the length, when this is a list.
    pub(super) length: Option<Scalar>,
    /// Type of the number, or of those in the list.
    pub(super) scalar: Scalar,
}

/// A table of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    /// Rows, as the header says: not to be trusted before it was held against the size of the file.
    pub(super) count: u32,
    pub(super) properties: Vec<Property>,
}

/// What the header says, and where the data begin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    /// Position of the first byte after the header.
    pub(super) end: usize,
    /// Lines of the header.
    pub(super) lines: u32,
}

/// Reads the header. Errors come with the line they are in.
pub(super) fn parse(bytes: &[u8]) -> Result<Header, (u32, Error)> {
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut end = 0;
    for (line, number) in bytes.split_inclusive(|&b| b == b'\n').zip(1_u32..) {
        end += line.len();
        let text = String::from_utf8_lossy(line);
        let words: Vec<&str> = text.split_whitespace().collect();
        if number == 1 {
            if words != ["ply"] {
                let error = Error::scene("this is no PLY file: its first line is not `ply`");
                return Err((1, error.help("check the name and the extension of the file")));
            }
            continue;
        }
        if words == ["end_header"] {
            let missing =
                || Error::scene("the header has no line with the format").help("add `format ascii 1.0`");
            let format = format.ok_or_else(|| (number, missing()))?;
            return Ok(Header { format, elements, end, lines: number });
        }
        header_line(&words, &mut format, &mut elements).map_err(|error| (number, error))?;
    }
    let error = Error::scene("the header has no line `end_header`").help("check that the file is complete");
    Err((0, error))
}

fn header_line(words: &[&str], format: &mut Option<Format>, elements: &mut Vec<Element>) -> Result<()> {
    match *words {
        [] | ["comment" | "obj_info", ..] => {}
        ["format", name, "1.0"] if format.is_none() => {
            *format = Some(match name {
                "ascii" => Format::Ascii,
                "binary_little_endian" => Format::LittleEndian,
                "binary_big_endian" => Format::BigEndian,
                _ => {
                    return Err(Error::scene(format!("unknown format `{}`", shown(name.as_bytes())))
                        .help("use ascii, binary_little_endian or binary_big_endian"));
                }
            });
        }
        ["element", name, count] => {
            let count = count.parse().map_err(|_| {
                Error::scene(format!("`{}` is no count of elements", shown(count.as_bytes())))
                    .help(format!("use a whole number up to {}", u32::MAX))
            })?;
            if elements.iter().any(|e| e.name == name) {
                return Err(Error::scene(format!("a second element `{name}`")).help("join the two"));
            }
            elements.push(Element { name: name.into(), count, properties: Vec::new() });
        }
        ["property", scalar, name] => property(elements, name, None, Scalar::parse(scalar)?)?,
        ["property", "list", length, scalar, name] => {
            let count = Scalar::parse(length)?;
            if !count.is_integer() {
                let message =
                    format!("the lengths of list `{name}` have type `{length}`, which is no whole number");
                return Err(Error::scene(message).help("use uchar, ushort or uint"));
            }
            property(elements, name, Some(count), Scalar::parse(scalar)?)?;
        }
        _ => {
            return Err(Error::scene(format!(
                "`{}` is no line of a PLY header",
                shown(words.join(" ").as_bytes())
            ))
            .help("write format, element, property, comment, obj_info or end_header"));
        }
    }
    Ok(())
}

fn property(elements: &mut [Element], name: &str, length: Option<Scalar>, scalar: Scalar) -> Result<()> {
    let Some(element) = elements.last_mut() else {
        return Err(Error::scene(format!("property `{name}` comes before the first element"))
            .help("put a line `element` before it"));
    };
    if element.properties.iter().any(|p| p.name == name) {
        let message = format!("element `{}` has two properties `{name}`", element.name);
        return Err(Error::scene(message).help("rename one of them"));
    }
    if length.is_some() && is_index_list(name) && !scalar.is_integer() {
        let message = format!("the indices in list `{name}` are no whole numbers");
        return Err(Error::scene(message).help("use int or uint"));
    }
    element.properties.push(Property { name: name.into(), length, scalar });
    Ok(())
}

/// Whether a list of this name holds the vertices of a face.
pub(super) fn is_index_list(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_types_lists_comments_and_both_line_ends() {
        let text = b"ply\r\nformat binary_big_endian 1.0\r\ncomment \xff\r\n\nobj_info x\nelement face 7\n\
            property list uint8 int vertex_index\nproperty double q\nend_header\n123";
        let header = parse(text).unwrap();
        assert_eq!(header.format, Format::BigEndian);
        assert_eq!((header.end, header.lines), (text.len() - 3, 9));
        let [element] = &header.elements[..] else { panic!("{header:?}") };
        assert_eq!((element.name.as_str(), element.count), ("face", 7));
        assert_eq!(element.properties[0].length, Some(Scalar::U8));
        assert_eq!(element.properties[1].scalar, Scalar::F64);
    }

    #[test]
    fn wrong_headers_are_errors_with_their_line() {
        for (text, line, part) in [
            ("bla", 1, "first line is not `ply`"),
            ("", 0, "no line `end_header`"),
            ("ply\nformat binary_mixed_endian 1.0\n", 2, "unknown format"),
            ("ply\nformat ascii 2.0\n", 2, "no line of a PLY header"),
            ("ply\nend_header\n", 2, "no line with the format"),
            ("ply\nformat ascii 1.0\nheh\n", 3, "`heh`"),
            ("ply\nproperty float x\n", 2, "before the first element"),
            ("ply\nelement vertex 4\nproperty float x extra\n", 3, "no line of a PLY header"),
            ("ply\nelement vertex 4\nproperty float16 x\n", 3, "unknown type `float16`"),
            ("ply\nelement vertex 4\nproperty float x\nproperty int x\n", 4, "two properties `x`"),
            ("ply\nelement vertex 4\nelement vertex 4\n", 3, "a second element `vertex`"),
            ("ply\nelement face 4\nproperty list float int vertex_indices\n", 3, "which is no whole number"),
            ("ply\nelement face 4\nproperty list int float vertex_indices\n", 3, "are no whole numbers"),
            ("ply\nelement vertex 4294967296\n", 2, "`4294967296`"),
            ("ply\nelement vertex -1\n", 2, "`-1`"),
        ] {
            let (found, error) = parse(text.as_bytes()).unwrap_err();
            assert_eq!(found, line, "{text:?}");
            assert!(error.message.contains(part), "{text:?}: {error}");
        }
    }
}
