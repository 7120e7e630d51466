//! Rays through a lens, in 64 bits: the twin of `shaders/camera/lens_trace.glsl`.

use crate::layout;
use crate::scene::LensSystem;
use glam::{DVec2, DVec3};

/// Which index of refraction a lens has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Glass {
    /// That of the d line.
    LineD,
    /// By Cauchy's formula at a wavelength, given as 1 / λ² in 1 / µm².
    At(f64),
}

/// A ray in lens space: millimetres, x to the right, y up, z from the film towards the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensRay {
    /// A point on it.
    pub origin: DVec3,
    /// Of unit length.
    pub direction: DVec3,
}

#[derive(Debug, Clone, Copy)]
struct Step {
    position: f64,
    curvature: f64,
    aperture: f64,
    /// Indices of refraction towards the film and towards the scene.
    index: [f64; 2],
    cauchy: [f64; 2],
    index_d: f64,
}

/// A lens at a distance from the film, for rays in both directions.
#[derive(Debug, Clone)]
pub struct LensTrace {
    /// From the film to the scene.
    steps: Vec<Step>,
    /// The step that is the stop.
    stop: Option<usize>,
}

impl LensTrace {
    /// A lens whose last vertex is at `rear` millimetres from the film. `stop` is an interface and the radius that it has in place
    /// of that of the file.
    pub fn new(system: &LensSystem, rear: f64, stop: Option<(usize, f64)>, glass: Glass) -> Self {
        let cauchy = |i: usize| match i {
            0 => [1.0, 0.0],
            _ => system.interfaces[i - 1].cauchy(),
        };
        let index = |[a, b]: [f64; 2], d: f64| match glass {
            Glass::LineD => d,
            Glass::At(inverse_square) => a + b * inverse_square,
        };
        let mut position = rear;
        let mut steps = Vec::with_capacity(system.interfaces.len());
        for (i, interface) in system.interfaces.iter().enumerate().rev() {
            // The thickness of the last interface has no meaning
            position += if i + 1 == system.interfaces.len() { 0.0 } else { interface.thickness };
            let own = 0.5 * interface.aperture;
            let front = system.index_before(i);
            steps.push(Step {
                position,
                curvature: if interface.radius == 0.0 { 0.0 } else { -1.0 / interface.radius },
                aperture: stop.filter(|(at, _)| *at == i).map_or(own, |(_, radius)| radius),
                index: [index(interface.cauchy(), interface.index), index(cauchy(i), front)],
                cauchy: cauchy(i),
                index_d: front,
            });
        }
        let stop = stop.map(|(at, _)| steps.len() - 1 - at);
        Self { steps, stop }
    }

    /// The records for the kernels.
    pub fn records(&self) -> Vec<layout::LensInterface> {
        let record = |step: &Step| layout::LensInterface {
            position: step.position as f32,
            curvature: step.curvature as f32,
            aperture_squared: (step.aperture * step.aperture) as f32,
            index: step.index_d as f32,
            cauchy: step.cauchy.map(|x| x as f32),
            spare: [0.0; 2],
        };
        self.steps.iter().map(record).collect()
    }

    /// Where the vertex of the interface nearest to the film is.
    pub fn rear(&self) -> f64 {
        self.steps.first().map_or(0.0, |step| step.position)
    }

    /// Radius of what the last surface lets through, and how far its rim is in front of its vertex.
    pub(super) fn last_surface(&self) -> (f64, f64) {
        let Some(Step { aperture, curvature, .. }) = self.steps.first() else { return (0.0, 0.0) };
        let aperture = if *curvature == 0.0 { *aperture } else { aperture.min(1.0 / curvature.abs()) };
        let f = curvature * aperture * aperture;
        (aperture, f / (1.0 + (1.0 - curvature * f).max(0.0).sqrt()))
    }

    /// Where a ray from the film crosses the stop, whatever its size; None when it does not get there.
    pub(super) fn at_stop(&self, ray: LensRay) -> Option<DVec2> {
        let stop = self.stop?;
        let there = self.steps[..stop]
            .iter()
            .try_fold(ray, |ray, step| boundary(ray, step, step.index[0] / step.index[1]))?;
        let along = (self.steps[stop].position - there.origin.z) / there.direction.z;
        Some((there.origin + along * there.direction).truncate())
    }

    /// A ray from the film to the scene; None when it does not get through.
    pub fn to_scene(&self, ray: LensRay) -> Option<LensRay> {
        self.steps.iter().try_fold(ray, |ray, step| boundary(ray, step, step.index[0] / step.index[1]))
    }

    /// A ray from the scene to the film; None when it does not get through.
    pub fn to_film(&self, ray: LensRay) -> Option<LensRay> {
        self.steps.iter().rev().try_fold(ray, |ray, step| boundary(ray, step, step.index[1] / step.index[0]))
    }

    /// The points where a ray from the film meets the interfaces, up to where it is stopped, and how it leaves if it is not.
    pub fn path(&self, ray: LensRay) -> (Vec<DVec3>, Option<LensRay>) {
        let mut points = vec![ray.origin];
        let mut ray = ray;
        for step in &self.steps {
            match boundary(ray, step, step.index[0] / step.index[1]) {
                Some(next) => ray = next,
                None => return (points, None),
            }
            points.push(ray.origin);
        }
        (points, Some(ray))
    }
}

/// To the surface, through its opening, and bent by Snell's law (Welford 1986, section 4.2). `eta` is the index in front of the
/// boundary, as the ray goes, over that behind it.
fn boundary(ray: LensRay, step: &Step, eta: f64) -> Option<LensRay> {
    let LensRay { origin, direction } = ray;
    // As if the ray went towards +z
    let along = (step.position - origin.z) / direction.z;
    let (x, y) = (origin.x + along * direction.x, origin.y + along * direction.y);
    let c = step.curvature;
    let f = c * (x * x + y * y);
    let g = direction.z - c * (x * direction.x + y * direction.y);
    let cosine_squared = g * g - c * f;
    if cosine_squared < 0.0 {
        return None;
    }
    // The root near the vertex: where g has the sign of the direction
    let cosine = cosine_squared.sqrt().copysign(direction.z);
    let rest = f / (g + cosine);
    let point =
        DVec3::new(x + rest * direction.x, y + rest * direction.y, step.position + rest * direction.z);
    if !(along + rest >= 0.0 && point.x * point.x + point.y * point.y <= step.aperture * step.aperture) {
        return None;
    }
    let bent_squared = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if bent_squared <= 0.0 {
        return None;
    }
    let k = bent_squared.sqrt().copysign(direction.z) - eta * cosine;
    let normal = DVec3::new(-c * point.x, -c * point.y, 1.0 - c * (point.z - step.position));
    Some(LensRay { origin: point, direction: (eta * direction + k * normal).normalize() })
}
