//! The comparators themselves: they must accept a reference with its own noise and counts that are fair, and reject what is
//! wrong.

mod common;

use common::chi2;
use common::random::Random;
use common::references::{all, folder, present, rendered};
use dapple::diff::{Estimate, Verdict, compare, critical_value, level_of_each, relative_mse, two_sided_tail};
use dapple::film::{Film, Frame, write};
use dapple::scene::{self, Rect};

/// Independent normal numbers: SplitMix64 and the transform of Box and Muller.
struct Gaussian(u64);

impl Gaussian {
    /// Uniform in (0, 1].
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ bits >> 31) >> 11) as f64 * 2f64.powi(-53) + 2f64.powi(-54)
    }

    fn next(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// Another picture of the same scene with the same noise, before it is spoilt by `change` of the true means.
fn another(reference: &Estimate, change: impl Fn(&mut Estimate)) -> Estimate {
    let mut picture = reference.clone();
    change(&mut picture);
    let mut noise = Gaussian(1);
    for (mean, variance) in picture.mean.iter_mut().zip(&reference.variance) {
        for c in 0..3 {
            mean[c] += noise.next() * variance[c].sqrt();
        }
    }
    picture
}

/// Something that makes a picture wrong.
type Change<'a> = &'a dyn Fn(&mut Estimate);

/// Every pixel takes the place of its right neighbour, the last of a row that of the first.
fn move_one_pixel(picture: &mut Estimate) {
    picture.mean.chunks_exact_mut(picture.width).for_each(|row| row.rotate_right(1));
}

/// The 16 x 16 patch in which a change shows best: where it is bright against its noise. Empty in a picture
/// smaller than that.
fn clearest_patch(picture: &Estimate) -> Vec<usize> {
    let patch = |x0: usize, y0: usize| -> Vec<usize> {
        (0..256).map(|i| (y0 + i / 16) * picture.width + x0 + i % 16).collect()
    };
    let clarity = |patch: &[usize]| -> f64 {
        patch.iter().map(|&i| picture.mean[i][1] / (picture.variance[i][1].sqrt() + 0.001)).sum()
    };
    let corners = (0..=picture.height - 16)
        .step_by(8)
        .flat_map(|y| (0..=picture.width - 16).step_by(8).map(move |x| (x, y)));
    corners.map(|(x, y)| patch(x, y)).max_by(|a, b| clarity(a).total_cmp(&clarity(b))).unwrap_or_default()
}

#[test]
fn critical_values_are_those_of_the_tables() {
    // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, two-sided levels; last digit rounded there
    for (level, dof, expected) in [
        (0.10, 1, 6.314),
        (0.05, 1, 12.706),
        (0.05, 2, 4.303),
        (0.05, 3, 3.182),
        (0.01, 4, 4.604),
        (0.05, 15, 2.131),
        (0.02, 15, 2.602),
        (0.01, 15, 2.947),
        (0.002, 15, 3.733),
        (0.05, 100, 1.984),
        (0.01, 100, 2.626),
    ] {
        let value = critical_value(level, dof);
        assert!((value - expected).abs() <= 0.000_51, "level {level}, {dof} dof: {value}, table {expected}");
    }
}

#[test]
fn far_tails_are_exact_enough() {
    for dof in [1, 2, 15, 200] {
        assert_eq!(two_sided_tail(0.0, dof), 1.0);
        // The level of a pixel in a picture of a million
        let level = level_of_each(0.01, 1_000_000);
        let value = critical_value(level, dof);
        assert!((two_sided_tail(value, dof) / level - 1.0).abs() < 1e-5, "{dof} dof");
    }
    // Closed forms: 1 dof is Cauchy, with 2 dof the tail is 1 - t / sqrt(2 + t²)
    assert!((two_sided_tail(1.0, 1) - 0.5).abs() < 1e-15);
    assert!((two_sided_tail(1.0, 2) - (1.0 - 1.0 / 3f64.sqrt())).abs() < 1e-15);
}

#[test]
fn levels_of_many_tests_multiply_back() {
    let each = level_of_each(0.01, 12_288);
    assert!(((1.0 - each).powi(12_288) - 0.99).abs() < 1e-12);
    assert_eq!(level_of_each(0.01, 1), 0.01);
}

#[test]
fn accepts_noise_and_rejects_errors_on_every_reference() {
    let Some(folder) = folder().unwrap() else { return };
    let references = all(&folder).unwrap();
    assert!(!references.is_empty(), "no references in {}", folder.display());
    for reference in references {
        let (name, picture) = (&reference.name, &reference.picture);
        let verdict = |test: &Estimate| compare(picture, test, reference.systematic);

        let same = verdict(&another(picture, |_| {}));
        println!("{name:32} {same}");
        assert!(same.accepted(), "{name}, the same with its own noise: {same}");

        let patch = clearest_patch(picture);
        let brighter = |p: &mut Estimate| p.mean.iter_mut().flatten().for_each(|v| *v *= 1.05);
        let darker_patch =
            |p: &mut Estimate| patch.iter().for_each(|&i| p.mean[i] = p.mean[i].map(|v| v * 0.9));
        let changes: [(&str, Change); 4] = [
            ("5 % brighter", &brighter),
            ("moved one pixel", &move_one_pixel),
            ("a patch 10 % darker", &darker_patch),
            ("a pixel that is not a number", &|p| p.mean[77][2] = f64::NAN),
        ];
        for (what, change) in changes {
            let verdict = verdict(&another(picture, change));
            assert!(!verdict.accepted(), "{name}, {what}: {verdict}");
        }

        let mut lower = picture.clone();
        lower.height -= 1;
        lower.mean.truncate(lower.width * lower.height);
        lower.variance.truncate(lower.width * lower.height);
        assert!(matches!(verdict(&lower), Verdict::Refused(_)), "{name}, one row less");
    }
}

#[test]
fn missing_references_fail_where_they_are_needed() {
    let folder = tempfile::tempdir().unwrap();
    assert!(present(folder.path(), true).unwrap().is_some());
    let missing = folder.path().join("reference");
    assert!(present(&missing, true).unwrap_err().contains("is missing"));
    assert!(present(&missing, false).unwrap().is_none());
    // A folder without pictures is no success either
    assert!(all(folder.path()).is_err());
}

/// A grey picture without noise.
fn grey(width: usize, height: usize) -> Estimate {
    let pixels = width * height;
    Estimate { width, height, mean: vec![[0.5; 3]; pixels], variance: vec![[0.0; 3]; pixels] }
}

#[test]
fn refuses_what_it_cannot_judge() {
    let reference = grey(16, 16);
    let reason = |test: &Estimate| compare(&reference, test, 0.0).to_string();
    assert_eq!(reason(&grey(16, 15)), "FAIL size differs: reference 16 x 16, test 16 x 15");
    // As many pixels in another shape
    assert_eq!(reason(&grey(8, 32)), "FAIL size differs: reference 16 x 16, test 8 x 32");
    let mut test = grey(16, 16);
    test.mean[18][1] = f64::INFINITY;
    assert_eq!(reason(&test), "FAIL test has non-finite pixels, the first at 2,1");
    for variance in [f64::NAN, f64::INFINITY, -1.0] {
        let mut test = grey(16, 16);
        test.variance[0][0] = variance;
        assert_eq!(reason(&test), "FAIL test has a variance that is negative or not finite");
    }
    let mut test = grey(16, 16);
    test.variance.pop();
    assert_eq!(reason(&test), "FAIL test has planes of a length that is not its size");
    let small = compare(&grey(7, 16), &grey(7, 16), 0.0);
    assert_eq!(small.to_string(), "FAIL 7 x 16 is smaller than one block of 8 x 8");
}

#[test]
fn numbers_are_those_of_known_differences() {
    let reference = grey(20, 20);
    let mut test = grey(20, 20);
    assert_eq!(
        compare(&reference, &test, 0.0).to_string(),
        "pass pixels 100.000 %  blocks 100.00 %  mean off  0.000 %  relMSE 0.00e0 (less noise -3.8e-10)"
    );
    // Two of 400 pixels and one of 4 blocks (the border of 4 pixels is in none)
    test.mean[0] = [0.5, 0.9, 0.5];
    test.mean[399] = [0.9, 0.5, 0.5];
    let Verdict::Measured(measured) = compare(&reference, &test, 0.0) else { panic!("comparable pictures") };
    assert_eq!((measured.pixels, measured.blocks), (0.995, 0.75));
    assert!((measured.mean_off - 0.4 / 400.0 / 0.5).abs() < 1e-12);
    assert!((relative_mse(&reference.mean, &test.mean) - 2.0 * 0.16 / 0.26 / 1200.0).abs() < 1e-15);
    // Differences within the systematic and absolute allowance do not count
    let mut test = grey(20, 20);
    test.mean.iter_mut().flatten().for_each(|v| *v = 0.5 * 1.01 + 4.9e-4);
    assert!(compare(&reference, &test, 0.01).accepted());
    assert!(!compare(&reference, &test, 0.009).accepted());
}

#[test]
fn reads_the_means_and_variances_that_dapple_writes() {
    let window = Rect { x0: 5, y0: 3, x1: 25, y1: 19 };
    let frame = Frame { width: 30, height: 20, window, radiance_exponent: -24, depth_exponent: -12, seed: 1 };
    let film = Film::new(frame).unwrap();
    let mut picture = film.resolve();
    let mut noise = Gaussian(2);
    picture.rgb.iter_mut().flatten().for_each(|v| *v = noise.next() as f32);
    picture.variance.iter_mut().flatten().for_each(|v| *v = noise.uniform() as f32);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write(&path, &picture, &scene::Film::default(), &film.meta()).unwrap();
    let read = rendered(&path).unwrap();
    assert_eq!((read.width, read.height), (20, 16));
    assert_eq!(read.mean, Vec::from_iter(picture.rgb.iter().map(|v| v.map(f64::from))));
    assert_eq!(read.variance, Vec::from_iter(picture.variance.iter().map(|v| v.map(f64::from))));
}

#[test]
fn chi_square_of_the_tables() {
    // Abramowitz and Stegun, table 26.8, and closed forms for two and four degrees of freedom
    for (statistic, dof, p) in [
        (3.841_458_82, 1, 0.05),
        (18.307_038_05, 10, 0.05),
        (124.342_113_4, 100, 0.05),
        (149.449_253, 100, 0.001),
        (2.0, 2, f64::exp(-1.0)),
        (6.0, 4, 4.0 * f64::exp(-3.0)),
    ] {
        let got = chi2::p_value(statistic, dof);
        assert!((got - p).abs() < 1e-5 * p + 1e-7, "{statistic} {dof}: {got} not {p}");
    }
    assert!((chi2::p_value(1023.0, 1023) - 0.494).abs() < 0.002);
}

#[test]
fn chi_square_refuses_what_is_wrong() {
    let mut random = Random(11);
    let mut counts = vec![0_u64; 64];
    (0..64_000).for_each(|_| counts[(random.u32() >> 26) as usize] += 1);
    chi2::accept(&[("fair".to_string(), chi2::test_uniform(&counts))]);
    let refused = |counts: &[u64], expected: &[f64]| {
        let p = chi2::test(counts, expected);
        std::panic::catch_unwind(|| chi2::accept(&vec![("unfair".to_string(), p); 100])).is_err()
    };
    let fair = vec![1000.0; 64];
    // A fifth of one cell in the next one; a slope; a cell that must stay empty
    let mut moved = counts.clone();
    moved[3] -= 200;
    moved[4] += 200;
    assert!(refused(&moved, &fair));
    let slope: Vec<u64> = (0..64).map(|i| 900 + 200 * i / 63).collect();
    assert!(refused(&slope, &fair));
    let mut empty = fair.clone();
    empty[0] = 0.0;
    empty[1] = 2000.0;
    assert!(refused(&counts, &empty));
    assert!(std::panic::catch_unwind(|| chi2::accept(&[("nan".to_string(), f64::NAN)])).is_err());
    assert!(std::panic::catch_unwind(|| chi2::accept(&[])).is_err());
}
