//! Buffers in device memory.

use super::census::Token;
use super::device::{DeviceType, Gpu, Inner};
use super::{Command, check, huge_pages, limits};
use crate::layout::WORD_BYTES;
use crate::{Error, Result};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Where a buffer lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// On the device.
    Device,
    /// Where the host writes and the device reads.
    Upload,
    /// Where the device writes and the host reads.
    Readback,
}

/// A buffer. It may be bound as storage, as texels, as a uniform block, copied, filled, and hold dispatch sizes.
pub struct Buffer {
    pub(super) raw: vk::Buffer,
    bytes: u64,
    place: Place,
    allocation: Mutex<Option<Allocation>>,
    inner: Arc<Inner>,
    _counted: Token,
}

impl Gpu {
    /// Makes a buffer of at least `bytes`, a whole number of words. `name` is used in messages; one of the table of
    /// bindings tells how the buffer will be bound.
    ///
    /// # Errors
    ///
    /// When it is too long to be bound, or the device has no memory left for it. Both are known before memory is taken.
    pub fn buffer(&self, name: &str, bytes: u64, place: Place) -> Result<Arc<Buffer>> {
        let bytes = bytes.max(WORD_BYTES).checked_next_multiple_of(WORD_BYTES).unwrap_or(u64::MAX);
        let known = &self.inner.info;
        limits::check_buffer(&known.limits, &known.name, name, bytes)?;
        if place == Place::Device {
            let in_use = self.inner.on_device.load(Ordering::Relaxed);
            limits::check_memory(self.inner.memory, &known.name, name, bytes, in_use)?;
        }
        let info = vk::BufferCreateInfo::default().size(bytes).usage(
            vk::BufferUsageFlags::STORAGE_BUFFER
                | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
                | vk::BufferUsageFlags::UNIFORM_BUFFER
                | vk::BufferUsageFlags::INDIRECT_BUFFER
                | vk::BufferUsageFlags::TRANSFER_SRC
                | vk::BufferUsageFlags::TRANSFER_DST,
        );
        let device = &self.inner.device;
        // SAFETY: the device is alive and `info` lives until the call returns.
        let raw = check(unsafe { device.create_buffer(&info, None) }, &format!("make buffer `{name}`"))?;
        let counted = self.inner.census.buffers.clone();
        let inner = self.inner.clone();
        let buffer = Buffer { raw, bytes, place, allocation: Mutex::new(None), inner, _counted: counted };
        // SAFETY: the buffer was just made on this device.
        let requirements = unsafe { device.get_buffer_memory_requirements(raw) };
        let location = match place {
            Place::Device => MemoryLocation::GpuOnly,
            Place::Upload => MemoryLocation::CpuToGpu,
            Place::Readback => MemoryLocation::GpuToCpu,
        };
        let allocation = self
            .inner
            .allocator
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .allocate(&AllocationCreateDesc {
                name,
                requirements,
                location,
                linear: true,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            })
            .map_err(|error| {
                Error::device(format!("no memory for buffer `{name}` of {bytes} bytes: {error}"))
                    .help("use smaller meshes, textures or pictures, or another --device")
            })?;
        if self.inner.info.kind == DeviceType::Cpu {
            huge_pages::advise(&allocation);
        }
        // SAFETY: the allocation fits the requirements of this buffer, and nothing is bound to it yet.
        let bound = unsafe { device.bind_buffer_memory(raw, allocation.memory(), allocation.offset()) };
        *buffer.allocation() = Some(allocation);
        if place == Place::Device {
            self.inner.on_device.fetch_add(bytes, Ordering::Relaxed);
        }
        let now = self.inner.allocated.fetch_add(bytes, Ordering::Relaxed) + bytes;
        self.inner.allocated_peak.fetch_max(now, Ordering::Relaxed);
        check(bound, &format!("bind memory to buffer `{name}`"))?;
        Ok(Arc::new(buffer))
    }

    /// Makes a buffer on the device that holds `words`; at least one word long.
    ///
    /// # Errors
    ///
    /// As [`Gpu::buffer`], or when copying fails.
    pub fn upload(&self, name: &str, words: &[u8]) -> Result<Arc<Buffer>> {
        self.upload_parts(name, words.len() as u64, |write| write(0, words))
    }

    /// Makes a buffer of `bytes` on the device, whose parts are written one after the other: `parts` tells the byte at which each begins, and
    /// what is in it.
    ///
    /// # Errors
    ///
    /// As [`Gpu::buffer`], when copying fails, when a part is not within the buffer, and those of `parts`.
    pub fn upload_parts(
        &self,
        name: &str,
        bytes: u64,
        parts: impl FnOnce(&mut dyn FnMut(u64, &[u8]) -> Result<()>) -> Result<()>,
    ) -> Result<Arc<Buffer>> {
        let buffer = self.buffer(name, bytes, Place::Device)?;
        parts(&mut |at, words| {
            let length = words.len() as u64;
            if at.checked_add(length).is_none_or(|end| end > bytes) {
                return Err(Error::device(format!("{length} bytes at {at} are not within buffer `{name}`")));
            }
            if buffer.write_at(at, words) {
                return Ok(());
            }
            let staging = self.buffer(&format!("{name} (staging)"), length, Place::Upload)?;
            if !staging.write(words) {
                return Err(Error::device(format!("the driver does not map memory for buffer `{name}`")));
            }
            self.run(&[Command::Copy { from: &staging, to: &buffer, at, bytes: length }])
        })?;
        Ok(buffer)
    }
}

impl Buffer {
    /// Length in bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Whether the buffer was made by a device.
    pub(super) fn is_of(&self, device: &Arc<Inner>) -> bool {
        Arc::ptr_eq(&self.inner, device)
    }

    fn allocation(&self) -> MutexGuard<'_, Option<Allocation>> {
        self.allocation.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Where the host sees the buffer.
    #[cfg(test)]
    pub(super) fn mapped_address(&self) -> Option<usize> {
        self.allocation().as_ref().and_then(Allocation::mapped_ptr).map(|start| start.as_ptr() as usize)
    }

    /// Writes to the start of the buffer; false when the host does not see it, or it is shorter. The device must not be
    /// using it.
    pub fn write(&self, bytes: &[u8]) -> bool {
        self.write_at(0, bytes)
    }

    /// The same from a byte on.
    pub fn write_at(&self, at: u64, bytes: &[u8]) -> bool {
        let mut allocation = self.allocation();
        let memory = allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        let [own, at] = [self.bytes, at].map(|n| usize::try_from(n).unwrap_or(usize::MAX));
        let whole = memory.and_then(|memory| memory.get_mut(..own));
        let Some(target) = whole.and_then(|memory| memory.get_mut(at..)?.get_mut(..bytes.len())) else {
            return false;
        };
        target.copy_from_slice(bytes);
        true
    }

    /// Looks at the first `bytes` bytes. The device must not be writing.
    ///
    /// # Errors
    ///
    /// When there are fewer, they are no whole number of `u32`, or the host does not see them.
    pub fn read<T>(&self, bytes: u64, look: impl FnOnce(&[u32]) -> T) -> Result<T> {
        if bytes > self.bytes || !bytes.is_multiple_of(4) {
            return Err(Error::device(format!("{bytes} bytes of a buffer of {} cannot be read", self.bytes)));
        }
        let allocation = self.allocation();
        let mapped = allocation.as_ref().and_then(Allocation::mapped_slice);
        let part = mapped.and_then(|memory| memory.get(..usize::try_from(bytes).ok()?));
        let words = part.and_then(|part| bytemuck::try_cast_slice(part).ok());
        words.map(look).ok_or_else(|| Error::device("the driver does not map memory that the host reads"))
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: tickets and bindings keep the buffers that they use until the work is done.
        unsafe { self.inner.device.destroy_buffer(self.raw, None) };
        if let Some(allocation) = self.allocation().take() {
            self.inner.allocated.fetch_sub(self.bytes, Ordering::Relaxed);
            if self.place == Place::Device {
                self.inner.on_device.fetch_sub(self.bytes, Ordering::Relaxed);
            }
            let mut allocator = self.inner.allocator.lock().unwrap_or_else(PoisonError::into_inner);
            // Freeing fails only for memory of another allocator.
            _ = allocator.free(allocation);
        }
    }
}
