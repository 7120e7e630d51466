//! What a kernel expects of its host, read with naga, and the proof that the kernel is portable.

use std::error::Error as StdError;
use std::fmt;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, ArraySize, GlobalVariable, Handle, ImageClass, Module, Type, TypeInner};

use super::stack;
use crate::{Error, Result};

/// The library that validates, as it stands in `Cargo.lock`.
pub(super) const VALIDATOR_ID: &str = "naga 30.0.1";

/// The kind of a resource.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BindingClass {
    /// A storage buffer.
    Storage,
    /// A uniform buffer.
    Uniform,
    /// A buffer read through a format (`samplerBuffer`).
    TexelBuffer,
    /// A buffer read and written through a format (`imageBuffer`).
    StorageTexelBuffer,
    /// A sampled image without a sampler (`texture2D`).
    Texture,
    /// A sampled image with its sampler (`sampler2D`).
    CombinedTexture,
    /// An image that is read and written (`image2D`).
    StorageTexture,
    /// A sampler.
    Sampler,
}

impl fmt::Display for BindingClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Storage => "a storage buffer",
            Self::Uniform => "a uniform buffer",
            Self::TexelBuffer => "a texel buffer",
            Self::StorageTexelBuffer => "a texel buffer to write to",
            Self::Texture => "a texture",
            Self::CombinedTexture => "a texture with its sampler",
            Self::StorageTexture => "a texture to write to",
            Self::Sampler => "a sampler",
        })
    }
}

/// A resource that a kernel uses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReflectedBinding {
    /// Descriptor set.
    pub set: u32,
    /// Number in the set.
    pub binding: u32,
    /// Name of the variable or, when it has none, of its block.
    pub name: Option<String>,
    /// Kind of resource.
    pub class: BindingClass,
    /// Bytes from one element to the next of the array without a length at the end of a storage buffer.
    pub element_stride: Option<u32>,
    /// Bytes of a buffer in front of an array without a length, rounded up to the alignment of the block if there
    /// is no such array.
    pub size: Option<u32>,
}

/// What a kernel expects of its host.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reflection {
    /// Size of a workgroup.
    pub local_size: [u32; 3],
    /// The resources that the entry point uses, by set and binding.
    pub bindings: Vec<ReflectedBinding>,
}

/// Parses and validates a SPIR-V module of the storage-buffer variant and says what it expects.
///
/// # Errors
///
/// When naga cannot read the module or finds it invalid.
pub fn reflect(words: &[u32]) -> Result<Reflection> {
    stack::run("naga", || {
        let (module, info) = parse(words)?;
        reflection(&module, &info)
    })?
}

/// Translates a SPIR-V module to WGSL, reads the WGSL back, validates it, and returns it.
///
/// # Errors
///
/// When naga cannot read the module, write it as WGSL, or read that again.
pub fn translates_to_wgsl(words: &[u32]) -> Result<String> {
    stack::run("naga", || {
        let (module, info) = parse(words)?;
        wgsl(&module, &info)
    })?
}

/// [`reflect`] and [`translates_to_wgsl`] at once, which is quicker.
///
/// # Errors
///
/// Those of both.
pub fn reflect_portable(words: &[u32]) -> Result<Reflection> {
    stack::run("naga", || {
        let (module, info) = parse(words)?;
        let reflection = reflection(&module, &info)?;
        wgsl(&module, &info)?;
        Ok(reflection)
    })?
}

fn wgsl(module: &Module, info: &ModuleInfo) -> Result<String> {
    let flags = naga::back::wgsl::WriterFlags::empty();
    let text = naga::back::wgsl::write_string(module, info, flags)
        .map_err(|e| refusal("naga cannot write the kernel as WGSL", &e))?;
    let again = naga::front::wgsl::parse_str(&text)
        .map_err(|e| refusal("naga cannot read the WGSL that it wrote", &e))?;
    validate(&again)?;
    Ok(text)
}

fn parse(words: &[u32]) -> Result<(Module, ModuleInfo)> {
    let options = naga::front::spv::Options::default();
    let module = naga::front::spv::Frontend::new(words.iter().copied(), &options)
        .parse()
        .map_err(|e| refusal("naga cannot read the kernel", &e))?;
    let info = validate(&module)?;
    Ok((module, info))
}

fn validate(module: &Module) -> Result<ModuleInfo> {
    // No capability beyond what every WebGPU device has: of those that naga names, halves packed into a uint, which are
    // missing only on old OpenGL.
    Validator::new(ValidationFlags::all(), Capabilities::SHADER_FLOAT16_IN_FLOAT32)
        .validate(module)
        .map_err(|e| refusal("naga finds the kernel invalid", &e.into_inner()))
}

/// naga says what went wrong in general and names the cause only in the errors behind it.
fn refusal(what: &str, error: &dyn StdError) -> Error {
    let mut message = what.to_owned();
    let mut cause = Some(error);
    while let Some(error) = cause {
        message.push_str(&format!(": {error}"));
        cause = error.source();
    }
    Error::device(message)
}

fn reflection(module: &Module, info: &ModuleInfo) -> Result<Reflection> {
    let [entry] = module.entry_points.as_slice() else {
        return Err(Error::device(format!(
            "a kernel has one entry point, this one has {}",
            module.entry_points.len()
        )));
    };
    let uses = info.get_entry_point(0);
    let mut bindings = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        if let Some(at) = &variable.binding
            && !uses[handle].is_empty()
        {
            bindings.push(reflected(module, variable, at.group, at.binding)?);
        }
    }
    bindings.sort_by_key(|b| (b.set, b.binding));
    Ok(Reflection { local_size: entry.workgroup_size, bindings })
}

fn reflected(module: &Module, variable: &GlobalVariable, set: u32, binding: u32) -> Result<ReflectedBinding> {
    let ty = &module.types[variable.ty];
    let class = class(variable.space, &ty.inner).ok_or_else(|| {
        Error::device(format!("set {set}, binding {binding} is a kind of resource that dapple does not know"))
    })?;
    let (size, element_stride) = match class {
        BindingClass::Storage | BindingClass::Uniform => layout(module, variable.ty),
        _ => (None, None),
    };
    let named = |name: &Option<String>| name.clone().filter(|n| !n.is_empty());
    let name = named(&variable.name).or_else(|| named(&ty.name));
    Ok(ReflectedBinding { set, binding, name, class, element_stride, size })
}

fn class(space: AddressSpace, inner: &TypeInner) -> Option<BindingClass> {
    match (space, inner) {
        (AddressSpace::Storage { .. }, _) => Some(BindingClass::Storage),
        (AddressSpace::Uniform, _) => Some(BindingClass::Uniform),
        (_, TypeInner::Sampler { .. }) => Some(BindingClass::Sampler),
        (_, TypeInner::Image { class: ImageClass::Storage { .. }, .. }) => Some(BindingClass::StorageTexture),
        (_, TypeInner::Image { .. }) => Some(BindingClass::Texture),
        _ => None,
    }
}

/// Size and stride of a block. See [`ReflectedBinding`].
fn layout(module: &Module, ty: Handle<Type>) -> (Option<u32>, Option<u32>) {
    match &module.types[ty].inner {
        TypeInner::Struct { members, span } => match members.last() {
            Some(last) => match &module.types[last.ty].inner {
                TypeInner::Array { size: ArraySize::Dynamic, stride, .. } => {
                    (Some(last.offset), Some(*stride))
                }
                _ => (Some(*span), None),
            },
            None => (Some(*span), None),
        },
        TypeInner::Array { size: ArraySize::Dynamic, stride, .. } => (Some(0), Some(*stride)),
        inner => (inner.try_size(module.to_ctx()), None),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{KernelKey, Sources, compile, scan};
    use super::*;

    const TRACE: &str = "
        layout(local_size_x = 64) in;
        struct Path { vec4 origin; vec4 direction; };
        layout(std140, set = 0, binding = 0) uniform Frame { mat4 world_from_camera; uvec2 size; float time; } g_frame;
        layout(std430, set = 0, binding = 3) readonly buffer B { uvec4 b[]; };
        layout(std430, set = 0, binding = 2) buffer Paths { uint count; Path paths[]; } g_paths;
        layout(std430, set = 1, binding = 7) buffer Unused { float unused[]; };
        layout(set = 0, binding = 5) uniform texture2DArray g_pages;
        float never() { return unused[0]; }
        void main() {
            uint i = gl_GlobalInvocationID.x;
            ivec2 texel = ivec2(b[i].xy);
            Path path = g_paths.paths[i];
            path.origin = g_frame.world_from_camera * vec4(uintBitsToFloat(b[i].xyz), g_frame.time);
            path.direction += texelFetch(g_pages, ivec3(texel, 1), 0);
            g_paths.paths[atomicAdd(g_paths.count, 1u)] = path;
        }";

    fn words(text: &str) -> Vec<u32> {
        compile(&Sources::from_map([("a.comp", text)]).unwrap(), &KernelKey::new("a.comp")).unwrap().words
    }

    #[test]
    fn the_resources_in_use_are_reflected() {
        let reflection = reflect(&words(TRACE)).unwrap();
        assert_eq!(reflection.local_size, [64, 1, 1]);
        let binding = |binding, name: &str, class, element_stride, size| ReflectedBinding {
            set: 0,
            binding,
            name: Some(name.to_owned()),
            class,
            element_stride,
            size,
        };
        let expected = [
            binding(0, "g_frame", BindingClass::Uniform, None, Some(80)),
            binding(2, "g_paths", BindingClass::Storage, Some(32), Some(16)),
            binding(3, "B", BindingClass::Storage, Some(16), Some(0)),
            binding(5, "g_pages", BindingClass::Texture, None, None),
        ];
        assert_eq!(reflection.bindings, expected);
    }

    #[test]
    fn the_scan_agrees_with_naga() {
        let words = words(TRACE);
        let (scanned, reflected) = (scan(&words).unwrap(), reflect(&words).unwrap());
        assert_eq!(scanned.local_size, reflected.local_size);
        let reflected: Vec<_> = reflected.bindings.iter().map(|b| ((b.set, b.binding), b.class)).collect();
        assert_eq!(scanned.bindings.into_iter().collect::<Vec<_>>(), reflected);
    }

    #[test]
    fn a_kernel_translates_to_wgsl() {
        let text = translates_to_wgsl(&words(TRACE)).unwrap();
        assert!(text.contains("@compute @workgroup_size(64, 1, 1)"), "{text}");
    }

    #[test]
    fn texel_buffers_are_refused_with_a_reason() {
        let text = "layout(local_size_x = 64) in;
            layout(set = 0, binding = 1) uniform usamplerBuffer t;
            layout(std430, set = 0, binding = 0) buffer Out { uvec4 o[]; };
            void main() { o[0] = texelFetch(t, 1); }";
        let error = reflect(&words(text)).unwrap_err().to_string();
        assert!(error.starts_with("naga cannot read the kernel: "), "{error}");
    }

    #[test]
    fn a_panic_of_naga_is_an_error() {
        let text = "layout(local_size_x = 64) in;
            layout(std430, set = 0, binding = 0) buffer Out { uvec4 o[]; };
            void main() { atomicAdd(o[0].y, 1u); }";
        let error = translates_to_wgsl(&words(text)).unwrap_err().to_string();
        assert!(error.starts_with("naga "), "{error}");
    }

    #[test]
    fn words_that_are_no_module_are_an_error() {
        let sound = words(TRACE);
        for cut in [0, 1, 4, 5, 6, 20, sound.len() / 2, sound.len() - 1] {
            reflect(&sound[..cut]).unwrap_err();
        }
        reflect(&[7; 100]).unwrap_err();
    }
}
