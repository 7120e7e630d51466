//! What a material does to the surface itself.

use super::keys::{BUMP, NORMAL_MAP};
use super::reader::Reader;
use super::text::Limits;
use super::view::{Item, View};
use crate::Result;
use crate::scene::{Bump, Derivative, Detail, NormalMap, Opacity, Sides, Tangents, Value};
use glam::Vec3;

/// What an opacity and a filter may be.
const SHARE: Limits = Limits::From(0.0, 1.0);

impl Reader<'_> {
    pub fn detail(&self, view: &View<'_>) -> Result<Detail> {
        let default = Detail::default();
        let normals = view.get("bump").or(view.get("normal_map"));
        for key in ["soften_terminator", "keep_visible"] {
            if let (Some(item), None) = (view.get(key), normals) {
                let error = item.error(format!("{} needs `bump` or `normal_map`", item.name()));
                return Err(error.help("add one of them"));
            }
        }
        Ok(Detail {
            opacity: self.opacity(view)?,
            sides: sides(view)?,
            bump: view.get("bump").map(|item| self.bump(item)).transpose()?,
            normal_map: view.get("normal_map").map(|item| self.normal_map(item)).transpose()?,
            soften_terminator: view.bool_or("soften_terminator", default.soften_terminator)?,
            keep_visible: view.bool_or("keep_visible", default.keep_visible)?,
        })
    }

    fn bump(&self, item: Item<'_>) -> Result<Bump> {
        let view = View::new(self.sources, item.node, item.name(), BUMP)?;
        let rules = [
            ("kernel", Derivative::Kernel),
            ("forward", Derivative::Forward),
            ("analytic", Derivative::Analytic),
        ];
        Ok(Bump {
            texture: self.textures.find(view.need("texture")?)?,
            height: view.f32_or("height", 1.0, Limits::Finite)?,
            derivative: view.choice_or("derivative", Derivative::Kernel, &rules)?,
            curvature: view.bool_or("curvature_term", true)?,
        })
    }

    fn normal_map(&self, item: Item<'_>) -> Result<NormalMap> {
        let view = View::new(self.sources, item.node, item.name(), NORMAL_MAP)?;
        let tangents = [("mikktspace", Tangents::MikkTSpace), ("uv", Tangents::Uv)];
        Ok(NormalMap {
            texture: self.textures.find(view.need("texture")?)?,
            green_down: view.choice_or("green", false, &[("up", false), ("down", true)])?,
            strength: view.f32_or(
                "strength",
                1.0,
                Limits::From(-NormalMap::MOST_STRENGTH, NormalMap::MOST_STRENGTH),
            )?,
            tangents: view.choice_or("tangents", Tangents::MikkTSpace, &tangents)?,
        })
    }

    fn opacity(&self, view: &View<'_>) -> Result<Opacity> {
        let Some(item) = view.get("opacity") else {
            return match ["opacity_cutoff", "filter_color"].iter().find_map(|key| view.get(key)) {
                Some(item) => {
                    Err(item.error(format!("{} needs `opacity`", item.name())).help("add `opacity`"))
                }
                None => Ok(Opacity::default()),
            };
        };
        Ok(Opacity {
            value: self.number(item, SHARE)?,
            cutoff: view.get("opacity_cutoff").map(|item| item.f32(Limits::AtLeast(0.0))).transpose()?,
            filter: match view.get("filter_color") {
                Some(item) => self.color(item, SHARE)?,
                None => Value::Constant(Vec3::ONE),
            },
        })
    }
}

/// From where a surface is there. What is not there from behind sends out no light there.
fn sides(view: &View<'_>) -> Result<Sides> {
    let sides = view.choice_or("sides", Sides::Both, &[("both", Sides::Both), ("front", Sides::Front)])?;
    match view.get("two_sided") {
        Some(item) if sides == Sides::Front && item.bool()? => Err(item
            .error("`two_sided` light needs a surface that is there from both sides")
            .help("remove `two_sided`, or `sides`")),
        _ => Ok(sides),
    }
}
