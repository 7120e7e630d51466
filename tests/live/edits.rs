//! What becomes of edits.

use super::{Room, cache, gpu, wait, wait_for};
use dapple::live::{Event, Generation};
use dapple::render::Next;

/// What an edit cost: trees, kernels that were compiled, and whether as much was sent as the texels are.
fn cost(generation: &Generation) -> (u32, u32) {
    (generation.opened.trees, generation.opened.kernels)
}

#[test]
fn an_edit_does_only_what_it_touches() {
    let room = Room::new();
    let mut studio = room.studio(&gpu(), cache());
    let mut before = studio.generation().unwrap();
    assert_eq!(before.opened.trees, 2, "of the triangle, and over it and the sphere");
    let mut edit = |what: &dyn Fn()| {
        what();
        let next = studio.generation().unwrap();
        let sent = next.opened.bytes;
        let spent = cost(&next);
        before = next;
        (spent, sent)
    };
    let scene = |from: &str, to: &str| room.edit("scene.toml", from, to);
    assert_eq!(edit(&|| {}), ((0, 0), 0), "nothing changed");
    assert_eq!(edit(&|| scene("fov = 35", "fov = 40")), ((0, 0), 0), "the camera is in the frame");
    let (spent, sent) = edit(&|| scene("color = 0.6", "color = 0.5"));
    assert_eq!(spent, (0, 0), "a constant of a material");
    assert!((1..1000).contains(&sent), "{sent} bytes for a material");
    let (spent, sent) = edit(&|| scene("intensity = 40", "intensity = 50"));
    assert_eq!(spent, (0, 0), "a light");
    assert!((1..1000).contains(&sent), "{sent} bytes for a light");
    let (spent, sent) = edit(&|| room.paint("picture.png", 200));
    assert_eq!(spent, (0, 0), "a picture");
    assert!(sent > 0, "texels");
    assert_eq!(edit(&|| room.edit("triangle.ply", "-3 0 -1", "-2 0 -1")).0, (2, 0), "a mesh");
    assert_eq!(edit(&|| scene("center = [0, 1, 0]", "center = [0, 1.5, 0]")).0, (1, 0), "a sphere");
}

#[test]
fn a_file_of_the_shaders_compiles_the_kernels_again_that_include_it() {
    let room = Room::new();
    let mut studio = room.studio(&gpu(), cache());
    studio.generation().unwrap();
    let mut number = 0;
    let mut append = |name: &str| {
        number += 1;
        // A number that no other run has, so that nothing is found on disk
        let mark = format!("\nconst float UNIQUE_{}_{number} = 1.0;\n", std::process::id());
        let text = std::fs::read_to_string(room.path("shaders").join(name)).unwrap();
        room.write(&format!("shaders/{name}"), text + &mark);
        let edited = [room.path("shaders").canonicalize().unwrap().join(name)].into();
        (studio.touched_by(&edited), studio.generation().unwrap().opened.kernels)
    };
    assert_eq!(append("material/diffuse.glsl"), (true, 1), "shade");
    assert_eq!(append("camera/thin_lens.glsl"), (true, 1), "camera");
    assert_eq!(append("geometry/traverse.glsl"), (true, 4), "intersect and shadow, each for long rays too");
    assert_eq!(append("base/math.glsl").1, 7, "all but that of the queues");
    let unknown = [room.path("shaders").canonicalize().unwrap().join("notes.txt")].into();
    assert!(!studio.touched_by(&unknown));
}

#[test]
fn edits_of_the_scene_and_of_its_files_are_followed() {
    let room = Room::new();
    let live = room.live(8);
    let first = wait_for(&live, 1);
    assert!(first.error.is_none() && first.latency.is_none());
    let grey = |state: &dapple::live::State| state.shot.as_ref().unwrap().picture.rgb[0];
    let edits: [&dyn Fn(); 3] = [
        &|| room.edit("scene.toml", "color = 0.2", "color = 0.7"),
        &|| room.paint("picture.png", 220),
        &|| room.edit("triangle.ply", "0 3 -1", "0 5 -1"),
    ];
    let mut before = grey(&first);
    for (edit, number) in edits.into_iter().zip(2..) {
        edit();
        let state = wait_for(&live, number);
        assert!(state.latency.is_some_and(|seconds| seconds > 0.0));
        if number == 2 {
            assert_ne!(grey(&state), before, "the sky is in the corner");
            assert_eq!(grey(&state), [0.7; 3]);
        }
        before = grey(&state);
    }
}

#[test]
fn an_edit_with_an_error_keeps_the_picture_and_names_the_place() {
    let room = Room::new();
    let live = room.live(4);
    let first = wait_for(&live, 1);
    room.edit("scene.toml", "radius = 1", "radius = -1");
    let bad = wait(&live, "an error", |state| state.error.is_some());
    let error = bad.error.unwrap();
    let place = error.place.clone().unwrap();
    assert_eq!((place.file, place.line), (room.path("scene.toml"), 31), "{}", error.message);
    assert_eq!(bad.generation.unwrap().number, 1);
    // A shader that does not compile, while the scene is wrong too, and both mended
    room.edit("scene.toml", "radius = -1", "radius = 1");
    wait_for(&live, 2);
    room.edit("shaders/material/diffuse.glsl", "vec3 diffuse_eval(", "vec3 diffuse_eval((");
    let bad = wait(&live, "an error", |state| state.error.is_some());
    let place = bad.error.unwrap().place.unwrap();
    assert_eq!(place.file, room.path("shaders/material/diffuse.glsl"));
    assert!(place.line > 0);
    room.edit("shaders/material/diffuse.glsl", "vec3 diffuse_eval((", "vec3 diffuse_eval(");
    let good = wait_for(&live, 3);
    assert!(good.error.is_none());
    assert_eq!(good.shot.unwrap().picture.frame, first.shot.unwrap().picture.frame);
}

#[test]
fn the_picture_is_that_of_a_render_of_the_same_samples() {
    let room = Room::new();
    let live = room.live(24);
    let state = wait(&live, "24 samples", |state| state.shot.as_ref().is_some_and(|shot| shot.spp == 24));
    let shot = state.shot.unwrap();
    let film = shot.generation.renderer.render(0, 24, &mut |_| Next::Continue).unwrap();
    assert_eq!(shot.picture, film.resolve());
}

#[test]
fn it_can_be_looked_at_from_elsewhere_and_back() {
    let room = Room::new();
    let live = room.live(4);
    let first = wait_for(&live, 1);
    let mut camera = first.generation.unwrap().camera.clone();
    camera.position.x += 1.0;
    live.events().send(Event::Look(Some(camera.clone()))).unwrap();
    assert_eq!(wait_for(&live, 2).generation.unwrap().camera.position, camera.position);
    // It stays through an edit of something else
    room.edit("scene.toml", "color = 0.6", "color = 0.1");
    assert_eq!(wait_for(&live, 3).generation.unwrap().camera.position, camera.position);
    live.events().send(Event::Look(None)).unwrap();
    let back = wait_for(&live, 4).generation.unwrap();
    assert_eq!(back.camera.position.x, camera.position.x - 1.0);
}

/// A triangle whose positions are in a file of their own.
const MODEL: &str = r#"{
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [9, 9, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "m.bin"}]
}"#;

#[test]
fn the_files_of_a_model_are_followed() {
    let room = Room::new();
    let corners = |side: f32| -> Vec<u8> {
        [0.0, 0.0, 0.0, side, 0.0, 0.0, 0.0, side, 0.0_f32].iter().flat_map(|x| x.to_le_bytes()).collect()
    };
    room.write("m.bin", corners(1.0));
    room.write("m.gltf", MODEL);
    room.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    room.write("m.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
    room.write(
        "scene.toml",
        format!("{}\n[[instance]]\nfile = \"m.gltf\"\n[[instance]]\nfile = \"m.obj\"\n", super::SCENE),
    );
    let live = room.live(4);
    wait_for(&live, 1);
    room.write("m.bin", corners(2.0));
    wait_for(&live, 2);
    room.write("m.mtl", "newmtl a\nKd 0.9 0.1 0.1\n");
    wait_for(&live, 3);
}
