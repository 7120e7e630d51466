//! Wavefront OBJ files.
//!
//! The parser is our own: `tobj` gives no line numbers with its errors, reads faces of one or two corners as
//! points and lines, and takes words that are not numbers in some places without a word.

use super::file::{read_bytes, shown};
use super::mesh::{normalize_normals, triangulate};
use crate::scene::{Mesh, MeshPart};
use crate::{Error, Result};
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::path::Path;

/// Reads the faces of an OBJ file as triangles.
///
/// * Each run of faces with one `usemtl` name is a part of that name; faces without one are named by the last `g`
///   or `o`. Material files are not read.
/// * Corners with the same indices share a vertex; all others have vertices of their own.
/// * Normals are kept, with unit length, only if every corner has one; texture coordinates likewise.
/// * Polygons are cut into triangles. Points, lines, curves, smoothing groups and unknown keywords are passed over,
///   and so are the fourth coordinate or the colour of a position and the third texture coordinate.
///
/// # Errors
/// With the line: too few or too many numbers, words that are not numbers, numbers that are not finite in single
/// precision, faces with less than three corners, index 0, and indices beyond what has been read so far. Without:
/// a file that cannot be read or has no face.
pub fn read_obj(path: &Path) -> Result<Mesh> {
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
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    /// What the mesh holds: one vertex for each different corner.
    mesh: Mesh,
    vertices: HashMap<Corner, u32>,
    some_uv_absent: bool,
    some_normal_absent: bool,
    /// Names that apply to the next face.
    material: Option<String>,
    group: String,
    /// Vertices of the face being read.
    polygon: Vec<u32>,
}

fn parse(bytes: &[u8]) -> LineResult<Mesh> {
    let mut reader = Reader::default();
    let mut joined = Vec::new();
    for (i, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let number = u32::try_from(i + 1).unwrap_or(u32::MAX);
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
                let ([x, y, z, ..], count) = numbers::<8>("position", rest)?;
                if !matches!(count, 3 | 4 | 6 | 7) {
                    return Err(wrong_count("position", count, "3 numbers x y z"));
                }
                self.positions.push(Vec3::new(x, y, z));
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
        match self.mesh.parts.last_mut() {
            Some(part) if part.name == *name => part.triangles.end = range.end,
            _ => self.mesh.parts.push(MeshPart { name: name.clone(), triangles: range, material: None }),
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

    fn finish(self) -> Result<Mesh> {
        let mut mesh = self.mesh;
        if mesh.triangles.is_empty() {
            return Err(Error::scene("the mesh has no triangles").help("export it with its faces"));
        }
        if self.some_uv_absent {
            mesh.uvs = Vec::new();
        }
        if self.some_normal_absent {
            mesh.normals = Vec::new();
        }
        normalize_normals(&mut mesh);
        Ok(mesh)
    }
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
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ok(text: &str) -> Mesh {
        parse(text.as_bytes()).unwrap()
    }

    fn error(text: &str) -> String {
        let (line, error) = parse(text.as_bytes()).unwrap_err();
        error.at(Path::new("m.obj"), line, 0).to_string()
    }

    const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn triangles_polygons_and_indices_from_the_end() {
        let mesh = ok(&format!("{CORNERS}f 1 2 3\nf -4 -3 -2 -1 # a quad\n"));
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.parts, [MeshPart { name: String::new(), triangles: 0..3, material: None }]);
        assert!(mesh.normals.is_empty() && mesh.uvs.is_empty());
    }

    #[test]
    fn corners_with_different_indices_are_different_vertices() {
        let text =
            format!("{CORNERS}vt 0 0\nvt .5 1 0\nvn 0 0 2\nf 1/1/1 2/2/1 3/1/1\nf 1/2/1 2/2/1 3/1/1\n");
        let mesh = ok(&text);
        assert_eq!(mesh.triangles, [[0, 1, 2], [3, 1, 2]]);
        assert_eq!(mesh.positions[0], mesh.positions[3]);
        assert_eq!(mesh.uvs[3], Vec2::new(0.5, 1.0));
        assert_eq!(mesh.normals, [Vec3::Z; 4]);
    }

    #[test]
    fn one_corner_without_normal_or_uv_drops_them_all() {
        let mesh = ok(&format!("{CORNERS}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2/1/1 3/1/1"));
        assert!(mesh.uvs.is_empty());
        assert_eq!(mesh.normals.len(), 4);
        assert!(
            ok(&format!("{CORNERS}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/1 2/1/1 3/1"))
                .normals
                .is_empty()
        );
    }

    #[test]
    fn zero_normals_become_face_normals() {
        let mesh = ok(&format!("{CORNERS}vn 0 0 0\nvn 1 0 0\nf 1//1 2//2 3//2"));
        assert_eq!(mesh.normals, [Vec3::Z, Vec3::X, Vec3::X]);
    }

    #[test]
    fn parts_take_the_material_name_or_else_the_group() {
        let faces =
            "o box\nf 1 2 3\ng top side\nf 1 2 3\nusemtl red #25\nf 1 2 3\ng x\nf 1 2 3\nusemtl b\nf 1 2 3";
        let mesh = ok(&format!("{CORNERS}{faces}"));
        let parts: Vec<_> = mesh.parts.iter().map(|p| (p.name.as_str(), p.triangles.clone())).collect();
        assert_eq!(parts, [("box", 0..1), ("top side", 1..2), ("red #25", 2..4), ("b", 4..5)]);
    }

    #[test]
    fn line_ends_and_continued_lines() {
        let mesh = ok("v 0 0 0\r\nv 1 0\\\r\n 0\r\nv 1 1 0 1\r\n\tf 1 2 \\\n3");
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
        assert_eq!(ok("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\\").triangles.len(), 1);
    }

    #[test]
    fn errors_name_the_line_and_the_thing() {
        assert_eq!(
            error("v 0 0 0\nv 1 0\n"),
            "m.obj:2: the position has 2 numbers, must have 3 numbers x y z; check that the file is complete"
        );
        assert_eq!(
            error(&format!("{CORNERS}f 1 2 5")),
            "m.obj:5: the index of a position is 5, but only 4 come before this line; check that the file is complete"
        );
        for (text, part) in [
            ("v 0 nan 0", ":1: `nan` in a position is not a finite number"),
            ("v 0 1e39 0", "`1e39` in a position"),
            ("v 0 x 0", "`x` in a position"),
            ("v 1 2 3 4 5", "has 5 numbers"),
            ("vt", "has 0 numbers"),
            ("vn 0 0 1 0", "has 4 numbers"),
            ("v 0 0 0\nf 1 1 0", ":2: the index of a position is 0"),
            ("v 0 0 0\nf 1 1 -2", "is -2, but only 1"),
            ("v 0 0 0\nf 1 1/1 1", "texture coordinate is 1, but only 0"),
            ("v 0 0 0\nf 1 1//1 1", "normal is 1, but only 0"),
            ("v 0 0 0\nf 1 1", "the face has 2 corners"),
            ("v 0 0 0\nf", "the face has 0 corners"),
            ("v 0 0 0\nf 1/ 1 1", "`1/` is no corner"),
            ("v 0 0 0\nf 1 1 1/1/1/1", "is 1, but only 0"),
            ("v 0 0 0\nf 1 1 1////", "`1////` is no corner"),
            ("v 0 0 0\nf 1 1 99999999999999999999", "is no corner"),
            ("v 0 0 0\nf 1 1 -9223372036854775808", "but only 1"),
            ("", "m.obj: the mesh has no triangles"),
            ("v 0 0 0", "has no triangles"),
        ] {
            assert!(error(text).contains(part), "{text:?}: {}", error(text));
        }
    }

    proptest! {
        #[test]
        fn any_text_gives_a_sound_mesh_or_an_error(text in "([vf]|vt|vn|o|usemtl|[-0-9./ ]{1,9}|[\n\\\\]|[ -~]){0,80}") {
            if let Ok(mesh) = parse(text.as_bytes()) {
                prop_assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.positions.len()));
            }
        }

        #[test]
        fn any_bytes_give_a_mesh_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = parse(&bytes);
        }

        #[test]
        fn damaged_files_give_a_sound_mesh_or_an_error(at in 0_usize..100, byte: u8) {
            let mut bytes = format!("{CORNERS}vt 0 0\nvn 0 0 2\nf 1/1/1 2/1/1 3/1/1 -1/-1/-1\nusemtl b\nf 1 2 3\n").into_bytes();
            let at = at % bytes.len();
            bytes[at] = byte;
            if let Ok(mesh) = parse(&bytes) {
                prop_assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.positions.len()));
                prop_assert!(mesh.normals.is_empty() || mesh.normals.len() == mesh.positions.len());
            }
        }
    }
}
