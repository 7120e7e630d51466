//! `[camera]`.

use super::Writer;
use super::keys::{Keys, number, vector};
use super::lens::lens;
use crate::Result;
use crate::scene::{
    Aperture, Camera, FisheyeMapping, Focus, FovAxis, Lens, LensCamera, Measure, Meter, Opening, Paraxial,
    Projection,
};

impl Writer<'_> {
    pub(super) fn camera(&mut self) -> Result<Keys> {
        let scene = self.scene;
        let camera = &scene.camera;
        let mut keys = Keys::new();
        match &camera.projection {
            Projection::Perspective(view) => {
                stand(&mut keys, camera);
                keys.number("fov", view.fov, 40.0);
                axis(&mut keys, view.fov_axis);
                if let Some(lens) = &view.lens {
                    self.thin_lens(&mut keys, lens)?;
                }
            }
            Projection::Orthographic { size, axis: side } => {
                keys.set("kind", "orthographic");
                stand(&mut keys, camera);
                keys.number("view_size", *size, 2.0);
                axis(&mut keys, *side);
            }
            Projection::Equirectangular => {
                keys.set("kind", "equirectangular");
                stand(&mut keys, camera);
            }
            Projection::Fisheye { mapping, fov, axis: side } => {
                keys.set("kind", "fisheye");
                stand(&mut keys, camera);
                if *mapping == FisheyeMapping::Equisolid {
                    keys.set("mapping", "equisolid");
                }
                keys.number("fov", *fov, 180.0);
                axis(&mut keys, *side);
            }
            Projection::Lens(lens) => {
                keys.set("kind", "lens");
                stand(&mut keys, camera);
                self.lens_camera(&mut keys, lens)?;
            }
        }
        if let Meter::Shot(shot) = scene.film.exposure.meter {
            keys.set("shutter", number(shot.shutter));
            keys.number("iso", shot.iso, 100.0);
        }
        Ok(keys)
    }

    fn thin_lens(&mut self, keys: &mut Keys, lens: &Lens) -> Result<()> {
        match lens.aperture {
            Aperture::Radius(radius) => keys.set("lens_radius", number(radius)),
            Aperture::FNumber { number: n, sensor_height } => {
                keys.set("f_number", number(n));
                keys.number("sensor_height", sensor_height, 0.024);
            }
        }
        match lens.focus {
            Focus::Distance(distance) => keys.set("focus_distance", number(distance)),
            Focus::Plane { point, normal } => {
                keys.set("focus_point", vector(point));
                keys.set("focus_normal", vector(normal));
            }
        }
        self.opening(keys, &lens.opening)?;
        keys.number("cat_eye", lens.cat_eye, 0.0);
        Ok(())
    }

    fn lens_camera(&mut self, keys: &mut Keys, camera: &LensCamera) -> Result<()> {
        let file = self.files.add("lens", "lens", "txt", lens(&camera.system).as_bytes())?;
        keys.set("file", file);
        keys.set("spacing", "next");
        keys.number("unit", camera.unit, 1000.0);
        keys.set("sensor_diagonal", number(camera.sensor_diagonal));
        keys.set("focus_distance", number(camera.focus_distance));
        stop(keys, camera)?;
        self.opening(keys, &camera.opening)?;
        keys.flag("dispersion", camera.dispersion || !camera.system.disperses(), true);
        if camera.measure == Measure::Irradiance {
            keys.set("measure", "irradiance");
        }
        Ok(())
    }

    fn opening(&mut self, keys: &mut Keys, opening: &Opening) -> Result<()> {
        match opening.image {
            Some(image) => keys.set("aperture_image", self.image(image)?),
            None => keys.count("blades", opening.blades, 0),
        }
        keys.number("blade_rotation", opening.blade_rotation, 0.0);
        keys.number("anamorphic", opening.anamorphic, 1.0);
        Ok(())
    }
}

/// The stop of a lens, as the diameter that gives it to the last digit where one does.
fn stop(keys: &mut Keys, camera: &LensCamera) -> Result<()> {
    if camera.stop_diameter == Paraxial::of(&camera.system)?.stop_diameter {
        return Ok(());
    }
    let unit = f64::from(camera.unit);
    let near = camera.stop_diameter / unit;
    let exact = [near, near.next_down(), near.next_up()];
    let exact = exact.into_iter().find(|aperture| aperture * unit == camera.stop_diameter);
    keys.set("aperture", exact.unwrap_or(near));
    Ok(())
}

/// Where the camera is, and where it is when the shutter closes.
fn stand(keys: &mut Keys, camera: &Camera) {
    let default = Camera::default();
    keys.vector("position", camera.position, default.position);
    keys.vector("target", camera.target, default.target);
    keys.vector("up", camera.up, default.up);
    if let Some(close) = camera.at_close {
        // One of them says that it moves
        keys.set("position_close", vector(close.position));
        keys.vector("target_close", close.target, camera.target);
        keys.vector("up_close", close.up, camera.up);
    }
    keys.flag("mirrored", camera.mirrored, false);
}

pub(super) fn axis(keys: &mut Keys, axis: FovAxis) {
    let word = match axis {
        FovAxis::Vertical => "vertical",
        FovAxis::Horizontal => "horizontal",
        FovAxis::Smaller => "smaller",
    };
    keys.word("fov_axis", word, "vertical");
}
