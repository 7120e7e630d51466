//! Student's t distribution: how far from zero is too far.

use std::f64::consts::{FRAC_2_PI, PI};

/// Probability that |t| with `dof` degrees of freedom is at least `t`, for `t >= 0`.
///
/// Finite sums for whole degrees of freedom (Abramowitz and Stegun, 26.7.3 and 26.7.4). They give the
/// probability of the complement, so the answer has an error of about 1e-15: fit for levels above 1e-10.
pub fn two_sided_tail(t: f64, dof: u32) -> f64 {
    let angle = (t / f64::from(dof).sqrt()).atan();
    let cos2 = angle.cos().powi(2);
    // Terms 1, 1/2 cos², 1·3/(2·4) cos⁴ ... (even) or 1, 2/3 cos², 2·4/(3·5) cos⁴ ... (odd)
    let odd = dof % 2;
    let series = (1..dof / 2).fold((1.0, 1.0), |(sum, term), k| {
        let k = f64::from(2 * k + odd);
        let term = term * (k - 1.0) / k * cos2;
        (sum + term, term)
    });
    let inside = match (dof, odd) {
        (1, _) => FRAC_2_PI * angle,
        (_, 1) => FRAC_2_PI * (angle + angle.sin() * angle.cos() * series.0),
        _ => angle.sin() * series.0,
    };
    1.0 - inside
}

/// The `t` that |t| with `dof` degrees of freedom exceeds with probability `level`.
pub fn critical_value(level: f64, dof: u32) -> f64 {
    // The tail falls as the angle atan(t / √dof) grows from 0 to a right angle: halve that interval
    let scale = f64::from(dof).sqrt();
    let (mut low, mut high) = (0.0, PI / 2.0);
    for _ in 0..100 {
        let middle = (low + high) / 2.0;
        if two_sided_tail(scale * f64::tan(middle), dof) > level {
            low = middle;
        } else {
            high = middle;
        }
    }
    scale * high.tan()
}

/// The level of each of `count` independent tests that fail by chance with probability `level` together (Šidák).
pub fn level_of_each(level: f64, count: usize) -> f64 {
    // 1 - (1 - level)^(1/count) without the loss of digits
    -((-level).ln_1p() / count as f64).exp_m1()
}
