//! Surfaces of which not all is there: k layers of opacity α let (1 − α)ᵏ through.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

/// A white wall at z = −10 in front of a pinhole, seen straight on.
fn wall(width: u32, spp: u32) -> Scene {
    let mut s = scene(width, width, spp);
    s.camera.projection = Projection::pinhole(20.0);
    s.render.max_depth = 1;
    let white = s.unlit(grey(1.0));
    s.quad(Vec3::new(-9.0, -9.0, -10.0), Vec3::X * 18.0, Vec3::Y * 18.0, white);
    s
}

fn veil(s: &mut Scene, opacity: Opacity) -> Handle<Material> {
    let black = s.black();
    s.materials[black].detail.opacity = opacity;
    black
}

fn share(value: f32) -> Opacity {
    Opacity { value: Value::Constant(value), ..Opacity::default() }
}

/// Layers in front of the wall, each nearer than the last.
fn layers(s: &mut Scene, material: Handle<Material>, count: u32) {
    for k in 0..count {
        s.quad(Vec3::new(-5.0, -5.0, -8.0 + k as f32), Vec3::X * 10.0, Vec3::Y * 10.0, material);
    }
}

#[test]
fn layers_let_a_power_of_their_transparency_through() {
    for (alpha, count) in [(0.5, 2), (0.3, 4), (0.125, 1)] {
        let mut s = wall(48, 64);
        let m = veil(&mut s, share(alpha));
        layers(&mut s, m, count);
        expect_grey(mean(&render(&s)), f64::from(1.0 - alpha).powi(count as i32), 0.0);
    }
}

#[test]
fn layers_of_a_mesh_and_of_its_copies_are_drawn_for_alike() {
    // Two quads of one mesh, placed twice: the draws of triangles and of instances are independent
    let mut s = wall(48, 64);
    let m = veil(&mut s, share(0.4));
    let square =
        |z: f32| [(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)].map(|(x, y)| Vec3::new(x, y, z));
    let mesh = Mesh {
        positions: [square(-7.0), square(-6.5)].concat(),
        triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
        ..Mesh::default()
    };
    let mesh = s.meshes.add("sheets", mesh);
    s.place(mesh, m, Affine3A::IDENTITY);
    s.place(mesh, m, Affine3A::from_translation(Vec3::Z));
    expect_grey(mean(&render(&s)), 0.6_f64.powi(4), 0.0);
}

#[test]
fn a_sphere_is_met_twice() {
    let mut s = wall(32, 256);
    let m = veil(&mut s, share(0.5));
    s.sphere(Vec3::new(0.0, 0.0, -5.0), 1.2, m);
    expect_grey(mean(&render(&s)), 0.25, 0.0);
}

#[test]
fn the_camera_sees_through_holes_without_depth() {
    // 90 % holes: columns of a picture of which one in ten is there
    for cutoff in [None, Some(0.5)] {
        let mut s = wall(40, 16);
        s.render.sampler = Sampler::Center;
        let mut texels = vec![[0, 0, 0, 255]; 10];
        texels[4] = [255; 4];
        let leaf = s.picture(Image { width: 10, height: 1, texels: Texels::Rgba8(texels) }, |texture| {
            texture.filter = TexelFilter::Nearest;
        });
        let m = veil(&mut s, Opacity { value: Value::Texture(leaf), cutoff, ..Opacity::default() });
        layers(&mut s, m, 6);
        let picture = render(&s);
        for (x, rgb) in picture.rgb[20 * 40..][..40].iter().enumerate() {
            let tan = (2.0 * (x as f32 + 0.5) / 40.0 - 1.0) * 10.0_f32.to_radians().tan();
            let there = (0..6).any(|k| {
                let u = (tan * (8.0 - k as f32) + 5.0) / 10.0;
                (0.4..0.5).contains(&u)
            });
            assert_eq!(rgb[0], if there { 0.0 } else { 1.0 }, "{cutoff:?}, column {x}");
        }
        assert!(picture.rgb.iter().any(|rgb| rgb[0] == 0.0));
    }
}

#[test]
fn a_shadow_through_layers_is_exact() {
    for (alpha, count, filter) in
        [(0.5, 2, Vec3::ONE), (0.25, 5, Vec3::ONE), (0.25, 3, Vec3::new(1.0, 0.5, 0.0))]
    {
        let lit = |count| {
            let mut s = scene(4, 4, 4);
            s.render.max_depth = 1;
            s.camera = look(Vec3::new(0.0, 5.0, 0.1), Vec3::ZERO, 5.0);
            let floor = s.diffuse(0.5);
            s.floor(floor);
            s.lights.push(Light::point(Vec3::new(30.0, 20.0, 0.0), Vec3::splat(1000.0)));
            let m = veil(&mut s, Opacity { filter: Value::Constant(filter), ..share(alpha) });
            for k in 0..count {
                let x = 5.0 + k as f32;
                s.quad(Vec3::new(x, -5.0, -50.0), Vec3::Y * 100.0, Vec3::Z * 100.0, m);
            }
            mean(&render(&s)).mean
        };
        let (open, behind) = (lit(0), lit(count));
        for c in 0..3 {
            let expected = open[c] * f64::from((1.0 - alpha) * filter[c]).powi(count);
            assert!((behind[c] - expected).abs() <= 1e-5 * open[c], "{c}: {behind:?}, expected {expected}");
        }
    }
}

#[test]
fn stained_glass_colours_what_is_behind_it() {
    let filter = Vec3::new(0.9, 0.5, 0.25);
    let mut s = wall(8, 4);
    let m = veil(&mut s, Opacity { filter: Value::Constant(filter), ..share(0.0) });
    layers(&mut s, m, 3);
    s.sphere(Vec3::new(0.0, 0.0, -2.0), 1.0, m);
    expect_every_pixel(&render(&s), filter.to_array().map(|f| f64::from(f).powi(5)), 1e-5);
    // Half of it is there, and black
    let mut s = wall(48, 64);
    let m = veil(&mut s, Opacity { filter: Value::Constant(filter), ..share(0.5) });
    layers(&mut s, m, 2);
    expect_mean(mean(&render(&s)), filter.to_array().map(|f| (0.5 * f64::from(f)).powi(2)), 0.0);
}

#[test]
fn a_lamp_that_is_half_there_is_half_as_bright() {
    // By light sampling and by chance, weighted against each other; and behind a coloured sheet
    let lit = |opacity: Option<f32>, sheet: Option<Vec3>| {
        let mut s = scene(16, 16, 256);
        s.render.max_depth = 2;
        s.camera = look(Vec3::new(0.0, 3.0, 0.1), Vec3::ZERO, 30.0);
        let floor = s.diffuse(0.5);
        s.floor(floor);
        let lamp = s.emitter(grey(5.0), true);
        s.materials[lamp].detail.opacity = opacity.map_or(Opacity::default(), share);
        s.quad(Vec3::new(1.5, 1.0, -1.0), Vec3::Z * 2.0, Vec3::Y * 2.0, lamp);
        if let Some(filter) = sheet {
            let m = veil(&mut s, Opacity { filter: Value::Constant(filter), ..share(0.0) });
            s.quad(Vec3::new(1.2, 0.0, -9.0), Vec3::Z * 18.0, Vec3::Y * 9.0, m);
        }
        mean(&render(&s))
    };
    let whole = lit(None, None);
    let scaled = |m: Measured, f: [f64; 3]| Measured { mean: [0, 1, 2].map(|c| m.mean[c] * f[c]), ..m };
    expect_same(lit(Some(0.5), None), scaled(whole, [0.5; 3]), 0.0);
    let filter = Vec3::new(0.9, 0.6, 0.3);
    expect_same(lit(None, Some(filter)), scaled(whole, filter.to_array().map(f64::from)), 0.0);
}

#[test]
fn an_opacity_is_mapped_as_a_colour_is() {
    // Triplanar in object space, whose normal is not that of the world: as a colour, and as a cut-out of white
    let seen = |cut: bool| {
        let mut s = scene(32, 32, 1);
        s.render.sampler = Sampler::Center;
        let texels = Texels::Rgba8(vec![[0, 0, 0, 255], [255; 4], [255; 4], [0, 0, 0, 255]]);
        let picture =
            s.picture(Image { width: 2, height: 2, texels }, |texture| texture.filter = TexelFilter::Nearest);
        let mapping = Mapping {
            kind: MappingKind::Triplanar,
            space: MappingSpace::Object,
            mapping_from_space: Affine3A::from_scale(Vec3::splat(3.0)),
            pole_u: 0.0,
            seam_blend: 0.0,
            sharpness: 8.0,
        };
        let value = Value::Texture(picture);
        let texture = Value::Texture(s.textures.add("mapped", Texture::Mapped { value, mapping }));
        let m = s.unlit(if cut { grey(1.0) } else { texture });
        if cut {
            let Value::Texture(handle) = texture else { panic!("a texture") };
            let value = Value::Texture(handle);
            s.materials[m].detail.opacity = Opacity { value, cutoff: Some(0.5), ..Opacity::default() };
        }
        let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
        let mesh =
            Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
        let mesh = s.meshes.add("floor", mesh);
        let upright = Affine3A::from_rotation_x(std::f32::consts::FRAC_PI_2);
        s.place(mesh, m, Affine3A::from_translation(Vec3::Z * -1.5) * upright);
        render(&s).rgb
    };
    let (color, cut) = (seen(false), seen(true));
    assert_eq!(color, cut);
    let white = color.iter().filter(|rgb| rgb[0] == 1.0).count();
    assert!(white > 100 && white < 900, "{white}");
}
