//! Values of textures at points that the host names.

use super::kernels::{add_generated, key};
use super::resident::upload_texels;
use super::threads_of;
use crate::gpu::{Bindings, Buffer, Command, Gpu, Pipeline, Place};
use crate::layout::{Backend, Frame, Record as _, TexturePoint, WORD_BYTES, WORKGROUP};
use crate::prepare::{Features, Prepared, PreparedTextures, Stage, prepare_textures};
use crate::scene::{Handle, Image, Scene, Store, Texels, Texture};
use crate::shader::{Compiler, Spirv};
use crate::{Error, Result};
use std::sync::Arc;

/// Most points of one dispatch.
const MOST_POINTS: usize = 1 << 16;

/// Some textures of a scene on a device, to ask for their values.
pub struct Evaluator {
    gpu: Arc<Gpu>,
    references: Vec<u32>,
    pipeline: Arc<Pipeline>,
    bindings: Arc<Bindings>,
    frame: Frame,
    uniform: Arc<Buffer>,
    points: Arc<Buffer>,
    values: Arc<Buffer>,
    host: Arc<Buffer>,
}

/// Some textures of a scene and the kernel that gives their values, before they are on a device.
pub(super) struct Asked {
    textures: PreparedTextures,
    kernel: Spirv,
    backend: Backend,
}

impl Asked {
    /// Prepares the textures and compiles the kernel.
    ///
    /// # Errors
    ///
    /// As [`prepare_textures`], and when the kernel does not compile.
    pub fn new(
        compiler: &mut Compiler,
        scene: &Scene,
        asked: &[Handle<Texture>],
        backend: Backend,
    ) -> Result<Self> {
        let textures = prepare_textures(scene, asked)?;
        add_generated(compiler.sources_mut(), &textures.glsl)?;
        let features =
            Features { vertex_color: textures.vertex_color, uv1: textures.uv1, ..Features::default() };
        let prepared = Prepared { features, ..Prepared::default() };
        let kernel = compiler.kernel(&key(scene, &prepared, Stage::Evaluate, None, backend))?;
        Ok(Self { textures, kernel, backend })
    }

    /// A hash of all that the values depend on.
    pub fn hash(&self, images: &Store<Image>) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        let mut add = |bytes: &[u8]| {
            hasher.update(&(bytes.len() as u64).to_le_bytes()).update(bytes);
        };
        add(bytemuck::cast_slice(self.kernel.words()));
        add(bytemuck::cast_slice(&self.textures.records));
        add(bytemuck::cast_slice(&self.textures.references));
        for image in self.textures.atlas.images().map(|image| &images[image]) {
            add(bytemuck::cast_slice(&[image.width, image.height]));
            match &image.texels {
                Texels::Rgba8(texels) => add(bytemuck::cast_slice(texels)),
                Texels::Rgba16(texels) => add(bytemuck::cast_slice(texels)),
                Texels::RgbaF32(texels) => add(bytemuck::cast_slice(texels)),
            }
        }
        hasher.finalize()
    }
}

impl Evaluator {
    /// Puts textures of a scene on the device and compiles the kernel that gives their values.
    ///
    /// # Errors
    ///
    /// As [`prepare_textures`], and when the kernel does not compile or the device has no memory.
    pub fn new(
        gpu: Arc<Gpu>,
        compiler: &mut Compiler,
        scene: &Scene,
        asked: &[Handle<Texture>],
        backend: Backend,
    ) -> Result<Self> {
        Self::open(gpu, &Asked::new(compiler, scene, asked, backend)?, &scene.images)
    }

    pub(super) fn open(gpu: Arc<Gpu>, asked: &Asked, images: &Store<Image>) -> Result<Self> {
        let Asked { textures, kernel, backend } = asked;
        let backend = *backend;
        let layout = gpu.layout(backend)?;
        let pipeline = gpu.pipeline(&layout, kernel)?;
        let point_bytes = MOST_POINTS as u64 * u64::from(TexturePoint::WORDS) * WORD_BYTES;
        let value_bytes = MOST_POINTS as u64 * WORD_BYTES;
        let uniform = gpu.buffer("frame", size_of::<Frame>() as u64, Place::Upload)?;
        let points = gpu.buffer("points", point_bytes, Place::Upload)?;
        let values = gpu.buffer("values", value_bytes, Place::Device)?;
        let host = gpu.buffer("values (host)", value_bytes, Place::Readback)?;
        let records = gpu.upload("textures", bytemuck::cast_slice(&textures.records))?;
        let texels = upload_texels(&gpu, &textures.atlas, |image| images.shared(image))?;
        let bindings = gpu.bindings(
            &layout,
            &[
                ("frame", &uniform),
                ("points", &points),
                ("textures", &records),
                ("texels", &texels),
                ("values", &values),
            ],
        )?;
        let frame = Frame { threads: threads_of(&gpu), ..Frame::default() };
        Ok(Self {
            gpu,
            references: textures.references.clone(),
            pipeline,
            bindings,
            frame,
            uniform,
            points,
            values,
            host,
        })
    }

    /// The values of a texture: red, green, blue and alpha for each point. The texture must be one of those that were asked
    /// for; the `reference` of a point is filled in here.
    ///
    /// # Errors
    ///
    /// When the device fails.
    pub fn values(&self, texture: Handle<Texture>, points: &[TexturePoint]) -> Result<Vec<[f32; 4]>> {
        let mut values = Vec::with_capacity(points.len());
        for chunk in points.chunks(MOST_POINTS) {
            let reference = self.references[texture.index()];
            let chunk: Vec<_> = chunk.iter().map(|point| TexturePoint { reference, ..*point }).collect();
            self.chunk(&chunk, &mut values)?;
        }
        Ok(values)
    }

    fn chunk(&self, points: &[TexturePoint], values: &mut Vec<[f32; 4]>) -> Result<()> {
        let count = points.len() as u32;
        let frame = Frame { point_count: count, ..self.frame };
        if !self.uniform.write(bytemuck::bytes_of(&frame)) || !self.points.write(bytemuck::cast_slice(points))
        {
            return Err(Error::device("the driver does not map memory for the points of textures"));
        }
        let bytes = u64::from(count) * WORD_BYTES;
        let groups = [count.div_ceil(WORKGROUP).div_ceil(self.frame.threads), self.frame.threads];
        self.gpu.run(&[
            Command::Dispatch { pipeline: &self.pipeline, bindings: &self.bindings, groups },
            Command::Barrier,
            Command::Copy { from: &self.values, to: &self.host, at: 0, bytes },
            Command::Barrier,
        ])?;
        self.host.read(bytes, |words| values.extend_from_slice(bytemuck::cast_slice(words)))
    }
}
