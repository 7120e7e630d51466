//! What `--json` prints, one object a line.

use super::stop::Reason;
use dapple::Place;
use serde::Serialize;

/// The events, told apart by the key `event`. Numbers that JSON cannot hold (an infinite depth) are null.
#[derive(Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// The device is open and the scene is read.
    Start {
        device: String,
        driver: String,
        #[serde(rename = "type")]
        kind: &'static str,
        /// Columns and rows of the whole picture.
        size: [u32; 2],
        /// The pixels that are rendered: x0, y0, x1, y1.
        window: [u32; 4],
        spp: u32,
        first_sample: u32,
        seed: u32,
        file: Option<String>,
    },
    /// Something doubtful in the scene.
    Warning { message: String, place: Where },
    /// What is known to be rendered; several times a second at most.
    Progress {
        /// Samples that every pixel has.
        spp: u32,
        /// Share of the work, 0..=1.
        done: f64,
        samples: u64,
        samples_per_second: f64,
        elapsed_s: f64,
    },
    /// The values of `--pixel`.
    Pixel {
        x: u32,
        y: u32,
        rgb: [f32; 3],
        alpha: f32,
        albedo: [f32; 3],
        normal: [f32; 3],
        depth: Option<f32>,
        variance: [f32; 3],
        samples: u32,
    },
    /// The picture is written.
    Done {
        file: Option<String>,
        spp: u32,
        seconds: f64,
        /// Samples that were not finite.
        left_out: u64,
        /// Samples that were brighter than the film can hold.
        clamped: u64,
        /// Why the render ended before all samples were done.
        stopped_by: Option<Reason>,
        /// The command that renders the first pixel again that had a sample that was not finite.
        repeat: Option<String>,
    },
    /// The page of `dapple live` is there.
    Serving { url: String },
    /// The first pixels of an edited scene are there.
    Generation {
        number: u64,
        /// Since the edit; none when there was none.
        latency_s: Option<f64>,
        read_s: f64,
        prepare_s: f64,
        /// Of GLSL.
        compile_s: f64,
        /// Of the driver.
        driver_s: f64,
        upload_s: f64,
        /// Displaced meshes that were cut, trees that were built, kernels that were compiled, and bytes that were sent to the device.
        displaced: u32,
        trees: u32,
        kernels: u32,
        bytes: u64,
    },
    /// A texture is baked.
    Baked {
        files: Vec<String>,
        /// Columns and rows of each.
        size: [u32; 2],
        /// Least and greatest of red, green and blue, before `--range`.
        least: [f32; 3],
        greatest: [f32; 3],
        /// Texels with a colour that a PNG cannot hold.
        clamped: u64,
        /// Texels that were not finite.
        not_finite: u64,
        seconds: f64,
    },
    /// Something wrong or doubtful in a shader.
    Problem {
        /// `error` or `warning`.
        severity: &'static str,
        file: String,
        line: u32,
        column: u32,
        message: String,
        help: Option<String>,
        /// A kernel in which it is, with its switches.
        kernel: Option<String>,
    },
    /// Shaders are checked.
    Checked { kernels: usize, variants: usize, errors: usize, warnings: usize, seconds: f64 },
    /// The end, with exit code 1 or 2.
    Error {
        message: String,
        help: Option<String>,
        place: Option<Where>,
        /// The command that shows the failure again.
        repeat: Option<String>,
    },
}

/// A place in a file; 0 = unknown.
#[derive(Debug, Serialize)]
pub struct Where {
    file: String,
    line: u32,
    column: u32,
}

impl From<&Place> for Where {
    fn from(place: &Place) -> Self {
        let file = place.file.to_string_lossy().into_owned();
        Self { file, line: place.line, column: place.column }
    }
}
