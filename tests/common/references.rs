//! Converged pictures by other renderers, in `../shared/reference`.

use dapple::diff::{Estimate, read, read_variance};
use std::path::{Path, PathBuf};

/// A converged picture by another renderer.
#[derive(Debug, Clone)]
pub struct Reference {
    pub name: String,
    /// Relative difference that does not count: what the two renderers compute differently on purpose.
    pub systematic: f64,
    pub picture: Estimate,
}

/// The folder of the references, `None` with a notice when this machine lacks it.
///
/// An error when it is missing in CI (`CI=true`).
pub fn folder() -> Result<Option<PathBuf>, String> {
    let in_ci = std::env::var_os("CI").is_some_and(|v| v == "true");
    present(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference"), in_ci)
}

/// The folder if it exists. Otherwise a notice, or an error where it is `needed`, since no checks is no success.
pub fn present(folder: &Path, needed: bool) -> Result<Option<PathBuf>, String> {
    if folder.is_dir() {
        return Ok(Some(folder.to_path_buf()));
    }
    let text = format!("{} is missing: no comparison with other renderers", folder.display());
    if needed {
        return Err(text);
    }
    eprintln!("SKIPPED: {text}");
    Ok(None)
}

/// All references of the folder, by name.
pub fn all(folder: &Path) -> Result<Vec<Reference>, String> {
    let mut list = Vec::new();
    for renderer in ["mitsuba", "pbrt"] {
        let files = folder.join(renderer);
        let entries = files.read_dir().map_err(|e| format!("{}: {e}", files.display()))?;
        for entry in entries {
            let name = entry.map_err(|e| e.to_string())?.file_name().to_string_lossy().into_owned();
            if let Some(name) = name.strip_suffix("_var.exr") {
                list.push(reference(folder, renderer, name)?);
            }
        }
    }
    list.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(list)
}

/// One reference: `NAME.exr` and `NAME_var.exr` in the folder of its renderer, `pbrt` or `mitsuba`.
pub fn reference(folder: &Path, renderer: &str, name: &str) -> Result<Reference, String> {
    // pbrt turns RGB into spectra, which moves saturated colours; Mitsuba computed these in RGB
    let systematic = match renderer {
        "pbrt" => 0.015,
        "mitsuba" => 0.002,
        _ => return Err(format!("no references by `{renderer}`")),
    };
    let file = |suffix: &str| folder.join(renderer).join(format!("{name}{suffix}.exr"));
    let mut picture = read(&file("")).map_err(|error| error.to_string())?.estimate;
    picture.variance = read_variance(&file("_var")).map_err(|error| error.to_string())?;
    Ok(Reference { name: name.to_string(), systematic, picture })
}

/// A picture of dapple: its means, and its layer `variance`.
pub fn rendered(file: &Path) -> Result<Estimate, String> {
    let reading = read(file).map_err(|error| error.to_string())?;
    reading
        .noise_is_known
        .then_some(reading.estimate)
        .ok_or(format!("{}: no layer `variance`", file.display()))
}
