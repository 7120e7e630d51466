//! Textures that a scene brings as GLSL of its own.
//!
//! Each text goes into the generated file once, with a prefix of its own before every name that it declares, so that two texts
//! cannot clash; `#line` tells the compiler which file and line of the user's a line is. Parameters are variables of the kernel
//! that are read from the record before the function is called.

use super::builder::{Builder, Node, Words};
use super::range::Range;
use super::shape::Shape;
use crate::layout::{Record as _, TextureInput};
use crate::scene::glsl::{ENTRY, declared, renamed};
use crate::scene::{GlslTexture, Parameter};
use glam::Vec3;
use std::fmt::Write as _;

/// The name of the generated file.
const GENERATED: &str = "generated/textures.glsl";

/// Whether two textures are one function, but for their numbers.
fn is_like(a: &GlslTexture, b: &GlslTexture) -> bool {
    let kind = |(name, value): &(String, Parameter)| (name.clone(), matches!(value, Parameter::Number(_)));
    let kinds = |texture: &GlslTexture| texture.parameters.iter().map(kind).collect::<Vec<_>>();
    a.source == b.source && (&a.file, a.line) == (&b.file, b.line) && kinds(a) == kinds(b)
}

impl<'a> Builder<'a> {
    pub(super) fn user(&mut self, texture: &'a GlslTexture) -> Node {
        let known = self.users.iter().position(|other| is_like(texture, other));
        let user = known.unwrap_or_else(|| {
            self.users.push(texture);
            self.users.len() - 1
        });
        let mut words = Words::default();
        let mut push = |value: Vec3| words.push(TextureInput { value: value.to_array(), at: 0 });
        push(Vec3::splat(texture.max));
        for (_, value) in &texture.parameters {
            push(match *value {
                Parameter::Number(number) => Vec3::splat(number),
                Parameter::Color(color) => color,
            });
        }
        let max = f64::from(texture.max);
        // What a function does on average is not known
        self.keep(Shape::User(user as u32), words, None, Range { min: -max, mean: 0.5 * max, max })
    }
}

fn prefix(user: usize) -> String {
    format!("user{user}_")
}

/// Writes the text of a user to the generated file: its parameters, and its lines under its own name.
pub(super) fn write_text(out: &mut String, user: usize, texture: &GlslTexture) {
    let prefix = prefix(user);
    let mut names = declared(&texture.source);
    for (name, value) in &texture.parameters {
        let kind = if matches!(value, Parameter::Number(_)) { "float" } else { "vec3" };
        _ = writeln!(out, "{kind} {prefix}{name};");
        names.insert(name.clone());
    }
    // A function of another type is an error in the line of the user's
    _ = writeln!(out, "vec4 {prefix}{ENTRY}(TextureContext context);");
    let file = line_name(&texture.file.display().to_string());
    _ = writeln!(out, "#line {} \"{file}\"\n{}", texture.line, renamed(&texture.source, &prefix, &names));
    let next = out.lines().count() + 2;
    _ = writeln!(out, "#line {next} \"{GENERATED}\"");
}

/// A file name as it may stand in a `#line`.
fn line_name(name: &str) -> String {
    name.chars()
        .map(|c| {
            if c == '"' || c.is_control() {
                '\''
            } else if c == '\\' {
                '/'
            } else {
                c
            }
        })
        .collect()
}

/// The body of the function of a texture.
pub(super) fn body(user: usize, texture: &GlslTexture) -> String {
    let prefix = prefix(user);
    let mut body = String::new();
    for (i, (name, value)) in texture.parameters.iter().enumerate() {
        let lanes = if matches!(value, Parameter::Number(_)) { "r" } else { "rgb" };
        let word = (1 + i as u32) * TextureInput::WORDS;
        _ = write!(body, "{prefix}{name} = texture_constant(at + {word}u).{lanes}; ");
    }
    body + &format!(
        "vec4 value = {prefix}{ENTRY}(context); vec3 most = texture_constant(at).rgb; \
         return vec4(clamp(value.rgb, -most, most), value.a);"
    )
}
