//! `dapple live`.

use super::args::LiveArgs;
use super::console::Console;
use super::event::{Event, Where};
use super::job;
use super::stop::Stop;
use dapple::gpu::{DeviceChoice, DeviceType, Gpu, validation_from_environment};
use dapple::live::{About, Address, Live, Request, Server, Shot, State};
use dapple::shader::CacheOptions;
use dapple::{Error, Result};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// How long a Ctrl-C may wait.
const PATIENCE: Duration = Duration::from_millis(100);

/// Shows a scene until it is told to stop.
pub fn run(args: &LiveArgs, console: &mut Console) -> Result<()> {
    let stop = Stop::watch(None)?;
    let gpu = Arc::new(Gpu::open(&DeviceChoice {
        wanted: args.device.clone(),
        require_gpu: args.require_gpu,
        validation: validation_from_environment(),
    })?);
    if gpu.info().kind == DeviceType::Cpu {
        console.note(&format!("rendering on the CPU: {}", gpu.info().name));
    }
    let device = gpu.info().name.clone();
    let live = Live::start(gpu, request(args), args.spp)?;
    let server = if args.no_page { None } else { Some(serve(&live, args, device, console)?) };
    let mut told = Told::default();
    while stop.reason(Duration::ZERO).is_none() {
        let state = live.show().wait(PATIENCE, |state| told.is_behind(state));
        told.tell(&state, console);
    }
    drop(server);
    Ok(())
}

fn serve(live: &Live, args: &LiveArgs, device: String, console: &mut Console) -> Result<Server> {
    let folder = match args.scene.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let roots = std::iter::once(folder.to_path_buf()).chain(args.shaders.clone()).collect();
    let address = Address { host: args.host, port: args.port };
    let server = Server::start(live, &address, About { device, spp: args.spp, roots })?;
    let url = server.url();
    if console.json() {
        console.event(&Event::Serving { url: url.to_owned() });
    } else {
        console.result(url);
    }
    if args.open
        && let Err(error) = open::that_detached(url)
    {
        console.note(&format!("no browser could be opened: {error}; go to {url}"));
    }
    Ok(server)
}

fn request(args: &LiveArgs) -> Request {
    let (size, strict) = (args.size, args.read.strict);
    Request {
        scene: args.scene.clone(),
        overrides: args.read.set.clone(),
        choice: args.read.model.choice(),
        shaders: args.shaders.clone(),
        cache: CacheOptions::from_environment(),
        adjust: Box::new(move |scene, warnings| {
            job::strictly(strict, warnings)?;
            job::set_window(&mut scene.film, size, None, None)
        }),
    }
}

/// What was said so far.
#[derive(Default)]
struct Told {
    attempts: u64,
    generation: u64,
}

impl Told {
    fn is_behind(&self, state: &State) -> bool {
        state.attempts != self.attempts
            || state.shot.as_ref().is_some_and(|shot| shot.generation.number != self.generation)
    }

    fn tell(&mut self, state: &State, console: &mut Console) {
        if state.attempts != self.attempts {
            self.attempts = state.attempts;
            if let Some(error) = &state.error {
                tell_error(error, console);
            }
        }
        if let Some(shot) = &state.shot
            && shot.generation.number != self.generation
        {
            self.generation = shot.generation.number;
            tell_generation(shot, state.latency, console);
        }
    }
}

fn tell_error(error: &Error, console: &mut Console) {
    if console.json() {
        return console.event(&Event::Error {
            message: error.message.clone(),
            help: error.help.clone(),
            place: error.place.as_ref().map(Where::from),
            repeat: None,
        });
    }
    let place = error.place.as_ref().map_or_else(String::new, |place| format!("{place}: "));
    let help = error.help.as_ref().map_or_else(String::new, |help| format!("; {help}"));
    console.result(&format!("{place}error: {}{help}", error.message));
}

fn tell_generation(shot: &Shot, latency: Option<f64>, console: &mut Console) {
    let generation = &shot.generation;
    for warning in &generation.warnings {
        if console.json() {
            console.event(&Event::Warning {
                message: warning.message.clone(),
                place: Where::from(&warning.place),
            });
        } else {
            console.result(&format!("{}: warning: {}", warning.place, warning.message));
        }
    }
    let (number, opened) = (generation.number, &generation.opened);
    let driver_s = opened.driver_seconds + shot.warm_seconds;
    if console.json() {
        return console.event(&Event::Generation {
            number,
            latency_s: latency,
            read_s: generation.read_seconds,
            prepare_s: opened.displace_seconds + opened.prepare_seconds,
            compile_s: opened.compile_seconds,
            driver_s,
            upload_s: opened.upload_seconds,
            displaced: opened.displaced,
            trees: opened.trees,
            kernels: opened.kernels,
            bytes: opened.bytes,
        });
    }
    let ms = |seconds: f64| format!("{:.0} ms", 1e3 * seconds);
    let after = latency.map_or_else(String::new, |latency| format!(" seen after {}", ms(latency)));
    console.result(&format!(
        "generation {number}{after}: read {}, prepared {}, kernels {} and {} in the driver, sent {}",
        ms(generation.read_seconds),
        ms(opened.displace_seconds + opened.prepare_seconds),
        ms(opened.compile_seconds),
        ms(driver_s),
        ms(opened.upload_seconds),
    ));
}
