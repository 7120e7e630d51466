//! Kernels on demand: from the disk cache where they are sound, else from glslang.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use super::cache::{CacheOptions, KeyHasher};
use super::compile::{COMPILER_ID, KernelKey, SPIRV_MAGIC, Spirv, Until, compile_with, one_of};
use super::graph::{IncludeGraph, reachable};
use super::reflect::VALIDATOR_ID;
use super::source::Sources;
use crate::{Error, Result};

/// Counts of a [`Compiler`] since it was made.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CompileStats {
    /// Kernels that came from the disk cache, or from memory.
    pub hits: u32,
    /// Kernels that were given to glslang, those with errors among them.
    pub misses: u32,
    /// Seconds spent on reading and hashing sources and on the cache.
    pub lookup_seconds: f64,
    /// Seconds spent in glslang.
    pub compile_seconds: f64,
}

/// Compiles kernels of one tree of sources, with a disk cache and a memory of what went into which.
///
/// [`Compiler::kernel`] may be called from several threads at once.
#[derive(Debug)]
pub struct Compiler {
    sources: Sources,
    cache: CacheOptions,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    stats: CompileStats,
    graph: IncludeGraph,
    /// What each kernel was when it was last asked for, and the hash of what it was made of.
    last: BTreeMap<KernelKey, (blake3::Hash, Spirv)>,
}

/// The texts that a kernel can need, read once: what is hashed is what is compiled, even while files change.
struct Snapshot(BTreeMap<String, Result<String>>);

impl Compiler {
    /// A compiler for these sources.
    pub fn new(sources: Sources, cache: CacheOptions) -> Self {
        Self { sources, cache, state: Mutex::default() }
    }

    /// The sources.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The sources, to replace virtual files.
    pub fn sources_mut(&mut self) -> &mut Sources {
        &mut self.sources
    }

    /// The kernel, compiled from the sources as they are now.
    ///
    /// # Errors
    ///
    /// When a file is missing or cannot be read, or glslang refuses the code: with file and line.
    pub fn kernel(&self, key: &KernelKey) -> Result<Spirv> {
        self.kernel_until(key, Until::FirstError).map_err(|errors| one_of(&errors, key))
    }

    /// As [`Self::kernel`], with every error that the compiler finds by reading on; some may follow from others.
    ///
    /// # Errors
    ///
    /// As [`Self::kernel`]: at least one.
    pub fn kernel_or_errors(&self, key: &KernelKey) -> Result<Spirv, Vec<Error>> {
        self.kernel_until(key, Until::TheEnd)
    }

    fn kernel_until(&self, key: &KernelKey, until: Until) -> Result<Spirv, Vec<Error>> {
        let started = Instant::now();
        let snapshot = Snapshot::take(&self.sources, &key.file);
        let hash = snapshot.hash(key).map_err(|error| vec![error])?;
        if let Some(spirv) = self.remembered(key, &hash, started) {
            return Ok(spirv);
        }
        if let Some((words, includes)) = self.cache.load(&hash) {
            let mut state = self.state();
            state.stats.hits += 1;
            state.stats.lookup_seconds += started.elapsed().as_secs_f64();
            state.graph.record(key, includes.clone());
            let spirv = Spirv { key: key.clone(), words, includes };
            state.last.insert(key.clone(), (hash, spirv.clone()));
            return Ok(spirv);
        }
        let looked_up = started.elapsed().as_secs_f64();
        let started = Instant::now();
        let read = |name: &str| snapshot.read(name).unwrap_or_else(|| self.sources.read(name));
        let outcome = compile_with(&read, &|name| self.sources.is_virtual(name), key, until);
        let compiled = started.elapsed().as_secs_f64();
        let started = Instant::now();
        if let Ok(spirv) = &outcome {
            // An include that the cheap scan does not see is not in the hash: such a kernel is never stored.
            if spirv.includes.iter().all(|name| snapshot.0.contains_key(name)) {
                self.cache.store(&hash, &spirv.words, &spirv.includes);
                self.state().last.insert(key.clone(), (hash, spirv.clone()));
            }
        }
        let mut state = self.state();
        state.stats.misses += 1;
        state.stats.compile_seconds += compiled;
        state.stats.lookup_seconds += looked_up + started.elapsed().as_secs_f64();
        // A kernel with an error depends on whatever it might have included, so that the edit that mends it counts.
        let files =
            outcome.as_ref().map_or_else(|_| snapshot.0.keys().cloned().collect(), |s| s.includes.clone());
        state.graph.record(key, files);
        outcome
    }

    /// The kernel, when it is what it was.
    fn remembered(&self, key: &KernelKey, hash: &blake3::Hash, started: Instant) -> Option<Spirv> {
        let mut state = self.state();
        let spirv = state.last.get(key).filter(|(made_of, _)| made_of == hash)?.1.clone();
        state.stats.hits += 1;
        state.stats.lookup_seconds += started.elapsed().as_secs_f64();
        state.graph.record(key, spirv.includes.clone());
        Some(spirv)
    }

    /// Runs a check of a kernel, unless the cache knows that it went well before. `what` tells checks apart, with all that they depend
    /// on beside the kernel.
    ///
    /// # Errors
    ///
    /// Those of the check.
    pub fn once(&self, spirv: &Spirv, what: &str, check: impl FnOnce(&Spirv) -> Result<()>) -> Result<()> {
        let mut hasher = KeyHasher::default();
        hasher.text("checked").text(VALIDATOR_ID).text(env!("CARGO_PKG_VERSION")).text(what);
        spirv.words.iter().for_each(|word| hasher.word(*word));
        let hash = hasher.finish();
        if self.cache.load(&hash).is_none() {
            check(spirv)?;
            // What is kept is that there is something
            self.cache.store(&hash, &[SPIRV_MAGIC], &BTreeSet::new());
        }
        Ok(())
    }

    /// The kernels asked for so far that need this file, in the order of their keys.
    pub fn dependents(&self, file: &str) -> Vec<KernelKey> {
        self.state().graph.dependents(file)
    }

    /// What was done so far.
    pub fn stats(&self) -> CompileStats {
        self.state().stats
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // Counts and names stay true if another thread panicked while it held the lock.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Snapshot {
    fn take(sources: &Sources, kernel: &str) -> Self {
        Self(reachable(kernel, |name| sources.read(name), |text| text.as_ref().ok().map(String::as_str)))
    }

    fn read(&self, name: &str) -> Option<Result<String>> {
        self.0.get(name).cloned()
    }

    fn hash(&self, key: &KernelKey) -> Result<blake3::Hash> {
        let mut hasher = KeyHasher::default();
        hasher.text(COMPILER_ID).text(env!("CARGO_PKG_VERSION")).text(&key.prologue()?).text(&key.file);
        for (name, text) in &self.0 {
            match text {
                Ok(text) => hasher.text(name).text("text").text(text),
                Err(_) => hasher.text(name).text("missing"),
            };
        }
        Ok(hasher.finish())
    }
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::*;

    const A: &str = "#include \"base/b.glsl\"\n#ifdef MORE\n#include \"more.glsl\"\n#endif\n\
        layout(local_size_x = 64) in;\n\
        layout(std430, set = 0, binding = 0) buffer Out { float g_out[]; };\n\
        void main() { g_out[0] = b(); }\n";

    struct Room {
        folder: tempfile::TempDir,
    }

    impl Room {
        fn new() -> Self {
            let room = Self { folder: tempfile::tempdir().unwrap() };
            std::fs::create_dir_all(room.shaders().join("base")).unwrap();
            room.write("a.comp", A);
            room.write("base/b.glsl", "float b() { return 1.0; }\n");
            room
        }

        fn shaders(&self) -> PathBuf {
            self.folder.path().join("shaders")
        }

        fn write(&self, name: &str, text: &str) {
            std::fs::write(self.shaders().join(name), text).unwrap();
        }

        fn cache(&self) -> PathBuf {
            self.folder.path().join("cache")
        }

        fn compiler(&self) -> Compiler {
            self.compiler_with(&self.cache())
        }

        fn compiler_with(&self, cache: &Path) -> Compiler {
            Compiler::new(
                Sources::any_folder(&self.shaders()).unwrap(),
                CacheOptions::Folder(cache.to_path_buf()),
            )
        }

        /// Asks a new compiler, as the next run of the program would: the kernel and whether it was in the cache.
        fn ask(&self, key: &KernelKey) -> (Spirv, bool) {
            let compiler = self.compiler();
            let spirv = compiler.kernel(key).unwrap();
            let stats = compiler.stats();
            assert_eq!(stats.hits + stats.misses, 1);
            (spirv, stats.hits == 1)
        }
    }

    #[test]
    fn the_second_run_gets_the_same_kernel_from_disk() {
        let room = Room::new();
        let key = KernelKey::new("a.comp").define("N", 3);
        let (first, hit) = room.ask(&key);
        assert!(!hit);
        let (second, hit) = room.ask(&key);
        assert!(hit);
        assert_eq!(first, second);
        assert_eq!(first.includes.len(), 2);
    }

    #[test]
    fn every_text_and_every_define_counts() {
        let room = Room::new();
        let key = KernelKey::new("a.comp");
        let (first, _) = room.ask(&key);
        assert!(!room.ask(&key.clone().define("N", 1)).1);
        assert!(!room.ask(&key.clone().define("N", 2)).1);
        room.write("base/b.glsl", "float b() { return 2.0; }\n");
        let (changed, hit) = room.ask(&key);
        assert!(!hit);
        assert_ne!(first.words, changed.words);
        // A file that only an inactive branch includes: not needed, but it may become so.
        room.write("more.glsl", "float more = 1.0;\n");
        assert!(!room.ask(&key).1);
        room.write("base/b.glsl", "float b() { return 1.0; }\n");
        std::fs::remove_file(room.shaders().join("more.glsl")).unwrap();
        let (back, hit) = room.ask(&key);
        assert!(hit);
        assert_eq!(first, back);
    }

    #[test]
    fn a_damaged_file_is_compiled_again_and_replaced() {
        let room = Room::new();
        let key = KernelKey::new("a.comp");
        let (first, _) = room.ask(&key);
        let stored = std::fs::read_dir(room.cache()).unwrap().next().unwrap().unwrap().path();
        std::fs::write(&stored, "damaged").unwrap();
        let (again, hit) = room.ask(&key);
        assert!(!hit);
        assert_eq!(first, again);
        assert!(room.ask(&key).1);
    }

    #[test]
    fn a_cache_that_cannot_be_written_costs_time_only() {
        let room = Room::new();
        let file = room.folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        for _ in 0..2 {
            let compiler = room.compiler_with(&file);
            compiler.kernel(&KernelKey::new("a.comp")).unwrap();
            assert_eq!(compiler.stats().misses, 1);
        }
    }

    #[test]
    fn an_include_that_the_scan_does_not_see_is_never_cached() {
        let room = Room::new();
        room.write("a.comp", &A.replace("#include \"base", "#/**/include \"base"));
        for _ in 0..2 {
            assert!(!room.ask(&KernelKey::new("a.comp")).1);
        }
    }

    #[test]
    fn dependents_follow_the_includes_also_of_a_kernel_with_an_error() {
        let room = Room::new();
        let (plain, more) = (KernelKey::new("a.comp"), KernelKey::new("a.comp").define("MORE", 1));
        for _ in 0..2 {
            let compiler = room.compiler();
            compiler.kernel(&plain).unwrap();
            assert_eq!(compiler.dependents("base/b.glsl"), std::slice::from_ref(&plain));
            assert!(compiler.dependents("more.glsl").is_empty());
            compiler.kernel(&more).unwrap_err();
            assert_eq!(compiler.dependents("base/b.glsl"), [plain.clone(), more.clone()]);
            assert_eq!(compiler.dependents("more.glsl"), std::slice::from_ref(&more));
        }
    }

    #[test]
    fn a_check_that_went_well_is_not_repeated() {
        let room = Room::new();
        let (spirv, _) = room.ask(&KernelKey::new("a.comp"));
        let check = |what: &str, outcome: Result<()>| {
            let mut ran = false;
            let told = room.compiler().once(&spirv, what, |_| {
                ran = true;
                outcome
            });
            (ran, told.is_ok())
        };
        let failure = || Err(crate::Error::device("bad"));
        assert_eq!(check("a", failure()), (true, false));
        assert_eq!(check("a", Ok(())), (true, true));
        assert_eq!(check("a", failure()), (false, true));
        assert_eq!(check("b", failure()), (true, false));
    }

    #[test]
    fn all_errors_are_found_by_reading_on() {
        let two = A.replace("g_out[0] = b();", "g_out[0] = first;\n g_out[1] = second;");
        let room = Room::new();
        room.write("a.comp", &two);
        room.write("base/b.glsl", "float b() { return third; }\n");
        let key = KernelKey::new("a.comp");
        let errors = room.compiler().kernel_or_errors(&key).unwrap_err();
        let told: Vec<_> = errors.iter().map(ToString::to_string).collect();
        let undeclared = |place: &str, name: &str| format!("{place}: '{name}': undeclared identifier");
        let expected = [("base/b.glsl:1", "third"), ("a.comp:7", "first"), ("a.comp:8", "second")];
        assert_eq!(told, expected.map(|(place, name)| undeclared(place, name)));
        assert_eq!(room.compiler().kernel(&key).unwrap_err().to_string(), told[0]);
    }

    #[test]
    fn a_virtual_file_can_be_replaced() {
        let mut compiler = Compiler::new(Sources::from_map([("a.comp", A)]).unwrap(), CacheOptions::Off);
        let key = KernelKey::new("a.comp");
        assert!(compiler.kernel(&key).is_err());
        compiler.sources_mut().set_virtual("base/b.glsl", "float b() { return 1.0; }").unwrap();
        compiler.kernel(&key).unwrap();
        assert!(compiler.sources().is_virtual("base/b.glsl"));
        assert_eq!(compiler.stats().misses, 2);
    }
}
