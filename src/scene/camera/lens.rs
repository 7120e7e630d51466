//! A lens of several elements, as a lens file has it, and a camera that looks through it.

use super::Opening;
use super::paraxial::Paraxial;
use crate::{Error, Result};

/// A boundary between two media, or the stop. Lengths are in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensInterface {
    /// Radius of curvature, positive when the centre is on the side of the film; 0 = flat.
    pub radius: f64,
    /// Distance along the axis to the next interface towards the film; of the last one without meaning.
    pub thickness: f64,
    /// Index of refraction at the d line (587.6 nm) of the medium towards the film.
    pub index: f64,
    /// Abbe number (n_d − 1) / (n_F − n_C) of that medium, where it is known.
    pub abbe: Option<f64>,
    /// Diameter of what is let through.
    pub aperture: f64,
}

/// Wavelengths of the F, d and C lines in micrometres.
pub(crate) const LINES: [f64; 3] = [0.486_132_7, 0.587_561_8, 0.656_272_5];

impl LensInterface {
    /// A and B of Cauchy's formula n(λ) = A + B/λ², with λ in micrometres, for the medium towards the film: through n_d, with
    /// the Abbe number between the F and C lines. B is 0 where no Abbe number is known.
    pub fn cauchy(&self) -> [f64; 2] {
        let [f, d, c] = LINES;
        let b = self.abbe.map_or(0.0, |abbe| (self.index - 1.0) / (abbe * (f.powi(-2) - c.powi(-2))));
        [self.index - b / (d * d), b]
    }
}

/// The stop of a lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Number of its interface.
    pub interface: usize,
    /// Whether the file names it: a flat row between equal media. Else it is the rim that a beam along the axis meets first.
    pub named: bool,
}

/// A lens: its interfaces from the front, where the scene is, to the rear, where the film is. Air is around it.
#[derive(Debug, Clone, PartialEq)]
pub struct LensSystem {
    /// The comments at the head of its file, line by line.
    pub notes: Vec<String>,
    /// At least one, of which one at least bends light.
    pub interfaces: Vec<LensInterface>,
}

impl LensSystem {
    /// Index at the d line of the medium in front of an interface.
    pub fn index_before(&self, interface: usize) -> f64 {
        if interface == 0 { 1.0 } else { self.interfaces[interface - 1].index }
    }

    /// The rows that let light through unbent: stops.
    pub fn stops(&self) -> impl Iterator<Item = usize> {
        let flat = |i: &usize| self.interfaces[*i].radius == 0.0;
        (0..self.interfaces.len()).filter(flat).filter(|&i| self.interfaces[i].index == self.index_before(i))
    }

    /// Length along the axis from the first to the last interface, in millimetres.
    pub fn length(&self) -> f64 {
        self.interfaces.iter().rev().skip(1).map(|interface| interface.thickness).sum()
    }

    /// Whether any medium has an Abbe number.
    pub fn disperses(&self) -> bool {
        self.interfaces.iter().any(|interface| interface.abbe.is_some())
    }
}

/// What a pixel of a camera with a lens of several elements says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Radiance: where the lens shows the same radiance L everywhere, the middle of the picture is L at every f-number, as far
    /// as the lens keeps to its paraxial exit pupil.
    Radiance,
    /// Irradiance of the film, ∫ L cos⁴θ / Z² dA over the exit pupil.
    Irradiance,
}

/// A camera with a lens of several elements (Kolb, Mitchell and Hanrahan 1995).
#[derive(Debug, Clone, PartialEq)]
pub struct LensCamera {
    /// The lens.
    pub system: LensSystem,
    /// Diameter of the stop in millimetres, at most that of the file.
    pub stop_diameter: f64,
    /// Distance from the film to the plane of focus, in scene units.
    pub focus_distance: f32,
    /// Shape of the stop.
    pub opening: Opening,
    /// Diagonal of the film in scene units.
    pub sensor_diagonal: f32,
    /// Millimetres in a scene unit.
    pub unit: f32,
    /// Whether each colour has an index of its own.
    pub dispersion: bool,
    /// What a pixel says.
    pub measure: Measure,
}

impl LensCamera {
    /// The lens as it is stopped down.
    ///
    /// # Errors
    /// A lens that does not gather light.
    pub fn paraxial(&self) -> Result<Paraxial> {
        let mut lens = Paraxial::of(&self.system)?;
        lens.stop_down(self.stop_diameter);
        Ok(lens)
    }

    /// Distance in millimetres from the last vertex to the film that focuses on `focus_distance`.
    ///
    /// # Errors
    /// A distance that the lens cannot focus on.
    pub fn film_distance(&self) -> Result<f64> {
        let lens = Paraxial::of(&self.system)?;
        let unit = f64::from(self.unit);
        let wanted = f64::from(self.focus_distance) * unit;
        lens.focus(wanted).ok_or_else(|| {
            let nearest = lens.nearest_focus() / unit;
            Error::scene(format!(
                "the lens cannot focus on {} in front of the film, only from {nearest:.4} on",
                self.focus_distance
            ))
            .help("move the camera away, or check `unit`")
        })
    }
}
