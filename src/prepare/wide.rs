//! Binary trees to records with up to four children, whose boxes are rounded outwards to bytes.

use crate::layout::{LEAF, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, LEAF_INSTANCE, NONE, Node};
use obvhs::bvh2::{Bvh2, node::Bvh2Node};

/// A tree over boxes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tree {
    /// Inner nodes; references count from 0 in this tree.
    pub nodes: Vec<Node>,
    /// Primitive at each place of the leaves.
    pub order: Vec<u32>,
    /// Where to start: a reference as in [`Node`]; NONE for no primitives.
    pub root: u32,
    /// Stack entries that a ray may need: children less one, summed along the way down where that is most.
    pub depth: u32,
    /// Expected cost of a random ray by the surface area heuristic: a node costs 1, a primitive 1.
    pub cost: f32,
}

impl Tree {
    /// A tree over nothing.
    pub fn empty() -> Self {
        Self { root: NONE, ..Self::default() }
    }

    /// Joins up to three levels of a binary tree into nodes of up to four children, in the order of a walk from the root.
    /// None when a leaf has more primitives than a reference can count.
    pub fn widened(binary: &Bvh2) -> Option<Self> {
        let root = binary.nodes.first()?;
        let mut tree = Self { order: binary.primitive_indices.clone(), ..Self::default() };
        if root.is_leaf() {
            tree.root = leaf(root)?;
            return Some(tree);
        }
        let whole = area(root).max(f64::MIN_POSITIVE);
        let mut cost = 1.0;
        let mut open = vec![Open { index: 0, parent: None, above: 0 }];
        while let Some(inner) = open.pop() {
            let here = tree.nodes.len();
            if let Some((node, child)) = inner.parent {
                tree.nodes[node].children[child] = here as u32;
            }
            let children = Children::of(binary, inner.index)?;
            let children = children.as_slice();
            let above = inner.above + children.len() as u32 - 1;
            tree.depth = tree.depth.max(above);
            let mut node = with_boxes(binary.nodes.get(inner.index as usize)?, binary, children);
            for (i, &child) in children.iter().enumerate() {
                let inner = &binary.nodes[child as usize];
                cost += area(inner) / whole * f64::from(inner.prim_count.max(1));
                if inner.is_leaf() {
                    node.children[i] = leaf(inner)?;
                } else {
                    open.push(Open { index: child, parent: Some((here, i)), above });
                }
            }
            tree.nodes.push(node);
        }
        tree.cost = cost as f32;
        Some(tree)
    }

    /// The same tree in arrays that already hold `nodes` nodes and `primitives` primitives.
    pub fn shift(&mut self, nodes: u32, primitives: u32) {
        for reference in references(&mut self.root, &mut self.nodes) {
            if *reference & LEAF == 0 {
                *reference += nodes;
            } else if *reference & LEAF_INSTANCE == 0 {
                *reference += primitives;
            }
        }
    }
}

/// All references of a tree; those of instances, and NONE for no child, among them.
pub(super) fn references<'a>(root: &'a mut u32, nodes: &'a mut [Node]) -> impl Iterator<Item = &'a mut u32> {
    std::iter::once(root).chain(nodes.iter_mut().flat_map(|node| &mut node.children))
}

/// The reference of a leaf, when it can count its primitives.
fn leaf(node: &Bvh2Node) -> Option<u32> {
    let count = (1..=super::bvh::MAX_LEAF).contains(&node.prim_count);
    count.then(|| LEAF | (node.prim_count - 1) << LEAF_COUNT_SHIFT | (node.first_index & LEAF_FIRST_MASK))
}

fn area(node: &Bvh2Node) -> f64 {
    f64::from(node.aabb().half_area())
}

/// A binary node that is to become a wide one.
struct Open {
    index: u32,
    /// The node and the child of it that refer to this one.
    parent: Option<(usize, usize)>,
    /// Stack entries of the nodes on the way.
    above: u32,
}

/// The children of a wide node: those of a binary node, of which the largest are replaced by theirs.
#[derive(Clone, Copy)]
struct Children {
    indices: [u32; 4],
    count: usize,
}

impl Children {
    fn of(binary: &Bvh2, index: u32) -> Option<Self> {
        let pair = |index: u32| {
            let first = binary.nodes.get(index as usize)?.first_index;
            binary.nodes.get(first as usize + 1).map(|_| [first, first + 1])
        };
        let [first, second] = pair(index)?;
        let mut children = Self { indices: [first, second, 0, 0], count: 2 };
        while children.count < 4 {
            let inner =
                (0..children.count).filter(|&i| !binary.nodes[children.indices[i] as usize].is_leaf());
            let size = |i: &usize| area(&binary.nodes[children.indices[*i] as usize]);
            let Some(largest) = inner.max_by(|a, b| size(a).total_cmp(&size(b))) else { break };
            let [first, second] = pair(children.indices[largest])?;
            children.indices[largest] = first;
            children.indices[children.count] = second;
            children.count += 1;
        }
        Some(children)
    }

    fn as_slice(&self) -> &[u32] {
        &self.indices[..self.count]
    }
}

/// A node without references: the boxes of its children.
fn with_boxes(parent: &Bvh2Node, binary: &Bvh2, children: &[u32]) -> Node {
    let (low, high) = (parent.aabb().min.to_array(), parent.aabb().max.to_array());
    let mut node = Node { children: [NONE; 4], ..Node::default() };
    for axis in 0..3 {
        let exponent = step_exponent(f64::from(high[axis]) - f64::from(low[axis]));
        let step = 2f64.powi(exponent as i32 - 127);
        node.origin[axis] = low[axis];
        node.exponents |= exponent << (8 * axis);
        for (i, &child) in children.iter().enumerate() {
            let aabb = binary.nodes[child as usize].aabb();
            let steps = |corner: f32| (f64::from(corner) - f64::from(low[axis])) / step;
            // The step is a power of two: both are exact before they are rounded
            let from = steps(aabb.min.to_array()[axis]).floor().clamp(0.0, 255.0) as u32;
            let to = steps(aabb.max.to_array()[axis]).ceil().clamp(0.0, 255.0) as u32;
            node.low[axis] |= from << (8 * i);
            node.high[axis] |= to << (8 * i);
        }
    }
    node
}

/// The least biased exponent whose 255 steps are not shorter than `extent`.
fn step_exponent(extent: f64) -> u32 {
    let fits = |exponent: &i32| 255.0 * 2f64.powi(exponent - 127) >= extent;
    let guess = (extent / 255.0).log2().ceil().clamp(-126.0, 127.0) as i32 + 127;
    (guess - 1..=guess + 1).filter(|e| (1..=254).contains(e)).find(fits).unwrap_or(254) as u32
}

/// The box of a child, as kernels see it.
#[cfg(test)]
pub(super) fn child_box(node: &Node, child: usize) -> super::Bounds {
    let corner = |bytes: [u32; 3]| {
        glam::Vec3::from_array(std::array::from_fn(|axis| {
            let step = 2f64.powi((node.exponents >> (8 * axis) & 255) as i32 - 127);
            (f64::from(node.origin[axis]) + f64::from(bytes[axis] >> (8 * child) & 255) * step) as f32
        }))
    };
    super::Bounds { min: corner(node.low), max: corner(node.high) }
}
