//! Lenses of several elements: the table of `../shared/formulas.md` C.8, and pictures through them.

use crate::common::references;
use crate::common::render::*;
use dapple::import::{Spacing, read_lens};
use dapple::prepare::lens::{Glass, INVERSE_SQUARES, LensRay, LensTrace};
use dapple::scene::*;
use glam::{DVec3, Vec3};

/// The lenses that pbrt's scenes use, where this machine has them.
fn reference_lens(name: &str) -> Option<LensSystem> {
    let folder = references::folder().unwrap()?;
    Some(
        read_lens(&folder.join("lenses").join(name), Spacing::Detect)
            .unwrap_or_else(|error| panic!("{error}")),
    )
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-4 * expected.abs(), "{found}, expected {expected}");
}

#[test]
fn the_table_of_four_lenses() {
    // Focal length, back focal distance, H, H′, length, entrance pupil and its diameter, f-number, exit pupil and its diameter,
    // film when focused at 10 m and 1 m
    let table = [
        (
            "dgauss.50mm.dat",
            [
                50.3582, 36.1059, 23.2357, -14.2523, 32.0400, 19.9465, 24.8051, 2.030, -17.7714, 26.5385,
                36.36195, 38.91762,
            ],
        ),
        (
            "wide.22mm.dat",
            [
                22.0235, 14.3183, 15.2936, -7.7052, 33.3711, 12.0887, 8.2060, 2.684, -11.4559, 9.6035,
                14.36703, 14.83149,
            ],
        ),
        (
            "fisheye.10mm.dat",
            [
                9.9914, 23.1605, 17.9563, 13.1691, 33.4461, 11.5424, 2.5316, 3.947, -4.7439, 7.0704,
                23.17057, 23.26548,
            ],
        ),
        (
            "telephoto.250mm.dat",
            [
                249.5666, 105.0704, -83.1359, -144.4962, 102.7800, 15.2865, 46.0163, 5.423, -73.9108,
                33.0014, 111.65925, 329.68034,
            ],
        ),
    ];
    for (name, row) in table {
        let Some(system) = reference_lens(name) else { return };
        let lens = Paraxial::of(&system).unwrap();
        let (entrance, exit) = (lens.entrance_pupil(), lens.exit_pupil());
        let found = [
            lens.focal_length,
            lens.back_focal_distance,
            lens.front_principal,
            lens.rear_principal,
            lens.length,
            entrance.position,
            entrance.diameter,
            lens.f_number(),
            exit.position,
            exit.diameter,
            lens.focus(10_000.0).unwrap(),
        ];
        for (found, expected) in found.into_iter().zip(row) {
            near(found, expected);
        }
        // The least distance from film to object of the telephoto, 4 f and what is between its principal planes, is 1.04 m; the
        // number that the table has for 1 m belongs to 1.0425 m
        match lens.focus(1000.0) {
            Some(film) => near(film, row[11]),
            None => {
                assert_eq!(name, "telephoto.250mm.dat");
                near(lens.nearest_focus(), 1039.69);
            }
        }
    }
}

#[test]
fn rays_from_infinity_show_spherical_aberration() {
    // Height of a ray along the axis, and where it crosses the axis behind the last vertex; 0 = blocked
    type Rows = &'static [(f64, f64)];
    let table: [(&str, Rows); 4] = [
        (
            "dgauss.50mm.dat",
            &[
                (1e-3, 36.1059),
                (1.0, 36.1037),
                (2.0, 36.0972),
                (4.0, 36.0747),
                (6.0, 36.05),
                (8.0, 36.0439),
                (10.0, 36.0899),
                (12.0, 36.2339),
            ],
        ),
        ("telephoto.250mm.dat", &[(1.0, 105.0663), (4.0, 105.006), (8.0, 104.8238), (12.0, 104.5598)]),
        ("wide.22mm.dat", &[(1.0, 14.2909), (2.0, 14.2194), (4.0, 0.0)]),
        ("fisheye.10mm.dat", &[(1.0, 22.9616), (2.0, 0.0)]),
    ];
    for (name, rows) in table {
        let Some(system) = reference_lens(name) else { return };
        let trace = LensTrace::new(&system, 50.0, None, Glass::LineD);
        for &(height, expected) in rows {
            let parallel = LensRay { origin: DVec3::new(height, 0.0, 1000.0), direction: -DVec3::Z };
            match trace.to_film(parallel) {
                None => assert_eq!(expected, 0.0, "{name} {height}"),
                Some(ray) => {
                    let crossing = ray.origin.z - ray.origin.x * ray.direction.z / ray.direction.x;
                    near(50.0 - crossing, expected);
                }
            }
        }
    }
}

#[test]
fn both_dialects_of_a_real_file_are_one_lens() {
    let Some(folder) = references::folder().unwrap() else { return };
    for name in ["dgauss.50mm.dat", "wide.22mm.dat", "fisheye.10mm.dat", "telephoto.250mm.dat"] {
        let file = folder.join("lenses").join(name);
        let text = String::from_utf8_lossy(&std::fs::read(&file).unwrap()).into_owned();
        let rows: Vec<Vec<&str>> = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.trim().is_empty())
            .map(|line| line.split_whitespace().collect())
            .collect();
        let mut before = "0";
        let mut shifted = String::new();
        for row in &rows {
            shifted += &format!("{}\t{before}\t{}\t{}\n", row[0], row[2], row[3]);
            before = row[1];
        }
        let other = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(other.path(), shifted).unwrap();
        let both = [&file, &other.path().to_path_buf()]
            .map(|path| read_lens(path, Spacing::Detect).unwrap().interfaces);
        assert_eq!(both[0], both[1], "{name}");
        assert!(!read_lens(&file, Spacing::Detect).unwrap().notes.is_empty(), "{name}");
    }
}

/// A biconvex lens of f = 50 mm that is wide, with a stop behind it: the stop is its own exit pupil.
fn stop_behind(radius: f64) -> LensSystem {
    let row =
        |radius, thickness, index, abbe, aperture| LensInterface { radius, thickness, index, abbe, aperture };
    let interfaces = vec![
        row(51.0, 4.0, 1.5, Some(40.0), 90.0),
        row(-51.0, 1.0, 1.0, None, 90.0),
        row(0.0, 0.0, 1.0, None, 2.0 * radius),
    ];
    LensSystem { notes: Vec::new(), interfaces }
}

fn through(system: LensSystem, change: impl FnOnce(&mut LensCamera)) -> Scene {
    let mut s = scene(12, 12, 4096);
    let stop_diameter = Paraxial::of(&system).unwrap().stop_diameter;
    let mut camera = LensCamera {
        system,
        stop_diameter,
        focus_distance: 5.0,
        opening: Opening::default(),
        sensor_diagonal: 0.06,
        unit: 1000.0,
        dispersion: false,
        measure: Measure::Radiance,
    };
    change(&mut camera);
    s.camera.projection = Projection::Lens(Box::new(camera));
    s.environment = constant_environment(1.0);
    s
}

/// Irradiance from a disk of radius `r` at distance `z` that shines with radiance 1, at `off` from its axis on a parallel plane
/// (form factor of a parallel disk; Howell's catalogue, B-12).
fn disk_irradiance(r: f64, z: f64, off: f64) -> f64 {
    let sum = r * r + off * off + z * z;
    let root = (sum * sum - 4.0 * r * r * off * off).sqrt();
    0.5 * std::f64::consts::PI * (1.0 + (r * r - off * off - z * z) / root)
}

#[test]
fn a_uniform_scene_falls_off_as_the_disk_of_the_stop() {
    for (radius, shape) in
        [(10.0, Opening::default()), (2.0, Opening { blades: 6, anamorphic: 2.0, ..Opening::default() })]
    {
        let round = shape.blades == 0;
        for measure in [Measure::Irradiance, Measure::Radiance] {
            let mut distance = 0.0;
            let s = through(stop_behind(radius), |camera| {
                (camera.measure, camera.opening) = (measure, shape);
                distance = camera.film_distance().unwrap();
            });
            let p = render(&s);
            let middle = disk_irradiance(radius, distance, 0.0);
            for (x, y) in [(5, 5), (6, 6), (0, 0), (11, 2), (2, 8), (11, 11)] {
                // 60 mm of diagonal
                let at = |i: usize, part: f64| ((i as f64 + part) / 12.0 - 0.5) * 60.0 / 2_f64.sqrt();
                let mean_of_pixel =
                    |f: &dyn Fn(f64) -> f64| integrate_square(8, |u, v| f(at(x, u).hypot(at(y, v))));
                // It and its mirror images
                let both = [[x, y], [y, x]];
                let alike =
                    both.iter().flat_map(|[x, y]| [[*x, *y], [11 - x, *y], [*x, 11 - y], [11 - x, 11 - y]]);
                let found = mean_of(&p, alike.map(|[x, y]| y * 12 + x));
                let factor = if measure == Measure::Radiance { middle } else { 1.0 };
                // A shape that is no circle but as bright is the same where it is small
                let exact = mean_of_pixel(&|off| disk_irradiance(radius, distance, off));
                expect_grey(found, exact / factor, if round { 0.0 } else { 0.005 });
                // cos⁴ holds where the stop is small
                if radius < 3.0 {
                    let falloff = mean_of_pixel(&|off| (distance / distance.hypot(off)).powi(4));
                    expect_grey(found, falloff * middle / factor, 0.005);
                }
            }
        }
    }
}

#[test]
fn one_colour_a_path_keeps_the_mean() {
    let s = through(stop_behind(5.0), |camera| camera.dispersion = true);
    let p = render(&s);
    let middle = [4, 5, 6, 7].into_iter().flat_map(|y| [4, 5, 6, 7].map(|x| y * 12 + x));
    // It falls off by 2 % at their corners
    expect_mean(mean_of(&p, middle), [1.0; 3], 0.02);
    assert!(p.rgb.iter().any(|c| c[0] != c[1]), "colours are drawn one by one");
}

#[test]
fn colours_focus_where_cauchys_index_says() {
    let system = stop_behind(10.0);
    for inverse_square in INVERSE_SQUARES {
        // n_d = 1.5, V = 40: B = 0.5 / (40 (λ_F⁻² − λ_C⁻²)) with the wavelengths in micrometres
        let b = 0.5 / (40.0 * (0.486_132_7_f64.powi(-2) - 0.656_272_5_f64.powi(-2)));
        let n = 1.5 + b * (inverse_square - 0.587_561_8_f64.powi(-2));
        let power = (n - 1.0) * (2.0 / 51.0 - (n - 1.0) * 4.0 / (n * 51.0 * 51.0));
        let back = 1.0 / power * (1.0 - (n - 1.0) * 4.0 / (n * 51.0));
        let trace = LensTrace::new(&system, 60.0, None, Glass::At(inverse_square));
        let ray =
            trace.to_film(LensRay { origin: DVec3::new(0.01, 0.0, 90.0), direction: -DVec3::Z }).unwrap();
        let crossing = ray.origin.z - ray.origin.x * ray.direction.z / ray.direction.x;
        // The stop is 1 mm behind the lens
        let found = 60.0 - crossing + 1.0;
        assert!((found - back).abs() < 1e-5 * back, "{found}, expected {back}");
    }
}

#[test]
fn what_is_in_focus_is_sharp_and_on_the_right_pixel() {
    // A small ball at the distance of focus, off the axis by a third of the half-height of the picture: on the edge of two pixels
    for distance in [1.0_f32, 10.0] {
        let mut film = 0.0;
        let mut s = through(stop_behind(1.5), |camera| {
            camera.focus_distance = distance;
            film = camera.film_distance().unwrap();
        });
        s.environment = None;
        let m = s.unlit(grey(1.0));
        let lens = Paraxial::of(&stop_behind(1.5)).unwrap();
        // Between the principal planes the image is as many times as large as it is farther away
        let (image, object) = (
            film - lens.rear_principal,
            f64::from(distance) * 1e3 - lens.length - film + lens.front_principal,
        );
        let half = 30.0 / 2_f64.sqrt() * 1e-3;
        let y = half / 3.0 * object / image;
        s.sphere(Vec3::new(0.0, y as f32, -distance), 0.05 * (y as f32), m);
        let p = render(&s);
        let sum: f64 = p.rgb.iter().map(|c| f64::from(c[0])).sum();
        let rows = p.rgb.iter().enumerate().map(|(i, c)| (i / 12) as f64 * f64::from(c[0]));
        let row = rows.sum::<f64>() / sum + 0.5;
        assert!((row - 4.0).abs() < 0.2, "{row}");
        let lit = p.rgb.iter().filter(|c| c[0] > 0.0005).count();
        assert!((1..=4).contains(&lit), "{lit} pixels");
    }
}

#[test]
fn a_lens_that_cannot_focus_is_refused() {
    let s = through(stop_behind(1.5), |camera| camera.focus_distance = 0.1);
    let error = dapple::prepare::prepare(&s).unwrap_err().to_string();
    assert!(
        error.starts_with("the lens cannot focus on 0.1 in front of the film, only from 0.20"),
        "{error}"
    );
}
