//! Scenes with each camera, filter and sampler, and nothing else.

use super::super::variant::SAMPLERS;
use crate::scene::{
    Aperture, FilterKind, FisheyeMapping, Focus, FovAxis, Image, Lens, LensCamera, LensInterface, LensSystem,
    Measure, Opening, Projection, Scene, Texels,
};
use glam::Vec3;

/// A scene for each sampler.
pub fn samplers() -> impl Iterator<Item = Scene> {
    SAMPLERS.into_iter().map(|(_, sampler)| {
        let mut scene = Scene::default();
        scene.render.sampler = sampler;
        scene
    })
}

/// A scene for each pixel filter.
pub fn filters() -> impl Iterator<Item = Scene> {
    let kinds = [
        FilterKind::Box,
        FilterKind::Tent,
        FilterKind::Gaussian,
        FilterKind::BlackmanHarris,
        FilterKind::Mitchell { b: 0.3, c: 0.3 },
        FilterKind::Sinc { tau: 3.0 },
    ];
    kinds.into_iter().map(|kind| {
        let mut scene = Scene::default();
        scene.film.filter.kind = kind;
        scene
    })
}

/// A scene for each kind of camera, and for what lenses may have.
pub fn cameras() -> Vec<Scene> {
    let mut scene = Scene::default();
    let white = Image { width: 1, height: 1, texels: Texels::Rgba8(vec![[255; 4]]) };
    let image = scene.images.add("opening", white);
    let axis = FovAxis::Vertical;
    let round = Opening::default();
    let openings = [
        round,
        Opening { blades: 5, ..round },
        Opening { image: Some(image), ..round },
        Opening { anamorphic: 1.5, ..round },
    ];
    let fisheye = |mapping| Projection::Fisheye { mapping, fov: 180.0, axis };
    let mut projections = vec![
        scene.camera.projection.clone(),
        Projection::Orthographic { size: 2.0, axis },
        Projection::Equirectangular,
        fisheye(FisheyeMapping::Equidistant),
        fisheye(FisheyeMapping::Equisolid),
    ];
    let plane = Focus::Plane { point: Vec3::ZERO, normal: Vec3::Z };
    let plain = Lens::new(Aperture::Radius(0.1), 1.0);
    for opening in openings {
        let lens = Lens { opening, ..plain };
        let tilted = Lens { focus: plane, ..lens };
        let lenses = [lens, tilted, Lens { cat_eye: 1.0, ..lens }, Lens { cat_eye: 1.0, ..tilted }];
        projections.extend(lenses.map(|lens| Projection::thin_lens(40.0, lens)));
        projections.extend([false, true].map(|dispersion| system(opening, dispersion)));
    }
    let with = |projection| {
        let mut scene = scene.clone();
        scene.camera.projection = projection;
        scene
    };
    projections.into_iter().map(with).collect()
}

/// A lens of one element.
fn system(opening: Opening, dispersion: bool) -> Projection {
    let row = |radius, index, abbe| LensInterface { radius, thickness: 2.0, index, abbe, aperture: 9.0 };
    let interfaces = vec![row(50.0, 1.5, Some(50.0)), row(-50.0, 1.0, None)];
    Projection::Lens(Box::new(LensCamera {
        system: LensSystem { notes: Vec::new(), interfaces },
        stop_diameter: 8.0,
        focus_distance: 1.0,
        opening,
        sensor_diagonal: 0.035,
        unit: 1000.0,
        dispersion,
        measure: Measure::Radiance,
    }))
}
