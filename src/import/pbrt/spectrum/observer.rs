//! The standard observer, daylight, and the RGB that they make of spectra.

use glam::{DMat3, DVec3};

/// Wavelengths of integrals, in nanometres.
const FIRST: u32 = 380;
const LAST: u32 = 780;
const STEP: u32 = 5;

/// Relative power of CIE illuminant D65 from 380 nm to 780 nm, each 10 nm (CIE 15).
const D65: [f64; 41] = [
    49.98, 54.65, 82.75, 91.49, 93.43, 86.68, 104.86, 117.01, 117.81, 114.86, 115.92, 108.81, 109.35, 107.80,
    104.79, 107.69, 104.41, 104.05, 100.00, 96.33, 95.79, 88.69, 90.01, 89.60, 87.70, 83.29, 83.70, 80.03,
    80.21, 82.28, 78.28, 69.72, 71.61, 74.35, 61.60, 69.89, 75.09, 63.59, 46.42, 66.81, 63.38,
];

/// Linear Rec. 709 RGB of XYZ (IEC 61966-2-1).
pub(super) const RGB_FROM_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(3.240_454_2, -0.969_266, 0.055_643_4),
    DVec3::new(-1.537_138_5, 1.876_010_8, -0.204_025_9),
    DVec3::new(-0.498_531_4, 0.041_556, 1.057_225_2),
);

/// The colour matching functions of the CIE 1931 observer, as sums of lobes (Wyman, Sloan and Shirley 2013, Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions, table 1).
pub(super) fn matching(wavelength: f64) -> DVec3 {
    let lobe = |middle: f64, below: f64, above: f64| {
        let width = if wavelength < middle { below } else { above };
        (-0.5 * ((wavelength - middle) / width).powi(2)).exp()
    };
    DVec3::new(
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    )
}

fn daylight(wavelength: u32) -> f64 {
    let (cell, rest) = ((wavelength - FIRST) / 10, (wavelength - FIRST) % 10);
    let at = |cell: u32| D65.get(cell as usize).copied().unwrap_or(0.0);
    at(cell) + (at(cell + 1) - at(cell)) * f64::from(rest) / 10.0
}

/// ∫ of a function of the wavelength, per channel, with the weights of red, green and blue at it.
fn integral(value: impl Fn(f64, u32) -> DVec3) -> DVec3 {
    (FIRST..=LAST)
        .step_by(STEP as usize)
        .map(|wavelength| {
            value(f64::from(wavelength), wavelength) * (RGB_FROM_XYZ * matching(wavelength.into()))
        })
        .sum()
}

/// The colour of a surface of a reflectance in daylight: 1 everywhere is white.
pub(super) fn reflected(reflectance: impl Fn(f64) -> f64) -> DVec3 {
    let lit = |l: f64, whole: u32| DVec3::splat(reflectance(l) * daylight(whole));
    integral(lit) / integral(|_, whole| DVec3::splat(daylight(whole)))
}

/// The colour of a light, of luminance 1 whatever its power, as pbrt makes it; daylight is white. Black has no luminance, and
/// stays black.
pub(super) fn shone(power: impl Fn(f64) -> f64) -> DVec3 {
    let luminance = |power: &dyn Fn(f64, u32) -> f64| -> f64 {
        let at = |l: u32| power(l.into(), l) * matching(l.into()).y;
        (FIRST..=LAST).step_by(STEP as usize).map(at).sum()
    };
    let own = luminance(&|l, _| power(l));
    if own <= 0.0 {
        return DVec3::ZERO;
    }
    let white = integral(|_, whole| DVec3::splat(daylight(whole))) / luminance(&|_, whole| daylight(whole));
    integral(|l, _| DVec3::splat(power(l))) / own / white
}

/// Means over the wavelengths that red, green and blue see in daylight.
pub(super) fn mean(value: impl Fn(f64) -> f64) -> DVec3 {
    let mut sum = DVec3::ZERO;
    let mut weights = DVec3::ZERO;
    for wavelength in (FIRST..=LAST).step_by(STEP as usize) {
        let seen = RGB_FROM_XYZ * matching(wavelength.into());
        let weight = seen.max(DVec3::ZERO) * daylight(wavelength);
        sum += weight * value(wavelength.into());
        weights += weight;
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_observer_is_near_that_of_the_tables() {
        // CIE 1931, 2°: the paper states errors of about a hundredth of the peak
        for (wavelength, x, y, z) in
            [(450.0, 0.3362, 0.0380, 1.7721), (555.0, 0.5121, 1.0, 0.0057), (600.0, 1.0622, 0.6310, 0.0008)]
        {
            let found = matching(wavelength);
            assert!((found - DVec3::new(x, y, z)).abs().max_element() < 0.03, "{wavelength}: {found}");
        }
    }

    #[test]
    fn daylight_is_white_and_long_waves_are_red() {
        let flat = reflected(|_| 0.25);
        assert!((flat - DVec3::splat(0.25)).abs().max_element() < 1e-12, "{flat}");
        let white = shone(|l| 3.0 * daylight(l as u32));
        assert!((white - DVec3::ONE).abs().max_element() < 1e-12, "{white}");
        let red = reflected(|l| if l > 600.0 { 1.0 } else { 0.0 });
        assert!(red.x > 0.7 && red.y < 0.2 && red.z.abs() < 0.05, "{red}");
        assert_eq!(shone(|_| 0.0), DVec3::ZERO);
    }
}
