//! Bounding volume hierarchies: built by `obvhs`, turned into records, and proven to fit the stack.

use super::Bounds;
use crate::layout::{LEAF, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, NONE, Node};
use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::{Boundable, BvhBuildParams};

/// Most primitives of a leaf: what three bits hold.
pub const MAX_LEAF: u32 = 8;
/// Inner nodes on the longest way down that a tree may have. Two levels of trees and their marks fit the stack.
pub const MAX_DEPTH: u32 = 44;

/// How much work to put into a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quality {
    /// What `render` uses.
    Default,
    /// Twice the time for a few per cent fewer steps.
    High,
}

/// A tree over boxes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tree {
    /// Inner nodes; references count from 0 in this tree.
    pub nodes: Vec<Node>,
    /// Primitive at each place of the leaves.
    pub order: Vec<u32>,
    /// Where to start: a reference as in [`Node`]; NONE for no primitives.
    pub root: u32,
    /// Inner nodes on the longest way down: the stack entries that a ray may need.
    pub depth: u32,
    /// Expected cost of a random ray by the surface area heuristic: a step down costs 1, a primitive 1.
    pub cost: f32,
}

struct Boxed(Bounds);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        Aabb::new(self.0.min.into(), self.0.max.into())
    }
}

/// Builds a tree over boxes with at most `max_leaf` (≤ [`MAX_LEAF`]) primitives a leaf.
pub fn build(bounds: Vec<Bounds>, max_leaf: u32, quality: Quality) -> Tree {
    if bounds.is_empty() {
        return Tree { root: NONE, ..Tree::default() };
    }
    let coincident = many_coincide(&bounds);
    let boxes: Vec<Boxed> = bounds.into_iter().map(Boxed).collect();
    if coincident {
        return balanced(&boxes, max_leaf);
    }
    let tree =
        Tree::from_obvhs(&build_bvh2(&boxes, params(max_leaf, quality), &mut std::time::Duration::default()));
    match tree {
        Some(tree) if tree.depth <= MAX_DEPTH => tree,
        _ => balanced(&boxes, max_leaf),
    }
}

fn params(max_leaf: u32, quality: Quality) -> BvhBuildParams {
    let base = match quality {
        Quality::Default => BvhBuildParams::fast_build(),
        Quality::High => BvhBuildParams::medium_build(),
    };
    BvhBuildParams { pre_split: false, max_prims_per_leaf: max_leaf.min(MAX_LEAF), ..base }
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

fn leaf(first: u32, count: u32) -> u32 {
    LEAF | (count - 1) << LEAF_COUNT_SHIFT | (first & LEAF_FIRST_MASK)
}

impl Tree {
    /// Turns child pairs into records, in the order of a walk from the root. None when a leaf is too large.
    fn from_obvhs(bvh: &Bvh2) -> Option<Self> {
        let root = bvh.nodes.first()?;
        let order = bvh.primitive_indices.clone();
        if root.is_leaf() {
            let fits = root.prim_count <= MAX_LEAF;
            return fits.then(|| Self {
                order,
                root: leaf(root.first_index, root.prim_count),
                ..Self::default()
            });
        }
        let mut tree = Self { order, root: 0, ..Self::default() };
        let area = |node: &obvhs::bvh2::node::Bvh2Node| f64::from(node.aabb().half_area());
        let (whole, mut cost) = (area(root).max(f64::MIN_POSITIVE), 0.0);
        // Left child pairs still to write: index in `bvh`, where the reference goes, depth.
        let mut open = vec![(root.first_index as usize, None, 1)];
        while let Some((pair, parent, depth)) = open.pop() {
            let here = tree.nodes.len();
            tree.depth = tree.depth.max(depth);
            tree.nodes.push(Node::default());
            if let Some((node, second)) = parent {
                let node: &mut Node = &mut tree.nodes[node];
                *(if second { &mut node.child1 } else { &mut node.child0 }) = here as u32;
            }
            for second in [false, true] {
                let child = bvh.nodes.get(pair + usize::from(second))?;
                let (min, max) = (child.aabb().min.into(), child.aabb().max.into());
                let node = &mut tree.nodes[here];
                let reference = if second {
                    (node.min1, node.max1) = (min, max);
                    &mut node.child1
                } else {
                    (node.min0, node.max0) = (min, max);
                    &mut node.child0
                };
                cost += area(child) / whole * f64::from(child.prim_count.max(1));
                if !child.is_leaf() {
                    open.push((child.first_index as usize, Some((here, second)), depth + 1));
                } else if child.prim_count <= MAX_LEAF {
                    *reference = leaf(child.first_index, child.prim_count);
                } else {
                    return None;
                }
            }
        }
        tree.cost = (1.0 + cost) as f32;
        Some(tree)
    }

    /// The same tree in an array that already holds `nodes` nodes; references of leaves stay as they are.
    pub fn shift_nodes(&mut self, nodes: u32) {
        self.shift(nodes, 0);
    }

    /// The same tree in arrays that already hold `nodes` nodes and `primitives` primitives.
    pub fn shift(&mut self, nodes: u32, primitives: u32) {
        let shift = |reference: &mut u32| {
            if *reference != NONE {
                *reference += if *reference & LEAF == 0 { nodes } else { primitives };
            }
        };
        shift(&mut self.root);
        for node in &mut self.nodes {
            shift(&mut node.child0);
            shift(&mut node.child1);
        }
    }
}

/// A tree split in halves by position: its depth is the least possible, whatever the boxes are.
fn balanced(boxes: &[Boxed], max_leaf: u32) -> Tree {
    let center = |i: u32| boxes[i as usize].0.min + boxes[i as usize].0.max;
    let mut tree = Tree { order: (0..boxes.len() as u32).collect(), ..Tree::default() };
    let mut order = std::mem::take(&mut tree.order);
    let bounds_of = |range: &[u32]| {
        range.iter().fold(Bounds::default(), |mut all, &i| {
            all.add(boxes[i as usize].0.min);
            all.add(boxes[i as usize].0.max);
            all
        })
    };
    if boxes.len() as u32 <= max_leaf {
        return Tree { root: leaf(0, boxes.len() as u32), order, ..tree };
    }
    let mut open = vec![(0, boxes.len(), None, 1)];
    while let Some((start, end, parent, depth)) = open.pop() {
        let here = tree.nodes.len();
        tree.depth = tree.depth.max(depth);
        tree.nodes.push(Node::default());
        if let Some((node, second)) = parent {
            let node: &mut Node = &mut tree.nodes[node];
            *(if second { &mut node.child1 } else { &mut node.child0 }) = here as u32;
        }
        let part = &mut order[start..end];
        let size = part.iter().fold(Bounds::default(), |mut all, &i| {
            all.add(center(i));
            all
        });
        let axis = largest_axis(size.max - size.min);
        let half = part.len() / 2;
        part.select_nth_unstable_by(half, |&a, &b| {
            center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(&b))
        });
        for (second, (from, to)) in [(start, start + half), (start + half, end)].into_iter().enumerate() {
            let (bounds, count) = (bounds_of(&order[from..to]), (to - from) as u32);
            let node = &mut tree.nodes[here];
            let reference = if second == 1 {
                (node.min1, node.max1) = (bounds.min.into(), bounds.max.into());
                &mut node.child1
            } else {
                (node.min0, node.max0) = (bounds.min.into(), bounds.max.into());
                &mut node.child0
            };
            if count <= max_leaf {
                *reference = leaf(from as u32, count);
            } else {
                open.push((from, to, Some((here, second == 1)), depth + 1));
            }
        }
    }
    tree.order = order;
    tree
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
    use super::*;
    use proptest::prelude::*;

    /// Walks a tree: every primitive once, every child inside the box that its parent gives it, depth as stated.
    fn check(tree: &Tree, bounds: &[Bounds], max_leaf: u32) {
        let mut seen = vec![0; bounds.len()];
        let mut deepest = 0;
        let mut open = vec![(tree.root, Bounds { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY }, 0)];
        while let Some((reference, outer, depth)) = open.pop() {
            deepest = deepest.max(depth);
            if reference & LEAF != 0 {
                let count = (reference >> LEAF_COUNT_SHIFT & 7) + 1;
                assert!(count <= max_leaf);
                for i in 0..count {
                    let primitive = tree.order[((reference & LEAF_FIRST_MASK) + i) as usize] as usize;
                    seen[primitive] += 1;
                    let b = bounds[primitive];
                    assert!(b.min.cmpge(outer.min).all() && b.max.cmple(outer.max).all());
                }
                continue;
            }
            let node = tree.nodes[reference as usize];
            for (child, min, max) in
                [(node.child0, node.min0, node.max0), (node.child1, node.min1, node.max1)]
            {
                let inner = Bounds { min: min.into(), max: max.into() };
                assert!(inner.min.cmpge(outer.min).all() && inner.max.cmple(outer.max).all());
                open.push((child, inner, depth + 1));
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
            check(&build(bounds.clone(), max_leaf, Quality::Default), &bounds, max_leaf);
            let boxed: Vec<Boxed> = bounds.iter().copied().map(Boxed).collect();
            let tree = balanced(&boxed, max_leaf);
            check(&tree, &bounds, max_leaf);
            prop_assert!(tree.depth <= (bounds.len() as f32).log2().ceil() as u32);
        }
    }

    #[test]
    fn coincident_boxes_stay_within_the_stack() {
        let bounds = vec![Bounds { min: Vec3::ZERO, max: Vec3::ONE }; 20_000];
        let tree = build(bounds.clone(), 4, Quality::Default);
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
            pool.install(|| build(bounds.clone(), 4, Quality::Default))
        };
        let one = with(1);
        assert!(one == with(2) && one == with(7));
    }
}
