//! Directives that move what comes after them.

use super::lexer::{Lexer, TokenKind};
use super::parameter::number;
use super::place::Spot;
use super::reader::Reader;
use super::state::Maps;
use crate::Result;
use crate::import::text::{shown, suggest};
use glam::{DAffine3, DMat3, DQuat, DVec3};

impl Reader<'_> {
    /// Does what a directive says, when it is one of those that move things.
    pub(super) fn moved(&mut self, lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<bool> {
        match word {
            "Identity" => self.place(|_| DAffine3::IDENTITY),
            "Translate" => {
                let by = DVec3::from_array(numbers(lexer, word, spot)?);
                self.place(|map| map * DAffine3::from_translation(by));
            }
            "Scale" => {
                let by = DVec3::from_array(numbers(lexer, word, spot)?);
                self.place(|map| map * DAffine3::from_scale(by));
            }
            "Rotate" => {
                let [angle, x, y, z] = numbers(lexer, word, spot)?;
                let axis = DVec3::new(x, y, z).try_normalize().ok_or_else(|| {
                    spot.error("the axis of Rotate is the zero vector").help("write Rotate ANGLE X Y Z")
                })?;
                let turn = DAffine3::from_quat(DQuat::from_axis_angle(axis, angle.to_radians()));
                self.place(|map| map * turn);
            }
            "LookAt" => {
                let look = look_at(numbers(lexer, word, spot)?, spot)?;
                self.place(|map| map * look);
            }
            "Transform" => {
                let matrix = matrix(lexer, word, spot)?;
                self.place(|_| matrix);
            }
            "ConcatTransform" => {
                let matrix = matrix(lexer, word, spot)?;
                self.place(|map| map * matrix);
            }
            "CoordinateSystem" => {
                let name = self.name(lexer, word, spot)?;
                self.systems.insert(name, self.state.maps);
            }
            "CoordSysTransform" => {
                let name = self.name(lexer, word, spot)?;
                self.state.maps = self.system(&name, spot)?;
            }
            "ActiveTransform" => self.state.active = active(lexer, spot)?,
            "TransformTimes" => self.interval = Some((numbers(lexer, word, spot)?, spot.clone())),
            "ReverseOrientation" => self.state.reverse ^= true,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Changes the maps that are active.
    fn place(&mut self, change: impl Fn(DAffine3) -> DAffine3) {
        for (map, active) in self.state.maps.iter_mut().zip(self.state.active) {
            if active {
                *map = change(*map);
            }
        }
    }

    fn system(&self, name: &str, spot: &Spot) -> Result<Maps> {
        self.systems.get(name).copied().ok_or_else(|| {
            let names = self.systems.keys().map(String::as_str);
            spot.error(format!("no coordinate system is named \"{}\"", shown(name))).help(suggest(
                name,
                names,
                "coordinate systems",
            ))
        })
    }
}

/// N numbers, in brackets or not.
fn numbers<const N: usize>(lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<[f64; N]> {
    let bracket = lexer.peek()?.is_some_and(|token| token.kind == TokenKind::Open);
    if bracket {
        lexer.next()?;
    }
    let mut values = [0.0; N];
    for (i, value) in values.iter_mut().enumerate() {
        let token = lexer.next()?.ok_or_else(|| {
            spot.error(format!("{word} has {i} numbers, must have {N}")).help("add the rest")
        })?;
        let found = (token.kind == TokenKind::Word).then(|| number(token.text)).flatten();
        *value = found.ok_or_else(|| {
            lexer
                .spot(&token)
                .error(format!("{} is no finite number", token.shown()))
                .help(format!("{word} has {N} numbers"))
        })?;
    }
    if bracket {
        let close = lexer.next()?;
        if close.is_none_or(|token| token.kind != TokenKind::Close) {
            let at = close.map_or_else(|| lexer.end(), |token| lexer.spot(&token));
            return Err(at
                .error(format!("the list of {word} has no end after {N} numbers"))
                .help("write ] there"));
        }
    }
    Ok(values)
}

/// A 4 × 4 matrix by columns.
fn matrix(lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<DAffine3> {
    let m: [f64; 16] = numbers(lexer, word, spot)?;
    let [a, b, c, d] = [0, 4, 8, 12].map(|i| DVec3::new(m[i], m[i + 1], m[i + 2]));
    if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
        return Err(spot
            .error(format!("the matrix of {word} is a projection"))
            .help("its fourth, eighth and twelfth numbers must be 0 and its last 1"));
    }
    Ok(DAffine3 { matrix3: DMat3::from_cols(a, b, c), translation: d })
}

/// From the world to a camera that looks along +z with y up and x to the right.
fn look_at(n: [f64; 9], spot: &Spot) -> Result<DAffine3> {
    let [eye, look, up] = [0, 3, 6].map(|i| DVec3::new(n[i], n[i + 1], n[i + 2]));
    let along = (look - eye)
        .try_normalize()
        .ok_or_else(|| spot.error("LookAt looks at its own position").help("move the second point"))?;
    let right = up.try_normalize().and_then(|up| up.cross(along).try_normalize()).ok_or_else(|| {
        spot.error("the up vector of LookAt is parallel to the view, or zero").help("turn it")
    })?;
    let axes = DMat3::from_cols(right, along.cross(right), along);
    Ok(DAffine3 { matrix3: axes, translation: eye }.inverse())
}

fn active(lexer: &mut Lexer<'_>, spot: &Spot) -> Result<[bool; 2]> {
    let token = lexer.next()?;
    match token.map(|token| token.text) {
        Some("All") => Ok([true; 2]),
        Some("StartTime") => Ok([true, false]),
        Some("EndTime") => Ok([false, true]),
        _ => {
            let at = token.map_or_else(|| spot.clone(), |token| lexer.spot(&token));
            Err(at.error("ActiveTransform wants a word").help("write All, StartTime or EndTime"))
        }
    }
}
