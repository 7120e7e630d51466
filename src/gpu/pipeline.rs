//! Compute pipelines and what is bound to them. All kernels share the descriptor set of [`crate::layout::BINDINGS`].

use super::census::Token;
use super::device::{Gpu, Inner};
use super::table::{confirm, descriptors};
use super::{Buffer, Place, check, limits};
use crate::layout::{BINDINGS, Backend, WORD_BYTES};
use crate::shader::{Spirv, scan};
use crate::{Error, Result};
use ash::vk;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// The descriptor layout that all pipelines and bindings of a back end share.
pub struct Layout {
    pub(super) set: vk::DescriptorSetLayout,
    pub(super) pipeline: vk::PipelineLayout,
    backend: Backend,
    inner: Arc<Inner>,
}

/// A compute kernel on the device.
pub struct Pipeline {
    pub(super) raw: vk::Pipeline,
    pub(super) layout: Arc<Layout>,
    _counted: Token,
}

/// Pipelines that are alive, by back end and hash of the kernel: drivers compile what they are given, as often as they are given it.
pub(super) type Pipelines = Mutex<HashMap<(Backend, blake3::Hash), Weak<Pipeline>>>;

/// One descriptor set with every binding of the table; what is not given is a dummy of one word.
pub struct Bindings {
    pub(super) set: vk::DescriptorSet,
    pool: vk::DescriptorPool,
    views: Vec<vk::BufferView>,
    // What is bound lives as long as the set.
    keep: Vec<Arc<Buffer>>,
    layout: Arc<Layout>,
    _counted: Token,
}

impl Gpu {
    /// Makes the layout that the pipelines and bindings of a back end share.
    ///
    /// # Errors
    ///
    /// When the device allows fewer storage buffers in a kernel than the table of bindings has.
    pub fn layout(&self, backend: Backend) -> Result<Arc<Layout>> {
        let bindings: Vec<_> = BINDINGS
            .iter()
            .flat_map(|binding| descriptors(binding, backend))
            .map(|(number, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(number)
                    .descriptor_type(kind)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let storage =
            bindings.iter().filter(|b| b.descriptor_type == vk::DescriptorType::STORAGE_BUFFER).count();
        if storage > self.inner.info.limits.storage_buffers as usize {
            return Err(Error::device(format!(
                "device `{}` allows {} storage buffers in a kernel, dapple needs {storage}",
                self.inner.info.name, self.inner.info.limits.storage_buffers
            ))
            .help("choose another --device"));
        }
        let device = &self.inner.device;
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is alive and `info` lives until the call returns.
        let set = check(unsafe { device.create_descriptor_set_layout(&info, None) }, "make the set layout")?;
        let mut layout =
            Layout { set, pipeline: vk::PipelineLayout::null(), backend, inner: self.inner.clone() };
        let sets = [set];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        // SAFETY: as above; `set` is of this device.
        layout.pipeline =
            check(unsafe { device.create_pipeline_layout(&info, None) }, "make the pipeline layout")?;
        Ok(Arc::new(layout))
    }

    /// The pipeline of a kernel: the one that there is, as long as anything holds it, or else a new one.
    ///
    /// # Errors
    ///
    /// When the kernel uses a resource that the table of bindings does not have, has workgroups of another size, or the
    /// driver refuses it.
    pub fn pipeline(&self, layout: &Arc<Layout>, spirv: &Spirv) -> Result<Arc<Pipeline>> {
        let key = (layout.backend, blake3::hash(bytemuck::cast_slice(spirv.words())));
        let known = || self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pipeline) = known().get(&key).and_then(Weak::upgrade) {
            return Ok(pipeline);
        }
        // Other threads need not wait for the driver
        let pipeline = self.make_pipeline(layout, spirv)?;
        let mut known = known();
        known.retain(|_, pipeline| pipeline.strong_count() > 0);
        known.insert(key, Arc::downgrade(&pipeline));
        Ok(pipeline)
    }

    fn make_pipeline(&self, layout: &Arc<Layout>, spirv: &Spirv) -> Result<Arc<Pipeline>> {
        let name = &spirv.key().file;
        confirm(&scan(spirv.words())?, layout.backend).map_err(|error| error.in_file(Path::new(name)))?;
        let device = &self.inner.device;
        let info = vk::ShaderModuleCreateInfo::default().code(spirv.words());
        let _counted = self.inner.census.modules.clone();
        // SAFETY: the words are sound, because only glslang makes a `Spirv`; the module is destroyed below.
        let module =
            check(unsafe { device.create_shader_module(&info, None) }, &format!("load kernel `{name}`"))?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main");
        let infos = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout.pipeline)];
        // SAFETY: module and layout are of this device, and the layout has what the kernel uses; the module may go once the
        // pipeline is made.
        let made = unsafe {
            let made = device.create_compute_pipelines(vk::PipelineCache::null(), &infos, None);
            device.destroy_shader_module(module, None);
            made
        };
        let pipelines = check(made.map_err(|(_, code)| code), &format!("compile kernel `{name}`"))?;
        let raw = pipelines.first().copied().unwrap_or_default();
        Ok(Arc::new(Pipeline { raw, layout: layout.clone(), _counted: self.inner.census.pipelines.clone() }))
    }

    /// Makes a descriptor set. Each buffer is named by the table; what is not given is a dummy of one word.
    ///
    /// # Errors
    ///
    /// When a name is not in the table, a buffer is of another device, or one is longer than a descriptor may be.
    pub fn bindings(&self, layout: &Arc<Layout>, buffers: &[(&str, &Arc<Buffer>)]) -> Result<Arc<Bindings>> {
        if let Some((name, _)) = buffers.iter().find(|(name, _)| BINDINGS.iter().all(|b| b.name != *name)) {
            return Err(Error::device(format!("no binding is called `{name}`")));
        }
        if let Some((name, _)) = buffers.iter().find(|(_, buffer)| !buffer.is_of(&self.inner)) {
            return Err(Error::device(format!("buffer `{name}` is of another device")));
        }
        let dummy = self.buffer("dummy", WORD_BYTES, Place::Device)?;
        let device = &self.inner.device;
        let count = |kind| {
            let all = BINDINGS.iter().flat_map(|b| descriptors(b, layout.backend));
            vk::DescriptorPoolSize::default()
                .ty(kind)
                .descriptor_count(all.filter(|d| d.1 == kind).count().max(1) as u32)
        };
        let sizes = [
            count(vk::DescriptorType::UNIFORM_BUFFER),
            count(vk::DescriptorType::STORAGE_BUFFER),
            count(vk::DescriptorType::UNIFORM_TEXEL_BUFFER),
        ];
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: the device is alive and `info` lives until the call returns.
        let pool = check(unsafe { device.create_descriptor_pool(&info, None) }, "make a descriptor pool")?;
        let mut bound = Bindings {
            set: vk::DescriptorSet::null(),
            pool,
            views: Vec::new(),
            layout: layout.clone(),
            keep: vec![dummy.clone()],
            _counted: self.inner.census.bindings.clone(),
        };
        let sets = [layout.set];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&sets);
        // SAFETY: pool and layout are of this device and the pool has room for one set.
        let set = check(unsafe { device.allocate_descriptor_sets(&info) }, "make a descriptor set")?;
        bound.set = set.first().copied().unwrap_or_default();
        for binding in BINDINGS {
            let given = buffers.iter().find(|(name, _)| *name == binding.name).map(|(_, buffer)| *buffer);
            for (number, kind) in descriptors(binding, layout.backend) {
                bound.bind(binding.name, number, kind, given.unwrap_or(&dummy))?;
            }
        }
        Ok(Arc::new(bound))
    }
}

impl Layout {
    /// Whether the layout was made by a device.
    pub(super) fn is_of(&self, device: &Arc<Inner>) -> bool {
        Arc::ptr_eq(&self.inner, device)
    }
}

impl Bindings {
    /// Whether kernels of a layout can be dispatched with this.
    pub(super) fn fits(&self, layout: &Layout) -> bool {
        self.layout.backend == layout.backend && self.layout.is_of(&layout.inner)
    }

    fn bind(
        &mut self,
        name: &str,
        number: u32,
        kind: vk::DescriptorType,
        buffer: &Arc<Buffer>,
    ) -> Result<()> {
        self.keep.push(buffer.clone());
        let inner = &self.layout.inner;
        limits::check_range(&inner.info.limits, &inner.info.name, name, kind, buffer.bytes())?;
        let buffers = [vk::DescriptorBufferInfo::default().buffer(buffer.raw).range(vk::WHOLE_SIZE)];
        let mut texels = [vk::BufferView::null()];
        let write =
            vk::WriteDescriptorSet::default().dst_set(self.set).dst_binding(number).descriptor_type(kind);
        let write = if kind == vk::DescriptorType::UNIFORM_TEXEL_BUFFER {
            let info = vk::BufferViewCreateInfo::default()
                .buffer(buffer.raw)
                .format(vk::Format::R32G32B32A32_UINT)
                .range(vk::WHOLE_SIZE);
            // SAFETY: the buffer has texel usage and is kept as long as the view in `views`.
            let view =
                check(unsafe { inner.device.create_buffer_view(&info, None) }, &format!("view `{name}`"))?;
            self.views.push(view);
            texels[0] = view;
            write.texel_buffer_view(&texels)
        } else {
            write.buffer_info(&buffers)
        };
        // SAFETY: the set is not in use yet, and what is written lives until the call returns.
        unsafe { inner.device.update_descriptor_sets(&[write], &[]) };
        Ok(())
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        // SAFETY: pipelines and sets hold an `Arc` of this, so none is left.
        unsafe {
            self.inner.device.destroy_pipeline_layout(self.pipeline, None);
            self.inner.device.destroy_descriptor_set_layout(self.set, None);
        }
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: a ticket keeps the pipelines of its work until that is done.
        unsafe { self.layout.inner.device.destroy_pipeline(self.raw, None) };
    }
}

impl Drop for Bindings {
    fn drop(&mut self) {
        // SAFETY: a ticket keeps the bindings of its work until that is done.
        unsafe {
            for view in &self.views {
                self.layout.inner.device.destroy_buffer_view(*view, None);
            }
            self.layout.inner.device.destroy_descriptor_pool(self.pool, None);
        }
    }
}
