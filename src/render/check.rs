//! All kernels of a tree of shaders, compiled and examined without a device.

use super::kernels::add_generated;
use crate::gpu::examine;
use crate::layout::{BINDINGS, Backend, Frame, Record as _};
use crate::prepare::variants;
use crate::shader::{CacheOptions, Compiler, KernelKey, Sources};
use crate::{Error, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// What was found in a tree of shaders.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Checked {
    /// Files of kernels.
    pub kernels: usize,
    /// Sets of switches that they were compiled with.
    pub variants: usize,
    /// What is wrong, by file and line, each once. Every error has a place with a file of the tree and, as far as they are known, line
    /// and column.
    pub errors: Vec<(Error, KernelKey)>,
    /// Files of the folder that no kernel can ask for, with the names that were perhaps meant.
    pub unused: Vec<(String, Option<String>)>,
}

/// What is wrong by file, line and message, with the first kernel in which it is.
type Found = BTreeMap<(PathBuf, u32, String), (Error, KernelKey)>;

/// A kernel to check.
struct Job<'a> {
    compiler: &'a Compiler,
    key: KernelKey,
    backend: Backend,
}

/// Compiles and examines all variants of the kernels, on as many threads as there are cores.
///
/// # Errors
///
/// None that is in the shaders: those are a result.
pub fn check_kernels(sources: &Sources, cache: &CacheOptions) -> Result<Checked> {
    let mut sets = Vec::new();
    for set in variants()? {
        let mut sources = sources.clone();
        add_generated(&mut sources, &set.texture_glsl)?;
        sets.push((Compiler::new(sources, cache.clone()), set.kernels));
    }
    let jobs: Vec<Job<'_>> = sets
        .iter()
        .flat_map(|(compiler, variants)| {
            variants.iter().map(move |variant| {
                let defines = variant.defines.clone();
                let key = KernelKey { defines, ..KernelKey::new(variant.file) };
                Job { compiler, key, backend: variant.backend }
            })
        })
        .collect();
    let kernels: BTreeSet<_> = jobs.iter().map(|job| &job.key.file).collect();
    Ok(Checked {
        kernels: kernels.len(),
        variants: jobs.len(),
        errors: check_all(&jobs).into_values().collect(),
        unused: unused(sets.iter().map(|(compiler, _)| compiler.sources()), &kernels),
    })
}

fn check_all(jobs: &[Job<'_>]) -> Found {
    let next = AtomicUsize::new(0);
    let found = Mutex::new(Found::new());
    let work = || {
        while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
            let errors = job.errors();
            let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
            errors.into_iter().for_each(|error| keep(&mut found, error, &job.key));
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    found.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps an error, with the same kernel whichever thread comes first.
fn keep(found: &mut Found, error: Error, key: &KernelKey) {
    let (file, line) = error.place.as_ref().map_or_else(Default::default, |p| (p.file.clone(), p.line));
    let known = found.entry((file, line, error.message.clone())).or_insert_with(|| (error, key.clone()));
    if *key < known.1 {
        known.1.clone_from(key);
    }
}

impl Job<'_> {
    /// What is wrong with the kernel.
    fn errors(&self) -> Vec<Error> {
        let Self { compiler, key, backend } = self;
        let errors = compiler.kernel_or_errors(key).map_or_else(
            |errors| errors,
            |spirv| {
                // All that the examination depends on beside the kernel
                let table = format!("{backend:?} {BINDINGS:?} {}", Frame::WORDS);
                compiler.once(&spirv, &table, |spirv| examine(spirv, *backend)).err().into_iter().collect()
            },
        );
        errors.into_iter().map(|error| placed(error, compiler.sources(), key)).collect()
    }
}

/// The error with a place in a file, and a column where the line has the word that the compiler quotes.
fn placed(error: Error, sources: &Sources, key: &KernelKey) -> Error {
    let mut error = error.in_file(key.file.as_ref());
    if let Some(place) = &mut error.place
        && place.line > 0
        && place.column == 0
        && let Ok(text) = sources.read(&place.file.to_string_lossy())
        && let Some(line) = text.lines().nth(place.line as usize - 1)
    {
        place.column = column(line, &error.message).unwrap_or(0);
    }
    error
}

/// Column, counted from 1 in characters, of the word that a message quotes.
fn column(line: &str, message: &str) -> Option<u32> {
    let start = message.find(['\'', '`'])?;
    let quote = message[start..].chars().next()?;
    let (word, _) = message[start + 1..].split_once(quote)?;
    let in_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let whole = |at: usize| {
        let before = line[..at].chars().next_back();
        let after = line[at + word.len()..].chars().next();
        !(word.starts_with(in_word) && before.is_some_and(in_word)
            || word.ends_with(in_word) && after.is_some_and(in_word))
    };
    let at = line.match_indices(word).map(|(at, _)| at).find(|at| !word.is_empty() && whole(*at))?;
    u32::try_from(line[..at].chars().count() + 1).ok()
}

/// Files of the folder that stand for none of the program, and to which no kernel leads with any textures.
fn unused<'a>(
    trees: impl Iterator<Item = &'a Sources>,
    kernels: &BTreeSet<&String>,
) -> Vec<(String, Option<String>)> {
    let (mut strangers, mut reached) = (Vec::new(), BTreeSet::new());
    for tree in trees {
        strangers = tree.strangers();
        if strangers.is_empty() {
            return strangers;
        }
        let names = kernels.iter().flat_map(|file| tree.reachable(file));
        // A virtual file hides that of the folder
        reached.extend(names.filter(|name| !tree.is_virtual(name)));
    }
    strangers.retain(|(name, _)| !reached.contains(name));
    strangers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_column_is_that_of_the_whole_word() {
        let line = "\tvec3 ö_ab = ab + a.b; // ä";
        assert_eq!(column(line, "'ab': undeclared identifier"), Some(14));
        assert_eq!(column(line, "'a': bad"), Some(19));
        assert_eq!(column(line, "'+': wrong operand types"), Some(17));
        assert_eq!(column("#include \"base/gone.glsl\"", "cannot include `base/gone.glsl`: no"), Some(11));
        for message in ["'c': bad", "syntax error", "'", "''", "'': bad", "`a.b"] {
            assert_eq!(column(line, message), None, "{message}");
        }
    }
}
