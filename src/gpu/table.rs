//! What a kernel may use of its host: the table of bindings, which it must keep to, and what every device can run.

use crate::layout::{BINDINGS, Backend, Binding, BindingKind, Frame, WORD_BYTES, WORKGROUP};
use crate::shader::{BindingClass, ReflectedBinding, Scan, Spirv, reflect_portable, scan};
use crate::{Error, Result};
use ash::vk;
use std::collections::BTreeMap;
use std::path::Path;

/// The descriptors of a binding: number and type.
pub(super) fn descriptors(binding: &Binding, backend: Backend) -> Vec<(u32, vk::DescriptorType)> {
    let storage = (binding.number, vk::DescriptorType::STORAGE_BUFFER);
    let texels = binding.view.map(|number| (number, vk::DescriptorType::UNIFORM_TEXEL_BUFFER));
    match (binding.kind, backend, texels) {
        (BindingKind::Uniform, ..) => vec![(binding.number, vk::DescriptorType::UNIFORM_BUFFER)],
        (BindingKind::Read, Backend::Texel, Some(texels)) => vec![texels],
        (BindingKind::ReadWrite, Backend::Texel, Some(texels)) => vec![storage, texels],
        _ => vec![storage],
    }
}

/// Compares what a kernel uses with the table.
pub(super) fn confirm(kernel: &Scan, backend: Backend) -> Result<()> {
    let [x, y, z] = kernel.local_size;
    if kernel.local_size != [WORKGROUP, 1, 1] {
        return Err(Error::device(format!("the workgroups are of {x} x {y} x {z}, not {WORKGROUP} x 1 x 1"))
            .help("leave `local_size_x` to the files that the kernel includes"));
    }
    for (&(set, number), &class) in &kernel.bindings {
        let known = BINDINGS.iter().flat_map(|binding| descriptors(binding, backend));
        let wanted =
            known.filter(|known| set == 0 && known.0 == number).map(|known| class_of(known.1)).next();
        let seen = format!("the kernel uses set {set}, binding {number} as {class}");
        let message = match wanted {
            Some(Some(wanted)) if wanted == class => continue,
            Some(Some(wanted)) => format!("{seen}, but it is {wanted}"),
            _ => format!("{seen}, but no such binding is bound"),
        };
        return Err(Error::device(message).help("use the names of shaders/shared/bindings.glsl alone"));
    }
    Ok(())
}

/// What a kernel may use a descriptor as.
fn class_of(kind: vk::DescriptorType) -> Option<BindingClass> {
    match kind {
        vk::DescriptorType::STORAGE_BUFFER => Some(BindingClass::Storage),
        vk::DescriptorType::UNIFORM_BUFFER => Some(BindingClass::Uniform),
        vk::DescriptorType::UNIFORM_TEXEL_BUFFER => Some(BindingClass::TexelBuffer),
        _ => None,
    }
}

/// What can be known of a kernel without a device: that it keeps to the table of bindings and, where it reads storage buffers, which
/// naga understands, that it is valid, portable, and has the layout of the records.
///
/// # Errors
///
/// What is wrong first, in the file of the kernel.
pub fn examine(spirv: &Spirv, backend: Backend) -> Result<()> {
    let examined = || {
        let scanned = scan(spirv.words())?;
        confirm(&scanned, backend)?;
        if backend == Backend::Storage {
            let reflection = reflect_portable(spirv.words())?;
            reflection.bindings.iter().try_for_each(confirm_layout)?;
            let reflected: BTreeMap<_, _> =
                reflection.bindings.iter().map(|b| ((b.set, b.binding), b.class)).collect();
            if (scanned.local_size, &scanned.bindings) != (reflection.local_size, &reflected) {
                return Err(Error::device("naga finds other resources in the kernel than its words say"));
            }
        }
        Ok(())
    };
    examined().map_err(|error| error.in_file(Path::new(&spirv.key().file)))
}

/// Compares what a kernel takes a buffer of the storage back end for with what is in it.
fn confirm_layout(used: &ReflectedBinding) -> Result<()> {
    let Some(row) = BINDINGS.iter().find(|row| row.number == used.binding) else { return Ok(()) };
    let word = WORD_BYTES as u32;
    let (what, wanted, seen) = match row.kind {
        BindingKind::Uniform => ("the bytes of the block", size_of::<Frame>() as u32, used.size),
        BindingKind::Uints => ("the bytes of an element", size_of::<u32>() as u32, used.element_stride),
        BindingKind::Read | BindingKind::ReadWrite => ("the bytes of a word", word, used.element_stride),
    };
    if seen == Some(wanted) {
        return Ok(());
    }
    let seen = seen.map_or_else(|| "unknown".to_owned(), |bytes| bytes.to_string());
    Err(Error::device(format!("of binding {} ({}), {what} are {seen}, not {wanted}", row.number, row.name))
        .help("leave the declarations of shaders/shared as they are"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shader::{KernelKey, Sources, compile};

    fn compiled(text: &str) -> Spirv {
        compile(&Sources::from_map([("a.comp", text)]).unwrap(), &KernelKey::new("a.comp")).unwrap()
    }

    /// What a kernel uses that has some lines in front of an empty `main`.
    fn kernel(size: u32, lines: &str) -> Scan {
        scan(compiled(&format!("layout(local_size_x = {size}) in;\n{lines}")).words()).unwrap()
    }

    fn texels(set: u32, number: u32) -> Scan {
        kernel(
            64,
            &format!(
                "layout(set = {set}, binding = {number}) uniform usamplerBuffer a;
                 layout(std430, set = 0, binding = 18) buffer B {{ uint b[]; }};
                 void main() {{ b[0] = texelFetch(a, 1).x; }}"
            ),
        )
    }

    #[test]
    fn kernels_keep_to_the_table() {
        // The nodes are binding 1, and 33 as texels.
        confirm(&texels(0, 33), Backend::Texel).unwrap();
        let refused = |scan: &Scan, backend| confirm(scan, backend).unwrap_err().to_string();
        let text = refused(&texels(0, 33), Backend::Storage);
        assert_eq!(
            text,
            "the kernel uses set 0, binding 33 as a texel buffer, but no such binding is bound; \
             use the names of shaders/shared/bindings.glsl alone"
        );
        assert!(refused(&texels(1, 33), Backend::Texel).contains("set 1, binding 33"));
        assert!(refused(&texels(0, 90), Backend::Texel).contains("no such binding"));
        let text = refused(&texels(0, 18 - 1), Backend::Texel);
        assert!(text.contains("binding 17 as a texel buffer, but it is a storage buffer"), "{text}");
        let text = refused(&kernel(32, "void main() {}"), Backend::Texel);
        assert!(text.starts_with("the workgroups are of 32 x 1 x 1, not 64 x 1 x 1"), "{text}");
    }

    #[test]
    fn kernels_with_another_layout_or_that_are_not_portable_are_refused() {
        let with = |declaration: &str, statement: &str| {
            let text = format!("layout(local_size_x = 64) in;\n{declaration}\nvoid main() {{ {statement} }}");
            examine(&compiled(&text), Backend::Storage).map_err(|error| error.to_string())
        };
        let words = |of: &str| format!("layout(std430, set = 0, binding = 14) buffer B {{ {of} b[]; }};");
        with(&words("uvec4"), "b[0] = uvec4(1u);").unwrap();
        let text = with(&words("uvec2"), "b[0] = uvec2(1u);").unwrap_err();
        assert!(
            text.starts_with("a.comp: of binding 14 (shadows), the bytes of a word are 8, not 16"),
            "{text}"
        );
        let frame = "layout(std140, set = 0, binding = 0) uniform F { uvec4 size; };\n";
        let text = with(&format!("{frame}{}", words("uvec4")), "b[0] = size;").unwrap_err();
        assert!(text.contains("of binding 0 (frame), the bytes of the block are 16, not "), "{text}");
        // WGSL has no atomics on a component of a vector
        let text = with(&words("uvec4"), "atomicAdd(b[0].y, 1u);").unwrap_err();
        assert!(text.starts_with("a.comp: naga "), "{text}");
    }
}
