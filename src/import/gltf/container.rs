//! The two forms of a file: JSON text, and GLB, which holds JSON and one buffer (glTF 2.0, chapter 4).

use crate::{Error, Result};
use serde_json::Value;

/// The document, and the buffer inside of a GLB file.
pub(super) struct Container {
    pub json: Value,
    pub binary: Option<Vec<u8>>,
}

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BINARY_CHUNK: u32 = 0x004e_4942;
/// Length of the header of a file, and of that of a chunk, in bytes.
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// Takes a file apart. Which form it has is told by its first bytes and not by its name.
pub(super) fn open(bytes: Vec<u8>) -> Result<Container> {
    if bytes.starts_with(MAGIC) {
        return open_glb(&bytes);
    }
    Ok(Container { json: parse(&bytes)?, binary: None })
}

fn open_glb(bytes: &[u8]) -> Result<Container> {
    let word = |at: usize| bytes.get(at..)?.first_chunk().map(|word| u32::from_le_bytes(*word));
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(damaged("the GLB file ends within its header"));
    };
    if version != 2 {
        return Err(Error::scene(format!("this is GLB of version {version}, must be of version 2"))
            .help("convert the model to glTF 2.0"));
    }
    let length = length as usize;
    if length > bytes.len() {
        return Err(damaged(format!(
            "the GLB header announces {length} bytes, the file has {}",
            bytes.len()
        )));
    }
    if length < HEADER + CHUNK_HEADER {
        return Err(damaged(format!("a GLB file of {length} bytes has no room for a chunk")));
    }
    let mut at = HEADER;
    let mut json = None;
    let mut binary = None;
    while at + CHUNK_HEADER <= length {
        let (Some(size), Some(kind)) = (word(at), word(at + 4)) else { break };
        let start = at + CHUNK_HEADER;
        let Some(data) =
            start.checked_add(size as usize).filter(|end| *end <= length).map(|end| &bytes[start..end])
        else {
            return Err(damaged(format!(
                "the chunk at byte {at} announces {size} bytes, more than are left"
            )));
        };
        match (kind, &json) {
            (JSON_CHUNK, None) => json = Some(parse(data)?),
            (_, None) => return Err(damaged("the first chunk of the GLB file is not its JSON")),
            (BINARY_CHUNK, Some(_)) if binary.is_none() => binary = Some(data.to_vec()),
            // Others are passed over, as the specification demands
            _ => {}
        }
        at = start + data.len();
    }
    let json = json.ok_or_else(|| damaged("the GLB file has no JSON"))?;
    Ok(Container { json, binary })
}

fn parse(bytes: &[u8]) -> Result<Value> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    serde_json::from_slice(text).map_err(|error| {
        Error::scene(format!("this is neither GLB nor JSON text: {error}"))
            .help("check that the file is complete, or export the model again")
    })
}

fn damaged(message: impl Into<String>) -> Error {
    Error::scene(message).help("check that the file is complete, or export the model again")
}
