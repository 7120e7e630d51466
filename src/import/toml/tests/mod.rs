//! The reader as a whole, on files in memory. Here: defaults, and a scene that has every key.

mod corners;
mod damage;
mod files;
mod film;
mod lights;
mod manual;
mod materials;
mod memory;
mod models;
mod patterns;
mod shapes;

use super::{Warning, read_scene_with};
use crate::Result;
use crate::import::ModelChoice;
use crate::scene::*;
use glam::{Affine3A, Vec2, Vec3};
use memory::Memory;
use std::collections::BTreeMap;
use std::path::Path;

fn read(text: &str) -> Result<(Scene, Vec<Warning>)> {
    read_set(text, &[])
}

fn read_set(text: &str, set: &[(&str, &str)]) -> Result<(Scene, Vec<Warning>)> {
    let set: Vec<_> = set.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    read_scene_with(
        Path::new("scene.toml"),
        &set,
        &ModelChoice::default(),
        &mut Memory::new(&[("scene.toml", text)]),
    )
}

/// Uses every key of every table.
const ALL: &str = include_str!("all_keys.toml");

fn all() -> Scene {
    let (scene, warnings) = read(ALL).unwrap_or_else(|error| panic!("{error}"));
    assert!(warnings.is_empty(), "{}", warnings[0]);
    scene
}

#[test]
fn nothing_gives_the_defaults() {
    for text in ["", "[film]\n[render]\n[camera]\n"] {
        let (scene, warnings) = read(text).unwrap();
        assert_eq!(scene.film, Film::default());
        assert_eq!(scene.render, Render::default());
        assert_eq!(scene.camera, Camera::default());
        assert!(scene.shapes.is_empty() && scene.environment.is_none() && warnings.is_empty());
    }
}

#[test]
fn film_and_render_take_every_key() {
    let scene = all();
    let shot = Shot { shutter: 0.01, iso: 400.0, f_number: Some(2.8) };
    let film = Film {
        width: 320,
        height: 200,
        crop: Some(Rect { x0: 10, y0: 20, x1: 300, y1: 200 }),
        filter: Filter { kind: FilterKind::Mitchell { b: 0.5, c: 0.25 }, radius: 2.0 },
        exposure: Exposure { meter: Meter::Shot(shot), stops: -1.5 },
        tone_curve: ToneCurve::Agx,
        png_bits: 16,
        transparent: true,
    };
    assert_eq!(scene.film, film);
    let render = Render {
        spp: 100,
        seed: 7,
        sampler: Sampler::Stratified,
        strata: [10, 10],
        max_depth: 5,
        diffuse_bounces: Some(0),
        russian_roulette: false,
        firefly_clamp: Some(20.0),
        geometric_veto: true,
    };
    assert_eq!(scene.render, render);
}

#[test]
fn camera_takes_every_key() {
    let camera = all().camera;
    assert_eq!((camera.position, camera.target), (Vec3::new(0.0, 1.0, 4.0), Vec3::Y));
    assert!(camera.mirrored);
    let (position, target) = (Vec3::new(0.0, 1.0, 3.0), Vec3::new(1.0, 1.0, 0.0));
    assert_eq!(camera.at_close, Some(Stand { position, target, up: Vec3::NEG_Z }));
    let Projection::Perspective(view) = camera.projection else { panic!() };
    assert_eq!((view.fov, view.fov_axis), (50.0, FovAxis::Smaller));
    let aperture = Aperture::FNumber { number: 2.8, sensor_height: 0.036 };
    let opening = Opening { blades: 6, blade_rotation: 15.0, anamorphic: 1.5, image: None };
    let focus = Focus::Plane { point: Vec3::new(0.0, 1.0, 1.0), normal: Vec3::Z };
    assert_eq!(view.lens, Some(Lens { aperture, focus, opening, cat_eye: 0.5 }));
    let lens = |text: &str| read(&format!("[camera]\n{text}")).unwrap().0.camera.thin_lens();
    let near = lens("lens_radius = 0.1\nfocus_point = [9, 9, 2]").unwrap();
    assert_eq!(near, Lens::new(Aperture::Radius(0.1), 3.0));
    assert_eq!(lens("lens_radius = 0\nfocus_distance = 1"), None);
    let shaped = lens("lens_radius = 1\nfocus_distance = 1\naperture_image = 'heart.png'").unwrap();
    assert!(shaped.opening.image.is_some());
}

#[test]
fn cameras_of_every_kind() {
    let camera = |text: &str| read(&format!("[camera]\n{text}")).unwrap().0.camera.projection;
    let axis = FovAxis::Vertical;
    assert_eq!(camera("kind = 'perspective'"), Camera::default().projection);
    assert_eq!(camera("kind = 'orthographic'\nview_size = 3"), Projection::Orthographic { size: 3.0, axis });
    assert_eq!(camera("kind = 'equirectangular'"), Projection::Equirectangular);
    let mapping = FisheyeMapping::Equisolid;
    let fisheye = Projection::Fisheye { mapping, fov: 180.0, axis: FovAxis::Smaller };
    assert_eq!(camera("kind = 'fisheye'\nmapping = 'equisolid'\nfov_axis = 'smaller'"), fisheye);
    let Projection::Lens(lens) =
        camera("kind = 'lens'\nfile = 'a.dat'\nfocus_point = [0, 0, 3]\nf_number = 8")
    else {
        panic!()
    };
    assert_eq!((lens.focus_distance, lens.unit, lens.sensor_diagonal), (2.0, 1000.0, 0.035));
    assert_eq!((lens.dispersion, lens.measure), (true, Measure::Radiance));
    let f_number = lens.paraxial().unwrap().f_number();
    assert!((f_number - 8.0).abs() < 1e-6, "{f_number}");
    let Projection::Lens(lens) = camera(
        "kind = 'lens'\nfile = 'a.dat'\nspacing = 'next'\nfocus_distance = 300\nunit = 1\nsensor_diagonal = 43\n\
         aperture = 5\ndispersion = false\nmeasure = 'irradiance'\nblades = 5",
    ) else {
        panic!()
    };
    assert_eq!((lens.stop_diameter, lens.sensor_diagonal, lens.opening.blades), (5.0, 43.0, 5));
    assert_eq!((lens.dispersion, lens.measure), (false, Measure::Irradiance));
}

#[test]
fn textures_take_every_key() {
    let scene = all();
    let textures: BTreeMap<_, _> = scene.textures.iter().map(|(_, name, texture)| (name, texture)).collect();
    let Texture::Image(wood) = textures["wood"] else { panic!() };
    assert_eq!(wood.filter, TexelFilter::Nearest);
    assert_eq!(wood.wrap, [Wrap::Mirror, Wrap::Black]);
    assert_eq!(
        wood.uv,
        UvTransform { scale: Vec2::new(2.0, 3.0), rotate: 30.0, offset: Vec2::new(0.5, 0.0) }
    );
    assert_eq!((wood.color_space, wood.channel), (ColorSpace::Linear, Channel::G));
    assert_eq!((wood.scale, wood.invert), (0.5, true));
    let Texture::Mapped { value, mapping } = textures["label"] else { panic!() };
    assert!(scene.textures[value.texture().unwrap()] == *textures["picture of label"]);
    assert_eq!((mapping.kind, mapping.space), (MappingKind::Spherical, MappingSpace::World));
    assert_eq!((mapping.pole_u, mapping.seam_blend, mapping.sharpness), (0.5, 0.125, 4.0));
    // The pole stays along z, at half the size; the meridian is made orthogonal to it
    let place = mapping.mapping_from_space.transform_point3(Vec3::new(2.0, 0.0, 6.0));
    assert!((place - Vec3::new(1.0, 0.0, 3.0)).length() < 1e-6, "{place}");
    let Texture::Mapped { mapping, .. } = textures["crate"] else { panic!() };
    assert_eq!((mapping.kind, mapping.sharpness), (MappingKind::Triplanar, 8.0));
    let Texture::Image(plain) = textures["plain"] else { panic!() };
    assert_eq!(
        (plain.color_space, plain.wrap, plain.filter),
        (ColorSpace::Srgb, [Wrap::Repeat; 2], TexelFilter::Bilinear)
    );
    let Texture::Image(sky) = textures["sky"] else { panic!() };
    assert_eq!(sky.color_space, ColorSpace::Linear);
    let Texture::Glsl(own) = textures["own"] else { panic!() };
    let parameters = [("factor", Parameter::Number(2.0)), ("tint", Parameter::Color(Vec3::ONE))];
    assert_eq!(own.parameters, parameters.map(|(name, value)| (name.to_owned(), value)));
    assert_eq!((own.max, own.file.as_path()), (5.0, Path::new("scene.toml")));
    let line = ALL.lines().position(|line| line.starts_with("vec4 color")).unwrap();
    assert_eq!(own.line as usize, line + 1);
    let Texture::Stack(scan) = textures["scan"] else { panic!() };
    assert_eq!(scan.wrap, [Wrap::Mirror, Wrap::Repeat, Wrap::Clamp], "z, x, y in turn");
    assert_eq!((scan.smooth, scan.color_space, scan.channel), (false, ColorSpace::Srgb, Channel::R));
    assert_eq!((scan.scale, scan.invert, scan.space.coordinates), (2.0, true, Coordinates::World));
    let place = scan.space.pattern_from_space.transform_point3(Vec3::new(2.0, 4.0, 6.0));
    assert_eq!(place, Vec3::new(3.0, 1.0, 2.0));
    let files: Vec<_> = scene.images.iter().map(|(_, name, _)| name).collect();
    assert_eq!(files, ["wood.png", "sky.exr", "scan07.exr", "scan08.exr"], "each file once");
    let Texture::Image(glow) = textures["emission of screen"] else { panic!() };
    assert_eq!((glow.image, glow.scale), (plain.image, 4.0));
}

#[test]
fn texture_trees_take_every_key() {
    let scene = all();
    let find = |name: &str| scene.textures.iter().find(|(_, other, _)| *other == name).unwrap();
    let of = |name: &str| Value::Texture(find(name).0);
    let grey = |value| Value::Constant(Vec3::splat(value));
    let object = PatternSpace::new(Coordinates::Object);
    let halved = PatternSpace {
        coordinates: Coordinates::World,
        pattern_from_space: Affine3A::from_scale(Vec3::splat(0.5)),
        filter_width: 0.5,
    };
    let veins = Noise {
        perlin: Perlin { variant: PerlinVariant::Classic, dimensions: 4 },
        normalize: false,
        w: [0.5, 2.0],
        sum: NoiseSum::Turbulence,
        octaves: 3,
        gain: 0.75,
        lacunarity: 3.0,
        low: grey(0.25),
        high: Value::Constant(Vec3::new(1.0, 0.5, 0.25)),
        space: halved,
    };
    assert_eq!(*find("veins").2, Texture::Noise(veins));
    let uv = PatternSpace { coordinates: Coordinates::Uv, ..object };
    let squares = Texture::Checker { dimensions: 2, even: of("mixed"), odd: grey(0.125), space: uv };
    assert_eq!(*find("squares").2, squares);
    let Value::Texture(other) = of("other") else { panic!() };
    let mixed = Texture::Mix { a: grey(0.5), b: of("veins"), amount: Value::Texture(other) };
    assert_eq!(*find("mixed").2, mixed);
    assert_eq!(*find("other").2, Texture::Invert { value: of("sum") });
    assert_eq!(*find("sum").2, Texture::Add { a: of("product"), b: grey(0.25) });
    assert_eq!(*find("product").2, Texture::Multiply { a: of("grain"), b: of("fire") });
    let grain = Noise {
        perlin: Perlin::default(),
        normalize: true,
        w: [0.0; 2],
        sum: NoiseSum::Fbm,
        octaves: 1,
        gain: 0.5,
        lacunarity: 2.0,
        low: of("bent"),
        high: grey(1.0),
        space: object,
    };
    assert_eq!(*find("grain").2, Texture::Noise(grain));
    let (a, b) = (Value::Constant(Vec3::ONE), Value::Texture(find("slate").0));
    assert_eq!(*find("paper").2, Texture::DirectionMix { a, b, direction: Vec3::Z });
    let Value::Texture(ball) = of("ball") else { panic!() };
    let stops = vec![(0.0, Vec3::ZERO), (0.5, Vec3::ONE), (1.0, Vec3::new(1.0, 0.5, 0.0))];
    assert_eq!(*find("fire").2, Texture::Ramp { value: Value::Texture(ball), stops, smooth: true });
    let (low, high) = (of("cells"), grey(1.0));
    let cells = Texture::Worley {
        feature: WorleyFeature::Difference,
        metric: Metric::Chebyshev,
        low: grey(0.0),
        high,
        space: object,
    };
    assert_eq!(*find("cells").2, cells);
    assert_eq!(*find("ball").2, Texture::Gradient { shape: Gradient::Spherical, low, high, space: object });
    let lamp = "[texture.f]\nkind = 'noise'\n[material.m]\nkind = 'diffuse'\nemission = { texture = 'f' }\nemission_scale = 2";
    let (lamp, _) = read(lamp).unwrap();
    let Some((f, ..)) = lamp.textures.iter().next() else { panic!() };
    let scaled = lamp.textures.iter().find(|(_, name, _)| *name == "emission of m").unwrap().2;
    assert_eq!(*scaled, Texture::Multiply { a: Value::Texture(f), b: grey(2.0) });
    let (fbm, _) = read("[texture.f]\nkind = 'fbm'").unwrap();
    let Some((_, _, Texture::Noise(fbm))) = fbm.textures.iter().next() else { panic!() };
    assert_eq!((fbm.octaves, fbm.gain, fbm.lacunarity), (6, 0.5, 2.0));
}

#[test]
fn shapes_take_every_key() {
    let scene = all();
    let kinds: Vec<_> = scene.shapes.iter().map(|shape| shape.kind).collect();
    let ShapeKind::Sphere { center, radius, pole, meridian } = kinds[0] else { panic!("sphere") };
    assert_eq!((center, radius, pole), (Vec3::X, 0.5, Vec3::Z));
    assert!(meridian.abs_diff_eq(Vec3::Y, 1e-6), "made orthogonal: {meridian}");
    let ShapeKind::Disk { normal, meridian, .. } = kinds[1] else { panic!("disk") };
    assert_eq!((normal, meridian), (Vec3::X, Vec3::Y));
    let edges = (Vec3::X * 2.0, Vec3::Z);
    let ShapeKind::Quad { origin, edge_u, edge_v } = kinds[2] else { panic!("quad") };
    assert_eq!((origin, edge_u, edge_v), (Vec3::ONE, edges.0, edges.1));
    let ShapeKind::Quad { origin, .. } = kinds[3] else { panic!("quad") };
    assert_eq!(origin, Vec3::new(-1.0, 0.0, -0.5));
}

#[test]
fn the_first_step_of_a_transform_is_applied_first() {
    let scene = all();
    let map = scene.shapes[0].world_from_object;
    // Scale by 2, quarter turn about +y, move, mirror in x.
    let expected = |p: Vec3| Vec3::new(-(2.0 * p.z + 1.0), 2.0 * p.y + 2.0, -2.0 * p.x + 3.0);
    for point in [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 2.0, 3.0)] {
        assert!(map.transform_point3(point).abs_diff_eq(expected(point), 1e-5));
    }
    assert!(map.matrix3.determinant() < 0.0);
    assert_eq!(scene.shapes[3].world_from_object, Affine3A::IDENTITY);
}

#[test]
fn meshes_and_instances_take_every_key() {
    let scene = all();
    let mesh = |name: &str| scene.meshes.iter().find(|found| found.1 == name).unwrap().2;
    let material =
        |name: &str| scene.materials.iter().find(|(_, other, _)| *other == name).map(|found| found.0);
    let inline = mesh("inline");
    assert_eq!(inline.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
    assert_eq!((inline.normals.len(), inline.uvs[2]), (4, Vec2::ONE));
    assert_eq!(inline.normals[0], Vec3::Z, "normalised");
    assert_eq!(inline.parts, [MeshPart { name: String::new(), triangles: 0..3, material: None }]);
    let car = mesh("car");
    assert!(car.normals.is_empty());
    assert_eq!(car.parts[0].material, material("glass"), "by `materials`");
    assert_eq!(car.parts[1].material, material("paint"), "by its own name");
    let part = |name: &str, at, material| MeshPart { name: name.into(), triangles: at..at + 1, material };
    assert_eq!(mesh("plain").parts, [part("lid", 0, material("glass")), part("", 1, None)]);
    let given: Vec<_> = scene.instances.iter().map(|instance| Some(instance.material)).collect();
    // The first is a displaced sphere; of the materials of parts any will do
    assert_eq!(
        given,
        ["gold", "chalk", "glass", "white of a model", "steel", "gold", "gold", "gold", "gold"].map(material)
    );
    assert!(
        scene.instances[3].name.ends_with("chair.glb Some(1.5) Some(\"red\")"),
        "{}",
        scene.instances[3].name
    );
    let texture = scene.textures.iter().find(|found| found.1 == "squares").unwrap().0;
    let moved = Displacement {
        texture,
        height: 0.5,
        offset: 0.25,
        direction: DisplacementDirection::Tangent,
        edge: EdgeLimit::Length(0.125),
        most_triangles: 1000,
    };
    let sphere = &scene.meshes[scene.instances[0].mesh];
    assert!(sphere.round && sphere.displacement == Some(moved));
    assert_eq!(mesh("moved").displacement.unwrap().edge, EdgeLimit::Pixels(3.0));
}
