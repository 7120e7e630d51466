//! The parameters of a directive, asked for by name and type.

use super::deprecated::{PARAMETERS, instead};
use super::parameter::{Parameter, Type, Values};
use super::place::Spot;
use crate::import::text::{Limits, closest, number, shown, suggest};
use crate::{Error, Result};
use glam::{Vec2, Vec3};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fmt;
use std::path::PathBuf;
use std::rc::Rc;

/// The parameters of a directive. Those that nobody asked for are errors in the end.
#[derive(Debug)]
pub(super) struct Parameters {
    /// The directive, such as `Shape "sphere"`.
    pub what: String,
    /// Where it is.
    pub spot: Spot,
    list: Vec<Rc<Parameter>>,
    /// What was asked for, which is what may be there.
    asked: RefCell<BTreeSet<(&'static str, &'static str)>>,
}

impl Parameters {
    /// Those of the directive come before those that it inherits.
    pub fn new(what: String, spot: Spot, own: Vec<Parameter>, inherited: &[Rc<Parameter>]) -> Self {
        let list = own.into_iter().map(Rc::new).chain(inherited.iter().cloned()).collect();
        Self { what, spot, list, asked: RefCell::default() }
    }

    /// The first parameter of that name and one of the types.
    pub fn find(&self, name: &'static str, kinds: &[Type]) -> Option<&Parameter> {
        self.asked.borrow_mut().extend(kinds.iter().map(|kind| (name, kind.name())));
        let found = self.list.iter().find(|one| one.name == name && kinds.contains(&one.kind))?;
        found.used.set(true);
        Some(found)
    }

    /// An error at the directive.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.spot.error(message)
    }

    /// An error about a value.
    pub fn refuse(&self, of: &Parameter, value: impl fmt::Display, rule: impl fmt::Display) -> Error {
        of.spot.error(format!("{} of {} is {value}, must be {rule}", of.shown(), self.what))
    }

    /// The error for a parameter that must be there.
    pub fn missing(&self, name: &str, kind: Type) -> Error {
        self.error(format!("\"{} {name}\" is missing in {}", kind.name(), self.what)).help("add it")
    }

    /// All numbers of a parameter.
    pub fn numbers(&self, name: &'static str, kind: Type) -> Option<(&Parameter, &[f32])> {
        let found = self.find(name, &[kind])?;
        match &found.values {
            Values::Numbers(list) => Some((found, list)),
            _ => None,
        }
    }

    /// All whole numbers of a parameter.
    pub fn integers(&self, name: &'static str) -> Option<(&Parameter, &[i32])> {
        let found = self.find(name, &[Type::Integer])?;
        match &found.values {
            Values::Integers(list) => Some((found, list)),
            _ => None,
        }
    }

    /// All strings of a parameter.
    pub fn strings(&self, name: &'static str, kind: Type) -> Option<(&Parameter, &[String])> {
        let found = self.find(name, &[kind])?;
        match &found.values {
            Values::Strings(list) => Some((found, list)),
            _ => None,
        }
    }

    /// Exactly N numbers.
    pub fn array<const N: usize>(&self, name: &'static str, kind: Type) -> Result<Option<[f32; N]>> {
        let Some((parameter, list)) = self.numbers(name, kind) else { return Ok(None) };
        let array = list.try_into().map_err(|_| self.count(parameter, N))?;
        Ok(Some(array))
    }

    /// The error for another count of values than `wanted`.
    pub fn count(&self, parameter: &Parameter, wanted: usize) -> Error {
        let (found, what) = (parameter.values.len(), &self.what);
        let s = if wanted == 1 { "" } else { "s" };
        parameter
            .spot
            .error(format!("{} of {what} has {found} values, must have {wanted}", parameter.shown()))
            .help(format!("write {wanted} value{s}"))
    }

    pub fn float(&self, name: &'static str, limits: Limits) -> Result<Option<f32>> {
        let Some([value]) = self.array(name, Type::Float)? else { return Ok(None) };
        match self.find(name, &[Type::Float]) {
            Some(parameter) if !limits.allows(value) => {
                Err(self.refuse(parameter, number(value.into()), limits))
            }
            _ => Ok(Some(value)),
        }
    }

    pub fn float_or(&self, name: &'static str, default: f32, limits: Limits) -> Result<f32> {
        Ok(self.float(name, limits)?.unwrap_or(default))
    }

    pub fn integer(&self, name: &'static str, low: u32, high: u32) -> Result<Option<u32>> {
        let Some((parameter, list)) = self.integers(name) else { return Ok(None) };
        let &[value] = list else { return Err(self.count(parameter, 1)) };
        match u32::try_from(value) {
            Ok(value) if (low..=high).contains(&value) => Ok(Some(value)),
            _ => Err(self.refuse(parameter, value, format!("from {low} to {high}"))),
        }
    }

    pub fn integer_or(&self, name: &'static str, default: u32, low: u32, high: u32) -> Result<u32> {
        Ok(self.integer(name, low, high)?.unwrap_or(default))
    }

    pub fn bool_or(&self, name: &'static str, default: bool) -> Result<bool> {
        let Some(parameter) = self.find(name, &[Type::Bool]) else { return Ok(default) };
        match &parameter.values {
            Values::Bools(list) if list.len() == 1 => Ok(list[0]),
            _ => Err(self.count(parameter, 1)),
        }
    }

    pub fn string(&self, name: &'static str) -> Result<Option<(&Parameter, &str)>> {
        self.one_string(name, Type::String)
    }

    /// The one string of a parameter.
    pub fn one_string(&self, name: &'static str, kind: Type) -> Result<Option<(&Parameter, &str)>> {
        match self.strings(name, kind) {
            None => Ok(None),
            Some((parameter, [text])) => Ok(Some((parameter, text))),
            Some((parameter, _)) => Err(self.count(parameter, 1)),
        }
    }

    /// One of some words.
    pub fn choice_or<T: Copy>(&self, name: &'static str, default: T, choices: &[(&str, T)]) -> Result<T> {
        let Some((parameter, text)) = self.string(name)? else { return Ok(default) };
        match choices.iter().find(|(word, _)| *word == text) {
            Some((_, value)) => Ok(*value),
            None => {
                let words = choices.iter().map(|(word, _)| *word);
                let help = match closest(text, words.clone()) {
                    Some(word) => format!("did you mean \"{word}\"?"),
                    None => "choose one of them".into(),
                };
                let rule = words.map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
                let rule = if choices.len() == 1 { rule } else { format!("one of {rule}") };
                Err(self.refuse(parameter, format!("\"{}\"", shown(text)), rule).help(help))
            }
        }
    }

    /// The path of a file.
    pub fn file(&self, name: &'static str) -> Result<Option<(Spot, PathBuf)>> {
        let Some((parameter, text)) = self.string(name)? else { return Ok(None) };
        if text.is_empty() {
            return Err(self.refuse(parameter, "\"\"", "the name of a file"));
        }
        Ok(Some((parameter.spot.clone(), parameter.spot.resolve(text))))
    }

    pub fn point_or(&self, name: &'static str, default: Vec3) -> Result<Vec3> {
        Ok(self.array(name, Type::Point3)?.map_or(default, Vec3::from_array))
    }

    pub fn vector_or(&self, name: &'static str, default: Vec3) -> Result<Vec3> {
        Ok(self.array(name, Type::Vector3)?.map_or(default, Vec3::from_array))
    }

    /// All points or normals of a parameter.
    pub fn vec3s(&self, name: &'static str, kind: Type) -> Option<(&Parameter, Vec<Vec3>)> {
        let (parameter, list) = self.numbers(name, kind)?;
        Some((parameter, list.as_chunks().0.iter().map(|&at| Vec3::from_array(at)).collect()))
    }

    /// All points in two dimensions of a parameter.
    pub fn vec2s(&self, name: &'static str) -> Option<(&Parameter, Vec<Vec2>)> {
        let (parameter, list) = self.numbers(name, Type::Point2)?;
        Some((parameter, list.as_chunks().0.iter().map(|&at| Vec2::from_array(at)).collect()))
    }

    /// Passes over parameters that change no picture.
    pub fn ignore(&self, names: &[&str]) {
        self.list.iter().filter(|one| names.contains(&one.name.as_str())).for_each(|one| one.used.set(true));
    }

    /// Whether a parameter of that name is there, whatever its type; it counts as used.
    pub fn has(&self, name: &str) -> Option<&Spot> {
        let found = self.list.iter().find(|one| one.name == name)?;
        found.used.set(true);
        Some(&found.spot)
    }

    /// An error for the first parameter that nobody asked for.
    pub fn finish(&self) -> Result<()> {
        let Some(unused) = self.list.iter().find(|one| !one.inherited && !one.used.get()) else {
            return Ok(());
        };
        let message = format!("{} is no parameter of {}", unused.shown(), self.what);
        Err(unused.spot.error(message).help(self.hint(unused)))
    }

    /// What was perhaps meant: another type, another name, or what pbrt-v4 has in place of an older name.
    fn hint(&self, unused: &Parameter) -> String {
        let asked = self.asked.borrow();
        let types: Vec<_> =
            asked.iter().filter(|(name, _)| *name == unused.name).map(|(_, kind)| *kind).collect();
        if !types.is_empty() {
            return format!("`{}` is of type {}", shown(&unused.name), types.join(", "));
        }
        if let Some(help) = instead(PARAMETERS, &unused.name) {
            return help.into();
        }
        let names: BTreeSet<_> = asked.iter().map(|(name, _)| *name).collect();
        suggest(&unused.name, names.into_iter(), "its parameters")
    }
}
