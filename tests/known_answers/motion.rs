//! Motion while the shutter is open: how long a pixel is covered, and what moves against what.

use crate::common::patterns::noise;
use crate::common::render::*;
use dapple::film::Picture;
use dapple::prepare::prepare;
use dapple::scene::*;
use glam::{Affine3A, EulerRot, Quat, Vec3};

fn shift(x: f32, y: f32, z: f32) -> Affine3A {
    Affine3A::from_translation(Vec3::new(x, y, z))
}

/// Parallel rays along −z through x and y from −1 to 1, on a sky of radiance 1.
fn parallel(side: u32, spp: u32) -> Scene {
    let mut s = scene(side, side, spp);
    s.camera = look(Vec3::Z * 5.0, Vec3::ZERO, 40.0);
    s.camera.projection = Projection::Orthographic { size: 2.0, axis: FovAxis::Vertical };
    s.environment = constant_environment(1.0);
    s.render.max_depth = 1;
    s
}

/// What is black in a column is the part of it that is covered, over the time: half of the height at a distance from the
/// middle of the thing, which goes from −way to way.
fn expect_columns(s: &Scene, way: f64, half_height: impl Fn(f64) -> f64) {
    let (picture, side) = (render(s), s.film.width);
    for x in 0..side {
        let covered = integrate_square(200, |u, time| {
            let at = 2.0 * (f64::from(x) + u) / f64::from(side) - 1.0;
            half_height(at - way * (2.0 * time - 1.0))
        });
        let column = (0..side).map(|y| (y * side + x) as usize);
        expect_grey(mean_of(&picture, column), 1.0 - covered, 2e-3);
    }
}

#[test]
fn what_moves_covers_a_pixel_for_the_time_that_it_is_there() {
    let (radius, way) = (0.4_f32, 0.5_f32);
    let round = |x: f64| (0.16 - x * x).max(0.0).sqrt();
    let square = |x: f64| if x.abs() < 0.4 { 0.4 } else { 0.0 };
    for kind in 0..4 {
        let mut s = parallel(12, 1024);
        let black = s.black();
        match kind {
            0 => _ = s.sphere(Vec3::X, radius, black),
            1 => _ = s.disk(Vec3::X, Vec3::Z, radius, black),
            2 => _ = s.quad(Vec3::new(0.6, -0.4, 0.0), Vec3::X * 0.8, Vec3::Y * 0.8, black),
            _ => {
                let (low, high) = (Vec3::new(0.6, -0.4, -0.1), Vec3::new(1.4, 0.4, 0.1));
                let mesh = s.meshes.add("box", box_mesh(low, high, false));
                s.place(mesh, black, Affine3A::IDENTITY);
            }
        }
        // In object space all are at x = 1
        let (open, close) = (shift(-1.0 - way, 0.0, 0.0), shift(way - 1.0, 0.0, 0.0));
        for shape in &mut s.shapes {
            (shape.world_from_object, shape.at_close) = (open, Some(close));
        }
        for instance in &mut s.instances {
            (instance.world_from_object, instance.at_close) = (open, Some(close));
        }
        expect_columns(&s, way.into(), if kind < 2 { &round as &dyn Fn(f64) -> f64 } else { &square });
    }
}

#[test]
fn what_turns_covers_a_direction_for_the_time_that_it_is_there() {
    // All of x > 0, a quarter of a turn about z: what is seen of the sky in a direction is the time that it is free
    let mut s = parallel(32, 1024);
    let black = s.black();
    let quad = s.quad(Vec3::new(0.0, -9.0, 0.0), Vec3::X * 9.0, Vec3::Y * 18.0, black);
    quad.at_close = Some(Affine3A::from_rotation_z(std::f32::consts::FRAC_PI_2));
    let picture = render(&s);
    let place = |i: usize| ((i % 32) as f64 - 15.5, 15.5 - (i / 32) as f64);
    let angle = |i: usize| place(i).1.atan2(place(i).0).to_degrees();
    let free = |angle: f64| match angle {
        a if a > 90.0 => (a - 90.0) / 90.0,
        a if a > 0.0 => 0.0,
        a if a > -90.0 => -a / 90.0,
        _ => 1.0,
    };
    for eighth in -4..4 {
        let range = f64::from(eighth) * 45.0 + 1e-6..f64::from(eighth + 1) * 45.0 - 1e-6;
        let pixels: Vec<_> = (0..32 * 32).filter(|&i| range.contains(&angle(i))).collect();
        let expected = pixels.iter().map(|&i| free(angle(i))).sum::<f64>() / pixels.len() as f64;
        // Pixels near the axis see a range of angles
        expect_grey(mean_of(&picture, pixels), expected, 5e-3);
    }
}

#[test]
fn a_stretch_grows_steadily() {
    let mut s = parallel(16, 1024);
    let black = s.black();
    let quad = s.quad(Vec3::new(-0.25, -0.25, 0.0), Vec3::X * 0.5, Vec3::Y * 0.5, black);
    quad.at_close = Some(Affine3A::from_scale(Vec3::new(3.0, 2.0, 1.0)));
    // ∫ (1 + 2t)(1 + t) dt = 19 / 6 of a quad of 1 / 16 of the picture
    expect_grey(mean(&render(&s)), 1.0 - 19.0 / 96.0, 0.0);
}

/// A ball, a box and a quad under a sky.
fn things(side: u32) -> Scene {
    let mut s = scene(side, side, 64);
    s.environment = constant_environment(1.0);
    s.render.max_depth = 3;
    let (white, metal) = (s.diffuse(0.8), s.conductor(0.9, 0.2, Fresnel::Exact));
    s.sphere(Vec3::new(-0.8, 0.3, -4.0), 0.7, metal);
    s.quad(Vec3::new(-3.0, -1.0, -7.0), Vec3::X * 6.0, Vec3::new(0.0, 0.5, 6.0), white);
    let mesh = s.meshes.add("box", box_mesh(Vec3::new(0.2, -0.6, -4.5), Vec3::new(1.0, 0.6, -3.5), false));
    s.place(mesh, white, Affine3A::IDENTITY);
    s
}

fn move_all(s: &mut Scene, close: Affine3A) {
    s.shapes.iter_mut().for_each(|shape| shape.at_close = Some(close));
    s.instances.iter_mut().for_each(|instance| instance.at_close = Some(close));
}

/// How many pixels differ by more than noise in colour or depth: the paths are the same but for rounding, and for what is
/// drawn of the sky, which does not turn.
fn different(a: &Picture, b: &Picture) -> usize {
    let differs = |i: &usize| {
        let rgb = (0..3).any(|c| {
            let noise = (a.variance[*i][c] + b.variance[*i][c]).sqrt();
            (a.rgb[*i][c] - b.rgb[*i][c]).abs() > 3.0 * noise + 1e-3
        });
        let depth = a.depth[*i].is_finite() && (a.depth[*i] - b.depth[*i]).abs() > 0.02 * b.depth[*i];
        rgb || depth
    };
    (0..a.rgb.len()).filter(differs).count()
}

#[test]
fn a_camera_that_moves_sees_what_a_camera_sees_of_things_that_move_against_it() {
    for (way, turn) in [
        (Vec3::new(0.5, -0.2, -0.4), Quat::IDENTITY),
        (Vec3::ZERO, Quat::from_euler(EulerRot::YXZ, -0.5, 0.2, 0.3)),
    ] {
        for mirrored in [false, true] {
            let mut still = things(32);
            still.camera.mirrored = mirrored;
            let (mut camera, mut world) = (still.clone(), still.clone());
            let (target, up) = (way + turn * Vec3::NEG_Z, turn * Vec3::Y);
            camera.camera.at_close = Some(Stand { position: way, target, up });
            move_all(&mut world, Affine3A::from_rotation_translation(turn, way).inverse());
            let [camera, world, still] = [camera, world, still].map(|s| render(&s));
            let (right, wrong) = (different(&camera, &world), different(&camera, &still));
            assert!(right <= 10, "{right} pixels differ, mirrored: {mirrored}");
            assert!(wrong > 100, "of a camera that stands still, only {wrong} pixels differ");
            expect_same(mean(&camera), mean(&world), 0.0);
        }
    }
}

#[test]
fn equal_key_frames_are_no_motion() {
    let still = things(16);
    let mut s = still.clone();
    move_all(&mut s, Affine3A::IDENTITY);
    let Camera { position, target, up, .. } = s.camera;
    s.camera.at_close = Some(Stand { position, target, up });
    assert!(prepare(&s).unwrap() == prepare(&still).unwrap());
    assert!(film_of(&s, options()) == film_of(&still, options()));
    s.shapes[0].at_close = Some(shift(0.0, 0.1, 0.0));
    assert!(film_of(&s, options()) != film_of(&still, options()));
}

#[test]
fn a_moving_lamp_is_found_by_chance_and_counts_whole() {
    // A closed room of emission 1 and reflectance ρ, of which a wall moves beyond the others: Σ ρᵏ
    for kind in 0..2 {
        let mut s = scene(8, 8, 256);
        s.render.max_depth = 30;
        let emission = Some(Emission { radiance: grey(1.0), two_sided: true });
        let m = s.material(Surface::diffuse(grey(0.5)), emission);
        let close = Affine3A::from_scale_rotation_translation(
            Vec3::new(1.2, 0.9, 1.1),
            Quat::from_rotation_y(0.7),
            Vec3::new(0.2, -0.1, 0.3),
        );
        if kind == 0 {
            s.sphere(Vec3::new(0.2, 0.1, 0.3), 2.0, m);
        } else {
            let mesh =
                s.meshes.add("box", box_mesh(Vec3::new(-1.0, -0.8, -2.0), Vec3::new(1.5, 0.9, 1.5), true));
            s.place(mesh, m, Affine3A::IDENTITY);
        }
        move_all(&mut s, close);
        assert!(prepare(&s).unwrap().lights.is_empty());
        expect_grey(mean(&render(&s)), 2.0, 1e-6);
    }
}

#[test]
fn nothing_that_moves_shadows_itself() {
    let mut random = Random(5);
    let mut totals = [(0, 0); 4];
    for i in 0..48 {
        let scale = random.between(-12.0, 12.0).exp2();
        let mut turn = || {
            let [a, b, c] = [(); 3].map(|()| random.between(0.0, 6.0));
            Quat::from_euler(EulerRot::XYZ, a, b, c)
        };
        let (open, nearby) = (turn(), turn());
        let close = open.slerp(nearby, 0.4);
        let light = (open * Vec3::Z + 0.5 * random.in_cube(1.0)).normalize();
        let away = random.in_cube(4.0) * if i & 1 == 0 { 0.0 } else { 1.0 };
        let kind = i % 4;
        let mut s = scene(48, 48, 1);
        s.render.sampler = Sampler::Center;
        s.render.max_depth = 1;
        let eye = (away + 4.0 * (open * Vec3::Z + 0.5 * random.in_cube(1.0))) * scale;
        s.camera = look(eye, away * scale, 35.0);
        let irradiance = Vec3::splat(std::f32::consts::PI);
        s.lights.push(Light::distant(-light, irradiance));
        let white = s.diffuse(1.0);
        match kind {
            0 => _ = s.quad(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0, white),
            1 => _ = s.sphere(Vec3::ZERO, 1.0, white),
            2 => _ = s.disk(Vec3::ZERO, Vec3::Z, 1.0, white),
            _ => {
                let mesh = s.meshes.add("box", box_mesh(Vec3::splat(-0.5), Vec3::splat(0.5), false));
                s.place(mesh, white, Affine3A::IDENTITY);
            }
        }
        let map = |turn: Quat, by: f32, at: Vec3| {
            Affine3A::from_scale_rotation_translation(Vec3::splat(scale * by), turn, at * scale)
        };
        move_all(&mut s, map(close, 1.3, away + random.in_cube(0.5)));
        s.shapes.iter_mut().for_each(|shape| shape.world_from_object = map(open, 1.0, away));
        s.instances.iter_mut().for_each(|instance| instance.world_from_object = map(open, 1.0, away));
        let p = render(&s);
        for i in (0..p.rgb.len()).filter(|&i| p.alpha[i] > 0.0) {
            // With one sample a pixel, its normal is that of the time
            let cosine = Vec3::from(p.normal[i]).dot(light);
            if cosine > 1e-3 {
                totals[kind].1 += 1;
                totals[kind].0 += u32::from(p.rgb[i][0] < 0.5 * cosine);
            }
        }
    }
    assert!(totals.iter().all(|&(dark, lit)| dark == 0 && lit > 2_000), "dark and lit: {totals:?}");
}

#[test]
fn a_texture_of_the_users_own_sees_the_time() {
    let mut s = parallel(8, 256);
    let text = GlslTexture {
        source: "vec4 color(TextureContext c) { return vec4(c.time * c.time); }".into(),
        file: "test.glsl".into(),
        line: 1,
        parameters: Vec::new(),
        max: 1.0,
    };
    let color = Value::Texture(s.textures.add("time", Texture::Glsl(text)));
    let m = s.unlit(color);
    s.quad(Vec3::new(-2.0, -2.0, 0.3), Vec3::X * 4.0, Vec3::Y * 4.0, m);
    expect_grey(mean(&render(&s)), 1.0 / 3.0, 0.0);
}

#[test]
fn a_texture_sees_the_time() {
    // Noise in four dimensions whose w grows: the mean of pictures at single times
    let with = |w: [f32; 2], spp: u32| {
        let mut s = parallel(8, spp);
        s.render.sampler = Sampler::Center;
        let perlin = Perlin { variant: PerlinVariant::Improved, dimensions: 4 };
        let space = PatternSpace { filter_width: 0.0, ..PatternSpace::new(Coordinates::World) };
        let pattern = Noise { w, ..noise(NoiseSum::Fbm, perlin, grey(0.0), space) };
        let pattern = Value::Texture(s.textures.add("noise", Texture::Noise(pattern)));
        let m = s.unlit(pattern);
        s.quad(Vec3::new(-2.0, -2.0, 0.3), Vec3::X * 4.0, Vec3::Y * 4.0, m);
        render(&s).rgb.iter().map(|rgb| rgb[0]).collect::<Vec<_>>()
    };
    let grown = with([0.25, 1.5], 1024);
    let times = 32;
    let mut expected = vec![0.0; grown.len()];
    for k in 0..times {
        let still = with([0.25 + 1.5 * (k as f32 + 0.5) / times as f32, 0.0], 1);
        expected.iter_mut().zip(still).for_each(|(sum, value)| *sum += value / times as f32);
    }
    let most = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    let off = most(&grown, &expected);
    assert!(off < 0.012, "off by {off}");
    assert!(most(&with([0.25, 0.0], 1), &expected) > 0.03, "a pattern at one time is as good");
}
