//! Every kind of kernel variant: compiles on both back ends, keeps to the table of bindings, is portable, and is valid.
#![allow(clippy::panic, clippy::unwrap_used, reason = "helpers of tests fail the test that called them")]

#[path = "../common/mod.rs"]
mod common;

mod cameras;
mod coats;
mod scenes;
mod switches;
mod tables;

use common::probe::{cache, sources};
use dapple::gpu::examine;
use dapple::layout::Backend;
use dapple::prepare::{self, Prepared, Stage, View};
use dapple::render;
use dapple::shader::{BindingClass, Compiler, Spirv, scan};
use std::collections::BTreeMap;
use std::io::Write as _;

use scenes::scenes;

/// Every kernel of every scene on a back end, each once.
fn kernels(backend: Backend) -> Vec<(String, Spirv)> {
    let mut found = BTreeMap::new();
    for (name, scene) in scenes() {
        let prepared: Prepared = prepare::prepare(&scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        let mut sources = sources().unwrap();
        render::add_generated(&mut sources, &prepared.texture_glsl).unwrap();
        let compiler = Compiler::new(sources, cache());
        for view in [None].into_iter().chain(View::ALL.map(Some)) {
            for stage in Stage::ALL {
                let key = render::key(&scene, &prepared, stage, view, backend);
                if view.is_some() && key == render::key(&scene, &prepared, stage, None, backend) {
                    continue;
                }
                let spirv = compiler.kernel(&key).unwrap_or_else(|e| panic!("{name}: {key}: {e}"));
                found.insert(spirv.words().to_vec(), (format!("{name}: {key}"), spirv));
            }
        }
    }
    let kernels: Vec<_> = found.into_values().collect();
    assert!(kernels.len() > 15, "{} kernels", kernels.len());
    kernels
}

#[test]
fn kernels_keep_to_the_table_and_those_that_read_storage_are_portable() {
    let mut views = 0;
    for backend in [Backend::Storage, Backend::Texel] {
        for (name, spirv) in kernels(backend) {
            examine(&spirv, backend).unwrap_or_else(|e| panic!("{name}: {e}"));
            let used = scan(spirv.words()).unwrap().bindings;
            assert!(!used.is_empty(), "{name}");
            views += used.values().filter(|class| **class == BindingClass::TexelBuffer).count();
        }
    }
    assert!(views > 20, "{views} texel buffers");
}

#[test]
fn spirv_val_accepts_every_kernel() {
    let tool = std::process::Command::new("spirv-val").arg("--version").output();
    if tool.is_err() {
        let text = "spirv-val is not installed (on Debian: apt-get install spirv-tools)";
        assert!(std::env::var_os("CI").is_none_or(|v| v != "true"), "{text}");
        eprintln!("SKIPPED: {text}");
        return;
    }
    for backend in [Backend::Storage, Backend::Texel] {
        for (name, spirv) in kernels(backend) {
            let mut file = tempfile::NamedTempFile::new().unwrap();
            file.write_all(bytemuck::cast_slice(spirv.words())).unwrap();
            let output = std::process::Command::new("spirv-val")
                .args(["--target-env", "vulkan1.2"])
                .arg(file.path())
                .output()
                .unwrap();
            let text = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{name}: {text}{}", String::from_utf8_lossy(&output.stdout));
        }
    }
}
