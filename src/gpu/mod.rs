//! The device: all `unsafe` code and all of Vulkan are in this room.
//!
//! Vulkan 1.2 core and nothing vendor-specific. The loader is found at run time. What the rest of the program sees are
//! plain values: [`Gpu`], [`Buffer`], [`Pipeline`], [`Bindings`] and lists of [`Command`]s.

mod buffer;
mod census;
mod command;
mod device;
mod huge_pages;
mod instance;
mod limits;
mod pipeline;
mod table;

pub use buffer::{Buffer, Place};
pub use census::Alive;
pub use command::{Command, Ticket};
pub use device::{DeviceChoice, DeviceInfo, DeviceType, Gpu, Limits, choose, devices};
pub use instance::{late_messages, validation_from_environment};
pub use pipeline::{Bindings, Layout, Pipeline};
pub use table::examine;

use crate::{Error, Result};
use ash::vk;

/// Turns a Vulkan result into an error that says what was being done.
fn check<T>(result: ash::prelude::VkResult<T>, what: &str) -> Result<T> {
    result.map_err(|code| match code {
        vk::Result::ERROR_DEVICE_LOST => Error::device(format!("the device was lost: {what}")).help(
            "the driver reset it; try a smaller picture, look at the system log, or choose another --device",
        ),
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => Error::device(format!("out of device memory: {what}"))
            .help("use smaller meshes or textures, or another --device"),
        vk::Result::ERROR_OUT_OF_HOST_MEMORY => Error::device(format!("out of host memory: {what}")),
        code => Error::device(format!("{what}: Vulkan says {code:?}")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;

    #[test]
    fn results_of_vulkan_become_errors_with_a_next_step() {
        let lost = check::<()>(Err(vk::Result::ERROR_DEVICE_LOST), "wait for the device").unwrap_err();
        assert_eq!(lost.kind, ErrorKind::Device);
        assert_eq!(lost.message, "the device was lost: wait for the device");
        assert!(lost.help.unwrap().contains("choose another --device"));
        let full = check::<()>(Err(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY), "make buffer `a`").unwrap_err();
        assert_eq!(full.message, "out of device memory: make buffer `a`");
        assert!(full.help.is_some());
        let other = check::<()>(Err(vk::Result::ERROR_FRAGMENTED_POOL), "make a pool").unwrap_err();
        assert_eq!(other.message, "make a pool: Vulkan says ERROR_FRAGMENTED_POOL");
        assert_eq!(check(Ok(3), "count").unwrap(), 3);
    }
}
