//! What the mesh readers share: choice of the format, polygons to triangles, unit normals.

use super::{gltf::read_gltf_mesh, obj::read_obj, ply::read_ply};
use crate::scene::{Mesh, unit};
use crate::{Error, Result};
use glam::{DVec3, Vec3};
use std::path::Path;

/// Reads a triangle mesh from an OBJ, PLY or glTF file, chosen by the extension of its name in any case of letters.
///
/// # Errors
/// Another extension, and all errors of [`read_obj`], [`read_ply`] and [`read_gltf_mesh`].
pub fn read_mesh(path: &Path) -> Result<Mesh> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        Some("obj") => read_obj(path),
        Some("ply") => read_ply(path),
        Some("gltf" | "glb") => read_gltf_mesh(path),
        other => {
            let kind = match other {
                Some(e) => format!("the extension `.{e}` is no mesh format that can be read"),
                None => "the name has no extension that tells the mesh format".into(),
            };
            Err(Error::scene(kind).help("use an .obj, .ply, .gltf or .glb file").in_file(path))
        }
    }
}

/// Polygons with more corners than this are cut as a fan: finding ears takes up to n³ steps.
const MOST_CORNERS_FOR_EARS: usize = 64;

/// Cuts a polygon of at least 3 vertices into triangles of the same orientation.
///
/// Polygons that are convex, or seen whole from their first corner, become a fan around it. Of others, ears are cut
/// off; what has no ear, because it crosses itself, becomes a fan. `polygon` holds indices below `positions.len()` and is used up.
pub(super) fn triangulate(polygon: &mut Vec<u32>, positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
    if (4..=MOST_CORNERS_FOR_EARS).contains(&polygon.len()) {
        let normal = polygon_normal(polygon, positions);
        if !is_fan(polygon, positions, normal) {
            while let Some(ear) = find_ear(polygon, positions, normal) {
                triangles.push(corner(polygon, ear));
                polygon.remove(ear);
                if polygon.len() == 3 {
                    break;
                }
            }
        }
    }
    if let Some((&first, rest)) = polygon.split_first() {
        triangles.extend(rest.windows(2).map(|edge| [first, edge[0], edge[1]]));
    }
}

/// Corner `i` with its neighbours before and after.
fn corner(polygon: &[u32], i: usize) -> [u32; 3] {
    let n = polygon.len();
    [polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]]
}

/// Position in double precision: products of three small lengths must not vanish.
fn position(positions: &[Vec3], vertex: u32) -> DVec3 {
    positions[vertex as usize].as_dvec3()
}

/// Normal of a triangle, as long as twice its area.
fn triangle_normal(triangle: [u32; 3], positions: &[Vec3]) -> DVec3 {
    let [a, b, c] = triangle.map(|v| position(positions, v));
    (b - a).cross(c - a)
}

/// Sum of the normals of a fan (Newell's method): right for concave polygons too.
fn polygon_normal(polygon: &[u32], positions: &[Vec3]) -> DVec3 {
    polygon[1..].windows(2).map(|edge| triangle_normal([polygon[0], edge[0], edge[1]], positions)).sum()
}

/// Whether all triangles of the fan around the first corner face the same way, so that none overlap.
fn is_fan(polygon: &[u32], positions: &[Vec3], normal: DVec3) -> bool {
    let mut edges = polygon[1..].windows(2);
    edges.all(|edge| triangle_normal([polygon[0], edge[0], edge[1]], positions).dot(normal) >= 0.0)
}

/// First corner that turns the right way and whose triangle holds no other vertex of the polygon.
fn find_ear(polygon: &[u32], positions: &[Vec3], normal: DVec3) -> Option<usize> {
    (0..polygon.len()).find(|&i| {
        let triangle = corner(polygon, i);
        let [a, b, c] = triangle.map(|v| position(positions, v));
        let inside = |p: DVec3| {
            [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| (to - from).cross(p - from).dot(normal) >= 0.0)
        };
        triangle_normal(triangle, positions).dot(normal) > 0.0
            && !polygon.iter().any(|v| {
                let p = position(positions, *v);
                p != a && p != b && p != c && inside(p)
            })
    })
}

/// Gives all normals unit length. One of zero length becomes the normal of a triangle at its vertex; where there
/// is none with an area, +z.
pub(super) fn normalize_normals(mesh: &mut Mesh) {
    let mut missing = 0_usize;
    for normal in &mut mesh.normals {
        *normal = unit(*normal).unwrap_or_default();
        missing += usize::from(*normal == Vec3::ZERO);
    }
    if missing == 0 {
        return;
    }
    for &triangle in &mesh.triangles {
        if triangle.iter().any(|&v| mesh.normals[v as usize] == Vec3::ZERO) {
            let flat = triangle_normal(triangle, &mesh.positions).normalize_or_zero().as_vec3();
            for v in triangle {
                let normal = &mut mesh.normals[v as usize];
                if *normal == Vec3::ZERO {
                    *normal = flat;
                }
            }
        }
    }
    for normal in &mut mesh.normals {
        if *normal == Vec3::ZERO {
            *normal = Vec3::Z;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[[f32; 2]]) -> (Vec<[u32; 3]>, Vec<Vec3>) {
        let positions: Vec<Vec3> = points.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect();
        let mut triangles = Vec::new();
        triangulate(&mut (0..points.len() as u32).collect(), &positions, &mut triangles);
        (triangles, positions)
    }

    /// The triangles have the area of the polygon and all face the same way, so they cannot overlap.
    fn assert_covers(points: &[[f32; 2]], area: f64) {
        let (triangles, positions) = cut(points);
        assert_eq!(triangles.len(), points.len() - 2);
        let areas: Vec<f64> = triangles.iter().map(|&t| 0.5 * triangle_normal(t, &positions).z).collect();
        assert!(areas.iter().all(|&a| a >= 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - area).abs() < 1e-6, "{areas:?}");
    }

    #[test]
    fn convex_polygons_become_a_fan() {
        let (triangles, _) = cut(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn concave_polygons_are_covered_without_overlap() {
        // An arrow head whose fan around the first corner would leave the polygon.
        assert_covers(&[[0.0, 0.0], [2.0, 2.0], [0.0, 1.0], [-2.0, 2.0]], 2.0);
        // The letter U, and a star with a zero-length edge.
        let u =
            [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [2.0, 3.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        assert_covers(&u, 7.0);
        assert_covers(&[[1.0, 1.0], [0.0, 2.0], [-1.0, 1.0], [0.0, 1.5], [0.0, 1.5]], 0.5);
    }

    #[test]
    fn polygons_without_ears_still_give_triangles() {
        for points in [[[0.0, 0.0]; 5], [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]]] {
            assert_eq!(cut(&points).0.len(), 3);
        }
        let many: Vec<[f32; 2]> = (0..200).map(|i| [i as f32, (i % 2) as f32]).collect();
        assert_eq!(cut(&many).0.len(), 198);
    }

    #[test]
    fn normals_get_unit_length_and_missing_ones_a_neighbour() {
        let mut mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE],
            normals: vec![Vec3::new(0.0, 0.0, -1e-30), Vec3::ZERO, Vec3::new(3e38, 3e38, 0.0), Vec3::ZERO],
            triangles: vec![[0, 2, 1]],
            ..Mesh::default()
        };
        normalize_normals(&mut mesh);
        let half = 0.5_f32.sqrt();
        assert_eq!(mesh.normals, [-Vec3::Z, -Vec3::Z, Vec3::new(half, half, 0.0), Vec3::Z]);
    }

    #[test]
    fn other_extensions_are_refused_with_the_ones_that_work() {
        let error = read_mesh(Path::new("a.stl")).unwrap_err().to_string();
        assert_eq!(
            error,
            "a.stl: the extension `.stl` is no mesh format that can be read; use an .obj, .ply, .gltf or .glb file"
        );
        assert!(read_mesh(Path::new("a")).is_err());
        // A known extension in capitals reaches the reader, which does not find the file.
        assert!(read_mesh(Path::new("/nonexistent/A.PLY")).unwrap_err().message.contains("cannot be read"));
    }
}
