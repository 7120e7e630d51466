//! The page as somebody uses it: with a mouse, with keys, and with its own buttons.

use super::browser::{Browser, Tab, chromium, serve};
use super::{Room, wait};
use base64::Engine as _;
use dapple::film::{Format, Meta, encode};
use dapple::live::{Live, Server, Shot};
use dapple::scene::{Focus, ToneCurve};
use serde_json::{Value, json};
use std::sync::Arc;

/// Bits of the keys that are held, as the protocol has them.
const ALT: u32 = 1;
const CTRL: u32 = 2;
const SHIFT: u32 = 8;

/// A page that shows the scene of a room. It ends from the top.
struct Stage {
    browser: Browser,
    tab: Tab,
    server: Server,
    live: Live,
    room: Room,
}

impl Stage {
    /// None without Chromium.
    fn of(room: Room) -> Option<Self> {
        let mut browser = Browser::start(chromium()?);
        let live = room.live(8);
        let server = serve(&room, &live);
        let tab = browser.open(server.url());
        let mut stage = Self { browser, tab, server, live, room };
        stage.until("true");
        Some(stage)
    }

    /// Waits for a condition, and until all samples are drawn.
    fn until(&mut self, condition: &str) {
        let all = "dapple.idle && dapple.shown.generation === dapple.state.generation && dapple.shown.spp === 8";
        self.browser.wait(&self.tab, &format!("{all} && ({condition})"));
    }

    fn value(&mut self, expression: &str) -> Value {
        self.browser.value(&self.tab, expression)
    }

    fn number(&mut self, expression: &str) -> f64 {
        self.value(expression).as_f64().unwrap()
    }

    fn text(&mut self, expression: &str) -> String {
        self.value(expression).as_str().unwrap().to_owned()
    }

    fn point(&mut self, expression: &str) -> [f64; 2] {
        serde_json::from_value(self.value(expression)).unwrap()
    }

    /// Where the middle of a pixel is.
    fn place(&mut self, x: usize, y: usize) -> [f64; 2] {
        self.point(&format!("dapple.place({x}, {y})"))
    }

    /// What the server shows.
    fn shot(&self) -> Arc<Shot> {
        wait(&self.live, "8 samples", |state| state.shot.as_ref().is_some_and(|shot| shot.spp == 8)).shot.unwrap()
    }

    fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], more: &Value) {
        let mut event = json!({"type": kind, "x": x, "y": y});
        event.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.browser.call(Some(&self.tab.0), "Input.dispatchMouseEvent", &event);
    }

    /// Drags from the middle of the canvas, or from elsewhere.
    fn drag(&mut self, from: [f64; 2], by: [f64; 2], button: &str) {
        let held = json!({"button": button, "buttons": if button == "right" { 2 } else { 1 }, "clickCount": 1});
        self.mouse("mouseMoved", from, &json!({}));
        self.mouse("mousePressed", from, &held);
        let at = |part: f64| [from[0] + part * by[0], from[1] + part * by[1]];
        for part in [0.5, 1.0] {
            self.mouse("mouseMoved", at(part), &held);
        }
        self.mouse("mouseReleased", at(1.0), &json!({"button": button, "clickCount": 1}));
    }

    fn click_at(&mut self, at: [f64; 2], modifiers: u32) {
        self.mouse("mouseMoved", at, &json!({}));
        for kind in ["mousePressed", "mouseReleased"] {
            self.mouse(kind, at, &json!({"button": "left", "clickCount": 1, "modifiers": modifiers}));
        }
    }

    /// Clicks on the middle of an element.
    fn click(&mut self, id: &str) {
        let middle = self.middle(id);
        self.click_at(middle, 0);
    }

    fn middle(&mut self, id: &str) -> [f64; 2] {
        self.point(&format!(
            "(box => [box.left + box.width / 2, box.top + box.height / 2])(document.getElementById('{id}').getBoundingClientRect())"
        ))
    }

    /// Presses a key and lets it go.
    fn key(&mut self, key: &str, modifiers: u32) {
        for kind in ["rawKeyDown", "keyUp"] {
            let code = if key.len() == 1 { i32::from(key.to_uppercase().as_bytes()[0]) } else { key_code(key) };
            let event = json!({"type": kind, "key": key, "code": key, "modifiers": modifiers, "windowsVirtualKeyCode": code});
            self.browser.call(Some(&self.tab.0), "Input.dispatchKeyEvent", &event);
        }
    }

    /// Waits until the camera is somewhere.
    fn stands_at(&mut self, place: [f64; 3]) {
        self.until(&format!("Math.hypot(...dapple.state.camera.position.map((v, i) => v - {place:?}[i])) < 1e-4"));
    }

    /// Where the camera is, as in a scene.
    fn position(&mut self) -> String {
        self.value("dapple.state.camera.position").to_string()
    }
}

fn key_code(key: &str) -> i32 {
    match key {
        "ArrowLeft" => 37,
        "ArrowRight" => 39,
        "ArrowDown" => 40,
        "Home" => 36,
        _ => panic!("what key is {key}?"),
    }
}

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
    // 0.006 radians to a pixel; the scene follows the pointer
    let middle = stage.middle("picture");
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
    let wheel = |notches: i32, modifiers: u32| json!({"deltaX": 0, "deltaY": notches, "modifiers": modifiers});
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
fn a_camera_without_a_lens_cannot_focus() {
    let Some(mut stage) = Stage::of(level()) else { return };
    assert_eq!(stage.value("document.getElementById('focus').disabled"), true);
    let sphere = stage.place(8, 6);
    stage.click_at(sphere, ALT);
    stage.click("focus");
    // It turns instead
    let [x, y] = sphere;
    stage.drag([x, y], [-50.0, 0.0], "left");
    stage.stands_at([5.0 * 0.3_f64.sin(), 1.0, 5.0 * 0.3_f64.cos()]);
}

/// Colours of the pixels on the screen, at their middles.
fn screen(stage: &mut Stage) -> Vec<[u8; 3]> {
    let places = "Array.from({length: 192}, (_, i) => dapple.place(i % 16, Math.floor(i / 16)))";
    let places: Vec<[f64; 2]> = serde_json::from_value(stage.value(places)).unwrap();
    let picture =
        stage.browser.call(Some(&stage.tab.0), "Page.captureScreenshot", &json!({"format": "png"}));
    let bytes = base64::engine::general_purpose::STANDARD.decode(picture["data"].as_str().unwrap()).unwrap();
    let screen = image::load_from_memory(&bytes).unwrap().to_rgb8();
    places.into_iter().map(|[x, y]| screen.get_pixel(x as u32, y as u32).0).collect()
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
    assert!(screen(&mut stage).iter().zip(&now).all(|(&seen, &now)| near(seen, now)));
    let check = |stage: &mut Stage, columns: usize| {
        let seen = screen(stage);
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
    stage.until("Math.abs(document.getElementById('divider').getAttribute('aria-valuenow') - 50) > 10");
    check(&mut stage, 4);
    stage.key("Home", 0);
    stage.until("document.getElementById('divider').getAttribute('aria-valuenow') === '0'");
    check(&mut stage, 0);
    stage.key("w", 0);
    stage.until("document.getElementById('divider').hidden");
    assert!(screen(&mut stage).iter().zip(&now).all(|(&seen, &now)| near(seen, now)));
}
