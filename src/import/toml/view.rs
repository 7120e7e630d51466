//! A table whose keys are known, and its values with the checks that all of them share.

use super::document::{Data, Entry, Node, Sources, Spot, Table};
use super::keys::Kinds;
use super::text::{Limits, closest, number, shown, suggest};
use crate::scene::unit;
use crate::{Error, Result};
use glam::{Vec2, Vec3, Vec4};
use std::fmt;
use std::path::PathBuf;

/// A table in which every key is known.
pub(super) struct View<'a> {
    pub sources: &'a Sources,
    /// Place of the table.
    pub spot: Spot,
    /// Name for messages, such as `[camera]` or `shape 2`.
    pub what: String,
    table: &'a Table,
}

impl<'a> View<'a> {
    /// Checks that all keys of the table are among `known`.
    pub fn new(sources: &'a Sources, node: &'a Node, what: String, known: &[&str]) -> Result<Self> {
        Self::checked(
            sources,
            node,
            what,
            |key| known.contains(&key),
            |key| suggest(key, known.iter().copied(), "its keys"),
        )
    }

    /// Reads the `kind` of an object and checks that its keys fit.
    pub fn of_kind(
        sources: &'a Sources,
        node: &'a Node,
        what: String,
        keys: &Kinds,
    ) -> Result<(Self, &'static str)> {
        Self::of_kind_or(sources, node, what, keys, "")
    }

    /// The same, with the kind of an object that does not say it; `""` is none.
    pub fn of_kind_or(
        sources: &'a Sources,
        node: &'a Node,
        what: String,
        keys: &Kinds,
        default: &str,
    ) -> Result<(Self, &'static str)> {
        let any = Self::checked(sources, node, what, |_| true, |_| String::new())?;
        let choices: Vec<_> = keys.kinds.iter().map(|kind| (kind.0, kind)).collect();
        let (kind, own) = match (any.get("kind"), keys.kinds.iter().find(|kind| kind.0 == default)) {
            (Some(item), _) => *item.choice(&choices)?,
            (None, Some(kind)) => *kind,
            (None, None) => {
                let names: Vec<_> = keys.kinds.iter().map(|(name, _)| format!("\"{name}\"")).collect();
                return Err(any
                    .error(format!("`kind` is missing in {}", any.what))
                    .help(format!("kinds are {}", names.join(", "))));
            }
        };
        let known = || keys.common.iter().chain(own.iter()).copied();
        let help = |key: &str| {
            let others: Vec<_> =
                keys.kinds.iter().filter(|(_, list)| list.contains(&key)).map(|(name, _)| *name).collect();
            match others.as_slice() {
                [] => suggest(key, known(), "its keys"),
                _ => format!("it is a key of {}", others.join(", ")),
            }
        };
        let what = if any.get("kind").is_some() { format!("{kind} {}", any.what) } else { any.what };
        Ok((Self::checked(sources, node, what, |key| known().any(|other| other == key), help)?, kind))
    }

    fn checked(
        sources: &'a Sources,
        node: &'a Node,
        what: String,
        known: impl Fn(&str) -> bool,
        help: impl Fn(&str) -> String,
    ) -> Result<Self> {
        let Data::Table(table) = &node.data else {
            let message = format!("{what} must be a table, found {}", node.data.type_name());
            return Err(sources.error(node.spot, message));
        };
        for entry in &table.entries {
            if !known(&entry.key) {
                let message = format!("unknown key `{}` in {what}", shown(&entry.key));
                return Err(sources.error(entry.spot, message).help(help(&entry.key)));
            }
        }
        Ok(Self { sources, spot: node.spot, what, table })
    }

    pub fn get(&self, key: &str) -> Option<Item<'a>> {
        self.table.get(key).map(|entry| Item::of_entry(self.sources, entry))
    }

    pub fn need(&self, key: &str) -> Result<Item<'a>> {
        self.get(key).ok_or_else(|| self.error(format!("`{key}` is missing in {}", self.what)))
    }

    /// The one of two keys that is there; an error when both are.
    pub fn either(&self, a: &str, b: &str) -> Result<Option<Item<'a>>> {
        match (self.get(a), self.get(b)) {
            (Some(first), Some(second)) => {
                let later = if first.node.spot < second.node.spot { second } else { first };
                Err(later.error(format!("{} has both `{a}` and `{b}`", self.what)).help("keep one of them"))
            }
            (first, second) => Ok(first.or(second)),
        }
    }

    /// As [`Self::either`], and one must be there.
    pub fn need_either(&self, a: &str, b: &str) -> Result<Item<'a>> {
        self.either(a, b)?.ok_or_else(|| {
            self.error(format!("{} has neither `{a}` nor `{b}`", self.what)).help("add one of them")
        })
    }

    /// An error at the place of the table.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.sources.error(self.spot, message)
    }

    pub fn bool_or(&self, key: &str, default: bool) -> Result<bool> {
        self.get(key).map_or(Ok(default), |item| item.bool())
    }
    pub fn u32_or(&self, key: &str, default: u32, low: u32, high: u32) -> Result<u32> {
        self.get(key).map_or(Ok(default), |item| item.u32(low, high))
    }
    pub fn f32_or(&self, key: &str, default: f32, limits: Limits) -> Result<f32> {
        self.get(key).map_or(Ok(default), |item| item.f32(limits))
    }
    pub fn vec3_or(&self, key: &str, default: Vec3) -> Result<Vec3> {
        self.get(key).map_or(Ok(default), |item| item.vec3(Limits::Finite))
    }
    pub fn choice_or<T: Copy>(&self, key: &str, default: T, choices: &[(&str, T)]) -> Result<T> {
        self.get(key).map_or(Ok(default), |item| item.choice(choices))
    }
}

/// A key and up to two indices below it, as in `positions[3][1]`.
#[derive(Clone, Copy)]
struct Label<'a> {
    key: &'a str,
    index: [u32; 2],
    depth: usize,
}

impl fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown(self.key))?;
        self.index.iter().take(self.depth).try_for_each(|index| write!(f, "[{index}]"))
    }
}

/// A value and the key that it belongs to.
#[derive(Clone, Copy)]
pub(super) struct Item<'a> {
    pub sources: &'a Sources,
    pub node: &'a Node,
    label: Label<'a>,
}

impl<'a> Item<'a> {
    pub fn of_entry(sources: &'a Sources, entry: &'a Entry) -> Self {
        Self { sources, node: &entry.node, label: Label { key: &entry.key, index: [0; 2], depth: 0 } }
    }

    /// The key, with indices.
    pub fn name(&self) -> String {
        format!("`{}`", self.label)
    }

    /// An error at the place of the value.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.sources.error(self.node.spot, message)
    }

    /// The error for a value of the wrong type.
    pub fn mismatch(&self, expected: &str) -> Error {
        self.error(format!("{} must be {expected}, found {}", self.name(), self.node.data.type_name()))
    }

    /// The error for a value of the right type that is not allowed.
    pub fn refuse(&self, value: impl fmt::Display, rule: impl fmt::Display) -> Error {
        self.error(format!("{} is {value}, must be {rule}", self.name()))
    }

    pub fn bool(&self) -> Result<bool> {
        match self.node.data {
            Data::Bool(value) => Ok(value),
            _ => Err(self.mismatch("true or false")),
        }
    }

    pub fn u32(&self, low: u32, high: u32) -> Result<u32> {
        match self.node.data {
            Data::Integer(value) => match u32::try_from(value) {
                Ok(number) if (low..=high).contains(&number) => Ok(number),
                _ => Err(self.refuse(value, format!("from {low} to {high}"))),
            },
            _ => Err(self.mismatch("a whole number")),
        }
    }

    pub fn f32(&self, limits: Limits) -> Result<f32> {
        let value = match self.node.data {
            Data::Integer(value) => value as f64,
            Data::Float(value) => value,
            _ => return Err(self.mismatch("a number")),
        };
        let narrow = value as f32;
        if !value.is_finite() {
            Err(self.refuse(number(value), "finite"))
        } else if !narrow.is_finite() {
            Err(self.refuse(number(value), "below 3.4e38"))
        } else if !limits.allows(narrow) {
            Err(self.refuse(number(value), limits))
        } else {
            Ok(narrow)
        }
    }

    /// The same, with all digits.
    pub fn f64(&self, limits: Limits) -> Result<f64> {
        let narrow = self.f32(limits)?;
        Ok(match self.node.data {
            Data::Integer(value) => value as f64,
            Data::Float(value) => value,
            _ => narrow.into(),
        })
    }

    pub fn is_number(&self) -> bool {
        matches!(self.node.data, Data::Integer(_) | Data::Float(_))
    }

    pub fn is_list(&self) -> bool {
        matches!(self.node.data, Data::List(_))
    }

    pub fn string(&self) -> Result<&'a str> {
        match &self.node.data {
            Data::String(text) => Ok(text),
            _ => Err(self.mismatch("a string")),
        }
    }

    /// A file name, relative to the file that it is written in.
    pub fn path(&self) -> Result<PathBuf> {
        let name = self.string()?;
        if name.is_empty() || name.contains('\0') {
            return Err(self.refuse(format!("\"{}\"", shown(name)), "the name of a file"));
        }
        Ok(self.sources.resolve(self.node.spot, name))
    }

    /// One of some words.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T> {
        let words: Vec<_> = choices.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let rule = if words.len() > 1 { format!("one of {}", words.join(", ")) } else { words.concat() };
        let Data::String(text) = &self.node.data else {
            return Err(self.mismatch(&rule));
        };
        match choices.iter().find(|(word, _)| word == text) {
            Some((_, value)) => Ok(*value),
            None => {
                let error = self.refuse(format!("\"{}\"", shown(text)), rule);
                Err(match closest(text, choices.iter().map(|(word, _)| *word)) {
                    Some(word) => error.help(format!("did you mean \"{word}\"?")),
                    None => error,
                })
            }
        }
    }

    /// The elements of a list.
    pub fn list(&self, expected: &str) -> Result<impl ExactSizeIterator<Item = Item<'a>> + use<'a>> {
        let Data::List(items) = &self.node.data else {
            return Err(self.mismatch(expected));
        };
        let (sources, label) = (self.sources, self.label);
        Ok(items.iter().enumerate().map(move |(i, node)| {
            let mut label = label;
            if let Some(index) = label.index.get_mut(label.depth) {
                *index = i as u32;
                label.depth += 1;
            }
            Item { sources, node, label }
        }))
    }

    /// A list of exactly N numbers.
    pub fn numbers<const N: usize>(&self, limits: Limits) -> Result<[f32; N]> {
        let expected = format!("a list of {N} numbers");
        let items = self.list(&expected)?;
        if items.len() != N {
            return Err(self.mismatch(&expected));
        }
        let mut values = [0.0; N];
        for (value, item) in values.iter_mut().zip(items) {
            *value = item.f32(limits)?;
        }
        Ok(values)
    }

    /// A list of exactly N whole numbers.
    pub fn whole_numbers<const N: usize>(&self, low: u32, high: u32) -> Result<[u32; N]> {
        let expected = format!("a list of {N} whole numbers");
        let items = self.list(&expected)?;
        if items.len() != N {
            return Err(self.mismatch(&expected));
        }
        let mut values = [0; N];
        for (value, item) in values.iter_mut().zip(items) {
            *value = item.u32(low, high)?;
        }
        Ok(values)
    }

    pub fn vec2(&self, limits: Limits) -> Result<Vec2> {
        Ok(Vec2::from_array(self.numbers(limits)?))
    }

    pub fn vec3(&self, limits: Limits) -> Result<Vec3> {
        Ok(Vec3::from_array(self.numbers(limits)?))
    }

    pub fn vec4(&self, limits: Limits) -> Result<Vec4> {
        Ok(Vec4::from_array(self.numbers(limits)?))
    }

    /// A vector that is not zero, scaled to unit length. One that has it within rounding stays as it is.
    pub fn direction(&self) -> Result<Vec3> {
        let vector = self.vec3(Limits::Finite)?;
        unit(vector)
            .ok_or_else(|| self.error(format!("{} is the zero vector and gives no direction", self.name())))
    }
}
