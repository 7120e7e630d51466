//! What a material does to the surface itself.

use super::reader::Reader;
use super::text::Limits;
use super::view::View;
use crate::Result;
use crate::scene::{Detail, Opacity, Value};
use glam::Vec3;

/// What an opacity and a filter may be.
const SHARE: Limits = Limits::From(0.0, 1.0);

impl Reader<'_> {
    pub fn detail(&self, view: &View<'_>) -> Result<Detail> {
        Ok(Detail { opacity: self.opacity(view)? })
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
            cutoff: view.get("opacity_cutoff").map(|item| item.f32(SHARE)).transpose()?,
            filter: match view.get("filter_color") {
                Some(item) => self.color(item, SHARE)?,
                None => Value::Constant(Vec3::ONE),
            },
        })
    }
}
