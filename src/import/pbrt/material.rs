//! `Material`, `MakeNamedMaterial` and what they do to the surface itself.

use super::dress::{Named, diffuse, interface};
use super::lexer::Lexer;
use super::parameter::Type;
use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::spectrum::{Role, Spectrum, indices};
use super::state::Target;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::{Limits, shown};
use crate::scene::{
    Bump, CoatedConductor, CoatedDiffuse, Conductor, Derivative, Detail, Dielectric, Fresnel, Handle,
    Interface, Material, Mix, NormalMap, Roughness, Surface, Tangents, Texture, Value,
};
use glam::Vec3;

/// Widths of microfacets below this are smooth, as in pbrt.
const SMOOTH: f32 = 1e-3;
/// Points of the square root by which textures of roughness become widths.
const ROOT_POINTS: usize = Texture::MOST_STOPS;
/// An index that is no number of its own.
const USUAL_INDEX: f32 = 1.5;

const KINDS: [&str; 12] = [
    "diffuse",
    "coateddiffuse",
    "conductor",
    "coatedconductor",
    "dielectric",
    "thindielectric",
    "diffusetransmission",
    "mix",
    "interface",
    "hair",
    "measured",
    "subsurface",
];

impl Reader<'_> {
    pub(super) fn material(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let (kind, from) = self.of_kind(lexer, "Material", spot, Some(Target::Material))?;
        let material = self.surface(&kind, &from)?;
        from.finish()?;
        let handle = self.scene.materials.add(spot.name(&kind), material);
        if kind == "interface" {
            self.wardrobe.interfaces.insert(handle);
        }
        self.state.material = Some(handle);
        Ok(())
    }

    pub(super) fn make_named_material(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let name = self.name(lexer, "MakeNamedMaterial", spot)?;
        let what = format!("MakeNamedMaterial \"{}\"", shown(&name));
        let from = self.parameters(lexer, what, spot, Some(Target::Material))?;
        let kind = match from.string("type")? {
            Some((_, kind)) => kind.to_owned(),
            None => return Err(from.missing("type", Type::String)),
        };
        let material = self.surface(&kind, &from)?;
        from.finish()?;
        let handle = self.named_material(&name, spot);
        if let Some(Named { made, .. }) = self.wardrobe.named.get_mut(&name)
            && std::mem::replace(made, true)
        {
            let message = format!("there is a material \"{}\" already", shown(&name));
            return Err(spot.error(message).help("choose another name"));
        }
        self.scene.materials[handle] = material;
        if kind == "interface" {
            self.wardrobe.interfaces.insert(handle);
        }
        Ok(())
    }

    fn surface(&mut self, kind: &str, from: &Parameters) -> Result<Material> {
        let surface = match kind {
            "diffuse" => Surface::diffuse(self.albedo(from, "reflectance", 0.5)?),
            "conductor" => {
                let widths = ["uroughness", "vroughness", "roughness"];
                Surface::Conductor(self.conductor(from, ["eta", "k", "reflectance"], widths)?)
            }
            "dielectric" => Surface::Dielectric(self.dielectric(from, false)?),
            "thindielectric" => Surface::Dielectric(self.dielectric(from, true)?),
            "mix" => self.mix(from)?,
            "interface" => return Ok(interface()),
            "coateddiffuse" => self.coated_diffuse(from)?,
            "coatedconductor" => self.coated_conductor(from)?,
            "diffusetransmission" => {
                let scale = from.float_or("scale", 1.0, Limits::AtLeast(0.0))?;
                let [reflectance, transmittance] = ["reflectance", "transmittance"]
                    .map(|name| self.albedo(from, name, 0.25).map(|albedo| self.scaled(albedo, scale)));
                Surface::diffuse_transmission(reflectance?, transmittance?)
            }
            "hair" | "measured" | "subsurface" => return Ok(self.replaced(kind, from)),
            _ => return Err(self.unknown("Material", kind, from, &KINDS)),
        };
        let detail = self.detail(from)?;
        Ok(Material { surface, emission: None, detail })
    }

    fn replaced(&mut self, kind: &str, from: &Parameters) -> Material {
        let what = match kind {
            "hair" => Unsupported::Hair,
            "measured" => Unsupported::Measured,
            _ => Unsupported::Subsurface,
        };
        self.unsupported(what, &from.spot);
        from.ignore(&[
            "sigma_a",
            "color",
            "eumelanin",
            "pheomelanin",
            "eta",
            "beta_m",
            "beta_n",
            "alpha",
            "filename",
            "mfp",
            "name",
            "reflectance",
            "sigma_s",
            "scale",
            "g",
            "roughness",
            "uroughness",
            "vroughness",
            "remaproughness",
            "displacement",
            "normalmap",
        ]);
        diffuse(0.5)
    }

    /// A reflectance or transmittance.
    fn albedo(&mut self, from: &Parameters, name: &'static str, default: f32) -> Result<Value<Vec3>> {
        let value = self.spectrum_texture(from, name, Role::Albedo)?;
        Ok(match value.unwrap_or(Value::Constant(Vec3::splat(default))) {
            Value::Constant(color) => Value::Constant(color.min(Vec3::ONE)),
            texture => texture,
        })
    }

    fn scaled(&mut self, albedo: Value<Vec3>, scale: f32) -> Value<Vec3> {
        match albedo {
            Value::Constant(color) => Value::Constant((color * scale).min(Vec3::ONE)),
            texture if scale == 1.0 => texture,
            value => {
                let factor = Value::Constant(scale);
                Value::Texture(self.part(Texture::Scale { value, factor }))
            }
        }
    }

    fn dielectric(&mut self, from: &Parameters, thin: bool) -> Result<Dielectric> {
        let (index, abbe) = self.index(from, "eta")?;
        let roughness = match thin {
            true => Roughness::alpha(0.0),
            false => self.boundary(from, index, ["uroughness", "vroughness", "roughness"])?,
        };
        let abbe = abbe.filter(|_| !thin);
        Ok(Dielectric { ior: Value::Constant(index), abbe, roughness, absorption: Vec3::ZERO, thin })
    }

    /// An index of refraction, and an Abbe number: a number, or a spectrum.
    fn index(&mut self, from: &Parameters, name: &'static str) -> Result<(f32, Option<f32>)> {
        let (index, abbe) = match from.float(name, Limits::Above(0.0))? {
            Some(index) => (index, None),
            None => self.spectrum(from, name)?.map_or((USUAL_INDEX, None), |spectrum| spectrum.glass()),
        };
        // pbrt takes 0 for 1
        let index = if index > 0.0 { index } else { 1.0 };
        Ok((self.within_range(from, Vec3::splat(index)).x, abbe))
    }

    /// An index of refraction, or its imaginary part, as far as indices go.
    fn within_range(&mut self, from: &Parameters, index: Vec3) -> Vec3 {
        if index.max_element() > Dielectric::MOST_INDEX {
            self.unsupported(Unsupported::LargeIndex, &from.spot);
        }
        index.clamp(Vec3::ZERO, Vec3::splat(Dielectric::MOST_INDEX))
    }

    /// Widths of microfacets of a boundary: one that bends nothing is smooth, as in pbrt.
    fn boundary(&mut self, from: &Parameters, index: f32, widths: [&'static str; 3]) -> Result<Roughness> {
        let roughness = self.roughness(from, widths, 0.0)?;
        Ok(if index == 1.0 { Roughness::alpha(0.0) } else { roughness })
    }

    /// Widths of microfacets: along u, across it, and what both are where they are not there.
    fn roughness(&mut self, from: &Parameters, names: [&'static str; 3], default: f32) -> Result<Roughness> {
        let both =
            self.float_texture(from, names[2], Limits::AtLeast(0.0))?.unwrap_or(Value::Constant(default));
        let [u, v] = [names[0], names[1]].map(|name| self.float_texture(from, name, Limits::AtLeast(0.0)));
        let remap = from.bool_or("remaproughness", true)?;
        let [u, v] = [u?.unwrap_or(both), v?.unwrap_or(both)];
        let along = self.width(u, remap);
        let across = if u == v { along } else { self.width(v, remap) };
        Ok(Roughness::alphas(along, across))
    }

    /// The width of a roughness: its square root, unless it is one.
    fn width(&mut self, roughness: Value<f32>, remap: bool) -> Value<f32> {
        match roughness {
            Value::Constant(roughness) => {
                let width = if remap { roughness.sqrt() } else { roughness };
                Value::Constant(if width < SMOOTH { 0.0 } else { width.min(1.0) })
            }
            Value::Texture(handle) if remap => {
                let points = (0..ROOT_POINTS)
                    .map(|i| i as f32 / (ROOT_POINTS - 1) as f32)
                    .map(|root| (root * root, root));
                let value = Value::Texture(handle);
                Value::Texture(self.part(Texture::Curve { value, points: points.collect(), smooth: false }))
            }
            texture => texture,
        }
    }

    fn conductor(
        &mut self,
        from: &Parameters,
        optics: [&'static str; 3],
        widths: [&'static str; 3],
    ) -> Result<Conductor> {
        let roughness = self.roughness(from, widths, 0.0)?;
        let reflectance = self.spectrum_texture(from, optics[2], Role::Albedo)?;
        if let Some(reflectance) = reflectance {
            if from.has("eta").or(from.has("k")).is_some() {
                let message = format!("{} has both `reflectance` and `eta` or `k`", from.what);
                return Err(from.error(message).help("keep one of them"));
            }
            return Ok(Conductor { reflectance, fresnel: Fresnel::Exact, roughness });
        }
        let [eta, k] = self.complex_index(from, optics[0], optics[1])?;
        let reflectance = Value::Constant(Vec3::ONE);
        Ok(Conductor { reflectance, fresnel: Fresnel::Index { eta, k }, roughness })
    }

    /// η and k, copper where they are not there.
    fn complex_index(
        &mut self,
        from: &Parameters,
        eta: &'static str,
        k: &'static str,
    ) -> Result<[Value<Vec3>; 2]> {
        let textures = [eta, k].map(|name| from.find(name, &[Type::Texture]).is_some());
        let copper = || Spectrum::copper();
        if textures == [false; 2] {
            let eta = self.spectrum(from, eta)?.unwrap_or(copper()[0].clone());
            let k = self.spectrum(from, k)?.unwrap_or(copper()[1].clone());
            return Ok(indices(&eta, &k).map(|index| Value::Constant(self.within_range(from, index))));
        }
        let [usual_eta, usual_k] = copper().map(|spectrum| Value::Constant(spectrum.rgb(Role::Unbounded)));
        let mut optic = |name, usual| {
            Ok(match self.spectrum_texture(from, name, Role::Unbounded)?.unwrap_or(usual) {
                Value::Constant(index) => Value::Constant(self.within_range(from, index)),
                texture => texture,
            })
        };
        Ok([optic(eta, usual_eta)?, optic(k, usual_k)?])
    }

    fn mix(&mut self, from: &Parameters) -> Result<Surface> {
        let names = match from.strings("materials", Type::String) {
            Some((_, [a, b])) => [a.clone(), b.clone()],
            Some((parameter, _)) => return Err(from.count(parameter, 2)),
            None => return Err(from.missing("materials", Type::String)),
        };
        let [a, b]: [Handle<Material>; 2] = names.map(|name| self.named_material(&name, &from.spot));
        let amount = self.float_texture(from, "amount", Limits::Finite)?.unwrap_or(Value::Constant(0.5));
        let amount = match amount {
            Value::Constant(amount) => Value::Constant(amount.clamp(0.0, 1.0)),
            texture => texture,
        };
        Ok(Surface::Mix(Mix { a, b, amount }))
    }

    fn coated_diffuse(&mut self, from: &Parameters) -> Result<Surface> {
        self.between_layers(from)?;
        Ok(Surface::CoatedDiffuse(CoatedDiffuse {
            color: self.albedo(from, "reflectance", 0.5)?,
            interface: self.interface(from, "eta", ["uroughness", "vroughness", "roughness"])?,
        }))
    }

    fn coated_conductor(&mut self, from: &Parameters) -> Result<Surface> {
        self.between_layers(from)?;
        let coat = ["interface.uroughness", "interface.vroughness", "interface.roughness"];
        let interface = self.interface(from, "interface.eta", coat)?;
        let base = ["conductor.uroughness", "conductor.vroughness", "conductor.roughness"];
        let conductor = self.conductor(from, ["conductor.eta", "conductor.k", "reflectance"], base)?;
        Ok(Surface::CoatedConductor(Box::new(CoatedConductor { conductor, interface })))
    }

    /// What is over a coated material. What would bend light the other way bends nothing.
    fn interface(
        &mut self,
        from: &Parameters,
        index: &'static str,
        widths: [&'static str; 3],
    ) -> Result<Interface> {
        let ior = self.index(from, index)?.0.max(1.0);
        Ok(Interface { ior, roughness: self.boundary(from, ior, widths)? })
    }

    /// What is between two layers, and how light there is followed.
    fn between_layers(&mut self, from: &Parameters) -> Result<()> {
        self.float_texture(from, "thickness", Limits::AtLeast(0.0))?;
        self.float_texture(from, "g", Limits::From(-1.0, 1.0))?;
        if self.albedo(from, "albedo", 0.0)? != Value::Constant(Vec3::ZERO) {
            self.unsupported(Unsupported::LayerMedium, &from.spot);
        }
        from.integer("maxdepth", 1, 1000)?;
        from.integer("nsamples", 1, 1000)?;
        from.bool_or("twosided", true)?;
        Ok(())
    }

    /// Bumps and normals, as pbrt has them: nothing is softened, and nothing turned back to the viewer.
    fn detail(&mut self, from: &Parameters) -> Result<Detail> {
        let bump = match self.float_texture(from, "displacement", Limits::Finite)? {
            Some(Value::Texture(texture)) => {
                Some(Bump { texture, height: 1.0, derivative: Derivative::Forward, curvature: true })
            }
            _ => None,
        };
        let normal_map = match from.file("normalmap")? {
            Some((spot, path)) => Some(NormalMap {
                texture: self.linear_picture(&spot, &path)?,
                green_down: false,
                strength: 1.0,
                tangents: Tangents::Uv,
            }),
            None => None,
        };
        if bump.is_none() && normal_map.is_none() {
            return Ok(Detail::default());
        }
        Ok(Detail { bump, normal_map, soften_terminator: false, keep_visible: false, ..Detail::default() })
    }
}
