//! `dapple bench`: how fast this machine is, on scenes made from formulas or on a scene of the user's.

mod blob;
mod memory;
mod scenes;
mod table;
mod write;

use super::args::{BenchArgs, Fetch};
use super::console::Console;
use dapple::gpu::{DeviceChoice, Gpu, validation_from_environment};
use dapple::import::read_scene;
use dapple::layout::Backend;
use dapple::prepare::{self, Stage};
use dapple::render::{Kernels, Measured, Next, Options, Renderer};
use dapple::scene::Scene;
use dapple::shader::{CacheOptions, Compiler, Sources};
use dapple::{Error, Result};
use serde::Serialize;
use std::sync::Arc;
use std::time::{Duration, Instant};

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
    bvh_sah_cost: f32,
    compile_cold_seconds: f64,
    compile_warm_seconds: f64,
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

/// Measures, and prints a table or one JSON object.
pub fn run(args: &BenchArgs, console: &mut Console) -> Result<()> {
    if let Some(folder) = &args.write_scene {
        return write::write(folder);
    }
    let choice = DeviceChoice {
        wanted: args.device.clone(),
        require_gpu: args.require_gpu,
        validation: validation_from_environment(),
    };
    let gpu = Arc::new(Gpu::open(&choice)?);
    let options = Options {
        backend: match args.fetch {
            Some(Fetch::Texel) => Backend::Texel,
            Some(Fetch::Storage) => Backend::Storage,
            None => Options::of(&gpu).backend,
        },
        ..Options::of(&gpu)
    };
    let mut rows = Vec::new();
    match &args.scene {
        Some(path) => {
            let (scene, _) = read_scene(path, &[])?;
            rows.push(measure(&path.display().to_string(), &scene, &gpu, options, args)?);
        }
        None => {
            for make in scenes::ALL {
                let built = make();
                console.note(&format!("measuring {}", built.name));
                rows.push(measure(built.name, &built.scene, &gpu, options, args)?);
            }
        }
    }
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        device: gpu.info().name.clone(),
        driver: gpu.info().driver.clone(),
        fetch: format!("{:?}", options.backend).to_lowercase(),
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

fn compiler(args: &BenchArgs, cache: CacheOptions) -> Result<Compiler> {
    let sources = match &args.shaders {
        Some(folder) => Sources::folder(folder)?,
        None => Sources::embedded(),
    };
    Ok(Compiler::new(sources, cache))
}

/// Measures one scene: compiling, from the start to the first slice, whole renders, and the stages one by one.
fn measure(name: &str, scene: &Scene, gpu: &Arc<Gpu>, options: Options, args: &BenchArgs) -> Result<Row> {
    let spp = args.spp.unwrap_or(scene.render.spp);
    let prepared = prepare::prepare(scene)?;
    let cold = seconds_of(|| {
        Kernels::new(gpu, &mut compiler(args, CacheOptions::Off)?, scene, &prepared, options.backend)
            .map(drop)
    })?;
    let cache = CacheOptions::from_environment();
    let mut cached = compiler(args, cache.clone())?;
    Kernels::new(gpu, &mut cached, scene, &prepared, options.backend)?;
    let mut warm_compiler = compiler(args, cache.clone())?;
    let warm =
        seconds_of(|| Kernels::new(gpu, &mut warm_compiler, scene, &prepared, options.backend).map(drop))?;
    let (triangles, bvh_seconds, cost) =
        (prepared.triangles.len(), prepared.bvh_seconds.0, prepared.bvh_cost);
    drop(prepared);

    gpu.take_peak_bytes();
    // From a scene in memory to the end of its first slice, with warm caches
    let start = Instant::now();
    let renderer = Renderer::open(gpu.clone(), &mut compiler(args, cache)?, scene, options)?;
    let mut first_slice = Duration::ZERO;
    let mut once = |_: &dapple::render::Progress| {
        if first_slice.is_zero() {
            first_slice = start.elapsed();
        }
        Next::Stop
    };
    renderer.render(0, spp, &mut once)?;

    let mut best = f64::INFINITY;
    let mut mean = 0.0;
    for _ in 0..args.rounds {
        let start = Instant::now();
        let film = renderer.render(0, spp, &mut |_| Next::Continue)?;
        best = best.min(start.elapsed().as_secs_f64());
        mean = mean_radiance(&film.resolve().rgb);
    }
    let device_bytes = gpu.take_peak_bytes();
    let stages: Measured = renderer.measure(spp)?;
    Ok(Row {
        scene: name.to_owned(),
        spp,
        triangles,
        mean_radiance: mean,
        msamples_per_second: scene.film.window().area() as f64 * f64::from(spp) / best / 1e6,
        camera_mrays_per_second: stages.camera.mega_per_second(),
        bounce_mrays_per_second: stages.bounce.mega_per_second(),
        shadow_mrays_per_second: stages.shadow.mega_per_second(),
        stage_seconds: Stage::WAVE.iter().map(|stage| stage.name()).zip(stages.seconds).collect(),
        bvh_mtriangles_per_second: if bvh_seconds > 0.0 { triangles as f64 / bvh_seconds / 1e6 } else { 0.0 },
        bvh_sah_cost: cost,
        compile_cold_seconds: cold,
        compile_warm_seconds: warm,
        first_slice_seconds: first_slice.as_secs_f64(),
        device_bytes,
        peak_memory_bytes: memory::peak(),
    })
}

fn seconds_of(work: impl FnOnce() -> Result<()>) -> Result<f64> {
    let start = Instant::now();
    work()?;
    Ok(start.elapsed().as_secs_f64())
}

fn mean_radiance(rgb: &[[f32; 3]]) -> f64 {
    let sum: f64 = rgb.iter().flatten().map(|c| f64::from(*c)).sum();
    sum / (3 * rgb.len()).max(1) as f64
}
