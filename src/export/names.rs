//! Names of objects, each once.

use crate::scene::Store;
use std::collections::BTreeSet;

/// The names of the objects of a store: their own where nobody before has it, else with a number behind it. Objects without a name are
/// called by what they are.
pub(super) fn unique<T>(store: &Store<T>, noun: &str) -> Vec<String> {
    let mut taken: BTreeSet<String> = store.iter().map(|(_, name, _)| name.to_owned()).collect();
    let mut given = BTreeSet::new();
    let mut names = Vec::with_capacity(store.len());
    for (handle, name, _) in store.iter() {
        let own = !name.is_empty() && given.insert(name.to_owned());
        names.push(if own {
            name.to_owned()
        } else {
            let (stem, first) = if name.is_empty() { (noun, handle.index() + 1) } else { (name, 2) };
            free(stem, first, &mut taken)
        });
    }
    names
}

/// A name with the first number that makes it new.
fn free(stem: &str, first: usize, taken: &mut BTreeSet<String>) -> String {
    let mut number = first;
    loop {
        let name = format!("{stem} {number}");
        if taken.insert(name.clone()) {
            return name;
        }
        number += 1;
    }
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
