//! The document as a whole: version, extensions, and the lists that its parts refer to by number.

use super::accessor::Accessor;
use super::budget::Budget;
use super::buffers::Buffers;
use super::container;
use super::json::Json;
use crate::import::file::{read_bytes, shown};
use crate::{Error, Result};
use glam::{Vec3, Vec4};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Extensions that are read in full, so that a file may require them.
const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// A file in memory.
pub(super) struct File {
    json: Value,
    binary: Option<Vec<u8>>,
    folder: PathBuf,
    bytes: u64,
}

impl File {
    /// Reads a `.gltf` or `.glb` file.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = read_bytes(path)?;
        let length = bytes.len() as u64;
        let container::Container { json, binary } = container::open(bytes)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(Self { json, binary, folder, bytes: length })
    }
}

/// A document whose outline has been checked, with its buffers.
pub(super) struct Document<'a> {
    pub root: Json<'a>,
    pub folder: &'a Path,
    /// Files that were read beside the document.
    pub files: BTreeSet<PathBuf>,
    pub buffers: Buffers,
    pub accessors: Vec<Accessor>,
    pub budget: Budget,
    /// Extensions that the file uses and that are not read, as warnings.
    pub left_out: Vec<String>,
}

impl<'a> Document<'a> {
    /// Checks version and extensions, and loads the buffers.
    pub fn open(file: &'a mut File) -> Result<Self> {
        let binary = file.binary.take();
        let root = Json::root(&file.json);
        check_version(&root)?;
        let left_out = check_extensions(&root)?;
        let mut files = BTreeSet::new();
        let buffers = Buffers::load(&root, binary, &file.folder, &mut files)?;
        let accessors = root
            .list("accessors")?
            .iter()
            .map(|json| Accessor::read(json, &buffers))
            .collect::<Result<_>>()?;
        let budget = Budget::of(file.bytes.saturating_add(buffers.len()));
        Ok(Self { root, folder: &file.folder, files, buffers, accessors, budget, left_out })
    }

    /// The accessor that a reference names, and its number.
    pub fn accessor(&self, reference: &Json<'_>) -> Result<(usize, &Accessor)> {
        let index = reference.whole()?;
        let accessor =
            self.accessors.get(index).ok_or_else(|| missing(reference, "accessors", self.accessors.len()))?;
        Ok((index, accessor))
    }

    /// The elements of the accessor that a reference names, as floats.
    pub fn floats<const N: usize>(&self, reference: &Json<'_>) -> Result<Vec<[f32; N]>> {
        self.accessor(reference)?.1.floats(&self.buffers, &self.budget)
    }

    /// Colours of vertices, or what a morph target adds to them: red, green and blue, and alpha or else `alpha`.
    pub fn colors(&self, reference: &Json<'_>, alpha: f32) -> Result<Vec<Vec4>> {
        if self.accessor(reference)?.1.width == 3 {
            let colors = self.floats::<3>(reference)?;
            return Ok(colors.into_iter().map(|color| Vec3::from(color).extend(alpha)).collect());
        }
        Ok(self.floats::<4>(reference)?.into_iter().map(Vec4::from).collect())
    }
}

/// The number of one of the objects of a list.
pub(super) fn index_into(reference: &Json<'_>, list: &str, count: usize) -> Result<usize> {
    let index = reference.whole()?;
    if index < count { Ok(index) } else { Err(missing(reference, list, count)) }
}

fn missing(reference: &Json<'_>, list: &str, count: usize) -> Error {
    match reference.whole() {
        Ok(index) => reference.error(format!("there is no /{list}/{index}, the file has {count}")),
        Err(error) => error,
    }
}

fn check_version(root: &Json<'_>) -> Result<()> {
    let asset = root.need("asset")?;
    let version = asset.need("version")?;
    let whole = |text: &str| {
        let (major, minor) = text.split_once('.')?;
        Some((major.parse::<u32>().ok()?, minor.parse::<u32>().ok()?))
    };
    match whole(version.string()?) {
        Some((2, _)) => {}
        Some((major, _)) => {
            return Err(version
                .error(format!("this is glTF {major}, must be glTF 2"))
                .help("convert the model to glTF 2.0"));
        }
        None => return Err(version.mismatch("a version such as \"2.0\"")),
    }
    match asset.get("minVersion")? {
        Some(least) if whole(least.string()?).is_none_or(|least| least > (2, 0)) => {
            Err(least.mismatch("at most \"2.0\""))
        }
        _ => Ok(()),
    }
}

/// Refuses what is required and not read; gives warnings of what else is not read.
fn check_extensions(root: &Json<'_>) -> Result<Vec<String>> {
    for required in root.list("extensionsRequired")? {
        let name = required.string()?;
        if !READ.contains(&name) {
            let message = format!(
                "the model requires the extension {}, which dapple does not read",
                shown(name.as_bytes())
            );
            return Err(required.error(message).help("export the model without it"));
        }
    }
    let mut left_out = Vec::new();
    for used in root.list("extensionsUsed")? {
        let name = used.string()?;
        if !READ.contains(&name) {
            left_out.push(format!("the extension {} is left out", shown(name.as_bytes())));
        }
    }
    Ok(left_out)
}
