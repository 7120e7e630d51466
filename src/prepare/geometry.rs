//! Shapes and meshes to instances, triangles and trees.
//!
//! What is placed once goes into one tree in world space (the soup); a mesh that is placed several times, or moves, gets a
//! tree of its own. A tree over instances stands above them, unless the soup is all there is.

use super::bounds::{Bounds, bounds_of, disk_bounds, ellipsoid_bounds, transformed, triangle_bounds};
use super::bvh::{self, Quality};
use super::motion::{Motion, bounds_over_time};
use super::places::{check_sizes, shape_frame};
use super::triangles::{Extras, mirrors, push_triangles};
use super::wide::Leaves;
use super::{Prepared, corners, rows};
use crate::layout::{
    self, INSTANCE_DEFAULT_UV, INSTANCE_DISK, INSTANCE_MESH, INSTANCE_SOUP, INSTANCE_SPHERE,
    INSTANCE_TRIANGLE_LIGHTS, Instance, LEAF, LEAF_FIRST_MASK, LEAF_INSTANCE, NONE, Record, Triangle,
};
use crate::scene::{Handle, Mesh, Scene, ShapeKind};
use crate::{Error, Result};
use glam::{Affine3A, Vec3};

/// Most triangles a leaf holds.
const TRIANGLES_A_LEAF: u32 = 4;

/// Boxes around the unit sphere and the unit disk.
const SPHERE: Bounds = Bounds { min: Vec3::NEG_ONE, max: Vec3::ONE };
const DISK: Bounds = Bounds { min: Vec3::new(-1.0, -1.0, 0.0), max: Vec3::new(1.0, 1.0, 0.0) };

/// Where a thing that may shine went: for the table of lights.
pub(super) struct Placed {
    /// Index in `Prepared::instances`.
    pub instance: u32,
    /// What it is.
    pub source: Source,
    /// Its map to world space.
    pub world_from_object: Affine3A,
    /// Its bounds in the world, at all times.
    pub bounds: Bounds,
    /// Whether it moves: it then is no light that is sampled.
    pub moves: bool,
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

/// What has been placed so far.
struct Placing<'a> {
    scene: &'a Scene,
    placed: Vec<Placed>,
    /// Triangles in world space.
    soup: Vec<Triangle>,
    /// What the tree over instances holds, beside the soup.
    tops: Vec<(u32, Bounds)>,
    /// Motions and the instances that they are of.
    motions: Vec<(u32, layout::Motion)>,
    /// Of the trees of meshes.
    deepest: u32,
}

/// Fills tree, faces, vertices, instances, motions, root, bounds.
pub(super) fn prepare(scene: &Scene, out: &mut Prepared) -> Result<Vec<Placed>> {
    let mut uses = vec![0_u32; scene.meshes.len()];
    for instance in &scene.instances {
        uses[instance.mesh.index()] += 1;
    }
    let mut placing = Placing {
        scene,
        placed: Vec::new(),
        soup: Vec::new(),
        tops: Vec::new(),
        motions: Vec::new(),
        deepest: 0,
    };
    for i in 0..scene.shapes.len() {
        placing.shape(i, out)?;
    }
    let mut trees: Vec<Option<MeshTree>> = vec![None; scene.meshes.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        let mesh = instance.mesh.index();
        placing.mesh(i, uses[mesh] == 1, &mut trees[mesh], out)?;
    }
    let Placing { placed, soup, tops, motions, deepest, .. } = placing;
    build_top(soup, tops, deepest, out)?;
    push_motions(scene, motions, out)?;
    corners::put_behind_faces(out);
    Ok(placed)
}

impl Placing<'_> {
    fn shape(&mut self, i: usize, out: &mut Prepared) -> Result<()> {
        let shape = &self.scene.shapes[i];
        let (frame, map) = (shape.kind.frame(), shape_frame(shape));
        let motion = Motion::between(&shape.name, &shape.world_from_object, shape.at_close.as_ref())?;
        let kind = match shape.kind {
            ShapeKind::Sphere { .. } => INSTANCE_SPHERE,
            ShapeKind::Disk { .. } => INSTANCE_DISK,
            ShapeKind::Quad { .. } if motion.is_some() => INSTANCE_MESH,
            ShapeKind::Quad { .. } => INSTANCE_SOUP,
        };
        let instance = out.push_instance(kind, map, shape.material.index() as u32);
        if kind != INSTANCE_SOUP {
            let close = shape.at_close.map(|close| close * frame);
            check_sizes(&shape.name, &map, close.as_ref())?;
        }
        let bounds = match shape.kind {
            ShapeKind::Sphere { .. } => {
                bounds_over_time(motion.as_ref(), &frame, &map, &SPHERE, ellipsoid_bounds)
            }
            ShapeKind::Disk { .. } => bounds_over_time(motion.as_ref(), &frame, &map, &DISK, disk_bounds),
            ShapeKind::Quad { .. } => {
                let mesh = Mesh::square();
                let extras = Extras::of(self.scene, &mesh, [shape.material]);
                if motion.is_some() {
                    let tree = tree_of(&mesh, &extras, out)?;
                    self.stand(instance, &tree, out);
                    let place = |map: &Affine3A| transformed(&tree.bounds, map);
                    bounds_over_time(motion.as_ref(), &frame, &map, &tree.bounds, place)
                } else {
                    self.bake(instance, &mesh, &map, &extras, out)
                }
            }
        };
        self.place(
            Placed {
                instance,
                source: Source::Shape(i),
                world_from_object: map,
                bounds,
                moves: motion.is_some(),
            },
            out,
        );
        self.motions.extend(motion.map(|motion| (instance, motion.record(&frame))));
        Ok(())
    }

    fn mesh(&mut self, i: usize, once: bool, tree: &mut Option<MeshTree>, out: &mut Prepared) -> Result<()> {
        let instance = &self.scene.instances[i];
        let (mesh, map) = (&self.scene.meshes[instance.mesh], instance.world_from_object);
        let motion = Motion::between(&instance.name, &map, instance.at_close.as_ref())?;
        let bakes = once && motion.is_none();
        let kind = if bakes { INSTANCE_SOUP } else { INSTANCE_MESH };
        let index = out.push_instance(kind, map, instance.material.index() as u32);
        if !bakes {
            check_sizes(&instance.name, &map, instance.at_close.as_ref())?;
        }
        let uv = if mesh.uvs.is_empty() { INSTANCE_DEFAULT_UV } else { 0 };
        out.instances[index as usize].flags = INSTANCE_TRIANGLE_LIGHTS | uv;
        let bounds = if bakes {
            let extras = Extras::of(self.scene, mesh, [instance.material]);
            self.bake(index, mesh, &map, &extras, out)
        } else {
            let tree = match tree {
                Some(tree) => *tree,
                None => *tree.insert(mesh_tree(self.scene, instance.mesh, out)?),
            };
            self.stand(index, &tree, out);
            let place = |map: &Affine3A| transformed(&tree.bounds, map);
            bounds_over_time(motion.as_ref(), &Affine3A::IDENTITY, &map, &tree.bounds, place)
        };
        self.place(
            Placed {
                instance: index,
                source: Source::Mesh(i),
                world_from_object: map,
                bounds,
                moves: motion.is_some(),
            },
            out,
        );
        self.motions.extend(motion.map(|motion| (index, motion.record(&Affine3A::IDENTITY))));
        Ok(())
    }

    /// Puts a mesh into world space.
    fn bake(
        &mut self,
        instance: u32,
        mesh: &Mesh,
        map: &Affine3A,
        extras: &Extras,
        out: &mut Prepared,
    ) -> Bounds {
        let first = self.soup.len();
        let face = push_triangles(mesh, map, Some(instance), extras, out, &mut self.soup);
        out.instances[instance as usize].first_face = face;
        bounds_of(&self.soup[first..])
    }

    /// Gives an instance its tree.
    fn stand(&mut self, instance: u32, tree: &MeshTree, out: &mut Prepared) {
        out.instances[instance as usize].root = tree.root;
        out.instances[instance as usize].first_face = tree.first_face;
        self.deepest = self.deepest.max(tree.depth);
    }

    fn place(&mut self, placed: Placed, out: &Prepared) {
        let instance = &out.instances[placed.instance as usize];
        let in_tree = match instance.kind {
            INSTANCE_SOUP => false,
            INSTANCE_MESH => instance.root != NONE,
            _ => true,
        };
        if in_tree {
            self.tops.push((placed.instance, placed.bounds));
        }
        self.placed.push(placed);
    }
}

/// Motions come after the instances, that of the camera last.
fn push_motions(scene: &Scene, motions: Vec<(u32, layout::Motion)>, out: &mut Prepared) -> Result<()> {
    out.features.moves = !motions.is_empty();
    let first = out.instances.len() as u32 * layout::Instance::WORDS;
    for (instance, motion) in motions {
        out.instances[instance as usize].motion = first + out.motions.len() as u32 * layout::Motion::WORDS;
        out.motions.push(motion);
    }
    let camera = &scene.camera;
    let close = camera.world_from_camera_at_close();
    if let Some(motion) = Motion::between("the camera", &camera.world_from_camera(), close.as_ref())? {
        out.camera_motion = first + out.motions.len() as u32 * layout::Motion::WORDS;
        out.motions.push(motion.record(&Affine3A::IDENTITY));
        out.features.camera_moves = true;
    }
    Ok(())
}

fn mesh_tree(scene: &Scene, handle: Handle<Mesh>, out: &mut Prepared) -> Result<MeshTree> {
    let mesh = &scene.meshes[handle];
    let instances = scene.instances.iter().filter(|instance| instance.mesh == handle);
    let extras = Extras::of(scene, mesh, instances.map(|instance| instance.material));
    tree_of(mesh, &extras, out)
}

/// The tree of a mesh in object space.
fn tree_of(mesh: &Mesh, extras: &Extras, out: &mut Prepared) -> Result<MeshTree> {
    let mut triangles = Vec::new();
    let first_face = push_triangles(mesh, &Affine3A::IDENTITY, None, extras, out, &mut triangles);
    let bounds = bounds_of(&triangles);
    let (root, depth) = out.push_tree(triangles)?;
    Ok(MeshTree { root, depth, bounds, first_face })
}

/// The soup's tree, and the tree over instances when there is more than the soup.
fn build_top(
    soup: Vec<Triangle>,
    tops: Vec<(u32, Bounds)>,
    mut deepest: u32,
    out: &mut Prepared,
) -> Result<()> {
    let soup_bounds = bounds_of(&soup);
    let soup_root = if soup.is_empty() {
        None
    } else {
        let (root, depth) = out.push_tree(soup)?;
        deepest = deepest.max(depth);
        Some(root)
    };
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
            motion: NONE,
            first_face: NONE,
            flags: 0,
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

#[cfg(test)]
#[path = "geometry_tests.rs"]
mod tests;
