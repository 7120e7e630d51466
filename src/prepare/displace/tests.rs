use super::*;
use crate::scene::{Material, Surface, Value};
use std::f64::consts::PI;

/// A scene with a mesh placed at the origin, 10 in front of the camera.
fn scene(mesh: Mesh, edge: EdgeLimit, direction: DisplacementDirection, height: f32) -> Scene {
    let mut scene = Scene::default();
    scene.camera.position = Vec3::Z * 10.0;
    let texture = scene.textures.add("heights", Texture::Constant(Vec3::ONE));
    let displacement =
        Displacement { texture, height, offset: 0.0, direction, edge, most_triangles: 300_000 };
    let mesh = Mesh { displacement: Some(displacement), ..mesh };
    let mesh = scene.meshes.add("hills", mesh);
    let surface = Surface::diffuse(Value::Constant(Vec3::ONE));
    let material = scene.materials.add("grey", Material::new(surface, None));
    let world_from_object = Affine3A::IDENTITY;
    scene.instances.push(Instance {
        name: "instance".into(),
        mesh,
        material,
        world_from_object,
        at_close: None,
    });
    scene
}

fn displaced(scene: &Scene, value: impl Fn(&TexturePoint) -> [f32; 3]) -> Mesh {
    let mut values =
        |_, points: &[TexturePoint]| Ok(points.iter().map(&value).map(|[r, g, b]| [r, g, b, 1.0]).collect());
    let mut scene = scene.clone();
    displace(&mut scene, &[], &mut Displaced::default(), &mut values).unwrap();
    scene.meshes.iter().next().unwrap().2.clone()
}

fn corners(mesh: &Mesh, triangle: &[u32; 3]) -> [glam::DVec3; 3] {
    triangle.map(|v| mesh.positions[v as usize].as_dvec3())
}

/// Volume inside of a closed mesh.
fn volume(mesh: &Mesh) -> f64 {
    let of = |t| {
        let [a, b, c] = corners(mesh, t);
        a.dot(b.cross(c)) / 6.0
    };
    mesh.triangles.iter().map(of).sum()
}

/// Every edge has a triangle on both of its sides, by the bits of its ends.
fn is_closed(mesh: &Mesh) -> bool {
    let mut edges: HashMap<_, i32> = HashMap::new();
    for triangle in &mesh.triangles {
        let p = triangle.map(|v| (mesh.positions[v as usize] + 0.0).to_array().map(f32::to_bits));
        for k in 0..3 {
            let (a, b) = (p[k], p[(k + 1) % 3]);
            *edges.entry(if a < b { (a, b) } else { (b, a) }).or_default() += if a < b { 1 } else { -1 };
        }
    }
    edges.values().all(|balance| *balance == 0)
}

/// How often a ray from a point crosses a mesh.
fn crossings(mesh: &Mesh, origin: glam::DVec3, direction: glam::DVec3) -> usize {
    let meets = |t: &&[u32; 3]| {
        let [a, b, c] = corners(mesh, t);
        let (ab, ac, s) = (b - a, c - a, origin - a);
        let p = direction.cross(ac);
        let q = s.cross(ab);
        let determinant = ab.dot(p);
        let (u, v, t) = (s.dot(p) / determinant, direction.dot(q) / determinant, ac.dot(q) / determinant);
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0
    };
    mesh.triangles.iter().filter(meets).count()
}

const NORMAL: DisplacementDirection = DisplacementDirection::Normal;

#[test]
fn a_displaced_sphere_has_its_volume_and_its_outline_and_is_closed() {
    let scene = scene(Mesh::unit_sphere(), EdgeLimit::Length(0.04), NORMAL, 0.3);
    // r = 1 + 0.3 z², of which the volume is 2π/3 ∫ r³ dz
    let mesh = displaced(&scene, |p| [p.object_position[2] * p.object_position[2]; 3]);
    let steps = 10_000;
    let cube = |i: i32| (1.0 + 0.3 * ((f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0).powi(2)).powi(3);
    let expected = 2.0 * PI / 3.0 * (0..steps).map(cube).sum::<f64>() * 2.0 / f64::from(steps);
    // Flat triangles inside of a round outline: a loss of the square of their size
    let lost = 1.0 - volume(&mesh) / expected;
    assert!((0.0..1e-3).contains(&lost), "{} {expected}", volume(&mesh));
    let highest = mesh.positions.iter().map(|p| p.length()).fold(0.0, f32::max);
    assert!((highest - 1.3).abs() < 1e-5, "{highest}");
    assert!(is_closed(&mesh));
    for i in 0..60 {
        let turn = f64::from(i) * 2.399_963;
        let z = (f64::from(i) + 0.5) / 30.0 - 1.0;
        let r = (1.0 - z * z).sqrt();
        let direction = glam::DVec3::new(r * turn.cos(), r * turn.sin(), z);
        assert_eq!(crossings(&mesh, glam::DVec3::new(0.013, 0.021, -0.017), direction) % 2, 1, "{direction}");
    }
}

#[test]
fn normals_are_those_of_the_moved_surface() {
    let scene = scene(Mesh::square(), EdgeLimit::Length(0.02), NORMAL, 0.1);
    let mesh = displaced(&scene, |p| [(2.0 * p.uv[0]).sin(); 3]);
    for (p, n) in mesh.positions.iter().zip(&mesh.normals).filter(|(p, _)| p.x > 0.05 && p.x < 0.95) {
        let slope = 0.1 * 2.0 * (2.0 * p.x).cos();
        let expected = Vec3::new(-slope, 0.0, 1.0).normalize();
        assert!(n.distance(expected) < 0.01, "{p}: {n}, expected {expected}");
    }
}

#[test]
fn a_seam_of_uv_and_edges_of_normals_stay_closed() {
    // The value jumps where u does
    let sphere = scene(Mesh::unit_sphere(), EdgeLimit::Length(0.2), NORMAL, 0.5);
    assert!(is_closed(&displaced(&sphere, |p| [p.uv[0]; 3])));
    // A cube of faces with normals and uv of their own, that none of the others share
    let mut cube = Mesh::default();
    for face in 0..6 {
        let axis = [Vec3::X, Vec3::Y, Vec3::Z][face / 2] * if face % 2 == 0 { 1.0 } else { -1.0 };
        let (u, v) = axis.any_orthonormal_pair();
        let first = cube.positions.len() as u32;
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            cube.positions.push((axis + x * u + y * v).round());
            cube.normals.push(axis);
            cube.uvs.push(Vec2::new(x + face as f32, y));
        }
        cube.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|k| first + k)));
    }
    let flat = Mesh { normals: Vec::new(), uvs: Vec::new(), ..cube.clone() };
    for mesh in [cube, flat] {
        let scene = scene(mesh, EdgeLimit::Length(0.3), NORMAL, 0.2);
        let moved = displaced(&scene, |p| [(5.0 * p.uv[0]).sin() * (3.0 * p.uv[1]).cos(); 3]);
        assert!(is_closed(&moved));
        assert!(moved.triangles.len() > 12 * 64);
    }
}

#[test]
fn vectors_go_along_the_axes_that_they_name() {
    let value = |_: &TexturePoint| [0.1, 0.2, 0.3];
    for (direction, expected) in [
        (DisplacementDirection::Object, Vec3::new(0.1, 0.2, 0.3)),
        (DisplacementDirection::Tangent, Vec3::new(0.1, 0.2, 0.3)),
        (NORMAL, Vec3::new(0.0, 0.0, 0.2)),
    ] {
        let scene = scene(Mesh::square(), EdgeLimit::Length(0.5), direction, 1.0);
        let (moved, flat) = (displaced(&scene, value), displaced(&scene, |_| [0.0; 3]));
        for (p, q) in moved.positions.iter().zip(&flat.positions) {
            assert!((*p - *q - expected).length() < 1e-6, "{direction:?}: {}", *p - *q);
        }
    }
}

#[test]
fn heights_are_in_the_units_of_the_world() {
    let mut scaled = scene(Mesh::unit_sphere(), EdgeLimit::Length(2.0), NORMAL, 0.5);
    scaled.instances[0].world_from_object = Affine3A::from_scale(Vec3::splat(4.0));
    let highest =
        displaced(&scaled, |_| [1.0; 3]).positions.iter().map(|p| 4.0 * p.length()).fold(0.0, f32::max);
    assert!((highest - 4.5).abs() < 1e-4, "{highest}");
}

#[test]
fn edges_are_as_long_as_they_may_be_and_shorter_near_the_camera() {
    let mut near = scene(Mesh::square(), EdgeLimit::Pixels(8.0), NORMAL, 0.0);
    // From one side, along the square
    (near.camera.position, near.camera.target) = (Vec3::new(0.5, -0.3, 0.2), Vec3::new(0.5, 1.0, 0.0));
    (near.film.width, near.film.height) = (200, 100);
    let mesh = displaced(&near, |_| [0.0; 3]);
    let mut longest = [0.0_f32; 2];
    for triangle in &mesh.triangles {
        for k in 0..3 {
            let [a, b] = [k, (k + 1) % 3].map(|k| mesh.positions[triangle[k] as usize]);
            let limit = 8.0 * near.camera.pixel_width(0.5 * (a + b), 200, 100);
            assert!(a.distance(b) <= 1.0001 * limit);
            let far = usize::from(0.5 * (a.y + b.y) > 0.5);
            longest[far] = longest[far].max(a.distance(b));
        }
    }
    assert!(longest[0] < longest[1]);
}

#[test]
fn the_bound_of_triangles_is_an_error_before_it_is_passed() {
    let mut scene = scene(Mesh::unit_sphere(), EdgeLimit::Length(1e-6), NORMAL, 0.1);
    let (handle, ..) = scene.meshes.iter().next().unwrap();
    scene.meshes[handle].displacement.as_mut().unwrap().most_triangles = 5000;
    let mut nothing = |_, _: &[TexturePoint]| panic!("nothing is asked for");
    let error = displace(&mut scene, &[], &mut Displaced::default(), &mut nothing).unwrap_err();
    assert_eq!(error.message, "mesh `hills`: displacement cuts it into more than 5000 triangles");
    assert!(error.help.unwrap().contains("max_triangles"));
}

#[test]
fn a_mesh_is_displaced_again_when_something_changes_that_it_is_made_from() {
    let by_length = scene(Mesh::unit_sphere(), EdgeLimit::Length(0.5), NORMAL, 0.1);
    let by_pixels = scene(Mesh::unit_sphere(), EdgeLimit::Pixels(100.0), NORMAL, 0.1);
    for (start, sees_camera) in [(by_length, false), (by_pixels, true)] {
        let mut kept = Displaced::remembering();
        let mut made = |edit: &dyn Fn(&mut Scene), textures: &[u8]| {
            let mut scene = start.clone();
            edit(&mut scene);
            let mut ones = |_, points: &[TexturePoint]| Ok(vec![[1.0; 4]; points.len()]);
            kept.begin();
            displace(&mut scene, textures, &mut kept, &mut ones).unwrap();
            kept.end();
            let mesh = scene.meshes.iter().next().unwrap().2;
            assert!(mesh.displacement.is_none() && mesh.triangles.len() > 20);
            kept.made() > 0
        };
        assert!(made(&|_| {}, b""), "there is none");
        assert!(!made(&|_| {}, b""), "nothing changed");
        let light = |scene: &mut Scene| scene.lights.push(crate::scene::Light::point(Vec3::Y, Vec3::ONE));
        assert!(!made(&light, b""), "a light");
        assert_eq!(made(&|scene| scene.camera.position = Vec3::Z * 9.0, b""), sees_camera, "the camera");
        assert_eq!(made(&|_| {}, b""), sees_camera, "back");
        assert!(made(&|_| {}, b"other"), "the textures");
        assert!(
            made(&|scene| scene.instances[0].world_from_object.translation.x = 1.0, b"other"),
            "its place"
        );
        let mesh = |scene: &Scene| scene.instances[0].mesh;
        let corner = |scene: &mut Scene| {
            let mesh = mesh(scene);
            scene.meshes[mesh].positions[0] *= 1.5;
        };
        assert!(made(&corner, b"other"), "a corner");
        let height = |scene: &mut Scene| {
            let mesh = mesh(scene);
            scene.meshes[mesh].displacement.as_mut().unwrap().height = 0.2;
        };
        assert!(made(&height, b"other"), "the height");
    }
}
