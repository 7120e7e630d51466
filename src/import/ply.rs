//! PLY files (Stanford polygon format).
//!
//! The parser is our own: a crate that gives every face a list of its own takes more than three times the size of
//! the file in memory, and finds properties by their names for every row. This one goes over the bytes once.

use super::file::{read_bytes, shown};
use super::mesh::{normalize_normals, triangulate};
use super::ply_header::{self, Element, Format, Header, Scalar, is_index_list};
use super::ply_vertices::read_vertices;
use crate::scene::{Mesh, MeshPart};
use crate::{Error, Result};
use std::path::Path;

/// Reads the faces of a PLY file as triangles: ASCII, or binary of either byte order.
///
/// * The element `vertex` has x, y, z; it may have nx, ny, nz, u, v (or s, t, or texture_u, texture_v), u1, v1 as a second
///   set, and tangents tx, ty, tz with the side of the bitangent in tw, of any types. Normals and tangents get unit length. It
///   may have red, green, blue, and beside them alpha: whole numbers are sRGB, of which 255 is most, and 65535 for `ushort`;
///   floats are linear. Alpha is linear.
/// * The element `face` has a list `vertex_indices` or `vertex_index`. Polygons are cut into triangles.
/// * All other elements and properties are passed over. The mesh is a single part without a name.
///
/// # Errors
/// With the line, in the header and in ASCII files: unknown words, wrong numbers of values, numbers that are not
/// finite in single precision in a property that is used, faces with less than three corners, indices of vertices
/// that do not exist. Without: a file that cannot be read, ends early, or has no vertices or faces.
pub fn read_ply(path: &Path) -> Result<Mesh> {
    let bytes = read_bytes(path)?;
    parse(&bytes).map_err(|(line, error)| error.at(path, line, 0))
}

fn parse(bytes: &[u8]) -> Result<Mesh, (u32, Error)> {
    let header = ply_header::parse(bytes)?;
    let data = &bytes[header.end..];
    let mesh = match header.format {
        Format::Ascii => {
            let mut source = Ascii { bytes: data, line: header.lines + 1 };
            read(&header, &mut source).map_err(|error| (source.line, error))
        }
        Format::LittleEndian => {
            read(&header, &mut Binary::<false> { bytes: data }).map_err(|error| (0, error))
        }
        Format::BigEndian => read(&header, &mut Binary::<true> { bytes: data }).map_err(|error| (0, error)),
    };
    finish(mesh?).map_err(|error| (0, error))
}

/// Numbers in the order of the file.
pub(super) trait Source {
    fn scalar(&mut self, scalar: Scalar) -> Result<f64>;
    /// Passes over numbers, at most as many as there are bytes.
    fn skip(&mut self, scalar: Scalar, count: usize) -> Result<()>;
    fn start_row(&mut self) {}
    fn end_row(&mut self) -> Result<()> {
        Ok(())
    }
    /// Bytes that are left.
    fn left(&self) -> usize;
    /// Least bytes that a number takes.
    fn size(scalar: Scalar) -> usize;
}

struct Binary<'a, const BIG: bool> {
    bytes: &'a [u8],
}

fn ends_early() -> Error {
    Error::scene("the file ends before the data that its header announces").help("check that it is complete")
}

impl<const BIG: bool> Binary<'_, BIG> {
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (head, rest) = self.bytes.split_first_chunk::<N>().ok_or_else(ends_early)?;
        self.bytes = rest;
        let mut bytes = *head;
        if BIG {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG: bool> Source for Binary<'_, BIG> {
    #[inline]
    fn scalar(&mut self, scalar: Scalar) -> Result<f64> {
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.take()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.take()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.take()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.take()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.take()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.take()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.take()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn skip(&mut self, scalar: Scalar, count: usize) -> Result<()> {
        let bytes = count.checked_mul(scalar.bytes()).and_then(|n| self.bytes.get(n..));
        self.bytes = bytes.ok_or_else(ends_early)?;
        Ok(())
    }

    fn left(&self) -> usize {
        self.bytes.len()
    }

    fn size(scalar: Scalar) -> usize {
        scalar.bytes()
    }
}

struct Ascii<'a> {
    bytes: &'a [u8],
    line: u32,
}

impl<'a> Ascii<'a> {
    /// The next word of the line.
    fn word(&mut self) -> Result<&'a [u8]> {
        let start = self.bytes.iter().position(|&b| b == b'\n' || !b.is_ascii_whitespace());
        let (_, rest) = self.bytes.split_at(start.unwrap_or(self.bytes.len()));
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(length);
        self.bytes = rest;
        match (word, rest) {
            ([], []) => Err(ends_early()),
            ([], _) => Err(Error::scene("the line has too few values for the properties in the header")
                .help("check that it is complete")),
            _ => Ok(word),
        }
    }
}

impl Source for Ascii<'_> {
    fn scalar(&mut self, _: Scalar) -> Result<f64> {
        let word = self.word()?;
        std::str::from_utf8(word).ok().and_then(|text| text.parse().ok()).ok_or_else(|| {
            Error::scene(format!("`{}` is not a number", shown(word)))
                .help("check that the values are in the order of the header")
        })
    }

    fn skip(&mut self, _: Scalar, count: usize) -> Result<()> {
        (0..count).try_for_each(|_| self.word().map(drop))
    }

    /// Passes over empty lines.
    fn start_row(&mut self) {
        while let Some((&b, rest)) = self.bytes.split_first()
            && b.is_ascii_whitespace()
        {
            self.line = self.line.saturating_add((b == b'\n').into());
            self.bytes = rest;
        }
    }

    fn end_row(&mut self) -> Result<()> {
        let start = self.bytes.iter().position(|&b| b == b'\n' || !b.is_ascii_whitespace());
        match start.map(|i| self.bytes.split_at(i).1) {
            None => self.bytes = &[],
            Some([b'\n', rest @ ..]) => {
                self.line = self.line.saturating_add(1);
                self.bytes = rest;
            }
            Some(_) => {
                return Err(Error::scene("the line has more values than the header has properties")
                    .help("write each row on a line of its own"));
            }
        }
        Ok(())
    }

    /// With a space after the last word, which need not be there.
    fn left(&self) -> usize {
        self.bytes.len() + 1
    }

    /// A digit and a space.
    fn size(_: Scalar) -> usize {
        2
    }
}

fn read(header: &Header, source: &mut impl Source) -> Result<Mesh> {
    let mut mesh = Mesh::default();
    let vertices = header.elements.iter().find(|e| e.name == "vertex").map_or(0, |e| e.count);
    let mut polygons = Polygons { corners: Vec::new(), ends: Vec::new() };
    for element in &header.elements {
        check_count(element, source)?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, source, &mut mesh)?,
            "face" => read_faces(element, source, vertices, &mut mesh, &mut polygons)?,
            _ => skip_rows(element, source)?,
        }
    }
    // Polygons that came before the vertices.
    let mut start = 0;
    for end in polygons.ends {
        let mut polygon = polygons.corners[start..end].to_vec();
        triangulate(&mut polygon, &mesh.positions, &mut mesh.triangles);
        start = end;
    }
    Ok(mesh)
}

fn finish(mut mesh: Mesh) -> Result<Mesh> {
    if mesh.triangles.is_empty() {
        return Err(Error::scene("the mesh has no triangles").help("export it with its faces"));
    }
    let count = u32::try_from(mesh.triangles.len())
        .map_err(|_| Error::scene("the mesh has more than 2³² − 1 triangles").help("split the mesh"))?;
    mesh.parts = vec![MeshPart { name: String::new(), triangles: 0..count, material: None }];
    normalize_normals(&mut mesh);
    Ok(mesh)
}

/// Holds the rows of an element against the bytes that are left, before any memory is taken for them. A row has
/// at least its numbers and the lengths of its lists.
fn check_count<S: Source>(element: &Element, source: &S) -> Result<()> {
    let row: usize = element.properties.iter().map(|p| S::size(p.length.unwrap_or(p.scalar))).sum();
    let most = source.left().checked_div(row).unwrap_or(usize::MAX);
    if element.count as usize > most {
        let message = format!(
            "the header announces {} {} elements, but the file has room for {most} at most",
            element.count, element.name
        );
        return Err(Error::scene(message).help("check that the file is complete"));
    }
    Ok(())
}

/// Passes over the rows of an element. One without properties takes no bytes.
fn skip_rows(element: &Element, source: &mut impl Source) -> Result<()> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        source.start_row();
        for property in &element.properties {
            let count = match property.length {
                Some(length) => list_length(source, length, property.scalar)?,
                None => 1,
            };
            source.skip(property.scalar, count)?;
        }
        source.end_row()?;
    }
    Ok(())
}

pub(super) fn list_length<S: Source>(source: &mut S, length: Scalar, scalar: Scalar) -> Result<usize> {
    let value = source.scalar(length)?;
    if value < 0.0 || value.fract() != 0.0 || !value.is_finite() {
        return Err(
            Error::scene(format!("a list has the length {value}")).help("check that the file is complete")
        );
    }
    let count = value as usize;
    if count > source.left() / S::size(scalar) { Err(ends_early()) } else { Ok(count) }
}

/// Faces that wait for their vertices.
struct Polygons {
    corners: Vec<u32>,
    ends: Vec<usize>,
}

fn read_faces(
    element: &Element,
    source: &mut impl Source,
    vertices: u32,
    mesh: &mut Mesh,
    waiting: &mut Polygons,
) -> Result<()> {
    let list = element.properties.iter().position(|p| p.length.is_some() && is_index_list(&p.name));
    let list = list.ok_or_else(|| {
        Error::scene("the faces have no list of vertices").help("give them the list property vertex_indices")
    })?;
    let vertices_are_known = mesh.positions.len() == vertices as usize;
    mesh.triangles.reserve(element.count as usize);
    let mut polygon = Vec::new();
    for face in 0..element.count {
        source.start_row();
        for (i, property) in element.properties.iter().enumerate() {
            let count = match property.length {
                Some(length) => list_length(source, length, property.scalar)?,
                None => 1,
            };
            if i != list {
                source.skip(property.scalar, count)?;
                continue;
            }
            if count < 3 {
                let message = format!("face {face} has {count} corners, must have at least 3");
                return Err(Error::scene(message).help("remove the face, or export the mesh again"));
            }
            polygon.clear();
            for _ in 0..count {
                let vertex = source.scalar(property.scalar)?;
                if !(vertex >= 0.0 && vertex < f64::from(vertices) && vertex.fract() == 0.0) {
                    let message =
                        format!("face {face} has the vertex {vertex}, but there are {vertices} vertices");
                    return Err(Error::scene(message).help("use whole numbers from 0 to one below that"));
                }
                polygon.push(vertex as u32);
            }
        }
        source.end_row()?;
        if vertices_are_known {
            triangulate(&mut polygon, &mesh.positions, &mut mesh.triangles);
        } else {
            waiting.corners.extend_from_slice(&polygon);
            waiting.ends.push(waiting.corners.len());
        }
    }
    Ok(())
}

#[cfg(test)]
#[path = "ply_tests.rs"]
mod tests;
