//! Bumps and normal maps: the normals that they must give.

use crate::common::render::*;
use dapple::film::Picture;
use dapple::scene::*;
use glam::{Affine3A, DVec3, Vec2, Vec3};
use std::f64::consts::PI;

const RULES: [Derivative; 3] = [Derivative::Kernel, Derivative::Forward, Derivative::Analytic];

/// A height that grows by 1 over the picture, along u or along v, in `texels` steps.
fn ramp(s: &mut Scene, texels: u32, along_v: bool) -> Handle<Texture> {
    // Texel centres are at (i + ½) / n, and row 0 is on top
    let value = |i: u32| (i as f32 + 0.5) / texels as f32;
    let texel = |i: u32| [if along_v { value(texels - 1 - i) } else { value(i) }; 4];
    let (width, height) = if along_v { (1, texels) } else { (texels, 1) };
    let texels = Texels::RgbaF32((0..texels).map(texel).collect());
    s.picture(Image { width, height, texels }, |texture| texture.wrap = [Wrap::Clamp; 2])
}

fn bumped(s: &mut Scene, texture: Handle<Texture>, height: f32, derivative: Derivative) -> Handle<Material> {
    let m = s.diffuse(0.5);
    s.materials[m].detail.bump = Some(Bump { texture, height, derivative, curvature: true });
    m
}

/// Demands a normal of the pixels that `expected` gives one for.
#[track_caller]
fn expect_normals(picture: &Picture, what: &str, tolerance: f64, expected: impl Fn(usize) -> Option<DVec3>) {
    let mut seen = 0;
    for (i, normal) in picture.normal.iter().enumerate() {
        let Some(expected) = expected(i) else { continue };
        let off = (DVec3::from_array(normal.map(f64::from)) - expected.normalize()).length();
        assert!(
            off < tolerance,
            "{what}, pixel {i}: {normal:?}, expected {}: off by {off:.2e}",
            expected.normalize()
        );
        seen += 1;
    }
    assert!(seen > 10, "{what}: {seen} pixels");
}

/// A camera that sees the square from (−0.4, −0.4, −4) to (0.4, 0.4, −4).
fn facing() -> Scene {
    let mut s = scene(9, 9, 1);
    s.render.sampler = Sampler::Center;
    s.camera.projection = Projection::pinhole(2.0 * (0.1_f32).atan().to_degrees());
    s
}

#[test]
fn a_constant_slope_tilts_a_quad_alike_by_every_rule_and_resolution() {
    for (along_v, tilt) in [(false, DVec3::new(-0.5, 0.0, 1.0)), (true, DVec3::new(0.0, -0.25, 1.0))] {
        for (rule, texels) in RULES.into_iter().flat_map(|rule| [(rule, 8), (rule, 64)]) {
            let mut s = facing();
            let texture = ramp(&mut s, texels, along_v);
            let m = bumped(&mut s, texture, 1.0, rule);
            // 2 wide and 4 high: the same height is half as steep along v
            s.quad(Vec3::new(-1.0, -2.0, -4.0), Vec3::X * 2.0, Vec3::Y * 4.0, m);
            // The lecture's literal cross product would turn the tilt by 90°
            expect_normals(&render(&s), &format!("{rule:?}, {texels} texels, {along_v}"), 2e-3, |_| {
                Some(tilt)
            });
        }
    }
}

#[test]
fn a_slope_on_a_sheared_triangle_is_that_of_its_uv() {
    // u runs along x, v along (1, 2): the height h = u has the gradient of u, (1, −½) in the plane
    for rule in RULES {
        for pieces in [1, 8] {
            let mut s = facing();
            let texture = ramp(&mut s, 32, false);
            let m = bumped(&mut s, texture, 0.5, rule);
            let n = pieces + 1;
            let at = |i: u32| Vec2::new((i % n) as f32, (i / n) as f32) / pieces as f32;
            let place = |uv: Vec2| Vec3::new(-2.0 + 2.0 * uv.x + 2.0 * uv.y, -2.0 + 4.0 * uv.y, -4.0);
            let cells = (0..pieces * pieces).map(|c| c / pieces * n + c % pieces);
            let mesh = Mesh {
                positions: (0..n * n).map(|i| place(at(i))).collect(),
                uvs: (0..n * n).map(at).collect(),
                triangles: cells.flat_map(|a| [[a, a + 1, a + 1 + n], [a, a + 1 + n, a + n]]).collect(),
                ..Mesh::default()
            };
            let mesh = s.meshes.add("sheared", mesh);
            s.place(mesh, m, Affine3A::IDENTITY);
            // ∂h/∂x = 0.5 / 2, ∂h/∂y = −0.5 / 4
            let expected = DVec3::new(-0.25, 0.125, 1.0);
            expect_normals(&render(&s), &format!("{rule:?}, {pieces} pieces"), 2e-3, |_| Some(expected));
        }
    }
}

#[test]
fn a_slope_on_a_sphere_and_its_bend() {
    for curvature in [false, true] {
        for along_v in [false, true] {
            let mut s = scene(15, 15, 1);
            s.render.sampler = Sampler::Center;
            s.camera = look(Vec3::new(-6.0, 0.0, 0.0), Vec3::ZERO, 30.0);
            let texture = ramp(&mut s, 256, along_v);
            let m = bumped(&mut s, texture, 0.75, Derivative::Kernel);
            s.materials[m].detail.bump.as_mut().unwrap().curvature = curvature;
            s.materials[m].detail.keep_visible = false;
            let (pole, meridian) = (Vec3::Y, Vec3::X);
            s.shape(ShapeKind::Sphere { center: Vec3::ZERO, radius: 1.5, pole, meridian }, m);
            let picture = render(&s);
            let expected = |i: usize| {
                let (origin, direction) = center_ray(&s, (i % 15) as u32, (i / 15) as u32);
                let b = origin.dot(direction);
                let root = b * b - (origin.dot(origin) - 2.25);
                let n = (origin + direction * (-b - (root > 0.0).then(|| root.sqrt())?)) / 1.5;
                // Longitude from x towards pole × meridian = −z
                let (longitude, latitude) = ((-n.z).atan2(n.x).rem_euclid(2.0 * PI), n.y.asin());
                (latitude.abs() < 1.0).then_some(())?;
                let east = DVec3::new(-longitude.sin(), 0.0, -longitude.cos());
                let north = n.cross(east).normalize();
                let north = if north.y < 0.0 { -north } else { north };
                let (turn, height) = match along_v {
                    true => (PI, 0.75 * (latitude / PI + 0.5)),
                    false => (2.0 * PI * latitude.cos(), 0.75 * longitude / (2.0 * PI)),
                };
                let radius = 1.5 + if curvature { height } else { 0.0 };
                Some(n - (if along_v { north } else { east }) * (0.75 / (turn * radius)))
            };
            expect_normals(&picture, &format!("{curvature} {along_v}"), 3e-3, expected);
        }
    }
}

#[test]
fn a_flat_map_changes_nothing() {
    let plain = |change: &dyn Fn(&mut Scene, Handle<Material>)| {
        let mut s = scene(32, 32, 4);
        s.camera = look(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, 40.0);
        let m = s.diffuse(0.5);
        change(&mut s, m);
        let mesh = s.meshes.add("ball", ball(6));
        s.place(mesh, m, Affine3A::from_scale(Vec3::new(1.0, 0.5, 1.0)));
        s.lights.push(Light::point(Vec3::new(3.0, 4.0, 5.0), Vec3::splat(50.0)));
        render(&s)
    };
    let flat = |s: &mut Scene, texel| {
        s.picture(Image { width: 2, height: 2, texels: Texels::Rgba8(vec![texel; 4]) }, |_| {})
    };
    let reference = plain(&|_, _| {});
    for rule in RULES {
        let picture = plain(&|s, m| {
            let texture = flat(s, [90; 4]);
            s.materials[m].detail.bump =
                Some(Bump { texture, height: 1.0, derivative: rule, curvature: false });
        });
        expect_close(&picture, &reference);
    }
    for texel in [[127, 127, 255, 255], [128, 128, 255, 255]] {
        expect_close(
            &plain(&|s, m| {
                let texture = flat(s, texel);
                let tangents = Tangents::MikkTSpace;
                s.materials[m].detail.normal_map =
                    Some(NormalMap { texture, green_down: false, strength: 1.0, tangents });
            }),
            &reference,
        );
    }
}

#[track_caller]
fn expect_close(a: &Picture, b: &Picture) {
    for (i, (a, b)) in a.rgb.iter().zip(&b.rgb).enumerate() {
        assert!((a[0] - b[0]).abs() < 2e-4, "pixel {i}: {a:?}, {b:?}");
    }
}

/// A ball of triangles with normals and uv.
fn ball(rings: u32) -> Mesh {
    let columns = 2 * rings + 1;
    let uv =
        |i: u32| Vec2::new((i % columns) as f32 / (2 * rings) as f32, (i / columns) as f32 / rings as f32);
    let place = |uv: Vec2| {
        let (longitude, latitude) = (uv.x * 2.0 * std::f32::consts::PI, (uv.y - 0.5) * std::f32::consts::PI);
        Vec3::new(latitude.cos() * longitude.cos(), latitude.cos() * longitude.sin(), latitude.sin())
    };
    let uvs: Vec<_> = (0..columns * (rings + 1)).map(uv).collect();
    let cells = (0..rings * 2 * rings).map(|c| c / (2 * rings) * columns + c % (2 * rings));
    Mesh {
        positions: uvs.iter().map(|uv| place(*uv)).collect(),
        normals: uvs.iter().map(|uv| place(*uv)).collect(),
        uvs,
        triangles: cells
            .flat_map(|a| [[a, a + 1, a + 1 + columns], [a, a + 1 + columns, a + columns]])
            .collect(),
        ..Mesh::default()
    }
}

#[test]
fn a_normal_map_tilts_along_the_axes_of_uv() {
    // (0.6, 0.3, 1) up to its length
    let n = DVec3::new(0.6, 0.3, 1.0).normalize();
    let texel = [n.x, n.y, n.z, 1.0].map(|c| (0.5 * c + 0.5) as f32);
    for (tangents, green_down, strength, turned) in [
        (Tangents::Uv, false, 1.0, false),
        (Tangents::MikkTSpace, false, 1.0, false),
        (Tangents::MikkTSpace, true, 1.0, false),
        (Tangents::MikkTSpace, false, 0.5, false),
        (Tangents::Uv, false, 1.0, true),
        (Tangents::MikkTSpace, false, 1.0, true),
    ] {
        for copies in [1, 2] {
            let mut s = facing();
            let texels = Texels::RgbaF32(vec![texel]);
            let texture = s.picture(Image { width: 1, height: 1, texels }, |_| {});
            let m = s.diffuse(0.5);
            s.materials[m].detail.normal_map = Some(NormalMap { texture, green_down, strength, tangents });
            // Turned: u runs against x, so that uv is mirrored
            let u = |x: f32| if turned { 1.0 - x } else { x };
            let corners =
                [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0), Vec2::new(0.0, 1.0)];
            let mesh = Mesh {
                positions: corners
                    .iter()
                    .map(|c| Vec3::new(2.0 * c.x - 1.0, 2.0 * c.y - 1.0, -4.0))
                    .collect(),
                uvs: corners.iter().map(|c| Vec2::new(u(c.x), c.y)).collect(),
                triangles: vec![[0, 1, 2], [0, 2, 3]],
                ..Mesh::default()
            };
            let mesh = s.meshes.add("square", mesh);
            for k in 0..copies {
                s.place(mesh, m, Affine3A::from_translation(Vec3::X * 50.0 * k as f32));
            }
            let (x, y) = (f64::from(strength) * 0.6, f64::from(strength) * 0.3);
            let expected = DVec3::new(if turned { -x } else { x }, if green_down { -y } else { y }, 1.0);
            let what = format!("{tangents:?} {green_down} {strength} {turned} {copies}");
            expect_normals(&render(&s), &what, 2e-5, |_| Some(expected));
        }
    }
}

#[test]
fn procedures_have_slopes_too() {
    // A gradient along x in object space, as a height: 1 over a length of 4
    for rule in RULES {
        let mut s = facing();
        let space = PatternSpace {
            filter_width: 0.0,
            coordinates: Coordinates::Object,
            pattern_from_space: Affine3A::from_translation(Vec3::splat(0.5))
                * Affine3A::from_scale(Vec3::splat(0.25)),
        };
        let gradient = Texture::Gradient { shape: Gradient::Linear, low: grey(0.0), high: grey(1.0), space };
        let texture = s.textures.add("gradient", gradient);
        let m = bumped(&mut s, texture, 2.0, rule);
        // Quads are unit squares in object space
        s.quad(Vec3::new(-1.0, -1.0, -4.0), Vec3::X * 2.0, Vec3::Y * 2.0, m);
        let expected = DVec3::new(-2.0 * 0.25 / 2.0, 0.0, 1.0);
        expect_normals(&render(&s), &format!("{rule:?}"), 2e-3, |_| Some(expected));
    }
}

#[test]
fn a_slope_on_a_disk_is_radial() {
    let mut s = facing();
    s.camera.projection = Projection::pinhole(2.0 * (0.2_f32).atan().to_degrees());
    let texture = ramp(&mut s, 64, true);
    let m = bumped(&mut s, texture, 0.5, Derivative::Kernel);
    s.disk(Vec3::new(0.0, 0.0, -4.0), Vec3::Z, 2.0, m);
    // v falls from 1 in the middle to 0 at the rim: a cone
    let expected = |i: usize| {
        let at = |k: usize| (2.0 * (k as f64 + 0.5) / 9.0 - 1.0) * 0.8;
        let radial = DVec3::new(at(i % 9), -at(i / 9), 0.0);
        (radial.length() > 0.2).then(|| radial.normalize() * (0.5 / 2.0) + DVec3::Z)
    };
    expect_normals(&render(&s), "disk", 3e-3, expected);
}

#[test]
fn a_blended_seam_has_no_crease_of_bumps() {
    // A height that jumps where u goes from 1 to 0, seen from +x; columns 3 and 4 are on both sides of the seam
    let crease = |seam_blend: f32| {
        let mut s = scene(8, 1, 1);
        s.render.sampler = Sampler::Center;
        s.camera = look(Vec3::new(6.0, 0.0, 0.0), Vec3::ZERO, 0.4);
        let picture = ramp(&mut s, 256, false);
        let Texture::Image(image) = &mut s.textures[picture] else { panic!("a picture") };
        image.wrap = [Wrap::Repeat; 2];
        let mapping = Mapping {
            kind: MappingKind::Uv,
            space: MappingSpace::Object,
            mapping_from_space: Affine3A::IDENTITY,
            pole_u: 0.0,
            seam_blend,
            sharpness: 1.0,
        };
        let value = Value::Texture(picture);
        let texture = s.textures.add("mapped", Texture::Mapped { value, mapping });
        let m = bumped(&mut s, texture, 0.3, Derivative::Kernel);
        s.materials[m].detail.keep_visible = false;
        s.sphere(Vec3::ZERO, 1.0, m);
        let normals = render(&s).normal;
        let [left, right] = [3, 4].map(|i| DVec3::from_array(normals[i].map(f64::from)));
        assert!(left.length() > 0.99 && right.length() > 0.99);
        // Neither a crease between both nor a wall: the height grows by 0.3 in a turn
        left.distance(right).max((left - DVec3::X).length())
    };
    assert!(crease(0.1) < 0.1, "{}", crease(0.1));
    assert!(crease(0.0) > 0.5, "{}", crease(0.0));
}
