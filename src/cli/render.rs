//! `dapple render`.

use super::args::RenderArgs;
use super::console::{Console, Step};
use super::job::Job;
use super::stop::{Reason, Stop};
use super::{Failure, pixel, repeat};
use dapple::film::{self, Film};
use dapple::gpu::{DeviceType, Gpu};
use dapple::render::{Next, Options, Progress, Renderer};
use dapple::{Error, Result};
use serde_json::json;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time between two events of progress.
const EVENT_PERIOD: Duration = Duration::from_millis(250);

/// Renders what the arguments say.
pub fn run(args: &RenderArgs, console: &mut Console) -> Result<(), Failure> {
    let stop = Stop::watch(args.time_limit)?;
    let mut job = Job::new(args)?;
    for warning in &job.warnings {
        warn(console, &warning.to_string());
    }
    let gpu = Arc::new(Gpu::open(&job.device)?);
    let info = gpu.info();
    if info.kind == DeviceType::Cpu {
        console.note(&format!("rendering on the CPU: {}", info.name));
    }
    announce(&job, &gpu, console);
    let renderer = Renderer::open(gpu.clone(), &mut job.compiler, &job.scene, Options::of(&gpu))
        .map_err(|error| in_shaders(error, args.shaders.as_deref()))?;
    let start = Instant::now();
    let mut watch = Watch::new(&job, &stop, console);
    let outcome = renderer.render(job.first_sample, job.scene.render.spp, &mut |p| watch.step(p));
    let (sound, reason) = (watch.sound, watch.reason);
    console.clear_bar();
    let film = outcome.map_err(|error| Failure {
        error,
        repeat: Some(repeat::from_sample(job.first_sample.saturating_add(sound))),
    })?;
    deliver(&job, &film, reason, start.elapsed(), console)?;
    Ok(())
}

/// A warning in the voice of the console.
fn warn(console: &mut Console, message: &str) {
    if console.json() {
        console.event(&json!({ "event": "warning", "message": message }));
    } else {
        console.note(&format!("warning: {message}"));
    }
}

fn announce(job: &Job, gpu: &Gpu, console: &mut Console) {
    let (film, info) = (&job.scene.film, gpu.info());
    let window = film.window();
    console.event(&json!({
        "event": "start",
        "device": info.name,
        "driver": info.driver,
        "type": super::devices::kind_name(info.kind),
        "size": [film.width, film.height],
        "window": [window.x0, window.y0, window.x1, window.y1],
        "spp": job.scene.render.spp,
        "first_sample": job.first_sample,
        "seed": job.scene.render.seed,
        "file": job.target.as_ref().map(|file| file.to_string_lossy()),
    }));
}

/// Errors of the user's shaders name files in the folder of `--shaders`: adds the folder where the file is there.
fn in_shaders(mut error: Error, folder: Option<&Path>) -> Error {
    if let (Some(place), Some(folder)) = (&mut error.place, folder) {
        let file = folder.join(&place.file);
        if file.is_file() {
            place.file = file;
        }
    }
    error
}

/// Follows a render and tells it when to stop.
struct Watch<'a> {
    stop: &'a Stop,
    console: &'a mut Console,
    spp: u32,
    /// Samples of the whole work.
    work: f64,
    told: Option<Duration>,
    /// Samples a pixel after the last slice and the one before it.
    last: u32,
    /// Samples a pixel that were certainly rendered without an error.
    sound: u32,
    reason: Option<Reason>,
}

impl<'a> Watch<'a> {
    fn new(job: &Job, stop: &'a Stop, console: &'a mut Console) -> Self {
        let spp = job.scene.render.spp;
        let work = job.scene.film.window().area() as f64 * f64::from(spp);
        Self { stop, console, spp, work, told: None, last: 0, sound: 0, reason: None }
    }

    fn step(&mut self, progress: &Progress) -> Next {
        // The slice of this step was only submitted; the ones before it are known to be done.
        (self.sound, self.last) = (self.last, progress.spp);
        let elapsed = progress.elapsed;
        self.reason = self.reason.or_else(|| self.stop.reason(elapsed));
        let samples = progress.done * self.work;
        let rate = samples / elapsed.as_secs_f64().max(1e-9);
        self.console.bar(&Step {
            spp: progress.spp,
            of: self.spp,
            done: progress.done,
            rate,
            left: self.left(progress),
            stopping: self.reason.is_some(),
        });
        if self.told.is_none_or(|told| elapsed >= told + EVENT_PERIOD) || progress.spp == self.spp {
            self.told = Some(elapsed);
            self.console.event(&json!({
                "event": "progress",
                "spp": progress.spp,
                "done": progress.done,
                "samples": samples.round() as u64,
                "samples_per_second": rate,
                "elapsed_s": elapsed.as_secs_f64(),
            }));
        }
        if self.reason.is_some() { Next::Stop } else { Next::Continue }
    }

    /// Time to the end of the work or to the time limit, whichever comes first.
    fn left(&self, progress: &Progress) -> Option<Duration> {
        let factor = (1.0 - progress.done).max(0.0) / progress.done;
        let work = Duration::try_from_secs_f64(progress.elapsed.as_secs_f64() * factor).ok();
        match (work, self.stop.left(progress.elapsed)) {
            (Some(work), Some(limit)) => Some(work.min(limit)),
            (work, limit) => work.or(limit),
        }
    }
}

/// Writes the picture, prints the pixel, and says what was done.
fn deliver(
    job: &Job,
    film: &Film,
    reason: Option<Reason>,
    took: Duration,
    console: &mut Console,
) -> Result<()> {
    let picture = film.resolve();
    if let Some(file) = &job.target {
        film::write(file, &picture, &job.scene.film, &film.meta())?;
    }
    if let Some(place) = job.pixel {
        pixel::print(&picture, place, console)?;
    }
    let (spp, wanted) = (film.samples_per_pixel(), job.scene.render.spp);
    let (left_out, clamped) = (film.left_out(), film.clamped());
    // A sample that was left out was rendered all the same.
    let reason = reason.filter(|_| spp < wanted && left_out == 0);
    console.event(&json!({
        "event": "done",
        "file": job.target.as_ref().map(|file| file.to_string_lossy()),
        "spp": spp,
        "seconds": took.as_secs_f64(),
        "left_out": left_out,
        "clamped": clamped,
        "stopped_by": reason,
    }));
    if console.json() {
        return Ok(());
    }
    let all = picture.samples.iter().map(|&n| u64::from(n)).sum::<u64>() + left_out;
    if left_out > 0 {
        warn(console, &format!("{left_out} of {all} samples were not finite and are left out"));
    }
    if clamped > 0 {
        warn(
            console,
            &format!("{clamped} of {all} samples were brighter than the film can hold and are clamped"),
        );
    }
    if let Some(reason) = reason {
        console.note(&format!("stopped by {reason} after {spp} of {wanted} samples a pixel"));
    }
    if let Some(file) = &job.target {
        let window = job.scene.film.window();
        console.note(&format!(
            "{}: {} x {} pixels, {spp} samples a pixel, {:.1} s",
            file.display(),
            window.width(),
            window.height(),
            took.as_secs_f64()
        ));
    }
    Ok(())
}
