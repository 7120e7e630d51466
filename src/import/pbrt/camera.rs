//! `Camera`.

use super::outset::Setting;
use super::parameter::Type;
use super::parameters::Parameters;
use super::reader::Reader;
use super::state::Maps;
use super::unsupported::Unsupported;
use crate::import::Spacing;
use crate::import::text::Limits;
use crate::scene::{
    Aperture, Camera, Exposure, FovAxis, Lens, LensCamera, Measure, Opening, Paraxial, Perspective,
    Projection, Stand,
};
use crate::{Error, Result};
use glam::{DAffine3, DVec3};

/// Millimetres in a scene unit: pbrt takes units for metres.
const UNIT: f32 = 1000.0;
/// How far axes may be from right angles and equal lengths.
const TOLERANCE: f64 = 1e-3;

/// The axes of a camera in the world.
struct Axes {
    position: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Length of a unit of the camera.
    scale: f64,
    /// Whether right is where a right-handed camera has left.
    mirrored: bool,
    /// Whether it is a turn, a place and a scale.
    rigid: bool,
}

impl Axes {
    fn of(camera_from_world: &DAffine3) -> Option<Self> {
        let map = camera_from_world.inverse();
        let [x, y, z] = [map.x_axis, map.y_axis, map.z_axis];
        let forward = z.try_normalize()?;
        let up = y.reject_from_normalized(forward).try_normalize()?;
        let right = x.reject_from_normalized(forward).reject_from_normalized(up).try_normalize()?;
        let scale = z.length();
        let even = [x, y].iter().all(|axis| (axis.length() - scale).abs() < TOLERANCE * scale);
        let square = [x.dot(y), y.dot(z), z.dot(x)].iter().all(|d| d.abs() < TOLERANCE * scale * scale);
        let rigid = even && square;
        let mirrored = right.dot(forward.cross(up)) < 0.0;
        let whole = Self { position: map.translation, right, up, forward, scale, mirrored, rigid };
        (map.is_finite() && scale > 0.0).then_some(whole)
    }

    /// Looking along one of the axes.
    fn stand(&self, along: DVec3) -> Stand {
        Stand {
            position: self.position.as_vec3(),
            // As far away as the position is exact, and a unit at least
            target: (self.position + along * self.position.abs().max_element().max(1.0)).as_vec3(),
            up: self.up.as_vec3(),
        }
    }
}

impl Reader<'_> {
    pub(super) fn camera(
        &mut self,
        setting: Option<&Setting>,
        maps: &Maps,
        film: Option<&Setting>,
    ) -> Result<()> {
        let lost = || {
            let error = Error::scene("the transform of the camera cannot be inverted");
            let error = error.help("give every axis a size");
            setting.map_or_else(|| error.clone(), |setting| setting.from.spot.locate(error.clone()))
        };
        let axes = Axes::of(&maps[0]).ok_or_else(lost)?;
        let diagonal = Self::setting_float(film, "diagonal", 35.0)?;
        if let Some(film) = film {
            film.from.finish()?;
        }
        let kind = setting.map_or("perspective", |setting| setting.kind.as_str());
        if let (Some(setting), false) = (setting, axes.rigid) {
            self.unsupported(Unsupported::Sheared, &setting.from.spot);
        }
        let projection = match setting {
            None => {
                Projection::Perspective(Perspective { fov: 90.0, fov_axis: FovAxis::Smaller, lens: None })
            }
            Some(Setting { kind, from }) => {
                let projection = match kind.as_str() {
                    "perspective" => self.perspective(from, &axes)?,
                    "orthographic" => self.orthographic(from, &axes)?,
                    "spherical" => self.spherical(from)?,
                    "realistic" => self.realistic(from, diagonal)?,
                    _ => {
                        let known = ["perspective", "orthographic", "spherical", "realistic"];
                        return Err(self.unknown("Camera", kind, from, &known));
                    }
                };
                self.shutter(from)?;
                projection
            }
        };
        if let Some(setting) = setting {
            setting.from.finish()?;
        }
        let spherical = kind == "spherical";
        // The middle of pbrt's picture of all directions looks to the left
        let stand = |axes: &Axes| axes.stand(if spherical { -axes.right } else { axes.forward });
        let open = stand(&axes);
        let at_close =
            if maps[0] == maps[1] { None } else { Some(stand(&Axes::of(&maps[1]).ok_or_else(lost)?)) };
        if at_close.is_some() {
            self.check_interval();
        }
        let mirrored = axes.mirrored != spherical;
        let Stand { position, target, up } = open;
        if !(position.is_finite() && target.is_finite()) {
            return Err(lost());
        }
        self.scene.camera = Camera { position, target, up, mirrored, projection, at_close };
        Ok(())
    }

    /// Light is gathered while the shutter is open, by which the sensor multiplies.
    fn shutter(&mut self, from: &Parameters) -> Result<()> {
        let [open, close] = [
            from.float_or("shutteropen", 0.0, Limits::Finite)?,
            from.float_or("shutterclose", 1.0, Limits::Finite)?,
        ];
        if open >= close {
            return Err(from.error("the shutter closes before it opens").help("write a larger shutterclose"));
        }
        self.shutter = [open.into(), close.into()];
        let stops = self.scene.film.exposure.stops + (close - open).log2();
        if stops.abs() > Exposure::MOST_STOPS {
            let message = format!("iso and shutter change the brightness by {stops} stops");
            let most = Exposure::MOST_STOPS;
            return Err(from.error(message).help(format!("{most} at most are possible: change one of them")));
        }
        self.scene.film.exposure.stops = stops;
        Ok(())
    }

    fn perspective(&mut self, from: &Parameters, axes: &Axes) -> Result<Projection> {
        let fov = from.float_or("fov", 90.0, Limits::Between(0.0, 180.0))?;
        let radius = from.float_or("lensradius", 0.0, Limits::AtLeast(0.0))?;
        let focus = from.float_or("focaldistance", 1e6, Limits::Above(0.0))?;
        let scale = axes.scale as f32;
        let lens = match radius > 0.0 {
            true => Some(Lens::new(
                Aperture::Radius(length(from, "lensradius", radius * scale)?),
                length(from, "focaldistance", focus * scale)?,
            )),
            false => None,
        };
        Ok(Projection::Perspective(match self.window(from)? {
            None => Perspective { fov, fov_axis: FovAxis::Smaller, lens },
            Some(half) => {
                let half_fov = (0.5 * fov.to_radians()).tan() * half;
                let fov = 2.0 * half_fov.atan().to_degrees();
                if !(0.0 < fov && fov < 180.0) {
                    let error =
                        from.error("screenwindow is so high or so low that nothing can be seen in it");
                    return Err(error.help("write numbers nearer to -1 and 1"));
                }
                Perspective { fov, fov_axis: FovAxis::Vertical, lens }
            }
        }))
    }

    fn orthographic(&mut self, from: &Parameters, axes: &Axes) -> Result<Projection> {
        if from.float_or("lensradius", 0.0, Limits::AtLeast(0.0))? > 0.0 {
            self.unsupported(Unsupported::OrthographicLens, &from.spot);
        }
        from.float_or("focaldistance", 1e6, Limits::Above(0.0))?;
        let scale = axes.scale as f32;
        let (half, axis) = match self.window(from)? {
            None => (1.0, FovAxis::Smaller),
            Some(half) => (half, FovAxis::Vertical),
        };
        Ok(Projection::Orthographic { size: length(from, "screenwindow", 2.0 * half * scale)?, axis })
    }

    /// Half of the height of `screenwindow`, in which the shorter side of the film is from −1 to 1 without it.
    fn window(&mut self, from: &Parameters) -> Result<Option<f32>> {
        let shape = self.scene.film.width as f32 / self.scene.film.height as f32;
        let near = |a: f32, b: f32| (a - b).abs() <= TOLERANCE as f32 * b.abs();
        if let Some(frame) = from.float("frameaspectratio", Limits::Above(0.0))?
            && !near(frame, shape)
        {
            self.unsupported(Unsupported::Frame, &from.spot);
        }
        let Some([x0, x1, y0, y1]) = from.array("screenwindow", Type::Float)? else { return Ok(None) };
        let (width, height) = (x1 - x0, y1 - y0);
        if !(width > 0.0 && height > 0.0 && width.is_finite() && height.is_finite()) {
            return Err(from
                .error("screenwindow is empty")
                .help("write x0 x1 y0 y1, x0 below x1 and y0 below y1"));
        }
        let middle = near(-x0, x1) && near(-y0, y1);
        if !middle || !near(width / height, shape) {
            self.unsupported(Unsupported::Window, &from.spot);
        }
        Ok(Some(0.5 * height))
    }

    fn spherical(&mut self, from: &Parameters) -> Result<Projection> {
        let equal_area =
            from.choice_or("mapping", true, &[("equalarea", true), ("equirectangular", false)])?;
        if equal_area {
            self.unsupported(Unsupported::EqualAreaCamera, &from.spot);
        }
        Ok(Projection::Equirectangular)
    }

    fn realistic(&mut self, from: &Parameters, diagonal: f32) -> Result<Projection> {
        let (spot, path) = from.file("lensfile")?.ok_or_else(|| from.missing("lensfile", Type::String))?;
        self.need_file(&spot, &path)?;
        let system = self.assets.lens(&path, Spacing::Next).map_err(|error| spot.locate(error))?;
        let lens = Paraxial::of(&system).map_err(|error| error.in_file(&path))?;
        // A stop that is wider than the lens is one that is wide open, as in pbrt
        let wanted = from.float_or("aperturediameter", 1.0, Limits::Above(0.0))?;
        let stop_diameter = f64::from(wanted).min(lens.stop_diameter);
        let focus_distance = from.float_or("focusdistance", 10.0, Limits::Above(0.0))?;
        let camera = LensCamera {
            system,
            stop_diameter,
            focus_distance,
            opening: self.opening(from)?,
            sensor_diagonal: diagonal / UNIT,
            unit: UNIT,
            dispersion: false,
            measure: Measure::Irradiance,
        };
        camera.film_distance().map_err(|error| from.spot.locate(error))?;
        // Paths begin with a small weight, which is no reason to end them
        self.scene.render.russian_roulette = false;
        Ok(Projection::Lens(Box::new(camera)))
    }

    fn opening(&mut self, from: &Parameters) -> Result<Opening> {
        let Some((parameter, name)) = from.string("aperture")? else { return Ok(Opening::default()) };
        let (spot, name) = (parameter.spot.clone(), name.to_owned());
        match name.as_str() {
            "circular" => Ok(Opening::default()),
            "pentagon" => Ok(Opening { blades: 5, ..Opening::default() }),
            "gaussian" | "square" | "star" => {
                self.unsupported(Unsupported::ApertureShape, &spot);
                Ok(Opening::default())
            }
            _ => {
                let path = spot.resolve(&name);
                let (image, _) = self.image(&spot, &path)?;
                Ok(Opening { image: Some(image), ..Opening::default() })
            }
        }
    }
}

/// A length that the transform of the camera has scaled.
fn length(from: &Parameters, name: &str, scaled: f32) -> Result<f32> {
    if scaled > 0.0 && scaled.is_finite() {
        return Ok(scaled);
    }
    let message = format!("{name} is {scaled} with the transform of the camera");
    Err(from.error(message).help("change its scale, or what is scaled"))
}
