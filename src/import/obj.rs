//! Wavefront OBJ files.
//!
//! The parser is our own: `tobj` gives no line numbers with its errors, reads faces of one or two corners as
//! points and lines, and takes words that are not numbers in some places without a word.

use super::file::{read_bytes, shown};
use super::mesh::{normalize_normals, triangulate};
use super::srgb::linear_from_srgb;
use crate::scene::{Mesh, MeshPart};
use crate::{Error, Result};
use glam::{Vec2, Vec3, Vec4};
use std::collections::HashMap;
use std::path::Path;

/// Reads the faces of an OBJ file as triangles.
///
/// * Each run of faces with one `usemtl` name is a part of that name; faces without one are named by the last `g`
///   or `o`. Material files are not read here, but with the file as a [model](super::read_model).
/// * Corners with the same indices share a vertex; all others have vertices of their own.
/// * Normals are kept, with unit length, only if every corner has one; texture coordinates likewise.
/// * A position may have a colour, `v x y z r g b`, in sRGB from 0 to 1, as Blender writes it, and alpha behind it. Where one has, those
///   without are white.
/// * Polygons are cut into triangles. Points, lines, curves, smoothing groups and unknown keywords are passed over,
///   and so are the fourth coordinate of a position and the third texture coordinate.
///
/// # Errors
/// With the line: too few or too many numbers, words that are not numbers, numbers that are not finite in single
/// precision, faces with less than three corners, index 0, and indices beyond what has been read so far. Without:
/// a file that cannot be read or has no face.
pub fn read_obj(path: &Path) -> Result<Mesh> {
    Ok(read_obj_file(path)?.mesh)
}

/// An OBJ file, with what it says of materials.
#[derive(Debug)]
pub(super) struct ObjFile {
    pub mesh: Mesh,
    /// Line and text of each `mtllib`.
    pub libraries: Vec<(u32, String)>,
    /// For each part of the mesh, whether `usemtl` has named it.
    pub wears: Vec<bool>,
}

/// The same with that.
pub(super) fn read_obj_file(path: &Path) -> Result<ObjFile> {
    let bytes = read_bytes(path)?;
    parse(&bytes).map_err(|(line, error)| error.at(path, line, 0))
}

/// Error with its line, 0 = the whole file.
type LineResult<T> = Result<T, (u32, Error)>;

/// Index of position, texture coordinate and normal of a corner; the last two may be absent.
type Corner = [u32; 3];
const ABSENT: u32 = u32::MAX;

#[derive(Default)]
struct Reader {
    /// What the file lists.
    positions: Vec<Vec3>,
    colors: Vec<Vec4>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    /// What the mesh holds: one vertex for each different corner.
    mesh: Mesh,
    vertices: HashMap<Corner, u32>,
    some_color: bool,
    some_uv_absent: bool,
    some_normal_absent: bool,
    /// Names that apply to the next face.
    material: Option<String>,
    group: String,
    wears: Vec<bool>,
    libraries: Vec<(u32, String)>,
    /// Line that is being read.
    number: u32,
    /// Vertices of the face being read.
    polygon: Vec<u32>,
}

fn parse(bytes: &[u8]) -> LineResult<ObjFile> {
    let mut reader = Reader::default();
    let mut joined = Vec::new();
    for (i, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let number = u32::try_from(i + 1).unwrap_or(u32::MAX);
        reader.number = number;
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        // A backslash at the end continues the line.
        if let Some(start) = line.strip_suffix(b"\\") {
            joined.extend_from_slice(start);
            joined.push(b' ');
            continue;
        }
        let result = if joined.is_empty() {
            reader.line(line)
        } else {
            joined.extend_from_slice(line);
            let result = reader.line(&joined);
            joined.clear();
            result
        };
        result.map_err(|error| (number, error))?;
    }
    reader.line(&joined).map_err(|error| (0, error))?;
    reader.finish().map_err(|error| (0, error))
}

impl Reader {
    fn line(&mut self, line: &[u8]) -> Result<()> {
        let line = line.trim_ascii();
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (keyword, rest) = line.split_at(end);
        match keyword {
            b"v" => {
                let ([x, y, z, r, g, b, a, _], count) = numbers::<8>("position", rest)?;
                if !matches!(count, 3 | 4 | 6 | 7) {
                    return Err(wrong_count("position", count, "3 numbers x y z"));
                }
                self.positions.push(Vec3::new(x, y, z));
                self.colors.push(color([r, g, b, a], count));
                self.some_color |= count >= 6;
            }
            b"vt" => {
                let ([u, v, ..], count) = numbers::<4>("texture coordinate", rest)?;
                if !(1..=3).contains(&count) {
                    return Err(wrong_count("texture coordinate", count, "2 numbers u v"));
                }
                self.uvs.push(Vec2::new(u, v));
            }
            b"vn" => {
                let ([x, y, z, _], count) = numbers::<4>("normal", rest)?;
                if count != 3 {
                    return Err(wrong_count("normal", count, "3 numbers x y z"));
                }
                self.normals.push(Vec3::new(x, y, z));
            }
            b"f" | b"fo" => self.face(rest)?,
            b"g" | b"o" => self.group = name(rest),
            b"mtllib" => self.libraries.push((self.number, name(rest))),
            b"usemtl" => self.material = Some(name(rest)).filter(|name| !name.is_empty()),
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, rest: &[u8]) -> Result<()> {
        let mut polygon = std::mem::take(&mut self.polygon);
        polygon.clear();
        for word in words(rest) {
            let corner = self.corner(word)?;
            polygon.push(self.vertex(corner)?);
        }
        if polygon.len() < 3 {
            let message = format!("the face has {} corners, must have at least 3", polygon.len());
            return Err(Error::scene(message).help("remove the face, or export the mesh again"));
        }
        let first = self.mesh.triangles.len();
        triangulate(&mut polygon, &self.mesh.positions, &mut self.mesh.triangles);
        self.polygon = polygon;
        let range = count_u32(first, "triangles")?..count_u32(self.mesh.triangles.len(), "triangles")?;
        let name = self.material.as_ref().unwrap_or(&self.group);
        let wears = self.material.is_some();
        match self.mesh.parts.last_mut() {
            Some(part) if part.name == *name && self.wears.last() == Some(&wears) => {
                part.triangles.end = range.end;
            }
            _ => {
                self.mesh.parts.push(MeshPart { name: name.clone(), triangles: range, material: None });
                self.wears.push(wears);
            }
        }
        Ok(())
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &[u8]) -> Result<Corner> {
        let malformed = || {
            let message = format!("`{}` is no corner of a face", shown(word));
            Error::scene(message).help("write it as v, v/vt, v//vn or v/vt/vn")
        };
        let mut fields = word.split(|&b| b == b'/');
        let mut index = |count: usize, thing: &str, may_be_absent: bool| match fields.next() {
            None | Some(b"") if may_be_absent => Ok(ABSENT),
            field => {
                let text = field.and_then(|f| std::str::from_utf8(f).ok()).ok_or_else(malformed)?;
                index(text.parse().map_err(|_| malformed())?, count, thing)
            }
        };
        let corner = [
            index(self.positions.len(), "position", false)?,
            index(self.uvs.len(), "texture coordinate", true)?,
            index(self.normals.len(), "normal", true)?,
        ];
        if fields.next().is_some() || word.ends_with(b"/") {
            return Err(malformed());
        }
        Ok(corner)
    }

    /// The vertex of a corner, made when it is new.
    fn vertex(&mut self, corner: Corner) -> Result<u32> {
        if let Some(&vertex) = self.vertices.get(&corner) {
            return Ok(vertex);
        }
        let vertex = count_u32(self.mesh.positions.len(), "vertices")?;
        let [v, vt, vn] = corner.map(|i| i as usize);
        self.mesh.positions.push(self.positions.get(v).copied().unwrap_or_default());
        self.mesh.colors.push(self.colors.get(v).copied().unwrap_or(Vec4::ONE));
        self.some_uv_absent |= corner[1] == ABSENT;
        self.some_normal_absent |= corner[2] == ABSENT;
        if !self.some_uv_absent {
            self.mesh.uvs.push(self.uvs.get(vt).copied().unwrap_or_default());
        }
        if !self.some_normal_absent {
            self.mesh.normals.push(self.normals.get(vn).copied().unwrap_or_default());
        }
        self.vertices.insert(corner, vertex);
        Ok(vertex)
    }

    fn finish(self) -> Result<ObjFile> {
        let mut mesh = self.mesh;
        if mesh.triangles.is_empty() {
            return Err(Error::scene("the mesh has no triangles").help("export it with its faces"));
        }
        if !self.some_color {
            mesh.colors = Vec::new();
        }
        if self.some_uv_absent {
            mesh.uvs = Vec::new();
        }
        if self.some_normal_absent {
            mesh.normals = Vec::new();
        }
        normalize_normals(&mut mesh);
        Ok(ObjFile { mesh, libraries: self.libraries, wears: self.wears })
    }
}

/// The colour of a position with so many numbers, of which these are the fourth and on.
fn color([r, g, b, a]: [f32; 4], count: usize) -> Vec4 {
    if count < 6 {
        return Vec4::ONE;
    }
    let [r, g, b] = [r, g, b].map(|channel| linear_from_srgb(channel.clamp(0.0, 1.0)));
    Vec4::new(r, g, b, if count > 6 { a.clamp(0.0, 1.0) } else { 1.0 })
}

/// Index from 0 of an index from 1, or from −1 backwards from the last of `count`.
fn index(given: i64, count: usize, thing: &str) -> Result<u32> {
    let count = i64::try_from(count).unwrap_or(i64::MAX);
    let index = if given < 0 { given.saturating_add(count) } else { given - 1 };
    if given == 0 {
        let message = format!("the index of a {thing} is 0, but OBJ counts from 1");
        return Err(Error::scene(message).help("use an index from 1, or a negative one from the end"));
    }
    match u32::try_from(index) {
        Ok(result) if index < count && result != ABSENT => Ok(result),
        _ => {
            let message =
                format!("the index of a {thing} is {given}, but only {count} come before this line");
            Err(Error::scene(message).help("check that the file is complete"))
        }
    }
}

fn count_u32(count: usize, things: &str) -> Result<u32> {
    u32::try_from(count).ok().filter(|&c| c != ABSENT).ok_or_else(|| {
        Error::scene(format!("the mesh has more than {} {things}", ABSENT - 1)).help("split the mesh")
    })
}

/// The words before a comment. Names are not split: 3ds Max calls its materials `Material #25`.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).take_while(|word| word[0] != b'#')
}

fn name(rest: &[u8]) -> String {
    String::from_utf8_lossy(rest.trim_ascii()).into_owned()
}

fn wrong_count(thing: &str, count: usize, wanted: &str) -> Error {
    Error::scene(format!("the {thing} has {count} numbers, must have {wanted}"))
        .help("check that the file is complete")
}

/// Up to `N` finite numbers and how many there were; the missing ones are 0.
fn numbers<const N: usize>(thing: &str, rest: &[u8]) -> Result<([f32; N], usize)> {
    let mut values = [0.0; N];
    let mut count = 0;
    for (word, value) in words(rest).zip(&mut values) {
        let parsed = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f32>().ok());
        *value = parsed.filter(|x| x.is_finite()).ok_or_else(|| {
            Error::scene(format!("`{}` in a {thing} is not a finite number", shown(word)))
                .help("export the mesh again without NaN and infinite coordinates")
        })?;
        count += 1;
    }
    Ok((values, count))
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
