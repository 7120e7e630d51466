//! The blob scene as files: `blob.toml` and `blob.ply`.

use super::blob;
use dapple::export::ply;
use dapple::{Error, Result, whole_file};
use std::path::Path;

const SCENE: &str = "\
# The benchmark scene `blob` of dapple, for any renderer. blob.ply is flat: it has no normals.

[film]
size = [512, 512]

[render]
spp = 16
max_depth = 5
russian_roulette = false

[camera]
position = [0, 1.2, 4.2]
target = [0, -0.1, 0]
fov = 45

[material.blob]
kind = \"diffuse\"
color = [0.6, 0.5, 0.4]

[material.ground]
kind = \"diffuse\"
color = 0.5

[mesh.blob]
file = \"blob.ply\"

[[instance]]
mesh = \"blob\"
material = \"blob\"

[[shape]]
kind = \"quad\"
origin = [-8, -1.25, 8]
edge_u = [16, 0, 0]
edge_v = [0, 0, -16]
material = \"ground\"

[[light]]
kind = \"quad\"
origin = [-1, 3.5, 0]
edge_u = [2, 0, 0]
edge_v = [0, 0, 2]
radiance = [12, 12, 11]

[environment]
color = [0.4, 0.45, 0.5]
";

/// Writes both files into a folder, which is made when it is missing.
pub(super) fn write(folder: &Path) -> Result<()> {
    let fail = |path: &Path, error: &std::io::Error| {
        Error::output(format!("cannot write: {error}"))
            .in_file(path)
            .help("choose another folder for --write-scene")
    };
    std::fs::create_dir_all(folder).map_err(|error| fail(folder, &error))?;
    for (name, bytes) in [("blob.ply", ply(&blob::mesh(7))), ("blob.toml", SCENE.as_bytes().to_vec())] {
        let path = folder.join(name);
        whole_file::write(&path, &bytes, true).map_err(|error| fail(&path, &error))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_are_the_built_in_scene() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path()).unwrap();
        let (read, warnings) = dapple::import::read_scene(&folder.path().join("blob.toml"), &[]).unwrap();
        assert!(warnings.is_empty(), "{warnings:?}");
        let built = super::super::scenes::blob_scene();
        let mesh = |scene: &dapple::scene::Scene| scene.meshes[scene.instances[0].mesh].clone();
        assert_eq!(mesh(&read).positions, mesh(&built).positions);
        assert_eq!(mesh(&read).triangles, mesh(&built).triangles);
        assert_eq!((&read.film, &read.render, &read.camera), (&built.film, &built.render, &built.camera));
        assert_eq!(read.environment, built.environment);
        assert_eq!(names(folder.path()), ["blob.ply", "blob.toml"]);
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_that_cannot_be_replaced_leaves_the_folder_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("blob.ply")).unwrap();
        let error = write(folder.path()).unwrap_err();
        assert_eq!(error.place.unwrap().file, folder.path().join("blob.ply"));
        assert_eq!(names(folder.path()), ["blob.ply"]);
    }
}
