//! Spectra to RGB: dapple renders with three channels.

mod named;
mod observer;

use super::parameter::{Parameter, Type, Values, number};
use super::parameters::Parameters;
use super::reader::Reader;
use crate::Result;
use crate::import::text::{Limits, shown, suggest};
use crate::scene::{Dielectric, LINES};
use glam::{DVec3, Vec3};

/// What a spectrum is of, which decides how it becomes RGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// A reflectance or transmittance from 0 to 1.
    Albedo,
    /// A number without an upper end, such as an index.
    Unbounded,
    /// Light: spectra and black bodies have a luminance of 1, to which scales apply.
    Light,
}

/// A spectrum as it is given.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Spectrum {
    /// Colour.
    Rgb(Vec3),
    /// Values at wavelengths in nanometres, which grow; two at least.
    Samples(Vec<[f32; 2]>),
    /// Index of refraction at the d line, and Abbe number.
    Glass([f32; 2]),
}

/// Largest reflectance of a metal: at 1 its index would be infinite.
const MOST_REFLECTANCE: f64 = 0.99;

impl Spectrum {
    /// In the three channels.
    pub fn rgb(&self, role: Role) -> Vec3 {
        match self {
            Self::Rgb(rgb) => *rgb,
            Self::Glass([index, _]) => Vec3::splat(*index),
            Self::Samples(list) => {
                let value = |wavelength: f64| interpolated(list, wavelength);
                let rgb = match role {
                    Role::Albedo => observer::reflected(value),
                    Role::Unbounded => observer::mean(value),
                    Role::Light => observer::shone(value),
                };
                // Colours that no screen has are cut off at 0
                rgb.as_vec3().max(Vec3::ZERO)
            }
        }
    }
}

impl Spectrum {
    /// The index of clear material at the d line, and its Abbe number where blue is bent more than red.
    pub fn glass(&self) -> (f32, Option<f32>) {
        match self {
            Self::Rgb(rgb) => (rgb.y, None),
            Self::Glass([index, abbe]) => (*index, Some(*abbe)),
            Self::Samples(list) => {
                let [f, d, c] = LINES.map(|micrometres| interpolated(list, 1000.0 * micrometres));
                let abbe = ((d - 1.0) / (f - c)) as f32;
                (d as f32, Dielectric::abbe_within(abbe).filter(|_| f > c))
            }
        }
    }

    /// η and k of copper, which is the metal of pbrt when a scene names none.
    pub fn copper() -> [Self; 2] {
        ["metal-Cu-eta", "metal-Cu-k"].map(|name| Self::Rgb(named::named(name).unwrap_or(Vec3::ONE)))
    }
}

/// η and k per channel of a metal: η is a mean, and k is such that the light that comes from straight above is reflected as
/// the spectra reflect daylight.
pub(super) fn indices(eta: &Spectrum, k: &Spectrum) -> [Vec3; 2] {
    let (Spectrum::Samples(eta_list), Spectrum::Samples(k_list)) = (eta, k) else {
        return [eta.rgb(Role::Unbounded), k.rgb(Role::Unbounded)];
    };
    let head_on = |l: f64| {
        let (eta, k) = (interpolated(eta_list, l), interpolated(k_list, l));
        ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k)
    };
    let r = observer::reflected(head_on).clamp(DVec3::ZERO, DVec3::splat(MOST_REFLECTANCE));
    let eta = observer::mean(|l| interpolated(eta_list, l));
    let squared = (r * (eta + 1.0) * (eta + 1.0) - (eta - 1.0) * (eta - 1.0)) / (1.0 - r);
    [eta.as_vec3(), squared.max(DVec3::ZERO).map(f64::sqrt).as_vec3()]
}

/// The value of samples at a wavelength; beyond the ends that of the end, as in pbrt.
fn interpolated(samples: &[[f32; 2]], wavelength: f64) -> f64 {
    let after = samples.partition_point(|sample| f64::from(sample[0]) < wavelength);
    let at = |i: usize| samples.get(i).map_or([0.0; 2], |sample| sample.map(f64::from));
    if after == 0 {
        return at(0)[1];
    }
    let [l0, v0] = at(after - 1);
    if after == samples.len() {
        return v0;
    }
    let [l1, v1] = at(after);
    v0 + (v1 - v0) * (wavelength - l0) / (l1 - l0)
}

/// Planck's law, in any unit; wavelength in nanometres.
fn planck(wavelength: f64, kelvin: f64) -> f64 {
    /// Planck's constant times the speed of light over Boltzmann's constant, in nm K.
    const C2: f64 = 1.438_776_877e7;
    // Against the power at 780 nm, so that cold bodies do not underflow
    let exponent = |l: f64| C2 / (l * kelvin);
    let ratio = (exponent(780.0) - exponent(wavelength)).exp();
    let rest = (1.0 - (-exponent(780.0)).exp()) / (1.0 - (-exponent(wavelength)).exp());
    (780.0 / wavelength).powi(5) * ratio * rest
}

const KINDS: [Type; 3] = [Type::Rgb, Type::Spectrum, Type::Blackbody];

impl Reader<'_> {
    /// A spectrum of a directive.
    pub fn spectrum(&mut self, from: &Parameters, name: &'static str) -> Result<Option<Spectrum>> {
        let Some(parameter) = from.find(name, &KINDS) else { return Ok(None) };
        self.spectrum_of(from, parameter).map(Some)
    }

    /// A spectrum in the three channels.
    pub fn rgb_or(
        &mut self,
        from: &Parameters,
        name: &'static str,
        role: Role,
        default: Vec3,
    ) -> Result<Vec3> {
        Ok(self.spectrum(from, name)?.map_or(default, |spectrum| spectrum.rgb(role)))
    }

    fn spectrum_of(&mut self, from: &Parameters, parameter: &Parameter) -> Result<Spectrum> {
        match (parameter.kind, &parameter.values) {
            (Type::Rgb, Values::Numbers(list)) => {
                let rgb: [f32; 3] = list.as_slice().try_into().map_err(|_| from.count(parameter, 3))?;
                if let Some(value) = rgb.iter().find(|value| **value < 0.0) {
                    return Err(from.refuse(parameter, value, "at least 0"));
                }
                Ok(Spectrum::Rgb(self.state.color_space.rec709(Vec3::from_array(rgb))))
            }
            (Type::Blackbody, Values::Numbers(list)) => {
                let &[kelvin] = list.as_slice() else { return Err(from.count(parameter, 1)) };
                if !Limits::AboveUpTo(0.0, 1e6).allows(kelvin) {
                    return Err(from.refuse(
                        parameter,
                        kelvin,
                        "a temperature above 0 and at most 1e6 kelvin",
                    ));
                }
                Ok(Spectrum::Rgb(observer::shone(|l| planck(l, kelvin.into())).as_vec3().max(Vec3::ZERO)))
            }
            (_, Values::Numbers(list)) => samples(list)
                .map(Spectrum::Samples)
                .map_err(|rule| from.refuse(parameter, format!("a list of {} numbers", list.len()), rule)),
            (_, Values::Strings(list)) => {
                let [name] = list.as_slice() else { return Err(from.count(parameter, 1)) };
                if let Some(glass) = named::glass(name) {
                    return Ok(Spectrum::Glass(glass));
                }
                match named::named(name) {
                    Some(rgb) => Ok(Spectrum::Rgb(rgb)),
                    None => self.spectrum_file(parameter, name).map(Spectrum::Samples),
                }
            }
            _ => Err(from.count(parameter, 1)),
        }
    }

    /// Wavelengths and values from a file, with comments from `#` on.
    fn spectrum_file(&mut self, parameter: &Parameter, name: &str) -> Result<Vec<[f32; 2]>> {
        let path = parameter.spot.resolve(name);
        if name.is_empty() || !self.assets.exists(&path) {
            let message = format!("\"{}\" is neither a named spectrum nor a file", shown(name));
            let names = named::names();
            let help = suggest(name, names.iter().map(String::as_str), "named spectra");
            return Err(parameter.spot.error(message).help(help));
        }
        let text = self.assets.text(&path).map_err(|error| parameter.spot.locate(error))?;
        let mut numbers = Vec::new();
        for (i, line) in text.lines().enumerate() {
            for word in line.split('#').next().unwrap_or("").split_ascii_whitespace() {
                let value = number(word).ok_or_else(|| {
                    let message = format!("`{}` is no finite number", shown(word));
                    crate::Error::scene(message)
                        .help("write wavelengths in nanometres and values, in turn")
                        .at(&path, i as u32 + 1, 0)
                })?;
                numbers.push(value as f32);
            }
        }
        samples(&numbers).map_err(|rule| {
            let message = format!("the spectrum has {} numbers, must have {rule}", numbers.len());
            crate::Error::scene(message).in_file(&path)
        })
    }
}

/// Pairs of wavelength and value; else what they must be.
fn samples(numbers: &[f32]) -> Result<Vec<[f32; 2]>, &'static str> {
    let (pairs, rest) = numbers.as_chunks();
    if pairs.is_empty() || !rest.is_empty() {
        return Err("wavelengths and values in turn");
    }
    let grows = pairs.windows(2).all(|two| two[0][0] < two[1][0]);
    if !grows {
        return Err("wavelengths that grow, each with a value");
    }
    Ok(pairs.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_joined_by_lines_and_held_at_the_ends() {
        let list = samples(&[400.0, 1.0, 500.0, 3.0, 600.0, 3.0]).unwrap();
        for (l, v) in [(300.0, 1.0), (400.0, 1.0), (450.0, 2.0), (500.0, 3.0), (550.0, 3.0), (900.0, 3.0)] {
            assert!((interpolated(&list, l) - v).abs() < 1e-12, "{l}");
        }
        assert!(
            samples(&[]).is_err()
                && samples(&[400.0]).is_err()
                && samples(&[500.0, 1.0, 400.0, 1.0]).is_err()
        );
    }

    #[test]
    fn a_black_body_of_6500_kelvin_is_nearly_white_and_one_of_2700_is_orange() {
        let at = |kelvin: f64| observer::shone(|l| planck(l, kelvin));
        assert!((at(6500.0) - DVec3::ONE).abs().max_element() < 0.08, "{}", at(6500.0));
        let warm = at(2700.0);
        assert!(warm.x > 1.7 && warm.x < 2.1 && warm.z < 0.35, "{warm}");
        for kelvin in [1.0, 1e-3, 1e6] {
            assert!(at(kelvin).is_finite(), "{kelvin}: {}", at(kelvin));
        }
        // Luminance is that of Rec. 709
        assert!((warm.dot(DVec3::new(0.2126, 0.7152, 0.0722)) - 1.0).abs() < 0.02);
    }

    #[test]
    fn indices_reflect_as_the_spectra_do() {
        let flat = |value: f32| Spectrum::Samples(vec![[400.0, value], [700.0, value]]);
        let [eta, k] = indices(&flat(0.2), &flat(3.0));
        assert!(
            eta.abs_diff_eq(Vec3::splat(0.2), 1e-5) && k.abs_diff_eq(Vec3::splat(3.0), 1e-3),
            "{eta} {k}"
        );
    }
}
