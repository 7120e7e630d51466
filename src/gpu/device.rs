//! Choosing a device and opening it.

use super::census::Census;
use super::instance::{Instance, door, no_driver};
use super::pipeline::Pipelines;
use super::{check, limits};
use crate::{Error, Result};
use ash::vk;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use std::mem::ManuallyDrop;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

/// What kind of thing a device is, in the order in which dapple prefers them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum DeviceType {
    /// A GPU with memory of its own.
    Discrete,
    /// A GPU that shares the memory of the CPU.
    Integrated,
    /// A GPU seen through a virtual machine.
    Virtual,
    /// Anything else.
    Other,
    /// A driver that runs kernels on the CPU.
    Cpu,
}

/// The limits that dapple meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Most texels of a texel buffer.
    pub texel_buffer_elements: u64,
    /// Most bytes of a storage buffer.
    pub storage_buffer_bytes: u64,
    /// Most storage buffers of a kernel.
    pub storage_buffers: u32,
    /// Most workgroups of a dispatch.
    pub workgroups: u32,
    /// Bytes of the largest memory heap on the device.
    pub memory_bytes: u64,
}

/// A device as the driver describes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DeviceInfo {
    /// Position in the list of devices.
    pub index: usize,
    /// Name of the device.
    pub name: String,
    /// Name and version of the driver.
    pub driver: String,
    /// Vulkan version, such as `1.3.230`.
    pub api: String,
    /// Kind.
    pub kind: DeviceType,
    /// Limits.
    pub limits: Limits,
    /// Why dapple cannot use it; none = it can.
    pub unfit: Option<String>,
}

/// Which device to use.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct DeviceChoice {
    /// Its index, or a part of its name, ignoring case; none = the best.
    pub wanted: Option<String>,
    /// Refuse a CPU device.
    pub require_gpu: bool,
    /// Load the validation layer; any message of it then is an error of the work that caused it.
    pub validation: bool,
}

/// An open device with one compute queue.
pub struct Gpu {
    pub(super) inner: Arc<Inner>,
    pub(super) pipelines: Pipelines,
}

/// What buffers, pipelines and tickets keep alive.
pub(super) struct Inner {
    pub(super) device: ash::Device,
    pub(super) queue: Mutex<vk::Queue>,
    pub(super) queue_family: u32,
    pub(super) allocator: ManuallyDrop<Mutex<Allocator>>,
    pub(super) info: DeviceInfo,
    pub(super) instance: Arc<Instance>,
    /// Bytes that buffers on the device may take together, and those that they take.
    pub(super) memory: u64,
    pub(super) on_device: AtomicU64,
    pub(super) allocated: AtomicU64,
    pub(super) allocated_peak: AtomicU64,
    pub(super) census: Census,
}

/// All devices of this machine, in the order of the driver list; `validation` as in [`DeviceChoice`].
///
/// # Errors
///
/// When there is no loader or driver.
pub fn devices(validation: bool) -> Result<Vec<DeviceInfo>> {
    let instance = Instance::new(validation)?;
    Ok(candidates(&instance)?.into_iter().map(|(_, info)| info).collect())
}

/// The device that [`Gpu::open`] would open, without opening it.
///
/// # Errors
///
/// When there is no loader or driver, or no device fits the choice.
pub fn choose(choice: &DeviceChoice) -> Result<DeviceInfo> {
    let instance = Instance::new(choice.validation)?;
    Ok(pick(candidates(&instance)?, choice)?.1)
}

impl Gpu {
    /// Opens the chosen device.
    ///
    /// # Errors
    ///
    /// When there is no loader or driver, no device fits the choice, or the driver refuses.
    pub fn open(choice: &DeviceChoice) -> Result<Self> {
        let instance = Instance::new(choice.validation)?;
        let (physical, info) = pick(candidates(&instance)?, choice)?;
        let queue_family = compute_family(&instance, physical)
            .ok_or_else(|| Error::device(format!("device `{}` has no compute queue", info.name)))?;
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
        let create = vk::DeviceCreateInfo::default().queue_create_infos(&queues);
        let door = door();
        // SAFETY: `physical` is of this instance; `create` lives until the call returns.
        let device =
            check(unsafe { instance.raw.create_device(physical, &create, None) }, "open the device")?;
        drop(door);
        // SAFETY: the device was made with one queue of this family.
        let queue = unsafe { device.get_device_queue(queue_family, 0) };
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.raw.clone(),
            device: device.clone(),
            physical_device: physical,
            debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
            buffer_device_address: false,
            allocation_sizes: gpu_allocator::AllocationSizes::default(),
        })
        .map_err(|error| Error::device(format!("set up device memory: {error}")))?;
        Ok(Self {
            pipelines: Pipelines::default(),
            inner: Arc::new(Inner {
                device,
                queue: Mutex::new(queue),
                queue_family,
                memory: limits::memory_of(&info),
                on_device: AtomicU64::new(0),
                allocator: ManuallyDrop::new(Mutex::new(allocator)),
                info,
                instance,
                allocated: AtomicU64::new(0),
                allocated_peak: AtomicU64::new(0),
                census: Census::default(),
            }),
        })
    }

    /// What the driver says of the device.
    pub fn info(&self) -> &DeviceInfo {
        &self.inner.info
    }

    /// Bytes of the buffers that are alive.
    pub fn allocated_bytes(&self) -> u64 {
        self.inner.allocated.load(Ordering::Relaxed)
    }

    /// The most that [`Self::allocated_bytes`] was since this was last called, or since the device was opened.
    pub fn take_peak_bytes(&self) -> u64 {
        self.inner.allocated_peak.swap(self.allocated_bytes(), Ordering::Relaxed)
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        let _door = door();
        // SAFETY: everything made from the device holds an `Arc` of this, so nothing is in use; the allocator goes
        // first because it frees memory of the device, and is never touched again.
        unsafe {
            _ = self.device.device_wait_idle();
            ManuallyDrop::drop(&mut self.allocator);
            self.device.destroy_device(None);
        }
    }
}

fn candidates(instance: &Instance) -> Result<Vec<(vk::PhysicalDevice, DeviceInfo)>> {
    let _door = door();
    // SAFETY: the instance is alive.
    let physical = check(unsafe { instance.raw.enumerate_physical_devices() }, "list the devices")?;
    Ok(physical.into_iter().enumerate().map(|(i, p)| (p, describe(instance, p, i))).collect())
}

fn describe(instance: &Instance, physical: vk::PhysicalDevice, index: usize) -> DeviceInfo {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    // SAFETY: `physical` is of this instance; the driver structure is only filled in from Vulkan 1.2 on.
    let (base, memory) = unsafe {
        let base = instance.raw.get_physical_device_properties(physical);
        if base.api_version >= vk::API_VERSION_1_2 {
            let mut chain = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
            instance.raw.get_physical_device_properties2(physical, &mut chain);
        }
        (base, instance.raw.get_physical_device_memory_properties(physical))
    };
    let text = |s: Result<&std::ffi::CStr, _>| {
        s.map_or_else(|_| String::new(), |s| s.to_string_lossy().into_owned())
    };
    let version = base.api_version;
    let api = format!(
        "{}.{}.{}",
        vk::api_version_major(version),
        vk::api_version_minor(version),
        vk::api_version_patch(version)
    );
    let unfit = if version < vk::API_VERSION_1_2 {
        Some(format!("it has Vulkan {api}, dapple needs 1.2"))
    } else if compute_family(instance, physical).is_none() {
        Some("it has no compute queue".to_owned())
    } else {
        None
    };
    let heaps = memory.memory_heaps_as_slice().iter();
    let local = heaps.filter(|heap| heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL));
    DeviceInfo {
        index,
        name: text(base.device_name_as_c_str()),
        driver: format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str())),
        api,
        kind: match base.device_type {
            vk::PhysicalDeviceType::DISCRETE_GPU => DeviceType::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => DeviceType::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => DeviceType::Virtual,
            vk::PhysicalDeviceType::CPU => DeviceType::Cpu,
            _ => DeviceType::Other,
        },
        limits: Limits {
            texel_buffer_elements: u64::from(base.limits.max_texel_buffer_elements),
            storage_buffer_bytes: u64::from(base.limits.max_storage_buffer_range),
            storage_buffers: base.limits.max_per_stage_descriptor_storage_buffers,
            workgroups: base.limits.max_compute_work_group_count[0],
            memory_bytes: local.map(|heap| heap.size).max().unwrap_or(0),
        },
        unfit,
    }
}

fn compute_family(instance: &Instance, physical: vk::PhysicalDevice) -> Option<u32> {
    // SAFETY: `physical` is of this instance.
    let families = unsafe { instance.raw.get_physical_device_queue_family_properties(physical) };
    families.iter().position(|family| family.queue_flags.contains(vk::QueueFlags::COMPUTE)).map(|i| i as u32)
}

fn pick(
    all: Vec<(vk::PhysicalDevice, DeviceInfo)>,
    choice: &DeviceChoice,
) -> Result<(vk::PhysicalDevice, DeviceInfo)> {
    if all.is_empty() {
        return Err(no_driver());
    }
    let names: Vec<String> = all.iter().map(|(_, info)| format!("{}: {}", info.index, info.name)).collect();
    let matches = |info: &DeviceInfo| match &choice.wanted {
        None => true,
        Some(wanted) => match wanted.parse::<usize>() {
            Ok(index) => info.index == index,
            Err(_) => info.name.to_lowercase().contains(&wanted.to_lowercase()),
        },
    };
    let mut fit: Vec<_> = all.into_iter().filter(|(_, info)| matches(info)).collect();
    if fit.is_empty() {
        let wanted = choice.wanted.as_deref().unwrap_or_default();
        return Err(
            Error::device(format!("no device `{wanted}`")).help(format!("there are {}", names.join(", ")))
        );
    }
    if let [(_, only)] = fit.as_slice()
        && let Some(why) = &only.unfit
    {
        return Err(Error::device(format!("device `{}` cannot be used: {why}", only.name)));
    }
    fit.retain(|(_, info)| info.unfit.is_none());
    if choice.require_gpu {
        fit.retain(|(_, info)| info.kind != DeviceType::Cpu);
    }
    fit.sort_by_key(|(_, info)| (info.kind, info.index));
    fit.into_iter().next().ok_or_else(|| {
        Error::device("no fitting GPU on this machine")
            .help(format!("there are {}; leave out --require-gpu to use the CPU", names.join(", ")))
    })
}
