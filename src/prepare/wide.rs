//! Binary trees to records with up to four children, whose boxes are rounded outwards to bytes.

use crate::layout::{CHILD_MARK_SHIFT, CHILD_NONE, Item, LEAF_COUNT_SHIFT, NONE, Node};
use obvhs::bvh2::{Bvh2, node::Bvh2Node};

/// A tree over boxes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tree {
    /// Nodes, and what the leaves hold.
    pub items: Vec<Item>,
    /// How many of the items are nodes.
    pub nodes: usize,
    /// Where to start: a reference; NONE for no primitives.
    pub root: u32,
    /// Stack entries that a ray may need: children less one, summed along the way down where that is most.
    pub depth: u32,
    /// Expected cost of a random ray by the surface area heuristic: a node costs 1, a primitive 1.
    pub cost: f32,
}

/// What becomes of the primitives of a tree.
pub struct Leaves<'a> {
    /// Place of the tree's first item in the buffer of trees.
    pub first_item: u32,
    /// Bits of the references to leaves.
    pub mark: u32,
    /// The item of a primitive.
    pub item: &'a dyn Fn(u32) -> Item,
}

impl Tree {
    /// A tree over nothing.
    pub fn empty() -> Self {
        Self { root: NONE, ..Self::default() }
    }

    /// Joins up to three levels of a binary tree into nodes of up to four children, in the order of a walk from the root.
    /// None when a leaf has more primitives than a reference can count.
    pub fn widened(binary: &Bvh2, leaves: &Leaves) -> Option<Self> {
        let root = binary.nodes.first()?;
        let mut tree = Self { root: leaves.first_item, ..Self::default() };
        if root.is_leaf() {
            tree.root |= tree.push_leaf(root, binary, leaves)?;
            return Some(tree);
        }
        let whole = area(root).max(f64::MIN_POSITIVE);
        let mut cost = 1.0;
        tree.items.push(Item::default());
        let mut open = vec![Open { index: 0, place: 0, above: 0 }];
        while let Some(inner) = open.pop() {
            let children = Children::of(binary, inner.index)?;
            let children = children.as_slice();
            let above = inner.above + children.len() as u32 - 1;
            tree.depth = tree.depth.max(above);
            let mut node = with_boxes(binary.nodes.get(inner.index as usize)?, binary, children);
            let base = tree.items.len();
            node.base = leaves.first_item + base as u32;
            let mut bytes = [CHILD_NONE; 4];
            for (byte, &index) in bytes.iter_mut().zip(children) {
                let child = &binary.nodes[index as usize];
                cost += area(child) / whole * f64::from(child.prim_count.max(1));
                let place = tree.items.len();
                let mark = if child.is_leaf() {
                    tree.push_leaf(child, binary, leaves)?
                } else {
                    tree.items.push(Item::default());
                    open.push(Open { index, place, above });
                    0
                };
                *byte = mark >> CHILD_MARK_SHIFT | (place - base) as u32;
            }
            node.children = u32::from_le_bytes(bytes.map(|byte| byte as u8));
            tree.items[inner.place] = bytemuck::cast(node);
            tree.nodes += 1;
        }
        tree.cost = cost as f32;
        Some(tree)
    }

    /// Puts the primitives of a leaf, if a reference can count them, and gives the upper bits of the reference.
    fn push_leaf(&mut self, leaf: &Bvh2Node, binary: &Bvh2, leaves: &Leaves) -> Option<u32> {
        if !(1..=super::bvh::MAX_LEAF).contains(&leaf.prim_count) {
            return None;
        }
        let first = leaf.first_index as usize;
        let primitives = binary.primitive_indices.get(first..first + leaf.prim_count as usize)?;
        self.items.extend(primitives.iter().map(|&primitive| (leaves.item)(primitive)));
        Some(leaves.mark | (leaf.prim_count - 1) << LEAF_COUNT_SHIFT)
    }
}

fn area(node: &Bvh2Node) -> f64 {
    f64::from(node.aabb().half_area())
}

/// A binary node that is to become a wide one.
struct Open {
    index: u32,
    /// The item that it becomes.
    place: usize,
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

/// A node with the boxes of its children only.
fn with_boxes(parent: &Bvh2Node, binary: &Bvh2, children: &[u32]) -> Node {
    let (low, high) = (parent.aabb().min.to_array(), parent.aabb().max.to_array());
    let mut node = Node::default();
    for axis in 0..3 {
        let exponent = step_exponent(f64::from(high[axis]) - f64::from(low[axis]));
        let step = 2f64.powi(exponent as i32 - 127);
        node.origin[axis] = low[axis];
        node.exponents |= exponent << (8 * axis);
        for (i, &child) in children.iter().enumerate() {
            let aabb = binary.nodes[child as usize].aabb();
            // The step is a power of two: the quotients are exact
            let (from, _) = difference(aabb.min.to_array()[axis], low[axis]);
            let (_, to) = difference(aabb.max.to_array()[axis], low[axis]);
            let from = (from / step).floor().clamp(0.0, 255.0) as u32;
            let to = (to / step).ceil().clamp(0.0, 255.0) as u32;
            node.low[axis] |= from << (8 * i);
            node.high[axis] |= to << (8 * i);
        }
    }
    node
}

/// a − b, rounded down and up. In most cases both are exact; the rest of a difference is known (Knuth, TAOCP 4.2.2).
fn difference(a: f32, b: f32) -> (f64, f64) {
    let (a, b) = (f64::from(a), f64::from(b));
    let rounded = a - b;
    let part = rounded - a;
    let rest = (a - (rounded - part)) - (b + part);
    (
        if rest < 0.0 { rounded.next_down() } else { rounded },
        if rest > 0.0 { rounded.next_up() } else { rounded },
    )
}

/// The least biased exponent whose 255 steps are not shorter than `extent`.
fn step_exponent(extent: f64) -> u32 {
    let fits = |exponent: &i32| 255.0 * 2f64.powi(exponent - 127) >= extent;
    let guess = (extent / 255.0).log2().ceil().clamp(-126.0, 127.0) as i32 + 127;
    (guess - 1..=guess + 1).filter(|e| (1..=254).contains(e)).find(fits).unwrap_or(254) as u32
}

/// The reference of a child, as kernels see it.
#[cfg(test)]
pub(super) fn child(node: &Node, child: usize) -> Option<u32> {
    use crate::layout::CHILD_OFFSET_MASK;
    let byte = node.children >> (8 * child) & 255;
    let reference =
        (byte & !CHILD_OFFSET_MASK) << CHILD_MARK_SHIFT | (node.base + (byte & CHILD_OFFSET_MASK));
    (byte != CHILD_NONE).then_some(reference)
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
