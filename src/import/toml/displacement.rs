//! `displacement`.

use super::keys::DISPLACEMENT;
use super::reader::Reader;
use super::text::Limits;
use super::view::{Item, View};
use crate::Result;
use crate::scene::{
    Displacement, DisplacementDirection, EdgeLimit, Instance, Mesh, MeshPart, Shape, ShapeKind,
};

/// Pixels of an edge when the scene does not say.
const EDGE_PIXELS: f32 = 2.0;

impl Reader<'_> {
    pub fn displacement(&self, item: Item<'_>) -> Result<Displacement> {
        let view = View::new(self.sources, item.node, item.name(), DISPLACEMENT)?;
        let directions = [
            ("normal", DisplacementDirection::Normal),
            ("object", DisplacementDirection::Object),
            ("tangent", DisplacementDirection::Tangent),
        ];
        let limits = Limits::Above(0.0);
        let edge = match view.either("edge_length", "edge_pixels")? {
            Some(item) if view.get("edge_length").is_some() => EdgeLimit::Length(item.f32(limits)?),
            Some(item) => EdgeLimit::Pixels(item.f32(limits)?),
            None => EdgeLimit::Pixels(EDGE_PIXELS),
        };
        Ok(Displacement {
            texture: self.textures.find(view.need("texture")?)?,
            height: view.f32_or("height", 1.0, Limits::Finite)?,
            offset: view.f32_or("offset", 0.0, Limits::Finite)?,
            direction: view.choice_or("direction", DisplacementDirection::Normal, &directions)?,
            edge,
            most_triangles: view.u32_or(
                "max_triangles",
                Displacement::USUAL_MOST_TRIANGLES,
                1,
                i32::MAX as u32,
            )?,
        })
    }

    /// A shape that is displaced is a mesh.
    pub fn displaced_shape(&mut self, shape: Shape, displacement: Displacement) {
        let base = match shape.kind {
            ShapeKind::Sphere { .. } => Mesh::unit_sphere(),
            _ => Mesh::square(),
        };
        let whole = 0..base.triangles.len() as u32;
        let parts = vec![MeshPart { name: String::new(), triangles: whole, material: None }];
        let mesh = Mesh { displacement: Some(displacement), parts, ..base };
        let mesh = self.scene.meshes.add(&shape.name, mesh);
        self.scene.instances.push(Instance {
            mesh,
            material: shape.material,
            world_from_object: shape.world_from_object * shape.kind.frame(),
            at_close: None,
            name: shape.name,
        });
    }
}
