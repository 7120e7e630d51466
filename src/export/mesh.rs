//! `[mesh.NAME]`: small meshes in the scene, others as PLY files.

use super::Writer;
use super::keys::{Keys, number, numbers, pair, rows, vector};
use super::ply::ply;
use crate::Result;
use crate::scene::{Displacement, DisplacementDirection, EdgeLimit, Handle, Mesh};
use glam::Vec4;
use toml_edit::Value;

/// Most triangles of a mesh that is written into the scene.
const SMALL: usize = 16;
/// What the reader cuts edges to when the scene does not say.
const EDGE_PIXELS: f32 = 2.0;

impl Writer<'_> {
    pub(super) fn mesh(&mut self, handle: Handle<Mesh>, mesh: &Mesh) -> Result<Keys> {
        let mut keys = if is_plain(mesh) && mesh.triangles.len() <= SMALL && is_whole(mesh) {
            inline(mesh)
        } else {
            let name = self.meshes.name(handle).to_owned();
            let mut keys = Keys::new();
            keys.set("file", self.files.add(&name, "mesh", "ply", &ply(mesh))?);
            if !is_whole(mesh) {
                keys.set("parts", self.parts(mesh));
            }
            keys
        };
        keys.flag("round", mesh.round, false);
        if let Some(displacement) = &mesh.displacement {
            keys.set("displacement", self.displacement(displacement));
        }
        Ok(keys)
    }

    fn parts(&self, mesh: &Mesh) -> Value {
        rows(mesh.parts.iter().map(|part| {
            let mut keys = Keys::new();
            keys.word("name", &part.name, "");
            keys.set("triangles", i64::from(part.triangles.end - part.triangles.start));
            if let Some(material) = part.material {
                keys.set("material", self.materials.refer(material));
            }
            keys.inline()
        }))
    }

    fn displacement(&self, displacement: &Displacement) -> Value {
        let mut keys = Keys::new();
        keys.set("texture", self.textures.refer(displacement.texture));
        keys.number("height", displacement.height, 1.0);
        keys.number("offset", displacement.offset, 0.0);
        let direction = match displacement.direction {
            DisplacementDirection::Normal => "normal",
            DisplacementDirection::Object => "object",
            DisplacementDirection::Tangent => "tangent",
        };
        keys.word("direction", direction, "normal");
        match displacement.edge {
            EdgeLimit::Length(length) => keys.set("edge_length", number(length)),
            EdgeLimit::Pixels(pixels) => keys.number("edge_pixels", pixels, EDGE_PIXELS),
        }
        keys.count("max_triangles", displacement.most_triangles, Displacement::USUAL_MOST_TRIANGLES);
        keys.inline()
    }
}

/// Whether all of it can be said in the scene.
fn is_plain(mesh: &Mesh) -> bool {
    mesh.tangents.is_empty() && mesh.colors.iter().all(|color| color.min_element() >= 0.0)
}

/// Whether it is one part without name and material.
fn is_whole(mesh: &Mesh) -> bool {
    matches!(mesh.parts.as_slice(), [part] if part.name.is_empty() && part.material.is_none())
}

fn inline(mesh: &Mesh) -> Keys {
    let mut keys = Keys::new();
    keys.set("positions", rows(mesh.positions.iter().copied().map(vector)));
    if !mesh.normals.is_empty() {
        keys.set("normals", rows(mesh.normals.iter().copied().map(vector)));
    }
    for (key, uvs) in [("uvs", &mesh.uvs), ("uvs1", &mesh.uvs1)] {
        if !uvs.is_empty() {
            keys.set(key, rows(uvs.iter().copied().map(pair)));
        }
    }
    if !mesh.colors.is_empty() {
        let color = |color: &Vec4| match color.w {
            1.0 => vector(color.truncate()),
            _ => numbers(&color.to_array()),
        };
        keys.set("colors", rows(mesh.colors.iter().map(color)));
    }
    let triangle = |corners: &[u32; 3]| corners.iter().map(|&corner| i64::from(corner)).collect::<Value>();
    keys.set("triangles", rows(mesh.triangles.iter().map(triangle)));
    keys
}
