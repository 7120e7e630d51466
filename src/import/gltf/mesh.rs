//! Meshes: their primitives in a pose, joined where their vertices have the same attributes.

use super::deform;
use super::document::Document;
use super::json::Json;
use super::node::numbers;
use super::primitive::Primitive;
use super::reader::Reader;
use crate::Result;
use crate::import::mesh::normalize_normals;
use crate::scene::{Handle, Material, Mesh, MeshPart, unit};
use glam::{Affine3A, Vec4};
use std::collections::HashMap;

/// A mesh of the document, whose attributes go together.
pub(super) struct Source<'a> {
    pub name: String,
    pub primitives: Vec<Primitive<'a>>,
    /// Weights of morph targets for nodes that have none of their own.
    pub weights: Vec<f32>,
}

impl<'a> Source<'a> {
    /// All meshes of a document.
    pub fn all(document: &Document<'a>) -> Result<Vec<Self>> {
        document
            .root
            .list("meshes")?
            .iter()
            .enumerate()
            .map(|(i, json)| Self::read(document, json, i))
            .collect()
    }

    fn read(document: &Document<'a>, json: &Json<'a>, index: usize) -> Result<Self> {
        let primitives = json.need("primitives")?;
        let items = primitives.items()?;
        if items.is_empty() {
            return Err(primitives.error("a mesh must have a primitive"));
        }
        Ok(Self {
            name: json.name("mesh", index)?,
            primitives: items
                .into_iter()
                .map(|json| Primitive::read(document, json))
                .collect::<Result<_>>()?,
            weights: json.get("weights")?.map_or(Ok(Vec::new()), |weights| numbers(&weights))?,
        })
    }
}

/// What moves the vertices of a mesh.
pub(super) struct Pose<'p> {
    pub weights: &'p [f32],
    /// From the mesh to the world for each joint, where the node has a skin.
    pub joints: Option<&'p [Affine3A]>,
}

impl Pose<'_> {
    /// Whether the vertices stay where the file has them.
    pub fn is_rest(&self) -> bool {
        self.joints.is_none() && self.weights.iter().all(|weight| *weight == 0.0)
    }
}

/// Attributes of which a mesh has all or none: a mesh of the scene has each for all of its vertices.
const OPTIONAL: [&str; 5] = ["NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"];

/// Primitives with the same optional attributes.
struct Group<'a> {
    has: [bool; OPTIONAL.len()],
    mesh: Mesh,
    /// First vertex of primitives whose attributes are read already.
    first: HashMap<Vec<(&'a str, usize)>, u32>,
}

impl<'a> Reader<'a> {
    /// The meshes of the scene that a mesh of the document becomes in a pose.
    pub fn mesh(&mut self, source: &Source<'a>, pose: &Pose<'_>) -> Result<Vec<Handle<Mesh>>> {
        let mut groups: Vec<Group<'a>> = Vec::new();
        for primitive in &source.primitives {
            if !primitive.has_area() {
                self.warn(&primitive.json, "points, lines and primitives without positions are left out");
                continue;
            }
            let material = self.material_of(primitive)?;
            let has = OPTIONAL.map(|name| primitive.attribute(name).is_some());
            let at = groups.iter().position(|group| group.has == has).unwrap_or_else(|| {
                groups.push(Group { has, mesh: Mesh::default(), first: HashMap::new() });
                groups.len() - 1
            });
            self.add_to(&mut groups[at], primitive, pose, material)?;
        }
        let mut handles = Vec::new();
        for mut group in groups.into_iter().filter(|group| !group.mesh.triangles.is_empty()) {
            normalize_normals(&mut group.mesh);
            for tangent in &mut group.mesh.tangents {
                // One without a direction is none, as in a PLY file
                *tangent = unit(tangent.truncate()).unwrap_or_default().extend(if tangent.w < 0.0 {
                    -1.0
                } else {
                    1.0
                });
            }
            handles.push(self.scene.meshes.add(source.name.as_str(), group.mesh));
        }
        Ok(handles)
    }

    fn add_to(
        &self,
        group: &mut Group<'a>,
        primitive: &Primitive<'a>,
        pose: &Pose<'_>,
        material: Handle<Material>,
    ) -> Result<()> {
        let mesh = &mut group.mesh;
        let identity = primitive.identity()?;
        let first = match group.first.get(&identity) {
            Some(first) => *first,
            None => {
                let first = mesh.positions.len() as u32;
                let mut vertices = primitive.vertices(&self.document)?;
                deform::morph(&self.document, primitive, pose.weights, &mut vertices)?;
                if let Some(joints) = pose.joints {
                    deform::skin(&self.document, primitive, joints, &mut vertices)?;
                }
                mesh.positions.append(&mut vertices.positions);
                mesh.normals.append(&mut vertices.normals);
                mesh.tangents.append(&mut vertices.tangents);
                mesh.uvs.append(&mut vertices.uvs);
                mesh.uvs1.append(&mut vertices.uvs1);
                // What is outside counts as the nearer end (section 3.7.2.1)
                mesh.colors.extend(vertices.colors.iter().map(|color| color.clamp(Vec4::ZERO, Vec4::ONE)));
                group.first.insert(identity, first);
                first
            }
        };
        let mut triangles = primitive.triangles(&self.document)?;
        triangles.iter_mut().flatten().for_each(|corner| *corner += first);
        let start = mesh.triangles.len() as u32;
        mesh.triangles.append(&mut triangles);
        if [mesh.positions.len(), mesh.triangles.len()].iter().any(|count| u32::try_from(*count).is_err()) {
            return Err(primitive.json.error("a mesh holds at most 2³² − 1 vertices and triangles"));
        }
        let name = self.scene.materials.name(material).to_owned();
        let triangles = start..mesh.triangles.len() as u32;
        if !triangles.is_empty() {
            mesh.parts.push(MeshPart { name, triangles, material: Some(material) });
        }
        Ok(())
    }
}
