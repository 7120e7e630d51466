//! The importance table of an environment image.

use super::atlas::Reader;
use super::textures::References;
use super::{Prepared, alias};
use crate::layout::EnvironmentCell;
use crate::scene::{ColorSpace, DirectionMapping, Environment, Image, Scene, Texture, UvTransform};
use std::f64::consts::PI;

/// Most columns of the table. A wider image is averaged: the table only says where to look more often.
const MOST_COLUMNS: u32 = 1024;
/// Columns and rows of a table that says the same everywhere.
const EVEN_CELLS: [u32; 2] = [64, 32];
/// Share of the samples that goes to all directions alike, so that no light is missed where the table is coarse.
const EVEN_SHARE: f64 = 0.02;

/// Fills the table, when the environment is an image.
pub(super) fn prepare(scene: &Scene, textures: &References, out: &mut Prepared) {
    let Some(environment) = &scene.environment else { return };
    let Some(handle) = environment.texture() else { return };
    let mapping = environment.mapping;
    out.features.environment_image = true;
    out.features.environment_equal_area = mapping == DirectionMapping::EqualArea;
    out.environment_texture = textures.reference(handle);
    let weights = match &scene.textures[handle] {
        // A moved or scaled image is looked at evenly, as are other textures: right, if noisier.
        Texture::Image(image) if image.uv == UvTransform::default() => {
            let (texture, image) = (image, &scene.images[image.image]);
            let read = Reader { image, decode: texture.color_space == ColorSpace::Srgb };
            let size = [image.width.min(MOST_COLUMNS), image.height.clamp(1, MOST_COLUMNS / 2)];
            out.environment_size = size;
            weights(size, mapping, |column, row| cell(&read, image, column, size[1] - 1 - row, size))
        }
        _ => {
            out.environment_size = EVEN_CELLS;
            weights(EVEN_CELLS, mapping, |_, _| 1.0)
        }
    };
    out.environment = alias::table(&weights)
        .into_iter()
        .map(|slot| EnvironmentCell { accept: slot.accept, alias: slot.alias, chance: slot.chance, spare: 0 })
        .collect();
}

/// Brightness times solid angle of each cell, row by row, v growing with the row.
fn weights(
    [columns, rows]: [u32; 2],
    mapping: DirectionMapping,
    brightness: impl Fn(u32, u32) -> f64,
) -> Vec<f64> {
    let solid_angle = |row: u32| match mapping {
        DirectionMapping::Equirectangular => (((f64::from(row) + 0.5) / f64::from(rows) - 0.5) * PI).cos(),
        DirectionMapping::EqualArea => 1.0,
    };
    let mut weights = Vec::with_capacity(columns as usize * rows as usize);
    for row in 0..rows {
        for column in 0..columns {
            weights.push(brightness(column, row) * solid_angle(row));
        }
    }
    let sum: f64 = weights.iter().sum();
    let whole: f64 = (0..rows).map(solid_angle).sum::<f64>() * f64::from(columns);
    for (i, weight) in weights.iter_mut().enumerate() {
        let even = solid_angle(i as u32 / columns) / whole;
        *weight = (1.0 - EVEN_SHARE) * if sum > 0.0 { *weight / sum } else { 0.0 } + EVEN_SHARE * even;
    }
    weights
}

/// Mean brightness of the texels of a cell and their neighbours, which a bilinear look-up in the cell may meet.
fn cell(read: &Reader<'_>, image: &Image, column: u32, row_from_top: u32, size: [u32; 2]) -> f64 {
    let span = |i: u32, cells: u32, texels: u32| {
        let (from, to) = (u64::from(i) * u64::from(texels), u64::from(i + 1) * u64::from(texels));
        let (from, to) = ((from / u64::from(cells)) as u32, to.div_ceil(u64::from(cells)) as u32);
        (from.saturating_sub(1), (to + 1).min(texels))
    };
    let ((x0, x1), (y0, y1)) =
        (span(column, size[0], image.width), span(row_from_top, size[1], image.height));
    let mut sum = 0.0;
    for y in y0..y1 {
        for x in x0..x1 {
            let [r, g, b, _] = read.linear(x, y);
            sum += (f64::from(r) + f64::from(g) + f64::from(b)).max(0.0);
        }
    }
    sum / (f64::from(x1 - x0) * f64::from(y1 - y0))
}

/// The rotation of an environment as rows of the map from world directions to those of the texture.
pub(crate) fn rows(environment: &Environment) -> [[f32; 3]; 3] {
    // The inverse of a rotation is its transpose: its rows are the columns of the rotation.
    let m = environment.world_from_environment;
    [m.x_axis.to_array(), m.y_axis.to_array(), m.z_axis.to_array()]
}
