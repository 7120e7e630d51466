//! [`Scene`] → a scene file of dapple's own language, with the files that it names beside it.
//!
//! Every key is written with the value that reads back as the same number, and left out where it has the value of its default. Objects
//! come in the order of their stores, so that what is read again has the same handles. What nothing refers to is left out.

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

use crate::Result;
use crate::scene::{Handle, Image, Material, Mesh, Scene, Store, Texture};
use files::Files;
use keys::Keys;
use names::Called;
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
        textures: Called::new(&scene.textures, "texture"),
        materials: Called::new(&scene.materials, "material"),
        meshes: Called::new(&scene.meshes, "mesh"),
        images: BTreeMap::new(),
        files: Files::beside(path, replace)?,
    };
    let document = writer.document().map_err(|error| error.in_file(path))?;
    writer.files.finish(document.to_string().trim_start(), check)
}

/// A scene on its way to files.
struct Writer<'a> {
    scene: &'a Scene,
    textures: Called<Texture>,
    materials: Called<Material>,
    meshes: Called<Mesh>,
    /// Names of the files of pictures that are written already.
    images: BTreeMap<usize, String>,
    files: Files,
}

impl Writer<'_> {
    fn document(&mut self) -> Result<DocumentMut> {
        let scene = self.scene;
        let camera = self.camera()?;
        let shapes = listed(scene.shapes.iter().map(|shape| self.shape(shape)));
        let instances = listed(scene.instances.iter().map(|instance| self.instance(instance)));
        let lights = listed(scene.lights.iter().map(|light| self.light(light)));
        let environment = scene.environment.as_ref().map(|environment| self.environment(environment));
        // Each of these refers to what is behind it alone
        let meshes = self.named(&scene.meshes, |writer| &writer.meshes, Self::mesh)?;
        let materials = self.named(&scene.materials, |writer| &writer.materials, Self::material)?;
        let textures = self.named(&scene.textures, |writer| &writer.textures, Self::texture)?;
        let settings = |keys: Keys| Item::Table(keys.table());
        let tables = [
            ("film", settings(film::film(&scene.film))),
            ("render", settings(film::render(&scene.render))),
            ("camera", settings(camera)),
            ("texture", textures),
            ("material", materials),
            ("mesh", meshes),
            ("shape", shapes),
            ("instance", instances),
            ("light", lights),
        ];
        let mut document = DocumentMut::new();
        for (key, item) in tables {
            let is_empty = match &item {
                Item::Table(table) => table.is_empty(),
                Item::ArrayOfTables(list) => list.is_empty(),
                Item::None | Item::Value(_) => false,
            };
            if !is_empty {
                document.insert(key, item);
            }
        }
        // A table of no keys is an environment too
        if let Some(environment) = environment {
            document.insert("environment", settings(environment));
        }
        Ok(document)
    }

    /// The tables of those objects of a store that something refers to, themselves among it.
    fn named<T>(
        &mut self,
        store: &Store<T>,
        called: impl Fn(&Self) -> &Called<T>,
        keys: impl Fn(&mut Self, Handle<T>, &T) -> Result<Keys>,
    ) -> Result<Item> {
        let mut written = BTreeMap::new();
        while let Some(handle) = called(self).next(&written) {
            written.insert(handle, keys(self, handle, &store[handle])?);
        }
        let mut all = Table::new();
        all.set_implicit(true);
        for (handle, keys) in written {
            all.insert(called(self).name(handle), Item::Table(keys.table()));
        }
        Ok(Item::Table(all))
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
}

fn listed(tables: impl Iterator<Item = Keys>) -> Item {
    Item::ArrayOfTables(tables.map(Keys::table).collect::<ArrayOfTables>())
}
