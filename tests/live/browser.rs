//! The page in a real browser, headless Chromium, driven through its debugging protocol.

use super::{LIMIT, Room, gpu, wait};
use base64::Engine as _;
use dapple::live::{About, Address, Live, Server};
use serde_json::{Value, json};
use std::net::{Ipv4Addr, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Message, WebSocket};

/// A browser that runs.
pub struct Browser {
    process: Child,
    socket: WebSocket<MaybeTlsStream<TcpStream>>,
    calls: u64,
    _profile: TempDir,
}

impl Drop for Browser {
    fn drop(&mut self) {
        _ = self.process.kill();
        _ = self.process.wait();
    }
}

/// Where Chromium is; none where it is not installed, which is a failure in CI.
pub fn chromium() -> Option<&'static str> {
    let found = ["chromium", "chromium-browser", "google-chrome"].into_iter().find(|name| {
        Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
    });
    if found.is_none() {
        assert!(std::env::var_os("CI").is_none_or(|v| v != "true"), "Chromium is not installed");
        eprintln!("SKIPPED: Chromium is not installed");
    }
    found
}

impl Browser {
    pub fn start(program: &str) -> Self {
        let profile = tempfile::tempdir().unwrap();
        let process = Command::new(program)
            .args([
                "--headless=new",
                "--no-sandbox",
                "--disable-gpu",
                "--enable-unsafe-swiftshader",
                "--no-first-run",
            ])
            .args(["--disable-dev-shm-usage", "--hide-scrollbars", "--force-device-scale-factor=1"])
            .args(["--window-size=900,700", "--remote-debugging-port=0"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let address = address(&profile.path().join("DevToolsActivePort"));
        let (socket, _) = tungstenite::connect(address).unwrap();
        Self { process, socket, calls: 0, _profile: profile }
    }

    /// Calls a method, and waits for its result.
    pub fn call(&mut self, session: Option<&str>, method: &str, params: &Value) -> Value {
        self.ask(session, method, params).unwrap_or_else(|error| panic!("{method}: {error}"))
    }

    /// The same where the browser may refuse.
    fn ask(&mut self, session: Option<&str>, method: &str, params: &Value) -> Result<Value, Value> {
        self.calls += 1;
        let mut message = json!({"id": self.calls, "method": method, "params": params});
        if let Some(session) = session {
            message["sessionId"] = session.into();
        }
        self.socket.send(Message::text(message.to_string())).unwrap();
        loop {
            if let Message::Text(text) = self.socket.read().unwrap() {
                let answer: Value = serde_json::from_str(&text).unwrap();
                if answer["id"] == self.calls {
                    let (result, error) = (&answer["result"], &answer["error"]);
                    return if error.is_null() { Ok(result.clone()) } else { Err(error.clone()) };
                }
            }
        }
    }

    /// Opens a tab, and waits until its page is there: what is asked before is lost with the empty one.
    pub fn open(&mut self, url: &str) -> Tab {
        let target = self.call(None, "Target.createTarget", &json!({"url": url}));
        let attach = json!({"targetId": target["targetId"], "flatten": true});
        let session = self.call(None, "Target.attachToTarget", &attach);
        let tab = Tab(session["sessionId"].as_str().unwrap().to_owned());
        let there = json!({"expression": "document.readyState === 'complete' && Boolean(window.dapple)"});
        let start = Instant::now();
        while !self
            .ask(Some(&tab.0), "Runtime.evaluate", &there)
            .is_ok_and(|answer| answer["result"]["value"] == true)
        {
            assert!(start.elapsed() < LIMIT, "the page does not open");
            std::thread::sleep(Duration::from_millis(10));
        }
        tab
    }

    /// The value of an expression in a tab; of what it promises, once it is there.
    pub fn value(&mut self, tab: &Tab, expression: &str) -> Value {
        let params = json!({"expression": expression, "awaitPromise": true, "returnByValue": true});
        let result = self.call(Some(&tab.0), "Runtime.evaluate", &params);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn wait(&mut self, tab: &Tab, expression: &str) {
        let limit = LIMIT.as_millis();
        let true_in_time = self.value(
            tab,
            &format!(
                "new Promise(done => {{
                    const end = performance.now() + {limit};
                    const look = () => {{
                        const it = Boolean(window.dapple && ({expression}));
                        if (it || performance.now() > end) done(it); else setTimeout(look, 10);
                    }};
                    look();
                }})"
            ),
        );
        let state = self.value(tab, "JSON.stringify([window.dapple?.state, window.dapple?.shown])");
        assert_eq!(true_in_time, true, "waited for {expression}; {state}");
    }
}

/// A tab of a browser, by the name of its session.
pub struct Tab(pub String);

/// The address that a browser writes into its profile once it listens.
fn address(file: &Path) -> String {
    let start = Instant::now();
    loop {
        let text = std::fs::read_to_string(file).unwrap_or_default();
        if let Some((port, path)) = text.split_once('\n') {
            return format!("ws://127.0.0.1:{port}{}", path.trim_end());
        }
        assert!(start.elapsed() < LIMIT, "the browser does not start");
        std::thread::sleep(Duration::from_millis(20));
    }
}

pub fn serve(room: &Room, live: &Live) -> Server {
    let address = Address { host: Ipv4Addr::LOCALHOST.into(), port: 0 };
    let about = About { device: gpu().info().name.clone(), spp: 8, roots: vec![room.path("")] };
    Server::start(live, &address, about).unwrap()
}

#[test]
fn the_page_shows_the_render_and_follows_edits() {
    let Some(program) = chromium() else { return };
    let room = Room::new();
    let live = room.live(8);
    let server = serve(&room, &live);
    // Two at once
    let mut browsers = [(); 2].map(|()| {
        let mut browser = Browser::start(program);
        let tab = browser.open(server.url());
        (browser, tab)
    });
    // Both show all samples, and just the pixels of the render
    let shot =
        wait(&live, "8 samples", |state| state.shot.as_ref().is_some_and(|shot| shot.spp == 8)).shot.unwrap();
    for (browser, tab) in &mut browsers {
        browser.wait(tab, "dapple.idle && dapple.shown.spp === 8 && dapple.shown.scale === 1");
        for (x, y) in [(0, 0), (8, 6), (15, 11)] {
            let seen = browser.value(tab, &format!("Array.from(dapple.pixel({x}, {y}))"));
            let right = shot.picture.rgb[y * 16 + x];
            for channel in 0..3 {
                let (seen, right) = (seen[channel].as_f64().unwrap(), f64::from(right[channel]));
                assert!((seen - right).abs() <= 1e-3 * right + 1e-6, "{seen} for {right} at {x}, {y}");
            }
        }
    }
    // A good edit is a new generation in both
    room.edit("scene.toml", "color = 0.2", "color = 0.75");
    for (browser, tab) in &mut browsers {
        browser.wait(tab, "dapple.shown.generation === 2");
        let corner = browser.value(tab, "dapple.pixel(0, 0)[0]").as_f64().unwrap();
        assert!((corner - 0.75).abs() < 1e-3, "{corner}");
    }
    // A bad one shows its place and keeps the picture
    let (browser, tab) = &mut browsers[0];
    room.edit("scene.toml", "radius = 1", "radius = -1");
    let shows = |text: &str| format!("document.body.innerText.includes({text:?})");
    browser.wait(tab, &format!("{} && {}", shows("scene.toml:31"), shows("must be above 0")));
    assert_eq!(browser.value(tab, "dapple.shown.generation"), 2);
    room.edit("scene.toml", "radius = -1", "radius = 1.5");
    browser.wait(tab, "!dapple.state.error && dapple.shown.generation === 3");
    browser.wait(tab, &format!("!{}", shows("must be above 0")));
    check_screen(browser, tab, &server);
}

/// The pixels on the screen against those of the PNG that the server writes.
fn check_screen(browser: &mut Browser, tab: &Tab, server: &Server) {
    browser.wait(tab, "dapple.idle && dapple.state.spp === dapple.state.wanted_spp");
    let png = image::load_from_memory(&super::server::get(server, "/picture.png", "").1).unwrap().to_rgb8();
    let picture = browser.call(Some(&tab.0), "Page.captureScreenshot", &json!({"format": "png"}));
    let bytes = base64::engine::general_purpose::STANDARD.decode(picture["data"].as_str().unwrap()).unwrap();
    let screen = image::load_from_memory(&bytes).unwrap().to_rgb8();
    for (x, y) in [(0, 0), (8, 6), (15, 11), (3, 9)] {
        let place = browser.value(tab, &format!("dapple.place({x}, {y})"));
        let [left, top] = [0, 1].map(|axis| place[axis].as_f64().unwrap() as u32);
        let (seen, right) = (screen.get_pixel(left, top).0, png.get_pixel(x, y).0);
        for (seen, right) in seen.into_iter().zip(right) {
            assert!(seen.abs_diff(right) <= 1, "{seen} on the screen, {right} in the file at {x}, {y}");
        }
    }
}
