//! Shapes and meshes to instances, triangles and trees.
//!
//! What is placed once goes into one tree in world space (the soup); a mesh that is placed several times gets a tree of
//! its own. A tree over instances stands above them, unless the soup is all there is.

use super::bounds::{Bounds, bounds_of, disk_bounds, ellipsoid_bounds, transformed, triangle_bounds};
use super::bvh::{self, Quality};
use super::triangles::{Extras, mirrors, push_triangles};
use super::wide::Leaves;
use super::{Prepared, rows};
use crate::layout::{
    INSTANCE_DISK, INSTANCE_MESH, INSTANCE_SOUP, INSTANCE_SPHERE, Instance, LEAF, LEAF_FIRST_MASK,
    LEAF_INSTANCE, NONE, Triangle,
};
use crate::scene::{Handle, Mesh, Scene, Shape, ShapeKind};
use crate::{Error, Result};
use glam::{Affine3A, Mat3A, Vec3};

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

/// A mesh that is placed several times.
#[derive(Clone, Copy)]
struct MeshTree {
    root: u32,
    depth: u32,
    bounds: Bounds,
    first_face: u32,
}

/// Fills tree, faces, vertices, instances, root, bounds.
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
                let (first, mesh) = (soup.len(), Mesh::square());
                let extras = Extras::of(scene, &mesh, [shape.material]);
                let face = push_triangles(&mesh, &world_from_object, Some(instance), &extras, out, &mut soup);
                out.instances[instance as usize].first_face = face;
                bounds_of(&soup[first..])
            }
        };
        placed.push(Placed { instance, source: Source::Shape(i), world_from_object, bounds });
    }
    let mut trees: Vec<Option<MeshTree>> = vec![None; scene.meshes.len()];
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
            let extras = Extras::of(scene, mesh, [instance.material]);
            let face = push_triangles(mesh, &map, Some(index), &extras, out, &mut soup);
            out.instances[index as usize].first_face = face;
            bounds_of(&soup[first..])
        } else {
            let tree = match trees[instance.mesh.index()] {
                Some(tree) => tree,
                None => *trees[instance.mesh.index()].insert(mesh_tree(scene, instance.mesh, out)?),
            };
            out.instances[index as usize].root = tree.root;
            out.instances[index as usize].first_face = tree.first_face;
            transformed(&tree.bounds, &map)
        };
        placed.push(Placed { instance: index, source: Source::Mesh(i), world_from_object: map, bounds });
    }
    build_top(scene, soup, &trees, out)?;
    Ok(placed)
}

fn mesh_tree(scene: &Scene, handle: Handle<Mesh>, out: &mut Prepared) -> Result<MeshTree> {
    let (mesh, mut triangles) = (&scene.meshes[handle], Vec::new());
    let instances = scene.instances.iter().filter(|instance| instance.mesh == handle);
    let extras = Extras::of(scene, mesh, instances.map(|instance| instance.material));
    let first_face = push_triangles(mesh, &Affine3A::IDENTITY, None, &extras, out, &mut triangles);
    let bounds = bounds_of(&triangles);
    let (root, depth) = out.push_tree(triangles)?;
    Ok(MeshTree { root, depth, bounds, first_face })
}

/// The soup's tree, and the tree over instances when there is more than the soup.
fn build_top(
    scene: &Scene,
    soup: Vec<Triangle>,
    trees: &[Option<MeshTree>],
    out: &mut Prepared,
) -> Result<()> {
    let mut tops: Vec<(u32, Bounds)> = Vec::new();
    let mut deepest = trees.iter().flatten().map(|tree| tree.depth).max().unwrap_or(0);
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
        if let Some(tree) = &trees[instance.mesh.index()]
            && tree.root != NONE
        {
            tops.push((index as u32, transformed(&tree.bounds, &instance.world_from_object)));
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
    let bounds = tops.iter().map(|(_, bounds)| *bounds).collect();
    let leaves = Leaves {
        first_item: out.first_item(tops.len())?,
        mark: LEAF | LEAF_INSTANCE,
        item: &|i| [[tops[i as usize].0, 0, 0, 0], [0; 4], [0; 4]],
    };
    let mut tree = bvh::build(bounds, 1, Quality::High, &leaves);
    out.stack_entries = stack_entries(tree.depth, Some(deepest));
    out.root = tree.root;
    out.node_count += tree.nodes;
    out.tree.append(&mut tree.items);
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
            first_face: NONE,
            default_uv: 0,
        });
        self.instances.len() as u32 - 1
    }

    /// Where the tree of some more primitives begins.
    fn first_item(&self, primitives: usize) -> Result<u32> {
        let first = self.tree.len();
        // A tree has fewer nodes than primitives
        if first + 2 * primitives > LEAF_FIRST_MASK as usize {
            let most = LEAF_FIRST_MASK / 2;
            return Err(
                Error::scene(format!("more than {most} triangles and instances")).help("use instances")
            );
        }
        Ok(first as u32)
    }

    /// Builds the tree of some triangles. Gives root and depth.
    fn push_tree(&mut self, triangles: Vec<Triangle>) -> Result<(u32, u32)> {
        let leaves = Leaves {
            first_item: self.first_item(triangles.len())?,
            mark: LEAF,
            item: &|i| bytemuck::cast(triangles[i as usize]),
        };
        let start = std::time::Instant::now();
        let bounds = triangles.iter().map(triangle_bounds).collect();
        let mut tree = bvh::build(bounds, TRIANGLES_A_LEAF, Quality::Default, &leaves);
        self.bvh_seconds.0 += start.elapsed().as_secs_f64();
        self.triangle_count += triangles.len();
        self.node_count += tree.nodes;
        self.tree.append(&mut tree.items);
        self.bvh_cost = self.bvh_cost.max(tree.cost);
        Ok((tree.root, tree.depth))
    }
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

/// From the unit sphere, disk or square of the kernels to the world.
pub(super) fn shape_frame(shape: &Shape) -> Affine3A {
    shape.world_from_object * shape.kind.frame()
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
