//! Triangle meshes, from the scene and from files.

use super::object::Geometry;
use super::parameter::{Parameter, Type};
use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::shape::Looks;
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::mesh::normalize_normals;
use crate::import::text::Limits;
use crate::scene::{Displacement, DisplacementDirection, EdgeLimit, Mesh, MeshPart, Value};
use glam::{Vec2, Vec3};
use std::path::PathBuf;

/// Most triangles that are made of shapes which are no meshes, or of a file that has been read before.
const MOST_MADE: usize = 1 << 24;

impl Reader<'_> {
    pub(super) fn triangle_mesh(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let mut mesh = vertices(from)?;
        mesh.triangles = corners(from, mesh.positions.len())?;
        let tangents = from.vec3s("S", Type::Vector3);
        if let Some((parameter, list)) = &tangents {
            same_count(from, parameter, list.len(), mesh.positions.len())?;
            // Those without a length take some direction
            let unit = |s: &Vec3| s.as_dvec3().normalize_or(glam::DVec3::X).as_vec3();
            mesh.tangents = list.iter().map(|s| unit(s).extend(1.0)).collect();
            if mesh.uvs.is_empty() {
                mesh = with_uvs(&mesh);
            }
        }
        from.ignore(&["faceIndices"]);
        let mesh = oriented(mesh, self.state.reverse);
        let looks = Looks { tangents: tangents.is_some(), alpha: looks.alpha, spot: looks.spot.clone() };
        self.add_mesh("trianglemesh", mesh, &looks)
    }

    pub(super) fn ply_mesh(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let (spot, path) = from.file("filename")?.ok_or_else(|| from.missing("filename", Type::String))?;
        let displacement = self.displacement(from)?;
        if path.extension().is_some_and(|extension| extension == "gz") {
            return Err(spot.error("compressed meshes are not read").help("run gunzip on it first"));
        }
        self.need_file(&spot, &path)?;
        let key = (path, self.state.reverse);
        let known = self.meshes.get(&key).copied();
        if displacement.is_none() && !self.powered() {
            let handle = match known {
                Some(handle) => handle,
                None => {
                    let mesh = self.ply(&spot, &key)?;
                    let handle = self.scene.meshes.add(key.0.display().to_string(), mesh);
                    self.meshes.insert(key, handle);
                    handle
                }
            };
            return self.add_shape("plymesh", Geometry::Mesh(handle), 1.0, looks);
        }
        let mesh = match known {
            Some(handle) => self.scene.meshes[handle].clone(),
            None => self.ply(&spot, &key)?,
        };
        self.made(mesh.triangles.len(), &looks.spot)?;
        self.add_mesh("plymesh", Mesh { displacement, ..mesh }, looks)
    }

    /// The mesh of a file, turned inside out or not.
    fn ply(&mut self, spot: &Spot, (path, reverse): &(PathBuf, bool)) -> Result<Mesh> {
        let mesh = self.assets.mesh(path).map_err(|error| spot.locate(error))?;
        Ok(oriented(mesh, *reverse))
    }

    /// Edges are measured in the world and heights in the space of the mesh.
    fn displacement(&mut self, from: &Parameters) -> Result<Option<Displacement>> {
        let edge = from.float_or("edgelength", 1.0, Limits::Above(0.0))? * self.edge_scale;
        let Some(Value::Texture(texture)) = self.float_texture(from, "displacement", Limits::Finite)? else {
            return Ok(None);
        };
        if self.objects.open.is_some() {
            self.unsupported(Unsupported::DisplacedInstance, &from.spot);
        }
        let scale = self.state.maps[0].matrix3.determinant().abs().cbrt() as f32;
        Ok(Some(Displacement {
            texture,
            height: scale,
            offset: 0.0,
            direction: DisplacementDirection::Normal,
            edge: EdgeLimit::Length(edge),
            most_triangles: Displacement::USUAL_MOST_TRIANGLES,
        }))
    }

    pub(super) fn loop_subdivision(&mut self, from: &Parameters, looks: &Looks) -> Result<()> {
        let levels = from.integer_or("levels", 3, 0, 20)?;
        from.choice_or("scheme", (), &[("loop", ())])?;
        let (_, positions) = positions(from)?;
        let triangles = corners(from, positions.len())?;
        let cage = Mesh { positions, triangles, ..Mesh::default() };
        let mut mesh = cage.loop_subdivided(levels).map_err(|error| looks.spot.locate(error))?;
        self.made(mesh.triangles.len(), &looks.spot)?;
        // pbrt goes clockwise around each vertex, so that the normals of its surfaces point away from where corners go round
        // counter-clockwise
        mesh.normals.iter_mut().for_each(|normal| *normal = -*normal);
        let mesh = oriented(mesh, self.state.reverse);
        self.add_mesh("loopsubdiv", mesh, looks)
    }

    /// Counts triangles that cost little text.
    pub(super) fn made(&mut self, triangles: usize, spot: &Spot) -> Result<()> {
        self.made += triangles;
        if self.made <= MOST_MADE {
            return Ok(());
        }
        let message = format!("shapes that are no meshes make more than {MOST_MADE} triangles");
        Err(spot.error(message).help("describe what is there many times as an object"))
    }
}

/// `P`, `N` and `uv`.
pub(super) fn vertices(from: &Parameters) -> Result<Mesh> {
    let (_, positions) = positions(from)?;
    let count = positions.len();
    let mut mesh = Mesh { positions, ..Mesh::default() };
    if let Some((parameter, normals)) = from.vec3s("N", Type::Normal) {
        same_count(from, parameter, normals.len(), count)?;
        // Normals without a length take some direction; their triangles are still there
        mesh.normals = normals.iter().map(|n| n.as_dvec3().normalize_or(glam::DVec3::Z).as_vec3()).collect();
    }
    if let Some((parameter, uvs)) = from.vec2s("uv") {
        same_count(from, parameter, uvs.len(), count)?;
        mesh.uvs = uvs;
    }
    Ok(mesh)
}

fn positions(from: &Parameters) -> Result<(&Parameter, Vec<Vec3>)> {
    from.vec3s("P", Type::Point3).ok_or_else(|| from.missing("P", Type::Point3))
}

fn same_count(from: &Parameters, parameter: &Parameter, found: usize, wanted: usize) -> Result<()> {
    if found == wanted {
        return Ok(());
    }
    let message = format!("{} of {} has {found} values, P has {wanted} points", parameter.shown(), from.what);
    Err(parameter.spot.error(message).help("write one for each point"))
}

/// Corners of triangles; one triangle needs none.
fn corners(from: &Parameters, count: usize) -> Result<Vec<[u32; 3]>> {
    let Some(flat) = indices::<3>(from, count)? else {
        return match count {
            3 => Ok(vec![[0, 1, 2]]),
            _ => Err(from.missing("indices", Type::Integer)),
        };
    };
    Ok(flat)
}

/// `indices` in groups of N, each below `count`.
pub(super) fn indices<const N: usize>(from: &Parameters, count: usize) -> Result<Option<Vec<[u32; N]>>> {
    let Some((parameter, list)) = from.integers("indices") else { return Ok(None) };
    if list.len() % N != 0 {
        let message = format!(
            "{} of {} has {} numbers, must have {N} a face",
            parameter.shown(),
            from.what,
            list.len()
        );
        return Err(parameter.spot.error(message).help("add the rest"));
    }
    let index = |value: i32| match u32::try_from(value) {
        Ok(index) if (index as usize) < count => Ok(index),
        _ => Err(from.refuse(parameter, value, format!("the index of one of the {count} points, from 0"))),
    };
    let mut groups = Vec::with_capacity(list.len() / N);
    for group in list.as_chunks::<N>().0 {
        let mut corners = [0; N];
        for (corner, &value) in corners.iter_mut().zip(group) {
            *corner = index(value)?;
        }
        groups.push(corners);
    }
    Ok(Some(groups))
}

/// A mesh as one part, whose front is that of pbrt: where the normals of its vertices point, or else where its corners go round
/// counter-clockwise; the reverse of both after `ReverseOrientation`.
pub(super) fn oriented(mut mesh: Mesh, reverse: bool) -> Mesh {
    normalize_normals(&mut mesh);
    if reverse {
        mesh.normals.iter_mut().for_each(|normal| *normal = -*normal);
    }
    let turned = |mesh: &Mesh, corners: &[u32; 3]| {
        if mesh.normals.is_empty() {
            return reverse;
        }
        let [a, b, c] = corners.map(|i| mesh.positions[i as usize].as_dvec3());
        let normal: Vec3 = corners.iter().map(|&i| mesh.normals[i as usize]).sum();
        (b - a).cross(c - a).dot(normal.as_dvec3()) < 0.0
    };
    let turns: Vec<bool> = mesh.triangles.iter().map(|corners| turned(&mesh, corners)).collect();
    if mesh.uvs.is_empty() && turns.contains(&true) {
        mesh = with_uvs(&mesh);
    }
    for (triangle, _) in mesh.triangles.iter_mut().zip(&turns).filter(|(_, turn)| **turn) {
        triangle.swap(1, 2);
    }
    let end = mesh.triangles.len() as u32;
    mesh.parts = vec![MeshPart { name: String::new(), triangles: 0..end, material: None }];
    mesh
}

/// Each triangle with corners of its own, whose texture coordinates are those of pbrt where there are none.
fn with_uvs(mesh: &Mesh) -> Mesh {
    let corners = || mesh.triangles.iter().flatten().map(|&i| i as usize);
    let count = mesh.triangles.len() as u32;
    Mesh {
        positions: corners().map(|i| mesh.positions[i]).collect(),
        normals: corners().filter_map(|i| mesh.normals.get(i).copied()).collect(),
        tangents: corners().filter_map(|i| mesh.tangents.get(i).copied()).collect(),
        uvs: [Vec2::ZERO, Vec2::X, Vec2::ONE].repeat(count as usize),
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    }
}
