//! Parts of quadrics, tubes, patches and subdivided meshes.

use super::*;

#[test]
fn quadrics_and_patches_take_every_key() {
    let scene = all();
    let kinds: Vec<_> = scene.shapes[5..9].iter().map(|shape| shape.kind).collect();
    let ShapeKind::Quadric(sphere) = kinds[0] else { panic!("sphere") };
    assert_eq!(sphere.extent, Extent::Sphere { z_min: -1.0, z_max: 1.5 });
    assert_eq!((sphere.radius, sphere.phi_max, sphere.axis, sphere.meridian), (2.0, 270.0, Vec3::Z, Vec3::X));
    let ShapeKind::Quadric(disk) = kinds[1] else { panic!("disk") };
    assert_eq!((disk.extent, disk.phi_max), (Extent::Disk { inner_radius: 0.5 }, 90.0));
    let ShapeKind::Quadric(tube) = kinds[2] else { panic!("cylinder") };
    assert_eq!((tube.extent, tube.radius), (Extent::Cylinder { z_min: -1.0, z_max: 3.0 }, 0.5));
    // From the tube between z = 0 and 1: its lower and upper end, and where its angle begins
    let map = tube.frame();
    assert_eq!(map.transform_point3(Vec3::ZERO), Vec3::new(1.0, 2.0, 2.0));
    assert_eq!(map.transform_point3(Vec3::Z), Vec3::new(1.0, 2.0, 6.0));
    assert_eq!(map.transform_point3(Vec3::X), Vec3::new(1.0, 2.5, 2.0));
    let ShapeKind::Patch(patch) = kinds[3] else { panic!("patch") };
    assert_eq!(patch.corners, [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE]);
    assert_eq!((patch.normals, patch.uvs), (Some([Vec3::Z; 4]), Patch::UVS.map(|uv| 2.0 * uv)));
    let lamps: Vec<_> = scene.shapes[12..].iter().map(|shape| shape.kind).collect();
    assert!(matches!(lamps[..], [ShapeKind::Quadric(_), ShapeKind::Patch(Patch { normals: None, .. })]));
}

#[test]
fn what_is_whole_is_no_part() {
    let shape = |text: &str| {
        let text = format!("[material.m]\nkind = 'diffuse'\n[[shape]]\nmaterial = 'm'\n{text}");
        read(&text).unwrap().0.shapes[0].kind
    };
    let sphere = shape("kind = 'sphere'\nradius = 2\nz_min = -2\nz_max = 2\nphi_max = 360");
    assert!(matches!(sphere, ShapeKind::Sphere { .. }));
    assert!(matches!(shape("kind = 'disk'\nradius = 2\ninner_radius = 0"), ShapeKind::Disk { .. }));
    let half = shape("kind = 'sphere'\nradius = 2\nz_min = 0");
    let ShapeKind::Quadric(Quadric { extent, .. }) = half else { panic!() };
    assert_eq!(extent, Extent::Sphere { z_min: 0.0, z_max: 2.0 });
}

#[test]
fn subdivision_cuts_and_smooths() {
    let scene = all();
    let smooth = scene.meshes.iter().find(|(_, name, _)| *name == "smooth").unwrap().2;
    assert_eq!((smooth.triangles.len(), smooth.positions.len()), (64, 34));
    assert_eq!(smooth.normals.len(), 34);
    assert_eq!(smooth.parts[0].triangles, 0..64);
    let text = "[material.m]\nkind = 'diffuse'\n[mesh.a]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2]]\n\
        subdivision = 'loop'\n[[instance]]\nmesh = 'a'\nmaterial = 'm'";
    let (scene, _) = read(text).unwrap();
    assert_eq!(scene.meshes.iter().next().unwrap().2.triangles.len(), 64, "three levels");
}

#[test]
fn parts_are_all_of_a_mesh_that_has_none_of_its_own() {
    let refused =
        |file: &str, keys: &str| read(&format!("[mesh.m]\nfile = '{file}'\n{keys}")).unwrap_err().to_string();
    let cases = [
        (
            "plain.ply",
            "parts = [{ triangles = 1 }]",
            "scene.toml:3:9: the parts have 1 triangles, the mesh has 2",
        ),
        (
            "plain.ply",
            "parts = [{ triangles = 1 }, { triangles = 2 }]",
            "scene.toml:3:43: the parts have more than the 2 triangles of the mesh",
        ),
        (
            "plain.ply",
            "parts = [{ triangles = 0 }]",
            "scene.toml:3:24: `triangles` is 0, must be from 1 to 4294967295",
        ),
        ("plain.ply", "parts = [{ name = 'a' }]", "scene.toml:3:10: `triangles` is missing in `parts[0]`"),
        (
            "car.obj",
            "parts = [{ triangles = 2 }]",
            "`parts` has no meaning for a mesh that has parts by itself",
        ),
        (
            "plain.ply",
            "parts = []\nmaterials = {}",
            "scene.toml:3:9: `parts` has no meaning beside `materials`",
        ),
    ];
    for (file, keys, message) in cases {
        let found = refused(file, keys);
        assert!(found.contains(message), "{keys}\n{found}");
    }
}
