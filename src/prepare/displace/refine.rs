//! Cutting a mesh until no edge is longer than a limit, without cracks.
//!
//! Whether an edge is cut depends on its two end points alone, so all triangles that have it cut it alike, whatever their
//! texture coordinates and normals are. Vertices at one place are one [`Place`].

use crate::layout::NONE;
use crate::scene::Mesh;
use crate::{Error, Result};
use glam::{Vec2, Vec3, Vec4};
use std::collections::HashMap;
use std::ops::Range;

/// A vertex: its place, and what belongs to one side of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub place: u32,
    pub uv: Vec2,
    /// Second texture coordinates; as `uv` where the mesh has none.
    pub uv1: Vec2,
    /// Linear, with alpha; white where the mesh has none.
    pub color: Vec4,
    /// Unit normal of the mesh, or 0 when it is flat.
    pub normal: Vec3,
}

/// A mesh that is being cut.
#[derive(Debug, Clone)]
pub(super) struct Refined {
    /// Where the places are.
    pub places: Vec<Vec3>,
    pub vertices: Vec<Vertex>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// The triangles of each part.
    pub parts: Vec<Range<u32>>,
    round: bool,
}

/// Edges halve with every pass: after so many, floats cannot tell their ends apart.
const MOST_PASSES: u32 = 24;

impl Refined {
    /// The mesh as it is, with its vertices joined by place.
    pub fn of(mesh: &Mesh) -> Self {
        let (mut places, mut known) = (Vec::new(), HashMap::new());
        let mut vertices = Vec::with_capacity(mesh.positions.len());
        let mut vertex = |i: usize, uv: Vec2| {
            // 0 and −0 are one place
            let position = mesh.positions[i] + 0.0;
            let place = *known.entry(position.to_array().map(f32::to_bits)).or_insert_with(|| {
                places.push(position);
                places.len() as u32 - 1
            });
            vertices.push(Vertex {
                place,
                uv,
                uv1: mesh.uvs1.get(i).copied().unwrap_or(uv),
                color: mesh.colors.get(i).copied().unwrap_or(Vec4::ONE),
                normal: mesh.normals.get(i).copied().unwrap_or(Vec3::ZERO),
            });
            vertices.len() as u32 - 1
        };
        let triangles = if mesh.uvs.is_empty() {
            // Each triangle has the uv that a mesh without any has
            let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE];
            let own = |t: &[u32; 3]| [0, 1, 2].map(|k| vertex(t[k] as usize, corners[k]));
            mesh.triangles.iter().map(own).collect()
        } else {
            (0..mesh.positions.len()).for_each(|i| _ = vertex(i, mesh.uvs[i]));
            mesh.triangles.clone()
        };
        let mut parts: Vec<_> = mesh.parts.iter().map(|part| part.triangles.clone()).collect();
        if parts.is_empty() {
            parts.push(0..mesh.triangles.len() as u32);
        }
        Self { places, vertices, triangles, parts, round: mesh.round }
    }

    /// Cuts every edge for which `too_long` says so, and those that come of it, into halves.
    ///
    /// # Errors
    /// When that takes more than `most` triangles; none are made beyond them.
    pub fn refine(&mut self, most: u32, too_long: &dyn Fn(Vec3, Vec3) -> bool) -> Result<()> {
        for _ in 0..MOST_PASSES {
            let halves = self.cut_edges(too_long);
            let cuts = |t: &[u32; 3]| (0..3).filter(|&k| self.half(&halves, *t, k).is_some()).count() as u64;
            let (count, cut) = self.triangles.iter().map(cuts).fold((0, 0), |(n, c), k| (n + 1 + k, c + k));
            if cut == 0 {
                break;
            }
            if count > u64::from(most) {
                return Err(Error::scene(format!("displacement cuts it into more than {most} triangles"))
                    .help("allow longer edges, or give a larger `max_triangles`"));
            }
            self.cut_triangles(&halves, count as usize);
        }
        Ok(())
    }

    /// The place in the middle of each edge that is cut, by the places of its ends; NONE for others.
    fn cut_edges(&mut self, too_long: &dyn Fn(Vec3, Vec3) -> bool) -> HashMap<(u32, u32), u32> {
        let mut halves = HashMap::new();
        for triangle in &self.triangles {
            for k in 0..3 {
                let [a, b] = self.ends(*triangle, k);
                halves.entry(ordered(a, b)).or_insert_with(|| {
                    let (p, q) = (self.places[a as usize], self.places[b as usize]);
                    if a == b || !too_long(p, q) {
                        return NONE;
                    }
                    let middle = 0.5 * (p + q);
                    self.places.push(if self.round { middle.normalize_or(p) } else { middle });
                    self.places.len() as u32 - 1
                });
            }
        }
        halves
    }

    /// Places of the ends of edge k, which is opposite to corner k.
    fn ends(&self, triangle: [u32; 3], k: usize) -> [u32; 2] {
        [(k + 1) % 3, (k + 2) % 3].map(|corner| self.vertices[triangle[corner] as usize].place)
    }

    fn half(&self, halves: &HashMap<(u32, u32), u32>, triangle: [u32; 3], k: usize) -> Option<u32> {
        let [a, b] = self.ends(triangle, k);
        halves.get(&ordered(a, b)).copied().filter(|place| *place != NONE)
    }

    fn cut_triangles(&mut self, halves: &HashMap<(u32, u32), u32>, count: usize) {
        let mut made = HashMap::new();
        let mut cut = Vec::with_capacity(count);
        let triangles = std::mem::take(&mut self.triangles);
        for part in &mut self.parts {
            let first = cut.len() as u32;
            let range = part.start as usize..part.end as usize;
            *part = first..first;
            for &triangle in &triangles[range] {
                let mut middle = [NONE; 3];
                for (k, middle) in middle.iter_mut().enumerate() {
                    let [a, b] = [(k + 1) % 3, (k + 2) % 3].map(|corner| triangle[corner]);
                    let ends = [a, b].map(|v| self.vertices[v as usize].place);
                    if let Some(&place) =
                        halves.get(&ordered(ends[0], ends[1])).filter(|place| **place != NONE)
                    {
                        *middle = *made.entry(ordered(a, b)).or_insert_with(|| {
                            let [a, b] = [a, b].map(|v| self.vertices[v as usize]);
                            let between = between(a, b, place, self.places[place as usize], self.round);
                            self.vertices.push(between);
                            self.vertices.len() as u32 - 1
                        });
                    }
                }
                let at = |v: u32| self.places[self.vertices[v as usize].place as usize];
                push_cut(triangle, middle, &at, &mut cut);
            }
            part.end = cut.len() as u32;
        }
        self.triangles = cut;
    }
}

fn ordered(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// The vertex in the middle of two.
fn between(a: Vertex, b: Vertex, place: u32, position: Vec3, round: bool) -> Vertex {
    let color = 0.5 * (a.color + b.color);
    if !round {
        let normal = (a.normal + b.normal).normalize_or(a.normal);
        return Vertex { place, uv: 0.5 * (a.uv + b.uv), uv1: 0.5 * (a.uv1 + b.uv1), color, normal };
    }
    // On a sphere: by its place, on the side of the seam where its neighbours are. A pole has no longitude.
    let of = |v: Vertex| (v.uv.y > 0.0 && v.uv.y < 1.0).then_some(v.uv.x);
    let near = match (of(a), of(b)) {
        (Some(a), Some(b)) => 0.5 * (a + b),
        (a, b) => a.or(b).unwrap_or(0.5),
    };
    let mut uv = sphere_uv(position);
    uv.x += (near - uv.x).round();
    Vertex { place, uv, uv1: uv, color, normal: position }
}

/// Longitude about +z from +x and latitude of a point on the unit sphere, as texture coordinates.
fn sphere_uv(p: Vec3) -> Vec2 {
    let turns = f64::from(p.y).atan2(f64::from(p.x)) / std::f64::consts::TAU;
    let latitude = f64::from(p.z).atan2(f64::from(p.x).hypot(f64::from(p.y))) / std::f64::consts::PI;
    Vec2::new(turns as f32, (latitude + 0.5) as f32)
}

/// The pieces of a triangle of which edge k has `middle[k]`, or NONE.
fn push_cut(corners: [u32; 3], middle: [u32; 3], at: &dyn Fn(u32) -> Vec3, out: &mut Vec<[u32; 3]>) {
    let cut = middle.iter().filter(|m| **m != NONE).count();
    // Turned so that the edge that differs from the others is the first
    let odd = middle.iter().position(|m| (*m != NONE) == (cut == 1)).unwrap_or(0);
    let turn = |of: [u32; 3]| [0, 1, 2].map(|k| of[(odd + k) % 3]);
    let ([a, b, c], [ma, mb, mc]) = (turn(corners), turn(middle));
    match cut {
        0 => out.push(corners),
        1 => out.extend([[a, b, ma], [a, ma, c]]),
        2 => {
            // A corner, and a quad by its shorter diagonal
            out.push([a, mc, mb]);
            let shorter = at(mc).distance_squared(at(c)) < at(mb).distance_squared(at(b));
            out.extend(if shorter { [[mc, b, c], [mc, c, mb]] } else { [[mc, b, mb], [b, c, mb]] });
        }
        _ => out.extend([[a, mc, mb], [mc, b, ma], [mb, ma, c], [ma, mb, mc]]),
    }
}
