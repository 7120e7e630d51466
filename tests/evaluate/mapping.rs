//! Mappings and seams, against their formulas.

use super::evaluate;
use super::trees::points;
use crate::common::render::{Build as _, scene};
use dapple::layout::{Backend, TexturePoint};
use dapple::scene::{
    Coordinates, Gradient, Handle, Image, Mapping, MappingKind, MappingSpace, PatternSpace, Scene,
    TexelFilter, Texels, Texture, Value, Wrap,
};
use glam::{Affine3A, Mat3, Vec3};
use std::f64::consts::PI;

fn mapping(kind: MappingKind) -> Mapping {
    Mapping {
        kind,
        space: MappingSpace::Object,
        mapping_from_space: Affine3A::IDENTITY,
        pole_u: 0.0,
        seam_blend: 0.0,
        sharpness: 4.0,
    }
}

/// A texture whose red is u, green is v and blue is 1: two gradients from −8 to 8, so that nothing is cut off.
fn coordinates(scene: &mut Scene) -> Handle<Texture> {
    let wide = Affine3A::from_translation(Vec3::splat(-8.0)) * Affine3A::from_scale(Vec3::splat(16.0));
    let along = |turn: Mat3, color: Vec3| Texture::Gradient {
        shape: Gradient::Linear,
        low: Value::Constant(-8.0 * color),
        high: Value::Constant(8.0 * color),
        space: PatternSpace {
            coordinates: Coordinates::Uv,
            pattern_from_space: wide.inverse() * Affine3A::from_mat3(turn),
            filter_width: 0.0,
        },
    };
    let swap = Mat3::from_cols(Vec3::Y, Vec3::X, Vec3::Z);
    let u = Value::Texture(scene.textures.add("u", along(Mat3::IDENTITY, Vec3::X)));
    let v = Value::Texture(scene.textures.add("v", along(swap, Vec3::Y)));
    scene.textures.add("uv", Texture::Add { a: u, b: v })
}

fn values(scene: &Scene, handle: Handle<Texture>, points: &[TexturePoint]) -> Vec<[f64; 4]> {
    let [storage, texel] =
        [Backend::Storage, Backend::Texel].map(|backend| evaluate(scene, handle, backend, points).unwrap());
    assert!(storage == texel);
    storage.into_iter().map(|value| value.map(f64::from)).collect()
}

fn at(p: Vec3, normal: Vec3) -> TexturePoint {
    // In the world elsewhere, so that the spaces cannot be taken for one another
    TexturePoint {
        position: (p + 1.0).to_array(),
        object_position: p.to_array(),
        object_normal: normal.to_array(),
        uv: [0.3, 0.7],
        ..TexturePoint::default()
    }
}

/// u and v of points by a mapping.
fn mapped(mapping: Mapping, points: &[Vec3]) -> Vec<[f64; 2]> {
    let mut scene = scene(8, 8, 1);
    let value = Value::Texture(coordinates(&mut scene));
    let handle = scene.textures.add("mapped", Texture::Mapped { value, mapping });
    let points: Vec<_> = points.iter().map(|p| at(*p, Vec3::Z)).collect();
    values(&scene, handle, &points).into_iter().map(|value| [value[0], value[1]]).collect()
}

#[track_caller]
fn expect(found: [f64; 2], expected: [f64; 2], what: &str) {
    let off = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
    // The gradients are 16 wide: 2⁻²⁰ is a rounding of theirs
    assert!(off < 5e-6, "{what}: {found:?}, expected {expected:?}");
}

/// Longitude in turns, in [0, 1).
fn turns(p: Vec3) -> f64 {
    (f64::from(p.y).atan2(f64::from(p.x)) / (2.0 * PI)).rem_euclid(1.0)
}

#[test]
fn spheres_and_cylinders_have_longitudes() {
    let at = points(300, 3.0);
    let sphere = mapped(mapping(MappingKind::Spherical), &at);
    let cylinder = mapped(mapping(MappingKind::Cylindrical), &at);
    let plane = mapped(mapping(MappingKind::Planar), &at);
    for (i, p) in at.iter().enumerate() {
        let [x, y, z] = p.to_array().map(f64::from);
        let latitude = (z / (x * x + y * y + z * z).sqrt()).asin();
        expect(sphere[i], [turns(*p), latitude / PI + 0.5], &format!("sphere {p}"));
        expect(cylinder[i], [turns(*p), z], &format!("cylinder {p}"));
        expect(plane[i], [x, y], &format!("plane {p}"));
    }
}

#[test]
fn the_pole_has_the_coordinate_that_the_scene_gives_it() {
    let poles = [Vec3::Z * 2.0, Vec3::Z * -0.5];
    for pole_u in [0.0, 0.25] {
        for (found, v) in
            mapped(Mapping { pole_u, ..mapping(MappingKind::Spherical) }, &poles).iter().zip([1.0, 0.0])
        {
            expect(*found, [f64::from(pole_u), v], "pole");
        }
    }
}

#[test]
fn mappings_are_placed_in_space() {
    let at = points(50, 3.0);
    let placed = Affine3A::from_translation(Vec3::new(1.0, 2.0, 3.0))
        * Affine3A::from_rotation_x(0.7)
        * Affine3A::from_scale(Vec3::new(2.0, 1.5, 1.0));
    for space in [MappingSpace::Object, MappingSpace::World] {
        let mapping = Mapping { space, mapping_from_space: placed.inverse(), ..mapping(MappingKind::Planar) };
        for (p, found) in at.iter().zip(mapped(mapping, &at)) {
            let p = if space == MappingSpace::World { *p + 1.0 } else { *p };
            let inside = placed.inverse().transform_point3(p);
            expect(found, [f64::from(inside.x), f64::from(inside.y)], &format!("{space:?} {p}"));
        }
    }
}

#[test]
fn cubes_show_a_picture_on_each_face() {
    let cases = [
        (Vec3::new(2.0, 0.5, -1.0), [0.75, 0.625]),
        (Vec3::new(-2.0, 0.5, -1.0), [0.25, 0.625]),
        (Vec3::new(-1.0, 0.5, 2.0), [0.25, 0.625]),
        (Vec3::new(-1.0, 0.5, -2.0), [0.75, 0.625]),
        (Vec3::new(0.5, 1.0, 0.25), [0.75, 0.375]),
        (Vec3::new(0.5, -1.0, 0.25), [0.75, 0.625]),
        (Vec3::ZERO, [0.5, 0.5]),
    ];
    let found = mapped(mapping(MappingKind::Cube), &cases.map(|case| case.0));
    for (found, (p, expected)) in found.into_iter().zip(cases) {
        expect(found, expected, &format!("{p}"));
    }
}

#[test]
fn three_planes_are_mixed_by_the_normal() {
    let p = Vec3::new(0.1, 0.2, 0.3);
    // Seen along +x, −x, +y, −y, +z and −z
    let planes = [[-0.3, 0.2], [0.3, 0.2], [0.1, -0.3], [0.1, 0.3], [0.1, 0.2], [-0.1, 0.2]];
    let axes = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
    let mut scene = scene(8, 8, 1);
    let value = Value::Texture(coordinates(&mut scene));
    let texture = Texture::Mapped { value, mapping: mapping(MappingKind::Triplanar) };
    let handle = scene.textures.add("mapped", texture);
    let mut cases: Vec<_> = axes.into_iter().zip(planes).collect();
    cases.push((Vec3::splat(7.0), [(-0.3 + 0.1 + 0.1) / 3.0, (0.2 - 0.3 + 0.2) / 3.0]));
    // Weights 1 and 2⁻⁴
    cases.push((Vec3::new(0.0, 3.0, 1.5), [0.1, (-0.3 + 0.2 / 16.0) / (1.0 + 1.0 / 16.0)]));
    let points: Vec<_> = cases.iter().map(|(normal, _)| at(p, *normal)).collect();
    for (found, (normal, expected)) in values(&scene, handle, &points).into_iter().zip(cases) {
        expect([found[0], found[1]], expected, &format!("{normal}"));
    }
}

/// A picture whose red grows from 0 to 1 along u, which does not fit at its ends.
fn unfitting(scene: &mut Scene) -> Handle<Texture> {
    let texels = (0..64).map(|i| [(i as f32 + 0.5) / 64.0; 4]).collect();
    scene.picture(Image { width: 64, height: 1, texels: Texels::RgbaF32(texels) }, |texture| {
        texture.filter = TexelFilter::Bilinear;
        texture.wrap = [Wrap::Clamp; 2];
    })
}

#[test]
fn seams_are_blended_away() {
    for kind in [MappingKind::Uv, MappingKind::Spherical, MappingKind::Cylindrical] {
        let jump = |seam_blend: f32| {
            let mut scene = scene(8, 8, 1);
            let value = Value::Texture(unfitting(&mut scene));
            let mapping = Mapping { seam_blend, ..mapping(kind) };
            let handle = scene.textures.add("mapped", Texture::Mapped { value, mapping });
            let point = |u: f32| {
                let (sin, cos) = (u * 2.0 * std::f32::consts::PI).sin_cos();
                TexturePoint { uv: [u.rem_euclid(1.0), 0.5], ..at(Vec3::new(cos, sin, 0.2), Vec3::Z) }
            };
            let us = [-1e-4, 1e-4, 0.05, 0.1, 0.5, 0.999, -2e-3, 2e-3];
            values(&scene, handle, &us.map(point)).into_iter().map(|value| value[0]).collect::<Vec<_>>()
        };
        let (plain, blended) = (jump(0.0), jump(0.1));
        assert!((plain[0] - plain[1]).abs() > 0.9, "{plain:?}");
        assert!((blended[0] - blended[1]).abs() < 1e-3, "{blended:?}");
        // Neither does the slope jump: 2e-3 of a turn moves the picture by as much, and the blend by 3 (0.02)² of a turn
        assert!((blended[6] - blended[7]).abs() < 6e-3, "{blended:?}");
        // u / 1.1 of a picture of 1.1 turns; half way through the blend the mean of both turns
        for (found, expected) in [(blended[3], 0.1 / 1.1), (blended[4], 0.5 / 1.1), (blended[2], 0.55 / 1.1)]
        {
            assert!((found - expected).abs() < 1e-4, "{kind:?}: {blended:?}, expected {expected}");
        }
    }
}
