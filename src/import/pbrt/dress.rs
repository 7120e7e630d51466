//! Materials of shapes: in pbrt light and opacity belong to the shape, here to the material.

use super::place::Spot;
use super::reader::Reader;
use super::shape::Looks;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::{shown, suggest};
use crate::scene::{Detail, Emission, Handle, Material, Opacity, Surface, Tangents, Value};
use glam::Vec3;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Names of materials, and those that shapes wear.
#[derive(Debug, Default)]
pub(super) struct Wardrobe {
    /// By name: its handle, whether it has been made, and where it was named first.
    pub named: BTreeMap<String, Named>,
    /// The material of a scene that names none.
    usual: Option<Handle<Material>>,
    /// Those that are not there.
    pub interfaces: BTreeSet<Handle<Material>>,
    worn: HashMap<Key, Handle<Material>>,
    dresses: Vec<Dress>,
}

/// A named material.
#[derive(Debug)]
pub(super) struct Named {
    pub handle: Handle<Material>,
    pub made: bool,
    pub spot: Spot,
}

/// A material with what a shape adds to it. It is made in the end, when all materials are known.
#[derive(Debug)]
struct Dress {
    handle: Handle<Material>,
    base: Handle<Material>,
    emission: Option<Emission>,
    alpha: Option<Value<f32>>,
    tangents: bool,
    spot: Spot,
}

/// What tells dresses apart: the bits of all numbers.
type Key = (Handle<Material>, Option<([u32; 4], bool)>, Option<[u32; 2]>, bool);

fn key(base: Handle<Material>, emission: Option<&Emission>, looks: &Looks) -> Key {
    let emission = emission.map(|emission| {
        let bits = match emission.radiance {
            Value::Constant(color) => {
                let [r, g, b] = color.to_array().map(f32::to_bits);
                [0, r, g, b]
            }
            Value::Texture(handle) => [1, handle.index() as u32, 0, 0],
        };
        (bits, emission.two_sided)
    });
    let alpha = looks.alpha.map(|alpha| match alpha {
        Value::Constant(number) => [0, number.to_bits()],
        Value::Texture(handle) => [1, handle.index() as u32],
    });
    (base, emission, alpha, looks.tangents)
}

/// A diffuse material.
pub(super) fn diffuse(reflectance: f32) -> Material {
    Material::new(Surface::diffuse(Value::Constant(Vec3::splat(reflectance))), None)
}

impl Reader<'_> {
    /// The material with a name, which may be made later.
    pub(super) fn named_material(&mut self, name: &str, spot: &Spot) -> Handle<Material> {
        if let Some(named) = self.wardrobe.named.get(name) {
            return named.handle;
        }
        let handle = self.scene.materials.add(name, diffuse(0.5));
        self.wardrobe.named.insert(name.into(), Named { handle, made: false, spot: spot.clone() });
        handle
    }

    /// The material of the next shape, with what the shape adds to it.
    pub(super) fn worn(&mut self, emission: Option<Emission>, looks: &Looks) -> Handle<Material> {
        let base = match self.state.material {
            Some(handle) => handle,
            None => {
                let materials = &mut self.scene.materials;
                *self.wardrobe.usual.get_or_insert_with(|| materials.add("usual", diffuse(0.5)))
            }
        };
        let Looks { alpha, tangents, spot } = looks;
        if emission.is_none() && alpha.is_none() && !tangents {
            return base;
        }
        let key = key(base, emission.as_ref(), looks);
        if let Some(&known) = self.wardrobe.worn.get(&key) {
            return known;
        }
        let name = spot.name(&shown(self.scene.materials.name(base)));
        let handle = self.scene.materials.add(name, diffuse(0.5));
        self.wardrobe.worn.insert(key, handle);
        let dress = Dress { handle, base, emission, alpha: *alpha, tangents: *tangents, spot: spot.clone() };
        self.wardrobe.dresses.push(dress);
        handle
    }

    /// Makes the materials of all shapes.
    pub(super) fn dress_all(&mut self) -> Result<()> {
        if let Some((name, named)) = self.wardrobe.named.iter().find(|(_, named)| !named.made) {
            let known = self.wardrobe.named.iter().filter(|(_, named)| named.made);
            let help = suggest(name, known.map(|(name, _)| name.as_str()), "named materials");
            return Err(named.spot.error(format!("no material is named \"{}\"", shown(name))).help(help));
        }
        for (name, named) in &self.wardrobe.named {
            if Material::mix_depth(&self.scene.materials, named.handle).is_none() {
                return Err(named.spot.error(Material::endless(&shown(name))).help("take a mix out of it"));
            }
        }
        for dress in std::mem::take(&mut self.wardrobe.dresses) {
            let mut material = self.scene.materials[dress.base].clone();
            let interface = self.wardrobe.interfaces.contains(&dress.base);
            if interface && dress.emission.is_some() {
                self.unsupported(Unsupported::ShiningInterface, &dress.spot);
                material = diffuse(0.0);
            }
            material.emission = dress.emission;
            if let Some(value) = dress.alpha.filter(|_| !interface) {
                material.detail.opacity = Opacity { value, ..Opacity::default() };
            }
            if let Some(map) = material.detail.normal_map.as_mut().filter(|_| dress.tangents) {
                map.tangents = Tangents::MikkTSpace;
            }
            self.scene.materials[dress.handle] = material;
        }
        Ok(())
    }
}

/// A material that is not there at all.
pub(super) fn interface() -> Material {
    let opacity = Opacity { value: Value::Constant(0.0), ..Opacity::default() };
    Material { detail: Detail { opacity, ..Detail::default() }, ..diffuse(0.0) }
}
