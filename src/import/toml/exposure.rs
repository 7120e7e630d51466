//! The exposure of a photograph: `shutter` and `iso` of `[camera]`.

use super::reader::Reader;
use super::text::Limits;
use super::view::View;
use crate::Result;
use crate::scene::{Aperture, Camera, Measure, Meter, Projection, Shot};

/// Speed of a film whose speed nobody says.
const ISO: f32 = 100.0;
/// Longest shutter time in seconds, and fastest film: products stay far within 64 bits.
const MOST: f32 = 1e9;

impl Reader<'_> {
    /// Exposes the film as the camera does, unless it exposes itself.
    pub(super) fn shot(&mut self, view: &View<'_>, camera: &Camera) -> Result<()> {
        let (shutter, iso) = (view.get("shutter"), view.get("iso"));
        let Some(shutter) = shutter else {
            return match iso {
                Some(iso) => {
                    Err(iso.error("`iso` needs a time that the shutter is open").help("add `shutter`"))
                }
                None => Ok(()),
            };
        };
        let limits = Limits::AboveUpTo(0.0, MOST);
        let f_number = match &camera.projection {
            Projection::Perspective(view) => match view.lens.map(|lens| lens.aperture) {
                Some(Aperture::FNumber { number, .. }) => Some(number),
                _ => {
                    return Err(shutter
                        .error("`shutter` needs the f-number of the lens")
                        .help("add `f_number`, or brighten the picture with `exposure` in [film]"));
                }
            },
            Projection::Lens(lens) if lens.measure == Measure::Irradiance => None,
            Projection::Lens(lens) => Some(lens.paraxial()?.f_number() as f32),
            _ => None,
        };
        let iso = iso.map_or(Ok(ISO), |item| item.f32(limits))?;
        let shot = Shot { shutter: shutter.f32(limits)?, iso, f_number };
        let exposure = &mut self.scene.film.exposure;
        if exposure.meter != Meter::Auto {
            exposure.meter = Meter::Shot(shot);
        }
        Ok(())
    }
}
