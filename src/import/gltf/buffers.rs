//! Buffers and the views into them.

use super::json::Json;
use super::uri;
use crate::Result;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The bytes of a model, and which of them each view shows.
pub(super) struct Buffers {
    buffers: Vec<Vec<u8>>,
    views: Vec<View>,
}

/// A part of a buffer.
struct View {
    buffer: usize,
    range: Range<usize>,
    /// Distance between elements, if it is not their size.
    stride: Option<usize>,
}

/// What the specification allows as a stride.
const STRIDES: Range<usize> = 4..253;

impl Buffers {
    /// Loads all buffers and checks that all views lie in them. `binary` is what a GLB file brings along; files are noted in `files`.
    pub fn load(
        root: &Json<'_>,
        mut binary: Option<Vec<u8>>,
        folder: &Path,
        files: &mut BTreeSet<PathBuf>,
    ) -> Result<Self> {
        let mut buffers = Vec::new();
        for (i, buffer) in root.list("buffers")?.iter().enumerate() {
            let length = buffer.need("byteLength")?.whole()?;
            let mut bytes = match (buffer.get("uri")?, binary.take().filter(|_| i == 0)) {
                (Some(uri), _) => uri::read(&uri, folder, files)?,
                (None, Some(binary)) => binary,
                (None, None) => {
                    return Err(buffer.error("the buffer has no `uri`, and no part of a GLB file is meant"));
                }
            };
            if bytes.len() < length {
                let found = bytes.len();
                return Err(buffer.error(format!("`byteLength` announces {length} bytes, there are {found}")));
            }
            bytes.truncate(length);
            buffers.push(bytes);
        }
        let views =
            root.list("bufferViews")?.iter().map(|view| read_view(view, &buffers)).collect::<Result<_>>()?;
        Ok(Self { buffers, views })
    }

    /// Bytes of all buffers.
    pub fn len(&self) -> u64 {
        self.buffers.iter().map(|buffer| buffer.len() as u64).sum()
    }

    /// Number of the view that a reference names.
    pub fn view(&self, reference: &Json<'_>) -> Result<usize> {
        let view = reference.whole()?;
        if view < self.views.len() {
            return Ok(view);
        }
        Err(reference.error(format!("there is no /bufferViews/{view}, the file has {}", self.views.len())))
    }

    /// The bytes of a view.
    pub fn bytes(&self, view: usize) -> &[u8] {
        let view = &self.views[view];
        &self.buffers[view.buffer][view.range.clone()]
    }

    /// The distance between elements of a view, when it says so.
    pub fn stride(&self, view: usize) -> Option<usize> {
        self.views[view].stride
    }
}

fn read_view(view: &Json<'_>, buffers: &[Vec<u8>]) -> Result<View> {
    let reference = view.need("buffer")?;
    let buffer = reference.whole()?;
    let Some(bytes) = buffers.get(buffer) else {
        return Err(reference.error(format!("there is no /buffers/{buffer}, the file has {}", buffers.len())));
    };
    let (offset, length) = (view.whole_or("byteOffset", 0)?, view.need("byteLength")?.whole()?);
    let end = offset.checked_add(length).filter(|end| *end <= bytes.len());
    let Some(end) = end else {
        let has = bytes.len();
        return Err(view.error(format!(
            "{length} bytes from byte {offset} on are more than /buffers/{buffer} has, which are {has}"
        )));
    };
    let stride = view.get("byteStride")?.map(|stride| stride.whole().map(|n| (n, stride))).transpose()?;
    if let Some((n, stride)) = stride.as_ref().filter(|(n, _)| !STRIDES.contains(n)) {
        return Err(stride.error(format!("the stride is {n}, must be from 4 to 252")));
    }
    Ok(View { buffer, range: offset..end, stride: stride.map(|(n, _)| n) })
}
