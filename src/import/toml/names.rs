//! Named objects of the scene and who uses them.

use super::document::Spot;
use super::text::{shown, suggest};
use super::view::Item;
use crate::Result;
use crate::scene::Handle;
use std::cell::Cell;
use std::collections::BTreeMap;

/// The objects of one kind by name.
pub(super) struct Names<T> {
    /// What they are called, and more than one of them.
    nouns: [&'static str; 2],
    objects: BTreeMap<String, Named<T>>,
}

struct Named<T> {
    handle: Handle<T>,
    spot: Spot,
    used: Cell<bool>,
}

impl<T> Names<T> {
    pub fn new(nouns: [&'static str; 2]) -> Self {
        Self { nouns, objects: BTreeMap::new() }
    }

    pub fn add(&mut self, name: &str, spot: Spot, handle: Handle<T>) {
        self.objects.insert(name.to_owned(), Named { handle, spot, used: Cell::new(false) });
    }

    /// The object that a string names.
    pub fn find(&self, item: Item<'_>) -> Result<Handle<T>> {
        let name = item.string()?;
        self.get(name).ok_or_else(|| {
            let [noun, nouns] = self.nouns;
            let help = suggest(name, self.objects.keys().map(String::as_str), nouns);
            item.error(format!("no {noun} is named `{}`", shown(name))).help(help)
        })
    }

    /// The object of a name.
    pub fn get(&self, name: &str) -> Option<Handle<T>> {
        let object = self.objects.get(name)?;
        object.used.set(true);
        Some(object.handle)
    }

    /// Place and message for every object that nothing has asked for.
    pub fn unused(&self) -> impl Iterator<Item = (Spot, String)> {
        let unused = self.objects.iter().filter(|(_, object)| !object.used.get());
        unused.map(|(name, object)| {
            (object.spot, format!("nothing uses the {} `{}`", self.nouns[0], shown(name)))
        })
    }
}
