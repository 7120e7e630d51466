//! The sphere of directions in cells, for counts against the integral of a density.

use std::f64::consts::{PI, TAU};

/// Cells of the sphere of directions: by z, then by angle; each is divided into midpoints of the integral.
pub const CELLS_Z: usize = 24;
pub const CELLS_PHI: usize = 24;
pub const PARTS_Z: usize = 32;
pub const PARTS_PHI: usize = 8;

pub fn midpoints() -> Vec<[f32; 3]> {
    let (rows, columns) = (CELLS_Z * PARTS_Z, CELLS_PHI * PARTS_PHI);
    let mut all = Vec::with_capacity(rows * columns);
    for row in 0..rows {
        let z = (row as f64 + 0.5) / rows as f64 * 2.0 - 1.0;
        let r = (1.0 - z * z).sqrt();
        for column in 0..columns {
            let phi = (column as f64 + 0.5) / columns as f64 * TAU;
            all.push([(r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32]);
        }
    }
    all
}

pub fn cell_of([x, y, z]: [f64; 3]) -> usize {
    let row = ((z + 1.0) / 2.0 * CELLS_Z as f64).clamp(0.0, CELLS_Z as f64 - 1.0) as usize;
    let column = (y.atan2(x) / TAU).rem_euclid(1.0) * CELLS_PHI as f64;
    row * CELLS_PHI + (column as usize).min(CELLS_PHI - 1)
}

/// Integrals over each cell of values at the midpoints.
pub fn cell_integrals(at_midpoints: impl Iterator<Item = f64>) -> Vec<f64> {
    let columns = CELLS_PHI * PARTS_PHI;
    let area = 4.0 * PI / (CELLS_Z * PARTS_Z * columns) as f64;
    let mut cells = vec![0.0; CELLS_Z * CELLS_PHI];
    for (i, value) in at_midpoints.enumerate() {
        let (row, column) = (i / columns / PARTS_Z, i % columns / PARTS_PHI);
        cells[row * CELLS_PHI + column] += value * area;
    }
    cells
}
