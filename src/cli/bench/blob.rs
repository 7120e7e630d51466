//! The blob: an icosphere of 20 · 4⁷ = 327,680 triangles, displaced by a fixed sum of twelve plane waves.

use dapple::scene::Mesh;
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Wave vector and phase of each octave.
#[rustfmt::skip]
const WAVES: [[f64; 4]; 12] = [
    [0.0024603067149651485, 0.5974910750169398, -0.5482757107244352, 1.4143011531409169],
    [-1.9096172977212347, -4.164915530985142, 0.25260313090924164, 5.157314467443772],
    [-3.15012171872851, -3.971039358847619, 3.134989121185269, 1.7485128439928566],
    [0.9065625413819277, -8.002025184490561, -0.25156567318415207, 3.4759633710278126],
    [-14.517517110678886, -4.9422502192343565, -20.533205589849118, 6.210669727442237],
    [-23.94255549129252, -3.0561847039708567, -16.47680425876814, 0.27595580999748753],
    [2.3826165166882225, -2.8413503583753066, -38.2547476044718, 5.759813615651113],
    [-0.8439164499786527, 1.971576356457552, -26.62436231979385, 1.5543937103316376],
    [2.8770238418579743, -19.178973929910136, -15.853209892741747, 1.25981022663833],
    [-17.604255922235343, -0.7089731678123491, 19.279699108953192, 0.9700155890658423],
    [-2.680846790019831, 2.651139437987534, 1.530762582121487, 5.320103547177659],
    [1.9948740358776123, 35.60117364962829, -40.53519056696624, 3.3983831982443493],
];

#[rustfmt::skip]
const FACES: [[u32; 3]; 20] = [
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
    [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
];

/// The blob after `level` subdivisions of an icosahedron: 20 · 4^level triangles, flat.
pub(super) fn mesh(level: u32) -> Mesh {
    let (positions, triangles) = icosphere(level);
    let positions = positions.into_iter().map(displaced).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

fn displaced(p: DVec3) -> Vec3 {
    let wave = |(octave, [x, y, z, phase]): (usize, &[f64; 4])| {
        (p.dot(DVec3::new(*x, *y, *z)) + phase).sin() * 0.12 / (1.0 + octave as f64)
    };
    (p * (1.0 + WAVES.iter().enumerate().map(wave).sum::<f64>())).as_vec3()
}

/// Points on the unit sphere, and triangles counter-clockwise seen from outside.
fn icosphere(level: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let t = f64::midpoint(1.0, 5.0_f64.sqrt());
    let corners = [
        (-1.0, t, 0.0),
        (1.0, t, 0.0),
        (-1.0, -t, 0.0),
        (1.0, -t, 0.0),
        (0.0, -1.0, t),
        (0.0, 1.0, t),
        (0.0, -1.0, -t),
        (0.0, 1.0, -t),
        (t, 0.0, -1.0),
        (t, 0.0, 1.0),
        (-t, 0.0, -1.0),
        (-t, 0.0, 1.0),
    ];
    let mut points: Vec<DVec3> = corners.iter().map(|&(x, y, z)| DVec3::new(x, y, z).normalize()).collect();
    let mut faces = FACES.to_vec();
    for _ in 0..level {
        let mut middles = HashMap::new();
        let mut split = Vec::with_capacity(4 * faces.len());
        for [i, j, k] in faces {
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    points.push((points[a as usize] + points[b as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let (a, b, c) = (middle(i, j), middle(j, k), middle(k, i));
            split.extend([[i, a, c], [j, b, a], [k, c, b], [a, b, c]]);
        }
        faces = split;
    }
    (points, faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_closed_and_where_it_should_be() {
        let blob = mesh(3);
        assert_eq!((blob.positions.len(), blob.triangles.len()), (642, 1280));
        // Closed: each edge is walked once in each direction. Outward: the volume inside is positive.
        let edges: std::collections::HashSet<[u32; 2]> =
            blob.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        assert_eq!(edges.len(), 3 * blob.triangles.len());
        assert!(edges.iter().all(|&[a, b]| edges.contains(&[b, a])));
        let volume: f64 = blob
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| blob.positions[v as usize].as_dvec3());
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!(volume > 0.0, "{volume}");
    }

    #[test]
    fn the_full_blob_is_that_of_the_benchmark() {
        let blob = mesh(7);
        assert_eq!((blob.positions.len(), blob.triangles.len()), (163_842, 327_680));
        let lowest = blob.positions.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        assert!((lowest + 1.0999).abs() < 1e-4, "{lowest}");
    }
}
