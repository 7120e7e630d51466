//! Materials: what a surface does with light.

use super::{Bsdf, Detail, Handle, Sides, Store, Texture, Value};
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

    fn textures(&self) -> [Option<Handle<Texture>>; 2] {
        [self.u.texture(), self.v.texture()]
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

impl Conductor {
    fn textures(&self) -> [Option<Handle<Texture>>; 4] {
        let optics = match self.fresnel {
            Fresnel::Index { eta, k } => [eta.texture(), k.texture()],
            _ => [self.reflectance.texture(), None],
        };
        let [u, v] = self.roughness.textures();
        [optics[0], optics[1], u, v]
    }
}

/// Clear material: smooth when both widths are 0, else a GGX microfacet surface (Walter et al. 2007).
#[derive(Debug, Clone, PartialEq)]
pub struct Dielectric {
    /// Index of refraction inside, relative to outside.
    pub ior: Value<f32>,
    /// GGX widths.
    pub roughness: Roughness,
    /// Abbe number (n_d − 1) / (n_F − n_C), above 0: each colour has an index of its own, by Cauchy's formula, and `ior` is that of the
    /// d line; none = all colours have the same.
    pub abbe: Option<f32>,
    /// Beer absorption a scene unit, per channel (Beer–Lambert law). What is inside is the same everywhere: no texture of a
    /// surface says what it is.
    pub absorption: Vec3,
    /// An infinitely thin sheet: reflections inside are summed and light is not bent. Smooth only.
    pub thin: bool,
}

impl Dielectric {
    /// Largest index of refraction, and largest imaginary part of one: real materials reach about 8; it leaves room and keeps squares
    /// harmless.
    pub const MOST_INDEX: f32 = 100.0;
    /// No glass bends colours as differently as that; diamond has 55, dense flint glass 20.
    pub const LEAST_ABBE: f32 = 1.0;
    /// Above it there is as good as no dispersion: red and blue are less than 0.0001 apart.
    pub const MOST_ABBE: f32 = 1e4;

    /// An Abbe number brought into its range; none of a number that is none, or as good as none.
    pub fn abbe_within(abbe: f32) -> Option<f32> {
        (abbe > 0.0 && abbe <= Self::MOST_ABBE).then(|| abbe.max(Self::LEAST_ABBE))
    }
}

/// A dielectric interface over an opaque base, with nothing in between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interface {
    /// Index of refraction of what is below it relative to outside, at least 1.
    pub ior: f32,
    /// GGX widths.
    pub roughness: Roughness,
}

/// A Lambertian base under an interface, with all light that goes to and fro between them (Saunderson 1942).
#[derive(Debug, Clone, PartialEq)]
pub struct CoatedDiffuse {
    /// Reflectance of the base, in [0, 1].
    pub color: Value<Vec3>,
    /// What is over it.
    pub interface: Interface,
}

/// Metal under an interface.
#[derive(Debug, Clone, PartialEq)]
pub struct CoatedConductor {
    /// The metal as it is in air: its index of refraction is that relative to outside, also that of [`Fresnel::Exact`].
    pub conductor: Conductor,
    /// What is over it.
    pub interface: Interface,
}

/// The model of glTF 2.0 (appendix B) with its extensions ior, specular, transmission, volume, dispersion, clearcoat and sheen.
#[derive(Debug, Clone, PartialEq)]
pub struct Principled {
    /// Reflectance of the diffuse base and of metal; colour of light that goes through. In [0, 1].
    pub base_color: Value<Vec3>,
    /// 0 is a dielectric, 1 is metal.
    pub metallic: Value<f32>,
    /// GGX widths; those below 0.001 count as 0.001.
    pub roughness: Roughness,
    /// Index of refraction of the dielectric, at least 1.
    pub ior: Value<f32>,
    /// Weight of what the dielectric reflects, in [0, 1].
    pub specular: Value<f32>,
    /// Factor on what the dielectric reflects head-on.
    pub specular_color: Value<Vec3>,
    /// Part of the base that lets light through and does not scatter it, in [0, 1].
    pub transmission: Value<f32>,
    /// As [`Dielectric::abbe`].
    pub abbe: Option<f32>,
    /// Beer absorption a scene unit inside, per channel.
    pub absorption: Vec3,
    /// A sheet without an inside: light that goes through is not bent.
    pub thin: bool,
    /// Weight of a coat with an index of 1.5, in [0, 1].
    pub clearcoat: Value<f32>,
    /// Roughness of the coat; its square is the GGX width.
    pub clearcoat_roughness: Value<f32>,
    /// Reflectance of cloth fibres that are grazed, in [0, 1].
    pub sheen_color: Value<Vec3>,
    /// Roughness of the sheen, in [0.3, 1].
    pub sheen_roughness: Value<f32>,
}

impl Default for Principled {
    fn default() -> Self {
        let (black, none) = (Value::Constant(Vec3::ZERO), Value::Constant(0.0));
        let half = Value::Constant(0.5);
        Self {
            base_color: Value::Constant(Vec3::splat(0.5)),
            metallic: none,
            roughness: Roughness { u: half, v: half, squared: true },
            ior: Value::Constant(1.5),
            specular: Value::Constant(1.0),
            specular_color: Value::Constant(Vec3::ONE),
            transmission: none,
            abbe: None,
            absorption: Vec3::ZERO,
            thin: false,
            clearcoat: none,
            clearcoat_roughness: none,
            sheen_color: black,
            sheen_roughness: half,
        }
    }
}

impl Principled {
    /// Whether it is the boundary of something that light goes through, with an inside.
    pub fn has_inside(&self) -> bool {
        !self.thin && self.transmission != Value::Constant(0.0)
    }
}

/// Two materials, of which each scattering event sees one.
#[derive(Debug, Clone, PartialEq)]
pub struct Mix {
    /// For an amount of 0.
    pub a: Handle<Material>,
    /// For an amount of 1.
    pub b: Handle<Material>,
    /// Chance of `b`, in [0, 1].
    pub amount: Value<f32>,
}

/// What a surface does with light.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// The colour is the radiance that the camera sees, whatever the light (the lecture's first use).
    Unlit {
        /// Radiance.
        color: Value<Vec3>,
    },
    /// One of the table [`BSDFS`](super::BSDFS).
    Bsdf(Bsdf),
    /// Metal.
    Conductor(Conductor),
    /// Glass, water.
    Dielectric(Dielectric),
    /// Paint, plastic, lacquered wood.
    CoatedDiffuse(CoatedDiffuse),
    /// Lacquered metal.
    CoatedConductor(Box<CoatedConductor>),
    /// The model of glTF.
    Principled(Box<Principled>),
    /// One of two materials.
    Mix(Mix),
}

/// Light that a surface sends out by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Emission {
    /// Radiance, W/(m² sr).
    pub radiance: Value<Vec3>,
    /// From the back too, where the surface is there from the back.
    pub two_sided: bool,
}

/// A material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// What the surface does with light.
    pub surface: Surface,
    /// What it sends out. A mix sends this out and nothing of what its parts do.
    pub emission: Option<Emission>,
    /// What it does to the surface itself.
    pub detail: Detail,
}

impl Material {
    /// A material whose surface is whole and smooth.
    pub fn new(surface: Surface, emission: Option<Emission>) -> Self {
        Self { surface, emission, detail: Detail::default() }
    }

    /// Whether light goes out from the back too.
    pub fn shines_behind(&self) -> bool {
        self.emission.as_ref().is_some_and(|emission| emission.two_sided) && self.detail.sides == Sides::Both
    }

    /// Most mixes on the way from a material to one that is no mix.
    pub const DEEPEST_MIX: u32 = 8;

    /// What is wrong with a material that has no [`Self::mix_depth`].
    pub fn endless(name: &str) -> String {
        let most = Self::DEEPEST_MIX;
        format!("material `{name}` is a mix of itself, or of more than {most} mixes one in the other")
    }

    /// How many mixes are one in the other; none when that has no end or is more than [`Self::DEEPEST_MIX`].
    pub fn mix_depth(materials: &Store<Self>, handle: Handle<Self>) -> Option<u32> {
        fn depth(materials: &Store<Material>, handle: Handle<Material>, room: u32) -> Option<u32> {
            let Surface::Mix(mix) = &materials[handle].surface else { return Some(0) };
            let room = room.checked_sub(1)?;
            let [a, b] = [mix.a, mix.b].map(|part| depth(materials, part, room));
            Some(1 + a?.max(b?))
        }
        depth(materials, handle, Self::DEEPEST_MIX)
    }

    /// The textures that drive the light of it, not its detail.
    pub fn textures(&self) -> impl Iterator<Item = Handle<Texture>> {
        let widths = Roughness::textures;
        let surface = match &self.surface {
            Surface::Unlit { color } => vec![color.texture()],
            Surface::Bsdf(bsdf) => bsdf.textures(),
            Surface::Conductor(conductor) => conductor.textures().to_vec(),
            Surface::CoatedDiffuse(CoatedDiffuse { color, interface }) => {
                [&[color.texture()][..], &widths(&interface.roughness)].concat()
            }
            Surface::CoatedConductor(coated) => {
                [&coated.conductor.textures()[..], &widths(&coated.interface.roughness)].concat()
            }
            Surface::Dielectric(Dielectric { ior, roughness, .. }) => {
                [&[ior.texture()][..], &widths(roughness)].concat()
            }
            Surface::Principled(p) => {
                let colors = [&p.base_color, &p.specular_color, &p.sheen_color].map(Value::texture);
                let layers = [&p.clearcoat, &p.clearcoat_roughness, &p.sheen_roughness].map(Value::texture);
                let base = [&p.metallic, &p.ior, &p.specular, &p.transmission].map(Value::texture);
                [&colors[..], &layers, &base, &widths(&p.roughness)].concat()
            }
            Surface::Mix(mix) => vec![mix.amount.texture()],
        };
        let emission = self.emission.as_ref().and_then(|emission| emission.radiance.texture());
        surface.into_iter().chain([emission]).flatten()
    }
}
