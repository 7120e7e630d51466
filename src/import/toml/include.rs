//! A scene file and the files that it includes, as one document.

use super::assets::Assets;
use super::document::{Data, Entry, Node, Sources, Spot, Table};
use super::keys::{LISTS, NAMED, SETTINGS, TOP, rivals};
use super::text::{shown, suggest};
use super::view::Item;
use crate::{Error, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

/// Longest chain of files that include one another.
const MAX_CHAIN: usize = 16;

/// Reads a scene file and all that it includes. A file that several others include is read once.
pub(super) fn load(path: &Path, assets: &mut dyn Assets, sources: &mut Sources) -> Result<Table> {
    Loader { assets, sources, chain: Vec::new(), seen: BTreeSet::new() }.file(path, None)
}

struct Loader<'a> {
    assets: &'a mut dyn Assets,
    sources: &'a mut Sources,
    /// The files that are being read, from the scene down to the current one: identity and name.
    chain: Vec<(PathBuf, PathBuf)>,
    seen: BTreeSet<PathBuf>,
}

impl Loader<'_> {
    fn file(&mut self, path: &Path, named_at: Option<Spot>) -> Result<Table> {
        let identity = identity(path);
        let locate = |sources: &Sources, error: Error| match named_at {
            Some(spot) => sources.locate(spot, error),
            None => error.in_file(path),
        };
        if self.chain.iter().any(|(seen, _)| *seen == identity) {
            let message = format!("the files include one another: {}", self.chain_text(path));
            return Err(locate(self.sources, Error::scene(message)));
        }
        if self.chain.len() >= MAX_CHAIN {
            let message = format!(
                "the files include one another more than {MAX_CHAIN} deep: {}",
                self.chain_text(path)
            );
            return Err(locate(self.sources, Error::scene(message)));
        }
        if !self.seen.insert(identity.clone()) {
            return Ok(Table::default());
        }
        if !self.assets.exists(path) {
            let message = format!("there is no file {}", shown(&path.display().to_string()));
            return Err(locate(self.sources, Error::scene(message)));
        }
        let text = self.assets.text(path).map_err(|error| locate(self.sources, error))?;
        let source = self.sources.add_file(path, text);
        let mut own = self.sources.parse(source)?;
        check_outline(self.sources, &own)?;

        self.chain.push((identity, path.to_path_buf()));
        let mut whole = Table::default();
        if let Some(index) = own.entries.iter().position(|entry| entry.key == "include") {
            let entry = own.entries.remove(index);
            let items = Item::of_entry(self.sources, &entry).list("a list of file names")?;
            let files: Vec<_> =
                items.map(|item| Ok((item.node.spot, item.path()?))).collect::<Result<_>>()?;
            for (spot, path) in files {
                let included = self.file(&path, Some(spot))?;
                merge(self.sources, &mut whole, included)?;
            }
        }
        self.chain.pop();
        merge(self.sources, &mut whole, own)?;
        Ok(whole)
    }

    fn chain_text(&self, last: &Path) -> String {
        let names = self.chain.iter().map(|(_, path)| path.as_path()).chain([last]);
        names.map(|path| shown(&path.display().to_string())).collect::<Vec<_>>().join(" → ")
    }
}

/// The same path for the same file, as far as that can be known.
pub(super) fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| {
        let mut plain = PathBuf::new();
        for part in path.components() {
            match part {
                Component::CurDir => {}
                Component::ParentDir if plain.file_name().is_some() => {
                    plain.pop();
                }
                _ => plain.push(part),
            }
        }
        plain
    })
}

/// Checks that everything at the top of a document is known and a table, a table of tables, or a list of tables.
pub(super) fn check_outline(sources: &Sources, document: &Table) -> Result<()> {
    for entry in &document.entries {
        let key = entry.key.as_str();
        let wrong = |expected: String| {
            let found = entry.node.data.type_name();
            Err(sources.error(entry.node.spot, format!("`{key}` must be {expected}, found {found}")))
        };
        match &entry.node.data {
            _ if !TOP.contains(&key) => {
                let message = format!("unknown key `{}` at the top of the scene", shown(key));
                let help = suggest(key, TOP.iter().copied(), "its keys");
                return Err(sources.error(entry.spot, message).help(help));
            }
            Data::Table(_) if SETTINGS.contains(&key) => {}
            _ if SETTINGS.contains(&key) => return wrong(format!("a table [{key}]")),
            Data::Table(objects) if NAMED.contains(&key) => {
                for object in &objects.entries {
                    if !matches!(object.node.data, Data::Table(_)) {
                        let name = shown(&object.key);
                        let found = object.node.data.type_name();
                        let message = format!("`{key}.{name}` must be a table [{key}.NAME], found {found}");
                        return Err(sources.error(object.node.spot, message));
                    }
                }
            }
            _ if NAMED.contains(&key) => return wrong(format!("tables [{key}.NAME]")),
            Data::List(items) if LISTS.contains(&key) => {
                for item in items {
                    if !matches!(item.data, Data::Table(_)) {
                        let found = item.data.type_name();
                        let message = format!("`{key}` must hold tables [[{key}]], found {found}");
                        return Err(sources.error(item.spot, message));
                    }
                }
            }
            _ if LISTS.contains(&key) => return wrong(format!("a list of tables [[{key}]]")),
            _ => {}
        }
    }
    Ok(())
}

/// Adds a document to another. Settings of `over` win, lists are joined, and no name may be there twice.
fn merge(sources: &Sources, base: &mut Table, over: Table) -> Result<()> {
    for entry in over.entries {
        let Some(old) = base.get_mut(&entry.key) else {
            base.entries.push(entry);
            continue;
        };
        match (&mut old.node.data, entry.node.data) {
            (Data::List(old), Data::List(new)) => old.extend(new),
            (Data::Table(table), Data::Table(new)) if SETTINGS.contains(&entry.key.as_str()) => {
                old.node.spot = entry.node.spot;
                for setting in new.entries {
                    replace(table, &entry.key, setting);
                }
            }
            (Data::Table(old), Data::Table(new)) => {
                let names: BTreeMap<_, _> = old.entries.iter().map(|e| (e.key.as_str(), e.spot)).collect();
                for object in &new.entries {
                    if let Some(&first) = names.get(object.key.as_str()) {
                        let (noun, name) = (&entry.key, shown(&object.key));
                        let message =
                            format!("{noun} `{name}` is there twice, first at {}", sources.place(first));
                        return Err(sources.error(object.spot, message).help("rename one of them"));
                    }
                }
                old.entries.extend(new.entries);
            }
            // check_outline has refused everything else.
            (_, data) => old.node = Node { spot: entry.node.spot, data },
        }
    }
    Ok(())
}

/// Sets a key and removes the keys that cannot stand beside it.
pub(super) fn replace(table: &mut Table, name: &str, entry: Entry) {
    let rivals = rivals(name, &entry.key);
    table.entries.retain(|old| old.key != entry.key && !rivals.contains(&old.key.as_str()));
    table.entries.push(entry);
}
