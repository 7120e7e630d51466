//! The table of lights without extent that are nothing but numbers and a file of shaders.

use super::{InputNumber, LightKind};
use glam::Vec3;
use std::f64::consts::PI;

/// What a light sends out, relative to its intensity, by the cosine of the angle to the direction in which it aims and by its numbers.
type Shines = fn(f64, [f64; PunctualKind::MOST_NUMBERS]) -> f64;

/// A row of [`PUNCTUAL_LIGHTS`].
#[derive(Debug)]
pub struct PunctualKind {
    /// Its kind in a scene: `shaders/light/NAME.glsl` has its verb `NAME_sample`.
    pub name: &'static str,
    /// Its numbers, at most [`Self::MOST_NUMBERS`].
    pub numbers: &'static [InputNumber],
    /// What it sends out in a direction: the mean around the axis. By it lights are chosen, and watts become intensity. None of light
    /// from infinity, which has an irradiance in place of an intensity, and no place.
    pub shines: Option<Shines>,
}

impl PartialEq for PunctualKind {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl PunctualKind {
    /// As many numbers as a light has room for.
    pub const MOST_NUMBERS: usize = 4;

    /// The row of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        PUNCTUAL_LIGHTS.iter().find(|kind| kind.name == name).copied()
    }

    /// Its place in [`PUNCTUAL_LIGHTS`].
    pub fn index(&self) -> usize {
        PUNCTUAL_LIGHTS.iter().position(|kind| kind == &self).unwrap_or(PUNCTUAL_LIGHTS.len())
    }
}

/// A light of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Punctual {
    /// Its row.
    pub kind: &'static PunctualKind,
    /// Where it is, in world space; of light from infinity 0.
    pub position: Vec3,
    /// Its numbers in the units of its row, and 0 for those that it does not have.
    pub numbers: [f32; PunctualKind::MOST_NUMBERS],
}

impl Punctual {
    /// What it sends out, relative to its intensity, at a cosine of the angle to its axis; none of light from infinity.
    pub fn shines(&self, cosine: f64) -> Option<f64> {
        self.kind.shines.map(|shines| shines(cosine, self.numbers.map(f64::from)))
    }

    /// The integral of that over the sphere, steradians, to a part in 10⁵: its power over its intensity.
    pub fn solid_angle(&self) -> Option<f64> {
        /// Before edges are looked for
        const PANELS: u32 = 256;
        self.kind.shines?;
        // What a ring sends out, narrow cones drawn apart: θ = π t³
        let ring = |t: f64| {
            let (sine, cosine) = (PI * t.powi(3)).sin_cos();
            self.shines(cosine).unwrap_or(0.0) * sine * 3.0 * t * t
        };
        let panel = |i: u32| integral(&ring, [i, i + 1].map(|i| f64::from(i) / f64::from(PANELS)), 40);
        Some(2.0 * PI * PI * (0..PANELS).map(panel).sum::<f64>())
    }
}

/// The integral of a function, by Simpson's rule, halved where it is not yet right or has an edge.
fn integral(f: &impl Fn(f64) -> f64, [a, b]: [f64; 2], halvings: u32) -> f64 {
    let middle = 0.5 * (a + b);
    let [fa, fl, fm, fr, fb] = [a, 0.5 * (a + middle), middle, 0.5 * (middle + b), b].map(f);
    let coarse = (fa + 4.0 * fm + fb) * (b - a) / 6.0;
    let fine = (fa + 4.0 * fl + 2.0 * fm + 4.0 * fr + fb) * (b - a) / 12.0;
    if halvings == 0 || (fine - coarse).abs() <= 1e-7 * fine.abs() {
        return fine;
    }
    integral(f, [a, middle], halvings - 1) + integral(f, [middle, b], halvings - 1)
}

/// Declares lights: `name(number = default in least..=most, …) shines function;` of one with a place, `name(…) from infinity;` of one
/// without. Each gets a row of [`PUNCTUAL_LIGHTS`] and a constructor.
macro_rules! punctual_lights {
    ($( $(#[doc = $doc:literal])* $name:ident(
        $($number:ident = $usual:literal in $least:literal..=$most:literal),*
    ) $where:ident $how:expr; )*) => {
        #[allow(non_upper_case_globals)] // Named as in scenes
        mod rows {
            use super::*;
            $( pub(super) static $name: PunctualKind = PunctualKind {
                name: stringify!($name),
                numbers: &[$( InputNumber {
                    key: stringify!($number), default: $usual, least: $least, most: $most,
                } ),*],
                shines: punctual_lights!(@shines $where $how),
            }; )*
        }

        /// Every row.
        pub static PUNCTUAL_LIGHTS: &[&PunctualKind] = &[$( &rows::$name ),*];

        impl LightKind {
            $( punctual_lights!(@constructor $where [$(#[doc = $doc])*] $name [$($number)*]); )*
        }
    };
    (@shines from $how:expr) => { None };
    (@shines shines $how:expr) => { Some($how) };
    (@constructor from [$(#[doc = $doc:literal])*] $name:ident [$($number:ident)*]) => {
        $(#[doc = $doc])*
        pub fn $name($($number: f32),*) -> Self {
            Self::Punctual(Punctual { kind: &rows::$name, position: Vec3::ZERO, numbers: filled(&[$($number),*]) })
        }
    };
    (@constructor shines [$(#[doc = $doc:literal])*] $name:ident [$($number:ident)*]) => {
        $(#[doc = $doc])*
        pub fn $name(position: Vec3, $($number: f32),*) -> Self {
            Self::Punctual(Punctual { kind: &rows::$name, position, numbers: filled(&[$($number),*]) })
        }
    };
}

// The keys of scene files, their export, records, constructors and all GLSL but the verb follow from a line here.
punctual_lights! {
    /// A cone of light of half-angle `cone_angle` in degrees: full on its inside, smoothstep in the cosine to 0 over its last
    /// `falloff_angle` degrees (pbrt-v4, section 12.2.1). A soft edge wider than the cone counts as wide as the cone. A texture is looked
    /// up by direction, equirectangular.
    spot(cone_angle = 30.0 in 0.0..=180.0, falloff_angle = 5.0 in 0.0..=180.0) shines spot_shines;
    /// Light from a disk infinitely far away, `angle` degrees across and evenly bright; parallel for 0. The uv of a texture is the place of
    /// the lit point across the light, in scene units from the origin: u to the right and v upward, seen along the light.
    distant(angle = 0.0 in 0.0..=90.0) from infinity;
}

fn spot_shines(cosine: f64, [cone_angle, falloff_angle, ..]: [f64; PunctualKind::MOST_NUMBERS]) -> f64 {
    let [outer, inner] =
        [cone_angle, (cone_angle - falloff_angle).max(0.0)].map(|angle| angle.to_radians().cos());
    let t = ((cosine - outer) / (inner - outer).max(1e-7)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Numbers, and 0 for the others.
fn filled(numbers: &[f32]) -> [f32; PunctualKind::MOST_NUMBERS] {
    std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0.0))
}

const _: () = {
    let mut i = 0;
    while i < PUNCTUAL_LIGHTS.len() {
        assert!(
            PUNCTUAL_LIGHTS[i].numbers.len() <= PunctualKind::MOST_NUMBERS,
            "a light has room for four numbers"
        );
        i += 1;
    }
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solid_angle_of_a_spot_is_that_of_its_cone() {
        for cone in [0.0_f32, 0.05, 1.0, 5.0, 20.5, 45.0, 90.0, 137.0, 180.0] {
            for edge in [0.0_f32, 0.01, 0.5, 5.0, 30.0, 180.0] {
                let LightKind::Punctual(spot) = LightKind::spot(Vec3::ZERO, cone, edge) else { panic!() };
                let [outer, inner] = [f64::from(cone), f64::from((cone - edge).max(0.0))]
                    .map(|angle| angle.to_radians().cos());
                // Smoothstep is a half in the mean
                let whole = 2.0 * PI * (1.0 - 0.5 * (inner + outer));
                let found = spot.solid_angle().unwrap();
                // Edges steeper than a cosine of 32 bits can say are made wider
                let tolerance = 1e-5 * whole + if inner - outer < 1e-7 { 4e-7 } else { 0.0 };
                assert!((found - whole).abs() <= tolerance, "{cone}° {edge}°: {found}, not {whole}");
            }
        }
    }
}
