//! `Film` and `PixelFilter`.

use super::outset::Setting;
use super::parameter::Type;
use super::parameters::Parameters;
use super::reader::Reader;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::Limits;
use crate::scene::{Film, Filter, FilterKind, MAX_SIDE, Rect};

impl Reader<'_> {
    pub(super) fn film(&mut self, setting: Option<&Setting>) -> Result<()> {
        let mut film = Film { width: 1280, height: 720, ..Film::default() };
        if let Some(Setting { kind, from }) = setting {
            match kind.as_str() {
                "rgb" => {}
                "gbuffer" => from.ignore(&["coordinatesystem"]),
                "spectral" => {
                    self.unsupported(Unsupported::SpectralFilm, &from.spot);
                    from.ignore(&["nbuckets", "lambdamin", "lambdamax"]);
                }
                _ => return Err(self.unknown("Film", kind, from, &["rgb", "gbuffer", "spectral"])),
            }
            film.width = from.integer_or("xresolution", film.width, 1, MAX_SIDE)?;
            film.height = from.integer_or("yresolution", film.height, 1, MAX_SIDE)?;
            film.crop = crop(from, &film)?;
            self.sensor(from, &mut film)?;
        }
        self.scene.film = film;
        Ok(())
    }

    /// The sensor: a speed of 100 and a shutter that is open for 1 s show radiance 1 as 1.
    fn sensor(&mut self, from: &Parameters, film: &mut Film) -> Result<()> {
        let iso = from.float_or("iso", 100.0, Limits::AboveUpTo(0.0, 1e9))?;
        film.exposure.stops = (iso / 100.0).log2();
        if let Some((parameter, name)) = from.string("sensor")?
            && name != "cie1931"
        {
            let spot = parameter.spot.clone();
            self.unsupported(Unsupported::Sensor, &spot);
        }
        if from.float_or("whitebalance", 0.0, Limits::AtLeast(0.0))? != 0.0 {
            self.unsupported(Unsupported::WhiteBalance, &from.spot);
        }
        if from.float("maxcomponentvalue", Limits::Above(0.0))?.is_some() {
            self.unsupported(Unsupported::MaxComponent, &from.spot);
        }
        from.ignore(&["filename", "savefp16"]);
        Ok(())
    }

    pub(super) fn filter(&mut self, setting: Option<&Setting>) -> Result<()> {
        /// Of pbrt when the scene does not say.
        const USUAL: Filter = Filter { kind: FilterKind::Gaussian, radius: 1.5 };
        self.scene.film.filter = USUAL;
        let Some(Setting { kind, from }) = setting else { return Ok(()) };
        let (kind, usual) = match kind.as_str() {
            "box" => (FilterKind::Box, 0.5),
            "triangle" => (FilterKind::Tent, 2.0),
            "gaussian" => (FilterKind::Gaussian, 1.5),
            "mitchell" => {
                let share = |name| from.float_or(name, 1.0 / 3.0, Limits::From(0.0, 1.0));
                (FilterKind::Mitchell { b: share("B")?, c: share("C")? }, 2.0)
            }
            "sinc" => (FilterKind::Sinc { tau: from.float_or("tau", 3.0, Limits::Above(0.0))? }, 4.0),
            _ => {
                let known = ["box", "triangle", "gaussian", "mitchell", "sinc"];
                return Err(self.unknown("PixelFilter", kind, from, &known));
            }
        };
        let limits = Limits::AboveUpTo(0.0, Filter::MOST_RADIUS);
        let [x, y] = [from.float_or("xradius", usual, limits)?, from.float_or("yradius", usual, limits)?];
        if x != y {
            self.unsupported(Unsupported::FilterSize, &from.spot);
        }
        if kind == FilterKind::Gaussian {
            let sigma = from.float_or("sigma", 0.5, Limits::Above(0.0))?;
            if (sigma - x / 3.0).abs() > 1e-4 * x {
                self.unsupported(Unsupported::FilterSigma, &from.spot);
            }
        }
        self.scene.film.filter = Filter { kind, radius: x };
        from.finish()
    }
}

/// The part of the picture that is rendered: `pixelbounds` in pixels, or `cropwindow` in parts of the picture.
fn crop(from: &Parameters, film: &Film) -> Result<Option<Rect>> {
    let size = [film.width, film.width, film.height, film.height];
    let bounds: Option<[u32; 4]> = if let Some((parameter, list)) = from.integers("pixelbounds") {
        let list: [i32; 4] = list.try_into().map_err(|_| from.count(parameter, 4))?;
        let mut bounds = [0; 4];
        for ((bound, value), most) in bounds.iter_mut().zip(list).zip(size) {
            *bound = u32::try_from(value).unwrap_or(0).min(most);
        }
        Some(bounds)
    } else {
        let window: Option<[f32; 4]> = from.array("cropwindow", Type::Float)?;
        window.map(|window| {
            let mut bounds = [0; 4];
            for ((bound, part), most) in bounds.iter_mut().zip(window).zip(size) {
                *bound = (part.clamp(0.0, 1.0) * most as f32).ceil() as u32;
            }
            bounds
        })
    };
    let Some([x0, x1, y0, y1]) = bounds else { return Ok(None) };
    if x0 >= x1 || y0 >= y1 {
        return Err(from
            .error("no pixel is left of the film")
            .help("write x0 x1 y0 y1, x0 below x1 and y0 below y1"));
    }
    Ok(Some(Rect { x0, y0, x1, y1 }))
}
