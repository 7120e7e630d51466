//! `dapple diff`.

use crate::Room;
use serde_json::Value;

/// A room with the scene by two seeds, and with a light that is a tenth brighter.
fn room() -> Room {
    let room = Room::new();
    for (name, rest) in [("a", "--seed 1"), ("b", "--seed 2"), ("c", "--seed 2 --set environment.color=0.24")]
    {
        room.run(&format!("render scene.toml -q --spp 256 -o {name}.exr {rest}")).code(0);
    }
    room
}

#[test]
fn noise_agrees_and_brightness_differs() {
    let room = room();
    let ran = room.run("diff a.exr b.exr").code(0);
    assert!(ran.out.contains("statistical test  pass pixels"), "{}", ran.out);
    let findings = |words: &str, code: i32| -> Value {
        let ran = room.run(&format!("diff --json {words}")).code(code);
        // An error is a second line
        serde_json::from_str(ran.out.lines().next().unwrap()).unwrap()
    };
    let same = findings("a.exr a.exr", 0);
    assert_eq!(
        (&same["rel_mse"], &same["flip"], &same["different_pixels"]),
        (&0.0.into(), &0.0.into(), &0.into())
    );
    let brighter = findings("a.exr c.exr", 1);
    assert_eq!((&brighter["agree"], &brighter["test"]["accepted"]), (&false.into(), &false.into()));
    assert!(brighter["flip"].as_f64() > findings("a.exr b.exr", 0)["flip"].as_f64());
    // A fifth of the sky, and less than that of what it lights
    findings("a.exr c.exr --systematic 0.21", 0);
    let ran = room.run("diff a.exr c.exr").code(1);
    assert!(ran.err.contains("c.exr: the pictures differ"), "{}", ran.err);
}

#[test]
fn limits_decide_where_no_variance_is_known() {
    let room = room();
    for name in ["a", "c"] {
        room.run(&format!(
            "render scene.toml -q -o {name}.png --set environment.color={}",
            if name == "a" { 0.2 } else { 0.24 }
        ))
        .code(0);
    }
    room.run("diff a.png a.png").code(0);
    room.run("diff a.png c.png").code(1);
    room.run("diff a.png c.png --max-flip 0.5 --max-rel-mse 0.5").code(0);
    room.run("diff a.png c.png --max-flip 0.5 --max-rel-mse 0.0001").code(1);
    room.run("diff a.png c.png --max-flip 0.0001").code(1);
    // A variance of a file of its own: the picture itself, which is far more noise than there is
    let ran = room.run("diff a.png c.png --variance a.png -o panel.png").code(0);
    assert!(ran.out.contains("pass"), "{}", ran.out);
    let panel = image::open(room.path("panel.png")).unwrap().into_rgb8();
    assert_eq!(panel.dimensions(), (48, 12));
    let left = image::open(room.path("a.png")).unwrap().into_rgb8();
    assert!((0..16).all(|x| {
        panel.get_pixel(x, 0).0.iter().zip(left.get_pixel(x, 0).0).all(|(a, b)| a.abs_diff(b) <= 1)
    }));
    // What cannot be compared is an error of another kind
    room.run("render scene.toml -q --size 8x8 -o small.png").code(0);
    let ran = room.run("diff a.png small.png").code(2);
    assert!(ran.err.contains("8 × 8 pixels, the reference has 16 × 12"), "{}", ran.err);
    room.run("diff a.png a.png --variance small.png").code(2);
}
