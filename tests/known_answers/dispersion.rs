//! Glass that bends each colour in its own way.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

/// Index at the d line and Abbe number of the glass here.
const INDEX: f64 = 1.7;
const ABBE: f64 = 20.0;
/// Middles of the bands of red, green and blue and how far they reach, in µm.
const BANDS: [f64; 3] = [0.6114, 0.5491, 0.4643];
const REACH: f64 = 0.05;

fn flint(alpha: f32) -> Surface {
    flint_of(ABBE, alpha)
}

fn flint_of(abbe: f64, alpha: f32) -> Surface {
    let (ior, roughness) = (Value::Constant(INDEX as f32), Roughness::alpha(alpha));
    let abbe = Some(abbe as f32);
    Surface::Dielectric(Dielectric { ior, roughness, abbe, absorption: Vec3::ZERO, thin: false })
}

/// Mean over the band of a colour of a function of the index, with the formula that lenses have.
fn over_band(color: usize, f: impl Fn(f64) -> f64) -> f64 {
    over_band_of(ABBE, color, f)
}

fn over_band_of(abbe: f64, color: usize, f: impl Fn(f64) -> f64) -> f64 {
    let row = LensInterface { radius: 0.0, thickness: 0.0, index: INDEX, abbe: Some(abbe), aperture: 1.0 };
    let [a, b] = row.cauchy();
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..1000 {
        let x = (f64::from(i) + 0.5) / 500.0 - 1.0;
        let wavelength = BANDS[color] + REACH * x;
        sum += (1.0 - x.abs()) * f(a + b / (wavelength * wavelength));
        weights += 1.0 - x.abs();
    }
    sum / weights
}

/// What a boundary lets through of unpolarised light (Fresnel 1823).
fn transmittance(sin_i: f64, index: f64) -> f64 {
    let (cos_i, cos_t) = ((1.0 - sin_i * sin_i).sqrt(), (1.0 - (sin_i / index).powi(2)).sqrt());
    let s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
    let p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
    1.0 - (s * s + p * p) / 2.0
}

#[test]
fn a_slab_shifts_each_colour_by_its_own_index() {
    // Seen at 60° through a unit of glass: a floor a unit below it, as bright as its place
    const BEGIN: f64 = 2.2;
    let mut s = scene(8, 8, 4096);
    s.render.max_depth = 2;
    let sin = 60_f64.to_radians().sin();
    s.camera = look(Vec3::new(sin as f32, 0.5, 0.0), Vec3::ZERO, 0.01);
    let m = s.material(flint(0.0), None);
    let slab = box_mesh(Vec3::new(-50.0, -1.0, -50.0), Vec3::new(50.0, 0.0, 50.0), false);
    let slab = s.meshes.add("slab", slab);
    s.place(slab, m, Affine3A::IDENTITY);
    let source = format!(
        "vec4 color(TextureContext context) {{ return vec4(vec3(max(-context.position.x - {BEGIN:?}, 0.0)), 1.0); }}"
    );
    let place = GlslTexture { source, file: "place.glsl".into(), line: 1, parameters: vec![], max: 100.0 };
    let place = s.textures.add("place", Texture::Glsl(place));
    let floor = s.unlit(Value::Texture(place));
    s.quad(Vec3::new(-50.0, -2.0, 50.0), Vec3::X * 100.0, Vec3::NEG_Z * 100.0, floor);
    let outside = sin / (1.0 - sin * sin).sqrt();
    let seen = |index: f64| {
        let sin_t = sin / index;
        let inside = sin_t / (1.0 - sin_t * sin_t).sqrt();
        transmittance(sin, index).powi(2) * (inside + outside - BEGIN)
    };
    let expected = [0, 1, 2].map(|color| over_band(color, seen));
    assert!(expected[2] < 0.9 * expected[0] && expected[1] < 0.97 * expected[0]);
    expect_mean(mean(&render(&s)), expected, 1e-4);
}

#[test]
fn a_ball_of_flint_in_a_white_room_is_invisible() {
    let mut s = scene(16, 16, 512);
    s.render.max_depth = 100;
    s.camera = look(Vec3::new(0.0, 0.0, 3.0), Vec3::ZERO, 36.0);
    s.environment = constant_environment(1.0);
    let m = s.material(flint(0.0), None);
    s.sphere(Vec3::ZERO, 1.0, m);
    expect_grey(mean(&render(&s)), 1.0, 1e-4);
}

#[test]
fn balls_of_nearly_smooth_flint_in_a_white_room_are_invisible() {
    // Six boundaries: colours that part are not to come back with all their weights multiplied
    let (ior, abbe, white) = (Value::Constant(1.6), Some(ABBE as f32), Vec3::ONE);
    let roughness = Roughness { squared: true, ..Roughness::alpha(0.0) };
    let principled = Principled {
        base_color: Value::Constant(white),
        transmission: Value::Constant(1.0),
        roughness,
        ior,
        abbe,
        ..Principled::default()
    };
    for surface in [flint(0.002), Surface::Principled(Box::new(principled))] {
        let mut s = scene(8, 8, 1024);
        s.render.max_depth = 64;
        s.camera = look(Vec3::new(0.0, 0.0, 3.0), Vec3::ZERO, 30.0);
        s.environment = constant_environment(1.0);
        let m = s.material(surface, None);
        for i in 0..3 {
            s.sphere(Vec3::NEG_Z * 2.1 * i as f32, 1.0, m);
        }
        let seen = mean(&render(&s));
        assert!(seen.error.iter().all(|error| *error < 0.01), "{:?}", seen.error);
        expect_grey(seen, 1.0, 2e-3);
    }
}

#[test]
fn rough_glass_is_as_three_glasses_of_one_index() {
    /// So strong that colours differ by far more than noise does.
    const STRONG: f64 = 6.0;
    // The bands are narrow, and what a rough ball does hardly depends on the place in them
    let ball = |surface: Surface| {
        let mut s = scene(8, 8, 16_384);
        s.render.max_depth = 8;
        s.camera = look(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, 20.0);
        let m = s.material(surface, None);
        s.sphere(Vec3::ZERO, 1.0, m);
        // Reflected by the front of the ball alone, where a larger index shows
        let lamp = s.emitter(grey(5.0), true);
        s.quad(Vec3::new(-3.0, -3.0, 6.0), Vec3::X * 6.0, Vec3::Y * 6.0, lamp);
        mean(&render(&s))
    };
    let whole = ball(flint_of(STRONG, 0.2));
    let index = |color| over_band_of(STRONG, color, |index| index) as f32;
    let ones = [0, 1, 2].map(|color| ball(glass(index(color), 0.2, Vec3::ZERO, false)));
    let apart = ones[2].mean[2] / ones[0].mean[0] - 1.0;
    let error = whole.error[0].hypot(ones[0].error[0]) / whole.mean[0];
    assert!(
        apart > 3.0 * (4.0 * error + 5e-3),
        "colours {apart} apart, with an error of {error}, prove nothing"
    );
    for (color, mut one) in ones.into_iter().enumerate() {
        // Of the others nothing is asked
        for other in (0..3).filter(|other| *other != color) {
            (one.mean[other], one.error[other]) = (whole.mean[other], whole.error[other]);
        }
        expect_same(whole, one, 5e-3);
    }
}

#[test]
fn a_lens_with_dispersion_and_glass_agree_on_the_colour_of_a_path() {
    // What a lens with dispersion shows is as bright with glass in front of it as the glass says, not three times that
    let see = |dispersion: bool, surface: Option<Surface>| {
        let mut s = scene(8, 8, 2048);
        s.camera = look(Vec3::new(0.0, 0.0, 1.0), Vec3::ZERO, 40.0);
        let row = |radius, index, abbe| LensInterface { radius, thickness: 3.0, index, abbe, aperture: 8.0 };
        let system = LensSystem {
            notes: Vec::new(),
            interfaces: vec![row(50.0, 1.5, Some(40.0)), row(-50.0, 1.0, None)],
        };
        s.camera.projection = Projection::Lens(Box::new(LensCamera {
            system,
            stop_diameter: 8.0,
            focus_distance: 5.0,
            opening: Opening::default(),
            sensor_diagonal: 0.04,
            unit: 1000.0,
            dispersion,
            measure: Measure::Radiance,
        }));
        s.environment = constant_environment(1.0);
        if let Some(surface) = surface {
            let m = s.material(surface, None);
            s.sphere(Vec3::new(0.0, 0.0, -5.0), 4.0, m);
        }
        mean(&render(&s))
    };
    expect_same(see(true, Some(flint(0.0))), see(true, None), 1e-4);
    expect_same(see(true, Some(flint(0.0))), see(false, Some(flint(0.0))), 1e-2);
}
