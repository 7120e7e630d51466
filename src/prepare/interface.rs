//! Dielectric interfaces over opaque bases: tables of what a rough one lets through, and of what comes back to a rough base.

use crate::layout::{INTERFACE_COLUMNS, INTERFACE_ROWS, InterfaceInput, NONE};
use glam::{DVec3, dvec3};
use std::collections::HashMap;
use std::f64::consts::PI;

/// Steps along each axis of the square from which normals are drawn.
const STEPS: u32 = 32;
/// Steps along the cosine for what a smooth interface lets through.
const SMOOTH_STEPS: u32 = 4096;

/// The tables of a scene, each index with one of a kind.
pub(super) struct Interfaces<'a> {
    /// The words behind the materials.
    words: &'a mut Vec<[u32; 4]>,
    /// Words of the materials.
    first: u32,
    /// Where the tables are: what an index lets through, and what comes back under it.
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
        let mut place = |value: &dyn Fn(f64, f64) -> f64| {
            let at = *first + words.len() as u32;
            words.extend(table(value));
            at
        };
        let key = ior.to_bits();
        let through_table = if rough {
            *self.through.entry(key).or_insert_with(|| place(&|cos, alpha| through(cos, alpha, eta)))
        } else {
            NONE
        };
        let inner_table = if rough_base {
            *self.inner.entry(key).or_insert_with(|| place(&|cos, alpha| returned(cos, alpha, eta)))
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

/// The mean of a function over the normals that a direction (sin, 0, cos) sees (Heitz 2018).
fn over_visible(wo: DVec3, alpha: f64, value: impl Fn(DVec3) -> f64) -> f64 {
    let v = dvec3(alpha * wo.x, 0.0, wo.z).normalize();
    let (across, along) = (DVec3::Y, dvec3(-v.z, 0.0, v.x));
    let step = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let at = |i: u32, j: u32| {
        // Both halves of the disk are alike
        let (radius, phi) = (step(i).sqrt(), PI * (step(j) - 0.5));
        let x = radius * phi.cos();
        let s = 0.5 * (1.0 + v.z);
        let y = (1.0 - s) * (1.0 - x * x).sqrt() + s * radius * phi.sin();
        let n = across * x + along * y + v * (1.0 - x * x - y * y).max(0.0).sqrt();
        value(dvec3(alpha * n.x, alpha * n.y, n.z.max(1e-6)).normalize())
    };
    (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| at(i, j))).sum::<f64>() / f64::from(STEPS * STEPS)
}

/// Part of the light that the facets of a GGX interface let through, once, of light from outside (Walter et al. 2007).
fn through(cos: f64, alpha: f64, eta: f64) -> f64 {
    if alpha == 0.0 {
        return 1.0 - fresnel(cos, eta);
    }
    let wo = dvec3((1.0 - cos * cos).sqrt(), 0.0, cos);
    let masked = lambda(cos, alpha);
    over_visible(wo, alpha, |m| {
        let cos_m = wo.dot(m);
        let cos_t = (1.0 - (1.0 - cos_m * cos_m) / (eta * eta)).max(0.0).sqrt();
        let wi = -wo / eta + m * (cos_m / eta - cos_t);
        if wi.z >= 0.0 || cos_m <= 0.0 {
            return 0.0;
        }
        (1.0 - fresnel(cos_m, eta)) * (1.0 + masked) / (1.0 + masked + lambda(-wi.z, alpha))
    })
}

/// Part of the light that a white GGX mirror under a smooth interface scatters, once, and that the interface sends back to it; of light
/// that came in from a direction outside.
fn returned(cos: f64, alpha: f64, eta: f64) -> f64 {
    if alpha == 0.0 {
        return fresnel(cos, eta);
    }
    let sin = (1.0 - cos * cos).sqrt() / eta;
    let wo = dvec3(sin, 0.0, (1.0 - sin * sin).sqrt());
    let masked = lambda(wo.z, alpha);
    over_visible(wo, alpha, |m| {
        let wi = m * (2.0 * wo.dot(m)) - wo;
        if wi.z <= 0.0 {
            return 0.0;
        }
        fresnel(wi.z, 1.0 / eta) * (1.0 + masked) / (1.0 + masked + lambda(wi.z, alpha))
    })
}

/// 2 ∫ T(μ) μ dμ of a smooth interface.
fn smooth_mean(eta: f64) -> f64 {
    let step = |i: u32| (f64::from(i) + 0.5) / f64::from(SMOOTH_STEPS);
    let values = (0..SMOOTH_STEPS).map(step).map(|cos| 2.0 * cos * (1.0 - fresnel(cos, eta)));
    values.sum::<f64>() / f64::from(SMOOTH_STEPS)
}

/// A function of the cosine and the width, over their square roots: cells with the values at their corners, row by row of the width,
/// and then for each row 2 ∫ f(μ) μ dμ at its two ends.
fn table(value: impl Fn(f64, f64) -> f64) -> Vec<[u32; 4]> {
    let columns = INTERFACE_COLUMNS as usize;
    let root = |i: usize, count: u32| i as f64 / f64::from(count);
    // What grazes the surface exactly has no visible normals
    let cosine = |i: usize| root(i, INTERFACE_COLUMNS).powi(2).max(1e-6);
    let row = |j: usize| -> Vec<f64> {
        let alpha = root(j, INTERFACE_ROWS).powi(2);
        (0..=columns).map(|i| value(cosine(i), alpha)).collect()
    };
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
        for cos in [0.05, 0.3, 0.7, 1.0] {
            for (rough, smooth) in [
                (through(cos, 1e-3, 1.5), through(cos, 0.0, 1.5)),
                (returned(cos, 1e-3, 1.5), fresnel(cos, 1.5)),
            ] {
                assert!((rough - smooth).abs() < 2e-3, "{cos}: {rough} {smooth}");
            }
            // What is under no interface does not come back
            assert_eq!(returned(cos, 0.3, 1.0), 0.0);
        }
        // Widths send more of the light beyond the critical angle
        assert!(returned(1.0, 0.5, 1.5) > 0.3 && returned(1.0, 0.1, 1.5) < 0.1);
    }

    #[test]
    fn means_are_those_of_what_is_between_the_values() {
        let row: Vec<f64> = (0..=32).map(|i| 2.0 - f64::from(i) / 32.0).collect();
        // 4 ∫ (2 − x) x³ dx
        assert!((mean(&row) - (2.0 - 0.8)).abs() < 1e-12);
        let words = table(|cos, alpha| cos.sqrt() + 10.0 * alpha.sqrt());
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
