//! `shaders/geometry/triangle.glsl`: ray against triangle; no ray slips between triangles.

use crate::common::probe::{Probe, Word, as_doubles, vector};
use crate::common::random::Random;
use crate::common::twins::geometry;
use crate::common::twins::math::{cross, length, sub, towards, wide};

type Point = [f32; 3];

struct Case {
    triangle: [Point; 3],
    origin: Point,
    direction: Point,
}

fn hits(cases: &[Case]) -> Vec<(bool, [f64; 3])> {
    let glsl = "#include \"geometry/triangle.glsl\"
        void probe(uint i) {
            vec3 a = uintBitsToFloat(fetch_points(5u * i).xyz);
            vec3 b = uintBitsToFloat(fetch_points(5u * i + 1u).xyz);
            vec3 c = uintBitsToFloat(fetch_points(5u * i + 2u).xyz);
            vec3 o = uintBitsToFloat(fetch_points(5u * i + 3u).xyz);
            vec3 d = uintBitsToFloat(fetch_points(5u * i + 4u).xyz);
            float t;
            vec2 bary;
            bool hit = triangle_hit(a, b, c, triangle_ray(o, d), FAR, t, bary);
            store_values(i, uvec4(hit ? 1u : 0u, floatBitsToUint(t), floatBitsToUint(bary)));
        }";
    let mut inputs: Vec<Word> = Vec::with_capacity(5 * cases.len());
    for case in cases {
        inputs.extend(case.triangle.iter().map(|p| vector(*p)));
        inputs.extend([vector(case.origin), vector(case.direction)]);
    }
    let values = Probe::new().both(glsl, &inputs, cases.len(), cases.len());
    values
        .iter()
        .map(|v| {
            let [_, t, x, y] = as_doubles(*v);
            (v[0] == 1, [t, x, y])
        })
        .collect()
}

/// A point of a triangle by barycentric coordinates.
fn point_in([a, b, c]: [Point; 3], u: f32, v: f32) -> Point {
    [0, 1, 2].map(|i| a[i] * (1.0 - u - v) + b[i] * u + c[i] * v)
}

#[test]
fn triangles_are_hit_where_doubles_say() {
    let mut random = Random(1);
    let mut cases = Vec::new();
    for i in 0..200_000 {
        // From needles and specks to plain ones
        let size = if i % 4 == 0 { random.between(-12.0, 0.0).exp2() } else { 1.0 };
        let a = random.cube(1.0);
        let mut corner = |scale: f32| {
            let offset = random.cube(scale);
            [0, 1, 2].map(|c| a[c] + offset[c])
        };
        let triangle = [a, corner(1.0), corner(size)];
        let origin = random.cube(3.0);
        let (u, v) = (random.between(-0.5, 1.5), random.between(-0.5, 1.5));
        let mut direction = towards(origin, point_in(triangle, u, v));
        let scale = random.between(-10.0, 10.0).exp2() * if i % 5 == 0 { -1.0 } else { 1.0 };
        direction = direction.map(|c| c * scale);
        cases.push(Case { triangle, origin, direction });
    }
    let mut seen = [0; 2];
    for (case, (hit, [t, x, y])) in cases.iter().zip(hits(&cases)) {
        let triangle = case.triangle.map(wide);
        let Some(meeting) = geometry::triangle_hit(triangle, wide(case.origin), wide(case.direction)) else {
            assert!(!hit);
            continue;
        };
        // A rounding of the vertices about the origin moves an edge by about this much, in barycentric coordinates:
        // 6 ulp of the largest coordinate over the smallest height, which a grazing ray enlarges
        let reach = triangle.iter().map(|p| length(sub(*p, wide(case.origin)))).fold(0.0, f64::max);
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| length(sub(triangle[i], triangle[j])));
        let area = length(cross(sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0])));
        let height = area / edges.iter().copied().fold(0.0, f64::max);
        let slack = 8e-7 * reach / (height * meeting.sine);
        if meeting.inside.abs() < slack || meeting.t.abs() * length(wide(case.direction)) < slack * reach {
            continue;
        }
        let expected = meeting.inside > 0.0 && meeting.t > 0.0;
        assert_eq!(hit, expected, "{triangle:?} {:?} {:?} {}", case.origin, case.direction, meeting.inside);
        seen[usize::from(hit)] += 1;
        if hit {
            let close = (t - meeting.t).abs() <= slack * reach.max(meeting.t) * 2.0;
            let [u, v] = meeting.bary;
            let bary_slack = slack * 4.0;
            assert!(
                close && (x - u).abs() < bary_slack && (y - v).abs() < bary_slack,
                "{t} {x} {y}: {} {u} {v} {slack}",
                meeting.t
            );
        }
    }
    assert!(seen[0] > 50_000 && seen[1] > 15_000, "{seen:?}");
}

#[test]
fn triangles_without_area_are_never_hit() {
    let mut random = Random(2);
    let mut cases = Vec::new();
    for i in 0..50_000 {
        let (a, b) = (random.cube(2.0), random.cube(2.0));
        let triangle = match i % 4 {
            0 => [a, a, a],
            1 => [a, a, b],
            2 => [a, b, a],
            _ => [a, b, b],
        };
        let origin = random.cube(4.0);
        let direction = towards(origin, point_in(triangle, random.f32(), 0.0));
        cases.push(Case { triangle, origin, direction });
    }
    // A point and a segment of whole numbers, met head-on; a direction without length
    let (a, b, c) = ([1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]);
    cases.push(Case { triangle: [a, b, c], origin: [2.0, 0.0, 5.0], direction: [0.0, 0.0, -1.0] });
    cases.push(Case { triangle: [a, b, c], origin: [0.0; 3], direction: [1.0, 0.0, 0.0] });
    cases.push(Case { triangle: [a, b, [0.0, 1.0, 0.0]], origin: [1.5, 0.1, 1.0], direction: [0.0; 3] });
    let count = hits(&cases).iter().filter(|(hit, _)| *hit).count();
    assert_eq!(count, 0);
}

/// Rays at shared edges and vertices of a mesh, against the triangles around each: how many meet none of them.
fn misses(vertices: &[Point], triangles: &[[usize; 3]], rays: &[(Point, Point)], around: usize) -> usize {
    assert_eq!(triangles.len() % around, 0);
    let glsl = format!(
        "#include \"geometry/triangle.glsl\"
        const uint AROUND = {around}u;
        vec3 corner(uint at) {{ return uintBitsToFloat(fetch_points(at).xyz); }}
        void probe(uint i) {{
            uint first = fetch_points(2u * i).w;
            vec3 o = uintBitsToFloat(fetch_points(2u * i).xyz);
            vec3 d = uintBitsToFloat(fetch_points(2u * i + 1u).xyz);
            uint found = 0u;
            for (uint k = 0u; k < AROUND; ++k) {{
                uint at = 2u * frame.point_count + 3u * (first + k);
                float t;
                vec2 bary;
                if (triangle_hit(corner(at), corner(at + 1u), corner(at + 2u), triangle_ray(o, d), FAR, t, bary)) found += 1u;
            }}
            store_values(i, uvec4(found));
        }}"
    );
    let groups = triangles.len() / around;
    let mut inputs = Vec::with_capacity(2 * rays.len() + 3 * triangles.len());
    for (i, (o, d)) in rays.iter().enumerate() {
        let first = (i % groups * around) as u32;
        inputs.push([o[0].to_bits(), o[1].to_bits(), o[2].to_bits(), first]);
        inputs.push(vector(*d));
    }
    inputs.extend(triangles.iter().flatten().map(|&v| vector(vertices[v])));
    let values = Probe::new().both(&glsl, &inputs, rays.len(), rays.len());
    values.iter().filter(|v| v[0] == 0).count()
}

/// A closed fan of `n` triangles about vertex 0, nearly flat.
fn fan(random: &mut Random, n: usize, center: Point, size: f32) -> (Vec<Point>, Vec<[usize; 3]>) {
    let mut vertices = vec![center];
    for i in 0..n {
        let angle = (i as f32 + random.between(-0.3, 0.3)) * std::f32::consts::TAU / n as f32;
        let r = size * random.between(0.6, 1.0);
        let offset = [r * angle.cos(), r * angle.sin(), size * random.between(-0.2, 0.2)];
        vertices.push([0, 1, 2].map(|c| center[c] + offset[c]));
    }
    // Corners in any order, as meshes have them
    let triangles = (0..n)
        .map(|i| {
            let t = [0, 1 + i, 1 + (i + 1) % n];
            let turn = random.u32() as usize % 3;
            let mut t = [t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]];
            if random.u32().is_multiple_of(2) {
                t.swap(0, 1);
            }
            t
        })
        .collect();
    (vertices, triangles)
}

/// Half a million rays at the edges and the middle of fans; `place` gives a middle, a size and an origin.
fn fan_misses(seed: u64, place: impl Fn(&mut Random) -> (Point, f32, Point)) -> usize {
    const AROUND: usize = 6;
    const FANS: usize = 500;
    const RAYS: usize = 500_000;
    let mut random = Random(seed);
    let (mut vertices, mut triangles, mut origins) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..FANS {
        let (center, size, origin) = place(&mut random);
        let (v, t) = fan(&mut random, AROUND, center, size);
        let base = vertices.len();
        vertices.extend(v);
        triangles.extend(t.iter().map(|t| t.map(|i| base + i)));
        origins.push((origin, size));
    }
    let rays: Vec<(Point, Point)> = (0..RAYS)
        .map(|i| {
            let fan = i % FANS;
            let (origin, size) = origins[fan];
            let base = fan * (AROUND + 1);
            let offset = random.cube(size * 0.1);
            let origin = [0, 1, 2].map(|c| origin[c] + offset[c]);
            let rim = vertices[base + 1 + random.u32() as usize % AROUND];
            let s = if i % 3 == 0 { 0.0 } else { random.f32() * 0.9 };
            let target = point_in([vertices[base], rim, rim], s, 0.0);
            (origin, towards(origin, target))
        })
        .collect();
    misses(&vertices, &triangles, &rays, AROUND)
}

#[test]
fn no_ray_slips_between_triangles() {
    let count = fan_misses(3, |r| {
        let center = r.cube(2.0);
        let o = r.cube(1.0);
        (center, 1.0, [center[0] + o[0], center[1] + o[1], center[2] + 3.0])
    });
    assert_eq!(count, 0, "of 500,000 near the origin");
    let count = fan_misses(4, |r| {
        let center = r.cube(1e5);
        let o = r.cube(4.0);
        (center, 1.0, [center[0] + o[0], center[1] + o[1], center[2] - 7.0])
    });
    assert_eq!(count, 0, "of 500,000 at huge offsets");
    let count = fan_misses(5, |r| {
        let center = r.cube(1.0);
        let o = r.cube(400.0);
        (center, 0.01, [o[0], o[1], 1000.0])
    });
    assert_eq!(count, 0, "of 500,000 at specks far away");
}

#[test]
fn no_ray_slips_between_triangles_of_a_grid() {
    // Axis-aligned rays at the corners and edges of a grid of whole numbers: every product is exact, every sum a tie
    let mut vertices = Vec::new();
    for y in -2..=2 {
        vertices.extend((-2..=2).map(|x| [x as f32, y as f32, 0.0]));
    }
    let at = |x: usize, y: usize| y * 5 + x;
    let mut triangles = Vec::new();
    for y in 0..4 {
        for x in 0..4 {
            triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
        }
    }
    let mut rays = Vec::new();
    for sign in [1.0, -1.0_f32] {
        for y in -4..=4 {
            for x in -4..=4 {
                // Corners, middles of edges and diagonals, and beside them; the border counts as well
                let (x, y) = (x as f32 / 2.0, y as f32 / 2.0);
                rays.extend([(sign, [x, y]), (sign, [0.999 * x, 0.999 * y]), (sign, [x, 0.37 * x])]);
            }
        }
    }
    for turn in 0..3 {
        // The same grid in each of the three planes
        let turned = |p: Point| [p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]];
        let grid: Vec<Point> = vertices.iter().map(|v| turned(*v)).collect();
        let aimed: Vec<(Point, Point)> = rays
            .iter()
            .map(|(sign, [x, y])| (turned([*x, *y, 3.0 * sign]), turned([0.0, 0.0, -sign])))
            .collect();
        assert_eq!(misses(&grid, &triangles, &aimed, triangles.len()), 0);
        // Not at the border, where a rounding may lead past the grid
        let oblique: Vec<(Point, Point)> = aimed
            .iter()
            .filter(|(o, d)| (0..3).all(|c| d[c] != 0.0 || o[c].abs() < 1.9999))
            .map(|(o, d)| {
                let target = [0, 1, 2].map(|c| o[c] + 3.0 * d[c]);
                let origin = [0, 1, 2].map(|c| o[c] + [0.7, -0.3, 0.5][c] * (1.0 - d[c].abs()));
                (origin, towards(origin, target))
            })
            .collect();
        assert_eq!(misses(&grid, &triangles, &oblique, triangles.len()), 0);
    }
}
