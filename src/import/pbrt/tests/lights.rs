//! Lights with images, and how images are stored.

use super::{read, world};
use crate::scene::*;
use glam::Vec3;

/// What `two.png` has in its middle.
const GREY: f32 = 0.215_860_5;

fn factor(scene: &Scene, value: Value<Vec3>) -> f32 {
    match &scene.textures[value.texture().unwrap()] {
        Texture::Scale { factor: Value::Constant(factor), .. } => *factor,
        Texture::Scale { value: Value::Constant(color), .. } => color.x,
        Texture::Image(_) => 1.0,
        other => panic!("{other:?}"),
    }
}

fn near(found: f32, wanted: f32) {
    assert!((found - wanted).abs() <= 1e-4 * wanted, "{found} {wanted}");
}

#[test]
fn an_image_of_an_area_light_is_its_radiance() {
    let light = |more: &str| {
        let scene = world(&format!(
            "AreaLightSource \"diffuse\" \"string filename\" \"two.png\" {more} Shape \"disk\""
        ));
        let radiance = scene.materials[scene.shapes[0].material].emission.as_ref().unwrap().radiance;
        factor(&scene, radiance)
    };
    near(light(""), 1.0);
    near(light("\"float scale\" 3"), 3.0);
    let mean = (1.0 + GREY) / 3.0;
    near(light("\"float power\" 5"), 5.0 / (mean * std::f32::consts::PI.powi(2)));
    let both = "WorldBegin\n AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"string filename\" \"two.png\"";
    let error = read(both).unwrap_err().to_string();
    assert_eq!(
        error,
        "scene.pbrt:2:28: AreaLightSource \"diffuse\" has both `L` and `filename`; keep one of them"
    );
}

#[test]
fn the_power_of_a_light_with_an_image_counts_its_texels() {
    let light = |text: &str| {
        let scene = world(&format!("LightSource {text} \"string filename\" \"two.png\""));
        factor(&scene, scene.lights[0].intensity)
    };
    let mean = (1.0 + GREY) / 3.0;
    near(light("\"goniometric\" \"rgb I\" [2 2 2]"), 2.0);
    near(
        light("\"goniometric\" \"rgb I\" [2 2 2] \"float power\" 7"),
        2.0 * 7.0 / (4.0 * std::f32::consts::PI * mean),
    );
    // A third as wide as high: tan 45° to the side, and 3 upward
    let texels = [0.0, GREY, 1.0].iter().zip([-2.0_f32, 0.0, 2.0]);
    let seen: f32 = texels.map(|(light, y)| light * (1.0 + y * y).powf(-1.5)).sum();
    near(light("\"projection\" \"float power\" 7"), 7.0 / (4.0 * 3.0 * seen / 3.0));
}

#[test]
fn integers_are_powers_of_light_when_a_scene_says_so() {
    let image = |encoding: &str| {
        let scene = world(&format!(
            "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"two.png\" \"string encoding\" \"{encoding}\" \
             Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\""
        ));
        let (image, space) = scene
            .textures
            .iter()
            .find_map(|(_, _, texture)| match texture {
                Texture::Image(image) => Some((image.image, image.color_space)),
                _ => None,
            })
            .unwrap();
        scene.images[image].linear(1, space)[0]
    };
    near(image("sRGB"), GREY);
    near(image("linear"), 128.0 / 255.0);
    near(image("gamma 3"), (128.0_f32 / 255.0).powi(3));
    for wrong in ["gamma", "gamma x", "gamma 0", "gamma -1", "gamma 2 3", "rgb"] {
        let text = format!(
            "WorldBegin Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"two.png\" \"string encoding\" \"{wrong}\""
        );
        assert!(read(&text).unwrap_err().to_string().contains("must be \"sRGB\""), "{wrong}");
    }
}
