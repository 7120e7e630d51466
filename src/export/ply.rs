//! Meshes as PLY files.

use crate::scene::Mesh;

/// A binary little-endian PLY file of all vertices and triangles of a mesh: floats, which are read back as they are.
pub(super) fn ply(mesh: &Mesh) -> Vec<u8> {
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
    header += &format!(
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::read_ply;
    use crate::scene::MeshPart;
    use glam::{Vec2, Vec3, Vec4};
    use proptest::prelude::*;

    fn read_back(mesh: &Mesh) -> Mesh {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mesh.ply");
        std::fs::write(&path, ply(mesh)).unwrap();
        read_ply(&path).unwrap()
    }

    fn vector() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-1e6_f32..1e6).prop_map(Vec3::from)
    }

    fn direction() -> impl Strategy<Value = Vec3> {
        vector().prop_filter_map("no direction", |v| v.as_dvec3().try_normalize().map(|v| v.as_vec3()))
    }

    prop_compose! {
        fn meshes()(vertices in prop::collection::vec((vector(), direction(), direction(), any::<[i16; 8]>()), 3..20))
            (there in any::<[bool; 5]>(), triangles in prop::collection::vec(prop::array::uniform3(0..vertices.len() as u32), 1..20),
                vertices in Just(vertices)) -> Mesh {
            fn kept<T>(there: bool, all: impl Iterator<Item = T>) -> Vec<T> {
                all.filter(|_| there).collect()
            }
            let number = |i: i16| f32::from(i) / 777.0;
            let all = || vertices.iter();
            let end = triangles.len() as u32;
            Mesh {
                positions: all().map(|v| v.0).collect(),
                normals: kept(there[0], all().map(|v| v.1)),
                uvs: kept(there[1], all().map(|v| Vec2::new(number(v.3[0]), number(v.3[1])))),
                uvs1: kept(there[2], all().map(|v| Vec2::new(number(v.3[2]), number(v.3[3])))),
                tangents: kept(there[3], all().map(|v| v.2.extend(if v.3[4] < 0 { -1.0 } else { 1.0 }))),
                colors: kept(there[4], all().map(|v| Vec4::from([4, 5, 6, 7].map(|i| number(v.3[i]).abs())))),
                triangles,
                parts: vec![MeshPart { name: String::new(), triangles: 0..end, material: None }],
                ..Mesh::default()
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn what_is_written_is_read_back_as_it_was(mesh in meshes()) {
            prop_assert_eq!(read_back(&mesh), mesh);
        }
    }

    #[test]
    fn a_mesh_that_is_changed_is_not_the_same() {
        let mut mesh = Mesh::square();
        mesh.parts = vec![MeshPart { name: String::new(), triangles: 0..2, material: None }];
        let found = read_back(&mesh);
        assert_eq!(found, mesh);
        mesh.positions[1].x += f32::EPSILON;
        assert_ne!(found, mesh);
    }
}
