//! Primitives: the vertices of a part of a mesh, and its triangles.

use super::document::Document;
use super::json::Json;
use crate::Result;
use glam::{Vec2, Vec3, Vec4};

/// What the vertices of a primitive have. Empty lists are attributes that it does not have.
#[derive(Default, Clone)]
pub(super) struct Vertices {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    /// With the side of the bitangent in w.
    pub tangents: Vec<Vec4>,
    /// v upwards.
    pub uvs: Vec<Vec2>,
    /// The second set.
    pub uvs1: Vec<Vec2>,
    /// Linear, with alpha.
    pub colors: Vec<Vec4>,
}

/// The attributes of a primitive by name, with their accessors, and what else it names.
pub(super) struct Primitive<'a> {
    pub json: Json<'a>,
    attributes: Vec<(&'a str, Json<'a>)>,
    /// Attributes of each morph target.
    pub targets: Vec<Vec<(&'a str, Json<'a>)>>,
    /// Number of vertices; 0 without positions.
    pub count: usize,
    mode: usize,
}

/// Attributes that vertices can have, without the number of the set.
const KNOWN: [&str; 7] = ["POSITION", "NORMAL", "TANGENT", "TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"];
/// Attributes that a morph target can change.
const MORPHED: [&str; 5] = ["POSITION", "NORMAL", "TANGENT", "TEXCOORD", "COLOR"];
/// TRIANGLES, which is what a primitive is that does not say it.
const TRIANGLES: usize = 4;

impl<'a> Primitive<'a> {
    /// Reads what a primitive names, and checks that all of it goes together.
    pub fn read(document: &Document<'_>, json: Json<'a>) -> Result<Self> {
        let mode = json.get("mode")?;
        let number = mode.as_ref().map_or(Ok(TRIANGLES), Json::whole)?;
        if let Some(mode) = mode.filter(|_| number > 6) {
            return Err(mode.error(format!("{number} is no mode of a primitive")));
        }
        let attributes = json.need("attributes")?.entries()?;
        let mut count = None;
        for (name, reference) in &attributes {
            let (_, accessor) = document.accessor(reference)?;
            if !KNOWN.contains(&set_of(name).0) && !name.starts_with('_') {
                return Err(reference.error("no attribute has this name"));
            }
            same_count(reference, accessor.count, *count.get_or_insert(accessor.count))?;
        }
        let mut targets = Vec::new();
        for target in json.list("targets")? {
            let entries = target.entries()?;
            for (name, reference) in &entries {
                let (_, accessor) = document.accessor(reference)?;
                if !MORPHED.contains(&set_of(name).0) {
                    return Err(reference.error("a morph target cannot change this attribute"));
                }
                same_count(reference, accessor.count, count.unwrap_or(accessor.count))?;
            }
            targets.push(entries);
        }
        if let Some(indices) = json.get("indices")? {
            document.accessor(&indices)?;
        }
        let joints = attributes.iter().filter(|(name, _)| set_of(name).0 == "JOINTS").count();
        let weights = attributes.iter().filter(|(name, _)| set_of(name).0 == "WEIGHTS").count();
        if joints != weights {
            return Err(
                json.error(format!("there are {joints} sets of joints and {weights} of their weights"))
            );
        }
        Ok(Self { json, attributes, targets, count: count.unwrap_or(0), mode: number })
    }

    /// The accessor of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&Json<'a>> {
        self.attributes.iter().find(|(known, _)| *known == name).map(|(_, reference)| reference)
    }

    /// Attributes with the numbers of their accessors, those of the morph targets too: equal for equal vertices.
    pub fn identity(&self) -> Result<Vec<(&'a str, usize)>> {
        let all = self.attributes.iter().chain(self.targets.iter().flatten());
        all.map(|(name, reference)| Ok((*name, reference.whole()?))).collect()
    }

    /// Whether it is made of triangles, and not of points or lines.
    pub fn has_area(&self) -> bool {
        self.mode >= TRIANGLES && self.attribute("POSITION").is_some()
    }

    /// The vertices, as the file has them.
    pub fn vertices(&self, document: &Document<'_>) -> Result<Vertices> {
        let vec3 = |name| -> Result<Vec<Vec3>> {
            let Some(reference) = self.attribute(name) else { return Ok(Vec::new()) };
            Ok(document.floats::<3>(reference)?.into_iter().map(Vec3::from).collect())
        };
        let uvs = |name| -> Result<Vec<Vec2>> {
            let Some(reference) = self.attribute(name) else { return Ok(Vec::new()) };
            Ok(document.floats::<2>(reference)?.into_iter().map(|[u, v]| Vec2::new(u, 1.0 - v)).collect())
        };
        let colors = match self.attribute("COLOR_0") {
            Some(colors) => document.colors(colors, 1.0)?,
            None => Vec::new(),
        };
        let normals = vec3("NORMAL")?;
        let tangents = match self.attribute("TANGENT").filter(|_| !normals.is_empty()) {
            Some(tangents) => document.floats::<4>(tangents)?.into_iter().map(Vec4::from).collect(),
            None => Vec::new(),
        };
        Ok(Vertices {
            positions: vec3("POSITION")?,
            normals,
            tangents,
            uvs: uvs("TEXCOORD_0")?,
            uvs1: uvs("TEXCOORD_1")?,
            colors,
        })
    }

    /// The triangles, whose corners are below [`Self::count`].
    pub fn triangles(&self, document: &Document<'_>) -> Result<Vec<[u32; 3]>> {
        let Some(reference) = self.json.get("indices")? else {
            document.budget.take(self.count, size_of::<[u32; 3]>())?;
            return Ok(cut(self.mode, self.count, |i| i as u32));
        };
        let (_, accessor) = document.accessor(&reference)?;
        let indices = accessor.wholes::<1>(&document.buffers, &document.budget).map_err(|mut error| {
            error.message = format!("{}: {}", reference.pointer(), error.message);
            error
        })?;
        document.budget.take(indices.len(), size_of::<[u32; 3]>())?;
        if let Some(at) = indices.iter().position(|[index]| *index as usize >= self.count) {
            let (index, count) = (indices[at][0], self.count);
            return Err(reference.error(format!("index {at} names vertex {index}, and there are {count}")));
        }
        Ok(cut(self.mode, indices.len(), |i| indices[i][0]))
    }
}

/// The triangles of a list, strip or fan of `count` vertices.
fn cut(mode: usize, count: usize, vertex: impl Fn(usize) -> u32) -> Vec<[u32; 3]> {
    let rows = count.saturating_sub(2);
    match mode {
        TRIANGLES => (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2].map(&vertex)).collect(),
        // Every other triangle of a strip is turned round
        5 => (0..rows).map(|i| [i, i + 1 + i % 2, i + 2 - i % 2].map(&vertex)).collect(),
        6 => (0..rows).map(|i| [i + 1, i + 2, 0].map(&vertex)).collect(),
        _ => Vec::new(),
    }
}

/// `TEXCOORD_1` → `TEXCOORD` and 1.
fn set_of(name: &str) -> (&str, usize) {
    let parts = name.rsplit_once('_').and_then(|(kind, set)| Some((kind, set.parse().ok()?)));
    parts.unwrap_or((name, 0))
}

fn same_count(reference: &Json<'_>, found: usize, count: usize) -> Result<()> {
    if found == count {
        return Ok(());
    }
    Err(reference.error(format!("the attribute is there for {found} vertices, others are for {count}")))
}
