//! SPIR-V on disk, so that a kernel is compiled once a machine. Whatever goes wrong here costs time, never a render.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use super::compile::SPIRV_MAGIC;

/// First bytes of a cache file; the digit is the version of the format.
const FILE_MAGIC: &[u8; 8] = b"dapple 1";

/// A cache file above this size is damaged: the largest kernel is below a mebibyte.
const MAX_CACHE_FILE_BYTES: u64 = 64 << 20;

/// Where compiled kernels are kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CacheOptions {
    /// Nowhere.
    Off,
    /// In this folder, which is made when the first kernel is stored.
    Folder(PathBuf),
}

impl CacheOptions {
    /// `DAPPLE_CACHE=off` turns the cache off. Otherwise it is the folder `spirv` in `DAPPLE_CACHE_DIR` or, without
    /// that, in the folder that the platform gives to caches of `dapple` (`~/.cache/dapple` on Linux).
    pub fn from_environment() -> Self {
        Self::from_values(std::env::var_os("DAPPLE_CACHE"), std::env::var_os("DAPPLE_CACHE_DIR"))
    }

    fn from_values(switch: Option<OsString>, folder: Option<OsString>) -> Self {
        if switch.is_some_and(|s| s.eq_ignore_ascii_case("off")) {
            return Self::Off;
        }
        let root = folder.filter(|f| !f.is_empty()).map(PathBuf::from).or_else(|| {
            directories::ProjectDirs::from("", "", "dapple").map(|dirs| dirs.cache_dir().to_path_buf())
        });
        root.map_or(Self::Off, |root| Self::Folder(root.join("spirv")))
    }

    fn file(&self, key: &blake3::Hash) -> Option<PathBuf> {
        match self {
            Self::Off => None,
            Self::Folder(folder) => Some(folder.join(format!("{}.spv", key.to_hex()))),
        }
    }

    /// The words and the names of the files that went in; `None` when there is no sound file for the key.
    pub(super) fn load(&self, key: &blake3::Hash) -> Option<(Vec<u32>, BTreeSet<String>)> {
        let mut bytes = Vec::new();
        let file = std::fs::File::open(self.file(key)?).ok()?;
        file.take(MAX_CACHE_FILE_BYTES).read_to_end(&mut bytes).ok()?;
        let rest = bytes.strip_prefix(FILE_MAGIC)?;
        let (checksum, payload) = rest.split_at_checked(blake3::OUT_LEN)?;
        if checksum != self::checksum(key, payload).as_bytes().as_slice() {
            return None;
        }
        decode(payload)
    }

    /// True when the kernel was stored; false when there is no cache or it cannot be written.
    pub(super) fn store(&self, key: &blake3::Hash, words: &[u32], includes: &BTreeSet<String>) -> bool {
        let Some(path) = self.file(key) else { return false };
        let payload = encode(words, includes);
        write_atomically(&path, &[FILE_MAGIC, checksum(key, &payload).as_bytes(), &payload]).is_ok()
    }
}

/// A hash over texts that cannot be confused with the same letters cut in other places.
#[derive(Default)]
pub(super) struct KeyHasher(blake3::Hasher);

impl KeyHasher {
    pub(super) fn text(&mut self, text: &str) -> &mut Self {
        self.0.update(&(text.len() as u64).to_le_bytes());
        self.0.update(text.as_bytes());
        self
    }

    pub(super) fn word(&mut self, word: u32) {
        self.0.update(&word.to_le_bytes());
    }

    pub(super) fn finish(&self) -> blake3::Hash {
        self.0.finalize()
    }
}

fn checksum(key: &blake3::Hash, payload: &[u8]) -> blake3::Hash {
    blake3::Hasher::new().update(key.as_bytes()).update(payload).finalize()
}

/// Number of names, then each name with its length, then the words; all numbers are 32 bits, little-endian.
fn encode(words: &[u32], includes: &BTreeSet<String>) -> Vec<u8> {
    // Names are short and files few: the lengths fit.
    let number = |n: usize| (n as u32).to_le_bytes();
    let mut payload = number(includes.len()).to_vec();
    for name in includes {
        payload.extend(number(name.len()));
        payload.extend(name.as_bytes());
    }
    payload.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    payload
}

fn decode(payload: &[u8]) -> Option<(Vec<u32>, BTreeSet<String>)> {
    let (count, mut rest) = split_number(payload)?;
    let mut includes = BTreeSet::new();
    for _ in 0..count {
        let (length, after) = split_number(rest)?;
        let (name, after) = after.split_at_checked(usize::try_from(length).ok()?)?;
        includes.insert(std::str::from_utf8(name).ok()?.to_owned());
        rest = after;
    }
    let (words, odd) = rest.as_chunks::<4>();
    let words: Vec<u32> = words.iter().map(|w| u32::from_le_bytes(*w)).collect();
    (odd.is_empty() && words.first() == Some(&SPIRV_MAGIC)).then_some((words, includes))
}

fn split_number(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (number, rest) = bytes.split_first_chunk::<4>()?;
    Some((u32::from_le_bytes(*number), rest))
}

/// Another program that reads the file at any moment sees all of it or nothing.
fn write_atomically(path: &Path, parts: &[&[u8]]) -> std::io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    for part in parts {
        file.write_all(part)?;
    }
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> (blake3::Hash, Vec<u32>, BTreeSet<String>) {
        let includes = ["a.comp", "base/b.glsl"].map(str::to_owned).into();
        (blake3::hash(b"key"), vec![SPIRV_MAGIC, 1, 2, 3], includes)
    }

    #[test]
    fn environment_chooses_the_folder() {
        let of = |switch: Option<&str>, folder: Option<&str>| {
            CacheOptions::from_values(switch.map(OsString::from), folder.map(OsString::from))
        };
        assert_eq!(of(Some("off"), Some("/x")), CacheOptions::Off);
        assert_eq!(of(Some("OFF"), None), CacheOptions::Off);
        assert_eq!(of(Some("on"), Some("/x")), CacheOptions::Folder(Path::new("/x").join("spirv")));
        assert_eq!(of(None, Some("")), of(None, None));
    }

    #[test]
    fn a_kernel_comes_back_as_it_was_stored() {
        let folder = tempfile::tempdir().unwrap();
        let cache = CacheOptions::Folder(folder.path().join("new/spirv"));
        let (key, words, includes) = sample();
        assert_eq!(cache.load(&key), None);
        assert!(cache.store(&key, &words, &includes));
        assert_eq!(cache.load(&key), Some((words.clone(), includes.clone())));
        assert!(!CacheOptions::Off.store(&key, &words, &includes));
        assert_eq!(CacheOptions::Off.load(&key), None);
    }

    #[test]
    fn every_damaged_byte_and_every_cut_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let cache = CacheOptions::Folder(folder.path().to_path_buf());
        let (key, words, includes) = sample();
        assert!(cache.store(&key, &words, &includes));
        let path = cache.file(&key).unwrap();
        let sound = std::fs::read(&path).unwrap();
        for at in 0..sound.len() {
            let mut damaged = sound.clone();
            damaged[at] ^= 0x10;
            std::fs::write(&path, damaged).unwrap();
            assert_eq!(cache.load(&key), None, "byte {at}");
            std::fs::write(&path, &sound[..at]).unwrap();
            assert_eq!(cache.load(&key), None, "cut at {at}");
        }
        // A sound file under the name of another key.
        let other = blake3::hash(b"other");
        std::fs::write(cache.file(&other).unwrap(), sound).unwrap();
        assert_eq!(cache.load(&other), None);
    }

    #[test]
    fn a_payload_with_false_lengths_is_refused() {
        assert_eq!(decode(&[]), None);
        assert_eq!(decode(&[0xff; 4]), None);
        assert_eq!(decode(&[1, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, b'a']), None);
        assert_eq!(decode(&encode(&[], &BTreeSet::new())), None);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_no_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        let (key, words, includes) = sample();
        assert!(!CacheOptions::Folder(file.join("below")).store(&key, &words, &includes));
    }
}
