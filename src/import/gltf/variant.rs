//! KHR_materials_variants: which material a primitive has.

use super::document::{Document, index_into};
use super::primitive::Primitive;
use super::reader::Reader;
use crate::import::file::shown;
use crate::scene::{Handle, Material};
use crate::{Error, Result};

const EXTENSION: &str = "KHR_materials_variants";

/// The names of the variants of a model.
pub(super) fn names(document: &Document<'_>) -> Result<Vec<String>> {
    let Some(extension) = document.root.extension(EXTENSION)? else { return Ok(Vec::new()) };
    let variants = extension.need("variants")?.items()?;
    variants.iter().map(|variant| Ok(variant.need("name")?.string()?.to_owned())).collect()
}

/// The number of the variant of a name.
pub(super) fn find(document: &Document<'_>, name: &str) -> Result<usize> {
    let names = names(document)?;
    names.iter().position(|known| known == name).ok_or_else(|| {
        let list: Vec<_> = names.iter().map(|name| format!("\"{}\"", shown(name.as_bytes()))).collect();
        let help = if list.is_empty() {
            "the model has none".into()
        } else {
            format!("there are {}", list.join(", "))
        };
        Error::scene(format!("the model has no variant \"{}\"", shown(name.as_bytes()))).help(help)
    })
}

impl<'a> Reader<'a> {
    /// The material of a primitive: that of the variant, or else its own, or else the default of the specification.
    pub fn material_of(&mut self, primitive: &Primitive<'a>) -> Result<Handle<Material>> {
        let count = self.materials.len();
        let colored = primitive.attribute("COLOR_0").is_some();
        if let (Some(variant), Some(extension)) = (self.variant, primitive.json.extension(EXTENSION)?) {
            for mapping in extension.need("mappings")?.items()? {
                for number in mapping.need("variants")?.items()? {
                    if number.whole()? == variant {
                        let index = index_into(&mapping.need("material")?, "materials", count)?;
                        return self.material(Some(index), colored);
                    }
                }
            }
        }
        let own = primitive.json.get("material")?;
        let own = own.map(|reference| index_into(&reference, "materials", count)).transpose()?;
        self.material(own, colored)
    }
}
