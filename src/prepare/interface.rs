//! Dielectric interfaces over opaque bases: tables of what a rough one lets through, and of what leaves rough metal under one.

use crate::layout::{INTERFACE_COLUMNS, INTERFACE_ROWS, InterfaceInput, NONE};
use glam::{DVec3, dvec3};
use std::collections::HashMap;
use std::f64::consts::PI;

/// Steps along each axis of the square from which normals are drawn.
const STEPS: u32 = 32;
/// Cosines beyond the critical angle, and rounds in which sums converge.
const TRAPPED: u32 = 24;
const ROUNDS: u32 = 100;
/// Steps along the cosine for what a smooth interface lets through.
const SMOOTH_STEPS: u32 = 4096;

/// The tables of a scene, each index with one of a kind.
pub(super) struct Interfaces<'a> {
    /// The words behind the materials.
    words: &'a mut Vec<[u32; 4]>,
    /// Words of the materials.
    first: u32,
    /// Where the tables are: what an index lets through, and what leaves metal under it.
    through: HashMap<u32, u32>,
    inner: HashMap<u32, u32>,
}

impl<'a> Interfaces<'a> {
    /// None yet, behind so many words of materials.
    pub fn new(words: &'a mut Vec<[u32; 4]>, first: u32) -> Self {
        Self { words, first, through: HashMap::new(), inner: HashMap::new() }
    }

    /// The record of an interface, with the tables that it needs.
    pub fn input(&mut self, ior: f32, rough: bool, rough_base: bool) -> InterfaceInput {
        let eta = f64::from(ior);
        let Self { words, first, .. } = self;
        let mut place = |row: &dyn Fn(f64) -> Vec<f64>| {
            let at = *first + words.len() as u32;
            words.extend(table(row));
            at
        };
        let key = ior.to_bits();
        let through_table = if rough {
            *self.through.entry(key).or_insert_with(|| place(&|alpha| row_through(alpha, eta)))
        } else {
            NONE
        };
        let inner_table = if rough_base {
            *self.inner.entry(key).or_insert_with(|| place(&|alpha| leaving(alpha, eta)))
        } else {
            NONE
        };
        InterfaceInput { through_table, inner_table, through_mean: smooth_mean(eta) as f32, spare: 0 }
    }
}

/// Unpolarised reflectance of a dielectric; `eta` is the index behind over that in front.
fn fresnel(cos: f64, eta: f64) -> f64 {
    let sin2 = (1.0 - cos * cos) / (eta * eta);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2).sqrt();
    let parallel = (eta * cos - cos_t) / (eta * cos + cos_t);
    let perpendicular = (cos - eta * cos_t) / (cos + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// The auxiliary function of masking by GGX (Heitz 2014).
fn lambda(cos: f64, alpha: f64) -> f64 {
    0.5 * ((1.0 + alpha * alpha * (1.0 / (cos * cos) - 1.0)).sqrt() - 1.0)
}

/// Calls a function with STEPS² of the normals that a direction (sin, 0, cos) sees, all as likely (Heitz 2018).
fn over_visible(wo: DVec3, alpha: f64, mut each: impl FnMut(DVec3)) {
    let v = dvec3(alpha * wo.x, 0.0, wo.z).normalize();
    let (across, along) = (DVec3::Y, dvec3(-v.z, 0.0, v.x));
    let step = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let s = 0.5 * (1.0 + v.z);
    for i in 0..STEPS * STEPS {
        // Both halves of the disk are alike
        let (radius, phi) = (step(i / STEPS).sqrt(), PI * (step(i % STEPS) - 0.5));
        let x = radius * phi.cos();
        let y = (1.0 - s) * (1.0 - x * x).sqrt() + s * radius * phi.sin();
        let n = across * x + along * y + v * (1.0 - x * x - y * y).max(0.0).sqrt();
        each(dvec3(alpha * n.x, alpha * n.y, n.z.max(1e-6)).normalize());
    }
}

/// What a GGX interface of a width lets through, by the square root of the cosine.
fn row_through(alpha: f64, eta: f64) -> Vec<f64> {
    // What grazes the surface exactly has no visible normals
    let cosines =
        (0..=INTERFACE_COLUMNS).map(|i| (f64::from(i) / f64::from(INTERFACE_COLUMNS)).powi(2).max(1e-6));
    cosines.map(|cos| through(cos, alpha, eta)).collect()
}

/// Part of the light that the facets of a GGX interface let through, once, of light from outside (Walter et al. 2007).
fn through(cos: f64, alpha: f64, eta: f64) -> f64 {
    if alpha == 0.0 {
        return 1.0 - fresnel(cos, eta);
    }
    let wo = dvec3((1.0 - cos * cos).sqrt(), 0.0, cos);
    let masked = lambda(cos, alpha);
    let mut sum = 0.0;
    over_visible(wo, alpha, |m| {
        let cos_m = wo.dot(m);
        let cos_t = (1.0 - (1.0 - cos_m * cos_m) / (eta * eta)).max(0.0).sqrt();
        let wi = -wo / eta + m * (cos_m / eta - cos_t);
        if wi.z < 0.0 && cos_m > 0.0 {
            sum += (1.0 - fresnel(cos_m, eta)) * (1.0 + masked) / (1.0 + masked + lambda(-wi.z, alpha));
        }
    });
    sum / f64::from(STEPS * STEPS)
}

/// White GGX metal under a smooth interface, of a width: for each direction outside by the square root of its cosine, e such that
/// f_metal T T / (η² e(o) e(i)) sends out in all what the whole series does, from the first reflection on.
///
/// Directions are cosines below the interface: those that light comes in by, and then those beyond the critical angle.
fn leaving(alpha: f64, eta: f64) -> Vec<f64> {
    let outside = (0..=INTERFACE_COLUMNS).map(|i| (f64::from(i) / f64::from(INTERFACE_COLUMNS)).powi(2));
    let critical = (1.0 - 1.0 / (eta * eta)).sqrt();
    let beyond = (0..TRAPPED).map(|i| critical * f64::from(i) / f64::from(TRAPPED));
    let inside = outside.map(|cos| (1.0 - (1.0 - cos * cos) / (eta * eta)).sqrt());
    let cosines: Vec<f64> = beyond.chain(inside).collect();
    let returned: Vec<f64> = cosines.iter().map(|&cos| fresnel(cos, 1.0 / eta)).collect();
    if alpha == 0.0 {
        return returned[TRAPPED as usize..].iter().map(|returned| (1.0 - returned).sqrt()).collect();
    }
    let scattered: Vec<Vec<f64>> = cosines.iter().map(|&cos| scattered(cos, alpha, &cosines)).collect();
    let over = |row: &[f64], value: &dyn Fn(usize) -> f64| -> f64 {
        row.iter().enumerate().map(|(i, part)| part * value(i)).sum()
    };
    let first: Vec<f64> = scattered.iter().map(|row| over(row, &|i| 1.0 - returned[i])).collect();
    let mut whole = first.clone();
    for _ in 0..ROUNDS {
        let again = scattered.iter().map(|row| over(row, &|i| returned[i] * whole[i]));
        whole = first.iter().zip(again).map(|(first, again)| first + again).collect();
    }
    // Scaled alike by rows and columns (Sinkhorn and Knopp 1967); what no light leaves by counts for nothing
    let mut gain = vec![1.0; cosines.len()];
    for _ in 0..ROUNDS {
        let sums = scattered.iter().map(|row| over(row, &|i| (1.0 - returned[i]) * gain[i]));
        let scaled = gain.iter().zip(sums).zip(&whole);
        gain = scaled.map(|((gain, sum), whole)| (gain * whole / sum.max(1e-12)).sqrt()).collect();
    }
    gain[TRAPPED as usize..].iter().map(|gain| 1.0 / gain).collect()
}

/// Where white GGX metal scatters light from a direction, once: parts at cosines that grow.
fn scattered(cos: f64, alpha: f64, cosines: &[f64]) -> Vec<f64> {
    let cos = cos.max(1e-3);
    let wo = dvec3((1.0 - cos * cos).sqrt(), 0.0, cos);
    let masked = lambda(cos, alpha);
    let mut parts = vec![0.0; cosines.len()];
    over_visible(wo, alpha, |m| {
        let up = (m * (2.0 * wo.dot(m)) - wo).z;
        if up > 0.0 {
            let part = (1.0 + masked) / (1.0 + masked + lambda(up, alpha)) / f64::from(STEPS * STEPS);
            let above = cosines.partition_point(|&cosine| cosine < up).clamp(1, cosines.len() - 1);
            let share = ((up - cosines[above - 1]) / (cosines[above] - cosines[above - 1])).clamp(0.0, 1.0);
            parts[above] += part * share;
            parts[above - 1] += part * (1.0 - share);
        }
    });
    parts
}

/// 2 ∫ T(μ) μ dμ of a smooth interface.
fn smooth_mean(eta: f64) -> f64 {
    let step = |i: u32| (f64::from(i) + 0.5) / f64::from(SMOOTH_STEPS);
    let values = (0..SMOOTH_STEPS).map(step).map(|cos| 2.0 * cos * (1.0 - fresnel(cos, eta)));
    values.sum::<f64>() / f64::from(SMOOTH_STEPS)
}

/// A table of rows, one for each width by its square root, with values by the square root of the cosine: cells with the values at their
/// corners, row by row, and then for each row 2 ∫ f(μ) μ dμ at its two ends.
fn table(row: impl Fn(f64) -> Vec<f64>) -> Vec<[u32; 4]> {
    let columns = INTERFACE_COLUMNS as usize;
    let row = |j: usize| row((j as f64 / f64::from(INTERFACE_ROWS)).powi(2));
    let rows: Vec<_> = (0..=INTERFACE_ROWS as usize).map(row).collect();
    let word = |numbers: [f64; 4]| numbers.map(|number| (number as f32).to_bits());
    let cells = rows.windows(2).flat_map(|pair| {
        (0..columns).map(move |i| word([pair[0][i], pair[0][i + 1], pair[1][i], pair[1][i + 1]]))
    });
    let means = rows.windows(2).map(|pair| word([mean(&pair[0]), mean(&pair[1]), 0.0, 0.0]));
    cells.chain(means).collect()
}

/// 2 ∫ f(μ) μ dμ = 4 ∫ f(x²) x³ dx of what is linear in x between the values of a row, so that it fits what kernels interpolate.
fn mean(row: &[f64]) -> f64 {
    let step = 1.0 / (row.len() - 1) as f64;
    let cell = |(i, ends): (usize, &[f64])| {
        let (from, to) = (i as f64 * step, (i + 1) as f64 * step);
        let slope = (ends[1] - ends[0]) / step;
        let start = ends[0] - slope * from;
        start * (to.powi(4) - from.powi(4)) + 0.8 * slope * (to.powi(5) - from.powi(5))
    };
    row.windows(2).enumerate().map(cell).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_interface_lets_through_what_is_known() {
        // Diffuse reflectance from outside and inside at an index of 1.5 (Judd 1942): 0.0918 and 0.5963
        let mean = smooth_mean(1.5);
        assert!((mean - 0.9082).abs() < 1e-4, "{mean}");
        assert!((1.0 - mean / 2.25 - 0.5963).abs() < 1e-4, "{mean}");
        assert_eq!(smooth_mean(1.0), 1.0);
        let inside =
            (0..1000).map(|i| (f64::from(i) + 0.5) / 1000.0).map(|cos| 2.0 * cos * fresnel(cos, 1.0 / 1.5));
        assert!((inside.sum::<f64>() / 1000.0 - 0.5963).abs() < 1e-3);
    }

    #[test]
    fn a_rough_one_goes_over_into_it() {
        for (i, leaving) in leaving(1e-3, 1.5).into_iter().enumerate().skip(16) {
            let cos = (i as f64 / f64::from(INTERFACE_COLUMNS)).powi(2);
            let rough = through(cos, 1e-3, 1.5);
            let smooth = 1.0 - fresnel(cos, 1.5);
            assert!((rough - smooth).abs() < 2e-3, "{cos}: {rough} {smooth}");
            assert!((leaving * leaving - smooth).abs() < 1e-2, "{cos}: {leaving} {smooth}");
        }
        // Under no interface, all leaves at once
        assert!(leaving(0.3, 1.0).iter().all(|leaving| (leaving - 1.0).abs() < 1e-6));
    }

    #[test]
    fn means_are_those_of_what_is_between_the_values() {
        let row: Vec<f64> = (0..=32).map(|i| 2.0 - f64::from(i) / 32.0).collect();
        // 4 ∫ (2 − x) x³ dx
        assert!((mean(&row) - (2.0 - 0.8)).abs() < 1e-12);
        let words = table(|alpha| (0..=32).map(|i| f64::from(i) / 32.0 + 10.0 * alpha.sqrt()).collect());
        assert_eq!(words.len() as u32, (INTERFACE_COLUMNS + 1) * INTERFACE_ROWS);
        let corners = words[(INTERFACE_COLUMNS + 1) as usize].map(f32::from_bits);
        let (x, y) = (1.0 / 32.0, 10.0 / 16.0);
        assert_eq!(corners, [x + y, 2.0 * x + y, x + 2.0 * y, 2.0 * x + 2.0 * y]);
    }

    #[test]
    fn an_index_has_one_table() {
        let mut words = Vec::new();
        let mut interfaces = Interfaces::new(&mut words, 24);
        let smooth = interfaces.input(1.5, false, false);
        assert_eq!((smooth.through_table, smooth.inner_table), (NONE, NONE));
        let rough = interfaces.input(1.5, true, false);
        let both = interfaces.input(1.5, true, true);
        assert_eq!((rough.through_table, both.through_table), (24, 24));
        assert_eq!(both.inner_table as usize, 24 + words.len() / 2);
    }
}
