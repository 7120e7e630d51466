//! `--set key=value`: changes to the document before it is read.

use super::document::{Data, Entry, Node, Sources, Spot, Table};
use super::include::{check_outline, replace};
use super::keys::{LISTS, NAMED, SETTINGS, TOP};
use super::text::{shown, suggest};
use crate::Result;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Applies `key=value` pairs in order to the document of the scene `path`.
pub(super) fn apply(
    sources: &mut Sources,
    path: &Path,
    document: &mut Table,
    overrides: &[(String, String)],
) -> Result<()> {
    for (key, value) in overrides {
        let spot = Spot { source: sources.add_setting(path, key, value), offset: 0 };
        let Some(words) = words(key) else {
            return Err(sources
                .error(spot, format!("`{}` is no key", shown(key)))
                .help("write names with dots between them, such as render.spp"));
        };
        let node = parse_value(sources, spot, value)?;
        set(sources, spot, document, &words, node)?;
    }
    check_outline(sources, document)
}

/// The words of a dotted key, which may be quoted as in TOML.
fn words(key: &str) -> Option<Vec<String>> {
    if key.len() > 4096 || key.contains(['\n', '#']) && !key.contains(['"', '\'']) {
        return None;
    }
    let line = format!("{key} = 0");
    let document = DeTable::parse(&line).ok()?;
    let mut words = Vec::new();
    let mut table = document.get_ref();
    loop {
        let (word, value) = table.iter().next()?;
        if table.len() != 1 {
            return None;
        }
        words.push(word.get_ref().to_string());
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            DeValue::Integer(_) => return Some(words),
            _ => return None,
        }
    }
}

/// A TOML value, or a bare string when it is none and does not begin like a list, a table or a string.
fn parse_value(sources: &Sources, spot: Spot, value: &str) -> Result<Node> {
    match DeValue::parse(value.trim()) {
        Ok(parsed) => sources.convert(&parsed, spot, false, 0),
        Err(error) if value.trim_start().starts_with(['[', '{', '"', '\'']) => {
            Err(sources.error(spot, error.message().lines().next().unwrap_or("not TOML")))
        }
        Err(_) => Ok(Node { spot, data: Data::String(value.to_owned()) }),
    }
}

fn set(sources: &Sources, spot: Spot, document: &mut Table, words: &[String], node: Node) -> Result<()> {
    let (top, rest) = match words {
        [top, rest @ ..] if !rest.is_empty() => (top.as_str(), rest),
        _ => ("", words),
    };
    let fail = |message: String, help: String| Err(sources.error(spot, message).help(help));
    if SETTINGS.contains(&top) {
        if document.get(top).is_none() {
            let data = Data::Table(Table::default());
            document.entries.push(Entry { key: top.into(), spot, node: Node { spot, data } });
        }
    } else if !NAMED.contains(&top) && !LISTS.contains(&top) {
        let word = words.first().map_or("", String::as_str);
        if word == "include" {
            return Err(sources.error(spot, "`include` cannot be set"));
        }
        if TOP.contains(&word) {
            return fail(
                format!("`{word}` as a whole cannot be set"),
                format!("name a key in it, such as {word}.KEY"),
            );
        }
        return fail(
            format!("unknown key `{}` at the top of the scene", shown(word)),
            suggest(word, TOP.iter().copied(), "its keys"),
        );
    }
    let Some(table) = document.get_mut(top) else {
        return fail(format!("the scene has no {top}"), format!("add a {top} to the scene file"));
    };
    // The object itself: its name or its number from 1 comes before the key.
    let (object, keys) = match (&mut table.node.data, rest) {
        (Data::Table(_), keys) if SETTINGS.contains(&top) => (&mut table.node, keys),
        (Data::Table(objects), [name, keys @ ..]) => {
            if objects.get(name).is_none() {
                let names = objects.entries.iter().map(|entry| entry.key.as_str());
                let help = suggest(name, names, &format!("names of type {top}"));
                return fail(format!("no {top} is named `{}`", shown(name)), help);
            }
            match objects.get_mut(name) {
                Some(entry) => (&mut entry.node, keys),
                None => return Ok(()),
            }
        }
        (Data::List(objects), [number, keys @ ..]) => {
            let count = objects.len();
            let found =
                number.parse::<usize>().ok().and_then(|n| n.checked_sub(1)).and_then(|i| objects.get_mut(i));
            let Some(object) = found else {
                return fail(
                    format!("there is no {top} {}", shown(number)),
                    format!("the scene has {count}, counted from 1"),
                );
            };
            (object, keys)
        }
        _ => return Ok(()),
    };
    if keys.is_empty() {
        let name = shown(&words.join("."));
        return fail(
            format!("`{name}` as a whole cannot be set"),
            format!("name a key in it, such as {name}.KEY"),
        );
    }
    set_key(sources, spot, object, top, keys, node)
}

/// Sets `keys` below an object; tables that are missing on the way are made. At most 80 keys: TOML allows no more.
fn set_key(
    sources: &Sources,
    spot: Spot,
    object: &mut Node,
    name: &str,
    keys: &[String],
    node: Node,
) -> Result<()> {
    let Some((key, rest)) = keys.split_first() else { return Ok(()) };
    let found = object.data.type_name();
    let Data::Table(table) = &mut object.data else {
        return Err(sources.error(spot, format!("there is no `{}` in {found}", shown(key))));
    };
    if rest.is_empty() {
        replace(table, name, Entry { key: key.clone(), spot, node });
        return Ok(());
    }
    if table.get(key).is_none() {
        let data = Data::Table(Table::default());
        table.entries.push(Entry { key: key.clone(), spot, node: Node { spot, data } });
    }
    match table.get_mut(key) {
        // Rivals are known for the keys of objects only.
        Some(entry) => set_key(sources, spot, &mut entry.node, "", rest, node),
        None => Ok(()),
    }
}
