//! What the camera does: projection, depth of field, samplers and filters.

use crate::common::render::*;
use dapple::film::Picture;
use dapple::scene::*;
use glam::Vec3;

/// Mean position and spread of the light in a picture, in pixels: centre x and y, mean squared distance, sum.
fn moments(p: &Picture, width: usize) -> (f64, f64, f64, f64) {
    let sum: f64 = p.rgb.iter().map(|c| f64::from(c[1])).sum();
    let mean = |f: &dyn Fn(f64, f64) -> f64| {
        let each = |(i, c): (usize, &[f32; 3])| {
            f((i % width) as f64 + 0.5, (i / width) as f64 + 0.5) * f64::from(c[1])
        };
        p.rgb.iter().enumerate().map(each).sum::<f64>() / sum
    };
    let (x, y) = (mean(&|x, _| x), mean(&|_, y| y));
    (x, y, mean(&|a, b| (a - x).powi(2) + (b - y).powi(2)), sum)
}

#[test]
fn a_known_point_falls_on_the_right_pixel() {
    for (axis, width, height) in [
        (FovAxis::Vertical, 40, 20),
        (FovAxis::Horizontal, 40, 20),
        (FovAxis::Smaller, 40, 20),
        (FovAxis::Smaller, 20, 40),
    ] {
        for mirrored in [false, true] {
            let mut s = scene(width, height, 2048);
            s.camera = look(Vec3::new(1.0, 2.0, 3.0), Vec3::new(-1.0, 1.0, -4.0), 60.0);
            s.camera.projection =
                Projection::Perspective(Perspective { fov: 60.0, fov_axis: axis, lens: None });
            s.camera.mirrored = mirrored;
            let m = s.unlit(grey(1.0));
            let back = (s.camera.position - s.camera.target).normalize();
            let right = Vec3::Y.cross(back).normalize();
            let up = back.cross(right);
            // A small ball at (0.3, −0.2) of tan 30° of the spanned side, at depth 5
            let t = 30_f32.to_radians().tan();
            let (a, b) = (0.3 * t, -0.2 * t);
            s.sphere(s.camera.position + (right * a + up * b - back) * 5.0, 0.1, m);
            let side = match axis {
                FovAxis::Vertical => height,
                FovAxis::Horizontal => width,
                FovAxis::Smaller => width.min(height),
            };
            let (x, y, _, sum) = moments(&render(&s), width as usize);
            assert!(sum > 0.0);
            let half = f64::from(side) / 2.0;
            let sign = if mirrored { -1.0 } else { 1.0 };
            let (ex, ey) = (f64::from(width) / 2.0 + sign * 0.3 * half, f64::from(height) / 2.0 + 0.2 * half);
            assert!((x - ex).abs() < 0.05 && (y - ey).abs() < 0.05, "{axis:?}: {x} {y}, expected {ex} {ey}");
        }
    }
}

fn lens(radius: f32, focus_distance: f32, blades: u32, blade_rotation: f32) -> Option<Lens> {
    let mut lens = Lens::new(Aperture::Radius(radius), focus_distance);
    (lens.opening.blades, lens.opening.blade_rotation) = (blades, blade_rotation);
    Some(lens)
}

/// Radius of the disk of `through_lens` on the film, in pixels.
const SPOT: f64 = 1.92;

/// A small disk at `at`, which is as large from everywhere on the lens, through a lens: 32 × 32 pixels that span ±0.5 at distance 1.
fn through_lens(at: Vec3, lens: Option<Lens>) -> Picture {
    let mut s = scene(32, 32, 4096);
    let fov = 2.0 * 0.5_f32.atan().to_degrees();
    s.camera.projection = Projection::Perspective(Perspective { fov, fov_axis: FovAxis::Vertical, lens });
    let m = s.unlit(grey(1.0));
    s.disk(at, Vec3::Z, SPOT as f32 / 32.0 * -at.z, m);
    render(&s)
}

#[test]
fn circle_of_confusion() {
    for (z, focus, radius) in [(4.0_f32, 2.0, 0.5), (2.0, 5.0, 0.6), (10.0, 3.0, 0.7)] {
        let p = through_lens(Vec3::new(0.0, 0.0, -z), lens(radius, focus, 0, 0.0));
        // A disk of radius R |z − f| / (z f) at distance 1, evenly lit: mean squared distance is half of that squared
        let coc = f64::from(radius * (z - focus).abs() / (z * focus)) * 32.0;
        let (x, y, spread, _) = moments(&p, 32);
        // The disk itself adds half of its radius squared, and pixels 1/6
        let expected = coc * coc / 2.0 + SPOT * SPOT / 2.0 + 1.0 / 6.0;
        assert!((x - 16.0).abs() < 0.1 && (y - 16.0).abs() < 0.1, "{x} {y}");
        assert!((spread / expected - 1.0).abs() < 0.02, "spread {spread}, expected {expected}");
        let lit = |i: usize| p.rgb[i][1] > 0.0;
        let far = (0..1024)
            .filter(|&i| lit(i))
            .map(|i| ((i % 32) as f64 - 15.5).hypot((i / 32) as f64 - 15.5))
            .fold(0.0, f64::max);
        assert!((far - coc - SPOT).abs() < 0.9, "edge at {far}, expected {coc}");
    }
}

#[test]
fn blades_make_a_polygon() {
    for (blades, rotation) in [(3, 0.0_f32), (5, 20.0), (6, 0.0)] {
        let p = through_lens(Vec3::new(0.0, 0.0, -4.0), lens(0.8, 2.0, blades, rotation));
        // The polygon on the lens is seen on the film turned by 180° behind the focus, 6.4 pixels wide
        let coc = 0.8 * 2.0 / 8.0 * 32.0;
        let n = f64::from(blades);
        let (_, _, spread, _) = moments(&p, 32);
        // Second moment of a regular polygon about its centre: R²/6 · (2 + cos 2π/n)
        let expected =
            coc * coc / 6.0 * (2.0 + (std::f64::consts::TAU / n).cos()) + SPOT * SPOT / 2.0 + 1.0 / 6.0;
        assert!((spread / expected - 1.0).abs() < 0.02, "{blades} blades: {spread}, expected {expected}");
        // The farthest light is at the corners: at angle `rotation` on the lens, on the other side in the picture
        let corner = (0..1024)
            .filter(|&i| p.rgb[i][1] > 0.0)
            .map(|i| ((i % 32) as f64 - 15.5, 15.5 - (i / 32) as f64))
            .max_by(|a, b| a.0.hypot(a.1).total_cmp(&b.0.hypot(b.1)))
            .unwrap();
        let turn = (corner.1.atan2(corner.0).to_degrees() - f64::from(rotation)) / (360.0 / n);
        // Behind the plane of focus the image of a lens point lies on its own side: 0 turns off, or a corner's
        assert!((turn - turn.round()).abs() < 0.1 || n == 6.0, "{blades} blades: a corner at {corner:?}");
    }
}

#[test]
fn f_number_is_a_radius() {
    let number = Aperture::FNumber { number: 1.4, sensor_height: 0.5 };
    let with = |aperture| through_lens(Vec3::new(0.0, 0.0, -4.0), Some(Lens::new(aperture, 2.0)));
    // Focal length 0.5 / (2 · 0.5) = 0.5, so the radius is 0.5 / 2.8
    assert_eq!(with(number).rgb, with(Aperture::Radius(0.5 / 2.8)).rgb);
}

#[test]
fn the_plane_of_focus_is_sharp_to_the_corner() {
    // Black and white halves on the plane of focus: with and without a lens the same, but for pixels on the border
    let with = |lens| {
        let mut s = scene(16, 16, 64);
        let (fov, fov_axis) = (90.0, FovAxis::Vertical);
        s.camera.projection = Projection::Perspective(Perspective { fov, fov_axis, lens });
        let (white, black) = (s.unlit(grey(1.0)), s.unlit(grey(0.0)));
        s.quad(Vec3::new(1.3, -9.0, -3.0), Vec3::X * 9.0, Vec3::Y * 18.0, white);
        s.quad(Vec3::new(-9.0, -9.0, -3.0), Vec3::X * 10.3, Vec3::Y * 18.0, black);
        render(&s)
    };
    let (sharp, lens) = (with(None), with(lens(0.7, 3.0, 0, 0.0)));
    for i in 0..256 {
        // 1.3 / 3 of the half-width is column 11.47
        if i % 16 != 11 {
            assert_eq!(sharp.rgb[i], lens.rgb[i], "pixel {i}");
        }
    }
    assert!(sharp.rgb.iter().any(|c| c[0] == 1.0) && sharp.rgb.iter().any(|c| c[0] == 0.0));
}

/// A slanted edge between black and white: the part of a pixel that is white is known.
fn edge(sampler: Sampler, spp: u32, seed: u32) -> (Picture, Vec<f64>) {
    let mut s = scene(16, 16, spp);
    (s.render.sampler, s.render.seed, s.render.strata) = (sampler, seed, [8, 8]);
    let white = s.unlit(grey(1.0));
    // White right of the line x = 0.3 y at z = −1
    let mesh = Mesh {
        positions: vec![Vec3::new(-0.9, -3.0, -1.0), Vec3::new(9.0, 0.0, -1.0), Vec3::new(0.9, 3.0, -1.0)],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    let mesh = s.meshes.add("half", mesh);
    s.place(mesh, white, glam::Affine3A::IDENTITY);
    let part = |i: u32| {
        let (px, py) = (f64::from(i % 16) / 8.0 - 1.0, 1.0 - f64::from(i / 16) / 8.0);
        // Mean over y of the clamped part right of the line
        let n = 4000;
        (0..n)
            .map(|k| {
                let y = py - (f64::from(k) + 0.5) / f64::from(n) / 8.0;
                (1.0 - (0.3 * y - px) * 8.0).clamp(0.0, 1.0)
            })
            .sum::<f64>()
            / f64::from(n)
    };
    (render(&s), (0..256).map(part).collect())
}

#[test]
fn samplers_agree_on_the_mean_and_differ_in_noise() {
    let error = |sampler| {
        let mut sum = 0.0;
        for seed in 0..4 {
            let (p, truth) = edge(sampler, 64, seed);
            sum += p.rgb.iter().zip(&truth).map(|(c, t)| (f64::from(c[0]) - t).powi(2)).sum::<f64>();
        }
        (sum / 1024.0).sqrt()
    };
    let (random, stratified, sobol) =
        (error(Sampler::Random), error(Sampler::Stratified), error(Sampler::Sobol));
    eprintln!("random {random:.5}, stratified {stratified:.5}, sobol {sobol:.5}");
    // Pixels off the edge have no error; on it √(p (1 − p) / 64) is about 0.05
    assert!(random > 0.01 && random < 0.05, "{random}");
    assert!(stratified < 0.5 * random, "{stratified} {random}");
    assert!(sobol < 0.5 * random, "{sobol} {random}");
    for sampler in [Sampler::Random, Sampler::Stratified, Sampler::Sobol] {
        let (p, truth) = edge(sampler, 1024, 9);
        let expected = truth.iter().sum::<f64>() / 256.0;
        expect_grey(mean(&p), expected, 1e-5);
    }
}

#[test]
fn center_and_regular_samples_are_where_they_should_be() {
    let (p, _) = edge(Sampler::Center, 3, 0);
    for i in 0..256_u32 {
        let (x, y) = ((f64::from(i % 16) + 0.5) / 8.0 - 1.0, 1.0 - (f64::from(i / 16) + 0.5) / 8.0);
        assert_eq!(p.rgb[i as usize][0], if x > 0.3 * y { 1.0 } else { 0.0 }, "pixel {i}");
    }
    let (p, _) = edge(Sampler::Regular, 64, 0);
    for i in 0..256_u32 {
        let mut white = 0;
        for k in 0..64 {
            let (fx, fy) = ((f64::from(k % 8) + 0.5) / 8.0, (f64::from(k / 8) + 0.5) / 8.0);
            let (x, y) = ((f64::from(i % 16) + fx) / 8.0 - 1.0, 1.0 - (f64::from(i / 16) + fy) / 8.0);
            white += u32::from(x > 0.3 * y);
        }
        assert!((f64::from(p.rgb[i as usize][0]) * 64.0 - f64::from(white)).abs() < 1e-3, "pixel {i}");
    }
}

#[test]
fn filters_keep_a_constant_and_show_their_profile() {
    type Profile = fn(f64) -> f64;
    let cases: [(FilterKind, f32, Profile); 6] = [
        (FilterKind::Box, 1.0, |_| 1.0),
        (FilterKind::Tent, 2.0, |x| 1.0 - x.abs()),
        (FilterKind::Gaussian, 1.5, |x| (-4.5 * x * x).exp() - (-4.5_f64).exp()),
        (FilterKind::BlackmanHarris, 2.0, |x| {
            let t = std::f64::consts::PI * (x + 1.0);
            0.35875 - 0.48829 * t.cos() + 0.14128 * (2.0 * t).cos() - 0.01168 * (3.0 * t).cos()
        }),
        (FilterKind::Mitchell { b: 1.0 / 3.0, c: 1.0 / 3.0 }, 2.0, |x| {
            let x = 2.0 * x.abs();
            if x < 1.0 {
                7.0 * x.powi(3) - 12.0 * x * x + 16.0 / 3.0
            } else {
                (x - 2.0).powi(2) * (8.0 - 7.0 * x) / 3.0
            }
        }),
        (FilterKind::Sinc { tau: 3.0 }, 4.0, |x| {
            let angle = 4.0 * std::f64::consts::PI * x.abs().max(1e-9);
            angle.sin() / angle * (angle / 3.0).sin() / (angle / 3.0)
        }),
    ];
    for (kind, radius, profile) in cases {
        let mut s = scene(9, 9, 4096);
        s.film.filter = Filter { kind, radius };
        let m = s.unlit(grey(1.0));
        // An impulse: a tiny square in the middle of the middle pixel, 0.1 pixels wide
        let w = 0.1 * 2.0 / 9.0;
        s.quad(Vec3::new(-w / 2.0, -w / 2.0, -1.0), Vec3::X * w, Vec3::Y * w, m);
        s.render.sampler = Sampler::Sobol;
        let p = render(&s);
        let r = f64::from(radius);
        let n = 2000;
        let at = |k: i32| (f64::from(k) + 0.5) / f64::from(n) * 2.0 - 1.0;
        let whole: f64 = (0..n).map(|k| profile(at(k))).sum::<f64>() * 2.0 / f64::from(n) * r;
        let magnitude =
            ((0..n).map(|k| profile(at(k)).abs()).sum::<f64>() * 2.0 / f64::from(n) * r / whole).powi(2);
        // Weight of the impulse in a pixel whose centre is `d` pixels away along one axis
        let weight = |d: f64| {
            let each = |k: i32| {
                let x = (d + 0.1 * ((f64::from(k) + 0.5) / 20.0 - 0.5)) / r;
                if x.abs() < 1.0 { profile(x) } else { 0.0 }
            };
            (0..20).map(each).sum::<f64>() / 20.0 * 0.1 / whole
        };
        for i in 0..81 {
            let (dx, dy) = (f64::from(i % 9 - 4), f64::from(i / 9 - 4));
            let expected = weight(dx) * weight(dy);
            let measured = mean_of(&p, [i as usize]);
            let off = (measured.mean[0] - expected).abs();
            // Counts of 4096 samples: a pixel that expects a few of them may see none, so the error is that of the expected count.
            // Samples of a filter that is negative in places weigh more than 1
            let error = (magnitude * expected.abs() / 4096.0).sqrt();
            assert!(
                off <= 4.0 * error + 1e-9,
                "{kind:?}, pixel {dx} {dy}: {measured:?}, expected {expected}"
            );
        }
        let mut s = scene(8, 8, 16);
        s.film.filter = Filter { kind, radius };
        s.environment = constant_environment(1.0);
        if magnitude < 1.0 + 1e-9 {
            expect_every_pixel(&render(&s), [1.0; 3], 0.0);
        } else {
            // Each sample is more than 1, up or down
            let p = render(&s);
            let mean = mean_of(&p, 0..64);
            assert!((mean.mean[0] - 1.0).abs() <= 4.0 * mean.error[0], "{kind:?}: {mean:?}");
            assert!(mean.error[0] > 0.0);
        }
    }
}

/// Overlap of two circles of radius 1 whose centres are `d` apart, in parts of one.
fn overlap(d: f64) -> f64 {
    if d >= 2.0 {
        0.0
    } else {
        (2.0 * (d / 2.0).acos() - d / 2.0 * (4.0 - d * d).sqrt()) / std::f64::consts::PI
    }
}

#[test]
fn cats_eyes_are_where_two_circles_overlap() {
    let mut s = scene(16, 16, 8192);
    let mut lens = Lens::new(Aperture::Radius(0.1), 1e6);
    lens.cat_eye = 1.2;
    s.camera.projection = Projection::thin_lens(90.0, lens);
    s.environment = constant_environment(1.0);
    let p = render(&s);
    for (x, y) in [(8, 8), (12, 8), (3, 8), (8, 1), (12, 12), (13, 13)] {
        let at = |i: usize, part: f64| (i as f64 + part) / 8.0 - 1.0;
        let expected = integrate_square(16, |u, v| overlap(1.2 * at(x, u).hypot(at(y, v))));
        // It and its mirror images
        let both = [[x, y], [y, x]];
        let alike = both.iter().flat_map(|[x, y]| [[*x, *y], [15 - x, *y], [*x, 15 - y], [15 - x, 15 - y]]);
        expect_grey(mean_of(&p, alike.map(|[x, y]| y * 16 + x)), expected, 0.001);
    }
}

#[test]
fn a_picture_of_the_opening_is_seen_in_the_blur() {
    // White on the left or on top. Behind the plane of focus the blur is seen as the lens is from behind.
    for (texels, horizontal) in [([255, 0, 255, 0], true), ([255, 255, 0, 0], false)] {
        let texels = Texels::Rgba8(texels.map(|v| [v, v, v, 255]).to_vec());
        let mut s = scene(32, 32, 4096);
        let image = s.images.add("opening", Image { width: 2, height: 2, texels });
        let mut lens = Lens::new(Aperture::Radius(0.8), 2.0);
        lens.opening = Opening { image: Some(image), anamorphic: 2.0, ..Opening::default() };
        s.camera.projection = Projection::thin_lens(2.0 * 0.5_f32.atan().to_degrees(), lens);
        let m = s.unlit(grey(1.0));
        s.disk(Vec3::new(0.0, 0.0, -4.0), Vec3::Z, 0.24, m);
        let (x, y, ..) = moments(&render(&s), 32);
        // Half of the blur's 6.4 pixels, and of the half width that the ratio leaves
        let expected = if horizontal { (16.0 - 1.6, 16.0) } else { (16.0, 16.0 - 3.2) };
        assert!(
            (x - expected.0).abs() < 0.1 && (y - expected.1).abs() < 0.1,
            "{x} {y}, expected {expected:?}"
        );
    }
}
