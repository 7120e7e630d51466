//! Meshes, pictures and lenses are read back from the files beside a scene as they were.

use crate::same_again;
use dapple::scene::*;
use glam::{Affine3A, Vec2, Vec3, Vec4};
use proptest::prelude::*;

fn vector() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1e6_f32..1e6).prop_map(Vec3::from)
}

fn direction() -> impl Strategy<Value = Vec3> {
    vector().prop_filter_map("no direction", |v| v.as_dvec3().try_normalize().map(|v| v.as_vec3()))
}

prop_compose! {
    /// Meshes with and without each of the things that vertices have, in one or two parts.
    fn meshes()(vertices in prop::collection::vec((vector(), direction(), direction(), any::<[i16; 8]>()), 3..20))
        (there in any::<[bool; 6]>(), triangles in prop::collection::vec(prop::array::uniform3(0..vertices.len() as u32), 2..40),
            vertices in Just(vertices)) -> Mesh {
        fn kept<T>(there: bool, all: impl Iterator<Item = T>) -> Vec<T> {
            all.filter(|_| there).collect()
        }
        let number = |i: i16| f32::from(i) / 777.0;
        let all = || vertices.iter();
        let (cut, end) = (if there[5] { 1 } else { 0 }, triangles.len() as u32);
        let part = |triangles| MeshPart { name: String::new(), triangles, material: None };
        Mesh {
            positions: all().map(|v| v.0).collect(),
            normals: kept(there[0], all().map(|v| v.1)),
            uvs: kept(there[1], all().map(|v| Vec2::new(number(v.3[0]), number(v.3[1])))),
            uvs1: kept(there[2], all().map(|v| Vec2::new(number(v.3[2]), number(v.3[3])))),
            tangents: kept(there[3], all().map(|v| v.2.extend(if v.3[4] < 0 { -1.0 } else { 1.0 }))),
            colors: kept(there[4], all().map(|v| Vec4::from([4, 5, 6, 7].map(|i| number(v.3[i]).abs())))),
            parts: [0..cut, cut..end].into_iter().filter(|range| !range.is_empty()).map(part).collect(),
            triangles,
            ..Mesh::default()
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn meshes_are_read_back(mesh in meshes()) {
        let mut scene = Scene::default();
        let material = Material::new(Surface::diffuse(dapple::scene::Value::Constant(Vec3::ONE)), None);
        let material = scene.materials.add("white", material);
        let mesh = scene.meshes.add("mesh", mesh);
        let world_from_object = Affine3A::IDENTITY;
        scene.instances.push(Instance { name: String::new(), mesh, material, world_from_object, at_close: None });
        same_again(&scene, "a mesh");
    }
}

fn with_picture(image: Image) -> Scene {
    let mut scene = Scene::default();
    let image = scene.images.add("picture", image);
    let texture = ImageTexture {
        image,
        filter: TexelFilter::Bilinear,
        wrap: [Wrap::Repeat; 2],
        uv: UvTransform::default(),
        color_space: ColorSpace::Linear,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    };
    scene.textures.add("picture", Texture::Image(texture));
    scene
}

#[test]
fn pictures_are_read_back() {
    let all = |texels| with_picture(Image { width: 3, height: 2, texels });
    let bytes = (0..6_u8).map(|i| [i, 255 - i, 7 * i, 40 * i]).collect();
    let words = (0..6_u16).map(|i| [i, 65535 - i, 7777 * i, 9999 * i]).collect();
    let floats = (0..6_u8).map(f32::from).map(|i| [i / 3.0, -0.1, 1e-20, 1e9 / (i + 1.0)]).collect();
    for texels in [Texels::Rgba8(bytes), Texels::Rgba16(words), Texels::RgbaF32(floats)] {
        same_again(&all(texels), "a picture");
    }
    let folder = tempfile::tempdir().unwrap();
    let error = dapple::export::write_scene(
        &crate::all_used(&with_picture(Image::EMPTY)),
        &folder.path().join("a.toml"),
        false,
        &mut |_| Ok(()),
    )
    .unwrap_err();
    assert!(error.message.contains("the picture cannot be encoded"), "{error}");
}

#[test]
fn lenses_are_read_back() {
    let row =
        |radius, thickness, index, abbe| LensInterface { radius, thickness, index, abbe, aperture: 9.1 };
    let system = LensSystem {
        notes: vec!["A triplet".into(), "of three rows".into()],
        interfaces: vec![
            row(50.1, 1.0 / 3.0, 1.5168, Some(64.17)),
            row(0.0, 2.5, 1.7, None),
            row(-1e3, 0.0, 1.0, None),
        ],
    };
    let mut scene = Scene::default();
    scene.camera.projection = Projection::Lens(Box::new(LensCamera {
        stop_diameter: Paraxial::of(&system).unwrap().stop_diameter * 0.7,
        system,
        focus_distance: 5.0,
        opening: Opening { blades: 6, ..Opening::default() },
        sensor_diagonal: 0.04,
        unit: 1000.0,
        dispersion: true,
        measure: Measure::Irradiance,
    }));
    same_again(&scene, "a lens");
}
