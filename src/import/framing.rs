//! A camera that shows all of a model.

use crate::scene::{Camera, FovAxis, Instance, Perspective, Projection, Scene};
use glam::{DVec3, Vec3};

/// Where the camera is from the middle of the model: in front, a little from the right and from above.
const DIRECTION: DVec3 = DVec3::new(0.35, 0.3, 1.0);
/// Where it is when less than a part of the fronts that it would see is to be seen from there: from behind, from below, from the left.
const TURNS: [DVec3; 4] =
    [DVec3::ONE, DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.0, -1.0, 1.0), DVec3::new(-1.0, 1.0, 1.0)];
/// That part.
const ENOUGH: f64 = 0.5;
/// Field of view of the shorter side of the picture, in degrees.
const FOV: f32 = 35.0;
/// How much wider the view is than the model.
const MARGIN: f64 = 1.08;

/// A camera that sees the boxes around all instances, in a picture of any shape.
pub(super) fn camera(scene: &Scene, instances: &[Instance]) -> Camera {
    let (low, high) = bounds(scene, instances);
    let middle = 0.5 * (low + high);
    let back = direction(scene, instances);
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let tan = (0.5 * f64::from(FOV).to_radians()).tan();
    // Each corner must be inside of the pyramid of the view
    let distance = |corner: DVec3| {
        let p = corner - middle;
        p.dot(back) + MARGIN * p.dot(right).abs().max(p.dot(up).abs()) / tan
    };
    let corners = (0..8).map(|i| {
        let end = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(end(0), end(1), end(2))
    });
    let far = corners.map(distance).fold(f64::MIN_POSITIVE, f64::max);
    let far = if far > 1e-6 * middle.length() { far } else { middle.length().max(1.0) };
    Camera {
        position: (middle + back * far).as_vec3(),
        target: middle.as_vec3(),
        projection: Projection::Perspective(Perspective { fov: FOV, fov_axis: FovAxis::Smaller, lens: None }),
        ..Camera::default()
    }
}

/// The first direction from which enough of the fronts is seen: a sheet that faces away would show its back, or nothing.
fn direction(scene: &Scene, instances: &[Instance]) -> DVec3 {
    let directions = TURNS.map(|turn| (turn * DIRECTION).normalize());
    let mut seen = [0.0; TURNS.len()];
    for instance in instances {
        let mesh = &scene.meshes[instance.mesh];
        let map = instance.world_from_object.as_daffine3();
        let side = map.matrix3.determinant().signum();
        for corners in &mesh.triangles {
            let [a, b, c] =
                corners.map(|corner| map.transform_point3(mesh.positions[corner as usize].as_dvec3()));
            let area = side * (b - a).cross(c - a);
            seen.iter_mut().zip(&directions).for_each(|(sum, d)| *sum += area.dot(*d).max(0.0));
        }
    }
    let most = seen.iter().copied().fold(0.0, f64::max);
    let enough = seen.iter().position(|sum| *sum >= ENOUGH * most);
    enough.map_or(directions[0], |first| directions[first])
}

/// The box around all vertices in the world; around the origin when there are none.
fn bounds(scene: &Scene, instances: &[Instance]) -> (DVec3, DVec3) {
    let mut boxes = vec![None; scene.meshes.len()];
    let mut whole = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for instance in instances {
        let own = boxes[instance.mesh.index()].get_or_insert_with(|| {
            let mesh = &scene.meshes[instance.mesh];
            let points = mesh.triangles.iter().flatten().map(|corner| mesh.positions[*corner as usize]);
            points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
        });
        let map = instance.world_from_object.as_daffine3();
        let (low, high) = (own.0.as_dvec3(), own.1.as_dvec3());
        let middle = map.transform_point3(0.5 * (low + high));
        let m = map.matrix3;
        let half = 0.5 * (high - low);
        let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        whole = (whole.0.min(middle - reach), whole.1.max(middle + reach));
    }
    if whole.0.is_finite() && whole.1.is_finite() { whole } else { (DVec3::NEG_ONE, DVec3::ONE) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, Mesh, Surface, Value};
    use glam::Affine3A;

    #[test]
    fn all_of_a_box_is_seen_and_fills_the_picture() {
        for (scale, at) in [(1.0, Vec3::ZERO), (1e-3, Vec3::ONE), (500.0, Vec3::new(0.0, 1e3, -1e4))] {
            let mut scene = Scene::default();
            let corners =
                (0..8).map(|i| Vec3::new((i & 1) as f32 * 2.0, (i >> 1 & 1) as f32, (i >> 2) as f32 * 0.5));
            let positions: Vec<Vec3> = corners.collect();
            let triangles = vec![[0, 1, 2], [3, 4, 5], [5, 6, 7]];
            let mesh =
                scene.meshes.add("box", Mesh { positions: positions.clone(), triangles, ..Mesh::default() });
            let grey = Surface::diffuse(Value::Constant(Vec3::ONE));
            let material = scene.materials.add("grey", Material::new(grey, None));
            let world_from_object =
                Affine3A::from_scale_rotation_translation(Vec3::splat(scale), glam::Quat::IDENTITY, at);
            let instance = Instance { name: "box".into(), mesh, material, world_from_object, at_close: None };
            let camera = camera(&scene, &[instance]);
            let camera_from_world = camera.world_from_camera().inverse();
            let tan = (0.5 * FOV.to_radians()).tan();
            let seen = positions.iter().map(|p| {
                let p = camera_from_world.transform_point3(world_from_object.transform_point3(*p));
                assert!(p.z < 0.0, "{p} is behind the camera");
                p.x.abs().max(p.y.abs()) / (-p.z * tan)
            });
            let widest = seen.fold(0.0, f32::max);
            assert!((0.9..0.999).contains(&widest), "{scale}: {widest}");
        }
    }

    #[test]
    fn a_sheet_is_seen_from_its_front() {
        // Facing +z, −z and −y; and one that a mirror turns over
        for (corners, mirror, sign) in [
            ([Vec3::ZERO, Vec3::X, Vec3::Y], 1.0, Vec3::Z),
            ([Vec3::ZERO, Vec3::Y, Vec3::X], 1.0, -Vec3::Z),
            ([Vec3::ZERO, Vec3::X, Vec3::Z], 1.0, -Vec3::Y),
            ([Vec3::ZERO, Vec3::X, Vec3::Y], -1.0, Vec3::Z),
        ] {
            let mut scene = Scene::default();
            let mesh = Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
            let mesh = scene.meshes.add("sheet", mesh);
            let grey = Surface::diffuse(Value::Constant(Vec3::ONE));
            let material = scene.materials.add("grey", Material::new(grey, None));
            let world_from_object = Affine3A::from_scale(Vec3::new(mirror, 1.0, 1.0));
            let instance =
                Instance { name: "sheet".into(), mesh, material, world_from_object, at_close: None };
            let camera = camera(&scene, &[instance]);
            assert!((camera.position - camera.target).dot(sign) > 0.0, "{corners:?} {mirror}: {camera:?}");
        }
    }
}
