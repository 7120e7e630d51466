//! `Shape`.

use super::lexer::Lexer;
use super::object::{Geometry, Thing};
use super::place::Spot;
use super::reader::Reader;
use super::state::Target;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::Limits;
use crate::scene::{Emission, Handle, Material, Mesh, MeshPart, Texture, Value};
use glam::Vec3;
use std::f32::consts::PI;

const KINDS: [&str; 8] =
    ["sphere", "disk", "cylinder", "trianglemesh", "plymesh", "bilinearmesh", "loopsubdiv", "curve"];

/// What a shape adds to its material.
pub(super) struct Looks {
    pub alpha: Option<Value<f32>>,
    /// Its vertices have tangents.
    pub tangents: bool,
    pub spot: Spot,
}

impl Reader<'_> {
    pub(super) fn shape(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let (kind, from) = self.of_kind(lexer, "Shape", spot, Some(Target::Shape))?;
        let alpha = self.float_texture(&from, "alpha", Limits::Finite)?;
        let alpha = match alpha {
            Some(Value::Constant(alpha)) if alpha >= 1.0 => None,
            Some(Value::Constant(alpha)) => Some(Value::Constant(alpha.max(0.0))),
            other => other,
        };
        let looks = Looks { alpha, tangents: false, spot: spot.clone() };
        match kind.as_str() {
            "sphere" => self.sphere(&from, &looks)?,
            "disk" => self.disk(&from, &looks)?,
            "cylinder" => self.cylinder(&from, &looks)?,
            "trianglemesh" => self.triangle_mesh(&from, &looks)?,
            "plymesh" => self.ply_mesh(&from, &looks)?,
            "bilinearmesh" => self.bilinear_mesh(&from, &looks)?,
            "loopsubdiv" => self.loop_subdivision(&from, &looks)?,
            "curve" => {
                self.unsupported(Unsupported::Curve, spot);
                from.ignore(&[
                    "P",
                    "N",
                    "basis",
                    "degree",
                    "type",
                    "width",
                    "width0",
                    "width1",
                    "splitdepth",
                ]);
            }
            _ => return Err(self.unknown("Shape", &kind, &from, &KINDS)),
        }
        from.finish()
    }

    /// Adds a shape of an area, for which pbrt counts no scale.
    pub(super) fn add_shape(
        &mut self,
        kind: &'static str,
        geometry: Geometry,
        area: f32,
        looks: &Looks,
    ) -> Result<()> {
        let emission = self.emission(area, &looks.spot);
        let material = self.worn(emission, looks);
        self.add(kind, geometry, material, &looks.spot)
    }

    /// Adds a mesh. Where a lamp has a power, each of its triangles has it, as in pbrt.
    pub(super) fn add_mesh(&mut self, kind: &'static str, mut mesh: Mesh, looks: &Looks) -> Result<()> {
        if mesh.triangles.is_empty() {
            return Err(looks.spot.error(format!("the {kind} has no triangles")).help("add some"));
        }
        if self.powered() {
            mesh.parts = self.powered_parts(&mesh, looks);
        }
        let first = mesh.parts.first().and_then(|part| part.material);
        let material = match first {
            Some(material) => material,
            None => {
                let emission = self.emission(1.0, &looks.spot);
                self.worn(emission, looks)
            }
        };
        let name = looks.spot.name(kind);
        let handle = self.scene.meshes.add(name, mesh);
        self.add(kind, Geometry::Mesh(handle), material, &looks.spot)
    }

    /// Whether shapes are lamps of a power.
    pub(super) fn powered(&self) -> bool {
        let power = self.state.area_light.as_ref().and_then(|light| light.power);
        power.is_some() && self.objects.open.is_none()
    }

    fn add(
        &mut self,
        kind: &'static str,
        geometry: Geometry,
        material: Handle<Material>,
        spot: &Spot,
    ) -> Result<()> {
        self.add_thing(Thing { geometry, material, maps: self.state.maps, spot: spot.clone(), kind })
    }

    /// Runs of triangles of the same area, each with a material of its own.
    fn powered_parts(&mut self, mesh: &Mesh, looks: &Looks) -> Vec<MeshPart> {
        let map = self.state.maps[0];
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| map.transform_point3(mesh.positions[i as usize].as_dvec3()));
            (0.5 * (b - a).cross(c - a).length()) as f32
        };
        let mut parts: Vec<(MeshPart, f32)> = Vec::new();
        for (i, triangle) in mesh.triangles.iter().enumerate() {
            let (area, end) = (area(triangle), i as u32 + 1);
            match parts.last_mut() {
                Some((part, last)) if (area - *last).abs() <= 1e-5 * *last => part.triangles.end = end,
                _ => {
                    let part = MeshPart { name: String::new(), triangles: end - 1..end, material: None };
                    parts.push((part, area));
                }
            }
        }
        let dressed = parts.into_iter().map(|(part, area)| {
            let emission = self.emission(area, &looks.spot);
            let material = Some(self.worn(emission, looks));
            MeshPart { material, ..part }
        });
        dressed.collect()
    }

    /// The light of a shape of an area.
    fn emission(&mut self, area: f32, spot: &Spot) -> Option<Emission> {
        let light = self.state.area_light.clone()?;
        if self.objects.open.is_some() {
            self.unsupported(Unsupported::InstancedLamp, spot);
            return None;
        }
        let sides = if light.two_sided { 2.0 } else { 1.0 };
        let factor = match light.power {
            // A shape without an area has no light
            Some(power) => Some(power / (sides * area * PI * light.mean))
                .filter(|factor| factor.is_finite())
                .unwrap_or(0.0),
            None => 1.0,
        };
        let radiance = match light.radiance {
            Value::Constant(color) => {
                let color = color * factor;
                Value::Constant(if color.is_finite() { color } else { Vec3::ZERO })
            }
            Value::Texture(_) if factor == 1.0 => light.radiance,
            Value::Texture(_) => Value::Texture(
                self.part(Texture::Scale { value: light.radiance, factor: Value::Constant(factor) }),
            ),
        };
        Some(Emission { radiance, two_sided: light.two_sided })
    }
}
