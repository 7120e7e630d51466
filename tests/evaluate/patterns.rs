//! Checkers, bricks, dots, the edges of cells, and what changes the input of a texture.

use super::trees::{BLACK, WHITE, noise, points, reds, scene_of, space, values};
use crate::common::twins::noise::pcg3d;
use dapple::layout::{Backend, TexturePoint};
use dapple::scene::{
    Brick, Coordinates, Dots, Gradient, Metric, Noise, NoiseSum, Perlin, PerlinVariant, Texture, Value, Warp,
    WorleyFeature,
};
use glam::{Vec2, Vec3};

/// Values of a texture over squares, and means over points that are spread in them.
fn over_squares(texture: &Texture, middles: &[Vec3], width: f32) -> (Vec<f64>, Vec<f64>) {
    const SIDE: usize = 24;
    let (scene, handle) = scene_of([texture.clone()]);
    let at = |p: &Vec3| TexturePoint {
        object_position: p.to_array(),
        object_footprint: width,
        ..TexturePoint::default()
    };
    let asked: Vec<_> = middles.iter().map(at).collect();
    let found = super::evaluate(&scene, handle, Backend::Texel, &asked).unwrap();
    let found = found.into_iter().map(|value| f64::from(value[0])).collect();
    let offset = |i: usize| width * ((i as f32 + 0.5) / SIDE as f32 - 0.5);
    let spread: Vec<Vec3> = middles
        .iter()
        .flat_map(|p| (0..SIDE * SIDE).map(|i| *p + Vec3::new(offset(i % SIDE), offset(i / SIDE), 0.0)))
        .collect();
    let all = reds(texture.clone(), &spread);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    (found, all.chunks(SIDE * SIDE).map(mean).collect())
}

fn plane(count: usize) -> Vec<Vec3> {
    points(count, 6.0).into_iter().map(|p| Vec3::new(p.x, p.y, 0.5)).collect()
}

#[test]
fn checkers_are_means_over_the_pixel() {
    let checker = |dimensions| Texture::Checker {
        dimensions,
        even: WHITE,
        odd: BLACK,
        space: space(Coordinates::Object),
    };
    for width in [0.05, 0.4, 1.0, 1.7, 4.3] {
        let (found, expected) = over_squares(&checker(2), &plane(60), width);
        for (found, expected) in found.iter().zip(&expected) {
            // A border may pass any of the 24 columns and rows of points
            assert!((found - expected).abs() < 0.05, "width {width}: {found}, expected {expected}");
        }
    }
    // The third dimension: the same in even layers, the opposite in odd ones
    let at = plane(40);
    let above: Vec<Vec3> = at.iter().map(|p| *p + Vec3::Z).collect();
    assert_eq!(reds(checker(3), &at), reds(checker(2), &above));
    let (a, b) = (reds(checker(3), &at), reds(checker(3), &above));
    assert!(a.iter().zip(&b).all(|(a, b)| a + b == 1.0));
}

#[test]
fn bricks_lie_in_rows() {
    let wall = |variation| {
        Texture::Brick(Brick {
            brick: Value::Constant(Vec3::splat(0.5)),
            mortar: BLACK,
            size: Vec2::new(2.0, 0.5),
            joint: 0.1,
            offset: 0.5,
            variation,
            space: space(Coordinates::Object),
        })
    };
    let at = |x: f32, y: f32| Vec3::new(x, y, 3.0);
    // The middle of a brick, its ends, and the mortar between rows; the next row is moved by half a brick
    let known = [
        (at(1.0, 0.25), 0.5),
        (at(0.04, 0.25), 0.0),
        (at(0.06, 0.25), 0.5),
        (at(1.96, 0.25), 0.0),
        (at(1.0, 0.03), 0.0),
        (at(1.0, 0.75), 0.0),
        (at(0.0, 0.75), 0.5),
        (at(-1.0, -0.25), 0.0),
        (at(-2.0, -0.25), 0.5),
    ];
    let places: Vec<Vec3> = known.iter().map(|case| case.0).collect();
    assert_eq!(reds(wall(0.0), &places), known.map(|case| case.1));
    // Each brick has one lightness, and they differ
    let row: Vec<Vec3> = (0..40).map(|i| at(1.0 + 2.0 * i as f32, 0.25)).collect();
    let beside: Vec<Vec3> = row.iter().map(|p| *p + Vec3::new(0.5, 0.1, 0.0)).collect();
    let (a, b) = (reds(wall(0.4), &row), reds(wall(0.4), &beside));
    assert_eq!(a, b);
    assert!(a.iter().all(|v| (0.3 - 1e-6..=0.7 + 1e-6).contains(v)));
    assert!(a.iter().any(|v| *v < 0.4) && a.iter().any(|v| *v > 0.6));
    for width in [0.03, 0.2] {
        // A row at a time: the filter takes the joints of one row
        let inside: Vec<Vec3> =
            plane(80).into_iter().filter(|p| (p.y.rem_euclid(0.5) - 0.25).abs() < 0.12).collect();
        let (found, expected) = over_squares(&wall(0.0), &inside, width);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 0.03, "width {width}: {found}, expected {expected}");
        }
    }
    // Far away: the share of the bricks
    let (found, _) = over_squares(&wall(0.4), &plane(5), 200.0);
    assert!(found.iter().all(|v| (v - 0.5 * 0.95 * 0.8).abs() < 0.005), "{found:?}");
}

#[test]
fn dots_are_where_noise_says() {
    let dots = |radius| {
        Texture::Dots(Dots { inside: WHITE, outside: BLACK, radius, space: space(Coordinates::Object) })
    };
    let at = plane(500);
    let cells: Vec<Vec2> = at.iter().map(|p| (Vec2::new(p.x, p.y) + 0.5).floor()).collect();
    let n = |offset: Vec2| {
        let points: Vec<Vec3> = cells.iter().map(|cell| (*cell + offset).extend(0.5)).collect();
        let perlin = Perlin { variant: PerlinVariant::Pbrt, dimensions: 3 };
        reds(Texture::Noise(Noise { perlin, ..noise(NoiseSum::Fbm, 1, 0.5, 2.0) }), &points)
            .into_iter()
            .map(|value| 2.0 * value - 1.0)
            .collect::<Vec<f64>>()
    };
    let (there, x, y) = (n(Vec2::splat(0.5)), n(Vec2::new(1.5, 2.8)), n(Vec2::new(4.5, 9.8)));
    let found = reds(dots(0.35), &at);
    let mut inside = 0;
    for i in 0..at.len() {
        let center = (f64::from(cells[i].x) + 0.15 * x[i], f64::from(cells[i].y) + 0.15 * y[i]);
        let distance = (f64::from(at[i].x) - center.0).hypot(f64::from(at[i].y) - center.1);
        if (distance - 0.35).abs() > 1e-4 {
            assert_eq!(found[i], f64::from(u8::from(there[i] > 0.0 && distance < 0.35)), "{}", at[i]);
            inside += usize::from(found[i] == 1.0);
        }
    }
    assert!((60..140).contains(&inside), "{inside}");
    let (found, expected) = over_squares(&dots(0.35), &at[..80], 0.05);
    let off = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 0.12, "{off}");
    let (found, _) = over_squares(&dots(0.35), &at[..5], 50.0);
    assert!(found.iter().all(|v| (v - 0.5 * std::f64::consts::PI * 0.35 * 0.35).abs() < 1e-6));
}

#[test]
fn edges_of_cells_are_half_way_between_points() {
    let at = points(400, 6.0);
    let edge = Texture::Worley {
        feature: WorleyFeature::Edge,
        metric: Metric::Euclidean,
        low: BLACK,
        high: WHITE,
        space: space(Coordinates::Object),
    };
    let found = reds(edge, &at);
    let mut near = 0;
    for (p, found) in at.iter().zip(found) {
        let mut all = Vec::new();
        for i in 0..27 {
            let cell = p.floor().as_ivec3() + glam::IVec3::new(i % 3, i / 3 % 3, i / 9) - 1;
            let random =
                pcg3d(cell.to_array().map(|c| c as u32)).map(|bits| f64::from(bits >> 8) / 16_777_216.0);
            all.push(cell.as_dvec3() + glam::DVec3::from_array(random) - p.as_dvec3());
        }
        all.sort_by(|a, b| a.length().total_cmp(&b.length()));
        let to = |other: &glam::DVec3| {
            let across = *other - all[0];
            // How far along `across` the plane in the middle is
            (0.5 * (*other + all[0])).dot(across.normalize())
        };
        let expected = all[1..].iter().map(to).fold(f64::INFINITY, f64::min);
        assert!((found - expected.min(1.0)).abs() < 1e-5, "{p}: {found}, expected {expected}");
        near += usize::from(found < 0.1);
    }
    assert!(near > 40, "{near}");
}

#[test]
fn curves_and_factors_change_channels() {
    let color = Texture::Checker {
        dimensions: 3,
        even: Value::Constant(Vec3::new(0.25, 0.5, 2.0)),
        odd: BLACK,
        space: space(Coordinates::Object),
    };
    let at = [Vec3::splat(0.5), Vec3::new(1.5, 0.5, 0.5)];
    let points = vec![(0.0, 1.0), (0.5, 0.0), (1.0, 4.0)];
    for (smooth, quarter) in [(false, 0.5), (true, 0.5)] {
        let (mut scene, input) = scene_of([color.clone()]);
        let value = Value::Texture(input);
        let curve = scene.textures.add("curve", Texture::Curve { value, points: points.clone(), smooth });
        assert_eq!(values(&scene, curve, &at), [[quarter, 0.0, 4.0, 1.0], [1.0, 1.0, 1.0, 1.0]]);
        let factor = Value::Texture(input);
        let scaled = scene.textures.add("scaled", Texture::Scale { value: Value::Texture(curve), factor });
        // The mean of 0.25, 0.5 and 2
        let mean = 2.75 / 3.0;
        let found = values(&scene, scaled, &at);
        assert!((found[0][2] - 4.0 * mean).abs() < 1e-6 && found[1][..3] == [0.0; 3], "{found:?}");
    }
}

#[test]
fn a_warp_moves_the_points_of_its_input() {
    let gradient = |coordinates| Texture::Gradient {
        shape: Gradient::Linear,
        low: BLACK,
        high: Value::Constant(Vec3::splat(1.0)),
        space: space(coordinates),
    };
    let at: Vec<Vec3> = points(60, 0.2).into_iter().map(|p| p + 0.5).collect();
    for coordinates in [Coordinates::Object, Coordinates::World, Coordinates::Uv] {
        // By 0.5 · (2 · colour − 1) = (0.2, …)
        let (mut scene, value) = scene_of([gradient(coordinates)]);
        let by = Value::Constant(Vec3::new(0.7, 0.5, 0.5));
        let warp = Warp::By { value: Value::Texture(value), by, amount: 0.5 };
        let warped = scene.textures.add("warped", Texture::Warp(warp));
        for (found, p) in values(&scene, warped, &at).iter().zip(&at) {
            assert!((found[0] - (f64::from(p.x) + 0.2)).abs() < 1e-6, "{coordinates:?}: {found:?} at {p}");
        }
    }
    // By noise: three sums, the first of which is that of the points themselves
    let (mut scene, value) = scene_of([gradient(Coordinates::Object)]);
    let warp = Warp::Noise {
        value: Value::Texture(value),
        amount: 0.1,
        octaves: 3,
        gain: 0.5,
        lacunarity: 2.0,
        space: space(Coordinates::Object),
    };
    let warped = scene.textures.add("warped", Texture::Warp(warp));
    let fbm = Noise { normalize: false, ..noise(NoiseSum::Fbm, 3, 0.5, 2.0) };
    let n = reds(Texture::Noise(fbm), &at);
    for ((found, p), n) in values(&scene, warped, &at).iter().zip(&at).zip(n) {
        assert!((found[0] - (f64::from(p.x) + 0.1 * n)).abs() < 1e-5, "{found:?} at {p}");
    }
}
