//! Shapes and meshes to instances, triangles and trees.
//!
//! What is placed once goes into one tree in world space (the soup); a mesh that is placed several times gets a tree of
//! its own. A tree over instances stands above them, unless the soup is all there is.

use super::Prepared;
use super::bounds::{Bounds, bounds_of, disk_bounds, ellipsoid_bounds, transformed, triangle_bounds};
use super::bvh::{self, Quality};
use super::wide;
use crate::layout::{
    INSTANCE_DISK, INSTANCE_MESH, INSTANCE_SOUP, INSTANCE_SPHERE, Instance, LEAF, LEAF_FIRST_MASK,
    LEAF_INSTANCE, NONE, Triangle, Vertex,
};
use crate::scene::{Handle, Material, Mesh, Scene, Shape, ShapeKind};
use crate::{Error, Result};
use glam::{Affine3A, DAffine3, Mat3A, Vec2, Vec3};

/// Most triangles a leaf holds.
const TRIANGLES_A_LEAF: u32 = 4;

/// Largest and smallest axes of spheres, disks and meshes with a tree of their own: the squares of both, and of what
/// divides by them, are floats.
const LARGEST: f64 = 5e18;
const SMALLEST: f64 = 2e-19;

/// Where a thing that may shine went: for the table of lights.
pub(super) struct Placed {
    /// Index in `Prepared::instances`.
    pub instance: u32,
    /// What it is.
    pub source: Source,
    /// Its map to world space.
    pub world_from_object: Affine3A,
    /// Its bounds in the world.
    pub bounds: Bounds,
}

/// Where an instance comes from in the scene.
pub(super) enum Source {
    /// `scene.shapes[_]`.
    Shape(usize),
    /// `scene.instances[_]`.
    Mesh(usize),
}

/// Fills nodes, triangles, vertices, instances, root, bounds.
pub(super) fn prepare(scene: &Scene, out: &mut Prepared) -> Result<Vec<Placed>> {
    let mut placed = Vec::new();
    let mut uses = vec![0_u32; scene.meshes.len()];
    for instance in &scene.instances {
        uses[instance.mesh.index()] += 1;
    }
    let mut soup = Vec::new();
    for (i, shape) in scene.shapes.iter().enumerate() {
        let world_from_object = shape_frame(shape);
        let kind = match shape.kind {
            ShapeKind::Sphere { .. } => INSTANCE_SPHERE,
            ShapeKind::Disk { .. } => INSTANCE_DISK,
            ShapeKind::Quad { .. } => INSTANCE_SOUP,
        };
        let instance = out.push_instance(kind, world_from_object, shape.material.index() as u32);
        if kind != INSTANCE_SOUP {
            check_size(&shape.name, &world_from_object)?;
        }
        let bounds = match shape.kind {
            ShapeKind::Sphere { .. } => ellipsoid_bounds(&world_from_object),
            ShapeKind::Disk { .. } => disk_bounds(&world_from_object),
            ShapeKind::Quad { .. } => {
                let first = soup.len();
                push_triangles(&quad_mesh(), &world_from_object, Some(instance), out, &mut soup);
                bounds_of(&soup[first..])
            }
        };
        placed.push(Placed { instance, source: Source::Shape(i), world_from_object, bounds });
    }
    let mut trees: Vec<Option<(u32, u32, Bounds)>> = vec![None; scene.meshes.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        let (mesh, map) = (&scene.meshes[instance.mesh], instance.world_from_object);
        let once = uses[instance.mesh.index()] == 1;
        let kind = if once { INSTANCE_SOUP } else { INSTANCE_MESH };
        let index = out.push_instance(kind, map, instance.material.index() as u32);
        if !once {
            check_size(&instance.name, &map)?;
        }
        out.instances[index as usize].light_stride = 1;
        out.instances[index as usize].default_uv = u32::from(mesh.uvs.is_empty());
        let bounds = if once {
            let first = soup.len();
            push_triangles(mesh, &map, Some(index), out, &mut soup);
            bounds_of(&soup[first..])
        } else {
            let tree = &mut trees[instance.mesh.index()];
            if tree.is_none() {
                let mut own = Vec::new();
                push_triangles(mesh, &Affine3A::IDENTITY, None, out, &mut own);
                let bounds = bounds_of(&own);
                let (root, depth) = out.push_tree(own)?;
                *tree = Some((root, depth, bounds));
            }
            out.instances[index as usize].root = tree.map_or(NONE, |(root, ..)| root);
            tree.map_or(Bounds::default(), |(.., bounds)| transformed(&bounds, &map))
        };
        placed.push(Placed { instance: index, source: Source::Mesh(i), world_from_object: map, bounds });
    }
    build_top(scene, soup, &trees, out)?;
    out.put_triangles_after_nodes();
    Ok(placed)
}

/// The soup's tree, and the tree over instances when there is more than the soup.
fn build_top(
    scene: &Scene,
    soup: Vec<Triangle>,
    trees: &[Option<(u32, u32, Bounds)>],
    out: &mut Prepared,
) -> Result<()> {
    let mut tops: Vec<(u32, Bounds)> = Vec::new();
    let mut deepest = trees.iter().flatten().map(|(_, depth, _)| *depth).max().unwrap_or(0);
    let soup_bounds = bounds_of(&soup);
    let soup_root = if soup.is_empty() {
        None
    } else {
        let (root, depth) = out.push_tree(soup)?;
        deepest = deepest.max(depth);
        Some(root)
    };
    for (i, instance) in out.instances.iter().enumerate() {
        let map = world_from_object(instance);
        match instance.kind {
            INSTANCE_SPHERE => tops.push((i as u32, ellipsoid_bounds(&map))),
            INSTANCE_DISK => tops.push((i as u32, disk_bounds(&map))),
            _ => {}
        }
    }
    let meshes = scene.instances.iter().zip(scene.shapes.len()..);
    for (instance, index) in meshes {
        if let Some((root, _, bounds)) = trees[instance.mesh.index()]
            && root != NONE
        {
            tops.push((index as u32, transformed(&bounds, &instance.world_from_object)));
        }
    }
    for (_, bounds) in &tops {
        out.bounds.join(bounds);
    }
    if soup_root.is_some() {
        out.bounds.join(&soup_bounds);
    }
    if !out.bounds.diagonal().is_finite() {
        return Err(Error::scene("the scene is too large for 32-bit floats").help("scale it down"));
    }
    let uses = |kind| out.instances.iter().any(|instance| instance.kind == kind);
    (out.features.spheres, out.features.disks) = (uses(INSTANCE_SPHERE), uses(INSTANCE_DISK));
    out.features.instances = !tops.is_empty();
    let Some(root) = soup_root.filter(|_| tops.is_empty()) else {
        return build_instance_tree(tops, soup_root, soup_bounds, deepest, out);
    };
    out.root = root;
    out.stack_entries = stack_entries(deepest, None);
    Ok(())
}

fn build_instance_tree(
    mut tops: Vec<(u32, Bounds)>,
    soup_root: Option<u32>,
    soup_bounds: Bounds,
    deepest: u32,
    out: &mut Prepared,
) -> Result<()> {
    if let Some(root) = soup_root {
        let index = out.push_instance(INSTANCE_SOUP, Affine3A::IDENTITY, 0);
        out.instances[index as usize].root = root;
        tops.push((index, soup_bounds));
    }
    let mut tree = bvh::build(tops.iter().map(|(_, bounds)| *bounds).collect(), 1, Quality::High);
    // A leaf holds one instance: name it by its index.
    for reference in wide::references(&mut tree.root, &mut tree.nodes) {
        if *reference & LEAF != 0 && *reference != NONE {
            let place = (*reference & LEAF_FIRST_MASK) as usize;
            *reference = LEAF | LEAF_INSTANCE | tops[tree.order[place] as usize].0;
        }
    }
    tree.shift(out.nodes.len() as u32, 0);
    out.stack_entries = stack_entries(tree.depth, Some(deepest));
    out.root = tree.root;
    out.nodes.append(&mut tree.nodes);
    check_stack(out.stack_entries)
}

/// What `geometry/traverse.glsl` keeps: the mark of the end, the open children down the first tree, and for a second tree
/// the mark of its end and its open children.
fn stack_entries(first_depth: u32, second_depth: Option<u32>) -> u32 {
    1 + first_depth + second_depth.map_or(0, |depth| 1 + depth)
}

fn check_stack(entries: u32) -> Result<()> {
    if entries <= crate::layout::STACK_ENTRIES {
        return Ok(());
    }
    Err(Error::scene(format!(
        "the trees over meshes and instances need a stack of {entries}, more than {}",
        crate::layout::STACK_ENTRIES
    ))
    .help("merge small meshes into one"))
}

impl Prepared {
    fn push_instance(&mut self, kind: u32, world_from_object: Affine3A, material: u32) -> u32 {
        let rows = |m: &DAffine3| {
            let (linear, t) = (m.matrix3.transpose(), m.translation);
            [linear.x_axis.extend(t.x), linear.y_axis.extend(t.y), linear.z_axis.extend(t.z)]
                .map(|r| r.as_vec4().to_array())
        };
        // In f64: an inverse has products of three lengths on its way
        let exact = world_from_object.as_daffine3();
        let (world, object) = (rows(&exact), rows(&exact.inverse()));
        self.instances.push(Instance {
            kind,
            root: NONE,
            light: NONE,
            material,
            object_row0: object[0],
            object_row1: object[1],
            object_row2: object[2],
            world_row0: world[0],
            world_row1: world[1],
            world_row2: world[2],
            handedness: if mirrors(&world_from_object) { -1.0 } else { 1.0 },
            light_stride: 0,
            in_world: u32::from(kind == INSTANCE_SOUP),
            default_uv: 0,
        });
        self.instances.len() as u32 - 1
    }

    /// Nodes and triangles are items of one buffer, nodes first: leaves count from there.
    fn put_triangles_after_nodes(&mut self) {
        let nodes = self.nodes.len() as u32;
        let roots = self.instances.iter_mut().map(|instance| &mut instance.root);
        for reference in wide::references(&mut self.root, &mut self.nodes).chain(roots) {
            if *reference & LEAF != 0 && *reference & LEAF_INSTANCE == 0 {
                *reference += nodes;
            }
        }
    }

    /// Builds the tree of some triangles and puts them in its order. Gives root and depth.
    fn push_tree(&mut self, triangles: Vec<Triangle>) -> Result<(u32, u32)> {
        let (nodes, first) = (self.nodes.len(), self.triangles.len());
        // A tree has fewer nodes than triangles, and nodes and triangles are counted together
        if nodes + first + 2 * triangles.len() > LEAF_FIRST_MASK as usize {
            return Err(Error::scene(format!("more than {LEAF_FIRST_MASK} triangles")).help("use instances"));
        }
        let start = std::time::Instant::now();
        let mut tree =
            bvh::build(triangles.iter().map(triangle_bounds).collect(), TRIANGLES_A_LEAF, Quality::Default);
        self.bvh_seconds.0 += start.elapsed().as_secs_f64();
        tree.shift(nodes as u32, first as u32);
        self.nodes.append(&mut tree.nodes);
        self.triangles.extend(tree.order.iter().map(|&i| triangles[i as usize]));
        self.bvh_cost = self.bvh_cost.max(tree.cost);
        Ok((tree.root, tree.depth))
    }
}

/// The triangles of a mesh as records, with their vertices. `instance` is set for what is put into world
/// space; a map that mirrors turns the triangles round, so that they stay counter-clockwise from outside.
fn push_triangles(
    mesh: &Mesh,
    map: &Affine3A,
    instance: Option<u32>,
    out: &mut Prepared,
    triangles: &mut Vec<Triangle>,
) {
    let mirrored = mirrors(map);
    let normal_map = normal_map(map);
    let has_vertices = !mesh.normals.is_empty() || !mesh.uvs.is_empty();
    let first_vertex = out.vertices.len() as u32;
    if has_vertices {
        out.vertices.extend((0..mesh.positions.len()).map(|i| {
            let normal = mesh.normals.get(i).map_or(Vec3::ZERO, |n| normal_map * *n);
            let uv = mesh.uvs.get(i).copied().unwrap_or(Vec2::ZERO);
            Vertex { normal: normal.into(), u: uv.x, v: uv.y, spare: [0.0; 3] }
        }));
    }
    let materials = part_materials(mesh);
    triangles.reserve(mesh.triangles.len());
    for (i, corners) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = if mirrored { [corners[0], corners[2], corners[1]] } else { *corners };
        let position = |v: u32| map.transform_point3(mesh.positions[v as usize]).to_array();
        let vertices = if has_vertices { [a, b, c].map(|v| first_vertex + v) } else { [NONE; 3] };
        triangles.push(Triangle {
            a: position(a),
            instance: instance.unwrap_or(NONE),
            b: position(b),
            material: materials.get(i).copied().flatten().map_or(NONE, |material| material.index() as u32),
            c: position(c),
            primitive: i as u32,
            vertices,
            spare: 0,
        });
    }
}

/// The map of normals, up to a factor that is the same for all: normals are interpolated before they get unit length, so
/// that a mesh put into world space looks like one that is mapped by the kernels.
fn normal_map(map: &Affine3A) -> Mat3A {
    let m = map.as_daffine3().matrix3.inverse().transpose();
    let longest = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
    let m = if longest > 0.0 { m * (1.0 / longest) } else { m };
    Mat3A::from_cols(m.x_axis.as_vec3a(), m.y_axis.as_vec3a(), m.z_axis.as_vec3a())
}

/// Material of each triangle, none for that of the instance; empty when no part has one of its own.
pub(super) fn part_materials(mesh: &Mesh) -> Vec<Option<Handle<Material>>> {
    if mesh.parts.iter().all(|part| part.material.is_none()) {
        return Vec::new();
    }
    let mut materials = vec![None; mesh.triangles.len()];
    for part in &mesh.parts {
        if let Some(slots) = materials.get_mut(part.triangles.start as usize..part.triangles.end as usize) {
            slots.fill(part.material);
        }
    }
    materials
}

/// Whether a map mirrors.
pub(super) fn mirrors(map: &Affine3A) -> bool {
    map.as_daffine3().matrix3.determinant() < 0.0
}

/// Refuses what is so large or small that kernels, which square lengths in the object's space, leave the range of floats.
fn check_size(name: &str, map: &Affine3A) -> Result<()> {
    let world = map.as_daffine3().matrix3;
    let longest = |m: glam::DMat3| m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
    let (largest, smallest) = (longest(world), 1.0 / longest(world.inverse()));
    let refuse = |size: f64, what: &str, next: &str| {
        Err(Error::scene(format!("{name} has a size of {size:.1e}, too {what} for 32-bit floats")).help(next))
    };
    if largest > LARGEST {
        return refuse(largest, "large", "scale the scene down");
    }
    if smallest < SMALLEST || smallest.is_nan() {
        return refuse(smallest, "small", "scale the scene up, or leave it out");
    }
    Ok(())
}

/// The unit square as two triangles: uv = position.
fn quad_mesh() -> Mesh {
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    Mesh {
        positions: corners.iter().map(|c| c.extend(0.0)).collect(),
        uvs: corners.to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// From the unit sphere, disk or square of the kernels to the world.
pub(super) fn shape_frame(shape: &Shape) -> Affine3A {
    let around = |z: Vec3, along: Vec3, scale: f32, at: Vec3| {
        let z = z.normalize();
        let x = along.reject_from_normalized(z).normalize();
        let m = Mat3A::from_cols((x * scale).into(), (z.cross(x) * scale).into(), (z * scale).into());
        Affine3A { matrix3: m, translation: at.into() }
    };
    let object = match shape.kind {
        ShapeKind::Sphere { center, radius, pole, meridian } => around(pole, meridian, radius, center),
        ShapeKind::Disk { center, normal, radius, meridian } => around(normal, meridian, radius, center),
        ShapeKind::Quad { origin, edge_u, edge_v } => Affine3A {
            matrix3: Mat3A::from_cols(edge_u.into(), edge_v.into(), quad_normal(edge_u, edge_v).into()),
            translation: origin.into(),
        },
    };
    shape.world_from_object * object
}

/// Unit normal of a quad, however long its edges are.
fn quad_normal(edge_u: Vec3, edge_v: Vec3) -> Vec3 {
    edge_u.as_dvec3().cross(edge_v.as_dvec3()).normalize().as_vec3()
}

fn world_from_object(instance: &Instance) -> Affine3A {
    let rows = [instance.world_row0, instance.world_row1, instance.world_row2].map(glam::Vec4::from);
    let linear =
        Mat3A::from_cols(rows[0].truncate().into(), rows[1].truncate().into(), rows[2].truncate().into());
    Affine3A { matrix3: linear.transpose(), translation: Vec3::new(rows[0].w, rows[1].w, rows[2].w).into() }
}

#[cfg(test)]
#[path = "geometry_tests.rs"]
mod tests;
