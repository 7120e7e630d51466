//! Parts of quadrics, tubes and patches: hits, normals, uv and derivatives in the world against closed formulas.

use crate::common::probe::{Probe, Word, as_doubles, three, vector};
use crate::common::random::Random;
use bytemuck::cast;
use dapple::layout::{
    BilinearPatch, INSTANCE_CYLINDER, INSTANCE_DISK_PART, INSTANCE_PATCH, INSTANCE_SPHERE_PART, Instance,
    NONE, PatchNormals, QuadricPart, Record,
};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// First word of the rays, behind an instance and what belongs to it.
const RAYS: usize = 20;

const GLSL: &str = "
    #define HAS_SPHERES
    #define HAS_DISKS
    #define HAS_PARTS
    #define HAS_PATCHES
    #include \"shared/bindings.glsl\"
    #define fetch_instances fetch_points
    #include \"geometry/surface_quadric.glsl\"
    #include \"geometry/surface_patch.glsl\"
    void probe(uint i) {
        Instance instance = instance_fetch(0u);
        vec3 o = uintBitsToFloat(fetch_points(20u + 2u * i).xyz);
        vec3 d = uintBitsToFloat(fetch_points(21u + 2u * i).xyz);
        float t;
        bool hit = shape_hit(instance, object_point(instance, o), object_vector(instance, d), 0.0, FAR, t);
        Surface s;
        if (instance.kind == INSTANCE_PATCH) s = patch_surface(instance, t, o, d);
        else s = quadric_surface(instance, t, o, d);
        store_values(8u * i, uvec4(hit ? 1u : 0u, floatBitsToUint(t), floatBitsToUint(s.uv)));
        store_values(8u * i + 1u, floatBitsToUint(vec4(s.position, 0.0)));
        store_values(8u * i + 2u, floatBitsToUint(vec4(s.normal, 0.0)));
        store_values(8u * i + 3u, floatBitsToUint(vec4(s.geometric, 0.0)));
        store_values(8u * i + 4u, floatBitsToUint(vec4(s.dpdu, 0.0)));
        store_values(8u * i + 5u, floatBitsToUint(vec4(s.dpdv, 0.0)));
        store_values(8u * i + 6u, floatBitsToUint(vec4(s.dndu, 0.0)));
        store_values(8u * i + 7u, floatBitsToUint(vec4(s.dndv, 0.0)));
    }";

/// A shape by functions of two numbers in the unit square, in its object space.
struct Shape<'a> {
    kind: u32,
    words: Vec<Word>,
    point: Box<dyn Fn(DVec2) -> DVec3 + 'a>,
    /// Of any length, towards the front.
    geometric: Box<dyn Fn(DVec2) -> DVec3 + 'a>,
    normal: Box<dyn Fn(DVec2) -> DVec3 + 'a>,
    uv: Box<dyn Fn(DVec2) -> DVec2 + 'a>,
}

fn part(z_min: f32, z_max: f32, inner_radius: f32, turn: f32, v_min: f64, v_range: f64) -> Vec<Word> {
    let (v_min, v_range) = (v_min as f32, v_range as f32);
    cast::<_, [Word; 2]>(QuadricPart { z_min, z_max, inner_radius, turn, v_min, v_range, spare: [0.0; 2] })
        .to_vec()
}

fn around(turn: f32, u: f64) -> DVec3 {
    let (sin, cos) = (TAU * f64::from(turn) * u).sin_cos();
    DVec3::new(cos, sin, 0.0)
}

fn sphere_part() -> Shape<'static> {
    let (low, high, turn) = (-0.6_f32, 0.45_f32, 0.7_f32);
    let [a, b] = [low, high].map(|z| f64::from(z).asin());
    let point = move |at: DVec2| {
        let (sin, cos) = (a + (b - a) * at.y).sin_cos();
        around(turn, at.x) * cos + DVec3::Z * sin
    };
    Shape {
        kind: INSTANCE_SPHERE_PART,
        words: part(low, high, 0.0, turn, 0.5 + a / PI, (b - a) / PI),
        point: Box::new(point),
        geometric: Box::new(point),
        normal: Box::new(point),
        uv: Box::new(|at| at),
    }
}

fn disk_part() -> Shape<'static> {
    let (inner, turn) = (0.3_f32, 0.8_f32);
    let z = |_| DVec3::Z;
    Shape {
        kind: INSTANCE_DISK_PART,
        words: part(-2.0, 2.0, inner, turn, 0.0, 1.0 - f64::from(inner)),
        point: Box::new(move |at| around(turn, at.x) * (1.0 + (f64::from(inner) - 1.0) * at.y)),
        geometric: Box::new(z),
        normal: Box::new(z),
        uv: Box::new(|at| at),
    }
}

fn cylinder() -> Shape<'static> {
    let turn = 0.85_f32;
    let normal = move |at: DVec2| around(turn, at.x);
    Shape {
        kind: INSTANCE_CYLINDER,
        words: part(0.0, 1.0, 0.0, turn, 0.0, 1.0),
        point: Box::new(move |at| around(turn, at.x) + DVec3::Z * at.y),
        geometric: Box::new(normal),
        normal: Box::new(normal),
        uv: Box::new(|at| at),
    }
}

fn mix<T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>>(
    corners: [T; 4],
    at: DVec2,
) -> T {
    let [a, b, c, d] = corners;
    (a * (1.0 - at.x) + b * at.x) * (1.0 - at.y) + (c * (1.0 - at.x) + d * at.x) * at.y
}

fn patch(corners: [[f32; 3]; 4], normals: Option<[[f32; 3]; 4]>, uvs: [[f32; 2]; 4]) -> Shape<'static> {
    let size = 2.0;
    let [p00, p10, p01, p11] = corners.map(|corner| corner.map(|c| c / size));
    let [uv00, uv10, uv01, uv11] = uvs;
    let has_normals = u32::from(normals.is_some());
    let (spare01, spare11) = (0.0, 0.0);
    let record =
        BilinearPatch { p00, size, p10, has_normals, p01, spare01, p11, spare11, uv00, uv10, uv01, uv11 };
    let mut words = cast::<_, [Word; 6]>(record).to_vec();
    if let Some([n00, n10, n01, n11]) = normals {
        let record = PatchNormals { n00, n10, n01, n11, ..PatchNormals::default() };
        words.extend(cast::<_, [Word; 4]>(record));
    }
    let wide = |corner: [f32; 3]| DVec3::from(corner.map(f64::from));
    let p = corners.map(wide);
    let geometric = move |at: DVec2| {
        let [a, b, c, d] = p;
        ((b - a) * (1.0 - at.y) + (d - c) * at.y).cross((c - a) * (1.0 - at.x) + (d - b) * at.x)
    };
    let smooth = normals.map(|normals| normals.map(wide));
    let uv = uvs.map(|uv| DVec2::from(uv.map(f64::from)));
    Shape {
        kind: INSTANCE_PATCH,
        words,
        point: Box::new(move |at| mix(p, at)),
        geometric: Box::new(geometric),
        normal: Box::new(move |at| smooth.map_or_else(|| geometric(at), |normals| mix(normals, at))),
        uv: Box::new(move |at| mix(uv, at)),
    }
}

fn instance(kind: u32, map: &DAffine3) -> Instance {
    let rows = |map: &DAffine3| {
        let m = map.matrix3.transpose();
        let t = map.translation;
        [m.x_axis.extend(t.x), m.y_axis.extend(t.y), m.z_axis.extend(t.z)].map(|row| row.as_vec4().to_array())
    };
    let ([world_row0, world_row1, world_row2], [object_row0, object_row1, object_row2]) =
        (rows(map), rows(&map.inverse()));
    Instance {
        kind,
        root: Instance::WORDS,
        light: NONE,
        material: 0,
        object_row0,
        object_row1,
        object_row2,
        world_row0,
        world_row1,
        world_row2,
        handedness: 1.0,
        motion: NONE,
        first_face: NONE,
        flags: 0,
    }
}

/// The map with what a 32-bit record keeps of it.
fn narrow(map: DAffine3) -> DAffine3 {
    let f = |v: DVec3| v.as_vec3().as_dvec3();
    let m = map.matrix3;
    DAffine3 {
        matrix3: DMat3::from_cols(f(m.x_axis), f(m.y_axis), f(m.z_axis)),
        translation: f(map.translation),
    }
}

/// Checks a shape under a map at random points, from both sides.
fn check(name: &str, shape: &Shape<'_>, map: &DAffine3, seed: u64) {
    const COUNT: usize = 4000;
    let mut random = Random(seed);
    let mut words: Vec<Word> = cast::<_, [Word; 8]>(instance(shape.kind, map)).to_vec();
    words.extend(&shape.words);
    words.resize(RAYS, [0; 4]);
    let inverse_transpose = map.matrix3.inverse().transpose();
    let world = |at: DVec2| map.transform_point3((shape.point)(at));
    let normal = |at: DVec2| {
        let geometric = inverse_transpose * (shape.geometric)(at);
        let n = (inverse_transpose * (shape.normal)(at)).normalize();
        if n.dot(geometric) < 0.0 { -n } else { n }
    };
    let mut places = Vec::new();
    for i in 0..COUNT {
        // The corners and the middle too
        let between = |x: f32| 0.001 + 0.998 * f64::from(x);
        let at = match i {
            0 => DVec2::splat(0.5),
            1..=4 => DVec2::new(f64::from((i as u32 - 1) & 1), f64::from((i as u32 - 1) >> 1)),
            _ => DVec2::new(between(random.f32()), between(random.f32())),
        };
        let corner = (1..=4).contains(&i);
        // A corner of a patch is hit from both sides; parts of quadrics end somewhere within rounding
        let at = if corner && shape.kind != INSTANCE_PATCH { at * 0.99999 + 0.000_005 } else { at };
        let n = (inverse_transpose * (shape.geometric)(at)).normalize() * if i % 2 == 0 { 1.0 } else { -1.0 };
        let away = n + 0.6 * DVec3::from(random.cube(1.0).map(f64::from));
        let origin = (world(at) + 0.05 * away).as_vec3();
        let direction = (world(at) - origin.as_dvec3()).as_vec3() * random.between(-6.0, 6.0).exp2();
        words.extend([vector(origin.to_array()), vector(direction.to_array())]);
        places.push(at);
    }
    let values = Probe::new().both(GLSL, &words, COUNT, 8 * COUNT);
    for (i, (at, value)) in places.iter().zip(values.chunks_exact(8)).enumerate() {
        let place = format!("{name}, {i}, at {at}");
        assert_eq!(value[0][0], 1, "{place}: no hit");
        let [_, _, u, v] = as_doubles(value[0]);
        let got = |k: usize| DVec3::from(three(as_doubles(value[k])));
        let near = |found: DVec3, expected: DVec3, relative: f64, what: &str| {
            let off = found.distance(expected);
            assert!(off <= relative * (1.0 + expected.length()), "{place}: {what} {found}, not {expected}");
        };
        near(got(1), world(*at), 5e-6, "position");
        let uv = (shape.uv)(*at);
        assert!(uv.distance(DVec2::new(u, v)) < 2e-5, "{place}: uv {u} {v}, not {uv}");
        near(got(2), normal(*at), 1e-4, "normal");
        near(got(3), (inverse_transpose * (shape.geometric)(*at)).normalize(), 1e-4, "geometric normal");
        // Central differences, of f64
        let h = 1e-5;
        let (x, y) = (DVec2::X * h, DVec2::Y * h);
        let slope = |f: &dyn Fn(DVec2) -> DVec3, step: DVec2| (f(*at + step) - f(*at - step)) / (2.0 * h);
        let uv_slope = |step: DVec2| ((shape.uv)(*at + step) - (shape.uv)(*at - step)) / (2.0 * h);
        let (a, b) = (uv_slope(x), uv_slope(y));
        let determinant = a.x * b.y - a.y * b.x;
        let by_uv = |f: &dyn Fn(DVec2) -> DVec3| {
            let (fa, fb) = (slope(f, x), slope(f, y));
            [(fa * b.y - fb * a.y) / determinant, (fb * a.x - fa * b.x) / determinant]
        };
        let [dpdu, dpdv] = by_uv(&world);
        let [dndu, dndv] = by_uv(&normal);
        near(got(4), dpdu, 1e-4, "∂p/∂u");
        near(got(5), dpdv, 1e-4, "∂p/∂v");
        near(got(6), dndu, 5e-4, "∂n/∂u");
        near(got(7), dndv, 5e-4, "∂n/∂v");
    }
}

#[test]
fn shapes_are_what_their_formulas_say() {
    let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let twisted = [[-1.0, -1.0, 0.3], [1.0, -0.8, -0.2], [-0.9, 1.0, -0.4], [1.1, 1.0, 0.5]];
    let normals = [[-0.2, 0.1, 1.0], [0.3, 0.0, 0.9], [0.0, 0.3, 1.0], [0.1, -0.2, 1.2]];
    let shapes = [
        ("part of a sphere", sphere_part()),
        ("part of a disk", disk_part()),
        ("tube", cylinder()),
        (
            "flat patch",
            patch([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [1.0, 1.0, 0.0]], None, square),
        ),
        ("twisted patch", patch(twisted, None, square)),
        ("patch with normals", patch(twisted, Some(normals), square)),
        ("patch with uv", patch(twisted, None, [[0.1, 0.9], [0.2, 0.1], [0.8, 1.0], [1.0, 0.3]])),
    ];
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -0.5, 0.3);
    let plain = DAffine3::IDENTITY;
    let placed = DAffine3::from_scale_rotation_translation(
        DVec3::new(1.5, 0.8, 1.2),
        turn,
        DVec3::new(0.3, -0.7, 0.5),
    );
    let mirrored = placed * DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    for (k, (name, shape)) in shapes.iter().enumerate() {
        for map in [plain, placed, mirrored] {
            check(name, shape, &narrow(map), 11 + k as u64);
        }
    }
}

/// Random rays against parts of quadrics, hit or missed as their definition says.
#[test]
fn parts_are_hit_only_where_they_are() {
    for shape in [sphere_part(), disk_part(), cylinder()] {
        let mut random = Random(5);
        let mut words: Vec<Word> = cast::<_, [Word; 8]>(instance(shape.kind, &DAffine3::IDENTITY)).to_vec();
        words.extend(&shape.words);
        words.resize(RAYS, [0; 4]);
        let count = 50_000;
        let rays: Vec<_> = (0..count)
            .map(|_| {
                let (o, aim) = (random.cube(2.5), random.cube(1.2));
                (o, [0, 1, 2].map(|c| aim[c] - o[c]))
            })
            .collect();
        rays.iter().for_each(|(o, d)| words.extend([vector(*o), vector(*d)]));
        let values = Probe::new().both(GLSL, &words, count, 8 * count);
        let part: QuadricPart = cast([shape.words[0], shape.words[1]]);
        let mut seen = [0; 2];
        for ((o, d), value) in rays.iter().zip(values.chunks_exact(8)) {
            let (o, d) = (DVec3::from(o.map(f64::from)), DVec3::from(d.map(f64::from)));
            let roots = if shape.kind == INSTANCE_DISK_PART {
                vec![-o.z / d.z]
            } else {
                let keep =
                    if shape.kind == INSTANCE_CYLINDER { DVec3::new(1.0, 1.0, 0.0) } else { DVec3::ONE };
                let (p, q) = (o * keep, d * keep);
                let (a, b, c) = (q.dot(q), p.dot(q), p.dot(p) - 1.0);
                let root = (b * b - a * c).sqrt();
                vec![(-b - root) / a, (-b + root) / a]
            };
            // How far inside of all its limits a point is
            let margin = |t: f64| {
                let p = o + d * t;
                let turn = p.y.atan2(p.x).rem_euclid(TAU) / TAU;
                let mut margin = (f64::from(part.turn) - turn).min(turn);
                if shape.kind == INSTANCE_DISK_PART {
                    let r = p.truncate().length();
                    margin = margin.min(1.0 - r).min(r - f64::from(part.inner_radius));
                } else {
                    margin = margin.min(p.z - f64::from(part.z_min)).min(f64::from(part.z_max) - p.z);
                }
                margin
            };
            let real: Vec<f64> = roots.into_iter().filter(|t| t.is_finite()).collect();
            let double = real.len() == 2 && (real[1] - real[0]) * d.length() < 1e-2;
            if double || real.iter().any(|t| margin(*t).abs() < 1e-4 || t.abs() < 1e-4) {
                continue;
            }
            let expected = real.into_iter().find(|t| *t > 0.0 && margin(*t) > 0.0);
            assert_eq!(value[0][0] == 1, expected.is_some(), "{} {o} {d}", shape.kind);
            seen[usize::from(expected.is_some())] += 1;
            if let Some(t) = expected {
                let got = as_doubles(value[0])[1];
                assert!((got - t).abs() * d.length() < 1e-4, "{} {o} {d}: {got} not {t}", shape.kind);
            }
        }
        assert!(seen[0] > 5_000 && seen[1] > 5_000, "{} {seen:?}", shape.kind);
    }
}
