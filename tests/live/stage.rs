//! A scene, its page in a browser, and the hands of somebody who uses it.

use super::browser::{Browser, Tab, chromium, serve};
use super::{Room, wait};
use base64::Engine as _;
use dapple::live::{Live, Server, Shot};
use serde_json::{Value, json};
use std::sync::Arc;

/// Bits of the keys that are held, as the protocol has them.
pub const ALT: u32 = 1;
pub const CTRL: u32 = 2;
pub const SHIFT: u32 = 8;

/// A page that shows the scene of a room. It ends from the top.
pub struct Stage {
    browser: Browser,
    tab: Tab,
    _server: Server,
    pub live: Live,
    pub room: Room,
}

impl Stage {
    /// None without Chromium.
    pub fn of(room: Room) -> Option<Self> {
        let live = room.live(8);
        Self::with(room, live)
    }

    pub fn with(room: Room, live: Live) -> Option<Self> {
        let mut browser = Browser::start(chromium()?);
        let server = serve(&room, &live);
        let tab = browser.open(server.url());
        let mut stage = Self { browser, tab, _server: server, live, room };
        stage.until("true");
        Some(stage)
    }

    /// Waits for a condition, and until all samples are drawn.
    pub fn until(&mut self, condition: &str) {
        let all =
            "dapple.idle && dapple.shown.generation === dapple.state.generation && dapple.shown.spp === 8";
        self.wait(&format!("{all} && ({condition})"));
    }

    pub fn wait(&mut self, condition: &str) {
        self.browser.wait(&self.tab, condition);
    }

    pub fn value(&mut self, expression: &str) -> Value {
        self.browser.value(&self.tab, expression)
    }

    pub fn number(&mut self, expression: &str) -> f64 {
        self.value(expression).as_f64().unwrap()
    }

    pub fn text(&mut self, expression: &str) -> String {
        self.value(expression).as_str().unwrap().to_owned()
    }

    pub fn point(&mut self, expression: &str) -> [f64; 2] {
        serde_json::from_value(self.value(expression)).unwrap()
    }

    /// Where the middle of a pixel is.
    pub fn place(&mut self, x: usize, y: usize) -> [f64; 2] {
        self.point(&format!("dapple.place({x}, {y})"))
    }

    /// What the server shows.
    pub fn shot(&self) -> Arc<Shot> {
        wait(&self.live, "8 samples", |state| state.shot.as_ref().is_some_and(|shot| shot.spp == 8))
            .shot
            .unwrap()
    }

    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], more: &Value) {
        let mut event = json!({"type": kind, "x": x, "y": y});
        event.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.browser.call(Some(&self.tab.0), "Input.dispatchMouseEvent", &event);
    }

    /// Drags with a button held.
    pub fn drag(&mut self, from: [f64; 2], by: [f64; 2], button: &str) {
        let held =
            json!({"button": button, "buttons": if button == "right" { 2 } else { 1 }, "clickCount": 1});
        self.mouse("mouseMoved", from, &json!({}));
        self.mouse("mousePressed", from, &held);
        let at = |part: f64| [from[0] + part * by[0], from[1] + part * by[1]];
        for part in [0.5, 1.0] {
            self.mouse("mouseMoved", at(part), &held);
        }
        self.mouse("mouseReleased", at(1.0), &json!({"button": button, "clickCount": 1}));
    }

    pub fn click_at(&mut self, at: [f64; 2], modifiers: u32) {
        self.mouse("mouseMoved", at, &json!({}));
        for kind in ["mousePressed", "mouseReleased"] {
            self.mouse(kind, at, &json!({"button": "left", "clickCount": 1, "modifiers": modifiers}));
        }
    }

    /// Clicks on the middle of an element.
    pub fn click(&mut self, id: &str) {
        let middle = self.middle(id);
        self.click_at(middle, 0);
    }

    pub fn middle(&mut self, id: &str) -> [f64; 2] {
        self.point(&format!(
            "(box => [box.left + box.width / 2, box.top + box.height / 2])(document.getElementById('{id}').getBoundingClientRect())"
        ))
    }

    /// Presses a key and lets it go.
    pub fn key(&mut self, key: &str, modifiers: u32) {
        for kind in ["rawKeyDown", "keyUp"] {
            let code =
                if key.len() == 1 { i32::from(key.to_uppercase().as_bytes()[0]) } else { key_code(key) };
            let event = json!({"type": kind, "key": key, "code": key, "modifiers": modifiers, "windowsVirtualKeyCode": code});
            self.browser.call(Some(&self.tab.0), "Input.dispatchKeyEvent", &event);
        }
    }

    /// Colours of the pixels on the screen, at their middles.
    pub fn screen(&mut self) -> Vec<[u8; 3]> {
        let places = "Array.from({length: 192}, (_, i) => dapple.place(i % 16, Math.floor(i / 16)))";
        let places: Vec<[f64; 2]> = serde_json::from_value(self.value(places)).unwrap();
        let picture =
            self.browser.call(Some(&self.tab.0), "Page.captureScreenshot", &json!({"format": "png"}));
        let bytes =
            base64::engine::general_purpose::STANDARD.decode(picture["data"].as_str().unwrap()).unwrap();
        let screen = image::load_from_memory(&bytes).unwrap().to_rgb8();
        places.into_iter().map(|[x, y]| screen.get_pixel(x as u32, y as u32).0).collect()
    }

    /// Waits until the camera is somewhere.
    pub fn stands_at(&mut self, place: [f64; 3]) {
        self.until(&format!(
            "Math.hypot(...dapple.state.camera.position.map((v, i) => v - {place:?}[i])) < 1e-4"
        ));
    }

    /// Where the camera is, as in a scene.
    pub fn position(&mut self) -> String {
        self.value("dapple.state.camera.position").to_string()
    }
}

fn key_code(key: &str) -> i32 {
    match key {
        "ArrowLeft" => 37,
        "ArrowUp" => 38,
        "ArrowRight" => 39,
        "ArrowDown" => 40,
        "Home" => 36,
        _ => panic!("what key is {key}?"),
    }
}
