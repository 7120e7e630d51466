//! `dapple bench`: how fast this machine is, on scenes made from formulas or on a scene of the user's.

mod blob;
mod child;
mod memory;
mod scenes;
mod table;
mod write;

use super::args::{BenchArgs, Fetch};
use super::console::Console;
use child::{Caches, Task};
use dapple::gpu::{DeviceChoice, Gpu, validation_from_environment};
use dapple::import::read_scene;
use dapple::layout::{Backend, TILE};
use dapple::prepare::{self, Stage};
use dapple::render::{Kernels, Measured, Next, Options, Renderer};
use dapple::scene::{Rect, Scene};
use dapple::shader::{CacheOptions, Compiler, Sources};
use dapple::{Error, Result};
use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;

/// What was measured on one scene. Times in seconds, rates in millions a second.
#[derive(Debug, Serialize)]
struct Row {
    scene: String,
    spp: u32,
    triangles: usize,
    mean_radiance: f64,
    msamples_per_second: f64,
    camera_mrays_per_second: f64,
    bounce_mrays_per_second: f64,
    shadow_mrays_per_second: f64,
    stage_seconds: Vec<(&'static str, f64)>,
    bvh_mtriangles_per_second: f64,
    /// None for trees that were built balanced, or without triangles.
    bvh_sah_cost: Option<f32>,
    /// From GLSL until each kernel has run once, with empty caches and with filled ones, the driver's among them.
    compile_cold_seconds: f64,
    compile_warm_seconds: f64,
    /// From the start of the command to the end of the first slice, with filled caches.
    first_slice_seconds: f64,
    device_bytes: u64,
    peak_memory_bytes: Option<u64>,
}

/// All that was measured.
#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    device: String,
    driver: String,
    fetch: String,
    rows: Vec<Row>,
}

/// What all measurements of a command have in common.
struct Bench<'a> {
    args: &'a BenchArgs,
    gpu: Arc<Gpu>,
    options: Options,
}

/// Measures, and prints a table or one JSON object.
pub fn run(args: &BenchArgs, console: &mut Console) -> Result<()> {
    let start = Instant::now();
    if let Some(folder) = &args.write_scene {
        return write::write(folder);
    }
    let bench = Bench::open(args)?;
    if let Some((task, name)) = child::own_task() {
        let seconds = match task {
            Task::Kernels => bench.kernel_seconds(scene_of(args, &name)?)?,
            Task::FirstSlice => bench.first_slice_seconds(scene_of(args, &name)?, start)?,
        };
        console.result(&seconds.to_string());
        return Ok(());
    }
    let mut rows = Vec::new();
    match &args.scene {
        Some(path) => rows.push(bench.measure(&path.display().to_string())?),
        None => {
            for (name, _) in scenes::ALL {
                console.note(&format!("measuring {name}"));
                rows.push(bench.measure(name)?);
            }
        }
    }
    let info = bench.gpu.info();
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        device: info.name.clone(),
        driver: info.driver.clone(),
        fetch: format!("{:?}", bench.options.backend).to_lowercase(),
        rows,
    };
    if args.json {
        let text = serde_json::to_string(&report)
            .map_err(|error| Error::output(format!("cannot write the measurements as JSON: {error}")))?;
        console.result(&text);
    } else {
        console.result(&table::text(&report));
    }
    Ok(())
}

/// The scene of the user, or the built-in one of a name.
fn scene_of(args: &BenchArgs, name: &str) -> Result<Scene> {
    if let Some(path) = &args.scene {
        return Ok(read_scene(path, &[])?.0);
    }
    let make = scenes::ALL.iter().find(|(known, _)| *known == name);
    make.map(|(_, make)| make()).ok_or_else(|| Error::scene(format!("no built-in scene is called `{name}`")))
}

impl<'a> Bench<'a> {
    fn open(args: &'a BenchArgs) -> Result<Self> {
        let choice = DeviceChoice {
            wanted: args.device.clone(),
            require_gpu: args.require_gpu,
            validation: validation_from_environment(),
        };
        let gpu = Arc::new(Gpu::open(&choice)?);
        let of_device = Options::of(&gpu);
        let backend = match args.fetch {
            Some(Fetch::Texel) => Backend::Texel,
            Some(Fetch::Storage) => Backend::Storage,
            None => of_device.backend,
        };
        Ok(Self { args, gpu, options: Options { backend, ..of_device } })
    }

    fn compiler(&self) -> Result<Compiler> {
        let sources = match &self.args.shaders {
            Some(folder) => Sources::folder(folder)?,
            None => Sources::embedded(),
        };
        Ok(Compiler::new(sources, CacheOptions::from_environment()))
    }

    /// Seconds from GLSL until every kernel of the wave has run once, on one tile in the middle: some drivers compile only
    /// then. Putting the scene on the device is not counted.
    fn kernel_seconds(&self, mut scene: Scene) -> Result<f64> {
        let Rect { x0, y0, x1, y1 } = scene.film.window();
        let (x, y) = (u32::midpoint(x0, x1), u32::midpoint(y0, y1));
        scene.film.crop = Some(Rect { x0: x, y0: y, x1: (x + TILE).min(x1), y1: (y + TILE).min(y1) });
        let prepared = prepare::prepare(&scene)?;
        let start = Instant::now();
        let kernels = Kernels::new(&self.gpu, &mut self.compiler()?, &scene, &prepared, self.options)?;
        let compiled = start.elapsed();
        let renderer = Renderer::new(self.gpu.clone(), kernels, scene, prepared, self.options.slicing)?;
        let start = Instant::now();
        renderer.render(0, 1, &mut |_| Next::Continue)?;
        Ok((compiled + start.elapsed()).as_secs_f64())
    }

    /// Seconds from `start` to the end of the first slice, of one sample a pixel.
    fn first_slice_seconds(&self, scene: Scene, start: Instant) -> Result<f64> {
        let renderer = Renderer::open(self.gpu.clone(), &mut self.compiler()?, scene, self.options)?;
        let mut first = None;
        renderer.render(0, 1, &mut |progress| {
            if progress.computed > 0 {
                first.get_or_insert_with(|| start.elapsed());
            }
            Next::Continue
        })?;
        // A small picture is one slice.
        Ok(first.unwrap_or_else(|| start.elapsed()).as_secs_f64())
    }

    /// Measures one scene: what a start costs, whole renders, and the stages one by one.
    fn measure(&self, name: &str) -> Result<Row> {
        let Self { args, gpu, options } = self;
        let scene = scene_of(args, name)?;
        let prepared = prepare::prepare(&scene)?;
        let triangles = prepared.triangle_count;
        let (bvh_seconds, cost) = (prepared.bvh_seconds.0, prepared.bvh_cost);
        gpu.take_peak_bytes();
        let kernels = Kernels::new(gpu, &mut self.compiler()?, &scene, &prepared, *options)?;
        // Scene and kernels are known to be sound: errors in them were told here and not in another process.
        let caches = Caches::new()?;
        let compile_cold_seconds = caches.seconds(Task::Kernels, name)?;
        let compile_warm_seconds = caches.seconds(Task::Kernels, name)?;
        let first_slice_seconds = caches.seconds(Task::FirstSlice, name)?;

        let mut spp = args.spp.unwrap_or(scene.render.spp);
        let pixels = scene.film.window().area() as f64;
        let renderer = Renderer::new(gpu.clone(), kernels, scene, prepared, options.slicing)?;
        let (mut best, mut mean) = timed(&renderer, spp)?;
        while args.spp.is_none() && best < SHORTEST && spp < MOST_SPP {
            spp *= 4;
            (best, mean) = timed(&renderer, spp)?;
        }
        for _ in 1..args.rounds {
            best = best.min(timed(&renderer, spp)?.0);
        }
        let device_bytes = gpu.take_peak_bytes();
        let stages: Measured = renderer.measure(spp)?;
        Ok(Row {
            scene: name.to_owned(),
            spp,
            triangles,
            mean_radiance: mean,
            msamples_per_second: pixels * f64::from(spp) / best / 1e6,
            camera_mrays_per_second: stages.camera.mega_per_second(),
            bounce_mrays_per_second: stages.bounce.mega_per_second(),
            shadow_mrays_per_second: stages.shadow.mega_per_second(),
            stage_seconds: Stage::WAVE.iter().map(|stage| stage.name()).zip(stages.seconds).collect(),
            bvh_mtriangles_per_second: if bvh_seconds > 0.0 {
                triangles as f64 / bvh_seconds / 1e6
            } else {
                0.0
            },
            bvh_sah_cost: (cost > 0.0).then_some(cost),
            compile_cold_seconds,
            compile_warm_seconds,
            first_slice_seconds,
            device_bytes,
            peak_memory_bytes: memory::peak(),
        })
    }
}

/// Renders that take fewer seconds would measure how slices grow: they get more samples, unless it was said how many.
const SHORTEST: f64 = 0.2;
const MOST_SPP: u32 = 4096;

/// Seconds of a render, and its mean radiance.
fn timed(renderer: &Renderer, spp: u32) -> Result<(f64, f64)> {
    let start = Instant::now();
    let film = renderer.render(0, spp, &mut |_| Next::Continue)?;
    Ok((start.elapsed().as_secs_f64(), mean_radiance(&film.resolve().rgb)))
}

fn mean_radiance(rgb: &[[f32; 3]]) -> f64 {
    let sum: f64 = rgb.iter().flatten().map(|c| f64::from(*c)).sum();
    sum / (3 * rgb.len()).max(1) as f64
}
