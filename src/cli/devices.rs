//! `dapple devices`.

use super::console::Console;
use dapple::Result;
use dapple::gpu::{self, DeviceInfo, DeviceType};
use serde_json::{Value, json};
use std::fmt::Write;

/// What the loader and Mesa's drivers look at.
const VARIABLES: [&str; 8] = [
    "VK_DRIVER_FILES",
    "VK_ICD_FILENAMES",
    "VK_ADD_DRIVER_FILES",
    "VK_LOADER_DEBUG",
    "VK_INSTANCE_LAYERS",
    "VK_LAYER_PATH",
    "LP_NUM_THREADS",
    "MESA_SHADER_CACHE_DIR",
];

/// Lists devices and variables. The variables come even when there is no driver: they may be the reason.
pub fn run(json: bool, console: &mut Console) -> Result<()> {
    let devices = gpu::devices(gpu::validation_from_environment());
    let set: Vec<(&str, String)> = VARIABLES
        .iter()
        .filter_map(|name| Some((*name, std::env::var_os(name)?.to_string_lossy().into_owned())))
        .collect();
    let list = devices.as_deref().unwrap_or_default();
    if json && devices.is_ok() {
        let variables: serde_json::Map<_, _> =
            set.into_iter().map(|(name, value)| (name.to_owned(), Value::from(value))).collect();
        let object = json!({
            "devices": list.iter().map(as_json).collect::<Vec<_>>(),
            "variables": variables,
        });
        console.result(&object.to_string());
    } else if !json {
        console.result(&as_text(list, &set));
    }
    devices.map(|_| ())
}

/// The kind of a device in a word.
pub fn kind_name(kind: DeviceType) -> &'static str {
    match kind {
        DeviceType::Discrete => "discrete GPU",
        DeviceType::Integrated => "integrated GPU",
        DeviceType::Virtual => "virtual GPU",
        DeviceType::Other => "other",
        DeviceType::Cpu => "CPU",
    }
}

fn as_json(info: &DeviceInfo) -> Value {
    json!({
        "index": info.index,
        "name": info.name,
        "type": kind_name(info.kind),
        "driver": info.driver,
        "vulkan": info.api,
        "limits": {
            "memory_bytes": info.limits.memory_bytes,
            "storage_buffer_bytes": info.limits.storage_buffer_bytes,
            "storage_buffers": info.limits.storage_buffers,
            "texel_buffer_elements": info.limits.texel_buffer_elements,
            "workgroups": info.limits.workgroups,
        },
        "unfit": info.unfit,
    })
}

fn as_text(devices: &[DeviceInfo], variables: &[(&str, String)]) -> String {
    let mut out = String::new();
    for info in devices {
        let limits = &info.limits;
        let rows = [
            ("type", kind_name(info.kind).to_owned()),
            ("driver", info.driver.clone()),
            ("Vulkan", info.api.clone()),
            ("memory", bytes_text(limits.memory_bytes)),
            (
                "storage buffer",
                format!("{}, {} a kernel", bytes_text(limits.storage_buffer_bytes), limits.storage_buffers),
            ),
            ("texel buffer", format!("{} texels", limits.texel_buffer_elements)),
            ("dispatch", format!("{} workgroups", limits.workgroups)),
        ];
        _ = writeln!(out, "{}: {}", info.index, info.name);
        for (name, value) in rows {
            _ = writeln!(out, "   {name:<15} {value}");
        }
        if let Some(why) = &info.unfit {
            _ = writeln!(out, "   cannot be used: {why}");
        }
    }
    _ = writeln!(out, "variables of the loader and of drivers:");
    for (name, value) in variables {
        _ = writeln!(out, "   {name}={value}");
    }
    if variables.is_empty() {
        _ = writeln!(out, "   none is set");
    }
    out.trim_end().to_owned()
}

/// Bytes in the unit that suits them.
pub fn bytes_text(bytes: u64) -> String {
    match bytes {
        0..10_240 => format!("{bytes} bytes"),
        10_240..10_485_760 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        _ => format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
    }
}
