//! `[[instance]]` with a `file`: what a scene takes from its models, and what it says itself.

use super::*;

const MODEL: &str = "[[instance]]\nfile = 'chair.glb'\n";

fn showing(text: &str, choice: &ModelChoice) -> Result<Scene> {
    let mut memory = Memory::new(&[("scene.toml", text)]);
    read_scene_with(Path::new("scene.toml"), &[], choice, &mut memory).map(|(scene, _)| scene)
}

fn scene(text: &str) -> Scene {
    showing(text, &ModelChoice::default()).unwrap()
}

#[test]
fn a_model_by_itself_is_a_scene() {
    let mut memory = Memory::default();
    let read = read_scene_with(Path::new("a/chair.glb"), &[], &ModelChoice::default(), &mut memory);
    let (scene, warnings) = read.unwrap();
    assert_eq!(memory.loaded[0], "a/chair.glb None None");
    assert!(warnings.is_empty() && scene.instances.len() == 1 && scene.lights.len() == 1);
    // Changes from the command line reach it
    let set = [("render.spp".to_owned(), "7".to_owned())];
    let read = read_scene_with(Path::new("chair.GLTF"), &set, &ModelChoice::default(), &mut memory);
    assert_eq!(read.unwrap().0.render.spp, 7);
}

#[test]
fn what_shines_in_the_scene_file_takes_the_place_of_the_lights_of_the_model() {
    assert_eq!(scene(MODEL).lights.len(), 1);
    let lamp = "light = [{ kind = 'point', position = [0, 9, 0], intensity = 5 }]\n";
    let point = scene(&format!("{lamp}{MODEL}"));
    assert!(matches!(point.lights[..], [Light { kind: LightKind::Point { .. }, .. }]), "{:?}", point.lights);
    let sky = scene(&format!("environment.color = 2\n{MODEL}"));
    assert!(sky.lights.is_empty() && sky.environment.is_some());
    let glow = format!("material.glow = {{ kind = 'diffuse', emission = 3 }}\n{MODEL}");
    let glow = scene(&glow);
    assert!(glow.lights.is_empty() && glow.environment.is_none());
}

#[test]
fn a_camera_of_the_scene_file_takes_the_place_of_one_that_frames_the_model() {
    // The triangle is at x from 1 to 2 and y from 0 to 1
    let framed = scene(MODEL).camera;
    assert_eq!(framed.target, Vec3::new(1.5, 0.5, 0.0));
    let own = scene(&format!("camera.position = [0, 0, 9]\n{MODEL}")).camera;
    assert_eq!((own.position, own.target), (Vec3::Z * 9.0, Vec3::ZERO));
}

#[test]
fn models_are_placed_and_read_once() {
    let moved = "transform = [{ translate = [0, 4, 0] }]\n";
    let text = format!("{MODEL}{moved}{MODEL}{MODEL}time = 2\n");
    let mut memory = Memory::new(&[("scene.toml", &text)]);
    let (scene, _) =
        read_scene_with(Path::new("scene.toml"), &[], &ModelChoice::default(), &mut memory).unwrap();
    let models: Vec<_> = memory.loaded.iter().filter(|name| name.starts_with("chair")).collect();
    assert_eq!(models, ["chair.glb None None", "chair.glb Some(2.0) None"]);
    let places: Vec<Vec3> = scene.instances.iter().map(|i| i.world_from_object.translation.into()).collect();
    assert_eq!(places, [Vec3::new(1.0, 4.0, 0.0), Vec3::X, Vec3::X]);
}

#[test]
fn choices_of_the_command_line_win_and_need_a_model() {
    let choice = ModelChoice { time: Some(3.0), variant: Some("blue".into()), camera: None };
    let scene = showing(&format!("{MODEL}time = 1\nvariant = 'red'\n"), &choice).unwrap();
    assert_eq!(scene.instances[0].name, "chair.glb Some(3.0) Some(\"blue\")");
    let error = showing("", &choice).unwrap_err().to_string();
    assert!(error.starts_with("--time, --camera and --variant choose in glTF models"), "{error}");
    let none = ModelChoice { camera: Some("top".into()), ..ModelChoice::default() };
    let error = showing(MODEL, &none).unwrap_err().to_string();
    assert_eq!(error, "the model has no camera \"top\"; it has none");
}

#[test]
fn keys_that_do_not_go_together_are_refused() {
    let error = |text: &str| showing(text, &ModelChoice::default()).unwrap_err().to_string();
    assert!(error(&format!("{MODEL}material = 'x'\n")).contains("`material` has no meaning beside `file`"));
    let inline = "mesh.m = { positions = [[0,0,0],[1,0,0],[0,1,0]], triangles = [[0,1,2]] }\n";
    let late = error(&format!("{inline}[[instance]]\nmesh = 'm'\ntime = 1\n"));
    assert!(late.contains("`time` needs a `file`"), "{late}");
}
