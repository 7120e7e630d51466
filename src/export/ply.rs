//! Meshes as PLY files.

use crate::scene::Mesh;

/// A binary little-endian PLY file of all vertices and triangles of a mesh: floats, which are read back as they are. Parts,
/// displacement and `round` are left out.
pub fn ply(mesh: &Mesh) -> Vec<u8> {
    let mut header =
        format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.len());
    let groups: [(bool, &[&str]); 6] = [
        (true, &["x", "y", "z"]),
        (!mesh.normals.is_empty(), &["nx", "ny", "nz"]),
        (!mesh.uvs.is_empty(), &["u", "v"]),
        (!mesh.uvs1.is_empty(), &["u1", "v1"]),
        (!mesh.tangents.is_empty(), &["tx", "ty", "tz", "tw"]),
        (!mesh.colors.is_empty(), &["red", "green", "blue", "alpha"]),
    ];
    for name in groups.iter().filter(|(there, _)| *there).flat_map(|(_, names)| *names) {
        header += &format!("property float {name}\n");
    }
    // Where both fit: some programs know no other type than `int`
    let index = if mesh.positions.len() <= i32::MAX as usize { "int" } else { "uint" };
    header += &format!(
        "element face {}\nproperty list uchar {index} vertex_indices\nend_header\n",
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    let mut put = |numbers: &[f32]| numbers.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
    for (i, position) in mesh.positions.iter().enumerate() {
        put(&position.to_array());
        mesh.normals.get(i).into_iter().for_each(|normal| put(&normal.to_array()));
        mesh.uvs.get(i).into_iter().for_each(|uv| put(&uv.to_array()));
        mesh.uvs1.get(i).into_iter().for_each(|uv| put(&uv.to_array()));
        mesh.tangents.get(i).into_iter().for_each(|tangent| put(&tangent.to_array()));
        mesh.colors.get(i).into_iter().for_each(|color| put(&color.to_array()));
    }
    for corners in &mesh.triangles {
        bytes.push(3);
        corners.iter().for_each(|corner| bytes.extend_from_slice(&corner.to_le_bytes()));
    }
    bytes
}
