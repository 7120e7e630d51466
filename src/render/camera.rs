//! The uniform block: what it says of the camera.

use crate::layout::Frame;
use crate::prepare::Prepared;
use crate::scene::{FisheyeMapping, Focus, LensCamera, Projection, Scene, half_height};
use glam::{Affine3A, Vec3};

/// The fields of the camera; the others are 0.
pub(super) fn of_scene(scene: &Scene, prepared: &Prepared) -> Frame {
    let camera = &scene.camera;
    // A camera that moves makes its rays in its own space
    let moves = prepared.features.camera_moves;
    let world = if moves { Affine3A::IDENTITY } else { camera.world_from_camera() };
    let aspect = scene.film.width as f32 / scene.film.height as f32;
    let half_y = half_of_picture(&camera.projection, aspect);
    let opening = camera.opening().unwrap_or_default();
    let placed = Frame {
        camera_right: Vec3::from(world.matrix3.x_axis).to_array(),
        camera_up: Vec3::from(world.matrix3.y_axis).to_array(),
        camera_back: Vec3::from(world.matrix3.z_axis).to_array(),
        camera_position: Vec3::from(world.translation).to_array(),
        camera_motion: prepared.camera_motion,
        half_x: half_y * aspect,
        half_y,
        blades: opening.blades,
        blade_rotation: opening.blade_rotation.to_radians(),
        opening_half: opening.half_size(),
        opening_size: prepared.lens.opening_size,
        opening_cells: prepared.lens.opening_cells,
        filter_cells: prepared.lens.filter_cells,
        filter_weight: prepared.lens.filter_weight,
        ..Frame::default()
    };
    match &camera.projection {
        Projection::Perspective(view) => Frame {
            lens_radius: view.lens_radius(aspect),
            focus_distance: match view.lens.map(|lens| lens.focus) {
                Some(Focus::Distance(distance)) => distance,
                _ => 1.0,
            },
            focus_plane: camera.focus_plane().unwrap_or(Vec3::Z).to_array(),
            cat_eye: view.lens.map_or(0.0, |lens| lens.cat_eye),
            ..placed
        },
        Projection::Fisheye { mapping, fov, .. } => {
            let half = 0.5 * fov.to_radians();
            let fisheye_scale = match mapping {
                FisheyeMapping::Equidistant => half,
                FisheyeMapping::Equisolid => (0.5 * half).sin(),
            };
            Frame { fisheye_scale, ..placed }
        }
        Projection::Lens(lens) => through_lens(lens, prepared, placed),
        Projection::Orthographic { .. } | Projection::Equirectangular => placed,
    }
}

/// Half of the height of the picture in the unit of its projection.
fn half_of_picture(projection: &Projection, aspect: f32) -> f32 {
    match projection {
        Projection::Perspective(view) => view.tan_half_vertical_fov(aspect),
        Projection::Orthographic { size, axis } => half_height(*axis, 0.5 * size, aspect),
        Projection::Fisheye { axis, .. } => half_height(*axis, 1.0, aspect),
        Projection::Lens(lens) => {
            let half_diagonal = 0.5 * lens.sensor_diagonal * lens.unit;
            half_diagonal / (1.0 + aspect * aspect).sqrt()
        }
        Projection::Equirectangular => 1.0,
    }
}

fn through_lens(lens: &LensCamera, prepared: &Prepared, placed: Frame) -> Frame {
    let tables = &prepared.lens;
    Frame {
        lens_count: tables.interfaces,
        lens_stop: tables.stop,
        stop_radius: tables.stop_radius,
        lens_rear: tables.rear,
        lens_weight: tables.weight,
        lens_unit: 1.0 / lens.unit,
        lens_spread: tables.spread,
        pupil_bounds: tables.pupil_bounds,
        pupil_scale: tables.pupil_scale,
        ..placed
    }
}
