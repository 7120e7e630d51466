//! [`Scene`] → a scene file of dapple's own language, with the files that it names beside it.
//!
//! Every key is written with the value that reads back as the same number, and left out where it has the value of its default. Objects
//! come in the order of their stores, so that what is read again has the same handles.

mod camera;
mod files;
mod film;
mod keys;
mod lens;
mod light;
mod material;
mod mesh;
mod names;
mod noise;
mod pattern;
mod picture;
mod ply;
mod shape;
mod texture;

pub use files::Written;
pub use ply::ply;

use crate::scene::{Handle, Image, Material, Mesh, Scene, Texture};
use crate::{Error, Result};
use files::Files;
use keys::Keys;
use std::collections::BTreeMap;
use std::path::Path;
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table};

/// Writes a scene as the file `path`, whose name ends in `.toml`, and the meshes, pictures, lenses and textures in GLSL that it needs
/// into the folder `NAME_files` beside it. `check` gets the path of the scene before anything is moved to where it belongs, to read it back. What is
/// there already is replaced only with `replace`; files of other names stay in the folder.
///
/// # Errors
/// A name without `.toml`, files that are there or cannot be written, a scene with something that the language cannot say, and the
/// errors of `check`. Everything is then as before.
pub fn write_scene(
    scene: &Scene,
    path: &Path,
    replace: bool,
    check: &mut dyn FnMut(&Path) -> Result<()>,
) -> Result<Written> {
    let mut writer = Writer {
        scene,
        textures: names::unique(&scene.textures, "texture"),
        materials: names::unique(&scene.materials, "material"),
        meshes: names::unique(&scene.meshes, "mesh"),
        images: BTreeMap::new(),
        files: Files::beside(path, replace)?,
    };
    let document = writer.document().map_err(|error| error.in_file(path))?;
    writer.files.finish(document.to_string().trim_start(), check)
}

/// A scene on its way to files.
struct Writer<'a> {
    scene: &'a Scene,
    textures: Vec<String>,
    materials: Vec<String>,
    meshes: Vec<String>,
    /// Names of the files of pictures that are written already.
    images: BTreeMap<usize, String>,
    files: Files,
}

impl Writer<'_> {
    fn document(&mut self) -> Result<DocumentMut> {
        let scene = self.scene;
        let mut document = DocumentMut::new();
        let mut settings = |key: &str, keys: Keys| {
            if !keys.is_empty() {
                document.insert(key, Item::Table(keys.table()));
            }
        };
        settings("film", film::film(&scene.film));
        settings("render", film::render(&scene.render));
        settings("camera", self.camera()?);
        document.insert("texture", self.named(&scene.textures, Self::texture, |w, i| &w.textures[i])?);
        document.insert("material", self.named(&scene.materials, Self::material, |w, i| &w.materials[i])?);
        document.insert("mesh", self.named(&scene.meshes, Self::mesh, |w, i| &w.meshes[i])?);
        document.insert("shape", listed(scene.shapes.iter().map(|shape| self.shape(shape))));
        document.insert("instance", listed(scene.instances.iter().map(|instance| self.instance(instance))));
        document.insert("light", listed(scene.lights.iter().map(|light| self.light(light))));
        if let Some(environment) = &scene.environment {
            document.insert("environment", Item::Table(self.environment(environment).table()));
        }
        document.retain(|_, item| match item {
            Item::Table(table) => !table.is_empty(),
            Item::ArrayOfTables(list) => !list.is_empty(),
            _ => true,
        });
        Ok(document)
    }

    /// The tables of a store.
    fn named<T>(
        &mut self,
        store: &crate::scene::Store<T>,
        keys: impl Fn(&mut Self, Handle<T>, &T) -> Result<Keys>,
        name: impl for<'b> Fn(&'b Self, usize) -> &'b String,
    ) -> Result<Item> {
        let mut all = Table::new();
        all.set_implicit(true);
        for (handle, _, object) in store.iter() {
            let keys = keys(self, handle, object)?;
            all.insert(name(self, handle.index()), Item::Table(keys.table()));
        }
        Ok(Item::Table(all))
    }

    fn texture_name(&self, handle: Handle<Texture>) -> &str {
        &self.textures[handle.index()]
    }

    fn material_name(&self, handle: Handle<Material>) -> &str {
        &self.materials[handle.index()]
    }

    fn mesh_name(&self, handle: Handle<Mesh>) -> &str {
        &self.meshes[handle.index()]
    }

    /// The file of a picture, which is written when it is first asked for.
    fn image(&mut self, handle: Handle<Image>) -> Result<String> {
        if let Some(name) = self.images.get(&handle.index()) {
            return Ok(name.clone());
        }
        let path = Path::new(self.scene.images.name(handle));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let (extension, bytes) = picture::picture(&self.scene.images[handle])?;
        let name = self.files.add(&stem, "picture", extension, &bytes)?;
        self.images.insert(handle.index(), name.clone());
        Ok(name)
    }

    /// The error for what the language has no words for.
    fn unsaid(&self, what: impl Into<String>) -> Error {
        Error::output(what).help("change that in the scene that is converted")
    }
}

fn listed(tables: impl Iterator<Item = Keys>) -> Item {
    Item::ArrayOfTables(tables.map(Keys::table).collect::<ArrayOfTables>())
}
