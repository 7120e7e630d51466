//! A lens cut along its axis, with fans of rays, as SVG. The scene is on the left, the film on the right.

use dapple::prepare::lens::{Glass, LensRay, LensTrace};
use dapple::scene::{LensSystem, Paraxial};
use glam::DVec3;
use std::fmt::Write;

/// Width of the drawing in pixels, and its border.
const WIDTH: f64 = 1000.0;
const BORDER: f64 = 20.0;
/// Rays of a fan, and how many are tried to find its ends.
const FAN: u32 = 9;
const TRIED: u32 = 2000;
/// Height of the film that the drawing shows: that of full frame from the middle to the corner, in millimetres.
const FILM: f64 = 21.6;
/// Points of the outline of a surface.
const OUTLINE: u32 = 24;

/// From millimetres to pixels: z is the distance from the film, y is up.
struct Page {
    scale: f64,
    left: f64,
    middle: f64,
}

impl Page {
    fn point(&self, z: f64, y: f64) -> String {
        format!("{:.2},{:.2}", (self.left - z) * self.scale + BORDER, self.middle - y * self.scale)
    }
}

/// The drawing of a lens that is `film` millimetres from the film.
pub fn drawing(system: &LensSystem, lens: &Paraxial, film: f64) -> String {
    let stop = (lens.stop.interface, 0.5 * lens.stop_diameter);
    let trace = LensTrace::new(system, film, Some(stop), Glass::LineD);
    let highest =
        system.interfaces.iter().map(|i| 0.5 * i.aperture).fold(FILM.min(0.5 * lens.focal_length), f64::max);
    let left = film + lens.length + (0.4 * (film + lens.length)).max(highest);
    let scale = (WIDTH - 2.0 * BORDER) / left;
    let middle = BORDER + 1.15 * highest * scale;
    let page = Page { scale, left, middle };

    let mut out = String::new();
    _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH:.0}\" height=\"{:.0}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>",
        2.0 * middle
    );
    _ = writeln!(out, "<title>f = {:.2} mm, f/{:.2}</title>", lens.focal_length, lens.f_number());
    glass(&mut out, &page, system, film);
    line(&mut out, &page, [(0.0, 0.0), (left, 0.0)], "stroke=\"#999\" stroke-dasharray=\"8 4\"");
    let corner = FILM.min(0.4 * lens.focal_length);
    for (height, color) in [(0.0, "#1565c0"), (-corner, "#c62828")] {
        fan(&mut out, &page, &trace, height, color);
    }
    opening(&mut out, &page, system, lens, film);
    let highest = 1.1 * highest;
    line(&mut out, &page, [(0.0, -corner), (0.0, corner)], "stroke=\"black\" stroke-width=\"3\"");
    let planes = [("H", film + lens.length - lens.front_principal), ("H′", film - lens.rear_principal)];
    for (name, z) in planes.into_iter().filter(|(_, z)| (0.0..left).contains(z)) {
        line(&mut out, &page, [(z, -highest), (z, highest)], "stroke=\"#999\" stroke-dasharray=\"2 3\"");
        let at = page.point(z, highest);
        let (x, y) = at.split_once(',').unwrap_or(("0", "0"));
        _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" fill=\"#666\">{name}</text>");
    }
    out + "</svg>\n"
}

fn line(out: &mut String, page: &Page, ends: [(f64, f64); 2], style: &str) {
    let [a, b] = ends.map(|(z, y)| page.point(z, y));
    _ = writeln!(out, "<polyline points=\"{a} {b}\" fill=\"none\" {style}/>");
}

/// Distance of each vertex from the film, from the front.
fn vertices(system: &LensSystem, film: f64) -> Vec<f64> {
    let mut z = film + system.length();
    let distances = system.interfaces.iter().map(|interface| interface.thickness);
    let step = |distance: f64| {
        z -= distance;
        z + distance
    };
    distances.map(step).collect()
}

/// The outline of a surface, from its lower to its upper rim, as far as `aperture`.
fn outline(radius: f64, z: f64, aperture: f64) -> impl DoubleEndedIterator<Item = (f64, f64)> {
    (0..=OUTLINE).map(move |i| {
        let y = aperture * (2.0 * f64::from(i) / f64::from(OUTLINE) - 1.0);
        if radius == 0.0 {
            return (z, y);
        }
        // A rim beyond the sphere stays at its widest
        let height = y.abs().min(radius.abs());
        let depth = radius.abs() - (radius * radius - height * height).sqrt();
        (z - depth.copysign(radius), y)
    })
}

/// The elements: what is between two surfaces and is no air.
fn glass(out: &mut String, page: &Page, system: &LensSystem, film: f64) {
    let at = vertices(system, film);
    for (i, pair) in system.interfaces.windows(2).enumerate().filter(|(_, pair)| pair[0].index != 1.0) {
        let front = outline(pair[0].radius, at[i], 0.5 * pair[0].aperture);
        let rear = outline(pair[1].radius, at[i + 1], 0.5 * pair[1].aperture).rev();
        let points: Vec<_> = front.chain(rear).map(|(z, y)| page.point(z, y)).collect();
        _ = writeln!(
            out,
            "<polygon points=\"{}\" fill=\"#b3d9e6\" fill-opacity=\"0.7\" stroke=\"#37474f\"/>",
            points.join(" ")
        );
    }
}

/// The blades of the stop.
fn opening(out: &mut String, page: &Page, system: &LensSystem, lens: &Paraxial, film: f64) {
    let z = vertices(system, film)[lens.stop.interface];
    let inner = 0.5 * lens.stop_diameter;
    let outer = 1.1 * (0.5 * system.interfaces[lens.stop.interface].aperture) + 0.1 * inner;
    for side in [-1.0, 1.0] {
        line(out, page, [(z, side * inner), (z, side * outer)], "stroke=\"black\" stroke-width=\"3\"");
    }
}

/// Rays from a point of the film that get through, spread evenly over those that do.
fn fan(out: &mut String, page: &Page, trace: &LensTrace, film: f64, color: &str) {
    let origin = DVec3::new(film, 0.0, 0.0);
    let ray = |x: f64| LensRay { origin, direction: DVec3::new(x - film, 0.0, trace.rear()).normalize() };
    let reach = page.middle / page.scale;
    let tried = (0..=TRIED).map(|i| reach * (2.0 * f64::from(i) / f64::from(TRIED) - 1.0));
    let passing: Vec<f64> = tried.filter(|&x| trace.to_scene(ray(x)).is_some()).collect();
    let (Some(&low), Some(&high)) = (passing.first(), passing.last()) else { return };
    for i in 0..FAN {
        let x = low + (high - low) * f64::from(i) / f64::from(FAN - 1);
        let (mut points, leaving) = trace.path(ray(x));
        if let Some(leaving) = leaving {
            let along = (page.left - leaving.origin.z) / leaving.direction.z.max(1e-9);
            points.push(leaving.origin + along * leaving.direction);
        }
        let points: Vec<_> = points.iter().map(|p| page.point(p.z, p.x)).collect();
        _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"0.7\"/>",
            points.join(" ")
        );
    }
}
