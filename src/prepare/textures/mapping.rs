//! Mapped textures: their record, and the body of their function.

use super::builder::{Builder, Node, Words};
use super::shape::{Input, Shape};
use crate::layout::{Mapping as MappingRecord, Record as _};
use crate::prepare::rows;
use crate::scene::{Mapping, MappingKind, MappingSpace, Value};
use glam::Vec3;

/// What a mapping is, but for its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MappingShape {
    kind: MappingKind,
    space: MappingSpace,
    seam: bool,
}

impl Builder<'_> {
    pub(super) fn mapped(&mut self, value: &Value<Vec3>, mapping: &Mapping) -> Node {
        let input = self.input(value);
        if let Some(color) = input.constant {
            return self.constant(color);
        }
        let Mapping { kind, space, pole_u, seam_blend, sharpness, .. } = *mapping;
        let [row0, row1, row2] = rows(&mapping.mapping_from_space.as_daffine3());
        let mut words = Words::default();
        words.push(MappingRecord { row0, row1, row2, pole_u, seam_blend, sharpness, spare: 0 });
        let shape = MappingShape { kind, space, seam: seam_blend > 0.0 };
        self.join(Shape::Mapped(shape, [input.input()]), words, &[input], input.range)
    }
}

impl MappingShape {
    /// The body of the function of a texture that is mapped.
    pub(super) fn body(self, input: Input) -> String {
        let Input::Texture(shape) = input else { return "return texture_constant(at);".to_owned() };
        let value = |context: &str| format!("texture_{shape}(input_at, {context})");
        let (point, width, normal) = match self.space {
            MappingSpace::Object => {
                ("context.object_position", "context.object_footprint", "context.object_normal")
            }
            MappingSpace::World => ("context.position", "context.footprint", "context.normal"),
        };
        let mut body = format!("uint input_at = texture_input(at + {}u); ", MappingRecord::WORDS);
        let name = match self.kind {
            MappingKind::Uv => "uv",
            MappingKind::Uv1 => "uv1",
            MappingKind::Spherical => "spherical",
            MappingKind::Cylindrical => "cylindrical",
            MappingKind::Planar => "planar",
            MappingKind::Cube => "cube",
            MappingKind::Triplanar => {
                let planes = ["x", "y", "z"].map(|axis| {
                    value(&format!("mapped_{axis}(mapping, {point}, {width}, {normal}, context)"))
                });
                body += "Mapping mapping = mapping_fetch(at); ";
                return body + &format!("return triplanar_mix(mapping, {normal}, {});", planes.join(", "));
            }
        };
        body +=
            &format!("TextureContext mapped = mapped_{name}(mapping_fetch(at), {point}, {width}, context); ");
        if !self.seam {
            return body + &format!("return {};", value("mapped"));
        }
        body += "float blend = mapping_fetch(at).seam_blend; ";
        let [start, end] = [0, 1].map(|turn| value(&format!("seam_turn(mapped, blend, {turn}.0)")));
        body + &format!("return seam_mix(mapped, blend, {start}, {end});")
    }
}
