//! OBJ files with their materials, as models.

use super::file::{inside, read_bytes, shown};
use super::mtl::{self, Mtl};
use super::mtl_material::Maker;
use super::obj::{ObjFile, read_obj_file};
use super::text::suggest;
use super::{Model, ModelChoice};
use crate::scene::{Handle, Instance, Material, Mesh, Scene};
use crate::{Error, Result};
use glam::{Affine3A, Vec3};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

/// Reads an OBJ file with its materials into a scene, as one instance.
///
/// # Errors
/// Those of [`super::read_obj`]; what is wrong in a material file, with line and column; pictures that are not in the folder of the model; and
/// the choice of a variant, which no OBJ file has.
pub(super) fn read_obj_model(path: &Path, choice: &ModelChoice, scene: &mut Scene) -> Result<Model> {
    if let Some(variant) = &choice.variant {
        let message = format!("the model has no variant \"{}\"", shown(variant.as_bytes()));
        return Err(Error::scene(message).help("OBJ files have none").in_file(path));
    }
    let ObjFile { mut mesh, libraries, wears } = read_obj_file(path)?;
    let mut warnings = Vec::new();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut maker = Maker {
        scene,
        folder,
        path: path.to_path_buf(),
        size: longest_side(&mesh),
        colored: !mesh.colors.is_empty(),
        images: HashMap::new(),
    };
    let mut own_files = BTreeSet::new();
    let worn: BTreeSet<&str> = mesh
        .parts
        .iter()
        .zip(&wears)
        .filter(|(_, wears)| **wears)
        .map(|(part, _)| part.name.as_str())
        .collect();
    let mut known: BTreeMap<String, Handle<Material>> = BTreeMap::new();
    for (line, names) in &libraries {
        for name in files(folder, names) {
            let Some(file) = inside(&name.replace('\\', "/")) else {
                let name = shown(name.as_bytes());
                warnings.push(format!(
                    "line {line}: {name} is not in the folder of the model or below it, and is not read"
                ));
                continue;
            };
            maker.path = folder.join(file);
            own_files.insert(maker.path.clone());
            if !maker.path.exists() {
                warnings.push(format!("line {line}: there is no material file {}", shown(name.as_bytes())));
                continue;
            }
            let (materials, mut left_out) = mtl::parse(&maker.path, &read_bytes(&maker.path)?)?;
            warnings.append(&mut left_out);
            for material in materials.iter().filter(|material| worn.contains(material.name.as_str())) {
                known.insert(material.name.clone(), maker.material(material)?);
            }
        }
    }
    for name in worn.iter().filter(|name| !known.contains_key(**name)) {
        let help = suggest(name, known.keys().map(String::as_str), "materials");
        warnings.push(format!("no material is named `{}`, and it is grey; {help}", shown(name.as_bytes())));
    }
    let material = maker.material(&Mtl { name: "default material".into(), ..Mtl::default() })?;
    for (part, wears) in mesh.parts.iter_mut().zip(&wears) {
        part.material = Some(known.get(&part.name).copied().filter(|_| *wears).unwrap_or(material));
    }
    own_files.extend(maker.images.into_keys());
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mesh = scene.meshes.add(name.as_str(), mesh);
    let instance = Instance { name, mesh, material, world_from_object: Affine3A::IDENTITY, at_close: None };
    Ok(Model { instances: vec![instance], warnings, files: own_files, ..Model::default() })
}

/// The files of a `mtllib`: one whose name has blanks, or several.
fn files<'a>(folder: &Path, names: &'a str) -> Vec<&'a str> {
    let whole = inside(&names.replace('\\', "/")).is_some_and(|file| folder.join(file).exists());
    if whole { vec![names] } else { names.split_whitespace().collect() }
}

fn longest_side(mesh: &Mesh) -> f32 {
    let points = mesh.positions.iter();
    let (low, high) =
        points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    let side = (high - low).max_element();
    if side.is_finite() { side } else { 1.0 }
}
