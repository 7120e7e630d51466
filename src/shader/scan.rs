//! Reads the few facts that every SPIR-V kernel shows in its bare words. For what naga cannot read (texel buffers),
//! and as a second opinion on what it can.

use std::collections::{BTreeMap, BTreeSet};

use super::compile::SPIRV_MAGIC;
use super::reflect::BindingClass;
use crate::{Error, Result};

/// What [`scan`] finds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scan {
    /// Size of a workgroup.
    pub local_size: [u32; 3],
    /// Set, binding and class of each resource that code uses, in order.
    pub bindings: BTreeMap<(u32, u32), BindingClass>,
}

// Numbers from the SPIR-V specification, sections 3.32 (instructions), 3.6, 3.7, 3.8, 3.20.
const OP_EXECUTION_MODE: u32 = 16;
const OP_TYPE_IMAGE: u32 = 25;
const OP_TYPE_SAMPLER: u32 = 26;
const OP_TYPE_SAMPLED_IMAGE: u32 = 27;
const OP_TYPE_ARRAY: u32 = 28;
const OP_TYPE_RUNTIME_ARRAY: u32 = 29;
const OP_TYPE_POINTER: u32 = 32;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
const MODE_LOCAL_SIZE: u32 = 17;
const DECORATION_BINDING: u32 = 33;
const DECORATION_DESCRIPTOR_SET: u32 = 34;
const CLASS_UNIFORM_CONSTANT: u32 = 0;
const CLASS_UNIFORM: u32 = 2;
const CLASS_STORAGE_BUFFER: u32 = 12;
const DIM_BUFFER: u32 = 5;
const IMAGE_WITHOUT_SAMPLER: u32 = 2;

/// Words before the first instruction.
const HEADER_WORDS: usize = 5;

#[derive(Default)]
struct Module<'a> {
    local_size: Option<[u32; 3]>,
    /// Operands (without the result) of types, by their id.
    types: BTreeMap<u32, (u32, &'a [u32])>,
    /// Type and storage class by the id of a variable.
    variables: BTreeMap<u32, (u32, u32)>,
    sets: BTreeMap<u32, u32>,
    bindings: BTreeMap<u32, u32>,
    used: BTreeSet<u32>,
}

/// The size of the workgroup and the resources that code uses. Functions that nothing calls count as code; glslang
/// leaves them out.
///
/// # Errors
///
/// When the words are no SPIR-V, or are cut off.
pub fn scan(words: &[u32]) -> Result<Scan> {
    let broken = || Error::device("the SPIR-V is damaged");
    if words.first() != Some(&SPIRV_MAGIC) {
        return Err(broken());
    }
    let mut module = Module::default();
    let mut rest = words.get(HEADER_WORDS..).ok_or_else(broken)?;
    while let Some(first) = rest.first() {
        let (opcode, length) = (first & 0xffff, (first >> 16) as usize);
        let operands = rest.get(1..length).ok_or_else(broken)?;
        module.note(opcode, operands);
        rest = rest.get(length..).ok_or_else(broken)?;
    }
    let local_size =
        module.local_size.ok_or_else(|| Error::device("the SPIR-V has no size of a workgroup"))?;
    Ok(Scan { local_size, bindings: module.resources()? })
}

impl<'a> Module<'a> {
    fn note(&mut self, opcode: u32, operands: &'a [u32]) {
        match (opcode, operands) {
            (OP_EXECUTION_MODE, &[_, MODE_LOCAL_SIZE, x, y, z]) => self.local_size = Some([x, y, z]),
            (OP_DECORATE, &[id, DECORATION_BINDING, binding]) => {
                self.bindings.insert(id, binding);
            }
            (OP_DECORATE, &[id, DECORATION_DESCRIPTOR_SET, set]) => {
                self.sets.insert(id, set);
            }
            (OP_VARIABLE, &[ty, id, class, ..]) => {
                self.variables.insert(id, (ty, class));
            }
            (OP_TYPE_IMAGE..=OP_TYPE_POINTER, [id, of @ ..]) => {
                self.types.insert(*id, (opcode, of));
            }
            _ => self.used.extend(pointers(opcode, operands)),
        }
    }

    fn resources(&self) -> Result<BTreeMap<(u32, u32), BindingClass>> {
        let mut found = BTreeMap::new();
        for (id, binding) in self.bindings.iter().filter(|(id, _)| self.used.contains(id)) {
            let set = self.sets.get(id).copied().unwrap_or(0);
            let class = self.variables.get(id).and_then(|(ty, class)| self.class(*ty, *class));
            let class = class.ok_or_else(|| {
                Error::device(format!(
                    "set {set}, binding {binding} is a kind of resource that dapple does not know"
                ))
            })?;
            found.insert((set, *binding), class);
        }
        Ok(found)
    }

    fn class(&self, pointer: u32, storage_class: u32) -> Option<BindingClass> {
        match storage_class {
            CLASS_STORAGE_BUFFER => Some(BindingClass::Storage),
            CLASS_UNIFORM => Some(BindingClass::Uniform),
            CLASS_UNIFORM_CONSTANT => match *self.types.get(&pointer)? {
                (OP_TYPE_POINTER, &[_, ty]) => self.opaque_class(self.element(ty)?),
                _ => None,
            },
            _ => None,
        }
    }

    /// The type inside an array, or the type itself.
    fn element(&self, ty: u32) -> Option<u32> {
        match *self.types.get(&ty)? {
            (OP_TYPE_ARRAY | OP_TYPE_RUNTIME_ARRAY, [element, ..]) => Some(*element),
            _ => Some(ty),
        }
    }

    fn opaque_class(&self, ty: u32) -> Option<BindingClass> {
        match *self.types.get(&ty)? {
            (OP_TYPE_SAMPLER, _) => Some(BindingClass::Sampler),
            (OP_TYPE_SAMPLED_IMAGE, &[image]) => match self.opaque_class(image)? {
                BindingClass::Texture => Some(BindingClass::CombinedTexture),
                other => Some(other),
            },
            // Sampled type, dimension, depth, arrayed, multisampled, sampled, format.
            (OP_TYPE_IMAGE, &[_, dim, _, _, _, sampled, ..]) => {
                Some(match (dim == DIM_BUFFER, sampled == IMAGE_WITHOUT_SAMPLER) {
                    (true, false) => BindingClass::TexelBuffer,
                    (true, true) => BindingClass::StorageTexelBuffer,
                    (false, false) => BindingClass::Texture,
                    (false, true) => BindingClass::StorageTexture,
                })
            }
            _ => None,
        }
    }
}

/// The operands of an instruction that can be variables. Literals are left out, so that a number in the code is
/// never taken for the id of a variable.
fn pointers(opcode: u32, operands: &[u32]) -> &[u32] {
    let range = match opcode {
        // OpFunctionCall: type, result, function, then the arguments.
        57 => 3..operands.len(),
        // OpStore: pointer, value. OpCopyMemory: target, source.
        62 | 63 => 0..2,
        // OpAtomicStore, OpAtomicFlagClear: pointer first.
        228 | 319 => 0..1,
        // OpImageTexelPointer, OpLoad, OpAccessChain and its kin, OpArrayLength, OpCopyObject, OpAtomic...
        60 | 61 | 65..=68 | 70 | 83 | 227 | 229..=242 | 318 => 2..3,
        _ => 0..0,
    };
    operands.get(range).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{KernelKey, Sources, compile};
    use super::*;

    fn words(text: &str) -> Vec<u32> {
        compile(&Sources::from_map([("a.comp", text)]).unwrap(), &KernelKey::new("a.comp")).unwrap().words
    }

    const KINDS: &str = "
        layout(local_size_x = 8, local_size_y = 4) in;
        layout(set = 0, binding = 1) uniform usamplerBuffer g_nodes;
        layout(set = 0, binding = 2) uniform usamplerBuffer g_unused;
        layout(set = 0, binding = 3, r32ui) uniform uimageBuffer g_queue;
        layout(set = 0, binding = 4) uniform sampler2D g_picture;
        layout(set = 1, binding = 0) uniform texture2D g_pages[2];
        layout(set = 1, binding = 1) uniform sampler g_sampler;
        layout(set = 1, binding = 2, rgba32f) uniform image2D g_film;
        layout(std140, set = 2, binding = 0) uniform Frame { uvec4 g_size; };
        layout(std430, set = 0, binding = 0) buffer Out { uvec4 g_out[]; };
        layout(std430, set = 2, binding = 5) buffer Counted { uint g_counted[]; };
        uint count() { return atomicAdd(g_counted[0], 1u); }
        void main() {
            g_out[count()] = texelFetch(g_nodes, 1) + g_size;
            imageAtomicAdd(g_queue, 3, 2u);
            vec4 a = texelFetch(g_picture, ivec2(0), 0) + texelFetch(g_pages[1], ivec2(0), 0);
            imageStore(g_film, ivec2(1), a + textureLod(sampler2D(g_pages[0], g_sampler), vec2(0), 0.0));
        }";

    #[test]
    fn every_kind_of_resource_in_use_is_found() {
        use BindingClass::*;
        let scan = scan(&words(KINDS)).unwrap();
        assert_eq!(scan.local_size, [8, 4, 1]);
        let expected = [
            ((0, 0), Storage),
            ((0, 1), TexelBuffer),
            ((0, 3), StorageTexelBuffer),
            ((0, 4), CombinedTexture),
            ((1, 0), Texture),
            ((1, 1), Sampler),
            ((1, 2), StorageTexture),
            ((2, 0), Uniform),
            ((2, 5), Storage),
        ];
        assert_eq!(scan.bindings, BTreeMap::from(expected));
    }

    #[test]
    fn the_length_of_an_array_is_a_use() {
        let text = "layout(local_size_x = 64) in;
            layout(std430, set = 0, binding = 0) buffer In { uint i[]; } a;
            layout(std430, set = 0, binding = 1) buffer Out { uint o[]; } b;
            void main() { b.o[0] = a.i.length(); }";
        assert_eq!(scan(&words(text)).unwrap().bindings.len(), 2);
    }

    #[test]
    fn damaged_words_are_an_error() {
        let sound = words(KINDS);
        assert!(scan(&[]).is_err());
        assert!(scan(&sound[..5]).is_err());
        let mut without_length = sound.clone();
        without_length[5] &= 0xffff;
        assert!(scan(&without_length).is_err());
        // The module ends with OpReturnValue, two words, and OpFunctionEnd, one word.
        assert!(scan(&sound[..sound.len() - 2]).is_err());
    }

    proptest! {
        #[test]
        fn no_words_make_it_panic(at in 5usize..400, word: u32, more in proptest::collection::vec(any::<u32>(), 0..40)) {
            let mut damaged = words("layout(local_size_x = 64) in;
                layout(std430, set = 0, binding = 0) buffer Out { uint o[]; };
                void main() { o[1] = 2u; }");
            if let Some(slot) = damaged.get_mut(at) {
                *slot = word;
            }
            let _ = scan(&damaged);
            let mut random = vec![SPIRV_MAGIC];
            random.extend(more);
            let _ = scan(&random);
        }
    }
}
