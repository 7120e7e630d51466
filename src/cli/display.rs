//! `--display`: the picture as it grows, in a running tev (github.com/Tom94/tev), by its protocol over TCP.

use dapple::film::Picture;
use dapple::scene::Film;
use dapple::{Error, Result};
use std::io;
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tev_client::{PacketCreateImage, PacketUpdateImage, TevClient};

/// Time between two pictures.
const PERIOD: Duration = Duration::from_millis(500);
/// How long a display may take for what it is sent.
const PATIENCE: Duration = Duration::from_secs(10);
/// Side of the tiles in which a picture is sent.
const TILE: usize = 128;

/// The planes of a picture, by the names that viewers of EXR group them by.
const CHANNELS: [&str; 11] =
    ["R", "G", "B", "A", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"];

/// A viewer that is shown a picture, from a thread of its own: one that is slow gets fewer.
pub struct Display {
    pictures: SyncSender<Picture>,
    thread: JoinHandle<io::Result<()>>,
    last: Option<Instant>,
}

impl Display {
    /// Connects to `HOST:PORT` and makes a picture there.
    pub fn connect(address: &str, name: &str, film: &Film) -> Result<Self> {
        let failed = |error: io::Error| {
            Error::output(format!("no display at {address}: {error}"))
                .help("start tev before; it listens at 127.0.0.1:14158, or at what its --hostname says")
        };
        let stream = connect(address).map_err(failed)?;
        stream.set_write_timeout(Some(PATIENCE)).map_err(failed)?;
        let mut viewer = TevClient::wrap(stream);
        let create = PacketCreateImage {
            image_name: name,
            grab_focus: true,
            width: film.width,
            height: film.height,
            channel_names: &CHANNELS,
        };
        viewer.send(create).map_err(failed)?;
        let (pictures, shown) = sync_channel(1);
        let name = name.to_owned();
        let thread = std::thread::spawn(move || send_all(&mut viewer, &name, &shown));
        Ok(Self { pictures, thread, last: None })
    }

    /// Whether it is time for another picture.
    pub fn is_due(&self) -> bool {
        self.last.is_none_or(|last| last.elapsed() >= PERIOD)
    }

    /// Shows a picture, unless the last two are still on their way.
    pub fn show(&mut self, picture: Picture) {
        self.last = Some(Instant::now());
        match self.pictures.try_send(picture) {
            // A display that is gone is told of at the end
            Ok(()) | Err(TrySendError::Full(_) | TrySendError::Disconnected(_)) => {}
        }
    }

    /// Shows the last picture, and waits until it is sent.
    pub fn finish(self, picture: Picture) -> Result<()> {
        let lost = |error: io::Error| Error::output(format!("the display was lost: {error}"));
        // One that is gone ended the thread, which says why
        _ = self.pictures.send(picture);
        drop(self.pictures);
        match self.thread.join() {
            Ok(outcome) => outcome.map_err(lost),
            Err(_) => Err(lost(io::Error::other("its thread broke"))),
        }
    }
}

/// Tries all addresses that the name has.
fn connect(address: &str) -> io::Result<TcpStream> {
    let mut last = io::Error::new(io::ErrorKind::NotFound, "the name has no address");
    for address in address.to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(error) => last = error,
        }
    }
    Err(last)
}

fn send_all(viewer: &mut TevClient, name: &str, pictures: &Receiver<Picture>) -> io::Result<()> {
    for picture in pictures {
        send(viewer, name, &picture)?;
    }
    Ok(())
}

fn send(viewer: &mut TevClient, name: &str, picture: &Picture) -> io::Result<()> {
    let window = picture.frame.window;
    let [columns, rows] = [window.width() as usize, window.height() as usize];
    let offsets: Vec<u64> = (0..CHANNELS.len() as u64).collect();
    let strides = [CHANNELS.len() as u64; CHANNELS.len()];
    for y in (0..rows).step_by(TILE) {
        for x in (0..columns).step_by(TILE) {
            let [width, height] = [TILE.min(columns - x), TILE.min(rows - y)];
            let pixels =
                (y..y + height).flat_map(|row| (x..x + width).map(move |column| row * columns + column));
            let data: Vec<f32> = pixels.flat_map(|pixel| values(picture, pixel)).collect();
            viewer.send(PacketUpdateImage {
                image_name: name,
                grab_focus: false,
                channel_names: &CHANNELS,
                channel_offsets: &offsets,
                channel_strides: &strides,
                x: window.x0 + x as u32,
                y: window.y0 + y as u32,
                width: width as u32,
                height: height as u32,
                data: &data,
            })?;
        }
    }
    Ok(())
}

/// A pixel in the order of [`CHANNELS`].
fn values(picture: &Picture, i: usize) -> [f32; CHANNELS.len()] {
    let ([r, g, b], a) = (picture.rgb[i], picture.alpha[i]);
    let ([ar, ag, ab], [x, y, z]) = (picture.albedo[i], picture.normal[i]);
    [r, g, b, a, ar, ag, ab, x, y, z, picture.depth[i]]
}
