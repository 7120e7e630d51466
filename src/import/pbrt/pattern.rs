//! Textures of class checkerboard, dots and bilerp.

use super::mapping::Placement;
use super::parameters::Parameters;
use super::reader::Reader;
use super::texture::Number;
use crate::Result;
use crate::scene::{Dots, Gradient, PatternSpace, Texture, Value};
use glam::{Affine3A, Mat3, Mat3A, Vec3, Vec3A};

/// Radius of pbrt's dots.
const DOT_RADIUS: f32 = 0.35;
/// Coordinates up to which a bilerp goes on; a power of two, so that gradients are exact.
const FAR: f32 = 256.0;

const ZERO: Value<Vec3> = Value::Constant(Vec3::ZERO);
const ONE: Value<Vec3> = Value::Constant(Vec3::ONE);

impl Reader<'_> {
    pub(super) fn checkerboard(&mut self, from: &Parameters, number: Number) -> Result<Texture> {
        let dimensions = from.integer_or("dimension", 2, 2, 3)?;
        let (even, odd) = (self.input(from, "tex1", number, 1.0)?, self.input(from, "tex2", number, 0.0)?);
        if dimensions == 3 {
            return Ok(Texture::Checker { dimensions, even, odd, space: self.solid(from, 1.0)? });
        }
        let placement = self.placement(from)?;
        let space = self.flat(&placement);
        let pattern = |even, odd| Texture::Checker { dimensions, even, odd, space };
        Ok(self.patterned(&placement, even, odd, pattern))
    }

    /// pbrt takes `inside` for what is outside of the dots, and the reverse.
    pub(super) fn dots(&mut self, from: &Parameters, number: Number) -> Result<Texture> {
        let (inside, outside) =
            (self.input(from, "inside", number, 1.0)?, self.input(from, "outside", number, 0.0)?);
        let placement = self.placement(from)?;
        let space = self.flat(&placement);
        let pattern = |outside, inside| Texture::Dots(Dots { inside, outside, radius: DOT_RADIUS, space });
        Ok(self.patterned(&placement, inside, outside, pattern))
    }

    /// A pattern of two inputs. Where it has a mapping of its own, inputs that are textures keep theirs: the pattern of 0 and 1 is
    /// mapped, and they are mixed by it.
    fn patterned(
        &mut self,
        placement: &Placement,
        a: Value<Vec3>,
        b: Value<Vec3>,
        pattern: impl FnOnce(Value<Vec3>, Value<Vec3>) -> Texture,
    ) -> Texture {
        if placement.mapping.is_none() || (a.texture().is_none() && b.texture().is_none()) {
            return self.placed(placement, pattern(a, b));
        }
        let amount = self.placed(placement, pattern(ZERO, ONE));
        Texture::Mix { a, b, amount: Value::Texture(self.part(amount)) }
    }

    /// Between four corners.
    pub(super) fn bilerp(&mut self, from: &Parameters, number: Number) -> Result<Texture> {
        let mut corner = |name, default| self.input(from, name, number, default);
        let [v00, v01] = [corner("v00", 0.0)?, corner("v01", 1.0)?];
        let [v10, v11] = [corner("v10", 0.0)?, corner("v11", 1.0)?];
        let placement = self.placement(from)?;
        let [s, t] = self.ramps(&placement);
        let [a, b] = [[v00, v10], [v01, v11]].map(|[from, to]| {
            let side = self.sum(from, to, s);
            Value::Texture(self.part(side))
        });
        Ok(self.sum(a, b, t))
    }

    /// s and t of a placement, as far as [`FAR`].
    fn ramps(&mut self, placement: &Placement) -> [Value<Vec3>; 2] {
        let space = self.flat(placement);
        let turned = Affine3A::from_mat3(Mat3::from_cols(Vec3::Y, Vec3::X, Vec3::Z));
        // From −FAR to FAR over a gradient's 0 to 1
        let far = Affine3A {
            matrix3: Mat3A::from_diagonal(Vec3::splat(0.5 / FAR)),
            translation: Vec3A::splat(0.5),
        };
        let [low, high] = [-FAR, FAR].map(|end| Value::Constant(Vec3::splat(end)));
        [far, far * turned].map(|map| {
            let space = PatternSpace { pattern_from_space: map * space.pattern_from_space, ..space };
            let ramp =
                self.placed(placement, Texture::Gradient { shape: Gradient::Linear, low, high, space });
            Value::Texture(self.part(ramp))
        })
    }
}
