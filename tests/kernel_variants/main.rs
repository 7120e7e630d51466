//! Every kind of kernel variant: compiles on both back ends, keeps to the table of bindings, is portable, and is valid.
#![allow(clippy::panic, clippy::unwrap_used, reason = "helpers of tests fail the test that called them")]

#[path = "../common/mod.rs"]
mod common;

mod cameras;
mod coats;
mod scenes;

use common::probe::{cache, sources};
use dapple::layout::{BINDINGS, Backend, Binding, BindingKind, WORKGROUP};
use dapple::prepare::{self, Prepared, Stage, View};
use dapple::render;
use dapple::shader::{BindingClass, Compiler, Reflection, Spirv, reflect, scan, translates_to_wgsl};
use std::collections::BTreeMap;
use std::io::Write as _;

use scenes::scenes;

/// Every kernel of every scene on a back end, each once.
fn kernels(backend: Backend) -> Vec<(String, Spirv)> {
    let mut found = BTreeMap::new();
    for (name, scene) in scenes() {
        let prepared: Prepared = prepare::prepare(&scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        let mut sources = sources().unwrap();
        sources.set_virtual("generated/textures.glsl", prepared.texture_glsl.as_str()).unwrap();
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

/// What a binding of the table may be reflected as: number and class.
fn allowed(binding: &Binding, backend: Backend) -> Vec<(u32, BindingClass)> {
    let storage = (binding.number, BindingClass::Storage);
    match (binding.kind, backend, binding.view) {
        (BindingKind::Uniform, ..) => vec![(binding.number, BindingClass::Uniform)],
        (BindingKind::Read, Backend::Texel, Some(view)) => vec![(view, BindingClass::TexelBuffer)],
        (BindingKind::ReadWrite, Backend::Texel, Some(view)) => {
            vec![storage, (view, BindingClass::TexelBuffer)]
        }
        _ => vec![storage],
    }
}

/// Fails for a binding that the table does not have; counts the others.
fn check_bindings(
    name: &str,
    bindings: impl Iterator<Item = (u32, u32, BindingClass)>,
    backend: Backend,
) -> usize {
    let table: BTreeMap<u32, BindingClass> = BINDINGS.iter().flat_map(|b| allowed(b, backend)).collect();
    let mut count = 0;
    for (set, number, class) in bindings {
        assert_eq!(set, 0, "{name}");
        assert_eq!(table.get(&number), Some(&class), "{name}: binding {number}");
        count += 1;
    }
    count
}

#[test]
fn storage_kernels_are_portable_and_keep_to_the_table() {
    for (name, spirv) in kernels(Backend::Storage) {
        let Reflection { local_size, bindings } =
            reflect(spirv.words()).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(local_size, [WORKGROUP, 1, 1], "{name}");
        let used = bindings.iter().map(|b| (b.set, b.binding, b.class));
        assert!(check_bindings(&name, used, Backend::Storage) > 0, "{name}");
        for binding in &bindings {
            let row = BINDINGS.iter().find(|b| b.number == binding.binding).unwrap();
            let stride = match row.kind {
                BindingKind::Uniform => None,
                BindingKind::Uints => Some(4),
                BindingKind::Read | BindingKind::ReadWrite => Some(16),
            };
            assert_eq!(binding.element_stride, stride, "{name}: {}", row.name);
            if row.kind == BindingKind::Uniform {
                assert_eq!(binding.size, Some(size_of::<dapple::layout::Frame>() as u32), "{name}");
            }
        }
        translates_to_wgsl(spirv.words()).unwrap_or_else(|e| panic!("{name}: {e}"));
        let scanned = scan(spirv.words()).unwrap();
        assert_eq!(scanned.local_size, local_size, "{name}");
        let reflected: BTreeMap<_, _> = bindings.iter().map(|b| ((b.set, b.binding), b.class)).collect();
        assert_eq!(scanned.bindings, reflected, "{name}");
    }
}

#[test]
fn texel_kernels_keep_to_the_table() {
    let mut views = 0;
    for (name, spirv) in kernels(Backend::Texel) {
        let scanned = scan(spirv.words()).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(scanned.local_size, [WORKGROUP, 1, 1], "{name}");
        let used = scanned.bindings.iter().map(|((set, binding), class)| (*set, *binding, *class));
        assert!(check_bindings(&name, used, Backend::Texel) > 0, "{name}");
        views += scanned.bindings.values().filter(|c| **c == BindingClass::TexelBuffer).count();
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
