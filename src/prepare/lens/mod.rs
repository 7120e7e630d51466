//! What the kernels read of the lens of the camera: interfaces, bounds of the exit pupil, the picture of an opening.

mod opening;
mod pupil;
mod trace;

pub use trace::{Glass, LensRay, LensTrace};

use super::Prepared;
use crate::Result;
use crate::layout::PUPIL_INTERVALS;
use crate::scene::{LensCamera, Measure, Opening, Scene};
use std::f64::consts::PI;

/// 1 / λ² of red, green and blue in 1 / µm², as `camera/lens_system.glsl` has it of `base/spectrum.glsl`.
pub const INVERSE_SQUARES: [f64; 3] = [2.67519, 3.31663, 4.63877];

/// The buffer `lens`, with all that the camera and the film look up, and what the uniform block says of it. Lengths are in millimetres.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LensTables {
    /// Words of the buffer.
    pub words: Vec<[u32; 4]>,
    /// Number of interfaces; their records come first.
    pub interfaces: u32,
    /// The one that is the stop.
    pub stop: u32,
    /// Radius of the stop.
    pub stop_radius: f32,
    /// From the film to the last vertex.
    pub rear: f32,
    /// Factor on cos⁴ θ · area.
    pub weight: f32,
    /// Angle of a millimetre of film.
    pub spread: f32,
    /// First word with bounds of the exit pupil.
    pub pupil_bounds: u32,
    /// Intervals in a millimetre of film.
    pub pupil_scale: f32,
    /// First word with cells of the picture of the opening.
    pub opening_cells: u32,
    /// Its columns and rows.
    pub opening_size: [u32; 2],
    /// First word with cells of the pixel filter.
    pub filter_cells: u32,
    /// Magnitude of the pixel filter over its whole.
    pub filter_weight: f32,
}

/// Fills the tables.
pub(super) fn prepare(scene: &Scene, out: &mut Prepared) -> Result<()> {
    if let Some(camera) = scene.camera.lens_system() {
        system(camera, &mut out.lens)?;
    }
    if let Some(image) = scene.camera.opening().and_then(|opening| opening.image) {
        opening::prepare(&scene.images[image], scene.images.name(image), &mut out.lens)?;
    }
    Ok(())
}

/// The tables of a lens of several elements.
fn system(camera: &LensCamera, out: &mut LensTables) -> Result<()> {
    let paraxial = camera.paraxial()?;
    let rear = camera.film_distance()?;
    let traces = traces(camera, rear, paraxial.stop.interface);
    let [first, ..] = &traces;
    out.words =
        first.records().iter().flat_map(|record| bytemuck::cast::<_, [[u32; 4]; 2]>(*record)).collect();
    out.interfaces = camera.system.interfaces.len() as u32;
    out.stop = out.interfaces - 1 - paraxial.stop.interface as u32;
    out.stop_radius = (0.5 * camera.stop_diameter) as f32;
    out.rear = rear as f32;
    out.weight = weight(camera, &paraxial, rear) as f32;
    out.spread = (1.0 / paraxial.focal_length) as f32;

    let film_radius = 0.5 * f64::from(camera.sensor_diagonal) * f64::from(camera.unit);
    let used = if camera.dispersion { &traces[..] } else { &traces[..1] };
    out.pupil_bounds = out.words.len() as u32;
    out.pupil_scale = (f64::from(PUPIL_INTERVALS) / film_radius) as f32;
    out.words
        .extend(pupil::bounds(used, film_radius).iter().map(|bounds| bytemuck::cast::<_, [u32; 4]>(*bounds)));
    Ok(())
}

/// The lens in the three colours, which are the same where it does not disperse. The stop lets through all that the shape of
/// the opening may.
pub(crate) fn traces(camera: &LensCamera, rear: f64, stop: usize) -> [LensTrace; 3] {
    let reach = if camera.opening.image.is_some() { std::f64::consts::SQRT_2 } else { 1.0 };
    let stopped = (stop, 0.5 * camera.stop_diameter * reach);
    INVERSE_SQUARES.map(|inverse_square| {
        let glass = if camera.dispersion { Glass::At(inverse_square) } else { Glass::LineD };
        LensTrace::new(&camera.system, rear, Some(stopped), glass)
    })
}

/// What cos⁴ θ · area is multiplied with: one over Z², and where a pixel is a radiance, over the projected solid angle of the
/// paraxial exit pupil seen from the middle of the film, π sin² of its half-angle. An opening that is not round lets through
/// less in the circle around it; that is made up for.
fn weight(camera: &LensCamera, paraxial: &crate::scene::Paraxial, rear: f64) -> f64 {
    let tan_squared = paraxial.tan_image_angle(rear).powi(2);
    let measure = match camera.measure {
        Measure::Radiance => PI * tan_squared / (1.0 + tan_squared),
        Measure::Irradiance => 1.0,
    };
    1.0 / (rear * rear * measure * area_part(&camera.opening))
}

/// Area of an opening in parts of the circle; the weights of a picture have the mean of one.
fn area_part(opening: &Opening) -> f64 {
    let [x, y] = opening.half_size().map(f64::from);
    let corners = f64::from(opening.blades);
    let polygon = if opening.blades == 0 { 1.0 } else { 0.5 * corners * (2.0 * PI / corners).sin() / PI };
    x * y * polygon
}
