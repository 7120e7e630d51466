//! A value of the document that knows its JSON pointer (RFC 6901), with the checks of types that every reader needs.

use crate::import::file::shown;
use crate::{Error, Result};
use serde_json::Value;

/// What a user can do about a document that is wrong.
const NEXT_STEP: &str =
    "export the model again; the Khronos glTF-Validator shows all that is wrong with a file";

/// An error at a place in the document.
pub(super) fn error_at(pointer: &str, message: impl AsRef<str>) -> Error {
    let place = if pointer.is_empty() { "/" } else { pointer };
    Error::scene(format!("{place}: {}", message.as_ref())).help(NEXT_STEP)
}

/// A value and where it is.
#[derive(Clone)]
pub(super) struct Json<'a> {
    value: &'a Value,
    pointer: String,
}

impl<'a> Json<'a> {
    /// The whole document.
    pub fn root(value: &'a Value) -> Self {
        Self { value, pointer: String::new() }
    }

    /// Where it is.
    pub fn pointer(&self) -> &str {
        &self.pointer
    }

    /// An error at this place.
    pub fn error(&self, message: impl AsRef<str>) -> Error {
        error_at(&self.pointer, message)
    }

    /// The value of a key of this object, if it is there.
    pub fn get(&self, key: &str) -> Result<Option<Self>> {
        let Value::Object(object) = self.value else { return Err(self.mismatch("an object")) };
        Ok(object.get(key).map(|value| self.child(value, key)))
    }

    /// The value of a key that must be there.
    pub fn need(&self, key: &str) -> Result<Self> {
        self.get(key)?.ok_or_else(|| self.error(format!("`{}` is missing", shown(key.as_bytes()))))
    }

    /// The object of an extension.
    pub fn extension(&self, name: &str) -> Result<Option<Self>> {
        let Some(extensions) = self.get("extensions")? else { return Ok(None) };
        let Some(extension) = extensions.get(name)? else { return Ok(None) };
        if extension.value.is_object() { Ok(Some(extension)) } else { Err(extension.mismatch("an object")) }
    }

    /// The items of this list.
    pub fn items(&self) -> Result<Vec<Self>> {
        let Value::Array(items) = self.value else { return Err(self.mismatch("a list")) };
        Ok(items.iter().enumerate().map(|(i, value)| self.child(value, &i.to_string())).collect())
    }

    /// The items of the list of a key; none when it is not there.
    pub fn list(&self, key: &str) -> Result<Vec<Self>> {
        self.get(key)?.map_or(Ok(Vec::new()), |list| list.items())
    }

    /// Keys and values of this object.
    pub fn entries(&self) -> Result<Vec<(&'a str, Self)>> {
        let Value::Object(object) = self.value else { return Err(self.mismatch("an object")) };
        Ok(object.iter().map(|(key, value)| (key.as_str(), self.child(value, key))).collect())
    }

    fn child(&self, value: &'a Value, key: &str) -> Self {
        let escaped = key.replace('~', "~0").replace('/', "~1");
        Self { value, pointer: format!("{}/{}", self.pointer, shown(escaped.as_bytes())) }
    }

    /// This as a string.
    pub fn string(&self) -> Result<&'a str> {
        self.value.as_str().ok_or_else(|| self.mismatch("a string"))
    }

    /// The string of a key, if it is there.
    pub fn text(&self, key: &str) -> Result<Option<&'a str>> {
        self.get(key)?.map(|value| value.string()).transpose()
    }

    /// The name of an object; one made of `kind` and its number when it has none.
    pub fn name(&self, kind: &str, index: usize) -> Result<String> {
        let name = self.text("name")?.filter(|name| !name.is_empty());
        Ok(name.map_or_else(|| format!("{kind} {index}"), str::to_owned))
    }

    /// The boolean of a key, false when it is not there.
    pub fn flag(&self, key: &str) -> Result<bool> {
        let Some(value) = self.get(key)? else { return Ok(false) };
        value.value.as_bool().ok_or_else(|| value.mismatch("true or false"))
    }

    /// This as a number that a 32-bit float can hold.
    pub fn number(&self) -> Result<f32> {
        let number = self.value.as_f64().ok_or_else(|| self.mismatch("a number"))? as f32;
        if number.is_finite() { Ok(number) } else { Err(self.error("the number is too large")) }
    }

    /// The number of a key, or its default.
    pub fn number_or(&self, key: &str, default: f32) -> Result<f32> {
        self.get(key)?.map_or(Ok(default), |value| value.number())
    }

    /// This as a whole number that is not negative.
    pub fn whole(&self) -> Result<usize> {
        // Some writers give whole numbers a decimal point.
        let whole = self.value.as_u64().or_else(|| {
            let number = self.value.as_f64()?;
            ((0.0..9e15).contains(&number) && number.fract() == 0.0).then_some(number as u64)
        });
        let fits = whole.and_then(|number| usize::try_from(number).ok());
        fits.ok_or_else(|| self.mismatch("a whole number that is not negative"))
    }

    /// The whole number of a key, or its default.
    pub fn whole_or(&self, key: &str, default: usize) -> Result<usize> {
        self.get(key)?.map_or(Ok(default), |value| value.whole())
    }

    /// This as a list of so many numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f32; N]> {
        let items = self.items()?;
        if items.len() != N {
            return Err(self.error(format!("this is a list of {}, must be of {N} numbers", items.len())));
        }
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(&items) {
            *number = item.number()?;
        }
        Ok(numbers)
    }

    /// The numbers of a key, or their default.
    pub fn numbers_or<const N: usize>(&self, key: &str, default: [f32; N]) -> Result<[f32; N]> {
        self.get(key)?.map_or(Ok(default), |value| value.numbers())
    }

    /// An error that says what should be here and what is.
    pub fn mismatch(&self, expected: &str) -> Error {
        let found = match self.value {
            Value::Null => "null".into(),
            Value::Bool(_) => "a boolean".into(),
            Value::Number(number) => format!("the number {number}"),
            Value::String(text) => format!("the string \"{}\"", shown(text.as_bytes())),
            Value::Array(items) => format!("a list of {}", items.len()),
            Value::Object(_) => "an object".into(),
        };
        self.error(format!("this is {found}, must be {expected}"))
    }
}
