use super::*;
use glam::{Vec2, Vec3, Vec4};
use proptest::prelude::*;

const HEADER: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n";

fn ascii(header: &str, data: &str) -> String {
    format!("ply\nformat ascii 1.0\n{header}{data}")
}

fn quad() -> String {
    ascii(HEADER, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
}

fn error(bytes: impl AsRef<[u8]>) -> String {
    let (line, error) = parse(bytes.as_ref()).unwrap_err();
    error.at(Path::new("m.ply"), line, 0).to_string()
}

/// The quad with more properties of its vertices, and a row of them for each.
fn quad_with(properties: &str, rows: [&str; 4]) -> String {
    let header = HEADER.replace("element face", &format!("{properties}element face"));
    let [a, b, c, d] = rows;
    ascii(&header, &format!("0 0 0 {a}\n1 0 0 {b}\n1 1 0 {c}\n0 1 0 {d}\n4 0 1 2 3\n"))
}

/// A file with one property of every type, a list to pass over, an unknown element and a quad.
fn binary(big: bool) -> Vec<u8> {
    let format = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = format!(
        "ply\nformat {format} 1.0\nelement camera 1\nproperty double fov\nproperty list ushort short k\n\
         element vertex 4\nproperty list uchar double extra\nproperty short x\nproperty double y\nproperty char z\n\
         property float nx\nproperty float ny\nproperty int nz\nproperty uchar s\nproperty ushort t\nproperty uint id\n\
         element face 2\nproperty uchar flags\nproperty list uint ushort vertex_index\nproperty list uchar float q\n\
         end_header\n"
    )
    .into_bytes();
    let mut put = |little: &[u8]| {
        let mut value = little.to_vec();
        if big {
            value.reverse();
        }
        bytes.extend(value);
    };
    put(&1.5_f64.to_le_bytes());
    put(&2_u16.to_le_bytes());
    put(&7_i16.to_le_bytes());
    put(&(-7_i16).to_le_bytes());
    for (x, y) in [(-1_i16, -1.0_f64), (1, -1.0), (1, 1.0), (-1, 1.0)] {
        put(&[1]);
        put(&9.0_f64.to_le_bytes());
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&(-3_i8).to_le_bytes());
        put(&0.0_f32.to_le_bytes());
        put(&0.0_f32.to_le_bytes());
        put(&(-5_i32).to_le_bytes());
        put(&[200]);
        put(&40000_u16.to_le_bytes());
        put(&u32::MAX.to_le_bytes());
    }
    for corners in [&[0_u16, 1, 2][..], &[0, 1, 2, 3]] {
        put(&[255]);
        put(&(corners.len() as u32).to_le_bytes());
        for corner in corners {
            put(&corner.to_le_bytes());
        }
        put(&[1]);
        put(&0.0_f32.to_le_bytes());
    }
    bytes
}

fn assert_sound(mesh: &Mesh) {
    assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.positions.len()));
    assert!(mesh.normals.iter().all(|n| n.is_normalized()));
    assert_eq!(mesh.parts[0].triangles, 0..mesh.triangles.len() as u32);
}

#[test]
fn reads_text() {
    let mesh = parse(quad().as_bytes()).unwrap();
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty());
    assert_sound(&mesh);
    // Other line ends, empty lines and no end of the last line change nothing.
    let crlf = quad().replace('\n', "\r\n").replace("1 1 0", " \t\r\n1 1\t0 ");
    assert_eq!(parse(crlf.trim_end().as_bytes()).unwrap(), mesh);
}

#[test]
fn reads_both_byte_orders_and_all_types() {
    let mesh = parse(&binary(false)).unwrap();
    assert_eq!(mesh.positions[2], Vec3::new(1.0, 1.0, -3.0));
    assert_eq!(mesh.normals, [-Vec3::Z; 4]);
    assert_eq!(mesh.uvs, [Vec2::new(200.0, 40000.0); 4]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
    assert_sound(&mesh);
    assert_eq!(parse(&binary(true)).unwrap(), mesh);
}

#[test]
fn faces_may_come_before_the_vertices() {
    let header = "element face 1\nproperty list uchar int vertex_index\nelement vertex 4\n\
        property float x\nproperty float y\nproperty float z\nend_header\n";
    let mesh = parse(ascii(header, "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n").as_bytes()).unwrap();
    assert_eq!(mesh, parse(quad().as_bytes()).unwrap());
}

#[test]
fn whole_numbers_of_colours_are_srgb_and_floats_are_linear() {
    let colored = |types: [&str; 2], rows: [&str; 4]| {
        let [color, alpha] = types;
        let properties = format!(
            "property {color} red\nproperty {color} green\nproperty {color} blue\n{}",
            if alpha.is_empty() { String::new() } else { format!("property {alpha} alpha\n") }
        );
        parse(quad_with(&properties, rows).as_bytes()).unwrap().colors
    };
    let near = |found: Vec4, expected: [f32; 4]| {
        assert!((found - Vec4::from_array(expected)).length() < 1e-5, "{found}, expected {expected:?}");
    };
    let bytes = colored(["uchar", "uchar"], ["255 0 0 255", "0 188 0 51", "0 0 300 0", "-3 1 1 1"]);
    near(bytes[0], [1.0, 0.0, 0.0, 1.0]);
    near(bytes[1], [0.0, 0.502_886, 0.0, 0.2]);
    near(bytes[2], [0.0, 0.0, 1.0, 0.0]);
    let words = colored(["ushort", ""], ["65535 0 0", "0 48316 0", "0 0 0", "0 0 0"]);
    near(words[1], [0.0, 0.502_886, 0.0, 1.0]);
    let floats = colored(["float", "float"], ["1 0.5 0.25 0.5", "2 0 0 1", "0 0 0 0", "0 0 0 0"]);
    assert_eq!(floats[..2], [Vec4::new(1.0, 0.5, 0.25, 0.5), Vec4::new(2.0, 0.0, 0.0, 1.0)]);
    assert!(parse(quad().as_bytes()).unwrap().colors.is_empty());
}

#[test]
fn a_second_set_and_tangents_of_any_length() {
    let with = |names: &[&str], rows: [&str; 4]| {
        let properties: String = names.iter().map(|name| format!("property float {name}\n")).collect();
        quad_with(&properties, rows)
    };
    let read = |names: &[&str], rows| parse(with(names, rows).as_bytes()).unwrap();
    let tangent = ["tx", "ty", "tz", "tw"];
    let tangents = read(&tangent, ["3 0 4 1", "0 2 0 -0.5", "0 0 1e-30 0", "0 0 0 -1"]).tangents;
    let expected = [[0.6, 0.0, 0.8, 1.0], [0.0, 1.0, 0.0, -1.0], [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 0.0, -1.0]];
    for (found, expected) in tangents.iter().zip(expected) {
        assert!((*found - Vec4::from_array(expected)).length() < 1e-6, "{found}, expected {expected:?}");
    }
    // One that has no side is no tangent, and one number is no set
    assert!(read(&tangent[..3], ["1 0 0"; 4]).tangents.is_empty());
    assert!(read(&["u1"], ["1"; 4]).uvs1.is_empty());
    let mesh = read(&["v1", "u1"], ["1 2", "3 4", "5 6", "7 8"]);
    assert!(mesh.uvs.is_empty());
    assert_eq!(mesh.uvs1[..2], [Vec2::new(2.0, 1.0), Vec2::new(4.0, 3.0)]);
    for (names, right, wrong, which) in
        [(&tangent[..], "1 0 0 1", "1 0 nan 1", "tz"), (&["u1", "v1"][..], "0 0", "inf 0", "u1")]
    {
        let message = error(with(names, [right, wrong, right, right]));
        assert!(message.contains(&format!("{which} of vertex 1 is not a finite number")), "{message}");
    }
}

#[test]
fn elements_without_properties_take_no_time() {
    let header = format!("element nothing 4294967295\n{HEADER}");
    let text = ascii(&header, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3");
    assert_eq!(parse(text.as_bytes()), parse(quad().as_bytes()));
}

#[test]
fn errors_name_the_line_and_the_thing() {
    let quad = quad();
    for (from, to, part) in [
        ("1 1 0\n", "1 1\n", "m.ply:12: the line has too few values"),
        ("1 1 0\n", "1 1 0 0\n", "m.ply:12: the line has more values"),
        ("1 1 0\n", "1 nan 0\n", "m.ply:12: y of vertex 2 is not a finite number"),
        ("1 1 0\n", "1 1e39 0\n", "y of vertex 2 is not a finite number"),
        ("1 1 0\n", "1 x 0\n", "m.ply:12: `x` is not a number"),
        ("4 0 1 2 3\n", "4 0 1 2 4\n", "m.ply:14: face 0 has the vertex 4, but there are 4 vertices"),
        ("4 0 1 2 3\n", "4 0 1 2 -1\n", "face 0 has the vertex -1"),
        ("4 0 1 2 3\n", "4 0 1 2 0.5\n", "face 0 has the vertex 0.5"),
        ("4 0 1 2 3\n", "4 0 1 2 nan\n", "face 0 has the vertex NaN"),
        ("4 0 1 2 3\n", "2 0 1\n", "face 0 has 2 corners"),
        ("4 0 1 2 3\n", "-3 0 1 2\n", "a list has the length -3"),
        ("4 0 1 2 3\n", "1e9 0 1 2\n", "the file ends before"),
        ("4 0 1 2 3\n", "4 0 1 2", "the file ends before"),
        ("4 0 1 2 3\n", "", "room for 0 at most"),
        ("float y", "float q", "no complete position"),
        ("vertex_indices", "corners", "no list of vertices"),
        ("face 1", "face 0", "m.ply: the mesh has no triangles"),
        ("vertex 4", "vertex 4294967295", "announces 4294967295 vertex elements, but the file has room for"),
    ] {
        let text = quad.replacen(from, to, 1);
        assert!(error(&text).contains(part), "{to:?}: {}", error(&text));
    }
    assert!(error(ascii("end_header\n", "")).contains("no triangles"));
}

#[test]
fn cut_files_are_errors_at_every_length() {
    for whole in [quad().trim_end().as_bytes(), &binary(false)] {
        for length in 0..whole.len() {
            assert!(parse(&whole[..length]).is_err(), "{length} of {} bytes", whole.len());
        }
    }
}

proptest! {
    #[test]
    fn damaged_files_give_a_sound_mesh_or_an_error(
        kind in 0_usize..3,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = [quad().into_bytes(), binary(false), binary(true)][kind].clone();
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Ok(mesh) = parse(&bytes) {
            assert_sound(&mesh);
        }
    }

    #[test]
    fn any_bytes_after_a_good_header_give_a_mesh_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut file = format!("ply\nformat binary_little_endian 1.0\n{HEADER}").into_bytes();
        file.extend(bytes);
        if let Ok(mesh) = parse(&file) {
            assert_sound(&mesh);
        }
    }
}
