//! Pearson's chi-square test: whether counts follow a distribution.

use dapple::diff::level_of_each;

/// The level at which all chi-square tests of a test function together fail by chance.
const LEVEL: f64 = 0.01;

/// Cells with fewer expected counts than this are put together (Cochran's rule).
const LEAST_EXPECTED: f64 = 5.0;

/// The probability that chi-square with `dof` degrees of freedom is at least `statistic`.
///
/// The regularised upper incomplete gamma function Q(dof/2, statistic/2), by its series or its continued fraction
/// (Abramowitz and Stegun 6.5.29 and 6.5.31, the latter by Lentz's method).
pub fn p_value(statistic: f64, dof: usize) -> f64 {
    let (a, x) = (dof as f64 / 2.0, statistic / 2.0);
    if dof == 0 || x <= 0.0 {
        return 1.0;
    }
    let front = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * 1e-16 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return (1.0 - front * sum).clamp(0.0, 1.0);
    }
    let mut b = x + 1.0 - a;
    let mut c = 1e300;
    let mut d = 1.0 / b;
    let mut h = d;
    for i in 1..100_000 {
        let n = -f64::from(i) * (f64::from(i) - a);
        b += 2.0;
        d = 1.0 / (n * d + b);
        c = b + n / c;
        h *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    (front * h).clamp(0.0, 1.0)
}

/// ln Γ(x) for x > 0: Stirling's series after moving x beyond 10.
fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut shift) = (x, 0.0);
    while x < 10.0 {
        shift += f64::ln(x);
        x += 1.0;
    }
    let r = 1.0 / (x * x);
    let series = (1.0 / 12.0 - r * (1.0 / 360.0 - r * (1.0 / 1260.0 - r / 1680.0))) / x;
    (x - 0.5) * x.ln() - x + 0.5 * (2.0 * std::f64::consts::PI).ln() + series - shift
}

/// p-value of counts against expected counts, which must add up to the same within rounding.
///
/// A count where less than 10⁻⁹ is expected gives 0.
pub fn test(observed: &[u64], expected: &[f64]) -> f64 {
    assert_eq!(observed.len(), expected.len());
    let total: f64 = observed.iter().map(|&o| o as f64).sum();
    let sum: f64 = expected.iter().sum();
    assert!((total - sum).abs() < 2e-3 * total, "{total} counts, {sum} expected");
    if observed.iter().zip(expected).any(|(&o, &e)| o > 0 && e < 1e-9) {
        return 0.0;
    }
    let mut cells: Vec<(f64, f64)> = observed.iter().zip(expected).map(|(&o, &e)| (o as f64, e)).collect();
    cells.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (mut statistic, mut count, mut pool) = (0.0, 0_usize, (0.0, 0.0));
    for (i, (o, e)) in cells.iter().enumerate() {
        pool = (pool.0 + o, pool.1 + e);
        // What is left after this cell must fill a cell of its own
        let rest: f64 = if i + 1 < cells.len() { cells[i + 1..].iter().map(|c| c.1).sum() } else { f64::MAX };
        if (pool.1 >= LEAST_EXPECTED && rest >= LEAST_EXPECTED) || i + 1 == cells.len() {
            if pool.1 > 0.0 {
                statistic += (pool.0 - pool.1) * (pool.0 - pool.1) / pool.1;
                count += 1;
            }
            pool = (0.0, 0.0);
        }
    }
    p_value(statistic, count.saturating_sub(1))
}

/// p-value of counts against equal chances.
pub fn test_uniform(observed: &[u64]) -> f64 {
    let total: u64 = observed.iter().sum();
    test(observed, &vec![total as f64 / observed.len() as f64; observed.len()])
}

/// Fails when one of the p-values is below the level that the number of them allows (Šidák).
pub fn accept(results: &[(String, f64)]) {
    assert!(!results.is_empty(), "no checks is no success");
    let level = level_of_each(LEVEL, results.len());
    let bad: Vec<_> = results.iter().filter(|(_, p)| p.is_nan() || *p < level).collect();
    assert!(bad.is_empty(), "{} tests, level {level:.2e}, refused: {bad:?}", results.len());
}
