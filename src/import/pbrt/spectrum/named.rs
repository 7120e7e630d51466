//! Spectra that have names.

use super::observer::RGB_FROM_XYZ;
use glam::{DVec3, Vec3};

/// Indices of metals and of two clear crystals, η and k per channel.
///
/// From the spectra of refractiveindex.info: Johnson and Christy 1972 (Ag, Au, Cu), Rakić 1995 (Al), Querry 1985 (70 % copper, 30 %
/// zinc), Stephens and Malitson 1952 (MgO), Devore 1951 (TiO2, ordinary). η is the mean over what a channel sees in daylight; k is such
/// that light from straight above is reflected as the spectrum reflects daylight, up to 0.99, which red of gold would exceed.
const INDICES: [(&str, [f32; 3], [f32; 3]); 7] = [
    ("Ag", [0.0543, 0.0537, 0.0442], [4.3755, 3.5088, 2.6227]),
    ("Al", [1.2731, 0.9744, 0.6478], [7.0629, 6.5104, 5.5363]),
    ("Au", [0.2999, 0.5538, 1.3497], [10.8751, 2.4044, 1.7243]),
    ("Cu", [0.5049, 1.0278, 1.2457], [5.1306, 2.6109, 2.3207]),
    ("CuZn", [0.4954, 0.5651, 1.0601], [4.3872, 2.7928, 1.7611]),
    ("MgO", [1.7372, 1.7417, 1.7521], [0.0; 3]),
    ("TiO2", [2.6140, 2.6629, 2.8100], [0.0; 3]),
];

/// Indices of glasses at the d line and Abbe numbers, from the data sheets of Schott: N-BK7, N-BAF10, N-FK51A, N-LASF9, SF5, SF10, SF11.
const GLASSES: [(&str, f32, f32); 7] = [
    ("BK7", 1.5168, 64.17),
    ("BAF10", 1.6700, 47.11),
    ("FK51A", 1.4866, 84.47),
    ("LASF9", 1.8503, 32.17),
    ("F5", 1.6727, 32.21),
    ("F10", 1.7283, 28.41),
    ("F11", 1.7847, 25.76),
];

/// Chromaticities x and y of illuminants for the CIE 1931 observer (CIE 15; D60 from ACES).
const ILLUMINANTS: [(&str, f64, f64); 16] = [
    ("stdillum-A", 0.44757, 0.40745),
    ("stdillum-D50", 0.34567, 0.35850),
    ("stdillum-D65", 0.31271, 0.32902),
    ("stdillum-F1", 0.31310, 0.33727),
    ("stdillum-F2", 0.37208, 0.37529),
    ("stdillum-F3", 0.40910, 0.39430),
    ("stdillum-F4", 0.44018, 0.40329),
    ("stdillum-F5", 0.31379, 0.34531),
    ("stdillum-F6", 0.37790, 0.38835),
    ("stdillum-F7", 0.31292, 0.32933),
    ("stdillum-F8", 0.34588, 0.35875),
    ("stdillum-F9", 0.37417, 0.37281),
    ("stdillum-F10", 0.34609, 0.35986),
    ("stdillum-F11", 0.38052, 0.37713),
    ("stdillum-F12", 0.43695, 0.40441),
    ("illum-acesD60", 0.32168, 0.33767),
];

/// Index and Abbe number of a named glass.
pub(super) fn glass(name: &str) -> Option<[f32; 2]> {
    let glass = name.strip_prefix("glass-")?;
    GLASSES.iter().find(|(known, ..)| *known == glass).map(|&(_, index, abbe)| [index, abbe])
}

/// The numbers of a name: η or k of a metal, or the colour of an illuminant of luminance 1.
pub(super) fn named(name: &str) -> Option<Vec3> {
    if let Some((metal, part)) = name.strip_prefix("metal-").and_then(|name| name.split_once('-')) {
        let (_, eta, k) = INDICES.iter().find(|(known, ..)| *known == metal)?;
        return match part {
            "eta" => Some(Vec3::from_array(*eta)),
            "k" => Some(Vec3::from_array(*k)),
            _ => None,
        };
    }
    let (_, x, y) = ILLUMINANTS.iter().find(|(known, ..)| *known == name)?;
    Some((RGB_FROM_XYZ * DVec3::new(x / y, 1.0, (1.0 - x - y) / y)).as_vec3())
}

/// All names, for a message.
pub(super) fn names() -> Vec<String> {
    let metals =
        INDICES.iter().flat_map(|(metal, ..)| ["eta", "k"].map(|part| format!("metal-{metal}-{part}")));
    let glasses = GLASSES.iter().map(|(glass, ..)| format!("glass-{glass}"));
    metals.chain(glasses).chain(ILLUMINANTS.iter().map(|(name, ..)| (*name).to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_plausible_numbers() {
        let known = |name: &str| glass(name).is_some() || named(name).is_some_and(|color| color.is_finite());
        assert!(names().iter().all(|name| known(name)));
        assert_eq!(glass("glass-BK7"), Some([1.5168, 64.17]));
        assert!(named("stdillum-D65").unwrap().abs_diff_eq(Vec3::ONE, 2e-3));
        let warm = named("stdillum-A").unwrap();
        assert!(warm.x > 1.5 && warm.z < 0.4, "{warm}");
        assert_eq!([named("metal-Xx-eta"), named("metal-Au"), named("")], [None; 3]);
        assert_eq!([glass("glass-"), glass("BK7")], [None; 2]);
    }
}
