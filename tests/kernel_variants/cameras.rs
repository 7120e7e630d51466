//! Scenes that together have every kind of camera.

use dapple::scene::*;
use glam::Vec3;

/// The cameras, each with what it can have.
pub fn cameras() -> Vec<(&'static str, Scene)> {
    let axis = FovAxis::Vertical;
    let fisheye = |mapping| Projection::Fisheye { mapping, fov: 180.0, axis };
    let mut scene = Scene::default();
    let white = Image { width: 1, height: 1, texels: Texels::Rgba8(vec![[255; 4]]) };
    let image = Some(scene.images.add("opening", white));
    let mut tilted = Lens::new(Aperture::Radius(0.1), 1.0);
    tilted.focus = Focus::Plane { point: Vec3::ZERO, normal: Vec3::Z };
    (tilted.cat_eye, tilted.opening.image) = (1.0, image);
    let row = |radius, index, abbe| LensInterface { radius, thickness: 2.0, index, abbe, aperture: 9.0 };
    let interfaces = vec![row(50.0, 1.5, Some(50.0)), row(-50.0, 1.0, None)];
    let lens = |opening, dispersion| {
        let system = LensSystem { notes: Vec::new(), interfaces: interfaces.clone() };
        let (measure, sensor_diagonal, unit) = (Measure::Radiance, 0.035, 1000.0);
        let (stop_diameter, focus_distance) = (8.0, 1.0);
        Projection::Lens(Box::new(LensCamera {
            system,
            stop_diameter,
            focus_distance,
            opening,
            sensor_diagonal,
            unit,
            dispersion,
            measure,
        }))
    };
    let round = Opening::default();
    let kinds = [
        ("parallel rays", Projection::Orthographic { size: 2.0, axis }),
        ("all directions", Projection::Equirectangular),
        ("a fisheye", fisheye(FisheyeMapping::Equidistant)),
        ("another fisheye", fisheye(FisheyeMapping::Equisolid)),
        ("a tilted thin lens with a picture of its opening", Projection::thin_lens(40.0, tilted)),
        ("a lens of two elements with blades and dispersion", lens(Opening { blades: 5, ..round }, true)),
        ("a lens with a picture of its opening", lens(Opening { image, ..round }, true)),
        ("a round lens", lens(round, false)),
    ];
    let with = |(name, projection)| {
        let mut scene = scene.clone();
        scene.camera.projection = projection;
        (name, scene)
    };
    kinds.into_iter().map(with).collect()
}
