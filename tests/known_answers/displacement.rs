//! Displaced meshes as pictures.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

/// A sphere of radius 1 that its texture makes a sphere of radius 1.5.
fn grown(s: &mut Scene, material: Handle<Material>) {
    let texture = s.textures.add("height", Texture::Constant(Vec3::splat(0.5)));
    let displacement = Displacement {
        texture,
        height: 1.0,
        offset: 0.0,
        direction: DisplacementDirection::Normal,
        edge: EdgeLimit::Length(0.06),
        most_triangles: 1_000_000,
    };
    let mesh = Mesh { displacement: Some(displacement), ..Mesh::unit_sphere() };
    let mesh = s.meshes.add("grown", mesh);
    s.place(mesh, material, Affine3A::from_rotation_x(0.4));
}

#[test]
fn outline_shadow_and_shading_are_those_of_the_larger_sphere() {
    let picture = |displaced: bool| {
        let mut s = scene(32, 32, 64);
        s.camera = look(Vec3::new(0.0, 2.0, 7.0), Vec3::ZERO, 60.0);
        s.render.max_depth = 1;
        let (white, grey) = (s.diffuse(0.8), s.diffuse(0.5));
        s.quad(Vec3::new(-6.0, -1.5, 6.0), Vec3::X * 12.0, Vec3::NEG_Z * 12.0, grey);
        s.lights.push(point(Vec3::new(4.0, 6.0, 3.0), 100.0));
        if displaced {
            grown(&mut s, white);
        } else {
            s.sphere(Vec3::ZERO, 1.5, white);
        }
        render(&s)
    };
    let (moved, exact) = (picture(true), picture(false));
    let mut off: Vec<_> = moved.rgb.iter().zip(&exact.rgb).map(|(a, b)| (a[0] - b[0]).abs()).collect();
    off.sort_by(f32::total_cmp);
    let bright = exact.rgb.iter().map(|rgb| rgb[0]).fold(0.0, f32::max);
    // But for edges of the outline and of the shadow, which flat triangles move by a thousandth
    assert!(off[off.len() * 9 / 10] < 0.01 * bright, "{} of {bright}", off[off.len() * 9 / 10]);
    expect_same(mean(&moved), mean(&exact), 5e-3);
    // The sphere that was not displaced is another picture
    let small = {
        let mut s = scene(32, 32, 16);
        s.camera = look(Vec3::new(0.0, 2.0, 7.0), Vec3::ZERO, 60.0);
        s.render.max_depth = 1;
        let white = s.diffuse(0.8);
        s.lights.push(point(Vec3::new(4.0, 6.0, 3.0), 100.0));
        s.sphere(Vec3::ZERO, 1.0, white);
        render(&s)
    };
    assert!(mean(&small).mean[0] < 0.6 * mean(&exact).mean[0]);
}
