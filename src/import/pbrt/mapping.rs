//! Mappings of textures in two dimensions.

use super::parameters::Parameters;
use super::reader::Reader;
use crate::import::text::Limits;
use crate::scene::{
    Coordinates, Mapping, MappingKind, MappingSpace, PatternSpace, Texture, UvTransform, Value,
};
use crate::{Error, Result};
use glam::{Affine3A, DAffine3, Mat3A, Vec2, Vec3, Vec3A};

/// Where a texture in two dimensions is.
pub(super) struct Placement {
    /// From the coordinates that `mapping` gives to s and t of pbrt.
    pub uv: UvTransform,
    /// What gives coordinates in place of the uv of the surface.
    pub mapping: Option<Mapping>,
}

impl Reader<'_> {
    /// Where textures in space are: the current transform places their space in the world.
    pub(super) fn solid(&self, from: &Parameters, scale: f32) -> Result<PatternSpace> {
        let scaled = DAffine3::from_scale(glam::DVec3::splat(scale.into()));
        let map = scaled * self.texture_from_world(from)?;
        Ok(PatternSpace {
            pattern_from_space: narrow_flat(&map),
            filter_width: self.filter_width(),
            ..PatternSpace::new(Coordinates::World)
        })
    }

    fn texture_from_world(&self, from: &Parameters) -> Result<DAffine3> {
        let map = self.state.maps[0].inverse();
        let lost =
            || from.error("the transform of the texture cannot be inverted").help("give every axis a size");
        if narrow_flat(&map).is_finite() { Ok(map) } else { Err(lost()) }
    }

    fn filter_width(&self) -> f32 {
        if self.filtered { 1.0 } else { 0.0 }
    }

    /// `mapping` and what belongs to it.
    pub(super) fn placement(&self, from: &Parameters) -> Result<Placement> {
        let kinds = [
            ("uv", MappingKind::Uv),
            ("spherical", MappingKind::Spherical),
            ("cylindrical", MappingKind::Cylindrical),
            ("planar", MappingKind::Planar),
        ];
        let kind = from.choice_or("mapping", MappingKind::Uv, &kinds)?;
        if kind == MappingKind::Uv {
            let scale = [
                from.float_or("uscale", 1.0, Limits::Finite)?,
                from.float_or("vscale", 1.0, Limits::Finite)?,
            ];
            let uv = UvTransform { scale: Vec2::from_array(scale), rotate: 0.0, offset: offset(from)? };
            return Ok(Placement { uv, mapping: None });
        }
        let map = narrow_flat(&self.texture_from_world(from)?);
        let (uv, mapping_from_space) = match kind {
            // (θ, φ) in parts of half and of whole turns: 1 − v and u
            MappingKind::Spherical => {
                (UvTransform { rotate: 90.0, offset: Vec2::X, ..UvTransform::default() }, map)
            }
            MappingKind::Cylindrical => {
                (UvTransform { offset: Vec2::new(0.5, 0.0), ..UvTransform::default() }, map)
            }
            _ => {
                let (s, t) = (from.vector_or("v1", Vec3::X)?, from.vector_or("v2", Vec3::Y)?);
                // The third row gives no coordinate
                let rows = Mat3A::from_cols(s.into(), t.into(), Vec3A::ZERO).transpose();
                let uv = UvTransform { offset: offset(from)?, ..UvTransform::default() };
                (uv, Affine3A { matrix3: rows, translation: Vec3A::ZERO } * map)
            }
        };
        if !mapping_from_space.is_finite() {
            return Err(self.far(from));
        }
        let (pole_u, seam_blend, sharpness) = (0.0, 0.0, 4.0);
        let mapping =
            Mapping { kind, space: MappingSpace::World, mapping_from_space, pole_u, seam_blend, sharpness };
        Ok(Placement { uv, mapping: Some(mapping) })
    }

    fn far(&self, from: &Parameters) -> Error {
        from.error("the mapping is too far away").help("use smaller numbers")
    }

    /// The space of a pattern at a placement.
    pub(super) fn flat(&self, placement: &Placement) -> PatternSpace {
        let uv = placement.uv.matrix();
        let [x, y, at] = [uv.x_axis, uv.y_axis, uv.translation].map(|v| Vec3A::from(v.extend(0.0)));
        PatternSpace {
            pattern_from_space: Affine3A { matrix3: Mat3A::from_cols(x, y, Vec3A::Z), translation: at },
            filter_width: self.filter_width(),
            ..PatternSpace::new(Coordinates::Uv)
        }
    }

    /// A texture at the coordinates of a placement. Textures that it is made of must have none of their own.
    pub(super) fn placed(&mut self, placement: &Placement, texture: Texture) -> Texture {
        let Some(mapping) = placement.mapping else { return texture };
        Texture::Mapped { value: Value::Texture(self.part(texture)), mapping }
    }
}

fn offset(from: &Parameters) -> Result<Vec2> {
    Ok(Vec2::new(
        from.float_or("udelta", 0.0, Limits::Finite)?,
        from.float_or("vdelta", 0.0, Limits::Finite)?,
    ))
}

/// A map in 32 bits, whether or not it can be inverted.
fn narrow_flat(map: &DAffine3) -> Affine3A {
    let [x, y, z, at] =
        [map.x_axis, map.y_axis, map.z_axis, map.translation].map(|column| Vec3A::from(column.as_vec3()));
    Affine3A { matrix3: Mat3A::from_cols(x, y, z), translation: at }
}
