//! Keys of a table, and values as the language writes them.

use super::Writer;
use crate::scene;
use glam::{Affine3A, Vec2, Vec3};
use toml_edit::{Array, InlineTable, Item, Table, Value};

/// Whole numbers below this are written without a point.
const WHOLE: f32 = 1e7;
/// Lists of lists with more entries than this have a line for each.
const ON_ONE_LINE: usize = 4;

/// The keys of a table in the order in which they are written.
pub(super) struct Keys(Table);

impl Keys {
    pub fn new() -> Self {
        Self(Table::new())
    }

    /// A table of an object that has a kind.
    pub fn of_kind(kind: &str) -> Self {
        let mut keys = Self::new();
        keys.set("kind", kind);
        keys
    }

    pub fn table(self) -> Table {
        self.0
    }

    /// The same in one line.
    pub fn inline(self) -> Value {
        Value::InlineTable(self.0.into_inline_table())
    }

    pub fn set(&mut self, key: &str, value: impl Into<Value>) {
        self.0.insert(key, Item::Value(value.into()));
    }

    /// Unless it is the value of the default.
    pub fn word(&mut self, key: &str, word: &str, default: &str) {
        if word != default {
            self.set(key, word);
        }
    }

    pub fn flag(&mut self, key: &str, flag: bool, default: bool) {
        if flag != default {
            self.set(key, flag);
        }
    }

    pub fn count(&mut self, key: &str, value: u32, default: u32) {
        if value != default {
            self.set(key, i64::from(value));
        }
    }

    pub fn number(&mut self, key: &str, value: f32, default: f32) {
        if value.to_bits() != default.to_bits() {
            self.set(key, number(value));
        }
    }

    pub fn vector(&mut self, key: &str, value: Vec3, default: Vec3) {
        if value != default {
            self.set(key, vector(value));
        }
    }

    /// The steps of a map, unless it is the identity.
    pub fn transform(&mut self, key: &str, map: &Affine3A) {
        if *map != Affine3A::IDENTITY {
            self.set(key, steps(map));
        }
    }
}

impl Writer<'_> {
    /// A colour or a texture.
    pub fn color(&self, value: &scene::Value<Vec3>) -> Value {
        match value {
            scene::Value::Constant(value) => color(*value),
            scene::Value::Texture(texture) => self.texture_value(*texture),
        }
    }

    /// A number or a texture.
    pub fn amount(&self, value: &scene::Value<f32>) -> Value {
        match value {
            scene::Value::Constant(value) => number(*value),
            scene::Value::Texture(texture) => self.texture_value(*texture),
        }
    }

    fn texture_value(&self, texture: scene::Handle<scene::Texture>) -> Value {
        one_key("texture", self.textures.refer(texture))
    }

    /// A colour or a texture, unless it is this grey.
    pub fn put_color(&self, keys: &mut Keys, key: &str, value: &scene::Value<Vec3>, default: f32) {
        if *value != scene::Value::Constant(Vec3::splat(default)) {
            keys.set(key, self.color(value));
        }
    }

    /// A number or a texture, unless it is this number.
    pub fn put_amount(&self, keys: &mut Keys, key: &str, value: &scene::Value<f32>, default: f32) {
        if *value != scene::Value::Constant(default) {
            keys.set(key, self.amount(value));
        }
    }
}

/// The shortest decimal that reads as this number.
pub(super) fn number(value: f32) -> Value {
    if value.fract() == 0.0 && value.abs() < WHOLE && (value != 0.0 || value.is_sign_positive()) {
        return Value::from(value as i64);
    }
    // Read as the reader does: in 64 bits, then in 32
    let short = format!("{value:?}").parse::<f64>().unwrap_or(f64::from(value));
    Value::from(if short as f32 == value { short } else { f64::from(value) })
}

pub(super) fn numbers(values: &[f32]) -> Value {
    values.iter().map(|value| number(*value)).collect()
}

pub(super) fn vector(value: Vec3) -> Value {
    numbers(&value.to_array())
}

pub(super) fn pair(value: Vec2) -> Value {
    numbers(&value.to_array())
}

/// A grey as a number.
pub(super) fn color(value: Vec3) -> Value {
    if value == Vec3::splat(value.x) { number(value.x) } else { vector(value) }
}

/// The same for both, or a list of two.
pub(super) fn one_or_two(values: [Value; 2]) -> Value {
    let [a, b] = &values;
    if a.to_string() == b.to_string() { a.clone() } else { values.into_iter().collect() }
}

/// A list of lists or tables, of which a long one has a line for each.
pub(super) fn rows(values: impl Iterator<Item = Value>) -> Value {
    let mut list: Array = values.collect();
    if list.len() > ON_ONE_LINE {
        for value in list.iter_mut() {
            value.decor_mut().set_prefix("\n    ");
        }
        list.set_trailing("\n");
        list.set_trailing_comma(true);
    }
    Value::Array(list)
}

/// A table of one key.
pub(super) fn one_key(key: &str, value: impl Into<Value>) -> Value {
    Value::InlineTable(InlineTable::from_iter([(key, value.into())]))
}

/// The first three rows of a map.
pub(super) fn matrix(map: &Affine3A) -> Value {
    let [x, y, z, t] =
        [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis, map.translation].map(|c| c.to_array());
    numbers(&[0, 1, 2].map(|i| [x[i], y[i], z[i], t[i]]).concat())
}

/// A map as steps: what only scales and moves says so.
fn steps(map: &Affine3A) -> Value {
    let diagonal = Vec3::new(map.matrix3.x_axis.x, map.matrix3.y_axis.y, map.matrix3.z_axis.z);
    let scales = map.matrix3 == glam::Mat3A::from_diagonal(diagonal);
    let mut list = Array::new();
    if !scales {
        list.push(one_key("matrix", matrix(map)));
        return Value::Array(list);
    }
    if diagonal != Vec3::ONE {
        list.push(one_key("scale", color(diagonal)));
    }
    if map.translation != glam::Vec3A::ZERO {
        list.push(one_key("translate", vector(map.translation.into())));
    }
    Value::Array(list)
}
