//! `[mesh.NAME]`.

use super::document::{Data, Entry};
use super::keys::{MESH, PART};
use super::reader::Reader;
use super::text::{Limits, shown, suggest};
use super::view::{Item, View};
use crate::Result;
use crate::import::mesh::normalize_normals;
use crate::scene::{Handle, Material, Mesh, MeshPart};
use glam::{Vec2, Vec3, Vec4};
use std::collections::{BTreeMap, BTreeSet};

/// Keys that only inline meshes have.
const INLINE: [&str; 7] = ["positions", "triangles", "polygons", "normals", "uvs", "uvs1", "colors"];

/// Levels of subdivision when the scene does not say.
const LEVELS: u32 = 3;
/// Most triangles of all subdivided meshes of a scene.
const MOST_SUBDIVIDED: u64 = 1 << 24;
/// One triangle becomes four million.
const MOST_LEVELS: u32 = 10;
/// How far a vertex of a round mesh may be from the unit sphere.
const MOST_OFF_SPHERE: f32 = 1e-4;

impl Reader<'_> {
    pub fn mesh(&mut self, entry: &Entry) -> Result<()> {
        let what = format!("mesh `{}`", shown(&entry.key));
        let view = View::new(self.sources, &entry.node, what, MESH)?;
        let smooth = view.bool_or("smooth", true)?;
        let mut mesh = match view.either("file", "positions")? {
            Some(file) if view.get("file").is_some() => {
                if let Some(item) = INLINE.iter().find_map(|key| view.get(key)) {
                    return Err(item.error(format!("{} has no meaning beside `file`", item.name())));
                }
                self.file_mesh(&view, file)?
            }
            _ => inline_mesh(&view)?,
        };
        if mesh.triangles.is_empty() {
            return Err(view.error(format!("{} has no triangles", view.what)));
        }
        if let Some(levels) = levels(&view)? {
            let more = 4_u64.pow(levels).saturating_mul(mesh.triangles.len() as u64);
            if self.subdivided.saturating_add(more) > MOST_SUBDIVIDED {
                let message = format!(
                    "with {} the subdivided meshes have more than {MOST_SUBDIVIDED} triangles",
                    view.what
                );
                return Err(view.error(message).help("subdivide less often"));
            }
            self.subdivided += more;
            mesh = mesh.loop_subdivided(levels).map_err(|error| {
                view.error(format!("{} cannot be subdivided: {}", view.what, error.message))
                    .help(error.help.unwrap_or_default())
            })?;
            // Where sheets meet back to back the limit has none
            normalize_normals(&mut mesh);
        }
        if !smooth {
            mesh.normals = Vec::new();
        }
        mesh.round = round(&view, &mesh)?;
        mesh.displacement = view.get("displacement").map(|item| self.displacement(item)).transpose()?;
        let handle = self.scene.meshes.add(&entry.key, mesh);
        self.meshes.add(&entry.key, entry.spot, handle);
        Ok(())
    }

    fn file_mesh(&mut self, view: &View<'_>, file: Item<'_>) -> Result<Mesh> {
        let path = file.path()?;
        self.need_file(file.node.spot, &path)?;
        if let (Some(parts), Some(_)) = (view.get("parts"), view.get("materials")) {
            return Err(parts.error("`parts` has no meaning beside `materials`").help("keep one of them"));
        }
        // The names are checked before a file that may be large is read.
        let named = self.part_materials(view)?;
        let mut mesh = self.assets.mesh(&path).map_err(|error| self.sources.locate(file.node.spot, error))?;
        if let Some(item) = view.get("parts") {
            mesh.parts = self.parts(item, &mesh)?;
            return Ok(mesh);
        }
        let parts: BTreeSet<_> = mesh.parts.iter().map(|part| part.name.as_str()).collect();
        for (name, (item, _)) in &named {
            if !parts.contains(name) {
                let parts = parts.iter().copied().filter(|part| !part.is_empty());
                let message = format!("no part of the mesh is named `{}`", shown(name));
                return Err(item.error(message).help(suggest(name, parts, "named parts")));
            }
        }
        for part in &mut mesh.parts {
            part.material = match named.get(part.name.as_str()) {
                Some((_, material)) => Some(*material),
                None if part.name.is_empty() => None,
                None => self.materials.get(&part.name),
            };
        }
        Ok(mesh)
    }

    /// `parts`: runs of triangles of a file that has no parts of its own.
    fn parts(&self, item: Item<'_>, mesh: &Mesh) -> Result<Vec<MeshPart>> {
        if mesh.parts.len() > 1 || mesh.parts.iter().any(|part| !part.name.is_empty()) {
            let message = "`parts` has no meaning for a mesh that has parts by itself";
            return Err(item.error(message).help("use `materials` for these"));
        }
        let whole = mesh.triangles.len() as u64;
        let (mut parts, mut end) = (Vec::new(), 0_u32);
        for item in item.list("a list of parts, such as [{ triangles = 12, material = \"stone\" }]")? {
            let view = View::new(item.sources, item.node, item.name(), PART)?;
            let triangles = view.need("triangles")?;
            let count = triangles.u32(1, u32::MAX)?;
            let start = end;
            end = start.checked_add(count).filter(|end| u64::from(*end) <= whole).ok_or_else(|| {
                triangles.error(format!("the parts have more than the {whole} triangles of the mesh"))
            })?;
            let name = view.get("name").map_or(Ok(""), |name| name.string())?.to_owned();
            let material = view.get("material").map(|name| self.materials.find(name)).transpose()?;
            parts.push(MeshPart { name, triangles: start..end, material });
        }
        match u64::from(end) == whole {
            true => Ok(parts),
            false => Err(item
                .error(format!("the parts have {end} triangles, the mesh has {whole}"))
                .help("each triangle is in one part, in the order of the file")),
        }
    }

    /// `materials`: names of parts and of the materials that they get.
    fn part_materials<'a>(&self, view: &View<'a>) -> Result<BTreeMap<&'a str, (Item<'a>, Handle<Material>)>> {
        let Some(item) = view.get("materials") else {
            return Ok(BTreeMap::new());
        };
        let Data::Table(table) = &item.node.data else {
            return Err(item.mismatch("a table { \"name in the file\" = \"material\" }"));
        };
        let pairs = table.entries.iter().map(|entry| {
            let item = Item::of_entry(view.sources, entry);
            Ok((entry.key.as_str(), (item, self.materials.find(item)?)))
        });
        pairs.collect()
    }
}

/// Whether the vertices of a mesh are on the unit sphere and those that displacement adds shall be, too.
fn round(view: &View<'_>, mesh: &Mesh) -> Result<bool> {
    let Some(item) = view.get("round") else { return Ok(false) };
    let round = item.bool()?;
    let off = |point: &Vec3| (point.length() - 1.0).abs() > MOST_OFF_SPHERE;
    match mesh.positions.iter().position(off).filter(|_| round) {
        Some(vertex) => Err(item
            .error(format!("`round` is for meshes on the sphere of radius 1 about the origin, and vertex {vertex} is not on it"))
            .help("move the vertices, and scale the instance")),
        None => Ok(round),
    }
}

/// How often a mesh is subdivided, if it is.
fn levels(view: &View<'_>) -> Result<Option<u32>> {
    match (view.get("subdivision"), view.get("levels")) {
        (Some(item), _) => {
            item.choice(&[("loop", ())])?;
            view.u32_or("levels", LEVELS, 0, MOST_LEVELS).map(Some)
        }
        (None, Some(item)) => Err(item
            .error("`levels` has no meaning without `subdivision`")
            .help("add `subdivision = \"loop\"`")),
        (None, None) => Ok(None),
    }
}

fn inline_mesh(view: &View<'_>) -> Result<Mesh> {
    let Some(positions) = view.get("positions") else {
        return Err(view
            .error(format!("{} has neither `file` nor `positions`", view.what))
            .help("add one of them"));
    };
    if let Some(item) = view.get("materials").or(view.get("parts")) {
        return Err(item
            .error(format!("{} needs a `file`", item.name()))
            .help("give the material to the instance"));
    }
    let points = positions.list("a list of points [x, y, z]")?;
    let mut mesh = Mesh {
        positions: points.map(|point| point.vec3(Limits::Finite)).collect::<Result<_>>()?,
        ..Mesh::default()
    };
    let count = mesh.positions.len();
    if u32::try_from(count).is_err() {
        return Err(positions.error("a mesh holds at most 2³² − 1 vertices"));
    }
    if let Some(item) = view.get("normals") {
        let normals = item.list("a list of normals [x, y, z]")?;
        same_count(item, normals.len(), count)?;
        mesh.normals = normals.map(|normal| normal.direction()).collect::<Result<_>>()?;
    }
    for (key, uvs) in [("uvs", &mut mesh.uvs), ("uvs1", &mut mesh.uvs1)] {
        let Some(item) = view.get(key) else { continue };
        let list = item.list("a list of texture coordinates [u, v]")?;
        same_count(item, list.len(), count)?;
        *uvs = list.map(|uv| uv.vec2(Limits::Finite)).collect::<Result<Vec<Vec2>>>()?;
    }
    if let Some(item) = view.get("colors") {
        let colors = item.list("a list of colours")?;
        same_count(item, colors.len(), count)?;
        mesh.colors = colors.map(vertex_color).collect::<Result<_>>()?;
    }
    if view.get("triangles").is_none() && view.get("polygons").is_none() {
        return Err(view
            .error(format!("{} has neither `triangles` nor `polygons`", view.what))
            .help("add one of them"));
    }
    if let Some(item) = view.get("triangles") {
        for triangle in item.list("a list of triangles [a, b, c]")? {
            let expected = "a list of 3 whole numbers";
            let items = triangle.list(expected)?;
            if items.len() != 3 {
                return Err(triangle.mismatch(expected));
            }
            let mut corners = [0; 3];
            for (corner, item) in corners.iter_mut().zip(items) {
                *corner = index(item, count)?;
            }
            mesh.triangles.push(corners);
        }
    }
    if let Some(item) = view.get("polygons") {
        for polygon in item.list("a list of polygons [a, b, c, …]")? {
            fan(polygon, count, &mut mesh.triangles)?;
        }
    }
    let Ok(end) = u32::try_from(mesh.triangles.len()) else {
        return Err(view.error("a mesh holds at most 2³² − 1 triangles"));
    };
    mesh.parts.push(MeshPart { name: String::new(), triangles: 0..end, material: None });
    Ok(mesh)
}

/// A colour, or red, green, blue and alpha.
fn vertex_color(item: Item<'_>) -> Result<Vec4> {
    if item.is_list() && item.list("a list")?.len() == 4 {
        return item.vec4(Limits::AtLeast(0.0));
    }
    super::value::color(item, Limits::AtLeast(0.0)).map(|color| color.extend(1.0))
}

/// Cuts a convex polygon into triangles that share its first corner.
fn fan(polygon: Item<'_>, count: usize, triangles: &mut Vec<[u32; 3]>) -> Result<()> {
    let expected = "a list of 3 or more whole numbers";
    let mut corners = polygon.list(expected)?.map(|corner| index(corner, count));
    let (Some(first), Some(second)) = (corners.next(), corners.next()) else {
        return Err(polygon.mismatch(expected));
    };
    if corners.len() == 0 {
        return Err(polygon.mismatch(expected));
    }
    let (first, mut previous) = (first?, second?);
    for corner in corners {
        let corner = corner?;
        triangles.push([first, previous, corner]);
        previous = corner;
    }
    Ok(())
}

/// The index of one of `count` vertices.
fn index(item: Item<'_>, count: usize) -> Result<u32> {
    let value = match item.node.data {
        Data::Integer(value) => value,
        _ => return Err(item.mismatch("a whole number")),
    };
    match u32::try_from(value) {
        Ok(index) if (index as usize) < count => Ok(index),
        _ => Err(item.refuse(value, format!("the index of one of the {count} positions, from 0"))),
    }
}

fn same_count(item: Item<'_>, found: usize, positions: usize) -> Result<()> {
    if found == positions {
        return Ok(());
    }
    let name = item.name();
    Err(item
        .error(format!("{name} must have one entry for each of the {positions} positions, found {found}")))
}
