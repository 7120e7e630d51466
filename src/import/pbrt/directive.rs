//! One directive.

use super::color_space::ColorSpace;
use super::deprecated::{DIRECTIVES, instead};
use super::lexer::Lexer;
use super::place::Spot;
use super::reader::Reader;
use super::state::{Block, Target};
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::{shown, suggest};

/// Directives before `WorldBegin`, after it, and everywhere.
const OUTSET: &[&str] = &["Accelerator", "Camera", "Film", "Integrator", "Option", "PixelFilter", "Sampler"];
const WORLD: &[&str] = &[
    "AreaLightSource",
    "LightSource",
    "MakeNamedMaterial",
    "Material",
    "NamedMaterial",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "ReverseOrientation",
    "Shape",
    "Texture",
];
const ANYWHERE: &[&str] = &[
    "ActiveTransform",
    "Attribute",
    "AttributeBegin",
    "AttributeEnd",
    "ColorSpace",
    "ConcatTransform",
    "CoordSysTransform",
    "CoordinateSystem",
    "Identity",
    "Import",
    "Include",
    "LookAt",
    "MakeNamedMedium",
    "MediumInterface",
    "Rotate",
    "Scale",
    "Transform",
    "TransformBegin",
    "TransformEnd",
    "TransformTimes",
    "Translate",
    "WorldBegin",
];

impl Reader<'_> {
    /// Does what a directive says.
    pub(super) fn directive(&mut self, lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<()> {
        if OUTSET.contains(&word) && self.outset.is_none() {
            return Err(spot.error(format!("{word} is after WorldBegin")).help("write it before WorldBegin"));
        }
        if WORLD.contains(&word) && self.outset.is_some() {
            return Err(spot
                .error(format!("{word} is before WorldBegin"))
                .help("write WorldBegin before it"));
        }
        if self.moved(lexer, word, spot)? {
            return Ok(());
        }
        match word {
            "Accelerator" | "Camera" | "Film" | "Integrator" | "PixelFilter" | "Sampler" => {
                self.set_out(lexer, word, spot)
            }
            "Option" => self.option(lexer, spot),
            "WorldBegin" => self.world_begin(spot),
            "Include" | "Import" => self.include(lexer, word, spot),
            "Attribute" => self.attribute(lexer, spot),
            "AttributeBegin" => {
                self.begin(Block::Attribute, spot);
                Ok(())
            }
            "AttributeEnd" => self.end(Block::Attribute, spot),
            "TransformBegin" => {
                self.begin(Block::Transform, spot);
                Ok(())
            }
            "TransformEnd" => self.end(Block::Transform, spot),
            "ColorSpace" => self.color_space(lexer, spot),
            "MediumInterface" => self.medium_interface(lexer, spot),
            "MakeNamedMedium" => {
                self.name(lexer, word, spot)?;
                self.parameters(lexer, word.into(), spot, None)?;
                self.unsupported(Unsupported::NamedMedium, spot);
                Ok(())
            }
            "Texture" => self.texture(lexer, spot),
            "Material" => self.material(lexer, spot),
            "MakeNamedMaterial" => self.make_named_material(lexer, spot),
            "NamedMaterial" => {
                let name = self.name(lexer, word, spot)?;
                self.state.material = Some(self.named_material(&name, spot));
                Ok(())
            }
            "LightSource" => self.light_source(lexer, spot),
            "AreaLightSource" => self.area_light_source(lexer, spot),
            "Shape" => self.shape(lexer, spot),
            "ObjectBegin" => self.object_begin(lexer, spot),
            "ObjectEnd" => self.object_end(spot),
            "ObjectInstance" => self.object_instance(lexer, spot),
            _ => {
                let known = || OUTSET.iter().chain(WORLD).chain(ANYWHERE).copied();
                let help = match instead(DIRECTIVES, word) {
                    Some(help) => help.to_owned(),
                    None => suggest(word, known(), "directives"),
                };
                Err(spot.error(format!("unknown directive `{}`", shown(word))).help(help))
            }
        }
    }

    fn color_space(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let name = self.name(lexer, "ColorSpace", spot)?;
        self.state.color_space = match name.as_str() {
            "srgb" => ColorSpace::Srgb,
            "dci-p3" => ColorSpace::DciP3,
            "rec2020" => ColorSpace::Rec2020,
            "aces2065-1" => {
                self.unsupported(Unsupported::AcesSpace, spot);
                ColorSpace::Srgb
            }
            _ => {
                let known = ["srgb", "dci-p3", "rec2020", "aces2065-1"];
                return Err(spot
                    .error(format!("there is no colour space \"{}\"", shown(&name)))
                    .help(suggest(&name, known.into_iter(), "colour spaces")));
            }
        };
        Ok(())
    }

    /// `MediumInterface "inside" "outside"`, of which the second may be left out. Vacuum is nothing to speak of.
    fn medium_interface(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let mut names = vec![self.name(lexer, "MediumInterface", spot)?];
        if lexer.peek()?.is_some_and(|token| token.kind == super::lexer::TokenKind::Quoted) {
            names.push(self.name(lexer, "MediumInterface", spot)?);
        }
        if names.iter().any(|name| !name.is_empty()) {
            let what = if self.outset.is_some() { Unsupported::CameraMedium } else { Unsupported::Medium };
            self.unsupported(what, spot);
        }
        Ok(())
    }

    /// The parameters of a directive that begins with two names and a class: `Texture "name" "type" "class"`.
    pub(super) fn texture_head(
        &mut self,
        lexer: &mut Lexer<'_>,
        spot: &Spot,
    ) -> Result<([String; 3], super::parameters::Parameters)> {
        let mut names = || self.name(lexer, "Texture", spot);
        let head = [names()?, names()?, names()?];
        let what = format!("Texture \"{}\" of class \"{}\"", shown(&head[0]), shown(&head[2]));
        let from = self.parameters(lexer, what, spot, Some(Target::Texture))?;
        Ok((head, from))
    }
}
