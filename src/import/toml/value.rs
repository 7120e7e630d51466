//! Colours and numbers that a texture may give instead.

use super::document::Data;
use super::keys::TEXTURE_VALUE;
use super::reader::Reader;
use super::text::{Limits, shown};
use super::view::{Item, View};
use crate::Result;
use crate::import::srgb::linear_from_srgb;
use crate::scene::{Handle, Texture, Value};
use glam::Vec3;

impl Reader<'_> {
    /// A colour, or `{ texture = "NAME" }`.
    pub fn color(&self, item: Item<'_>, limits: Limits) -> Result<Value<Vec3>> {
        match self.texture_value(item)? {
            Some(texture) => Ok(Value::Texture(texture)),
            None => constant_color(item, limits, "a colour or { texture = \"NAME\" }").map(Value::Constant),
        }
    }

    /// A number, or `{ texture = "NAME" }`.
    pub fn number(&self, item: Item<'_>, limits: Limits) -> Result<Value<f32>> {
        match self.texture_value(item)? {
            Some(texture) => Ok(Value::Texture(texture)),
            None if item.is_number() => item.f32(limits).map(Value::Constant),
            None => Err(item.mismatch("a number or { texture = \"NAME\" }")),
        }
    }

    fn texture_value(&self, item: Item<'_>) -> Result<Option<Handle<Texture>>> {
        let Data::Table(_) = item.node.data else {
            return Ok(None);
        };
        let view = View::new(self.sources, item.node, item.name(), TEXTURE_VALUE)?;
        self.textures.find(view.need("texture")?).map(Some)
    }
}

/// A colour: `[r, g, b]`, a number for a grey, or `"#rrggbb"` in sRGB.
pub(super) fn color(item: Item<'_>, limits: Limits) -> Result<Vec3> {
    constant_color(item, limits, "a colour")
}

fn constant_color(item: Item<'_>, limits: Limits, expected: &str) -> Result<Vec3> {
    match &item.node.data {
        Data::Integer(_) | Data::Float(_) => item.f32(limits).map(Vec3::splat),
        Data::List(_) => item.vec3(limits),
        Data::String(text) => {
            let parsed = hex_color(text).ok_or_else(|| {
                item.error(format!("{} is \"{}\", which is no colour", item.name(), shown(text)))
                    .help("write [r, g, b], a number, or \"#rrggbb\"")
            })?;
            Ok(parsed)
        }
        _ => Err(item.mismatch(expected)),
    }
}

/// Linear colour of `#rrggbb`.
fn hex_color(text: &str) -> Option<Vec3> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6)?;
    if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let rgb = u32::from_str_radix(digits, 16).ok()?;
    let channel = |shift: u32| linear_from_srgb(((rgb >> shift) & 255) as f32 / 255.0);
    Some(Vec3::new(channel(16), channel(8), channel(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_colors_are_srgb() {
        assert_eq!(hex_color("#ffffff"), Some(Vec3::ONE));
        assert_eq!(hex_color("#000000"), Some(Vec3::ZERO));
        assert!((hex_color("#bC0000").unwrap().x - 0.502_886).abs() < 1e-5);
        assert_eq!(hex_color("#+12345"), None);
        assert_eq!(hex_color("#fff"), None);
        assert_eq!(hex_color("#ééé"), None);
    }
}
