//! One parameter: `"type name" values`.

use super::deprecated::{TYPES, instead};
use super::lexer::{Lexer, Token, TokenKind};
use super::place::Spot;
use crate::Result;
use crate::import::text::{shown, suggest};
use std::cell::Cell;

/// The type of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    Bool,
    Integer,
    Float,
    Point2,
    Vector2,
    Point3,
    Vector3,
    Normal,
    Rgb,
    Blackbody,
    Spectrum,
    String,
    Texture,
}

const NAMES: [(&str, Type); 13] = [
    ("bool", Type::Bool),
    ("integer", Type::Integer),
    ("float", Type::Float),
    ("point2", Type::Point2),
    ("vector2", Type::Vector2),
    ("point3", Type::Point3),
    ("vector3", Type::Vector3),
    ("normal", Type::Normal),
    ("rgb", Type::Rgb),
    ("blackbody", Type::Blackbody),
    ("spectrum", Type::Spectrum),
    ("string", Type::String),
    ("texture", Type::Texture),
];

impl Type {
    /// As it is written.
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(_, one)| *one == self).map_or("", |(name, _)| name)
    }

    /// Numbers in one value.
    pub fn width(self) -> usize {
        match self {
            Self::Point2 | Self::Vector2 => 2,
            Self::Point3 | Self::Vector3 | Self::Normal | Self::Rgb => 3,
            _ => 1,
        }
    }
}

/// What a parameter says.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    Bools(Vec<bool>),
    Integers(Vec<i32>),
    Numbers(Vec<f32>),
    Strings(Vec<String>),
}

impl Values {
    /// How many there are, counting each number.
    pub fn len(&self) -> usize {
        match self {
            Self::Bools(list) => list.len(),
            Self::Integers(list) => list.len(),
            Self::Numbers(list) => list.len(),
            Self::Strings(list) => list.len(),
        }
    }
}

/// A parameter.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    pub kind: Type,
    pub name: String,
    pub values: Values,
    pub spot: Spot,
    /// Comes from an `Attribute` directive, so that nobody needs to use it.
    pub inherited: bool,
    /// Whether it was looked at.
    pub used: Cell<bool>,
}

impl Parameter {
    /// As it is written, for messages.
    pub fn shown(&self) -> String {
        format!("\"{} {}\"", self.kind.name(), shown(&self.name))
    }
}

/// Reads the parameters that follow a directive.
pub(super) fn parameters(lexer: &mut Lexer<'_>) -> Result<Vec<Parameter>> {
    let mut list: Vec<Parameter> = Vec::new();
    while let Some(token) = lexer.peek()?.filter(|token| token.kind == TokenKind::Quoted) {
        lexer.next()?;
        let parameter = parameter(lexer, &token)?;
        if list.len() >= MOST_PARAMETERS {
            return Err(parameter.spot.error(format!("there are more than {MOST_PARAMETERS} parameters")));
        }
        if list.iter().any(|other| other.name == parameter.name) {
            let message = format!("{} is there twice", parameter.shown());
            return Err(parameter.spot.error(message).help("keep one of them"));
        }
        list.push(parameter);
    }
    Ok(list)
}

/// Most parameters of a directive: all of pbrt's names together are fewer.
pub(super) const MOST_PARAMETERS: usize = 256;

fn parameter(lexer: &mut Lexer<'_>, declaration: &Token<'_>) -> Result<Parameter> {
    let spot = lexer.spot(declaration);
    let mut words = declaration.text.split_ascii_whitespace();
    let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
        let message = format!("{} is no type and name of a parameter", declaration.shown());
        return Err(spot.error(message).help("write it as \"float radius\""));
    };
    let Some(&(_, kind)) = NAMES.iter().find(|(known, _)| *known == kind) else {
        let help = match instead(TYPES, kind) {
            Some(help) => help.to_owned(),
            None => suggest(kind, NAMES.iter().map(|(name, _)| *name), "types of parameters"),
        };
        return Err(spot.error(format!("unknown type `{}` of a parameter", shown(kind))).help(help));
    };
    let name = name.to_owned();
    let values = values(lexer, kind, &spot)?;
    let parameter = Parameter { kind, name, values, spot, inherited: false, used: Cell::new(false) };
    let (count, width) = (parameter.values.len(), kind.width());
    if count % width != 0 {
        let message = format!("{} has {count} numbers, must have {width} for each value", parameter.shown());
        return Err(parameter.spot.error(message));
    }
    Ok(parameter)
}

/// One value, or a list of them in brackets.
fn values(lexer: &mut Lexer<'_>, kind: Type, spot: &Spot) -> Result<Values> {
    let missing = || spot.error("the parameter has no value").help("add one, or a list in [ ]");
    let first = lexer.next()?.ok_or_else(missing)?;
    let mut reader = ValueReader { kind, values: None };
    match first.kind {
        TokenKind::Open => loop {
            let token = lexer.next()?.ok_or_else(|| {
                lexer
                    .spot(&first)
                    .error("the list has no end")
                    .help("add a closing ] before the end of the file")
            })?;
            match token.kind {
                TokenKind::Close => break,
                _ => reader.value(lexer, &token)?,
            }
        },
        TokenKind::Close => return Err(lexer.spot(&first).error("there is a `]` without a `[`")),
        _ => reader.value(lexer, &first)?,
    }
    Ok(reader.values.unwrap_or_else(|| match kind {
        Type::Bool => Values::Bools(Vec::new()),
        Type::Integer => Values::Integers(Vec::new()),
        Type::String | Type::Texture => Values::Strings(Vec::new()),
        _ => Values::Numbers(Vec::new()),
    }))
}

struct ValueReader {
    kind: Type,
    values: Option<Values>,
}

impl ValueReader {
    fn value(&mut self, lexer: &Lexer<'_>, token: &Token<'_>) -> Result<()> {
        let quoted = token.kind == TokenKind::Quoted;
        let wrong = |expected: &str| lexer.spot(token).error(format!("{} is no {expected}", token.shown()));
        if token.kind == TokenKind::Open {
            return Err(wrong("value").help("close the list before with ]"));
        }
        match (self.kind, self.values.as_mut()) {
            (Type::Bool, _) => {
                let value = match token.text {
                    _ if quoted => {
                        return Err(wrong("truth value").help("write true or false without quotes"));
                    }
                    "true" => true,
                    "false" => false,
                    _ => return Err(wrong("truth value").help("write true or false")),
                };
                match &mut self.values {
                    Some(Values::Bools(list)) => list.push(value),
                    other => *other = Some(Values::Bools(vec![value])),
                }
            }
            (Type::String | Type::Texture, _) | (Type::Spectrum, None | Some(Values::Strings(_)))
                if quoted =>
            {
                match &mut self.values {
                    Some(Values::Strings(list)) => list.push(token.text.to_owned()),
                    other => *other = Some(Values::Strings(vec![token.text.to_owned()])),
                }
            }
            (Type::String | Type::Texture, _) => return Err(wrong("string").help("put it into quotes")),
            (Type::Integer, _) => {
                let value = token.text.parse().ok().filter(|_| !quoted).ok_or_else(|| {
                    wrong("whole number")
                        .help("write a number from -2147483648 to 2147483647 without a point")
                })?;
                match &mut self.values {
                    Some(Values::Integers(list)) => list.push(value),
                    other => *other = Some(Values::Integers(vec![value])),
                }
            }
            _ => {
                if quoted {
                    return Err(wrong("number").help("write it without quotes"));
                }
                let value = number(token.text).ok_or_else(|| {
                    wrong("finite number").help("write one such as 0.5, -3 or 1e-4, below 3.4e38")
                })?;
                match &mut self.values {
                    Some(Values::Numbers(list)) => list.push(value as f32),
                    Some(Values::Strings(_)) => return Err(wrong("string").help("put it into quotes")),
                    other => *other = Some(Values::Numbers(vec![value as f32])),
                }
            }
        }
        Ok(())
    }
}

/// A number that is finite in 32 bits.
pub(super) fn number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| (*value as f32).is_finite())
}
