//! What page and server say to each other, as JSON with one key: the name of the message.

use crate::live::{Generation, Picks, Shot, State};
use crate::scene::{Camera, ToneCurve};
use crate::{Error, film};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// From the page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Said {
    /// Send a picture, as soon as there is a newer one.
    Frame(Want),
    /// Send the values of a pixel: column, and row from the top.
    Probe([u32; 2]),
    /// Look from elsewhere, or from where the scene says.
    Look(Option<Stand>),
    /// Focus on what is in a pixel.
    Focus([u32; 2]),
}

/// The picture that the page wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub(super) struct Want {
    pub aov: Aov,
    pub which: Which,
    /// It has those up to this number.
    pub after: u64,
    /// Side of the squares of pixels that become one.
    pub scale: u8,
}

/// A plane of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Aov {
    Color,
    Albedo,
    Normal,
    Depth,
    Alpha,
    Variance,
}

/// The picture as it grows, or the last one of the generation before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Which {
    Now,
    Before,
}

/// Where a camera is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Stand {
    pub position: [f32; 3],
    pub target: [f32; 3],
    pub up: [f32; 3],
}

/// What is in front of a picture in a binary message.
#[derive(Debug, Serialize)]
pub(super) struct FrameHead {
    pub serial: u64,
    pub generation: u64,
    pub spp: u32,
    pub width: usize,
    pub height: usize,
    pub scale: u8,
    pub aov: Aov,
    pub which: Which,
    pub channels: usize,
    pub bytes: usize,
}

/// To the page.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Saying {
    State(Box<Now>),
    Probe(Probe),
    Failed(&'static str),
}

/// What there is to know of the state.
#[derive(Debug, Default, Serialize)]
pub(super) struct Now {
    attempts: u64,
    generation: u64,
    spp: u32,
    wanted_spp: u32,
    rate: f64,
    device: String,
    size: [u32; 2],
    window: [u32; 4],
    gain: f64,
    tone_curve: &'static str,
    transparent: bool,
    camera: Option<View>,
    latency: Option<f64>,
    times: Option<Times>,
    warnings: Vec<Doubt>,
    error: Option<Wrong>,
    serial: u64,
    serial_before: u64,
}

#[derive(Debug, Serialize)]
struct View {
    #[serde(flatten)]
    stand: Stand,
    moved: bool,
    lens: bool,
}

#[derive(Debug, Serialize)]
struct Times {
    read: f64,
    prepare: f64,
    compile: f64,
    driver: f64,
    upload: f64,
}

#[derive(Debug, Serialize)]
struct Doubt {
    place: String,
    message: String,
}

#[derive(Debug, Serialize)]
struct Wrong {
    message: String,
    help: Option<String>,
    file: String,
    line: u32,
    column: u32,
    excerpt: Vec<(u32, String)>,
}

/// The values of a pixel.
#[derive(Debug, Serialize)]
pub(super) struct Probe {
    x: u32,
    y: u32,
    rgb: [f32; 3],
    alpha: f32,
    albedo: [f32; 3],
    normal: [f32; 3],
    depth: Option<f32>,
    samples: u32,
    /// Names, once they are known.
    object: Option<String>,
    material: Option<String>,
}

impl Now {
    pub fn of(state: &State, device: &str, wanted_spp: u32, roots: &[PathBuf]) -> Self {
        let mut now = Self {
            attempts: state.attempts,
            wanted_spp,
            device: device.to_owned(),
            error: state.error.as_ref().map(|error| Wrong::of(error, roots)),
            latency: state.latency,
            serial_before: state.before.as_ref().map_or(0, |shot| shot.serial),
            ..Self::default()
        };
        if let Some(generation) = &state.generation {
            now.know(generation, state.moved);
        }
        if let Some(shot) = &state.shot {
            now.see(shot);
        }
        now
    }

    fn know(&mut self, generation: &Generation, moved: bool) {
        let film = &generation.film;
        let window = film.window();
        self.generation = generation.number;
        self.size = [film.width, film.height];
        self.window = [window.x0, window.y0, window.x1, window.y1];
        self.transparent = film.transparent;
        self.tone_curve = match film.tone_curve {
            ToneCurve::Srgb => "srgb",
            ToneCurve::Linear => "linear",
            ToneCurve::Aces => "aces",
            ToneCurve::Agx => "agx",
        };
        let camera = &generation.camera;
        self.camera = Some(View { stand: Stand::of(camera), moved, lens: camera.thin_lens().is_some() });
        let opened = &generation.opened;
        self.times = Some(Times {
            read: generation.read_seconds,
            prepare: opened.displace_seconds + opened.prepare_seconds,
            compile: opened.compile_seconds,
            driver: opened.driver_seconds,
            upload: opened.upload_seconds,
        });
        let doubt = |warning: &crate::import::Warning| Doubt {
            place: warning.place.to_string(),
            message: warning.message.clone(),
        };
        self.warnings = generation.warnings.iter().map(doubt).collect();
    }

    fn see(&mut self, shot: &Shot) {
        (self.serial, self.spp, self.rate) = (shot.serial, shot.spp, shot.rate);
        self.gain = film::gain(&shot.picture, &shot.generation.film);
        if let Some(times) = &mut self.times {
            times.driver += shot.warm_seconds;
        }
    }
}

impl Stand {
    fn of(camera: &Camera) -> Self {
        Self { position: camera.position.into(), target: camera.target.into(), up: camera.up.into() }
    }
}

impl Wrong {
    fn of(error: &Error, roots: &[PathBuf]) -> Self {
        let place = error.place.clone();
        let (file, line, column) = place.map_or_else(Default::default, |p| (p.file, p.line, p.column));
        Self {
            message: error.message.clone(),
            help: error.help.clone(),
            excerpt: super::excerpt::around(&file, line, roots),
            file: file.display().to_string(),
            line,
            column,
        }
    }
}

impl Probe {
    /// None outside of what is rendered.
    pub fn of(shot: &Shot, [x, y]: [u32; 2]) -> Option<Self> {
        let picture = &shot.picture;
        let i = picture.frame.window.index(x, y)?;
        Some(Self {
            x,
            y,
            rgb: picture.rgb[i],
            alpha: picture.alpha[i],
            albedo: picture.albedo[i],
            normal: picture.normal[i],
            depth: Some(picture.depth[i]).filter(|depth| depth.is_finite()),
            samples: picture.samples[i],
            object: None,
            material: None,
        })
    }

    /// With what is there, by name.
    pub fn named(self, picks: &Picks) -> Self {
        let [object, material] = picks.at([self.x, self.y]).map(|name| name.map(str::to_owned));
        Self { object, material, ..self }
    }

    pub fn depth(&self) -> Option<f32> {
        self.depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_the_page_are_understood() {
        let read = |text: &str| serde_json::from_str::<Said>(text).unwrap();
        assert_eq!(read(r#"{"probe": [3, 4]}"#), Said::Probe([3, 4]));
        assert_eq!(read(r#"{"look": null}"#), Said::Look(None));
        let stand = Stand { position: [1.0, 2.0, 3.0], target: [0.0; 3], up: [0.0, 1.0, 0.0] };
        let text = r#"{"look": {"position": [1, 2, 3], "target": [0, 0, 0], "up": [0, 1, 0]}}"#;
        assert_eq!(read(text), Said::Look(Some(stand)));
        let want = Want { aov: Aov::Albedo, which: Which::Before, after: 7, scale: 2 };
        let text = r#"{"frame": {"aov": "albedo", "which": "before", "after": 7, "scale": 2}}"#;
        assert_eq!(read(text), Said::Frame(want));
        for wrong in ["", "[]", "{}", r#"{"quit": 1}"#, r#"{"probe": [1]}"#, r#"{"probe": [-1, 2]}"#] {
            assert!(serde_json::from_str::<Said>(wrong).is_err(), "{wrong}");
        }
    }
}
