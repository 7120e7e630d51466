//! Shapes and meshes to instances, triangles and trees.
//!
//! What is placed once goes into one tree in world space (the soup); a mesh that is placed several times, or moves, gets a
//! tree of its own. A tree over instances stands above them, unless the soup is all there is.

use super::bounds::{Bounds, bounds_of, transformed};
use super::bvh::{self, Quality};
use super::motion::{Motion, bounds_over_time};
use super::places::{check_sizes, shape_frame};
use super::shapes;
use super::triangles::{Extras, mirrors, push_triangles};
use super::wide::Leaves;
use super::{Prepared, Trees, corners, rows};
use crate::layout::{
    self, INSTANCE_DEFAULT_UV, INSTANCE_DISK, INSTANCE_MESH, INSTANCE_PATCH, INSTANCE_SOUP, INSTANCE_SPHERE,
    INSTANCE_TRIANGLE_LIGHTS, Instance, LEAF, LEAF_INSTANCE, NONE, Record, Triangle,
};
use crate::scene::{Handle, Mesh, Scene, ShapeKind};
use crate::{Error, Result};
use glam::Affine3A;
use std::sync::Arc;

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
    trees: &'a mut Trees,
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
pub(super) fn prepare(scene: &Scene, trees: &mut Trees, out: &mut Prepared) -> Result<Vec<Placed>> {
    trees.begin();
    let mut uses = vec![0_u32; scene.meshes.len()];
    for instance in &scene.instances {
        uses[instance.mesh.index()] += 1;
    }
    let mut placing = Placing {
        scene,
        trees,
        placed: Vec::new(),
        soup: Vec::new(),
        tops: Vec::new(),
        motions: Vec::new(),
        deepest: 0,
    };
    for i in 0..scene.shapes.len() {
        placing.shape(i, out)?;
    }
    let mut mesh_trees: Vec<Option<MeshTree>> = vec![None; scene.meshes.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        let mesh = instance.mesh.index();
        placing.mesh(i, uses[mesh] == 1, &mut mesh_trees[mesh], out)?;
    }
    let Placing { placed, soup, tops, motions, deepest, trees, .. } = placing;
    build_top(soup, tops, deepest, trees, out)?;
    out.bvh_seconds.0 = trees.end();
    push_motions(scene, motions, out)?;
    corners::put_behind_faces(out);
    shapes::place_words(out);
    Ok(placed)
}

impl Placing<'_> {
    fn shape(&mut self, i: usize, out: &mut Prepared) -> Result<()> {
        let shape = &self.scene.shapes[i];
        let (frame, map) = (shape.kind.frame(), shape_frame(shape));
        let motion = Motion::between(&shape.name, &shape.world_from_object, shape.at_close.as_ref())?;
        let kind = shapes::instance_kind(&shape.kind, motion.is_some());
        let instance = out.push_instance(kind, map, shape.material.index() as u32);
        if kind != INSTANCE_SOUP {
            let sized = |place: &Affine3A| *place * frame * Affine3A::from_scale(shapes::size(&shape.kind));
            let close = shape.at_close.as_ref().map(sized);
            check_sizes(&shape.name, &sized(&shape.world_from_object), close.as_ref())?;
        }
        let bounds = if let ShapeKind::Quad { .. } = shape.kind {
            let mesh = Mesh::square();
            let extras = Extras::of(self.scene, &mesh, [shape.material]);
            if motion.is_some() {
                let tree = tree_of(&mesh, &extras, self.trees, out)?;
                self.stand(instance, &tree, out);
                let place = |map: &Affine3A| transformed(&tree.bounds, map);
                bounds_over_time(motion.as_ref(), &frame, &map, &tree.bounds, place)
            } else {
                self.bake(instance, &mesh, &map, &extras, out)
            }
        } else {
            out.instances[instance as usize].root = shapes::push_words(&shape.kind, &mut out.shapes);
            let object = shapes::object_bounds(&shape.kind);
            let place = |map: &Affine3A| shapes::bounds(&shape.kind, &object, map);
            bounds_over_time(motion.as_ref(), &frame, &map, &object, place)
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
                None => *tree.insert(mesh_tree(self.scene, instance.mesh, self.trees, out)?),
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

fn mesh_tree(scene: &Scene, handle: Handle<Mesh>, trees: &mut Trees, out: &mut Prepared) -> Result<MeshTree> {
    let mesh = &scene.meshes[handle];
    let instances = scene.instances.iter().filter(|instance| instance.mesh == handle);
    let extras = Extras::of(scene, mesh, instances.map(|instance| instance.material));
    tree_of(mesh, &extras, trees, out)
}

/// The tree of a mesh in object space.
fn tree_of(mesh: &Mesh, extras: &Extras, trees: &mut Trees, out: &mut Prepared) -> Result<MeshTree> {
    let mut triangles = Vec::new();
    let first_face = push_triangles(mesh, &Affine3A::IDENTITY, None, extras, out, &mut triangles);
    let bounds = bounds_of(&triangles);
    let (root, depth) = out.push_tree(triangles, trees)?;
    Ok(MeshTree { root, depth, bounds, first_face })
}

/// The soup's tree, and the tree over instances when there is more than the soup.
fn build_top(
    soup: Vec<Triangle>,
    tops: Vec<(u32, Bounds)>,
    mut deepest: u32,
    trees: &mut Trees,
    out: &mut Prepared,
) -> Result<()> {
    let soup_bounds = bounds_of(&soup);
    let soup_root = if soup.is_empty() {
        None
    } else {
        let (root, depth) = out.push_tree(soup, trees)?;
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
    out.features.parts = shapes::PARTS.into_iter().any(uses);
    out.features.patches = uses(INSTANCE_PATCH);
    out.features.instances = !tops.is_empty();
    let Some(root) = soup_root.filter(|_| tops.is_empty()) else {
        return build_instance_tree(tops, soup_root, soup_bounds, deepest, trees, out);
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
    trees: &mut Trees,
    out: &mut Prepared,
) -> Result<()> {
    if let Some(root) = soup_root {
        let index = out.push_instance(INSTANCE_SOUP, Affine3A::IDENTITY, 0);
        out.instances[index as usize].root = root;
        tops.push((index, soup_bounds));
    }
    let bounds: Vec<Bounds> = tops.iter().map(|(_, bounds)| *bounds).collect();
    let instances: Vec<u32> = tops.iter().map(|(instance, _)| *instance).collect();
    let leaves = Leaves {
        first_item: out.first_item(tops.len())?,
        mark: LEAF | LEAF_INSTANCE,
        item: &|i| [[instances[i as usize], 0, 0, 0], [0; 4], [0; 4]],
    };
    let corners: Vec<[f32; 3]> = bounds.iter().flat_map(|b| [b.min.to_array(), b.max.to_array()]).collect();
    let key =
        [&leaves.first_item.to_le_bytes(), bytemuck::cast_slice(&instances), bytemuck::cast_slice(&corners)];
    let tree = trees.tree(&key, || bvh::build(bounds, 1, Quality::High, &leaves));
    out.stack_entries = stack_entries(tree.depth, Some(deepest));
    out.root = tree.root;
    out.node_count += tree.nodes;
    out.tree.append(&mut Arc::unwrap_or_clone(tree).items);
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
}

#[cfg(test)]
#[path = "geometry_tests.rs"]
mod tests;
