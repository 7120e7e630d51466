//! Names of objects, each once.

use crate::scene::{Handle, Store};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// Names that are given.
#[derive(Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    /// The first number that may be free, by what it is put behind.
    next: BTreeMap<String, usize>,
}

impl Names {
    /// Takes a name; false when it is taken.
    pub fn take(&mut self, name: &str) -> bool {
        self.taken.insert(name.to_owned())
    }

    /// Takes the first name of `named` that is free, with numbers from `first` on or from where `key` was the last time. Names count as the
    /// same that are the same by `fold`.
    pub fn next(
        &mut self,
        key: &str,
        first: usize,
        named: impl Fn(usize) -> String,
        fold: impl Fn(&str) -> String,
    ) -> String {
        let mut number = self.next.get(key).map_or(first, |&next| next.max(first));
        loop {
            let name = named(number);
            number += 1;
            if self.taken.insert(fold(&name)) {
                self.next.insert(key.to_owned(), number);
                return name;
            }
        }
    }
}

/// The names of the objects of a store, and those that something refers to.
pub(super) struct Called<T> {
    names: Vec<String>,
    wanted: RefCell<BTreeSet<Handle<T>>>,
}

impl<T> Called<T> {
    pub fn new(store: &Store<T>, noun: &str) -> Self {
        Self { names: unique(store, noun), wanted: RefCell::default() }
    }

    /// The name of an object.
    pub fn name(&self, handle: Handle<T>) -> &str {
        &self.names[handle.index()]
    }

    /// The same, for what refers to the object.
    pub fn refer(&self, handle: Handle<T>) -> &str {
        self.wanted.borrow_mut().insert(handle);
        self.name(handle)
    }

    /// The first object that something refers to and `written` has not.
    pub fn next<U>(&self, written: &BTreeMap<Handle<T>, U>) -> Option<Handle<T>> {
        self.wanted.borrow().iter().find(|handle| !written.contains_key(handle)).copied()
    }
}

/// The names of the objects of a store: their own where nobody before has it, else with a number behind it. Objects without a name are
/// called by what they are.
fn unique<T>(store: &Store<T>, noun: &str) -> Vec<String> {
    let mut names = Names::default();
    // Each keeps its own where it can, so that all of these are taken
    store.iter().for_each(|(_, name, _)| _ = names.take(name));
    let mut given = BTreeSet::new();
    let unique = store.iter().map(|(handle, name, _)| {
        if !name.is_empty() && given.insert(name) {
            return name.to_owned();
        }
        let (stem, first) = if name.is_empty() { (noun, handle.index() + 1) } else { (name, 2) };
        names.next(stem, first, |number| format!("{stem} {number}"), str::to_owned)
    });
    unique.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_kept_where_they_can_be() {
        let mut store = Store::default();
        for name in ["red", "", "red", "red 2", "", "texture 2"] {
            store.add(name, ());
        }
        let names = ["red", "texture 3", "red 3", "red 2", "texture 5", "texture 2"];
        assert_eq!(unique(&store, "texture"), names);
    }
}
