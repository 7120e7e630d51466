//! Huge pages for the memory of CPU devices. Traversal reads all over a tree, and each page that the processor does not
//! remember has to be looked up, which is dear in virtual machines.

use gpu_allocator::vulkan::Allocation;

/// Shorter memory has too few whole huge pages to matter.
#[cfg(target_os = "linux")]
const LEAST_BYTES: usize = 4 << 20;

/// Asks for huge pages in a memory block from its start to the end of `allocation`, before anything is written there.
/// Best effort: only Linux has this advice, and a kernel may refuse it.
pub(super) fn advise(allocation: &Allocation) {
    let (Some(mapped), Ok(offset), Ok(size)) =
        (allocation.mapped_ptr(), usize::try_from(allocation.offset()), usize::try_from(allocation.size()))
    else {
        return;
    };
    // The whole block is mapped at once, and the allocation begins at its offset in there.
    if let Some(start) = (mapped.as_ptr() as usize).checked_sub(offset) {
        advise_range(start, offset + size);
    }
}

#[cfg(target_os = "linux")]
fn advise_range(start: usize, bytes: usize) {
    let Some((start, bytes)) = whole_pages(start, bytes, rustix::param::page_size()) else { return };
    if bytes < LEAST_BYTES {
        return;
    }
    // SAFETY: the range is inside a mapped memory block that the allocator holds, and the advice changes no contents.
    _ = unsafe {
        rustix::mm::madvise(std::ptr::without_provenance_mut(start), bytes, rustix::mm::Advice::LinuxHugepage)
    };
}

#[cfg(not(target_os = "linux"))]
fn advise_range(_start: usize, _bytes: usize) {}

/// The whole pages of a range: start and bytes.
#[cfg_attr(not(target_os = "linux"), allow(dead_code, reason = "only Linux has the advice"))]
fn whole_pages(start: usize, bytes: usize, page: usize) -> Option<(usize, usize)> {
    let first = start.checked_next_multiple_of(page)?;
    let end = start.checked_add(bytes)? / page * page;
    end.checked_sub(first).filter(|bytes| *bytes > 0).map(|bytes| (first, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_pages_are_advised() {
        assert_eq!(whole_pages(4096, 8192, 4096), Some((4096, 8192)));
        assert_eq!(whole_pages(4100, 8192, 4096), Some((8192, 4096)));
        assert_eq!(whole_pages(4100, 4096, 4096), None);
        assert_eq!(whole_pages(0, 0, 4096), None);
        assert_eq!(whole_pages(usize::MAX - 1, 8192, 4096), None);
    }

    /// Whether the pages at an address are marked for huge pages; none when the kernel does not say.
    #[cfg(target_os = "linux")]
    fn is_advised(address: usize) -> Option<bool> {
        let maps = std::fs::read_to_string("/proc/self/smaps").ok()?;
        let mut inside = false;
        for line in maps.lines() {
            let range = line.split_whitespace().next().and_then(|word| word.split_once('-'));
            let hex = |text| usize::from_str_radix(text, 16).ok();
            if let Some((Some(start), Some(end))) = range.map(|(start, end)| (hex(start), hex(end))) {
                inside = (start..end).contains(&address);
            } else if inside && let Some(flags) = line.strip_prefix("VmFlags:") {
                return Some(flags.split_whitespace().any(|flag| flag == "hg"));
            }
        }
        None
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn long_buffers_of_a_cpu_device_are_advised() {
        use crate::gpu::{DeviceChoice, DeviceType, Gpu, Place};
        let gpu = Gpu::open(&DeviceChoice::default()).unwrap();
        let known = std::path::Path::new("/sys/kernel/mm/transparent_hugepage").exists();
        if gpu.info().kind != DeviceType::Cpu || !known {
            println!("nothing to test: no CPU device, or a kernel without huge pages");
            return;
        }
        let buffer = gpu.buffer("long", 16 << 20, Place::Device).unwrap();
        let middle = buffer.mapped_address().unwrap() + (8 << 20);
        assert_eq!(is_advised(middle), Some(true));
    }
}
