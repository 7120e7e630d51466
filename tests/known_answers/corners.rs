//! Colours of vertices, and a second set of texture coordinates, in all that sees textures.

use super::floor::*;
use crate::common::render::*;
use dapple::film::Picture;
use dapple::scene::*;
use glam::{Affine3A, Vec2, Vec3, Vec4};

/// Colour and alpha at a place of a rectangle: affine, so that two triangles show it alike.
fn color(u: f32, v: f32) -> Vec4 {
    Vec4::new(0.125 + 0.5 * u, 0.75 - 0.5 * v, 0.25 + 0.25 * u + 0.25 * v, 0.25 + 0.5 * u + 0.125 * v)
}

fn colored(origin: Vec3, edge_u: Vec3, edge_v: Vec3) -> Mesh {
    let mut mesh = rectangle_mesh(origin, edge_u, edge_v);
    mesh.colors = mesh.uvs.iter().map(|uv| color(uv.x, uv.y)).collect();
    mesh
}

fn vertex_color(s: &mut Scene, channel: Channel) -> Value<Vec3> {
    Value::Texture(s.textures.add("vertex color", Texture::VertexColor(channel)))
}

/// How a mesh comes into a scene: once; in copies; and in copies of which that which is seen is mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Placing {
    Once,
    OnceMirrored,
    Copies,
    CopiesMirrored,
}
const PLACINGS: [Placing; 4] =
    [Placing::Once, Placing::OnceMirrored, Placing::Copies, Placing::CopiesMirrored];

/// Places a mesh; where the map mirrors, x of the mesh is turned before.
fn place(s: &mut Scene, mut mesh: Mesh, material: Handle<Material>, placing: Placing) {
    let mirrored = matches!(placing, Placing::OnceMirrored | Placing::CopiesMirrored);
    let map = if mirrored { Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)) } else { Affine3A::IDENTITY };
    if mirrored {
        mesh.positions.iter_mut().for_each(|p| p.x = -p.x);
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    let mesh = s.meshes.add("mesh", mesh);
    s.place(mesh, material, map);
    if matches!(placing, Placing::Copies | Placing::CopiesMirrored) {
        let black = s.black();
        s.place(mesh, black, Affine3A::from_translation(Vec3::Y * 500.0));
    }
}

#[test]
fn colours_of_vertices_are_linear_between_them() {
    let channels = [Channel::Rgb, Channel::R, Channel::G, Channel::B, Channel::A];
    for (placing, channel) in
        PLACINGS.into_iter().zip(channels.into_iter().cycle()).chain([(Placing::Once, Channel::A)])
    {
        let mut s = scene(16, 16, 1);
        s.render.sampler = Sampler::Center;
        let value = vertex_color(&mut s, channel);
        let m = s.unlit(value);
        place(&mut s, colored(Vec3::new(-1.0, -1.0, -1.0), Vec3::X * 2.0, Vec3::Y * 2.0), m, placing);
        for (i, rgb) in render(&s).rgb.iter().enumerate() {
            let c = color((i as f32 % 16.0 + 0.5) / 16.0, 1.0 - ((i / 16) as f32 + 0.5) / 16.0);
            let expected = match channel {
                Channel::Rgb => c.truncate(),
                Channel::R => Vec3::splat(c.x),
                Channel::G => Vec3::splat(c.y),
                Channel::B => Vec3::splat(c.z),
                Channel::A => Vec3::splat(c.w),
            };
            assert!(
                (Vec3::from_array(*rgb) - expected).length() < 1e-5,
                "{placing:?} {channel:?} {i}: {rgb:?}, not {expected}"
            );
        }
    }
}

#[test]
fn what_has_no_colours_is_white() {
    let mut s = scene(8, 8, 1);
    s.render.sampler = Sampler::Center;
    let value = vertex_color(&mut s, Channel::Rgb);
    let m = s.unlit(value);
    s.sphere(Vec3::new(-0.5, 0.5, -2.0), 0.6, m);
    s.quad(Vec3::new(-9.0, -9.0, -8.0), Vec3::X * 9.0, Vec3::Y * 18.0, m);
    let flat =
        Mesh { uvs: Vec::new(), ..rectangle_mesh(Vec3::new(0.0, -9.0, -8.0), Vec3::X * 9.0, Vec3::Y * 18.0) };
    let plain = s.meshes.add("plain", flat);
    s.place(plain, m, Affine3A::IDENTITY);
    // Elsewhere there are some
    place(&mut s, colored(Vec3::Y * 500.0, Vec3::X, Vec3::Y), m, Placing::Once);
    expect_every_pixel(&render(&s), [1.0; 3], 0.0);
}

#[test]
fn lamps_shine_by_the_colours_of_their_vertices() {
    let (origin, u, v) = (Vec3::new(-1.6, 1.0, -0.8), Vec3::X * 2.0, Vec3::Z * 2.4);
    let (surface, bsdf) = surfaces().into_iter().next().unwrap();
    let part = |c: usize| under_quad(origin, u, v, |a, b| f64::from(color(a as f32, b as f32)[c]), &bsdf);
    let expected = [part(0), part(1), part(2)];
    for placing in PLACINGS {
        let mut s = floor_scene(surface.clone(), 1024);
        s.camera.position = EYE.normalize() * 0.9;
        let value = vertex_color(&mut s, Channel::Rgb);
        let light = s.emitter(value, false);
        place(&mut s, colored(origin, u, v), light, placing);
        eprintln!("{placing:?}: {expected:?}");
        expect_mean(mean(&render(&s)), expected, 2e-3);
    }
}

#[test]
fn alpha_of_vertices_cuts_out() {
    for placing in PLACINGS {
        let mut s = scene(16, 16, 1);
        s.render.sampler = Sampler::Center;
        let Value::Texture(alpha) = vertex_color(&mut s, Channel::A) else { unreachable!() };
        let m = s.unlit(grey(1.0));
        let value = Value::Texture(alpha);
        s.materials[m].detail.opacity = Opacity { value, cutoff: Some(0.53), ..Opacity::default() };
        place(&mut s, colored(Vec3::new(-1.0, -1.0, -1.0), Vec3::X * 2.0, Vec3::Y * 2.0), m, placing);
        let picture = render(&s);
        for (i, rgb) in picture.rgb.iter().enumerate() {
            let alpha = color((i as f32 % 16.0 + 0.5) / 16.0, 1.0 - ((i / 16) as f32 + 0.5) / 16.0).w;
            assert_eq!(rgb[0] > 0.5, alpha > 0.53, "{placing:?} {i}: {alpha}");
        }
    }
}

/// Texture coordinates of another kind: turned and stretched.
fn other(uv: Vec2) -> Vec2 {
    Vec2::new(0.9 - 0.7 * uv.y, 0.1 + 0.6 * uv.x)
}

/// A picture that differs along u and along v.
fn uneven(s: &mut Scene, filter: TexelFilter) -> Handle<Texture> {
    let mut random = Random(5);
    let texels = (0..64).map(|_| [0.0; 4].map(|_: f32| random.between(0.1, 0.9))).collect();
    s.picture(Image { width: 8, height: 8, texels: Texels::RgbaF32(texels) }, |texture| {
        texture.filter = filter
    })
}

fn second(s: &mut Scene, texture: Handle<Texture>) -> Handle<Texture> {
    let mapping = Mapping {
        kind: MappingKind::Uv1,
        space: MappingSpace::Object,
        mapping_from_space: Affine3A::IDENTITY,
        pole_u: 0.0,
        seam_blend: 0.0,
        sharpness: 4.0,
    };
    s.textures.add("second", Texture::Mapped { value: Value::Texture(texture), mapping })
}

/// A picture with a texture on the second set of a mesh, and one where that is its only set.
fn both_sets(
    filter: TexelFilter,
    camera: impl Fn() -> Scene,
    mesh: impl Fn() -> Mesh,
    placing: Placing,
    material: impl Fn(&mut Scene, Handle<Texture>) -> Handle<Material>,
) -> [Picture; 2] {
    [true, false].map(|two| {
        let mut s = camera();
        let plain = uneven(&mut s, filter);
        let texture = if two { second(&mut s, plain) } else { plain };
        let m = material(&mut s, texture);
        let mut mesh = mesh();
        let uvs: Vec<_> = mesh.uvs.iter().map(|uv| other(*uv)).collect();
        *(if two { &mut mesh.uvs1 } else { &mut mesh.uvs }) = uvs;
        place(&mut s, mesh, m, placing);
        render(&s)
    })
}

fn facing() -> Scene {
    let mut s = scene(16, 16, 1);
    s.render.sampler = Sampler::Center;
    s
}

fn board() -> Mesh {
    rectangle_mesh(Vec3::new(-1.0, -1.0, -1.0), Vec3::X * 2.0, Vec3::Y * 2.0)
}

#[track_caller]
fn expect_alike([a, b]: [Picture; 2], what: &str) {
    let far = |a: [f32; 3], b: [f32; 3]| Vec3::from_array(a).distance(Vec3::from_array(b));
    let mut range = [f32::INFINITY, 0.0_f32];
    for i in 0..a.rgb.len() {
        assert!(far(a.rgb[i], b.rgb[i]) < 2e-5, "{what}, pixel {i}: {:?} and {:?}", a.rgb[i], b.rgb[i]);
        assert!(
            far(a.normal[i], b.normal[i]) < 1e-4,
            "{what}, pixel {i}: {:?} and {:?}",
            a.normal[i],
            b.normal[i]
        );
        let seen = a.rgb[i][0] + a.normal[i][0];
        range = [range[0].min(seen), range[1].max(seen)];
    }
    assert!(range[1] - range[0] > 0.05, "{what}: nothing to see: {range:?}");
}

#[test]
fn a_picture_on_the_second_set_is_as_on_the_first() {
    for placing in PLACINGS {
        for filter in [TexelFilter::Bilinear, TexelFilter::Trilinear] {
            let color = |s: &mut Scene, texture| s.unlit(Value::Texture(texture));
            expect_alike(
                both_sets(filter, facing, board, placing, color),
                &format!("{placing:?} {filter:?}"),
            );
        }
        let cut = |s: &mut Scene, texture| {
            let m = s.unlit(grey(1.0));
            let value = Value::Texture(texture);
            s.materials[m].detail.opacity = Opacity { value, cutoff: Some(0.5), ..Opacity::default() };
            m
        };
        expect_alike(
            both_sets(TexelFilter::Nearest, facing, board, placing, cut),
            &format!("{placing:?} cut"),
        );
        let floor = || {
            let mut s = floor_scene(white(), 16);
            s.camera.position = EYE.normalize() * 0.9;
            s
        };
        let lamp = || rectangle_mesh(Vec3::new(-1.6, 1.0, -0.8), Vec3::X * 2.0, Vec3::Z * 2.4);
        let shining = |s: &mut Scene, texture| s.emitter(Value::Texture(texture), false);
        // By light sampling alone, so that both have the same random numbers
        let [a, b] = both_sets(TexelFilter::Bilinear, floor, lamp, placing, shining);
        let difference = a.rgb.iter().zip(&b.rgb).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
        assert!(difference < 1e-3 && a.rgb[0][0] > 0.1, "{placing:?}: {difference}");
    }
}

#[test]
fn bumps_and_normal_maps_are_differentiated_in_their_own_set() {
    for placing in PLACINGS {
        for derivative in [Derivative::Kernel, Derivative::Forward, Derivative::Analytic] {
            let bumped = |s: &mut Scene, texture| {
                let m = s.diffuse(0.5);
                s.materials[m].detail.bump = Some(Bump { texture, height: 0.5, derivative, curvature: true });
                m
            };
            let what = format!("{placing:?} {derivative:?}");
            expect_alike(both_sets(TexelFilter::Bilinear, facing, board, placing, bumped), &what);
        }
        for tangents in [Tangents::MikkTSpace, Tangents::Uv] {
            let mapped = |s: &mut Scene, texture| {
                let m = s.diffuse(0.5);
                let map = NormalMap { texture, green_down: false, strength: 1.0, tangents };
                s.materials[m].detail.normal_map = Some(map);
                m
            };
            let smooth = || Mesh { normals: vec![Vec3::Z; 4], ..board() };
            let what = format!("{placing:?} {tangents:?}");
            expect_alike(both_sets(TexelFilter::Bilinear, facing, smooth, placing, mapped), &what);
        }
    }
}

#[test]
fn without_a_second_set_it_is_the_first() {
    let seen = |two: bool, uvs: bool| {
        let mut s = facing();
        let plain = uneven(&mut s, TexelFilter::Bilinear);
        let texture = if two { second(&mut s, plain) } else { plain };
        let m = s.unlit(Value::Texture(texture));
        let mut mesh = board();
        if !uvs {
            mesh.uvs = Vec::new();
        }
        place(&mut s, mesh, m, Placing::Once);
        s.sphere(Vec3::new(0.0, 0.0, -0.9), 0.3, m);
        // Elsewhere there is one
        place(&mut s, Mesh { uvs1: vec![Vec2::ONE; 4], ..board() }, m, Placing::Copies);
        s.instances
            .iter_mut()
            .skip(1)
            .for_each(|i| i.world_from_object = Affine3A::from_translation(Vec3::Y * 500.0));
        render(&s).rgb
    };
    for uvs in [false, true] {
        assert_eq!(seen(true, uvs), seen(false, uvs));
    }
}

#[test]
fn displacement_sees_colours_and_keeps_them() {
    let mut s = facing();
    let value = vertex_color(&mut s, Channel::Rgb);
    let Value::Texture(texture) = vertex_color(&mut s, Channel::R) else { unreachable!() };
    let m = s.unlit(value);
    // Farther away by its red: so that it is seen larger by as much, and its colours are where they were
    let mut mesh = colored(Vec3::new(-1.0, -1.0, -1.0), Vec3::X * 2.0, Vec3::Y * 2.0);
    mesh.colors = mesh.uvs.iter().map(|uv| Vec4::new(1.0, uv.x, uv.y, 1.0)).collect();
    mesh.displacement = Some(Displacement {
        texture,
        height: -1.0,
        offset: 0.0,
        direction: DisplacementDirection::Normal,
        edge: EdgeLimit::Length(0.5),
        most_triangles: 10_000,
    });
    place(&mut s, mesh, m, Placing::Once);
    let picture = render(&s);
    for (i, rgb) in picture.rgb.iter().enumerate() {
        let at = |k: usize| 2.0 * (2.0 * (k as f32 + 0.5) / 16.0 - 1.0);
        let (x, y) = (at(i % 16), -at(i / 16));
        if x.abs().max(y.abs()) > 0.99 {
            assert!(x.abs().max(y.abs()) < 1.01 || rgb[0] == 0.0, "{i}: {rgb:?}");
            continue;
        }
        let expected = Vec3::new(1.0, 0.5 + 0.5 * x, 0.5 + 0.5 * y);
        assert!((Vec3::from_array(*rgb) - expected).length() < 1e-5, "{i}: {rgb:?}, not {expected}");
    }
}
