//! Pictures with the variance of their means: read from OpenEXR files, listed from `../shared/reference`.

use std::path::{Path, PathBuf};

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};

/// Means of the pixels, row by row from the top, and the variances of these means; red, green, blue.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    pub width: usize,
    pub height: usize,
    pub mean: Vec<[f64; 3]>,
    pub variance: Vec<[f64; 3]>,
}

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
    let (width, height, mean) = layer(&file(""), "")?;
    let (variance_width, variance_height, mut variance) = layer(&file("_var"), "")?;
    if (variance_width, variance_height) != (width, height) {
        return Err(format!("{name}: mean and variance differ in size"));
    }
    variance.iter_mut().flatten().for_each(|v| *v = v.max(0.0));
    let picture = Estimate { width, height, mean, variance };
    Ok(Reference { name: name.to_string(), systematic, picture })
}

/// A picture of dapple: its means, and its layer `variance`.
pub fn rendered(file: &Path) -> Result<Estimate, String> {
    let (width, height, mean) = layer(file, "")?;
    let (_, _, variance) = layer(file, "variance.")?;
    Ok(Estimate { width, height, mean, variance })
}

/// Width, height and pixels of the channels R, G and B with a prefix.
fn layer(file: &Path, prefix: &str) -> Result<(usize, usize, Vec<[f64; 3]>), String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(file)
        .map_err(|e| format!("{}: {e}", file.display()))?;
    let layer = image.layer_data;
    let mut pixels = vec![[0.0; 3]; layer.size.area()];
    for (c, name) in ["R", "G", "B"].iter().enumerate() {
        let name = format!("{prefix}{name}");
        let channel = layer.channel_data.list.iter().find(|channel| channel.name == *name.as_str());
        let channel = channel.ok_or_else(|| format!("{}: no channel {name}", file.display()))?;
        match &channel.sample_data {
            FlatSamples::F32(values) => {
                pixels.iter_mut().zip(values).for_each(|(p, &v)| p[c] = f64::from(v));
            }
            _ => return Err(format!("{}: {name} is not 32-bit float", file.display())),
        }
    }
    Ok((layer.size.width(), layer.size.height(), pixels))
}
