//! Materials: what a surface does with light.

use super::{Detail, Handle, Texture, Value};
use glam::Vec3;

/// How the reflectance of a conductor depends on the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fresnel {
    /// Exact conductor equations from a complex index of refraction (pbrt-v4, section 9.3.6).
    Index {
        /// Real part η, per channel.
        eta: Value<Vec3>,
        /// Imaginary part k, per channel.
        k: Value<Vec3>,
    },
    /// Exact conductor equations with η = 1 and the k that gives the reflectance at normal incidence.
    Exact,
    /// Schlick's approximation from the reflectance at normal incidence.
    Schlick,
    /// The reflectance at every angle.
    None,
}

/// Widths α of a GGX microfacet surface; smooth when both are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// Along ∂p/∂u.
    pub u: Value<f32>,
    /// Across ∂p/∂u.
    pub v: Value<f32>,
    /// The two are roughnesses, whose squares are the widths, and not the widths themselves.
    pub squared: bool,
}

impl Roughness {
    /// The same width in all directions.
    pub fn alpha(alpha: f32) -> Self {
        Self::alphas(Value::Constant(alpha), Value::Constant(alpha))
    }

    /// A width along ∂p/∂u, and one across it.
    pub fn alphas(u: Value<f32>, v: Value<f32>) -> Self {
        Self { u, v, squared: false }
    }

    /// Whether it is smooth wherever it is.
    pub fn is_smooth(&self) -> bool {
        [self.u, self.v].iter().all(|width| *width == Value::Constant(0.0))
    }
}

/// A metal: a perfect mirror when both widths are 0, else a GGX microfacet surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Conductor {
    /// Reflectance at normal incidence, in [0, 1]. Beside [`Fresnel::Index`] it has no meaning.
    pub reflectance: Value<Vec3>,
    /// Dependence on the angle.
    pub fresnel: Fresnel,
    /// GGX widths.
    pub roughness: Roughness,
}

/// Clear material: smooth when both widths are 0, else a GGX microfacet surface (Walter et al. 2007).
#[derive(Debug, Clone, PartialEq)]
pub struct Dielectric {
    /// Index of refraction inside, relative to outside.
    pub ior: Value<f32>,
    /// GGX widths.
    pub roughness: Roughness,
    /// Beer absorption a scene unit, per channel (Beer–Lambert law). What is inside is the same everywhere: no texture of a
    /// surface says what it is.
    pub absorption: Vec3,
    /// An infinitely thin sheet: reflections inside are summed and light is not bent. Smooth only.
    pub thin: bool,
}

/// What a surface does with light.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// The colour is the radiance that the camera sees, whatever the light (the lecture's first use).
    Unlit {
        /// Radiance.
        color: Value<Vec3>,
    },
    /// Lambertian (the lecture's third use).
    Diffuse {
        /// Reflectance, in [0, 1].
        color: Value<Vec3>,
    },
    /// Modified Phong: kd/π + ks (n+2)/(2π) cosⁿ, scaled down where kd + ks > 1 (Lafortune and Willems 1994).
    Phong {
        /// Diffuse coefficient.
        diffuse: Value<Vec3>,
        /// Specular coefficient.
        specular: Value<Vec3>,
        /// Exponent n ≥ 0.
        exponent: Value<f32>,
    },
    /// Metal.
    Conductor(Conductor),
    /// Glass, water.
    Dielectric(Dielectric),
}

/// Light that a surface sends out by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Emission {
    /// Radiance, W/(m² sr).
    pub radiance: Value<Vec3>,
    /// From the back too.
    pub two_sided: bool,
}

/// A material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// What the surface does with light.
    pub surface: Surface,
    /// What it sends out.
    pub emission: Option<Emission>,
    /// What it does to the surface itself.
    pub detail: Detail,
}

impl Material {
    /// A material whose surface is whole and smooth.
    pub fn new(surface: Surface, emission: Option<Emission>) -> Self {
        Self { surface, emission, detail: Detail::default() }
    }

    /// The textures that drive the light of it, not its detail.
    pub fn textures(&self) -> impl Iterator<Item = Handle<Texture>> {
        let surface = match &self.surface {
            Surface::Unlit { color } | Surface::Diffuse { color } => [color.texture(), None, None, None],
            Surface::Phong { diffuse, specular, exponent } => {
                [diffuse.texture(), specular.texture(), exponent.texture(), None]
            }
            Surface::Conductor(Conductor { reflectance, fresnel, roughness: Roughness { u, v, .. } }) => {
                let [first, second] = match fresnel {
                    Fresnel::Index { eta, k } => [eta.texture(), k.texture()],
                    _ => [reflectance.texture(), None],
                };
                [first, second, u.texture(), v.texture()]
            }
            Surface::Dielectric(Dielectric { ior, roughness: Roughness { u, v, .. }, .. }) => {
                [ior.texture(), u.texture(), v.texture(), None]
            }
        };
        let emission = self.emission.as_ref().and_then(|emission| emission.radiance.texture());
        surface.into_iter().chain([emission]).flatten()
    }
}
