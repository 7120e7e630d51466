//! Runs a few lines of GLSL that call leaf functions of `shaders/` over an array, on the device.
#![allow(clippy::panic, reason = "what fails here fails the test that called it")]

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use dapple::gpu::{Command, DeviceChoice, Gpu, Layout, Pipeline, Place};
use dapple::layout::{Backend, Frame, WORKGROUP};
use dapple::render::{add_generated, backend_of};
use dapple::shader::{CacheOptions, Compiler, KernelKey, Sources};

/// A word of the buffers `points` and `values`.
pub type Word = [u32; 4];

/// What a value has before the kernel writes it.
pub const UNWRITTEN: u32 = u32::MAX;

/// Stands for the textures of a scene in kernels that include files which name them.
const NO_TEXTURES: &str = "#include \"texture/context.glsl\"\n\
    vec4 texture_evaluate(uint reference, TextureContext context) { return vec4(0.0); }\n";

/// The device that the tests of a program share.
pub struct Probe {
    gpu: Arc<Gpu>,
    kernels: Mutex<HashMap<(String, Backend), Kernel>>,
}

type Kernel = (Arc<Layout>, Arc<Pipeline>);

impl Probe {
    /// Opens the device on the first call, with the validation layer when `DAPPLE_VALIDATION` is set.
    pub fn new() -> &'static Self {
        static SHARED: OnceLock<Probe> = OnceLock::new();
        SHARED.get_or_init(|| {
            let validation = dapple::gpu::validation_from_environment();
            let choice = DeviceChoice { validation, ..DeviceChoice::default() };
            let gpu = Arc::new(Gpu::open(&choice).unwrap_or_else(|error| panic!("{error}")));
            Probe { gpu, kernels: Mutex::default() }
        })
    }

    /// Runs `glsl`, which defines `void probe(uint i)`, for `i` in `0..points`, with `inputs` behind `fetch_points` and
    /// room for `outputs` words behind `store_values`. What the kernel does not write is [`UNWRITTEN`].
    pub fn run(
        &self,
        glsl: &str,
        backend: Backend,
        inputs: &[Word],
        points: usize,
        outputs: usize,
    ) -> Vec<Word> {
        let frame = Frame { point_count: points as u32, threads: 1, ..Frame::default() };
        self.run_with_frame(glsl, backend, &frame, inputs, outputs)
    }

    /// The same on both back ends, whose answers must be equal to the bit.
    pub fn both(&self, glsl: &str, inputs: &[Word], points: usize, outputs: usize) -> Vec<Word> {
        let storage = self.run(glsl, Backend::Storage, inputs, points, outputs);
        let texel = self.run(glsl, Backend::Texel, inputs, points, outputs);
        let differs = (0..outputs).find(|&i| storage[i] != texel[i]);
        if let Some(i) = differs {
            panic!("word {i}: {:?} from storage buffers, {:?} from texel buffers", storage[i], texel[i]);
        }
        storage
    }

    /// As [`Probe::run`], with the whole uniform block; `i` stays below its `point_count`.
    pub fn run_with_frame(
        &self,
        glsl: &str,
        backend: Backend,
        frame: &Frame,
        inputs: &[Word],
        outputs: usize,
    ) -> Vec<Word> {
        self.try_run(glsl, backend, frame, inputs, outputs).unwrap_or_else(|error| panic!("{error}\n{glsl}"))
    }

    /// The kernel, made once: drivers take longer to compile it than to run it.
    fn kernel(&self, glsl: &str, backend: Backend) -> dapple::Result<Kernel> {
        let name = (glsl.to_owned(), backend);
        let made = self.kernels.lock().unwrap_or_else(PoisonError::into_inner).get(&name).cloned();
        if let Some(kernel) = made {
            return Ok(kernel);
        }
        let mut sources = sources()?;
        sources.set_virtual("generated/probe.glsl", glsl)?;
        let compiler = Compiler::new(sources, cache());
        let mut key = KernelKey::new("probe.comp");
        if backend == Backend::Texel {
            key = key.define("TEXEL_FETCH", 1);
        }
        let layout = self.gpu.layout(backend)?;
        let pipeline = self.gpu.pipeline(&layout, &compiler.kernel(&key)?)?;
        let kernel = (layout, pipeline);
        self.kernels.lock().unwrap_or_else(PoisonError::into_inner).insert(name, kernel.clone());
        Ok(kernel)
    }

    fn try_run(
        &self,
        glsl: &str,
        backend: Backend,
        frame: &Frame,
        inputs: &[Word],
        outputs: usize,
    ) -> dapple::Result<Vec<Word>> {
        let gpu = &self.gpu;
        // Where texel buffers are short there is one back end
        let backend = backend.max(backend_of(gpu));
        let (layout, pipeline) = self.kernel(glsl, backend)?;
        let block = gpu.upload("frame", bytemuck::bytes_of(frame))?;
        let points = gpu.upload("points", bytemuck::cast_slice(inputs))?;
        let bytes = outputs as u64 * 16;
        let values = gpu.buffer("values", bytes, Place::Device)?;
        let host = gpu.buffer("values (host)", bytes, Place::Readback)?;
        let bindings =
            gpu.bindings(&layout, &[("frame", &block), ("points", &points), ("values", &values)])?;
        gpu.run(&[
            Command::Fill { buffer: &values, bytes, value: UNWRITTEN },
            Command::Barrier,
            Command::Dispatch {
                pipeline: &pipeline,
                bindings: &bindings,
                groups: [frame.point_count.div_ceil(WORKGROUP), 1],
            },
            Command::Barrier,
            Command::Copy { from: &values, to: &host, at: 0, bytes },
            Command::Barrier,
        ])?;
        host.read(bytes, |words| words.as_chunks().0.to_vec())
    }
}

/// The files of `shaders/` as they are on disk, and stubs of what a scene generates.
pub fn sources() -> dapple::Result<Sources> {
    let mut sources = Sources::folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"))?;
    add_generated(&mut sources, NO_TEXTURES)?;
    Ok(sources)
}

/// A cache of kernels for tests alone. Its keys are made of all texts, so it never gives an old kernel.
pub fn cache() -> CacheOptions {
    CacheOptions::Folder(Path::new(env!("CARGO_TARGET_TMPDIR")).join("spirv"))
}

/// A word of floats.
pub fn floats(x: f32, y: f32, z: f32, w: f32) -> Word {
    [x.to_bits(), y.to_bits(), z.to_bits(), w.to_bits()]
}

/// A vector with one spare lane.
pub fn vector(v: [f32; 3]) -> Word {
    floats(v[0], v[1], v[2], 0.0)
}

/// The four floats of a word.
pub fn as_floats(word: Word) -> [f32; 4] {
    word.map(f32::from_bits)
}

/// The four floats of a word, widened.
pub fn as_doubles(word: Word) -> [f64; 4] {
    word.map(|bits| f64::from(f32::from_bits(bits)))
}

/// The first three of four numbers.
pub fn three(v: [f64; 4]) -> [f64; 3] {
    [v[0], v[1], v[2]]
}
