//! Motions go where they must, and their boxes hold them.

use super::super::bounds::{ellipsoid_bounds, transformed};
use super::*;
use glam::{Mat3A, Quat};
use proptest::prelude::*;

fn between(open: &Affine3A, close: &Affine3A) -> Motion {
    Motion::between("it", open, Some(close)).unwrap().unwrap()
}

fn expect_near(a: Vec3, b: Vec3) {
    assert!(a.distance(b) <= 1e-5 * (1.0 + b.length()), "{a}, expected {b}");
}

#[test]
fn a_place_that_stays_is_no_motion() {
    let map = Affine3A::from_translation(Vec3::X);
    assert!(Motion::between("it", &map, Some(&map)).unwrap().is_none());
    assert!(Motion::between("it", &map, None).unwrap().is_none());
}

#[test]
fn half_way_is_the_middle_of_the_turn_the_stretch_and_the_way() {
    let open = Affine3A::from_scale(Vec3::new(1.0, 2.0, 3.0));
    let close = Affine3A::from_scale_rotation_translation(
        Vec3::new(3.0, 2.0, 1.0),
        Quat::from_rotation_z(std::f32::consts::FRAC_PI_2),
        Vec3::new(4.0, 0.0, 0.0),
    );
    let middle = narrow(&between(&open, &close).at(0.5, &DAffine3::IDENTITY));
    let h = std::f32::consts::FRAC_1_SQRT_2;
    expect_near(middle.transform_point3(Vec3::ZERO), Vec3::new(2.0, 0.0, 0.0));
    expect_near(middle.transform_vector3(Vec3::X), Vec3::new(2.0 * h, 2.0 * h, 0.0));
    expect_near(middle.transform_vector3(Vec3::Y), Vec3::new(-2.0 * h, 2.0 * h, 0.0));
    expect_near(middle.transform_vector3(Vec3::Z), Vec3::new(0.0, 0.0, 2.0));
}

#[test]
fn a_turn_goes_the_shorter_way() {
    let turn = |degrees: f32| Affine3A::from_rotation_y(degrees.to_radians());
    let half_way = narrow(&between(&turn(-20.0), &turn(-320.0)).at(0.5, &DAffine3::IDENTITY));
    expect_near(half_way.transform_vector3(Vec3::X), turn(10.0).transform_vector3(Vec3::X));
}

#[test]
fn what_turns_inside_out_is_refused() {
    let mirrored = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    assert!(Motion::between("it", &Affine3A::IDENTITY, Some(&mirrored)).is_err());
    let half_way = narrow(
        &between(&mirrored, &(Affine3A::from_translation(Vec3::X) * mirrored)).at(0.5, &DAffine3::IDENTITY),
    );
    expect_near(half_way.transform_vector3(Vec3::X), Vec3::NEG_X);
    expect_near(half_way.transform_vector3(Vec3::Y), Vec3::Y);
}

fn vector(range: f32) -> impl Strategy<Value = Vec3> {
    [-range..range, -range..range, -range..range].prop_map(Vec3::from)
}

/// Any map that does not mirror and is not flat.
fn map() -> impl Strategy<Value = Affine3A> {
    (vector(1.0), vector(1.0), vector(1.0), vector(20.0)).prop_filter_map("flat", |(x, y, z, t)| {
        let m = Mat3A::from_cols(x.into(), y.into(), z.into());
        let m = if m.determinant() < 0.0 { -m } else { m };
        (m.determinant() > 1e-2).then_some(Affine3A { matrix3: m, translation: t.into() })
    })
}

proptest! {
    #[test]
    fn the_ends_are_the_maps(open in map(), close in map(), first in map(), p in vector(3.0)) {
        let motion = between(&open, &close);
        for (time, map) in [(0.0, open), (1.0, close)] {
            let there = narrow(&motion.at(time, &first.as_daffine3())).transform_point3(p);
            let expected = map.transform_point3(first.transform_point3(p));
            prop_assert!(there.distance(expected) < 1e-4, "{there} at {time}, expected {expected}");
        }
    }

    #[test]
    fn no_point_leaves_the_box(open in map(), close in map(), first in map(), p in vector(1.0), time in 0.0..=1.0_f64) {
        let motion = between(&open, &close);
        let cube = Bounds { min: Vec3::NEG_ONE, max: Vec3::ONE };
        let boxed = motion.bounds(&first, &cube, |map| transformed(&cube, map));
        let there = motion.at(time, &first.as_daffine3());
        prop_assert_eq!(boxed.distance(there.transform_point3(p.as_dvec3()).as_vec3()), 0.0);
        // No larger than it must be: a cube around what the corners reach
        let size = (0..=64).flat_map(|i| {
            let map = motion.at(f64::from(i) / 64.0, &first.as_daffine3());
            cube.corners().map(move |corner| map.transform_point3(corner.as_dvec3()).as_vec3())
        }).fold(Bounds::default(), |mut all, p| { all.add(p); all });
        prop_assert!(boxed.diagonal() < 1.05 * size.diagonal(), "{} for {}", boxed.diagonal(), size.diagonal());
        let unit = p.normalize_or(Vec3::X);
        let round = motion.bounds(&first, &cube, ellipsoid_bounds);
        prop_assert_eq!(round.distance(there.transform_point3(unit.as_dvec3()).as_vec3()), 0.0);
    }
}

#[test]
fn a_point_between_the_samples_is_outside_of_a_box_without_a_margin() {
    // Half a turn: the ends alone are a box of no height
    let half = Affine3A::from_rotation_z(179.0_f32.to_radians());
    let motion = between(&Affine3A::IDENTITY, &half);
    let point = Bounds { min: Vec3::X, max: Vec3::X };
    let boxed = motion.bounds(&Affine3A::IDENTITY, &point, |map| transformed(&point, map));
    assert!((1.0..1.01).contains(&boxed.max.y), "{boxed:?}");
    assert!(boxed.min.y < 0.0 && boxed.min.y > -0.01, "{boxed:?}");
}
