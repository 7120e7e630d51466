//! Surfaces that are there from their front alone.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

fn front_only(s: &mut Scene, material: Handle<Material>) -> Handle<Material> {
    s.materials[material].detail.sides = Sides::Front;
    material
}

/// A camera that sees a white wall at z = −10, and one event for each path.
fn wall() -> Scene {
    let mut s = scene(8, 8, 4);
    s.camera.projection = Projection::pinhole(20.0);
    s.render.max_depth = 1;
    let white = s.unlit(grey(1.0));
    s.quad(Vec3::new(-9.0, -9.0, -10.0), Vec3::X * 18.0, Vec3::Y * 18.0, white);
    s
}

#[test]
fn what_is_seen_from_behind_is_not_there_and_costs_no_depth() {
    // Many layers of every kind of shape, once and in copies; from the front the nearest is seen
    for front in [false, true] {
        let mut s = wall();
        let grey = s.unlit(grey(0.25));
        let m = front_only(&mut s, grey);
        let (u, v) = if front { (Vec3::X, Vec3::Y) } else { (Vec3::Y, Vec3::X) };
        let corner = |z: f32| Vec3::new(-5.0, -5.0, z);
        s.quad(corner(-8.0), u * 10.0, v * 10.0, m);
        s.disk(Vec3::Z * -7.0, u.cross(v), 5.0, m);
        let mesh = rectangle_mesh(corner(0.0), u * 10.0, v * 10.0);
        let copies = s.meshes.add("copies", mesh.clone());
        s.place(copies, m, Affine3A::from_translation(Vec3::Z * -6.0));
        s.place(copies, m, Affine3A::from_translation(Vec3::Z * -5.0));
        let once = s.meshes.add("once", mesh);
        s.place(once, m, Affine3A::from_translation(Vec3::Z * -4.0));
        // A map that mirrors does not turn the inside out
        let mirrored = s.meshes.add("mirrored", rectangle_mesh(corner(0.0), u * 10.0, v * 10.0));
        s.place(
            mirrored,
            m,
            Affine3A::from_translation(Vec3::Z * -3.0) * Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)),
        );
        expect_every_pixel(&render(&s), [if front { 0.25 } else { 1.0 }; 3], 0.0);
    }
}

#[test]
fn a_ball_and_a_box_are_open_from_inside_and_closed_from_outside() {
    for inside in [false, true] {
        for ball in [false, true] {
            let mut s = wall();
            let black = s.black();
            let m = front_only(&mut s, black);
            let (at, size) = if inside { (0.0, 3.0) } else { (-5.0, 2.0) };
            if ball {
                s.sphere(Vec3::Z * at, size, m);
            } else {
                let half = Vec3::splat(size);
                let mesh = s.meshes.add("box", box_mesh(Vec3::Z * at - half, Vec3::Z * at + half, false));
                s.place(mesh, m, Affine3A::IDENTITY);
            }
            expect_every_pixel(&render(&s), [if inside { 1.0 } else { 0.0 }; 3], 0.0);
        }
    }
}

/// A floor below a sheet that faces up or down, with a lamp above.
fn below_a_sheet(sheet: Option<bool>, lamp: bool) -> Measured {
    let mut s = scene(16, 16, 64);
    s.render.max_depth = 2;
    s.camera = look(Vec3::new(0.0, 0.4, 2.0), Vec3::ZERO, 10.0);
    let floor = s.diffuse(0.5);
    s.floor(floor);
    if lamp {
        let shining = s.emitter(grey(5.0), false);
        let shining = front_only(&mut s, shining);
        // Faces down
        s.quad(Vec3::new(-1.0, 3.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0, shining);
    } else {
        s.lights.push(point(Vec3::Y * 3.0, 10.0));
    }
    if let Some(up) = sheet {
        let black = s.black();
        let m = front_only(&mut s, black);
        let (u, v) = if up { (Vec3::Z, Vec3::X) } else { (Vec3::X, Vec3::Z) };
        s.quad(Vec3::new(-50.0, 1.0, -50.0), u * 100.0, v * 100.0, m);
    }
    mean(&render(&s))
}

#[test]
fn a_light_shines_through_a_sheet_from_behind_and_not_from_its_front() {
    for lamp in [false, true] {
        let open = below_a_sheet(None, lamp);
        // Shadow rays go up: from behind a sheet that faces up
        expect_same(below_a_sheet(Some(true), lamp), open, 0.0);
        assert_eq!(below_a_sheet(Some(false), lamp).mean, [0.0; 3]);
    }
}

#[test]
fn a_lamp_that_is_there_from_its_front_shines_to_its_front_alone() {
    let lit = |sides: Sides, two_sided: bool, down: bool| {
        let mut s = scene(16, 16, 64);
        s.render.max_depth = 1;
        s.camera = look(Vec3::new(0.0, 0.4, 2.0), Vec3::ZERO, 10.0);
        let floor = s.diffuse(0.5);
        s.floor(floor);
        let lamp = s.emitter(grey(5.0), two_sided);
        s.materials[lamp].detail.sides = sides;
        let (u, v) = if down { (Vec3::X, Vec3::Z) } else { (Vec3::Z, Vec3::X) };
        s.quad(Vec3::new(-1.0, 3.0, -1.0), u * 2.0, v * 2.0, lamp);
        mean(&render(&s))
    };
    let plain = lit(Sides::Both, false, true);
    for two_sided in [false, true] {
        expect_same(lit(Sides::Front, two_sided, true), plain, 0.0);
        assert_eq!(lit(Sides::Front, two_sided, false).mean, [0.0; 3]);
    }
}

#[test]
fn a_lamp_inside_does_not_shine_out_past_coarse_triangles() {
    // By the normals of a ball much of a tetrahedron is turned to the lamp within it, and nothing of it is there from inside
    let lit = |lamp: Vec3| {
        let mut s = scene(32, 32, 16);
        s.camera = look(Vec3::new(0.5, 2.0, 5.0), Vec3::ZERO, 40.0);
        let white = s.diffuse(0.8);
        let m = front_only(&mut s, white);
        let corners =
            [Vec3::ONE, Vec3::new(-1.0, -1.0, 1.0), Vec3::new(-1.0, 1.0, -1.0), Vec3::new(1.0, -1.0, -1.0)];
        let faces = [[0, 1, 3], [0, 3, 2], [0, 2, 1], [1, 2, 3]];
        let normals = corners.map(|c| (c + Vec3::new(0.0, 6.0, 0.0)).normalize()).to_vec();
        let mesh =
            Mesh { positions: corners.to_vec(), normals, triangles: faces.to_vec(), ..Mesh::default() };
        let mesh = s.meshes.add("tetrahedron", mesh);
        s.place(mesh, m, Affine3A::IDENTITY);
        s.lights.push(point(lamp, 5.0));
        mean(&render(&s)).mean
    };
    assert_eq!(lit(Vec3::new(0.0, 0.1, 0.0)), [0.0; 3]);
    assert!(lit(Vec3::new(0.0, 3.0, 3.0))[0] > 0.01);
}
