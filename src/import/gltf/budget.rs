//! What a model may become in memory, in proportion to its file: a small file can name one accessor a million times.

use crate::{Error, Result};
use std::cell::Cell;

/// Bytes in memory for a byte of the file: quantised coordinates grow to the fourfold, and a mesh in several poses is stored
/// once for each.
const GROWTH: u64 = 64;
/// What every model may have beside that.
const ALLOWANCE: u64 = 64 << 20;

/// Bytes that are left.
pub(super) struct Budget {
    left: Cell<u64>,
    file: u64,
}

impl Budget {
    /// For a model whose file and buffers have so many bytes.
    pub fn of(file: u64) -> Self {
        Self { left: Cell::new(file.saturating_mul(GROWTH).saturating_add(ALLOWANCE)), file }
    }

    /// Takes the bytes of `count` things of `size` bytes each.
    pub fn take(&self, count: usize, size: usize) -> Result<()> {
        let bytes = (count as u64).saturating_mul(size as u64);
        let left = self.left.get().checked_sub(bytes).ok_or_else(|| {
            let file = self.file;
            Error::scene(format!("the model grows to more than {GROWTH} times its {file} bytes when it is read"))
                .help("a file that is so much smaller than what is in it is damaged or hostile; else cut it into parts")
        })?;
        self.left.set(left);
        Ok(())
    }
}
