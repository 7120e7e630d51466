//! Scenes that are hard on rays: seams, far away, many triangles in one place.

use super::geometry::aovs;
use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Quat, Vec3};

#[test]
fn no_ray_slips_between_triangles() {
    // A ball of triangles around the camera, black; the environment would shine through any gap
    let n = 40_u32;
    for twice in [false, true] {
        let mut mesh = Mesh::default();
        for j in 0..=n {
            for i in 0..n {
                let (a, b) =
                    (i as f32 / n as f32 * std::f32::consts::TAU, j as f32 / n as f32 * std::f32::consts::PI);
                mesh.positions.push(Vec3::new(b.sin() * a.cos(), b.cos(), b.sin() * a.sin()));
            }
        }
        for j in 0..n {
            for i in 0..n {
                let at = |i: u32, j: u32| j * n + i % n;
                mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let mut s = scene(64, 64, 64);
        s.environment = constant_environment(1.0);
        // Bounces graze many edges; nothing may find the environment
        s.render.max_depth = 4;
        s.render.russian_roulette = false;
        let m = s.diffuse(1.0);
        let handle = s.meshes.add("ball", mesh);
        let map = Affine3A::from_scale_rotation_translation(
            Vec3::splat(3.0),
            Quat::from_rotation_x(0.3),
            Vec3::new(0.5, 0.2, 0.4),
        );
        s.place(handle, m, map);
        if twice {
            s.place(handle, m, Affine3A::from_translation(Vec3::X * 20.0));
        }
        for target in [Vec3::NEG_Z, Vec3::Y, Vec3::new(1.0, 0.3, 0.2)] {
            // Straight through vertices and along edges, too
            s.camera = look(Vec3::ZERO, target, 100.0);
            let p = render(&s);
            let lit: Vec<usize> =
                (0..64 * 64).filter(|&i| p.rgb[i] != [0.0; 3] || p.alpha[i] != 1.0).collect();
            assert!(lit.is_empty(), "{} pixels see the outside, the first is {}", lit.len(), lit[0]);
        }
    }
}

#[test]
fn grids_seen_exactly_along_their_edges_have_no_gaps() {
    // Pixel centres fall on vertices and edges
    let n = 16_u32;
    let mut mesh = Mesh::default();
    for j in 0..=n {
        for i in 0..=n {
            mesh.positions.push(Vec3::new(i as f32 - 8.0, j as f32 - 8.0, -8.0));
        }
    }
    for j in 0..n {
        for i in 0..n {
            let at = |i: u32, j: u32| j * (n + 1) + i;
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let mut s = scene(31, 31, 1);
    // The picture spans ±7.75 at distance 8: pixel centres every half unit, from −7.5 to 7.5
    s.camera.projection = Projection::pinhole(2.0 * (7.75_f32 / 8.0).atan().to_degrees());
    let m = s.diffuse(0.5);
    let handle = s.meshes.add("grid", mesh);
    s.place(handle, m, Affine3A::IDENTITY);
    let p = aovs(&mut s);
    assert!(p.alpha.iter().all(|&a| a == 1.0));
}

#[test]
fn a_thin_scene_far_away_is_seen() {
    let far = 1.0e5_f32;
    let mut s = scene(16, 16, 1);
    let m = s.diffuse(0.5);
    // A board one unit wide and 0.01 thick
    let mesh =
        s.meshes.add("board", box_mesh(Vec3::new(-0.5, -0.5, -far - 0.01), Vec3::new(0.5, 0.5, -far), false));
    s.place(mesh, m, Affine3A::IDENTITY);
    s.sphere(Vec3::new(0.0, 1.0, -far), 0.25, m);
    s.camera.projection = Projection::pinhole((2.0_f32 * 2.0 / far).to_degrees());
    let p = aovs(&mut s);
    for i in 0..256 {
        let (x, y) = ((i % 16) as f32 / 4.0 - 1.875, 1.875 - (i / 16) as f32 / 4.0);
        let board = x.abs() < 0.5 && y.abs() < 0.5;
        let ball = x.hypot(y - 1.0) < 0.25;
        if (x.hypot(y - 1.0) - 0.25).abs() > 0.03 {
            assert_eq!(p.alpha[i] == 1.0, board || ball, "{x} {y}");
        }
        if board {
            assert!((p.depth[i] - far).abs() < 0.1, "{}", p.depth[i]);
        }
    }
}

#[test]
fn a_hundred_thousand_coincident_triangles_look_like_one() {
    let with = |copies: usize, instanced: bool| {
        // Few rays: each takes more than a hundred thousand steps, and kernels stop rays after 13,000
        let mut s = scene(4, 4, 1);
        s.camera = look(Vec3::new(0.0, 0.5, 3.0), Vec3::ZERO, 60.0);
        s.render.max_depth = 2;
        let (m, floor) = (s.diffuse(0.6), s.diffuse(0.8));
        let mesh = Mesh {
            positions: vec![Vec3::new(-1.0, -0.2, 0.0), Vec3::new(1.0, -0.2, 0.1), Vec3::new(0.0, 1.2, -0.1)],
            triangles: vec![[0, 1, 2]; copies],
            ..Mesh::default()
        };
        let handle = s.meshes.add("stack", mesh);
        s.place(handle, m, Affine3A::IDENTITY);
        if instanced {
            s.place(handle, m, Affine3A::from_translation(Vec3::Z * 1000.0));
        }
        s.quad(Vec3::new(-4.0, -0.5, 4.0), Vec3::X * 8.0, Vec3::NEG_Z * 8.0, floor);
        // Its shadow falls into the picture: shadow rays go through the pile, too
        s.lights.push(point(Vec3::new(0.5, 2.0, -2.0), 10.0));
        s.environment = constant_environment(0.3);
        render(&s)
    };
    for (copies, instanced) in [(100_000, false), (30_000, true)] {
        let (one, many) = (with(1, instanced), with(copies, instanced));
        assert_eq!(one.rgb, many.rgb);
        assert_eq!(one.depth, many.depth);
        assert!(one.depth.iter().any(|d| d.is_finite()) && one.rgb.iter().any(|c| c[0] > 0.01));
    }
}

#[test]
fn a_shadow_ray_that_runs_out_of_steps_goes_on() {
    // Straight up from the floor: through the box of a pile of triangles but past them, which takes more steps than a kernel
    // has, and only then into what hides the light
    let with = |copies: usize, hidden: bool| {
        let mut s = scene(4, 4, 1);
        s.camera = look(Vec3::new(3.0, 0.2, -0.4), Vec3::new(0.4, 0.0, -0.4), 1.0);
        s.render.max_depth = 1;
        let m = s.diffuse(0.5);
        s.quad(Vec3::new(-4.0, 0.0, 4.0), Vec3::X * 8.0, Vec3::NEG_Z * 8.0, m);
        let mesh = Mesh {
            positions: vec![Vec3::new(-1.0, 0.3, -1.0), Vec3::new(1.0, 0.3, 1.0), Vec3::new(-1.0, 0.7, 1.0)],
            triangles: vec![[0, 1, 2]; copies],
            ..Mesh::default()
        };
        let mesh = s.meshes.add("pile", mesh);
        s.place(mesh, m, Affine3A::IDENTITY);
        if hidden {
            s.quad(Vec3::new(-4.0, 3.0, 4.0), Vec3::X * 8.0, Vec3::NEG_Z * 8.0, m);
        }
        s.lights.push(point(Vec3::Y * 5.0, 10.0));
        render(&s)
    };
    assert!(with(100_000, true).rgb.iter().all(|c| *c == [0.0; 3]), "light where there is shadow");
    let lit = with(100_000, false);
    assert!(lit.rgb.iter().all(|c| c[0] > 0.01));
    expect_same(mean(&lit), mean(&with(1, false)), 1e-6);
}
