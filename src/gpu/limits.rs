//! Whether a buffer fits the limits of a device, told before it is made.

use super::device::{DeviceInfo, DeviceType, Limits};
use crate::layout::{BINDINGS, BindingKind, WORD_BYTES};
use crate::{Error, Result};
use ash::vk;

/// What can be done about a buffer that does not fit.
const SMALLER: &str = "use fewer or smaller meshes, textures and pictures, or another --device";

/// Refuses a buffer that no kernel could see whole. A name of the table of bindings tells how it is bound; what only
/// reads may be texels or storage, so the longer of both counts until it is bound.
pub(super) fn check_buffer(limits: &Limits, device: &str, name: &str, bytes: u64) -> Result<()> {
    let storage = vk::DescriptorType::STORAGE_BUFFER;
    let texels = vk::DescriptorType::UNIFORM_TEXEL_BUFFER;
    match BINDINGS.iter().find(|binding| binding.name == name).map(|binding| binding.kind) {
        Some(BindingKind::Read) => check_range(limits, device, name, storage, bytes)
            .or_else(|_| check_range(limits, device, name, texels, bytes)),
        Some(BindingKind::ReadWrite | BindingKind::Uints) => {
            check_range(limits, device, name, storage, bytes)
        }
        Some(BindingKind::Uniform) | None => Ok(()),
    }
}

/// Refuses a buffer that is longer than a descriptor of a kind may be.
pub(super) fn check_range(
    limits: &Limits,
    device: &str,
    name: &str,
    kind: vk::DescriptorType,
    bytes: u64,
) -> Result<()> {
    let (limit, what) = match kind {
        vk::DescriptorType::UNIFORM_TEXEL_BUFFER => {
            (limits.texel_buffer_elements.saturating_mul(WORD_BYTES), "maxTexelBufferElements")
        }
        vk::DescriptorType::STORAGE_BUFFER => (limits.storage_buffer_bytes, "maxStorageBufferRange"),
        _ => return Ok(()),
    };
    if bytes <= limit {
        return Ok(());
    }
    Err(Error::device(format!(
        "`{name}` takes {bytes} bytes, but {what} of device `{device}` allows {limit}"
    ))
    .help(SMALLER))
}

/// Refuses a buffer for which a device has no memory left; `in_use` is what its other buffers take.
pub(super) fn check_memory(memory: u64, device: &str, name: &str, bytes: u64, in_use: u64) -> Result<()> {
    if in_use.checked_add(bytes).is_some_and(|sum| sum <= memory) {
        return Ok(());
    }
    Err(Error::device(format!(
        "`{name}` takes {bytes} bytes, but {in_use} of the {memory} bytes of memory of device `{device}` are in use"
    ))
    .help(SMALLER))
}

/// Bytes that all buffers of a device may take together.
///
/// A CPU device takes them from the memory of the machine, whatever it says of its heap: Mesa before 23 always says
/// 2 GiB.
pub(super) fn memory_of(info: &DeviceInfo) -> u64 {
    let heap = if info.limits.memory_bytes == 0 { u64::MAX } else { info.limits.memory_bytes };
    if info.kind != DeviceType::Cpu {
        return heap;
    }
    std::fs::read_to_string("/proc/meminfo").ok().and_then(|text| total_memory(&text)).unwrap_or(u64::MAX)
}

/// Bytes of memory as `/proc/meminfo` has them.
fn total_memory(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Those of lavapipe, a thousand times smaller.
    const SMALL: Limits = Limits {
        texel_buffer_elements: 131_072,
        storage_buffer_bytes: 131_072,
        storage_buffers: 32,
        workgroups: 65_535,
        memory_bytes: 2_097_152,
    };

    #[test]
    fn what_is_only_read_may_be_as_long_as_a_texel_buffer() {
        let whole = 131_072 * 16;
        check_buffer(&SMALL, "toy", "tree", whole).unwrap();
        let error = check_buffer(&SMALL, "toy", "tree", whole + 16).unwrap_err();
        assert_eq!(
            error.to_string(),
            "`tree` takes 2097168 bytes, but maxTexelBufferElements of device `toy` allows 2097152; use fewer \
             or smaller meshes, textures and pictures, or another --device"
        );
        // A device whose storage buffers are the longer ones
        let storage = Limits { storage_buffer_bytes: 1 << 32, ..SMALL };
        check_buffer(&storage, "toy", "tree", whole + 16).unwrap();
    }

    #[test]
    fn what_is_written_must_fit_a_storage_buffer() {
        for name in ["film", "rays", "parked", "values"] {
            check_buffer(&SMALL, "toy", name, 131_072).unwrap();
            let error = check_buffer(&SMALL, "toy", name, 131_088).unwrap_err().to_string();
            assert!(error.starts_with(&format!("`{name}` takes 131088 bytes, but maxStorageBufferRange")));
        }
        // What no kernel sees
        check_buffer(&SMALL, "toy", "film (host)", 1 << 40).unwrap();
    }

    #[test]
    fn all_buffers_together_must_fit_the_memory() {
        check_memory(1000, "toy", "texels", 400, 600).unwrap();
        let error = check_memory(1000, "toy", "texels", 401, 600).unwrap_err().to_string();
        assert!(error.starts_with(
            "`texels` takes 401 bytes, but 600 of the 1000 bytes of memory of device `toy` are in use; "
        ));
        check_memory(u64::MAX, "toy", "texels", u64::MAX, 1).unwrap_err();
    }

    #[test]
    fn the_memory_of_a_gpu_is_its_heap_and_that_of_a_cpu_the_machine() {
        let info = |kind| DeviceInfo {
            index: 0,
            name: "toy".into(),
            driver: String::new(),
            api: String::new(),
            kind,
            limits: SMALL,
            unfit: None,
        };
        assert_eq!(memory_of(&info(DeviceType::Discrete)), SMALL.memory_bytes);
        assert!(memory_of(&info(DeviceType::Cpu)) > SMALL.memory_bytes);
        assert_eq!(total_memory("MemTotal:       24612345 kB\nMemFree: 1 kB\n"), Some(24_612_345 * 1024));
        assert_eq!(total_memory("MemFree: 1 kB\n"), None);
    }

    #[test]
    fn the_device_refuses_before_it_allocates() {
        use crate::gpu::{DeviceChoice, Gpu, Place};
        let gpu = Gpu::open(&DeviceChoice::default()).unwrap();
        let too_long = gpu.info().limits.storage_buffer_bytes + 16;
        let error = gpu.buffer("rays", too_long, Place::Device).err().unwrap();
        assert!(error.message.contains("maxStorageBufferRange"), "{error}");
        let error = gpu.buffer("all memory", 1 << 60, Place::Device).err().unwrap();
        assert!(error.message.contains("bytes of memory of device"), "{error}");
        assert_eq!((gpu.allocated_bytes(), gpu.take_peak_bytes()), (0, 0));
    }
}
