//! Loop subdivision (Loop 1987; Warren's weights; limit positions and tangents as in Hoppe et al. 1994 and pbrt-v3,
//! section 3.8): a smooth surface that a coarse mesh of triangles controls.

use super::{Mesh, MeshPart};
use crate::{Error, Result};
use glam::{DVec3, Vec2, Vec3, Vec4};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// Most triangles of a subdivided mesh: about a gigabyte with all that belongs to them.
const MOST_TRIANGLES: u64 = 4_000_000;

/// A mesh whose vertices are joined by place, so that seams of its texture coordinates do not open.
struct Cage {
    places: Vec<DVec3>,
    /// Corners by place.
    triangles: Vec<[u32; 3]>,
    /// Place and linear attributes of vertices; empty when the mesh has none of these.
    vertices: Vec<(u32, Attributes)>,
    /// Corners by vertex.
    corners: Vec<[u32; 3]>,
}

/// What is linear on each triangle of the cage: two sets of texture coordinates, and a colour.
#[derive(Debug, Clone, Copy, Default)]
struct Attributes {
    uv: Vec2,
    uv1: Vec2,
    color: Vec4,
}

impl Attributes {
    /// Those of a vertex; what the mesh has not is 0.
    fn of(mesh: &Mesh, vertex: usize) -> Self {
        Self {
            uv: mesh.uvs.get(vertex).copied().unwrap_or_default(),
            uv1: mesh.uvs1.get(vertex).copied().unwrap_or_default(),
            color: mesh.colors.get(vertex).copied().unwrap_or_default(),
        }
    }

    fn between(self, other: Self) -> Self {
        Self {
            uv: 0.5 * (self.uv + other.uv),
            uv1: 0.5 * (self.uv1 + other.uv1),
            color: 0.5 * (self.color + other.color),
        }
    }
}

/// The neighbours of a place, counter-clockwise seen from outside; a boundary begins at the first and ends at the last.
#[derive(Clone, Copy)]
struct Ring<'a> {
    places: &'a [u32],
    closed: bool,
}

/// The rings of all places.
struct Rings {
    places: Vec<u32>,
    /// Where each begins, and where the last ends.
    starts: Vec<usize>,
    closed: Vec<bool>,
}

impl Rings {
    fn iter(&self) -> impl Iterator<Item = Ring<'_>> {
        let ranges = self.starts.windows(2).map(|ends| &self.places[ends[0]..ends[1]]);
        ranges.zip(&self.closed).map(|(places, &closed)| Ring { places, closed })
    }
}

/// The edges of triangles, each once, in the order in which they are met.
struct Edges {
    /// Edge from each corner to the next, of each triangle.
    sides: Vec<[u32; 3]>,
    ends: Vec<[u32; 2]>,
    /// The corners across it in its two triangles; a boundary has one.
    across: Vec<[Option<u32>; 2]>,
}

impl Edges {
    fn of(triangles: &[[u32; 3]]) -> Self {
        let mut known = HashMap::with_capacity(triangles.len() * 3 / 2);
        let mut edges = Self { sides: Vec::with_capacity(triangles.len()), ends: vec![], across: vec![] };
        for [a, b, c] in triangles {
            edges.sides.push([[a, b, c], [b, c, a], [c, a, b]].map(|[from, to, across]| {
                let ends = [*from.min(to), *from.max(to)];
                let edge = *known.entry(ends).or_insert_with(|| {
                    edges.ends.push(ends);
                    edges.across.push([None; 2]);
                    edges.ends.len() as u32 - 1
                });
                let [first, second] = &mut edges.across[edge as usize];
                *if first.is_none() { first } else { second } = Some(*across);
                edge
            }));
        }
        edges
    }

    /// What stands for the middles of the edges of each triangle, which follow one another from `first` on.
    fn middles(&self, first: usize) -> Vec<[u32; 3]> {
        self.sides.iter().map(|side| side.map(|edge| first as u32 + edge)).collect()
    }
}

impl Mesh {
    /// The limit surface of Loop's scheme, cut `levels` times, with its normals. Each triangle becomes 4^levels, in its place
    /// in the order. Texture coordinates are linear on each triangle of this mesh; its normals do not count.
    ///
    /// # Errors
    /// When there would be more than four million triangles, or when the surface has no inside and outside at an edge or a vertex.
    pub fn loop_subdivided(&self, levels: u32) -> Result<Self> {
        let count = 4_u64.checked_pow(levels).and_then(|n| n.checked_mul(self.triangles.len() as u64));
        if count.is_none_or(|count| count > MOST_TRIANGLES) {
            let message = format!(
                "{levels} levels make 4^{levels} triangles of each of {}, more than {MOST_TRIANGLES} in all",
                self.triangles.len()
            );
            return Err(Error::scene(message).help("subdivide less often"));
        }
        let mut cage = Cage::of(self);
        let mut rings = cage.rings()?;
        for _ in 0..levels {
            cage = cage.subdivided(&rings);
            rings = cage.rings()?;
        }
        let (places, normals) = cage.limit(&rings);
        let factor = 4_u32.pow(levels);
        let part = |part: &MeshPart| MeshPart {
            triangles: part.triangles.start * factor..part.triangles.end * factor,
            ..part.clone()
        };
        let of = |values: &[Vec3]| match cage.vertices.as_slice() {
            [] => values.to_vec(),
            vertices => vertices.iter().map(|(place, _)| values[*place as usize]).collect(),
        };
        Ok(Self {
            positions: of(&places),
            normals: of(&normals),
            uvs: cage.attributes(&self.uvs, |vertex| vertex.uv),
            uvs1: cage.attributes(&self.uvs1, |vertex| vertex.uv1),
            tangents: Vec::new(),
            colors: cage.attributes(&self.colors, |vertex| vertex.color),
            triangles: if cage.vertices.is_empty() { cage.triangles } else { cage.corners },
            parts: self.parts.iter().map(part).collect(),
            displacement: self.displacement,
            round: false,
        })
    }
}

impl Cage {
    fn of(mesh: &Mesh) -> Self {
        let (mut places, mut known) = (Vec::new(), HashMap::new());
        let mut place_of = vec![u32::MAX; mesh.positions.len()];
        for v in mesh.triangles.iter().flatten().map(|v| *v as usize) {
            // 0 and −0 are one place
            let position = mesh.positions[v] + 0.0;
            place_of[v] = *known.entry(position.to_array().map(f32::to_bits)).or_insert_with(|| {
                places.push(position.as_dvec3());
                places.len() as u32 - 1
            });
        }
        // A vertex that no triangle has is left out
        let mut vertices = Vec::new();
        let mut vertex_of = vec![u32::MAX; mesh.positions.len()];
        let mut corners = Vec::new();
        if !(mesh.uvs.is_empty() && mesh.uvs1.is_empty() && mesh.colors.is_empty()) {
            for v in mesh.triangles.iter().flatten().map(|v| *v as usize) {
                if vertex_of[v] == u32::MAX {
                    vertex_of[v] = vertices.len() as u32;
                    vertices.push((place_of[v], Attributes::of(mesh, v)));
                }
            }
            corners = mesh.triangles.iter().map(|t| t.map(|v| vertex_of[v as usize])).collect();
        }
        let triangles = mesh.triangles.iter().map(|t| t.map(|v| place_of[v as usize])).collect();
        Self { places, triangles, vertices, corners }
    }

    /// One attribute of all vertices, when the mesh has it.
    fn attributes<T>(&self, given: &[T], one: impl Fn(&Attributes) -> T) -> Vec<T> {
        let there = self.vertices.iter().filter(|_| !given.is_empty());
        there.map(|(_, attributes)| one(attributes)).collect()
    }

    fn rings(&self) -> Result<Rings> {
        // The edges across each place lie side by side
        let mut ends = vec![0_usize; self.places.len() + 1];
        for place in self.triangles.iter().flatten() {
            ends[*place as usize + 1] += 1;
        }
        for i in 1..ends.len() {
            ends[i] += ends[i - 1];
        }
        let (mut next, mut fans) = (ends.clone(), vec![[0; 2]; 3 * self.triangles.len()]);
        for [a, b, c] in &self.triangles {
            for [at, from, to] in [[a, b, c], [b, c, a], [c, a, b]] {
                fans[next[*at as usize]] = [*from, *to];
                next[*at as usize] += 1;
            }
        }
        let mut rings = Rings { places: Vec::with_capacity(fans.len()), starts: vec![0], closed: Vec::new() };
        let mut sorted = Vec::new();
        for (place, ends) in ends.windows(2).enumerate() {
            let closed =
                join(&mut fans[ends[0]..ends[1]], &mut sorted, &mut rings.places).ok_or_else(|| {
                    let [x, y, z] = self.places[place].to_array();
                    Error::scene(format!(
                        "the triangles around the vertex at [{x}, {y}, {z}] are no simple fan"
                    ))
                    .help("an edge must have one or two triangles, which go round the same way")
                })?;
            rings.closed.push(closed);
            rings.starts.push(rings.places.len());
        }
        Ok(rings)
    }

    /// Each triangle as four.
    fn subdivided(&self, rings: &Rings) -> Self {
        let edges = Edges::of(&self.triangles);
        let middle_places = edges.middles(self.places.len());
        let even = self.places.iter().zip(rings.iter()).map(|(p, ring)| self.even(*p, ring));
        let odd = edges.ends.iter().zip(&edges.across).map(|(ends, across)| self.odd(*ends, *across));
        let places = even.chain(odd).collect();

        let seams = Edges::of(&self.corners);
        let middle_vertices = seams.middles(self.vertices.len());
        let mut cut_at = vec![0; seams.ends.len()];
        for (side, middles) in seams.sides.iter().zip(&middle_places) {
            for (seam, middle) in side.iter().zip(middles) {
                cut_at[*seam as usize] = *middle;
            }
        }
        let attributes = |vertex: u32| self.vertices[vertex as usize].1;
        let cut = seams.ends.iter().zip(&cut_at);
        let cut = cut.map(|([a, b], place)| (*place, attributes(*a).between(attributes(*b))));
        Self {
            places,
            triangles: four(&self.triangles, &middle_places),
            vertices: self.vertices.iter().copied().chain(cut).collect(),
            corners: four(&self.corners, &middle_vertices),
        }
    }

    fn sum(&self, places: &[u32]) -> DVec3 {
        places.iter().map(|place| self.places[*place as usize]).sum()
    }

    /// Where a vertex goes.
    fn even(&self, p: DVec3, ring: Ring<'_>) -> DVec3 {
        if ring.closed {
            let n = ring.places.len() as f64;
            return p * (1.0 - n * beta(n)) + self.sum(ring.places) * beta(n);
        }
        match ring.ends() {
            Some(ends) => 0.75 * p + 0.125 * self.sum(&ends),
            None => p,
        }
    }

    /// The new vertex of an edge.
    fn odd(&self, edge: [u32; 2], across: [Option<u32>; 2]) -> DVec3 {
        match across {
            [Some(a), Some(b)] => 0.375 * self.sum(&edge) + 0.125 * self.sum(&[a, b]),
            _ => 0.5 * self.sum(&edge),
        }
    }

    /// Positions and unit normals in the limit.
    fn limit(&self, rings: &Rings) -> (Vec<Vec3>, Vec<Vec3>) {
        let position = |(p, ring): (&DVec3, Ring<'_>)| {
            if ring.closed {
                let n = ring.places.len() as f64;
                let gamma = 1.0 / (n + 3.0 / (8.0 * beta(n)));
                return (*p * (1.0 - n * gamma) + self.sum(ring.places) * gamma).as_vec3();
            }
            // A boundary is a cubic B-spline
            ring.ends().map_or(*p, |ends| (4.0 * *p + self.sum(&ends)) / 6.0).as_vec3()
        };
        let normal = |(p, ring): (&DVec3, Ring<'_>)| {
            let [s, t] = self.tangents(*p, ring);
            s.cross(t).normalize_or_zero().as_vec3()
        };
        let all = || self.places.iter().zip(rings.iter());
        (all().map(position).collect(), all().map(normal).collect())
    }

    /// Two directions along the limit surface, the second to the left of the first seen from outside.
    fn tangents(&self, p: DVec3, ring: Ring<'_>) -> [DVec3; 2] {
        let n = ring.places.len();
        let at = |k: usize| self.places[ring.places[k] as usize];
        if ring.closed {
            let angle = |k: usize| TAU * k as f64 / n as f64;
            return [
                (0..n).map(|k| angle(k).cos() * at(k)).sum(),
                (0..n).map(|k| angle(k).sin() * at(k)).sum(),
            ];
        }
        let Some([first, last]) = ring.ends().map(|ends| ends.map(|place| self.places[place as usize]))
        else {
            return [DVec3::ZERO; 2];
        };
        let across = match n {
            2 => first + last - 2.0 * p,
            3 => at(1) - p,
            4 => 2.0 * (at(1) + at(2)) - first - last - 2.0 * p,
            _ => {
                let theta = PI / (n - 1) as f64;
                let between: DVec3 = (1..n - 1).map(|k| (theta * k as f64).sin() * at(k)).sum();
                (2.0 - 2.0 * theta.cos()) * between - theta.sin() * (first + last)
            }
        };
        [first - last, across]
    }
}

impl Ring<'_> {
    /// Both neighbours on the boundary.
    fn ends(&self) -> Option<[u32; 2]> {
        Some([*self.places.first()?, *self.places.last()?])
    }
}

/// Appends the places that edges go round one after the other, and says whether they come back to the first; none when they are
/// not one chain. `sorted` is room to work in.
fn join(fan: &mut [[u32; 2]], sorted: &mut Vec<u32>, places: &mut Vec<u32>) -> Option<bool> {
    fan.sort_unstable();
    sorted.clear();
    sorted.extend(fan.iter().map(|[_, to]| *to));
    sorted.sort_unstable();
    if fan.windows(2).any(|two| two[0][0] == two[1][0]) || sorted.windows(2).any(|two| two[0] == two[1]) {
        return None;
    }
    // A chain that is open begins where no edge ends
    let begins = |[from, _]: &[u32; 2]| sorted.binary_search(from).is_err();
    let [start, mut end] = *fan.get(fan.iter().position(begins).unwrap_or(0))?;
    places.push(start);
    for _ in 1..fan.len() {
        places.push(end);
        let next = fan.binary_search_by_key(&end, |[from, _]| *from).ok().filter(|_| end != start)?;
        [_, end] = fan[next];
    }
    if end != start {
        places.push(end);
    }
    // A triangle with two corners in one place goes round nothing
    (fan.len() > 1 || end != start).then_some(end == start)
}

/// Warren's weight of each of n neighbours.
fn beta(n: f64) -> f64 {
    if n == 3.0 { 3.0 / 16.0 } else { 3.0 / (8.0 * n) }
}

fn four(triangles: &[[u32; 3]], middles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let cut = |([a, b, c], [ab, bc, ca]): (&[u32; 3], &[u32; 3])| {
        [[*a, *ab, *ca], [*ab, *b, *bc], [*ca, *bc, *c], [*ab, *bc, *ca]]
    };
    triangles.iter().zip(middles).flat_map(cut).collect()
}

#[cfg(test)]
#[path = "subdivide_tests.rs"]
mod tests;
