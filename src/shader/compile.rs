//! One kernel from GLSL to SPIR-V with glslang, in the process.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::Path;

use glslang::error::{GlslangError, GlslangErrorLog};
use glslang::{
    CompilerOptions, ShaderInput, ShaderMessage, ShaderSource, ShaderStage, SourceLanguage, SpirvVersion,
    Target, VulkanVersion,
};

use super::include::{Includes, Read};
use super::{Sources, log, stack};
use crate::{Error, Result};

/// The GLSL compiler with its version, as it stands in `Cargo.lock`. A part of the key of the disk cache.
pub(super) const COMPILER_ID: &str = "glslang 0.9.1, glslang-sys 0.9.2+e1b562a";

/// What stands in front of every kernel. Names of files in `#line` need the second extension, `texelFetch` without
/// a sampler the third.
const PROLOGUE: &str = "#version 460 core\n\
    #extension GL_GOOGLE_include_directive : require\n\
    #extension GL_GOOGLE_cpp_style_line_directive : require\n\
    #extension GL_EXT_samplerless_texture_functions : require\n";

/// SPIR-V starts with this word.
pub(super) const SPIRV_MAGIC: u32 = 0x0723_0203;

/// Which kernel: its file and what is defined in front of it.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct KernelKey {
    /// The name of the file, such as `stages/camera.comp`.
    pub file: String,
    /// Macros and their values.
    pub defines: BTreeMap<String, String>,
}

/// A compiled kernel. Only this room makes one, and nothing changes it: drivers trust what is in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spirv {
    pub(super) key: KernelKey,
    pub(super) words: Vec<u32>,
    pub(super) includes: BTreeSet<String>,
}

impl Spirv {
    /// What was compiled.
    pub fn key(&self) -> &KernelKey {
        &self.key
    }

    /// SPIR-V 1.3 for Vulkan 1.1. Entry point `main`.
    pub fn words(&self) -> &[u32] {
        &self.words
    }

    /// The names of every file that went in, the kernel's own among them.
    pub fn includes(&self) -> &BTreeSet<String> {
        &self.includes
    }
}

impl KernelKey {
    /// A kernel without defines.
    pub fn new(file: impl Into<String>) -> Self {
        Self { file: file.into(), defines: BTreeMap::new() }
    }

    /// Adds a macro.
    #[must_use]
    pub fn define(mut self, name: impl Into<String>, value: impl ToString) -> Self {
        self.defines.insert(name.into(), value.to_string());
        self
    }

    /// Everything that stands in front of the kernel's own text.
    pub(super) fn prologue(&self) -> Result<String> {
        let mut text = PROLOGUE.to_owned();
        for (name, value) in &self.defines {
            check_define(name, value)?;
            text.push_str(&format!("#define {name} {value}\n"));
        }
        Ok(text)
    }
}

impl fmt::Display for KernelKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        for (name, value) in &self.defines {
            write!(f, " {name}={value}")?;
        }
        Ok(())
    }
}

/// Compiles one kernel. A warning of the compiler is an error.
///
/// May be called from several threads at once.
///
/// # Errors
///
/// When a file is missing or cannot be read, or glslang refuses the code: with file and line.
pub fn compile(sources: &Sources, key: &KernelKey) -> Result<Spirv> {
    compile_with(&|name| sources.read(name), &|name| sources.is_virtual(name), key, Until::FirstError)
        .map_err(|errors| one_of(&errors, key))
}

/// One error for all that are wrong with a kernel.
pub(super) fn one_of(errors: &[Error], key: &KernelKey) -> Error {
    log::joined(errors).unwrap_or_else(|| unexplained(key))
}

fn unexplained(key: &KernelKey) -> Error {
    Error::device("glslang failed without saying why").in_file(Path::new(&key.file))
}

/// How far the compiler reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Until {
    /// To the first error.
    FirstError,
    /// To the end, or to the first error of syntax. Some of the errors may follow from others.
    TheEnd,
}

/// Compiles one kernel from the texts that `read` returns; `is_virtual` tells which belong to the scene.
///
/// # Errors
///
/// At least one.
pub(super) fn compile_with(
    read: Read<'_>,
    is_virtual: &(dyn Fn(&str) -> bool + Sync),
    key: &KernelKey,
    until: Until,
) -> Result<Spirv, Vec<Error>> {
    let prologue = key.prologue().map_err(|error| vec![error])?;
    let mut includes = Includes::new(read);
    let text = includes.take(&key.file).map_err(|error| vec![error])?;
    let source = format!("{prologue}#line 1 \"{}\"\n{text}\n", key.file);
    if source.contains('\0') {
        return Err(vec![Error::device("there is a zero byte in the text").in_file(Path::new(&key.file))]);
    }
    let outcome =
        stack::run("glslang", || run_glslang(source, &mut includes, until)).map_err(|error| vec![error])?;
    let log = match &outcome {
        Ok((_, log)) => log.as_str(),
        Err(Failure::Log(log)) => log.as_str(),
        Err(Failure::Other(error)) => return Err(vec![error.clone().in_file(Path::new(&key.file))]),
    };
    let errors = log::errors_of(log, &key.file, &includes.refused, &|name| {
        // A text of a scene may rename its lines to the user's own file, which is none of the tree.
        is_virtual(name) || !includes.files.contains(name)
    });
    if !errors.is_empty() {
        return Err(errors);
    }
    match outcome {
        Ok((words, _)) if words.first() == Some(&SPIRV_MAGIC) => {
            Ok(Spirv { key: key.clone(), words, includes: includes.files })
        }
        _ => Err(vec![unexplained(key)]),
    }
}

enum Failure {
    Log(String),
    Other(Error),
}

/// The words and the log, or the log that says why there are none.
fn run_glslang(
    source: String,
    includes: &mut Includes<'_>,
    until: Until,
) -> std::result::Result<(Vec<u32>, String), Failure> {
    let compiler = glslang::Compiler::acquire()
        .ok_or_else(|| Failure::Other(Error::device("glslang cannot be initialised")))?;
    let further = match until {
        Until::FirstError => ShaderMessage::empty(),
        Until::TheEnd => ShaderMessage::CASCADING_ERRORS,
    };
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        // Vulkan 1.1 although the device has 1.2: for SPIR-V 1.4 and later glslang writes copies of whole
        // structs with OpCopyLogical, which naga refuses.
        target: Target::Vulkan { version: VulkanVersion::Vulkan1_1, spirv_version: SpirvVersion::SPIRV1_3 },
        // Taken from the #version line of the prologue.
        version_profile: None,
        messages: ShaderMessage::DEFAULT | ShaderMessage::SPV_RULES | ShaderMessage::VULKAN_RULES | further,
    };
    let source = ShaderSource::from(source);
    let no_defines: Option<&[(&str, Option<&str>)]> = None;
    let input = ShaderInput::new(&source, ShaderStage::Compute, &options, no_defines, Some(includes))
        .map_err(failure)?;
    let shader = compiler.create_shader(input).map_err(failure)?;
    let words = shader.compile().map_err(failure)?;
    Ok((words, shader.get_log()))
}

fn failure(error: GlslangError) -> Failure {
    match error {
        GlslangError::PreprocessError(GlslangErrorLog { log, .. })
        | GlslangError::ParseError(GlslangErrorLog { log, .. })
        | GlslangError::MapIoError(GlslangErrorLog { log, .. })
        | GlslangError::LinkError(GlslangErrorLog { log, .. }) => Failure::Log(log),
        other => Failure::Other(Error::device(other.to_string())),
    }
}

/// A define must stay on its line and must not swallow what follows it.
fn check_define(name: &str, value: &str) -> Result<()> {
    let identifier = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && name.chars().next().is_some_and(|c| !c.is_ascii_digit());
    let reserved = name.contains("__") || name.starts_with("GL_");
    if !identifier || reserved {
        return Err(Error::device(format!("`{}` cannot be the name of a macro", name.escape_debug())));
    }
    let plain = value.chars().all(|c| (c.is_ascii_graphic() || c == ' ') && !matches!(c, '\\' | '"' | '#'));
    if !plain || value.contains("//") || value.contains("/*") {
        return Err(Error::device(format!("`{}` cannot be the value of macro {name}", value.escape_debug())));
    }
    Ok(())
}
