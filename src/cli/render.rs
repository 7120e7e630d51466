//! `dapple render`.

use super::args::{RenderArgs, View};
use super::console::{Console, Step};
use super::display::Display;
use super::event::{Event, Where};
use super::job::Job;
use super::stop::{Reason, Stop};
use super::{Failure, pixel, repeat};
use dapple::Result;
use dapple::film::{self, Film};
use dapple::gpu::{DeviceType, Gpu};
use dapple::render::{Accumulation, Next, Options, Progress, Renderer};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time between two events of progress.
const EVENT_PERIOD: Duration = Duration::from_millis(250);

/// Renders what the arguments say.
pub fn run(args: &RenderArgs, console: &mut Console) -> Result<(), Failure> {
    let stop = Stop::watch(args.time_limit)?;
    let mut job = Job::new(args)?;
    for warning in &job.warnings {
        if console.json() {
            let place = Where::from(&warning.place);
            console.event(&Event::Warning { message: warning.message.clone(), place });
        } else {
            console.note(&format!("warning: {warning}"));
        }
    }
    let mut display = display(args, &job)?;
    let gpu = Arc::new(Gpu::open(&job.device)?);
    let info = gpu.info();
    if info.kind == DeviceType::Cpu {
        console.note(&format!("rendering on the CPU: {}", info.name));
    }
    announce(&job, &gpu, console);
    let scene = std::mem::take(&mut job.scene);
    let options = Options { view: job.view.map(Into::into), ..Options::of(&gpu) };
    let renderer = Renderer::open(gpu.clone(), &mut job.compiler, scene, options)
        .map_err(|error| job.compiler.sources().locate(error))?;
    let start = Instant::now();
    let mut watch = Watch::new(&job, &stop, console);
    let outcome = paint(&renderer, &job, &mut watch, display.as_mut());
    let (sound, reason) = (watch.sound, watch.reason);
    console.clear_bar();
    let film = outcome.map_err(|error| Failure {
        error,
        repeat: Some(repeat::from_sample(job.first_sample.saturating_add(sound.spp))),
    })?;
    deliver(&job, &film, reason, start.elapsed(), console)?;
    if let Some(Err(error)) = display.map(|display| display.finish(film.resolve())) {
        // The picture is written: that nobody could watch is no failure
        console.note(&format!("warning: {error}"));
    }
    Ok(())
}

/// The viewer that is to show the picture as it grows.
fn display(args: &RenderArgs, job: &Job) -> Result<Option<Display>> {
    let name = args.scene.file_stem().unwrap_or_default().to_string_lossy();
    args.display.as_ref().map(|address| Display::connect(address, &name, &job.film)).transpose()
}

fn paint(
    renderer: &Renderer,
    job: &Job,
    watch: &mut Watch<'_>,
    display: Option<&mut Display>,
) -> Result<Film> {
    let Some(display) = display else {
        return renderer.render(job.first_sample, job.spp, &mut |progress| watch.step(progress));
    };
    let mut picture = Accumulation::new(renderer, job.first_sample, job.spp)?;
    let mut stop = false;
    while !(stop && picture.at_pass_end())
        && let Some(progress) = picture.step()?
    {
        stop |= watch.step(&progress) == Next::Stop;
        if display.is_due() {
            display.show(picture.film()?.resolve());
        }
    }
    picture.into_film()
}

fn announce(job: &Job, gpu: &Gpu, console: &mut Console) {
    let (film, info) = (&job.film, gpu.info());
    let window = film.window();
    console.event(&Event::Start {
        device: info.name.clone(),
        driver: info.driver.clone(),
        kind: super::devices::kind_name(info.kind),
        size: [film.width, film.height],
        window: [window.x0, window.y0, window.x1, window.y1],
        spp: job.spp,
        first_sample: job.first_sample,
        seed: job.seed,
        file: job.file(),
    });
}

/// Follows a render and tells it when to stop.
struct Watch<'a> {
    stop: &'a Stop,
    console: &'a mut Console,
    spp: u32,
    /// Samples of the whole work.
    work: f64,
    told: Option<Duration>,
    last: Reached,
    /// What is certainly rendered without an error.
    sound: Reached,
    reason: Option<Reason>,
}

/// How far a render is: samples of each pixel, share of the work.
#[derive(Debug, Clone, Copy, Default)]
struct Reached {
    spp: u32,
    done: f64,
}

impl<'a> Watch<'a> {
    fn new(job: &Job, stop: &'a Stop, console: &'a mut Console) -> Self {
        let spp = job.spp;
        let work = job.film.window().area() as f64 * f64::from(spp);
        let nothing = Reached::default();
        Self { stop, console, spp, work, told: None, last: nothing, sound: nothing, reason: None }
    }

    fn step(&mut self, progress: &Progress) -> Next {
        // The slice of this step was only submitted; the ones before it are known to be done.
        self.sound = self.last;
        self.last = Reached { spp: progress.spp, done: progress.done };
        self.reason = self.reason.or_else(|| self.stop.reason(progress.elapsed));
        self.tell(progress.elapsed);
        if self.reason.is_some() { Next::Stop } else { Next::Continue }
    }

    fn tell(&mut self, elapsed: Duration) {
        let Reached { spp, done } = self.sound;
        let seconds = elapsed.as_secs_f64();
        let samples = done * self.work;
        let rate = samples / seconds.max(1e-9);
        let (left, stopping) = (self.left(elapsed), self.reason.is_some());
        self.console.bar(&Step { spp, of: self.spp, done, rate, left, stopping });
        if self.told.is_none_or(|told| elapsed >= told + EVENT_PERIOD) {
            self.told = Some(elapsed);
            self.console.event(&Event::Progress {
                spp,
                done,
                samples: samples.round() as u64,
                samples_per_second: rate,
                elapsed_s: seconds,
            });
        }
    }

    /// Time to the end of the work or to the time limit, whichever comes first.
    fn left(&self, elapsed: Duration) -> Option<Duration> {
        let factor = (1.0 - self.sound.done).max(0.0) / self.sound.done;
        let work = Duration::try_from_secs_f64(elapsed.as_secs_f64() * factor).ok();
        match (work, self.stop.left(elapsed)) {
            (Some(work), Some(limit)) => Some(work.min(limit)),
            (work, limit) => work.or(limit),
        }
    }
}

/// What came out of a render.
struct Summary {
    spp: u32,
    wanted: u32,
    /// Samples of all pixels, those that were left out among them.
    samples: u64,
    left_out: u64,
    /// The first pixel with samples that were left out.
    left_out_at: Option<[u32; 2]>,
    clamped: u64,
    stopped_by: Option<Reason>,
    seconds: f64,
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
        film::write(file, &picture, &job.film, &film.meta())?;
    }
    if let Some(place) = job.pixel {
        pixel::print(&picture, place, console)?;
    }
    let left_out = film.left_out();
    // The view of them has them in the picture
    let apart = if job.view == Some(View::NonFinite) { 0 } else { left_out };
    let samples = picture.samples.iter().map(|&n| u64::from(n)).sum::<u64>() + apart;
    let wanted = job.spp;
    // A signal during the last pass stops nothing.
    let whole = job.film.window().area() * u64::from(wanted);
    let summary = Summary {
        spp: film.samples_per_pixel(),
        wanted,
        samples,
        left_out,
        left_out_at: film.first_left_out(),
        clamped: film.clamped(),
        stopped_by: reason.filter(|_| samples < whole),
        seconds: took.as_secs_f64(),
    };
    summary.tell(job, console);
    Ok(())
}

impl Summary {
    fn tell(&self, job: &Job, console: &mut Console) {
        let Self { spp, wanted, samples, left_out, left_out_at, clamped, stopped_by, seconds } = *self;
        let file = job.file();
        let repeat = left_out_at.map(|pixel| repeat::of_pixel(pixel, job.first_sample));
        if console.json() {
            console.event(&Event::Done { file, spp, seconds, left_out, clamped, stopped_by, repeat });
            return;
        }
        if let (Some([x, y]), Some(repeat)) = (left_out_at, repeat) {
            let fate = if job.view == Some(View::NonFinite) { "marked" } else { "left out" };
            console.note(&format!(
                "warning: {left_out} of {samples} samples were not finite and are {fate}, the first of them in pixel \
                 {x},{y}\nrepeat with: {repeat}"
            ));
        }
        if clamped > 0 {
            console.note(&format!(
                "warning: {clamped} of {samples} samples were brighter than the film can hold and are clamped"
            ));
        }
        if let Some(reason) = stopped_by {
            console.note(&format!("stopped by {reason} after {spp} of {wanted} samples a pixel"));
        }
        if let Some(file) = file {
            let window = job.film.window();
            let (width, height) = (window.width(), window.height());
            console
                .note(&format!("{file}: {width} x {height} pixels, {spp} samples a pixel, {seconds:.1} s"));
        }
    }
}
