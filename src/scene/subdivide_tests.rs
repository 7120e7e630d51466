//! Limit points and tangents in closed form, and meshes that cannot be subdivided.

use crate::scene::{Mesh, MeshPart};
use glam::{Vec2, Vec3};

/// Faces of the octahedron, counter-clockwise from outside; +z is vertex 0.
fn octahedron() -> Mesh {
    Mesh {
        positions: vec![Vec3::Z, Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z],
        triangles: vec![
            [0, 1, 2],
            [0, 2, 3],
            [0, 3, 4],
            [0, 4, 1],
            [5, 2, 1],
            [5, 3, 2],
            [5, 4, 3],
            [5, 1, 4],
        ],
        ..Mesh::default()
    }
}

/// The icosahedron with a vertex at +z: two rings of five.
fn icosahedron() -> Mesh {
    let mut positions = vec![Vec3::Z];
    let (height, radius) = (0.2_f32.sqrt(), 0.8_f32.sqrt());
    for ring in 0..2 {
        for k in 0..5 {
            let angle = std::f32::consts::TAU * (k as f32 + 0.5 * ring as f32) / 5.0;
            let z = if ring == 0 { height } else { -height };
            positions.push(Vec3::new(radius * angle.cos(), radius * angle.sin(), z));
        }
    }
    positions.push(Vec3::NEG_Z);
    let mut triangles = Vec::new();
    for k in 0..5_u32 {
        let next = (k + 1) % 5;
        let [a, b, c, d] = [1 + k, 1 + next, 6 + k, 6 + next];
        triangles.extend([[0, a, b], [a, c, b], [b, c, d], [11, d, c]]);
    }
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A flat sheet of `n` × `n` squares, with uv.
fn sheet(n: u32) -> Mesh {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let point = |i: u32| Vec2::new((i % (n + 1)) as f32, (i / (n + 1)) as f32);
    let uvs: Vec<Vec2> = (0..(n + 1) * (n + 1)).map(point).collect();
    let mut triangles = Vec::new();
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    let positions = uvs.iter().map(|uv| uv.extend(0.0)).collect();
    Mesh { positions, uvs, triangles, ..Mesh::default() }
}

#[test]
fn vertices_of_regular_solids_go_to_their_limit_at_once() {
    // p∞ = (1 − n γ) p + γ Σ ring with γ = 1 / (n + 3 / (8 β)) and β = 3 / (8 n), so that γ = 1 / (2 n)
    for (mesh, ring) in [(octahedron(), 0.0), (icosahedron(), 0.2_f32.sqrt())] {
        let expected = Vec3::Z * (0.5 + 0.5 * ring);
        for levels in 0..4 {
            let limit = mesh.loop_subdivided(levels).unwrap();
            let z = (0..limit.positions.len()).find(|&i| limit.positions[i].abs_diff_eq(expected, 1e-6));
            let z = z.unwrap_or_else(|| panic!("{levels} levels: no vertex at {expected}"));
            assert!(limit.normals[z].abs_diff_eq(Vec3::Z, 1e-5), "{}", limit.normals[z]);
            assert_eq!(limit.triangles.len(), mesh.triangles.len() << (2 * levels));
            // A ball has χ = 2: V = 2 + E − F with E = 3 F / 2
            assert_eq!(limit.positions.len(), 2 + limit.triangles.len() / 2);
            for [a, b, c] in &limit.triangles {
                let [p, q, r] = [a, b, c].map(|v| limit.positions[*v as usize]);
                let flat = (q - p).cross(r - p);
                assert!([a, b, c].iter().all(|v| limit.normals[**v as usize].dot(flat) > 0.0));
            }
        }
    }
    // A tetrahedron has valence 3, and β = 3/16: γ = 1 / (3 + 2)
    let positions =
        vec![Vec3::ONE, Vec3::new(1.0, -1.0, -1.0), Vec3::new(-1.0, 1.0, -1.0), Vec3::new(-1.0, -1.0, 1.0)];
    let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    let solid = Mesh { positions, triangles, ..Mesh::default() };
    for levels in 0..3 {
        let limit = solid.loop_subdivided(levels).unwrap();
        assert!(limit.positions.iter().any(|p| p.abs_diff_eq(Vec3::splat(0.2), 1e-6)), "{levels}");
    }
}

#[test]
fn a_flat_sheet_stays_flat_and_keeps_its_texture() {
    let limit = sheet(4).loop_subdivided(2).unwrap();
    assert!(limit.positions.iter().all(|p| p.z == 0.0));
    assert!(limit.normals.iter().all(|n| n.abs_diff_eq(Vec3::Z, 1e-5)));
    for (p, uv) in limit.positions.iter().zip(&limit.uvs) {
        // Inside of a regular lattice nothing moves; at the border the surface shrinks to its spline
        let inside = (1.0..=3.0).contains(&uv.x) && (1.0..=3.0).contains(&uv.y);
        assert!(!inside || p.truncate().abs_diff_eq(*uv, 1e-5), "{p} {uv}");
    }
    // The border is a cubic B-spline: the corner goes to a sixth of the way to each of its neighbours
    for levels in 0..4 {
        let limit = sheet(4).loop_subdivided(levels).unwrap();
        let corner = Vec3::new(1.0, 1.0, 0.0) / 6.0;
        assert!(limit.positions.iter().any(|p| p.abs_diff_eq(corner, 1e-6)), "{levels} levels");
    }
}

#[test]
fn parts_and_seams_are_kept() {
    let mut mesh = octahedron();
    mesh.parts =
        [0..3, 3..8].map(|triangles| MeshPart { name: String::new(), triangles, material: None }).to_vec();
    // Each triangle with vertices of its own, as where textures have a seam
    let apart = Mesh {
        positions: mesh.triangles.iter().flatten().map(|v| mesh.positions[*v as usize]).collect(),
        uvs: mesh.triangles.iter().flat_map(|_| [Vec2::ZERO, Vec2::X, Vec2::Y]).collect(),
        triangles: (0..8).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..mesh.clone()
    };
    let (whole, apart) = (mesh.loop_subdivided(2).unwrap(), apart.loop_subdivided(2).unwrap());
    assert_eq!([whole.parts[0].triangles.clone(), whole.parts[1].triangles.clone()], [0..48, 48..128]);
    for (i, (a, b)) in whole.triangles.iter().zip(&apart.triangles).enumerate() {
        for (v, w) in a.iter().zip(b) {
            assert_eq!(whole.positions[*v as usize], apart.positions[*w as usize]);
            assert_eq!(whole.normals[*v as usize], apart.normals[*w as usize]);
        }
        let [p, q, r] = b.map(|v| apart.uvs[v as usize]);
        assert!(((q - p).perp_dot(r - p) - 1.0 / 16.0).abs() < 1e-6, "triangle {i}");
    }
}

#[test]
fn what_cannot_be_subdivided_is_an_error() {
    let mut three = octahedron();
    three.triangles.push([0, 1, 3]);
    let mut turned = octahedron();
    turned.triangles[0].swap(1, 2);
    let mut needle = octahedron();
    needle.triangles[0] = [0, 1, 1];
    for mesh in [three, turned, needle] {
        let error = mesh.loop_subdivided(1).unwrap_err();
        assert!(error.message.contains("no simple fan") && error.help.is_some(), "{error}");
    }
    for levels in [10, 31, 40] {
        let error = octahedron().loop_subdivided(levels).unwrap_err();
        assert!(error.message.contains("more than 4000000"), "{error}");
    }
}

#[test]
fn a_fan_of_many_triangles_takes_no_longer_than_others() {
    const CORNERS: u32 = 200_000;
    let rim = (0..CORNERS).map(|i| {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / CORNERS as f32).sin_cos();
        Vec3::new(cos, sin, 0.0)
    });
    let mesh = Mesh {
        positions: std::iter::once(Vec3::Z).chain(rim).collect(),
        triangles: (0..CORNERS).map(|i| [0, 1 + i, 1 + (i + 1) % CORNERS]).collect(),
        ..Mesh::default()
    };
    let started = std::time::Instant::now();
    assert_eq!(mesh.loop_subdivided(1).unwrap().triangles.len(), 4 * CORNERS as usize);
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
}

#[test]
fn a_triangle_with_two_corners_in_one_place_is_refused() {
    let mesh =
        Mesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X], triangles: vec![[0, 1, 2]], ..Mesh::default() };
    assert!(mesh.loop_subdivided(1).is_err());
}
