use super::*;
use proptest::prelude::*;

fn ok(text: &str) -> Mesh {
    parse(text.as_bytes()).unwrap().mesh
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
    let text = format!("{CORNERS}vt 0 0\nvt .5 1 0\nvn 0 0 2\nf 1/1/1 2/2/1 3/1/1\nf 1/2/1 2/2/1 3/1/1\n");
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
        ok(&format!("{CORNERS}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/1 2/1/1 3/1")).normals.is_empty()
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
        if let Ok(ObjFile { mesh, .. }) = parse(text.as_bytes()) {
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
        if let Ok(ObjFile { mesh, .. }) = parse(&bytes) {
            prop_assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.positions.len()));
            prop_assert!(mesh.normals.is_empty() || mesh.normals.len() == mesh.positions.len());
        }
    }
}

#[test]
fn positions_may_have_colours_in_srgb() {
    let mesh = ok("v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1 0.25\nv 1 1 0\nf 1 2 3\n");
    assert_eq!(mesh.colors[1..], [Vec4::new(0.0, 0.0, 1.0, 0.25), Vec4::ONE]);
    // Half way in sRGB is a fifth of the light
    assert!((mesh.colors[0] - Vec4::new(1.0, 0.214_041, 0.0, 1.0)).length() < 1e-5, "{}", mesh.colors[0]);
    assert!(ok("v 0 0 0 1\nv 1 0 0 1\nv 1 1 0\nf 1 2 3\n").colors.is_empty());
}
