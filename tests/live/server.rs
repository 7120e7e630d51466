//! The server of the page, as a program sees it that talks to it.

use super::{Room, gpu, wait, wait_for};
use dapple::live::{About, Address, Live, Server};
use flate2::read::ZlibDecoder;
use half::f16;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpStream};
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

fn serve(room: &Room, live: &Live) -> Server {
    let address = Address { host: Ipv4Addr::LOCALHOST.into(), port: 0 };
    let about = About { device: gpu().info().name.clone(), spp: 8, roots: vec![room.path("")] };
    Server::start(live, &address, about).unwrap()
}

fn host(server: &Server) -> &str {
    server.url().trim_start_matches("http://").split('/').next().unwrap()
}

/// The status and the body of the answer to a request that is sent as it is.
pub fn get(server: &Server, path: &str, headers: &str) -> (u16, Vec<u8>) {
    let host = host(server);
    let mut stream = TcpStream::connect(host).unwrap();
    let own = if headers.contains("Host:") { String::new() } else { format!("Host: {host}\r\n") };
    write!(stream, "GET {path} HTTP/1.1\r\n{own}{headers}Connection: close\r\n\r\n").unwrap();
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).unwrap();
    let head = answer.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
    let status = String::from_utf8_lossy(&answer[9..12]).parse().unwrap();
    (status, answer[head + 4..].to_vec())
}

/// A page.
struct Page(WebSocket<TcpStream>);

/// A picture that a page got.
struct Frame {
    head: Value,
    planes: Vec<Vec<u8>>,
}

impl Page {
    fn open(server: &Server) -> Self {
        let stream = TcpStream::connect(host(server)).unwrap();
        stream.set_read_timeout(Some(super::LIMIT)).unwrap();
        let request = format!("ws://{}/socket", host(server)).into_client_request().unwrap();
        Self(tungstenite::client(request, stream).unwrap().0)
    }

    fn say(&mut self, message: &Value) {
        self.0.send(Message::text(message.to_string())).unwrap();
    }

    /// The next message with this key.
    fn hear(&mut self, key: &str) -> Value {
        loop {
            if let Message::Text(text) = self.0.read().unwrap()
                && let Some(value) = serde_json::from_str::<Value>(&text).unwrap().get(key)
            {
                return value.clone();
            }
        }
    }

    fn frame(&mut self, aov: &str, after: u64, scale: u32) -> Frame {
        self.say(&json!({"frame": {"aov": aov, "which": "now", "after": after, "scale": scale}}));
        loop {
            if let Message::Binary(bytes) = self.0.read().unwrap() {
                let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                let head: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
                let mut body = Vec::new();
                ZlibDecoder::new(&bytes[4 + length..]).read_to_end(&mut body).unwrap();
                let pixels = (head["width"].as_u64().unwrap() * head["height"].as_u64().unwrap()) as usize;
                let planes: Vec<_> = body.chunks(pixels).map(<[u8]>::to_vec).collect();
                let parts = head["channels"].as_u64().unwrap() * head["bytes"].as_u64().unwrap();
                assert_eq!(planes.len() as u64, parts);
                return Frame { head, planes };
            }
        }
    }
}

impl Frame {
    /// A channel of a pixel of halves.
    fn half(&self, channel: usize, pixel: usize) -> f32 {
        f16::from_le_bytes([self.planes[2 * channel][pixel], self.planes[2 * channel + 1][pixel]]).to_f32()
    }

    fn serial(&self) -> u64 {
        self.head["serial"].as_u64().unwrap()
    }
}

/// A scene whose picture is done.
fn done(room: &Room) -> Live {
    let live = room.live(8);
    wait(&live, "8 samples", |state| state.shot.as_ref().is_some_and(|shot| shot.spp == 8));
    live
}

#[test]
fn a_page_gets_the_pixels_of_the_render() {
    let room = Room::new();
    let live = done(&room);
    let server = serve(&room, &live);
    let shot = live.show().state().shot.unwrap();
    let picture = &shot.picture;
    // Two at once
    let [mut one, mut two] = [(); 2].map(|()| Page::open(&server));
    for (page, aov, list) in [(&mut one, "color", &picture.rgb), (&mut two, "normal", &picture.normal)] {
        let frame = page.frame(aov, 0, 1);
        assert_eq!((frame.head["spp"].as_u64(), frame.head["width"].as_u64()), (Some(8), Some(16)));
        for (i, value) in list.iter().enumerate() {
            for channel in 0..3 {
                let seen = frame.half(channel, i);
                assert!(
                    (seen - value[channel]).abs() <= 5e-4 * value[channel].abs() + 1e-6,
                    "{seen} of {value:?}"
                );
            }
        }
    }
    let depth = one.frame("depth", 0, 1);
    let of = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|byte| depth.planes[byte][i]));
    assert!((0..16 * 12).all(|i| of(i) == picture.depth[i]));
    let small = one.frame("color", 0, 4);
    assert_eq!((small.head["width"].as_u64(), small.head["height"].as_u64()), (Some(4), Some(3)));
    one.say(&json!({"probe": [8, 6]}));
    let probe = one.hear("probe");
    assert_eq!(probe["samples"], 8);
    assert_eq!(probe["rgb"][0].as_f64().unwrap() as f32, picture.rgb[6 * 16 + 8][0]);
    // What is there has a name, once it was asked for
    let picked = wait(&live, "picks", |state| state.picks.is_some()).picks.unwrap();
    assert_eq!(picked.generation, 1);
    let mut named = |x: u32, y: u32| {
        one.say(&json!({"probe": [x, y]}));
        let probe = one.hear("probe");
        [probe["object"].clone(), probe["material"].clone()]
    };
    assert_eq!(named(8, 2), ["shape 1", "clay"]);
    let seen: Vec<_> = (0..12).flat_map(|y| (0..16).map(move |x| (x, y))).map(|(x, y)| named(x, y)).collect();
    for (names, alpha) in [([json!("instance 1"), json!("papered")], 1.0), ([Value::Null, Value::Null], 0.0)]
    {
        let of = |alpha: f32| picture.alpha.iter().zip(&seen).filter(move |(a, _)| **a == alpha);
        assert!(of(alpha).any(|(_, seen)| *seen == names), "{names:?}");
        let others = [json!("shape 1"), json!("clay")];
        assert!(of(alpha).all(|(_, seen)| *seen == names || alpha > 0.0 && *seen == others), "{seen:?}");
    }
    one.say(&json!({"probe": [16, 0]}));
    assert_eq!(one.hear("failed"), "there is no such pixel");
    one.say(&json!({"shut": "down"}));
    assert_eq!(one.hear("failed"), "this is no message of the page");
    let (status, png) = get(&server, "/picture.png", "");
    assert_eq!((status, &png[1..4]), (200, b"PNG".as_slice()));
    let (status, exr) = get(&server, "/picture.exr", "");
    assert_eq!((status, &exr[..4]), (200, [0x76, 0x2f, 0x31, 0x01].as_slice()));
}

#[test]
fn a_page_hears_of_edits_and_errors() {
    let room = Room::new();
    let live = done(&room);
    let server = serve(&room, &live);
    let mut page = Page::open(&server);
    let until = |page: &mut Page, wanted: &dyn Fn(&Value) -> bool| {
        loop {
            let state = page.hear("state");
            if wanted(&state) {
                return state;
            }
        }
    };
    let first = until(&mut page, &|state| state["generation"] == 1);
    assert!(first["error"].is_null() && first["latency"].is_null());
    let before = page.frame("color", 0, 1);
    // What is asked for is sent when it is there
    room.edit("scene.toml", "color = 0.2", "color = 0.9");
    let after = page.frame("color", before.serial(), 1);
    assert_eq!(after.head["generation"], 2);
    assert!((after.half(0, 0) - 0.9).abs() < 1e-3);
    room.edit("scene.toml", "radius = 1", "radius = -1");
    let bad = until(&mut page, &|state| !state["error"].is_null());
    assert_eq!((&bad["error"]["line"], &bad["generation"]), (&json!(31), &json!(2)));
    let excerpt = bad["error"]["excerpt"].as_array().unwrap();
    assert!(excerpt.contains(&json!([31, "radius = -1"])), "{excerpt:?}");
    page.say(&json!({"look": {"position": [1, 1, 5], "target": [0, 0, 0], "up": [0, 1, 0]}}));
    room.edit("scene.toml", "radius = -1", "radius = 1");
    let moved = until(&mut page, &|state| state["error"].is_null() && state["camera"]["moved"] == true);
    assert!(moved["latency"].as_f64().unwrap() > 0.0);
    page.say(&json!({"look": {"position": [1, 1, 5], "target": [1, 1, 5], "up": [0, 1, 0]}}));
    assert_eq!(page.hear("failed"), "a camera cannot stand so");
}

#[test]
fn a_page_that_stops_reading_slows_nobody() {
    let room = Room::new();
    let live = room.live(1 << 20);
    wait_for(&live, 1);
    let server = serve(&room, &live);
    let mut slow = Page::open(&server);
    // Far more than any buffer on the way holds, and nothing is read
    for _ in 0..5000 {
        slow.say(&json!({"probe": [1, 1]}));
    }
    let mut page = Page::open(&server);
    let mut serial = 0;
    let start = Instant::now();
    for _ in 0..5 {
        serial = page.frame("color", serial, 1).serial();
    }
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    let samples = |live: &Live| live.show().state().shot.unwrap().spp;
    let before = samples(&live);
    wait(&live, "more samples", |state| state.shot.as_ref().is_some_and(|shot| shot.spp > before + 8));
    // One that vanishes without a word
    drop(slow);
    page.frame("color", serial, 1);
}

#[test]
fn others_are_refused() {
    let room = Room::new();
    let live = done(&room);
    let server = serve(&room, &live);
    let status = |path: &str, headers: &str| get(&server, path, headers).0;
    assert_eq!(status("/", ""), 200);
    let own = format!("Origin: http://{}\r\n", host(&server));
    assert_eq!(status("/", &own), 200);
    let upgrade = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";
    for path in ["/", "/socket", "/picture.png"] {
        assert_eq!(status(path, &format!("Origin: http://evil.example\r\n{upgrade}")), 403, "{path}");
        assert_eq!(status(path, "Host: evil.example\r\n"), 403, "{path}");
    }
    // Nothing but the files of the page
    for path in [
        "/../scene.toml",
        "/scene.toml",
        "/..%2fscene.toml",
        "/%2e%2e/scene.toml",
        "//etc/passwd",
        "/page/../../mod.rs",
    ] {
        assert!(matches!(status(path, ""), 400 | 404), "{path}");
    }
    // Open to all, it wants its token
    let any = Address { host: IpAddr::V4(Ipv4Addr::UNSPECIFIED), port: 0 };
    let open =
        Server::start(&live, &any, About { device: String::new(), spp: 1, roots: Vec::new() }).unwrap();
    let (address, query) = open.url().trim_start_matches("http://").split_once('/').unwrap();
    let port = address.parse::<SocketAddr>().unwrap().port();
    let status = |path: &str| {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: studio:{port}\r\nConnection: close\r\n\r\n").unwrap();
        let mut answer = [0; 12];
        stream.read_exact(&mut answer).unwrap();
        String::from_utf8_lossy(&answer[9..]).parse::<u16>().unwrap()
    };
    assert_eq!(status("/"), 403);
    assert_eq!(status("/picture.png?token=0"), 403);
    assert_eq!(status("/socket"), 403);
    assert_eq!(status("/page.js"), 200);
    assert_eq!(status(&format!("/{query}")), 200);
    assert_eq!(status(&format!("/picture.png{query}")), 200);
}
