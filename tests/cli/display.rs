//! `dapple render --display`, with a viewer that takes tev's packets apart.

use crate::{Planes, Room};
use std::collections::HashMap;
use std::io::Read;
use std::net::{TcpListener, TcpStream};

/// What a viewer has been sent.
#[derive(Default)]
struct Viewer {
    name: String,
    size: [usize; 2],
    planes: HashMap<String, Vec<f32>>,
    tiles: usize,
}

/// A packet, read from its front.
struct Packet<'a>(&'a [u8]);

impl Packet<'_> {
    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let (front, rest) = self.0.split_at(N);
        self.0 = rest;
        front.try_into().unwrap()
    }

    fn number(&mut self) -> usize {
        u32::from_le_bytes(self.bytes()) as usize
    }

    fn text(&mut self) -> String {
        let end = self.0.iter().position(|&byte| byte == 0).unwrap();
        let text = String::from_utf8(self.0[..end].to_vec()).unwrap();
        self.0 = &self.0[end + 1..];
        text
    }

    fn texts(&mut self) -> Vec<String> {
        (0..self.number()).map(|_| self.text()).collect()
    }

    fn longs(&mut self, count: usize) -> Vec<usize> {
        (0..count).map(|_| u64::from_le_bytes(self.bytes()) as usize).collect()
    }
}

impl Viewer {
    /// Takes all that comes until the connection ends.
    fn watch(mut stream: TcpStream) -> Self {
        let mut viewer = Self::default();
        let mut length = [0; 4];
        while stream.read_exact(&mut length).is_ok() {
            let mut packet = vec![0; u32::from_le_bytes(length) as usize - 4];
            stream.read_exact(&mut packet).unwrap();
            viewer.take(&mut Packet(&packet));
        }
        viewer
    }

    fn take(&mut self, packet: &mut Packet<'_>) {
        let [kind, _grab] = packet.bytes();
        let name = packet.text();
        match kind {
            4 => {
                self.name = name;
                self.size = [packet.number(), packet.number()];
                let empty = vec![f32::NAN; self.size[0] * self.size[1]];
                self.planes = packet.texts().into_iter().map(|name| (name, empty.clone())).collect();
            }
            6 => {
                assert_eq!(name, self.name);
                let names = packet.texts();
                let [x, y, width, height] = [(); 4].map(|()| packet.number());
                let (offsets, strides) = (packet.longs(names.len()), packet.longs(names.len()));
                let data: Vec<f32> =
                    packet.0.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
                for ((name, offset), stride) in names.iter().zip(offsets).zip(strides) {
                    let plane = self.planes.get_mut(name).unwrap();
                    for i in 0..width * height {
                        plane[(y + i / width) * self.size[0] + x + i % width] = data[offset + i * stride];
                    }
                }
                self.tiles += 1;
            }
            other => panic!("packet of type {other}"),
        }
        assert!(kind == 6 || packet.0.is_empty());
    }
}

#[test]
fn a_viewer_gets_the_picture_that_is_written() {
    let room = Room::new();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let viewer = std::thread::spawn(move || Viewer::watch(listener.accept().unwrap().0));
    room.run(&format!("render scene.toml -o a.exr --size 150x20 --display {address}")).code(0);
    let viewer = viewer.join().unwrap();
    assert_eq!((viewer.name.as_str(), viewer.size), ("scene", [150, 20]));
    assert!(viewer.tiles >= 2, "150 pixels are two tiles");
    let exr = Planes::read(&room.path("a.exr"));
    for (shown, written) in
        [("R", "R"), ("B", "B"), ("albedo.G", "albedo.G"), ("normal.Y", "normal.Y"), ("depth.Z", "depth.Z")]
    {
        assert_eq!(viewer.planes[shown], exr.plane(written), "{shown}");
    }
}

#[test]
fn a_display_that_is_not_there_is_an_error_before_the_render() {
    let room = Room::new();
    // A port that was free a moment ago
    let address = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    room.run(&format!("render scene.toml --display {address}")).code(1).err_has("start tev before");
    room.run("render scene.toml --display nowhere").code(1).err_has("no display at nowhere");
    assert_eq!(room.names(), ["scene.toml"]);
}

#[test]
fn a_viewer_that_goes_does_not_stop_the_render() {
    let room = Room::new();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let viewer = std::thread::spawn(move || drop(listener.accept().unwrap()));
    room.run(&format!("render scene.toml -o a.exr --display {address}")).code(0);
    viewer.join().unwrap();
    assert_eq!(Planes::read(&room.path("a.exr")).width, 16);
}
