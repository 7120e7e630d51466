//! The page as somebody uses it: with a mouse, with keys, and with its own buttons.

use super::stage::{ALT, CTRL, SHIFT, Stage};
use super::{Room, cache, gpu};
use dapple::film::{Format, Meta, encode};
use dapple::live::{Live, Request, Shot};
use dapple::scene::{Focus, ToneCurve};
use serde_json::json;
use std::sync::{Arc, Mutex};

/// The camera looks at the middle of the sphere, 5 away.
fn level() -> Room {
    let room = Room::new();
    room.edit("scene.toml", "fov = 35", "fov = 35\ntarget = [0, 1, 0]");
    room
}

#[test]
fn a_drag_turns_the_camera() {
    let Some(mut stage) = Stage::of(level()) else { return };
    let at_first = stage.shot();
    assert_eq!(stage.value("dapple.state.camera.moved"), false);
    assert_eq!(stage.value("document.getElementById('look-reset').disabled"), true);
    // Nothing to focus
    assert_eq!(stage.value("document.getElementById('focus').disabled"), true);
    let middle = stage.middle("picture");
    stage.click("focus");
    stage.click_at(middle, ALT);
    // 0.006 radians to a pixel; the scene follows the pointer
    stage.drag(middle, [100.0, 50.0], "left");
    let (right, above) = (-0.6_f64, 0.3_f64);
    let flat = 5.0 * above.cos();
    stage.stands_at([flat * right.sin(), 1.0 + 5.0 * above.sin(), flat * right.cos()]);
    assert_eq!(stage.value("dapple.state.camera.target"), json!([0, 1, 0]));
    assert_eq!(stage.value("dapple.state.camera.moved"), true);
    assert!(stage.value("dapple.shown.generation").as_u64().unwrap() > 1);
    let turned = stage.shot();
    assert_ne!(turned.picture.rgb, at_first.picture.rgb);
    // A key turns on, to the right
    stage.key("ArrowRight", 0);
    let right = right + 0.1;
    stage.stands_at([flat * right.sin(), 1.0 + 5.0 * above.sin(), flat * right.cos()]);
    let (turned, position) = (stage.shot(), stage.position());
    // An edit does not move the camera back, and the button does
    stage.room.edit("scene.toml", "color = 0.2", "color = 0.4");
    stage.until("Math.abs(dapple.pixel(15, 0)[0] - 0.4) < 1e-3 && dapple.state.camera.moved");
    assert_eq!(stage.position(), position);
    stage.room.edit("scene.toml", "color = 0.4", "color = 0.2");
    stage.click("look-reset");
    stage.until("!dapple.state.camera.moved && Math.abs(dapple.pixel(15, 0)[0] - 0.2) < 1e-3");
    stage.stands_at([0.0, 1.0, 5.0]);
    assert_eq!(stage.shot().picture.rgb, at_first.picture.rgb);
    // A scene with a camera there shows what the drag showed
    stage.room.edit("scene.toml", "position = [0, 1, 5]", &format!("position = {position}"));
    stage.until(&format!("JSON.stringify(dapple.state.camera.position) === '{position}'"));
    assert_eq!(stage.value("dapple.state.camera.moved"), false);
    assert_eq!(stage.shot().picture.rgb, turned.picture.rgb);
}

#[test]
fn a_wheel_with_ctrl_goes_nearer_and_without_it_zooms() {
    let Some(mut stage) = Stage::of(level()) else { return };
    let middle = stage.middle("picture");
    let zoomed = "document.getElementById('zoom-one').textContent";
    let whole = stage.text(zoomed);
    // exp(0.002) to a notch
    let wheel =
        |notches: i32, modifiers: u32| json!({"deltaX": 0, "deltaY": notches, "modifiers": modifiers});
    stage.mouse("mouseWheel", middle, &wheel(-100, CTRL));
    let factor = (-0.2_f64).exp();
    stage.stands_at([0.0, 1.0, 5.0 * factor]);
    assert_eq!(stage.value("dapple.state.camera.moved"), true);
    assert_eq!(stage.text(zoomed), whole);
    // 0.004 to a pixel
    stage.drag(middle, [30.0, -20.0], "right");
    stage.stands_at([0.0, 1.0, 5.0 * factor * factor]);
    let depth = f64::from(stage.shot().picture.depth[6 * 16 + 8]);
    assert!((depth - (5.0 * factor * factor - 1.0)).abs() < 0.05, "{depth}");
    let generation = stage.number("dapple.state.generation");
    let (one, two) = (stage.place(0, 0), stage.place(1, 0));
    stage.mouse("mouseWheel", middle, &wheel(-100, 0));
    stage.until(&format!("{zoomed} !== '{whole}'"));
    let (near, next) = (stage.place(0, 0), stage.place(1, 0));
    assert!(((next[0] - near[0]) / (two[0] - one[0]) - 0.2_f64.exp()).abs() < 1e-3);
    assert_eq!(stage.number("dapple.state.generation"), generation);
    stage.key("r", 0);
    stage.until("!dapple.state.camera.moved");
    stage.stands_at([0.0, 1.0, 5.0]);
}

/// The distance that is sharp.
fn sharp_at(shot: &Shot) -> f32 {
    match shot.generation.camera.thin_lens().unwrap().focus {
        Focus::Distance(distance) => distance,
        Focus::Plane { .. } => panic!("a plane"),
    }
}

#[test]
fn a_click_focuses_on_what_is_there() {
    let room = level();
    room.edit("scene.toml", "fov = 35", "fov = 35\nlens_radius = 0.02\nfocus_distance = 2");
    let Some(mut stage) = Stage::of(room) else { return };
    assert_eq!(sharp_at(&stage.shot()), 2.0);
    let armed = "document.getElementById('focus').getAttribute('aria-pressed')";
    // The sphere is 4 away where it is nearest
    stage.click("focus");
    assert_eq!(stage.text(armed), "true");
    let sphere = stage.place(8, 6);
    stage.click_at(sphere, 0);
    stage.until("dapple.state.generation === 2 && dapple.state.camera.moved");
    let sharp = sharp_at(&stage.shot());
    assert!((sharp - 4.0).abs() < 0.05, "{sharp}");
    // The next click turns nothing and focuses nothing
    assert_eq!(stage.text(armed), "false");
    stage.click_at(sphere, 0);
    // All of the triangle is 6 away along the view, also where the ray to it is longer
    let triangle = stage.place(13, 8);
    stage.click_at(triangle, ALT);
    stage.until("dapple.state.generation === 3");
    let shot = stage.shot();
    let (sharp, far) = (sharp_at(&shot), shot.picture.depth[8 * 16 + 13]);
    assert!((sharp - 6.0).abs() < 0.01 && far > 6.1, "{sharp}, {far}");
    // Where nothing is, the page says so
    let sky = stage.place(0, 0);
    stage.click_at(sky, ALT);
    stage.until("document.getElementById('notice').textContent.includes('nothing to focus on')");
    assert_eq!(stage.number("dapple.state.generation"), 3.0);
    stage.key("r", 0);
    stage.until("dapple.state.generation === 4 && !dapple.state.camera.moved");
    assert_eq!(sharp_at(&stage.shot()), 2.0);
}

#[test]
fn no_step_is_lost_when_the_server_is_slow() {
    let room = level();
    let gate = Arc::new(Mutex::new(()));
    let held = gate.clone();
    let through = Box::new(move |_: &mut _, _: &[_]| {
        drop(held.lock());
        Ok(())
    });
    let live = Live::start(gpu(), Request { adjust: through, ..room.request(cache()) }, 8).unwrap();
    let Some(mut stage) = Stage::with(room, live) else { return };
    // Counts how often the page gave up to wait for a step
    stage.value(
        "window.late = 0; window.timer = setTimeout;
        window.setTimeout = (run, after) => timer(() => { run(); late += after === 1000; }, after); 0",
    );
    let closed = gate.lock().unwrap();
    stage.key("ArrowRight", 0);
    stage.wait("late === 1");
    assert_eq!(stage.value("dapple.idle"), false);
    stage.key("ArrowRight", 0);
    drop(closed);
    stage.stands_at([5.0 * 0.2_f64.sin(), 1.0, 5.0 * 0.2_f64.cos()]);
}

/// Colours of the pixels in a PNG of a shot, as it is written with some exposure and curve.
fn written(shot: &Shot, stops: f32, curve: ToneCurve) -> Vec<[u8; 3]> {
    let mut film = shot.generation.film.clone();
    (film.exposure.stops, film.tone_curve) = (stops, curve);
    let meta = Meta::of(&shot.picture.frame, shot.spp);
    let bytes = encode(Format::Png, &shot.picture, &film, &meta).unwrap();
    image::load_from_memory(&bytes).unwrap().to_rgb8().pixels().map(|pixel| pixel.0).collect()
}

fn near(one: [u8; 3], two: [u8; 3]) -> bool {
    one.into_iter().zip(two).all(|(one, two)| one.abs_diff(two) <= 1)
}

#[test]
fn left_of_the_divider_is_the_generation_before() {
    let Some(mut stage) = Stage::of(level()) else { return };
    let before = written(&stage.shot(), 0.0, ToneCurve::Srgb);
    stage.room.edit("scene.toml", "color = 0.2", "color = [0.7, 0.5, 0.3]");
    stage.room.edit("scene.toml", "size = [16, 12]", "size = [16, 12]\nfilm.exposure = -1");
    stage.until("dapple.state.gain === 0.5 && Math.abs(dapple.pixel(0, 0)[0] - 0.7) < 1e-3");
    let now = written(&stage.shot(), -1.0, ToneCurve::Srgb);
    assert!(before.iter().zip(&now).all(|(&before, &now)| !near(before, now)));
    assert!(stage.screen().iter().zip(&now).all(|(&seen, &now)| near(seen, now)));
    let check = |stage: &mut Stage, columns: usize| {
        let seen = stage.screen();
        // The names of the sides are at the top
        for i in 32..192 {
            let right = if i % 16 < columns { before[i] } else { now[i] };
            assert!(near(seen[i], right), "{:?} for {right:?} at {i}, {columns} columns", seen[i]);
        }
    };
    stage.click("wipe");
    stage.until("dapple.before?.spp === 8 && !document.getElementById('divider').hidden");
    check(&mut stage, 8);
    // Both sides can be asked for their numbers
    let linear = stage.number("dapple.pixel(0, 0, 'before')[0]");
    assert!((linear - 0.2).abs() < 1e-3, "{linear}");
    // It is dragged, and moved with keys
    let divider = stage.middle("divider");
    let quarter = [0, 4].map(|x| stage.place(x, 0)[0]);
    stage.drag(divider, [quarter[0] - quarter[1], 0.0], "left");
    let right = 100.0 * (divider[0] + quarter[0] - quarter[1]) / stage.number("innerWidth");
    stage.until(&format!(
        "Math.abs(document.getElementById('divider').getAttribute('aria-valuenow') - {right}) <= 1"
    ));
    check(&mut stage, 4);
    stage.key("Home", 0);
    stage.until("document.getElementById('divider').getAttribute('aria-valuenow') === '0'");
    check(&mut stage, 0);
    stage.key("w", 0);
    stage.until("document.getElementById('divider').hidden");
    assert!(stage.screen().iter().zip(&now).all(|(&seen, &now)| near(seen, now)));
}

#[test]
fn planes_are_those_of_the_render() {
    let room = level();
    // So that some pixels are covered in part
    room.edit("scene.toml", "size = [16, 12]", "size = [16, 12]\nfilm.transparent = true");
    let Some(mut stage) = Stage::of(room) else { return };
    let shot = stage.shot();
    let picture = &shot.picture;
    let thrice = |list: &[f32]| list.iter().map(|&value| [value; 3]).collect::<Vec<_>>();
    let planes = [
        ("albedo", picture.albedo.clone()),
        ("normal", picture.normal.clone()),
        ("depth", thrice(&picture.depth)),
        ("alpha", thrice(&picture.alpha)),
        ("variance", picture.variance.clone()),
        ("color", picture.rgb.clone()),
    ];
    let all = "Array.from({length: 192}, (_, i) => dapple.pixel(i % 16, Math.floor(i / 16)).map(String))";
    for (name, right) in &planes {
        assert!(right.iter().any(|value| value != &right[0]), "{name} is the same everywhere");
        stage.key("a", 0);
        stage.until(&format!("dapple.shown.aov === '{name}'"));
        assert_eq!(stage.text("document.getElementById('aov').value"), *name);
        let seen: Vec<[String; 3]> = serde_json::from_value(stage.value(all)).unwrap();
        for (i, (seen, right)) in seen.iter().zip(right).enumerate() {
            for (seen, &right) in seen.iter().zip(right) {
                let seen: f32 = seen.parse().unwrap();
                // All but a depth are sent as halves
                let most = if *name == "depth" { 0.0 } else { 5e-4 * right.abs() + 1e-7 };
                assert!(seen == right || (seen - right).abs() <= most, "{name} {i}: {seen} for {right}");
            }
        }
    }
    stage.key("a", SHIFT);
    stage.until("dapple.shown.aov === 'variance'");
    // The list itself
    stage.value("document.getElementById('aov').focus()");
    stage.key("ArrowUp", 0);
    stage.until("dapple.shown.aov === 'alpha'");
}

#[test]
fn exposure_and_curves_are_those_of_a_png() {
    let room = level();
    room.edit("scene.toml", "color = 0.6", "color = [0.9, 0.3, 0.05]");
    room.edit("scene.toml", "color = 0.2", "color = [0.05, 0.6, 2]");
    let Some(mut stage) = Stage::of(room) else { return };
    let shot = stage.shot();
    let check = |stage: &mut Stage, shot: &Shot, stops: f32, curve: ToneCurve| {
        let right = written(shot, stops, curve);
        for (i, (seen, right)) in stage.screen().into_iter().zip(right).enumerate() {
            assert!(near(seen, right), "{seen:?} for {right:?} at {i}, {stops} stops, {curve:?}");
        }
    };
    check(&mut stage, &shot, 0.0, ToneCurve::Srgb);
    // From the list, with keys of half a stop
    stage.value("document.getElementById('curve').focus()");
    for (name, curve) in [
        ("srgb", ToneCurve::Srgb),
        ("linear", ToneCurve::Linear),
        ("aces", ToneCurve::Aces),
        ("agx", ToneCurve::Agx),
    ] {
        stage.key("ArrowDown", 0);
        stage.until(&format!("document.getElementById('curve').value === '{name}'"));
        check(&mut stage, &shot, 0.0, curve);
    }
    stage.click("stops-reset");
    for (key, modifiers, stops) in
        [("e", 0, 0.5), ("e", 0, 1.0), ("e", SHIFT, 0.5), ("0", 0, 0.0), ("e", SHIFT, -0.5)]
    {
        stage.key(key, modifiers);
        stage.until(&format!("Number(document.getElementById('stops').value) === {stops}"));
        check(&mut stage, &shot, stops, ToneCurve::Agx);
    }
    // What the scene says, and stops on top of it
    stage.room.edit(
        "scene.toml",
        "size = [16, 12]",
        "size = [16, 12]\nfilm.exposure = 2\nfilm.tone_curve = \"aces\"",
    );
    stage.until("dapple.state.gain === 4");
    check(&mut stage, &shot, 1.5, ToneCurve::Agx);
    stage.value("document.getElementById('curve').focus()");
    stage.key("Home", 0);
    stage.until("document.getElementById('curve').value === 'scene'");
    check(&mut stage, &shot, 1.5, ToneCurve::Aces);
}

/// The numbers of the panel of the pixel, by their names.
fn panel(stage: &mut Stage) -> Vec<(String, Vec<String>)> {
    let texts = "Array.from(document.querySelectorAll('#probe span'), (span) => [span.firstChild.innerText, span.lastChild.textContent])";
    let texts: Vec<[String; 2]> = serde_json::from_value(stage.value(texts)).unwrap();
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect();
    texts.iter().map(|[name, text]| (name.trim().to_owned(), words(text))).collect()
}

#[test]
fn the_panel_has_the_values_under_the_pointer() {
    let Some(mut stage) = Stage::of(level()) else { return };
    let probe = |text: &str| format!("document.getElementById('probe').innerText.includes('{text}')");
    let check = |stage: &mut Stage, x: usize, y: usize, names: &[&str]| {
        let (shot, panel) = (stage.shot(), panel(stage));
        let (picture, i) = (&shot.picture, y * 16 + x);
        let right: [(&str, &[f32]); 7] = [
            ("x y", &[x as f32, y as f32]),
            ("rgb", &picture.rgb[i]),
            ("alpha", &[picture.alpha[i]]),
            ("albedo", &picture.albedo[i]),
            ("normal", &picture.normal[i]),
            ("depth", &[picture.depth[i]]),
            ("samples", &[8.0]),
        ];
        assert_eq!(panel.len(), right.len() + names.len());
        for ((name, texts), right) in panel[right.len()..].iter().zip(names) {
            assert_eq!(format!("{name} {}", texts.join(" ")), *right);
        }
        for ((name, texts), (right_name, values)) in panel.iter().zip(right) {
            assert_eq!((name.as_str(), texts.len()), (right_name, values.len()));
            for (text, &value) in texts.iter().zip(values) {
                let seen: f32 = if text == "∞" { f32::INFINITY } else { text.parse().unwrap() };
                assert!(
                    seen == value || (seen - value).abs() < 6e-5_f32.max(5e-3 * value.abs()),
                    "{name}: {text} for {value}"
                );
            }
        }
    };
    for (x, y, names) in [
        (8, 6, &["object shape 1", "material clay"][..]),
        (13, 8, &["object instance 1", "material papered"]),
        (15, 0, &[]),
    ] {
        let at = stage.place(x, y);
        stage.mouse("mouseMoved", at, &json!({}));
        stage.until(&probe(&format!("x y {x} {y}")));
        for name in names {
            stage.until(&probe(name));
        }
        check(&mut stage, x, y, names);
    }
    // The pointer rests, and the picture is another one
    stage.room.edit("scene.toml", "color = 0.2", "color = 0.5");
    stage.until(&probe("rgb 0.5000 0.5000 0.5000"));
    check(&mut stage, 15, 0, &[]);
    let bar = stage.middle("help");
    stage.mouse("mouseMoved", bar, &json!({}));
    stage.until("document.getElementById('probe').innerText === ''");
}
