//! Scenes with coats and paper.

use crate::scenes::{constant, material, place_triangle, surroundings, texture};
use dapple::scene::*;
use glam::Vec3;

fn coated(color: Value<Vec3>, fresnel: Fresnel, interface: Interface) -> [Surface; 2] {
    let conductor = Conductor { reflectance: color, fresnel, roughness: interface.roughness };
    [
        Surface::CoatedDiffuse(CoatedDiffuse { color, interface }),
        Surface::CoatedConductor(Box::new(CoatedConductor { conductor, interface })),
    ]
}

fn of(mut scene: Scene, surfaces: impl IntoIterator<Item = Surface>) -> Scene {
    for surface in surfaces {
        let handle = material(&mut scene, surface, None);
        place_triangle(&mut scene, handle, 1);
    }
    scene.environment = surroundings(constant(1.0));
    scene
}

/// Without tables, and without metal by its index.
pub fn smooth_coats() -> Scene {
    let interface = Interface { ior: 1.5, roughness: Roughness::alpha(0.0) };
    of(Scene::default(), coated(constant(0.5), Fresnel::Schlick, interface))
}

/// All inputs from textures.
pub fn rough_coats() -> Scene {
    let mut scene = Scene::default();
    let picture = texture(&mut scene, Texels::Rgba8(vec![[9, 99, 200, 255]; 2]), ColorSpace::Linear);
    let number = Value::Texture(picture);
    let roughness = Roughness { u: number, v: Value::Constant(0.5), squared: true };
    let color = Value::Texture(picture);
    let paper = Surface::diffuse_transmission(color, color);
    let surfaces = coated(color, Fresnel::Exact, Interface { ior: 1.5, roughness });
    of(scene, surfaces.into_iter().chain([paper]))
}
