//! Work for the device as a list of plain values, its submission, and waiting for it.

use super::device::{Gpu, Inner};
use super::{Bindings, Buffer, Pipeline, check};
use crate::{Error, Result};
use ash::vk;
use std::any::Any;
use std::sync::{Arc, PoisonError};

/// One step of work. Steps run in order; a [`Command::Barrier`] makes what was written before it visible after it.
pub enum Command<'a> {
    /// Sets `bytes` bytes from the start to copies of `value`.
    Fill {
        /// What is filled.
        buffer: &'a Arc<Buffer>,
        /// How much, a multiple of 4.
        bytes: u64,
        /// With what.
        value: u32,
    },
    /// Copies from the start of one buffer into another.
    Copy {
        /// Source.
        from: &'a Arc<Buffer>,
        /// Target.
        to: &'a Arc<Buffer>,
        /// Byte of the target where the copy begins.
        at: u64,
        /// How much.
        bytes: u64,
    },
    /// Runs a kernel over a number of workgroups.
    Dispatch {
        /// The kernel.
        pipeline: &'a Arc<Pipeline>,
        /// What it sees.
        bindings: &'a Arc<Bindings>,
        /// Workgroups in x and y.
        groups: [u32; 2],
    },
    /// Runs a kernel over as many workgroups as three `u32` in a buffer say.
    DispatchIndirect {
        /// The kernel.
        pipeline: &'a Arc<Pipeline>,
        /// What it sees.
        bindings: &'a Arc<Bindings>,
        /// Where the numbers are.
        sizes: &'a Arc<Buffer>,
        /// Their offset in bytes.
        offset: u64,
    },
    /// All writes before are visible to all reads after, also to the host.
    Barrier,
}

impl Command<'_> {
    /// What the device could not do without harm is an error.
    fn check(&self, gpu: &Gpu) -> Result<()> {
        let own = |buffer: &Buffer| buffer.is_of(&gpu.inner);
        let fits = |pipeline: &Pipeline, bindings: &Bindings| {
            pipeline.layout.is_of(&gpu.inner) && bindings.fits(&pipeline.layout)
        };
        let fault = match self {
            Command::Fill { bytes, .. } if bytes % 4 != 0 => Some("a fill is no whole number of words"),
            Command::Fill { buffer, .. } if !own(buffer) => Some(FOREIGN),
            Command::Copy { from, to, .. } if !own(from) || !own(to) => Some(FOREIGN),
            Command::Dispatch { pipeline, bindings, .. }
            | Command::DispatchIndirect { pipeline, bindings, .. }
                if !fits(pipeline, bindings) =>
            {
                Some("kernel and bindings are of two back ends or devices")
            }
            Command::DispatchIndirect { sizes, .. } if !own(sizes) => Some(FOREIGN),
            Command::DispatchIndirect { sizes, offset, .. } => sizes_fault(*offset, sizes.bytes()),
            Command::Dispatch { groups, .. } => {
                return check_groups(
                    groups[0].max(groups[1]),
                    gpu.inner.info.limits.workgroups,
                    &gpu.inner.info.name,
                );
            }
            _ => None,
        };
        fault.map_or(Ok(()), |fault| Err(Error::device(fault)))
    }

    fn uses(&self) -> Vec<Arc<dyn Any + Send + Sync>> {
        match self {
            Command::Fill { buffer, .. } => vec![(*buffer).clone()],
            Command::Copy { from, to, .. } => vec![(*from).clone(), (*to).clone()],
            Command::Dispatch { pipeline, bindings, .. } => vec![(*pipeline).clone(), (*bindings).clone()],
            Command::DispatchIndirect { pipeline, bindings, sizes, .. } => {
                vec![(*pipeline).clone(), (*bindings).clone(), (*sizes).clone()]
            }
            Command::Barrier => Vec::new(),
        }
    }
}

const FOREIGN: &str = "a buffer is of another device";

/// What is wrong with three sizes of a dispatch at an offset in a buffer.
fn sizes_fault(offset: u64, bytes: u64) -> Option<&'static str> {
    let inside = offset.checked_add(12).is_some_and(|end| end <= bytes);
    (!inside || !offset.is_multiple_of(4)).then_some("the sizes of a dispatch are not in their buffer")
}

fn check_groups(groups: u32, limit: u32, device: &str) -> Result<()> {
    if groups <= limit {
        return Ok(());
    }
    Err(Error::device(format!("a dispatch has {groups} workgroups, device `{device}` allows {limit}"))
        .help("render fewer samples or pixels at once, or choose another --device"))
}

/// Work that was submitted. It keeps what the work uses; dropping it waits for the work.
pub struct Ticket {
    pool: vk::CommandPool,
    fence: vk::Fence,
    inner: Arc<Inner>,
    done: bool,
    // What the commands name lives until the work is done.
    _keep: Vec<Arc<dyn Any + Send + Sync>>,
}

impl Gpu {
    /// Records and submits commands.
    ///
    /// # Errors
    ///
    /// When a command names what is of another device or reaches beyond a buffer or a limit, or the device fails.
    pub fn submit(&self, commands: &[Command<'_>]) -> Result<Ticket> {
        commands.iter().try_for_each(|command| command.check(self))?;
        let device = &self.inner.device;
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(self.inner.queue_family);
        // SAFETY: the device is alive; the pool is destroyed by the ticket.
        let pool = check(unsafe { device.create_command_pool(&info, None) }, "make a command pool")?;
        let mut ticket = Ticket {
            pool,
            fence: vk::Fence::null(),
            inner: self.inner.clone(),
            done: true,
            _keep: commands.iter().flat_map(Command::uses).collect(),
        };
        // SAFETY: as above.
        ticket.fence =
            check(unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }, "make a fence")?;
        let buffer = record(device, pool, commands)?;
        let buffers = [buffer];
        let submits = [vk::SubmitInfo::default().command_buffers(&buffers)];
        let queue = self.inner.queue.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the queue is locked, the command buffer is complete, and the ticket keeps it until it is done.
        check(unsafe { device.queue_submit(*queue, &submits, ticket.fence) }, "submit work")?;
        ticket.done = false;
        Ok(ticket)
    }

    /// Submits commands and waits for them.
    ///
    /// # Errors
    ///
    /// As [`Gpu::submit`] and [`Ticket::wait`].
    pub fn run(&self, commands: &[Command<'_>]) -> Result<()> {
        self.submit(commands)?.wait()
    }
}

fn record(
    device: &ash::Device,
    pool: vk::CommandPool,
    commands: &[Command<'_>],
) -> Result<vk::CommandBuffer> {
    let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
    // SAFETY: the pool is alive and used by this thread only.
    let buffers = check(unsafe { device.allocate_command_buffers(&info) }, "make a command buffer")?;
    let buffer = buffers.first().copied().unwrap_or_default();
    let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
    // SAFETY: the buffer is new.
    check(unsafe { device.begin_command_buffer(buffer, &begin) }, "begin recording")?;
    for command in commands {
        // SAFETY: the buffer is recording; what a command names is alive, and `Command::check` has seen that it is of this
        // device.
        unsafe { record_one(device, buffer, command) };
    }
    // SAFETY: the buffer is recording.
    check(unsafe { device.end_command_buffer(buffer) }, "end recording")?;
    Ok(buffer)
}

/// # Safety
/// `buffer` is recording; what the command names is of this device.
unsafe fn record_one(device: &ash::Device, buffer: vk::CommandBuffer, command: &Command<'_>) {
    // SAFETY: see above.
    unsafe {
        let bind = |pipeline: &Pipeline, bindings: &Bindings| {
            device.cmd_bind_pipeline(buffer, vk::PipelineBindPoint::COMPUTE, pipeline.raw);
            let (layout, sets) = (pipeline.layout.pipeline, [bindings.set]);
            device.cmd_bind_descriptor_sets(buffer, vk::PipelineBindPoint::COMPUTE, layout, 0, &sets, &[]);
        };
        match command {
            Command::Fill { buffer: target, bytes, value } => {
                let bytes = (*bytes).min(target.bytes());
                if bytes > 0 {
                    device.cmd_fill_buffer(buffer, target.raw, 0, bytes, *value);
                }
            }
            Command::Copy { from, to, at, bytes } => {
                let bytes = (*bytes).min(from.bytes()).min(to.bytes());
                if bytes > 0 {
                    let region = vk::BufferCopy::default().dst_offset(*at).size(bytes);
                    device.cmd_copy_buffer(buffer, from.raw, to.raw, &[region]);
                }
            }
            Command::Dispatch { pipeline, bindings, groups } => {
                bind(pipeline, bindings);
                device.cmd_dispatch(buffer, groups[0], groups[1], 1);
            }
            Command::DispatchIndirect { pipeline, bindings, sizes, offset } => {
                bind(pipeline, bindings);
                device.cmd_dispatch_indirect(buffer, sizes.raw, *offset);
            }
            Command::Barrier => barrier(device, buffer),
        }
    }
}

/// # Safety
/// `buffer` is recording.
unsafe fn barrier(device: &ash::Device, buffer: vk::CommandBuffer) {
    let (stages, host) = (
        vk::PipelineStageFlags::COMPUTE_SHADER
            | vk::PipelineStageFlags::TRANSFER
            | vk::PipelineStageFlags::DRAW_INDIRECT,
        vk::PipelineStageFlags::HOST,
    );
    let barriers = [vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::SHADER_WRITE | vk::AccessFlags::TRANSFER_WRITE)
        .dst_access_mask(
            vk::AccessFlags::SHADER_READ
                | vk::AccessFlags::SHADER_WRITE
                | vk::AccessFlags::UNIFORM_READ
                | vk::AccessFlags::TRANSFER_READ
                | vk::AccessFlags::TRANSFER_WRITE
                | vk::AccessFlags::INDIRECT_COMMAND_READ
                | vk::AccessFlags::HOST_READ,
        )];
    let flags = vk::DependencyFlags::empty();
    // SAFETY: see above.
    unsafe { device.cmd_pipeline_barrier(buffer, stages, stages | host, flags, &barriers, &[], &[]) };
}

impl Ticket {
    /// Waits until the work is done.
    ///
    /// # Errors
    ///
    /// When the device was lost, or the validation layer has said something.
    pub fn wait(mut self) -> Result<()> {
        self.finish()?;
        let messages = self.inner.instance.messages.take();
        if messages.is_empty() {
            return Ok(());
        }
        Err(Error::device(format!("the validation layer says: {}", messages.join("\n"))))
    }

    fn finish(&mut self) -> Result<()> {
        if self.done {
            return Ok(());
        }
        self.done = true;
        // SAFETY: the fence was submitted with this work.
        let result = unsafe { self.inner.device.wait_for_fences(&[self.fence], true, u64::MAX) };
        check(result, "wait for the device")
    }
}

impl Drop for Ticket {
    fn drop(&mut self) {
        // A lost device has stopped working too: its objects may go.
        _ = self.finish();
        // SAFETY: the work is done; fence and pool are ours alone.
        unsafe {
            self.inner.device.destroy_fence(self.fence, None);
            self.inner.device.destroy_command_pool(self.pool, None);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{DeviceChoice, Place};
    use crate::layout::Backend;
    use crate::shader::{KernelKey, Sources, compile};

    #[test]
    fn sizes_of_a_dispatch_are_inside_their_buffer() {
        assert_eq!(sizes_fault(52, 64), None);
        for offset in [53, 56, 64, u64::MAX, u64::MAX - 11] {
            assert!(sizes_fault(offset, 64).is_some(), "{offset}");
        }
        let error = check_groups(70_000, 65_535, "toy").unwrap_err().to_string();
        assert!(error.starts_with("a dispatch has 70000 workgroups, device `toy` allows 65535; "), "{error}");
        check_groups(65_535, 65_535, "toy").unwrap();
    }

    #[test]
    fn commands_that_would_do_harm_are_refused() {
        let open = || Gpu::open(&DeviceChoice::default()).unwrap();
        let (gpu, other) = (open(), open());
        let own = gpu.buffer("a", 64, Place::Readback).unwrap();
        let foreign = other.buffer("b", 64, Place::Device).unwrap();
        let fill = |buffer, bytes| Command::Fill { buffer, bytes, value: 7 };
        assert!(gpu.run(&[fill(&own, 3)]).is_err());
        assert!(gpu.run(&[fill(&foreign, 64)]).is_err());
        assert!(gpu.run(&[Command::Copy { from: &foreign, to: &own, at: 0, bytes: 64 }]).is_err());
        assert!(gpu.bindings(&gpu.layout(Backend::Storage).unwrap(), &[("film", &foreign)]).is_err());
        // More than there is means all, and nothing means nothing.
        gpu.run(&[fill(&own, 1 << 40), Command::Barrier, fill(&own, 0)]).unwrap();
        own.read(64, |words| assert_eq!(words, [7; 16])).unwrap();
        assert!(own.read(68, |_| ()).is_err() && own.read(3, |_| ()).is_err());
        assert!(!own.write(&[0; 65]) && own.write(&[0; 64]));
    }

    #[test]
    fn bindings_go_with_kernels_of_their_back_end() {
        let gpu = Gpu::open(&DeviceChoice::default()).unwrap();
        let [storage, texel] = [Backend::Storage, Backend::Texel].map(|b| gpu.layout(b).unwrap());
        let text = "layout(local_size_x = 64) in; void main() {}";
        let sources = Sources::from_map([("a.comp", text)]).unwrap();
        let kernel = compile(&sources, &KernelKey::new("a.comp")).unwrap();
        let pipeline = gpu.pipeline(&storage, &kernel).unwrap();
        let sizes = gpu.buffer("sizes", 16, Place::Device).unwrap();
        for (layout, offset, sound) in [(&storage, 0, true), (&texel, 0, false), (&storage, 8, false)] {
            let bindings = gpu.bindings(layout, &[]).unwrap();
            let clear = Command::Fill { buffer: &sizes, bytes: 16, value: 1 };
            let (pipeline, bindings, sizes) = (&pipeline, &bindings, &sizes);
            let dispatch = Command::DispatchIndirect { pipeline, bindings, sizes, offset };
            assert_eq!(gpu.run(&[clear, Command::Barrier, dispatch]).is_ok(), sound);
        }
    }
}
