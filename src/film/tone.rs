//! Curves from linear colour to the numbers in a PNG.

use crate::scene::ToneCurve;

/// More than any curve tells from white; larger numbers would leave 64 bits.
const MOST: f64 = 1e12;

/// Red, green and blue as they are written, in 0 to 1 but for rounding up: not yet clamped.
pub(super) fn encode(curve: ToneCurve, linear: [f64; 3]) -> [f64; 3] {
    match curve {
        ToneCurve::Srgb => linear.map(srgb),
        ToneCurve::Linear => linear,
        ToneCurve::Aces => aces(linear).map(srgb),
        ToneCurve::Agx => agx(linear),
    }
}

/// The sRGB curve of IEC 61966-2-1, without a limit above.
pub fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The reference and output transforms of ACES for a screen of 100 cd/m², as Hill fitted them with one curve between two matrices
/// (Stephen Hill 2016, in the notes to Pettineo's "BakingLab"). Linear in, linear out; 0.18 becomes 0.106.
fn aces(linear: [f64; 3]) -> [f64; 3] {
    const INPUT: [[f64; 3]; 3] =
        [[0.597_19, 0.354_58, 0.048_23], [0.076, 0.908_34, 0.015_66], [0.028_4, 0.133_83, 0.837_77]];
    const OUTPUT: [[f64; 3]; 3] = [
        [1.604_75, -0.531_08, -0.073_67],
        [-0.102_08, 1.108_13, -0.006_05],
        [-0.003_27, -0.072_76, 1.076_02],
    ];
    let curve =
        |v: f64| (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081);
    product(&OUTPUT, product(&INPUT, bounded(linear)).map(curve))
}

/// AgX (Troy Sobotka): stops from 2^−12.47 to 2^4.03 through a sigmoid, with colours drawn together before it so that bright ones
/// become white. Matrices and the polynomial of sixth degree are those of Wrensch (Minimal AgX Implementation, 2023). Linear in;
/// out come numbers for a screen with a gamma of 2.2, which are written as they are. 0.18 becomes 0.5.
fn agx(linear: [f64; 3]) -> [f64; 3] {
    const INSET: [[f64; 3]; 3] = [
        [0.842_479_062_253_094, 0.078_433_599_999_999_2, 0.079_223_745_147_764_3],
        [0.042_328_242_261_012_3, 0.878_468_636_469_772, 0.079_166_127_460_543_4],
        [0.042_375_654_905_705_1, 0.078_433_6, 0.879_142_973_793_104],
    ];
    const OUTSET: [[f64; 3]; 3] = [
        [1.196_879_005_120_17, -0.098_020_881_140_136_8, -0.099_029_744_079_720_5],
        [-0.052_896_851_757_456_2, 1.151_903_129_904_17, -0.098_961_176_844_843_3],
        [-0.052_971_635_514_443_8, -0.098_043_450_117_124_1, 1.151_073_672_641_16],
    ];
    const STOPS: [f64; 2] = [-12.473_93, 4.026_069];
    /// From x⁰ to x⁶.
    const SIGMOID: [f64; 7] = [-0.002_32, 0.119_1, 0.429_8, -6.868, 31.96, -40.14, 15.5];
    let curve = |v: f64| {
        let x = (v.log2().clamp(STOPS[0], STOPS[1]) - STOPS[0]) / (STOPS[1] - STOPS[0]);
        SIGMOID.iter().rev().fold(0.0, |sum, factor| sum * x + factor)
    };
    product(&OUTSET, product(&INSET, bounded(linear)).map(curve))
}

/// Numbers that the curves are made for.
fn bounded(linear: [f64; 3]) -> [f64; 3] {
    linear.map(|v| v.clamp(0.0, MOST))
}

fn product(rows: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [ToneCurve; 4] = [ToneCurve::Srgb, ToneCurve::Linear, ToneCurve::Aces, ToneCurve::Agx];

    fn grey(curve: ToneCurve, value: f64) -> f64 {
        let [r, g, b] = encode(curve, [value; 3]);
        // The rows of the published matrices add up to 1 within 2e-4
        assert!((r - g).abs() < 5e-4 && (g - b).abs() < 5e-4, "{curve:?} of {value}: {r} {g} {b}");
        g
    }

    #[test]
    fn known_values() {
        // Black is black, once clamped
        for curve in ALL {
            assert!((-0.005..=0.0).contains(&grey(curve, 0.0)), "{curve:?}");
        }
        let close = |a: f64, b: f64| (a - b).abs() < 5e-4;
        assert!(close(grey(ToneCurve::Linear, 0.18), 0.18));
        assert!(close(grey(ToneCurve::Srgb, 0.18), 0.4614));
        assert!(close(grey(ToneCurve::Srgb, 1.0), 1.0));
        // (0.18 · 0.2045786 − 0.000090537) / (0.18 · 0.6100222 + 0.238081) = 0.10559, and 1.0244881 / 1.654761 = 0.61912
        assert!(close(grey(ToneCurve::Aces, 0.18), srgb(0.10559)));
        assert!(close(grey(ToneCurve::Aces, 1.0), srgb(0.61912)));
        // Middle grey is the pivot of the sigmoid, at 0.5; the fit is good to 0.004
        assert!((grey(ToneCurve::Agx, 0.18) - 0.5).abs() < 0.004, "{}", grey(ToneCurve::Agx, 0.18));
        // White of ACES is where 0.016271 v² = 0.4083724 v + 0.2381715; that of AgX is 6.5 stops above grey
        assert!(close(grey(ToneCurve::Aces, 25.669), 1.0));
        assert!((grey(ToneCurve::Agx, 16.29) - 0.99858).abs() < 1e-4, "{}", grey(ToneCurve::Agx, 16.29));
        assert_eq!(grey(ToneCurve::Agx, 1e9), grey(ToneCurve::Agx, 17.0));
    }

    #[test]
    fn brighter_is_never_darker() {
        for curve in ALL {
            let mut last = f64::NEG_INFINITY;
            for i in 0..4000 {
                let value = grey(curve, (f64::from(i) * 0.01 - 20.0).exp2());
                assert!(value >= last, "{curve:?} falls at {i}: {value} after {last}");
                last = value;
            }
        }
    }

    #[test]
    fn film_looks_wash_out_what_is_too_bright() {
        // Ten times the brightness of white in red: sRGB clips to pure red, the film looks go towards white
        let red = [10.0, 0.1, 0.1];
        let spread = |curve| {
            let [r, g, _] = encode(curve, red).map(|v| v.clamp(0.0, 1.0));
            r - g
        };
        assert!(spread(ToneCurve::Aces) < spread(ToneCurve::Srgb) - 0.05, "{}", spread(ToneCurve::Aces));
        assert!(spread(ToneCurve::Agx) < spread(ToneCurve::Srgb) - 0.05, "{}", spread(ToneCurve::Agx));
    }

    #[test]
    fn no_number_is_too_strange() {
        for curve in [ToneCurve::Aces, ToneCurve::Agx] {
            for strange in [[-1.0, 0.5, f64::INFINITY], [f64::MAX, 0.0, -f64::MAX], [f64::INFINITY; 3]] {
                assert!(encode(curve, strange).iter().all(|v| v.is_finite()), "{curve:?} of {strange:?}");
            }
        }
    }
}
