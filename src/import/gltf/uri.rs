//! Where bytes outside of the document are: data URIs, and files in the folder of the model and below.

use super::json::Json;
use crate::Result;
use crate::import::file::{inside, read_bytes, shown};
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Padding may be there or not: both are in use.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The bytes that a URI names. A file is noted in `files`.
pub(super) fn read(uri: &Json<'_>, folder: &Path, files: &mut BTreeSet<PathBuf>) -> Result<Vec<u8>> {
    let text = uri.string()?;
    if let Some(data) = text.strip_prefix("data:") {
        return decode(uri, data);
    }
    let path = folder.join(relative(uri, text)?);
    files.insert(path.clone());
    read_bytes(&path).map_err(|error| uri.error(format!("{}: {}", shown(text.as_bytes()), error.message)))
}

fn decode(uri: &Json<'_>, data: &str) -> Result<Vec<u8>> {
    let Some((kind, body)) = data.split_once(',') else {
        return Err(uri.error("the data URI has no comma before its data"));
    };
    if !kind.ends_with(";base64") {
        return Ok(percent_decode_str(body).collect());
    }
    BASE64.decode(body.trim_ascii()).map_err(|error| uri.error(format!("the data URI is no base64: {error}")))
}

/// A file name that stays in the folder.
fn relative(uri: &Json<'_>, text: &str) -> Result<PathBuf> {
    let refuse = |why: &str| uri.error(format!("\"{}\" {why}", shown(text.as_bytes())));
    let name = percent_decode_str(text).decode_utf8().map_err(|_| refuse("is no text in UTF-8"))?;
    let scheme =
        name.split_once(':').is_some_and(|(scheme, _)| scheme.bytes().all(|b| b.is_ascii_alphanumeric()));
    if scheme {
        return Err(refuse("is no file name: only files beside the model are read"));
    }
    inside(&name)
        .ok_or_else(|| refuse("is not in the folder of the model or below it: other files are not read"))
}
