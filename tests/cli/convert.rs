//! `dapple convert`.

use crate::models::model;
use crate::{Planes, Room};
use serde_json::Value;

/// Instances of an object, glass with dispersion, a bumpy checker and a lamp with a picture of light.
const PBRT: &str = r#"
LookAt 0 2 -6  0 0.5 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
Integrator "volpath" "integer maxdepth" 5
WorldBegin
AttributeBegin
  Texture "squares" "spectrum" "checkerboard" "float uscale" 4 "float vscale" 4 "rgb tex1" [0.8 0.2 0.1]
  Material "diffuse" "texture reflectance" "squares"
  ObjectBegin "tile"
    Shape "trianglemesh" "point3 P" [-1 0 -1  1 0 -1  1 0 1  -1 0 1] "integer indices" [0 2 1 0 3 2] "point2 uv" [0 0 1 0 1 1 0 1]
  ObjectEnd
AttributeEnd
ObjectInstance "tile"
AttributeBegin
  Translate 2 0 1
  Rotate 30 0 1 0
  ObjectInstance "tile"
AttributeEnd
AttributeBegin
  Translate 0 1 0
  Material "dielectric" "spectrum eta" "glass-F11" "float roughness" 0.1
  Shape "sphere" "float radius" 0.7
AttributeEnd
LightSource "spot" "point3 from" [2 4 -2] "point3 to" [0 0 0] "rgb I" [40 40 30]
LightSource "infinite" "rgb L" [0.2 0.3 0.4]
"#;

#[test]
fn what_is_converted_renders_to_the_same_numbers() {
    let room = Room::new();
    room.write("model.gltf", &model());
    room.write("scene.pbrt", PBRT);
    for name in ["model.gltf", "scene.pbrt", "scene.toml"] {
        let told = room.run(&format!("convert {name} out.toml --force --json")).code(0);
        let told: Value = serde_json::from_str(&told.out).unwrap();
        assert_eq!(told["scene"], "out.toml");
        assert_eq!(told["files"].as_array().unwrap().last().unwrap(), "out.toml", "the scene comes last");
        for (scene, picture) in [(name, "a.exr"), ("out.toml", "b.exr")] {
            room.run(&format!("render {scene} -o {picture} --size 24x16 --spp 4 --quiet")).code(0);
        }
        let [a, b] = ["a.exr", "b.exr"].map(|name| Planes::read(&room.path(name)));
        assert!(a.plane("R").iter().any(|red| *red > 0.0), "{name} is black");
        assert_eq!(a.planes, b.planes, "{name}");
    }
}

#[test]
fn what_is_there_is_kept_and_other_languages_are_refused() {
    let room = Room::new();
    room.run("convert scene.toml scene.toml").code(1).err_has("this is there already and is not replaced");
    room.run("convert scene.toml out.pbrt").code(2).err_has("end the name in .toml");
    room.run("convert missing.pbrt out.toml").code(2).err_has("missing.pbrt");
    assert_eq!(room.names(), ["scene.toml"]);
}
