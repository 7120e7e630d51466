//! The lenses of `[camera]`: thin, and of several elements.

use super::camera::Stand;
use super::reader::Reader;
use super::text::{Limits, number};
use super::view::{Item, View};
use crate::Result;
use crate::import::Spacing;
use crate::scene::{Aperture, Focus, Lens, LensCamera, Measure, Opening, Paraxial};

const MAX_BLADES: u32 = 64;
/// Height of a full-frame sensor in metres.
const SENSOR_HEIGHT: f32 = 0.024;
/// Diagonal of the film in millimetres, as in pbrt.
const SENSOR_DIAGONAL: f32 = 35.0;
/// Sine of the angle below which a plane of focus counts as going through the camera.
const MIN_SINE: f64 = 1e-6;
/// What rounding may add to a stop, in parts of it.
const ROUNDING: f64 = 1e-5;
const SPACINGS: [(&str, Spacing); 3] =
    [("detect", Spacing::Detect), ("next", Spacing::Next), ("previous", Spacing::Previous)];
const MEASURES: [(&str, Measure); 2] = [("radiance", Measure::Radiance), ("irradiance", Measure::Irradiance)];

impl Reader<'_> {
    pub(super) fn thin_lens(&mut self, view: &View<'_>, stand: &Stand) -> Result<Option<Lens>> {
        let Some(opening) = view.either("lens_radius", "f_number")? else {
            let orphans = [
                "sensor_height",
                "focus_distance",
                "focus_point",
                "focus_normal",
                "blades",
                "blade_rotation",
                "anamorphic",
                "aperture_image",
                "cat_eye",
            ];
            return match orphans.iter().find_map(|key| view.get(key)) {
                Some(item) => Err(item
                    .error(format!("{} needs a lens, and the camera is a pinhole", item.name()))
                    .help("add `lens_radius` or `f_number`")),
                None => Ok(None),
            };
        };
        let aperture = match view.get("f_number") {
            Some(item) => Aperture::FNumber {
                number: item.f32(Limits::Above(0.0))?,
                sensor_height: view.f32_or("sensor_height", SENSOR_HEIGHT, Limits::Above(0.0))?,
            },
            None => {
                if let Some(item) = view.get("sensor_height") {
                    return Err(item
                        .error("`sensor_height` has no meaning with `lens_radius`")
                        .help("remove it"));
                }
                Aperture::Radius(opening.f32(Limits::AtLeast(0.0))?)
            }
        };
        let focus = match view.get("focus_normal") {
            Some(normal) => focus_plane(view, opening, normal, stand)?,
            None => Focus::Distance(focus_distance(view, opening, stand)?),
        };
        let cat_eye = view.f32_or("cat_eye", 0.0, Limits::AtLeast(0.0))?;
        let lens = Lens { aperture, focus, opening: self.opening(view)?, cat_eye };
        // A lens without width is a pinhole.
        Ok((aperture != Aperture::Radius(0.0)).then_some(lens))
    }

    pub(super) fn lens_camera(&mut self, view: &View<'_>, stand: &Stand) -> Result<LensCamera> {
        let file = view.need("file")?;
        let focus_distance = focus_distance(view, file, stand)?;
        let unit = view.f32_or("unit", 1000.0, Limits::Above(0.0))?;
        let sensor_diagonal = view.f32_or("sensor_diagonal", SENSOR_DIAGONAL / unit, Limits::Above(0.0))?;
        let measure = view.choice_or("measure", Measure::Radiance, &MEASURES)?;
        let spacing = view.choice_or("spacing", Spacing::Detect, &SPACINGS)?;
        let dispersion = view.bool_or("dispersion", true)?;
        let opening = self.opening(view)?;

        let (spot, path) = (file.node.spot, file.path()?);
        self.need_file(spot, &path)?;
        let system = self.assets.lens(&path, spacing).map_err(|error| self.sources.locate(spot, error))?;
        let paraxial = Paraxial::of(&system).map_err(|error| error.in_file(&path))?;
        let stop_diameter = stop_diameter(view, &paraxial, unit)?;
        let dispersion = dispersion && system.disperses();
        let camera = LensCamera {
            system,
            stop_diameter,
            focus_distance,
            opening,
            sensor_diagonal,
            unit,
            dispersion,
            measure,
        };
        let focus = view.either("focus_distance", "focus_point")?.unwrap_or(file);
        camera.film_distance().map_err(|error| self.sources.locate(focus.node.spot, error))?;
        Ok(camera)
    }

    /// The shape of an opening.
    fn opening(&mut self, view: &View<'_>) -> Result<Opening> {
        let blades = view.u32_or("blades", 0, 0, MAX_BLADES)?;
        if let Some(item) = view.get("blades").filter(|_| blades == 1 || blades == 2) {
            return Err(item.refuse(blades, format!("0 for a circle, or from 3 to {MAX_BLADES}")));
        }
        let image = match view.either("blades", "aperture_image")? {
            Some(_) => view.get("aperture_image").map(|item| self.image(item)).transpose()?,
            None => None,
        };
        Ok(Opening {
            blades,
            blade_rotation: view.f32_or("blade_rotation", 0.0, Limits::Finite)?,
            anamorphic: view.f32_or("anamorphic", 1.0, Limits::From(0.1, 10.0))?,
            image,
        })
    }
}

/// Distance along the view of what is sharp; `asker` is the key that wants to know.
fn focus_distance(view: &View<'_>, asker: Item<'_>, stand: &Stand) -> Result<f32> {
    let Some(focus) = view.either("focus_distance", "focus_point")? else {
        return Err(asker
            .error(format!("{} needs a plane of focus", asker.name()))
            .help("add `focus_distance` or `focus_point`"));
    };
    if view.get("focus_point").is_none() {
        return focus.f32(Limits::Above(0.0));
    }
    let along = (focus.vec3(Limits::Finite)?.as_dvec3() - stand.position).dot(stand.forward) as f32;
    if !(along > 0.0 && along.is_finite()) {
        let distance = number(f64::from(along));
        return Err(focus.error(format!(
            "{} is {distance} in front of the camera along the view, must be above 0",
            focus.name()
        )));
    }
    Ok(along)
}

/// A plane of focus with a normal of its own.
fn focus_plane(view: &View<'_>, asker: Item<'_>, normal: Item<'_>, stand: &Stand) -> Result<Focus> {
    let direction = normal.direction()?;
    let point = match view.get("focus_point") {
        Some(point) if view.get("focus_distance").is_none() => point.vec3(Limits::Finite)?,
        _ => (stand.position + stand.forward * f64::from(focus_distance(view, asker, stand)?)).as_vec3(),
    };
    let there = point.as_dvec3() - stand.position;
    if there.dot(direction.as_dvec3()).abs() <= MIN_SINE * there.length() {
        return Err(normal.error("the plane of focus goes through the camera"));
    }
    Ok(Focus::Plane { point, normal: direction })
}

/// Diameter of the stop in millimetres: that of the file, or less.
fn stop_diameter(view: &View<'_>, lens: &Paraxial, unit: f32) -> Result<f64> {
    let Some(item) = view.either("f_number", "aperture")? else { return Ok(lens.stop_diameter) };
    let value = item.f64(Limits::Above(0.0))?;
    let (diameter, rule) = if view.get("f_number").is_some() {
        let open = lens.f_number();
        (lens.stop_for(value), format!("at least {open:.4}, what the lens has wide open"))
    } else {
        let most = number(lens.stop_diameter / f64::from(unit));
        (value * f64::from(unit), format!("at most {most}, the stop of the lens"))
    };
    if diameter > lens.stop_diameter * (1.0 + ROUNDING) {
        return Err(item.refuse(value, rule));
    }
    Ok(diameter.min(lens.stop_diameter))
}
