//! `shaders/camera/panorama.glsl`, `thin_lens.glsl` and `opening.glsl`: where rays go, and how wide they become.

use crate::common::probe::{Probe, Word, as_doubles, floats};
use crate::common::random::Random;
use dapple::layout::{Backend, Frame};
use std::f64::consts::{PI, TAU};

/// A camera at (1, 2, 3) that looks along +x with y up: +z is to the right.
fn placed(half_x: f32, half_y: f32) -> Frame {
    Frame {
        camera_right: [0.0, 0.0, 1.0],
        camera_up: [0.0, 1.0, 0.0],
        camera_back: [-1.0, 0.0, 0.0],
        camera_position: [1.0, 2.0, 3.0],
        half_x,
        half_y,
        film_size: [64, 32],
        opening_half: [1.0, 1.0],
        threads: 1,
        ..Frame::default()
    }
}

const OPENINGS: &str = "#define OPENING_ROUND 0\n#define OPENING_POLYGON 1\n#define OPENING_PICTURE 2\n";

/// Origin, direction, width, spread and weight of `call` for points of the film; `u` is the point and two more numbers.
fn rays(frame: &Frame, switches: &str, call: &str, points: &[Word]) -> Vec<([f64; 4], [f64; 4], f64)> {
    let glsl = format!(
        "{OPENINGS}{switches}
        #include \"shared/bindings.glsl\"
        #define fetch_lens fetch_points
        #include \"camera/thin_lens.glsl\"
        #include \"camera/panorama.glsl\"
        void probe(uint i) {{
            vec4 u = uintBitsToFloat(fetch_points(i));
            CameraRay r = {call};
            store_values(3u * i, floatBitsToUint(vec4(r.origin, r.width)));
            store_values(3u * i + 1u, floatBitsToUint(vec4(r.direction, r.spread)));
            store_values(3u * i + 2u, floatBitsToUint(vec4(r.weight, 0.0)));
        }}"
    );
    let frame = Frame { point_count: points.len() as u32, ..*frame };
    let values = Probe::new().run_with_frame(&glsl, Backend::Storage, &frame, points, 3 * points.len());
    values.chunks(3).map(|w| (as_doubles(w[0]), as_doubles(w[1]), as_doubles(w[2])[0])).collect()
}

fn film_points() -> Vec<Word> {
    let mut random = Random(5);
    let corners = [[0.0, 0.0], [1.0, 1.0], [0.5, 0.5], [0.0, 1.0]];
    let mut points: Vec<Word> = corners.map(|[x, y]| floats(x, y, 0.3, 0.6)).to_vec();
    points.extend((0..2000).map(|_| floats(random.f32(), random.f32(), random.f32(), random.f32())));
    points
}

fn film(point: Word) -> [f64; 2] {
    let [x, y, ..] = as_doubles(point);
    [x, y]
}

/// Right, up and along the view to the world of [`placed`].
fn world([right, up, view]: [f64; 3]) -> [f64; 3] {
    [view, up, right]
}

#[track_caller]
fn near(found: &[f64], expected: [f64; 3], tolerance: f64) {
    for i in 0..3 {
        assert!((found[i] - expected[i]).abs() <= tolerance, "{found:?}, expected {expected:?}");
    }
}

#[test]
fn parallel_rays_leave_a_plane() {
    let points = film_points();
    let rays = rays(&placed(4.0, 2.0), "#define OPENING OPENING_ROUND", "orthographic_sample(u.xy)", &points);
    for (point, (origin, direction, weight)) in points.iter().zip(rays) {
        let [x, y] = film(*point);
        near(&origin, [1.0, 2.0 + 2.0 * (1.0 - 2.0 * y), 3.0 + 4.0 * (2.0 * x - 1.0)], 1e-6);
        near(&direction, [1.0, 0.0, 0.0], 0.0);
        assert_eq!((origin[3], direction[3], weight), (4.0 / 32.0, 0.0, 1.0));
    }
}

#[test]
fn longitude_goes_to_the_right_and_latitude_up() {
    let points = film_points();
    let rays =
        rays(&placed(2.0, 1.0), "#define OPENING OPENING_ROUND", "equirectangular_sample(u.xy)", &points);
    for (point, (_, direction, _)) in points.iter().zip(&rays) {
        let [x, y] = film(*point);
        let (longitude, latitude) = (TAU * (x - 0.5), PI * (0.5 - y));
        let (s, c) = latitude.sin_cos();
        near(direction, world([c * longitude.sin(), s, c * longitude.cos()]), 1e-6);
        // As large as the solid angle of the pixel, 2π/64 · π/32 · cos
        let solid = TAU / 64.0 * PI / 32.0 * c;
        assert!((direction[3] * direction[3] - solid).abs() < 1e-6, "{} {solid}", direction[3]);
    }
    // The middle looks along the view
    near(&rays[2].1, [1.0, 0.0, 0.0], 1e-7);
}

#[test]
fn fisheyes_keep_angles_or_areas() {
    let points = film_points();
    // The circle is as high as the picture, which is twice as wide
    for (equisolid, fov) in [(false, 180.0_f64), (false, 360.0), (true, 180.0), (true, 300.0), (false, 20.0)]
    {
        let half = fov.to_radians() / 2.0;
        let scale = if equisolid { (half / 2.0).sin() } else { half };
        let frame = Frame { fisheye_scale: scale as f32, ..placed(2.0, 1.0) };
        let switches = if equisolid { "#define FISHEYE_EQUISOLID 1\n" } else { "" };
        let switches = format!("{switches}#define OPENING OPENING_ROUND");
        for (point, (_, direction, weight)) in
            points.iter().zip(rays(&frame, &switches, "fisheye_sample(u.xy)", &points))
        {
            let [x, y] = film(*point);
            let [px, py] = [2.0 * (2.0 * x - 1.0), 1.0 - 2.0 * y];
            let r = px.hypot(py);
            if (r - 1.0).abs() > 1e-6 {
                assert_eq!(weight, f64::from(u8::from(r < 1.0)), "{r}");
            }
            if r >= 1.0 || r == 0.0 {
                continue;
            }
            let theta = if equisolid { 2.0 * (r * (half / 2.0).sin()).asin() } else { r * half };
            let (s, c) = theta.sin_cos();
            near(&direction, world([s * px / r, s * py / r, c]), 2e-6);
        }
    }
}

#[test]
fn rays_through_a_tilted_lens_meet_on_its_plane_of_focus() {
    // The plane n · p = d of points in front of the camera: right, up, view
    let (n, d) = ([0.3_f64, -0.8, 0.2], 1.7);
    let frame = Frame { lens_radius: 0.4, focus_plane: n.map(|x| (x / d) as f32), ..placed(1.0, 0.5) };
    let switches = "#define HAS_LENS 1\n#define FOCUS_PLANE 1\n#define OPENING OPENING_ROUND";
    let points = film_points();
    for (point, (origin, direction, _)) in
        points.iter().zip(rays(&frame, switches, "thin_lens_sample(u.xy, u.zw, vec2(0.0))", &points))
    {
        let [x, y] = film(*point);
        let through = [2.0 * x - 1.0, 0.5 * (1.0 - 2.0 * y), 1.0];
        let along: f64 = (0..3).map(|i| n[i] * through[i]).sum();
        // Where the ray through the middle of the lens meets the plane, before or behind the camera
        let target = world(through.map(|v| v * d / along));
        let from = [origin[0] - 1.0, origin[1] - 2.0, origin[2] - 3.0];
        let to: Vec<f64> = (0..3).map(|i| target[i] - from[i]).collect();
        let length = (to[0] * to[0] + to[1] * to[1] + to[2] * to[2]).sqrt() * along.signum();
        if length.abs() < 50.0 {
            near(&direction, [to[0] / length, to[1] / length, to[2] / length], 3e-5);
        }
    }
}

#[test]
fn openings_weigh_what_they_sample() {
    let mut random = Random(9);
    let points: Vec<Word> = (0..20_000)
        .map(|_| floats(random.f32(), random.f32(), 2.2 * random.f32() - 1.1, 2.2 * random.f32() - 1.1))
        .collect();
    let cells: Vec<Word> =
        vec![[0.4_f32.to_bits(), 1, 0.5_f32.to_bits(), 0], [1.0_f32.to_bits(), 1, 2.0_f32.to_bits(), 0]];
    for (shape, half) in
        [("ROUND", [1.0, 0.5]), ("POLYGON", [1.0, 1.0]), ("POLYGON", [0.5, 1.0]), ("PICTURE", [1.0, 1.0])]
    {
        let glsl = format!(
            "{OPENINGS}#define OPENING OPENING_{shape}
            #include \"shared/bindings.glsl\"
            #define fetch_lens fetch_points
            #include \"camera/opening.glsl\"
            void probe(uint i) {{
                vec4 u = uintBitsToFloat(fetch_points(i + 2u));
                vec2 p = opening_sample(u.xy, 0.5 * u.zw + 0.5);
                store_values(i, floatBitsToUint(vec4(p, opening_weight(0.9999 * p), opening_weight(u.zw))));
            }}"
        );
        let frame = Frame {
            blades: 5,
            blade_rotation: 0.7,
            opening_half: half,
            opening_size: [2, 1],
            point_count: points.len() as u32,
            ..placed(1.0, 1.0)
        };
        let inputs: Vec<Word> = cells.iter().chain(&points).copied().collect();
        let values = Probe::new().run_with_frame(&glsl, Backend::Storage, &frame, &inputs, points.len());
        let mut mean = 0.0;
        for (value, point) in values.iter().zip(&points) {
            let [x, y, inside, weight] = as_doubles(*value);
            assert!(inside > 0.0, "{shape}: {x} {y} is sampled and lets nothing through");
            assert!(x.abs() <= f64::from(half[0]) * 1.000_01 && y.abs() <= f64::from(half[1]) * 1.000_01);
            if shape == "PICTURE" {
                assert_eq!(inside, if x < 0.0 { 0.5 } else { 2.0 }, "{x}");
            }
            let [.., px, py] = as_doubles(*point);
            if px.abs() > 1.0 || py.abs() > 1.0 {
                assert_eq!(weight, 0.0, "{shape}");
            }
            mean += weight / points.len() as f64;
        }
        // The mean over the square of side 2.2 is the area of the shape, times its weight
        let area = match shape {
            "ROUND" => PI * 0.5,
            "POLYGON" => 2.5 * (TAU / 5.0).sin() * f64::from(half[0]),
            _ => 2.0 * 0.5 + 2.0 * 2.0,
        };
        assert!((mean * 4.84 / area - 1.0).abs() < 0.03, "{shape}: {} {area}", mean * 4.84);
    }
}

#[test]
fn cones_are_as_wide_as_a_pixel() {
    // Two points of the film, a pixel apart, near the middle
    let points = [floats(0.5, 0.5, 0.0, 0.0), floats(0.5, 0.5 + 1.0 / 32.0, 0.0, 0.0)];
    let round = "#define OPENING OPENING_ROUND";
    let equisolid = format!("#define FISHEYE_EQUISOLID 1\n{round}");
    for (switches, call, half_y, scale) in [
        (round, "thin_lens_sample(u.xy, vec2(0.0), vec2(0.0))", 0.3, 0.0),
        (round, "fisheye_sample(u.xy)", 1.0, 1.5),
        (equisolid.as_str(), "fisheye_sample(u.xy)", 1.0, 0.7),
    ] {
        let frame = Frame { fisheye_scale: scale, ..placed(2.0 * half_y, half_y) };
        let rays = rays(&frame, switches, call, &points);
        let dot: f64 = (0..3).map(|i| rays[0].1[i] * rays[1].1[i]).sum();
        let angle = dot.min(1.0).acos();
        assert!((rays[0].1[3] / angle - 1.0).abs() < 0.01, "{call}: {} {angle}", rays[0].1[3]);
        assert_eq!(rays[0].0[3], 0.0);
    }
}
