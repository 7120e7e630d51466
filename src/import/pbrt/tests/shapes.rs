//! Quadrics, patches, subdivided meshes and their fronts.

use super::{read, world};
use crate::scene::*;
use glam::{Vec2, Vec3};

#[test]
fn parts_of_quadrics_are_quadrics() {
    let scene = world(
        "Shape \"sphere\" \"float zmin\" -0.5 \"float zmax\" 7 \"float phimax\" 200 Shape \"sphere\" \"float phimax\" 400 \
         Shape \"cylinder\" \"float radius\" 2 Shape \"disk\" \"float height\" 3 \"float innerradius\" 0.25",
    );
    let about_z = |extent, z, radius, phi_max| {
        let center = Vec3::new(0.0, 0.0, z);
        ShapeKind::Quadric(Quadric { extent, center, radius, axis: Vec3::Z, meridian: Vec3::X, phi_max })
    };
    let [sphere, whole, cylinder, disk] = scene.shapes.as_slice() else { panic!("{:?}", scene.shapes) };
    assert_eq!(sphere.kind, about_z(Extent::Sphere { z_min: -0.5, z_max: 1.0 }, 0.0, 1.0, 200.0));
    assert!(matches!(whole.kind, ShapeKind::Sphere { .. }));
    assert_eq!(cylinder.kind, about_z(Extent::Cylinder { z_min: -1.0, z_max: 1.0 }, 0.0, 2.0, 360.0));
    assert_eq!(disk.kind, about_z(Extent::Disk { inner_radius: 0.25 }, 3.0, 1.0, 360.0));
}

#[test]
fn a_quadric_is_inside_out_after_one_of_reversing_and_mirroring() {
    let inside = |before: &str| {
        let (scene, warnings) = read(&format!("WorldBegin {before} Shape \"sphere\"")).unwrap();
        assert_eq!(warnings.len(), scene.instances.len(), "{warnings:?}");
        let Some((_, _, mesh)) = scene.meshes.iter().next() else { return false };
        let [a, b, c] = mesh.triangles[1].map(|i| mesh.positions[i as usize]);
        assert!((b - a).cross(c - a).dot(a) < 0.0 && mesh.normals[0].dot(mesh.positions[0]) < 0.0);
        true
    };
    assert_eq!(
        ["", "ReverseOrientation", "Scale -1 1 1", "ReverseOrientation Scale 1 -1 1"].map(inside),
        [false, true, true, false]
    );
}

fn patches(text: &str) -> Vec<Patch> {
    let kind = |shape: &Shape| match shape.kind {
        ShapeKind::Patch(patch) => patch,
        _ => panic!("{shape:?}"),
    };
    world(text).shapes.iter().map(kind).collect()
}

#[test]
fn patches_are_shapes_unless_two_triangles_are_the_same() {
    const TWISTED: &str = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1]";
    let twisted = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE];
    assert_eq!(patches(TWISTED), [Patch::new(twisted)]);
    let turned = Patch {
        corners: [Vec3::ZERO, Vec3::Y, Vec3::X, Vec3::ONE],
        uvs: [Vec2::ZERO, Vec2::Y, Vec2::X, Vec2::ONE],
        normals: None,
    };
    assert_eq!(patches(&format!("ReverseOrientation {TWISTED}")), [turned]);
    let back = patches(&format!("{TWISTED} \"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]"));
    assert_eq!(back, [Patch { normals: Some([Vec3::NEG_Z; 4]), ..turned }]);
    const FLAT: &str = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]";
    let flat = world(FLAT);
    assert_eq!((flat.shapes.len(), flat.instances.len()), (0, 1));
    // A lamp is one light, not two
    assert_eq!(patches(&format!("AreaLightSource \"diffuse\" {FLAT}")).len(), 1);
    let error =
        read("WorldBegin\n Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]").unwrap_err();
    assert_eq!(
        error.to_string(),
        "scene.pbrt:2:2: the bilinearmesh has no patches with an area; move their corners apart"
    );
}

#[test]
fn the_power_of_a_patch_is_over_its_area_in_the_world() {
    let scene = world(
        "AreaLightSource \"diffuse\" \"float power\" 6 Scale 3 2 1 \
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]",
    );
    let emission = scene.materials[scene.shapes[0].material].emission.as_ref().unwrap();
    let Value::Constant(radiance) = emission.radiance else { panic!() };
    assert!((radiance.x - std::f32::consts::FRAC_1_PI).abs() < 1e-5, "{radiance}");
}

#[test]
fn very_many_patches_are_cut_into_triangles() {
    let text = format!(
        "WorldBegin Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] \"integer indices\" [{}]",
        "0 1 2 3 ".repeat(65_537)
    );
    let (scene, warnings) = read(&text).unwrap();
    assert_eq!((scene.shapes.len(), scene.instances.len(), warnings.len()), (0, 1, 1));
    assert!(scene.meshes.iter().next().unwrap().2.triangles.len() <= 1 << 21);
}

#[test]
fn meshes_are_subdivided_and_their_normals_are_those_of_pbrt() {
    const TETRAHEDRON: &str =
        "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \"integer indices\" [0 2 1 0 1 3 1 2 3 2 0 3]";
    let mesh = |before: &str| {
        let scene = world(&format!("{before} Shape \"loopsubdiv\" \"integer levels\" 2 {TETRAHEDRON}"));
        scene.meshes.iter().next().unwrap().2.clone()
    };
    let middle = Vec3::splat(0.25);
    for (before, outside) in [("", false), ("ReverseOrientation", true)] {
        let mesh = mesh(before);
        assert_eq!(mesh.triangles.len(), 4 * 16);
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            assert_eq!((b - a).cross(c - a).dot(a - middle) > 0.0, outside);
            assert_eq!(mesh.normals[triangle[0] as usize].dot(a - middle) > 0.0, outside);
        }
    }
    let error =
        read(&format!("WorldBegin\n Shape \"loopsubdiv\" \"integer levels\" 15 {TETRAHEDRON}")).unwrap_err();
    assert!(error.to_string().starts_with("scene.pbrt:2:2: 15 levels make "), "{error}");
}

#[test]
fn tangents_of_vertices_are_those_of_normal_maps() {
    let scene = world(
        "Material \"diffuse\" \"string normalmap\" \"n.png\" Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \
         \"vector3 S\" [0 2 0 0 1 0 0 0 0] Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]",
    );
    let map = |i: usize| scene.materials[scene.instances[i].material].detail.normal_map.unwrap().tangents;
    assert_eq!([map(0), map(1)], [Tangents::MikkTSpace, Tangents::Uv]);
    let mesh = &scene.meshes[scene.instances[0].mesh];
    assert_eq!(mesh.tangents, [Vec3::Y, Vec3::Y, Vec3::X].map(|s| s.extend(1.0)));
    assert_eq!(mesh.uvs, [Vec2::ZERO, Vec2::X, Vec2::ONE]);
}
