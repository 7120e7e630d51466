//! `dapple --version`.

use super::console::Console;
use super::devices::kind_name;
use dapple::Result;
use dapple::gpu::{self, DeviceChoice};

/// The version, and the device that would be chosen; a machine without one still has a version.
pub fn run(console: &mut Console) -> Result<()> {
    console.result(concat!("dapple ", env!("CARGO_PKG_VERSION")));
    let choice = DeviceChoice { validation: gpu::validation_from_environment(), ..DeviceChoice::default() };
    let device = match gpu::choose(&choice) {
        Ok(info) => {
            format!("{} ({}), driver {}, Vulkan {}", info.name, kind_name(info.kind), info.driver, info.api)
        }
        Err(error) => error.message,
    };
    console.result(&format!("device: {device}"));
    Ok(())
}
