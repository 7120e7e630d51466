//! Bounding volume hierarchies: built by `obvhs`, widened, and proven to fit the stack.

use super::Bounds;
use super::wide::{Leaves, Tree};
use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2, node::Bvh2Node};
use obvhs::{Boundable, BvhBuildParams};

/// Most primitives of a leaf: what two bits hold.
pub const MAX_LEAF: u32 = 4;
/// Stack entries that a tree may need. Two levels of trees and their marks fit the stack.
pub const MAX_DEPTH: u32 = 76;

/// How much work to put into a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quality {
    /// What `render` uses for triangles.
    Default,
    /// Several times the time for a few per cent fewer steps. For trees over instances, which are few.
    High,
}

struct Boxed(Bounds);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        Aabb::new(self.0.min.into(), self.0.max.into())
    }
}

/// Builds a tree over boxes with at most `max_leaf` (≤ [`MAX_LEAF`]) primitives a leaf.
pub fn build(bounds: Vec<Bounds>, max_leaf: u32, quality: Quality, leaves: &Leaves) -> Tree {
    if bounds.is_empty() {
        return Tree::empty();
    }
    let coincident = many_coincide(&bounds);
    let boxes: Vec<Boxed> = bounds.into_iter().map(Boxed).collect();
    if !coincident {
        let binary = build_bvh2(&boxes, params(max_leaf, quality), &mut std::time::Duration::default());
        match Tree::widened(&binary, leaves) {
            Some(tree) if tree.depth <= MAX_DEPTH => return tree,
            _ => {}
        }
    }
    // Every leaf is small enough: its size is chosen below
    Tree::widened(&balanced(&boxes, max_leaf), leaves).unwrap_or_else(Tree::empty)
}

fn params(max_leaf: u32, quality: Quality) -> BvhBuildParams {
    let base = match quality {
        Quality::Default => BvhBuildParams::very_fast_build(),
        Quality::High => BvhBuildParams::medium_build(),
    };
    // To the kernels a node and a primitive are the same work
    let (max_prims_per_leaf, collapse_traversal_cost) = (max_leaf.min(MAX_LEAF), 1.0);
    BvhBuildParams { pre_split: false, max_prims_per_leaf, collapse_traversal_cost, ..base }
}

/// Whether more than about a thousand boxes are one and the same. The builder joins pairs of nearest neighbours, of which
/// there are few when all are as near: it takes time by the square of their number, minutes for 10⁵.
fn many_coincide(bounds: &[Bounds]) -> bool {
    const MOST: usize = 1000;
    const LOOKED_AT: usize = 4096;
    let step = bounds.len().div_ceil(LOOKED_AT).max(1);
    let key = |b: &Bounds| [b.min.to_array(), b.max.to_array()].map(|p| p.map(f32::to_bits));
    let mut keys: Vec<_> = bounds.iter().step_by(step).map(key).collect();
    keys.sort_unstable();
    keys.chunk_by(|a, b| a == b).any(|same| same.len() * step > MOST && same.len() >= 8)
}

/// A binary tree split in halves by position: its depth is the least possible, whatever the boxes are.
fn balanced(boxes: &[Boxed], max_leaf: u32) -> Bvh2 {
    let center = |i: u32| boxes[i as usize].0.min + boxes[i as usize].0.max;
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = vec![Bvh2Node::default()];
    // Ranges of `order` that still need their node
    let mut open = vec![(0, 0, boxes.len())];
    while let Some((here, start, end)) = open.pop() {
        let part = &mut order[start..end];
        let aabb = part.iter().fold(Aabb::empty(), |all, &i| all.union(&boxes[i as usize].aabb()));
        let count = part.len() as u32;
        if count <= max_leaf {
            nodes[here] = Bvh2Node::new(aabb, count, start as u32);
            continue;
        }
        let mut centers = Bounds::default();
        part.iter().for_each(|&i| centers.add(center(i)));
        let axis = largest_axis(centers.max - centers.min);
        let half = part.len() / 2;
        part.select_nth_unstable_by(half, |&a, &b| {
            center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(&b))
        });
        nodes[here] = Bvh2Node::new(aabb, 0, nodes.len() as u32);
        open.push((nodes.len(), start, start + half));
        open.push((nodes.len() + 1, start + half, end));
        nodes.extend([Bvh2Node::default(); 2]);
    }
    Bvh2 { nodes, primitive_indices: order, ..Bvh2::default() }
}

fn largest_axis(v: Vec3) -> usize {
    if v.x >= v.y && v.x >= v.z {
        0
    } else if v.y >= v.z {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::super::wide::{child, child_box};
    use super::*;
    use crate::layout::{Item, LEAF, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, Node};
    use proptest::prelude::*;

    /// Items that are the number of their primitive.
    const NUMBERS: Leaves = Leaves { first_item: FIRST, mark: LEAF, item: &|i| [[i; 4]; 3] };
    const FIRST: u32 = 1000;

    fn item(tree: &Tree, reference: u32) -> Item {
        tree.items[((reference & LEAF_FIRST_MASK) - FIRST) as usize]
    }

    /// Walks a tree: every primitive once and inside every box on the way to it, stack entries as stated.
    fn check(tree: &Tree, bounds: &[Bounds], max_leaf: u32) {
        let everything = Bounds { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };
        let (mut seen, mut deepest) = (vec![0; bounds.len()], 0);
        let mut open = vec![(tree.root, everything, 0)];
        while let Some((reference, outer, depth)) = open.pop() {
            deepest = deepest.max(depth);
            if reference & LEAF != 0 {
                let count = (reference >> LEAF_COUNT_SHIFT & 3) + 1;
                assert!(count <= max_leaf);
                for i in 0..count {
                    let primitive = item(tree, reference + i)[0][0] as usize;
                    seen[primitive] += 1;
                    let b = bounds[primitive];
                    assert!(
                        b.min.cmpge(outer.min).all() && b.max.cmple(outer.max).all(),
                        "{b:?} in {outer:?}"
                    );
                }
                continue;
            }
            let node: Node = bytemuck::cast(item(tree, reference));
            let children = (0..4).filter_map(|i| Some((i, child(&node, i)?)));
            let others = children.clone().count() as u32 - 1;
            for (i, reference) in children {
                // Boxes are rounded against their own parent: a primitive is in all of them, one box not in another
                let inner = child_box(&node, i);
                let both = Bounds { min: inner.min.max(outer.min), max: inner.max.min(outer.max) };
                open.push((reference, both, depth + others));
            }
        }
        assert!(seen.iter().all(|&n| n == 1), "{seen:?}");
        assert_eq!(deepest, tree.depth);
    }

    fn boxes() -> impl Strategy<Value = Vec<Bounds>> {
        let coordinate = prop_oneof![4 => -10.0_f32..10.0, 1 => Just(0.0_f32), 1 => -1e30_f32..1e30];
        let point = prop::array::uniform3(coordinate);
        prop::collection::vec((point.clone(), point), 1..300).prop_map(|pairs| {
            let mut all = Vec::new();
            for (a, b) in pairs {
                let mut bounds = Bounds::default();
                bounds.add(a.into());
                bounds.add(b.into());
                all.push(bounds);
            }
            all
        })
    }

    proptest! {
        #[test]
        fn trees_are_whole(bounds in boxes(), max_leaf in 1..=MAX_LEAF) {
            check(&build(bounds.clone(), max_leaf, Quality::Default, &NUMBERS), &bounds, max_leaf);
            let boxed: Vec<Boxed> = bounds.iter().copied().map(Boxed).collect();
            let tree = Tree::widened(&balanced(&boxed, max_leaf), &NUMBERS).unwrap();
            check(&tree, &bounds, max_leaf);
            // A node goes down one level at least, and leaves three children open at most
            prop_assert!(tree.depth <= 3 * (bounds.len() as f32).log2().ceil() as u32);
        }
    }

    #[test]
    fn a_box_that_spans_more_than_f64_can_tell_holds_its_corners() {
        let bounds = |min: f32, max: f32| Bounds { min: Vec3::splat(min), max: Vec3::splat(max) };
        let bounds = vec![bounds(-225.0 * 2_f32.powi(88), 6.0), bounds(-3.0, 0.0), bounds(1.0, 7.0)];
        for max_leaf in [1, 2] {
            check(&build(bounds.clone(), max_leaf, Quality::Default, &NUMBERS), &bounds, max_leaf);
        }
    }

    #[test]
    fn coincident_boxes_stay_within_the_stack() {
        let bounds = vec![Bounds { min: Vec3::ZERO, max: Vec3::ONE }; 20_000];
        let tree = build(bounds.clone(), 4, Quality::Default, &NUMBERS);
        assert!(tree.depth <= MAX_DEPTH);
        check(&tree, &bounds, 4);
    }

    #[test]
    fn bytes_do_not_depend_on_the_number_of_threads() {
        let bounds: Vec<Bounds> = (0..20_000_u32)
            .map(|i| {
                let p = Vec3::new((i * 7919 % 1009) as f32, (i * 104_729 % 997) as f32, (i % 13) as f32);
                Bounds { min: p, max: p + 1.5 }
            })
            .collect();
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| build(bounds.clone(), 4, Quality::Default, &NUMBERS))
        };
        let one = with(1);
        assert!(one == with(2) && one == with(7));
    }
}
