//! Trees that are built, or were built before.

use super::bounds::triangle_bounds;
use super::bvh::{self, Quality};
use super::kept::Kept;
use super::{Leaves, Prepared, Tree};
use crate::layout::{LEAF, LEAF_FIRST_MASK, Triangle};
use crate::{Error, Result};
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Instant;

/// Most triangles a leaf holds.
const TRIANGLES_A_LEAF: u32 = 4;

/// The trees of the scene that was prepared before, so that an edit builds only those whose primitives are others.
#[derive(Debug, Default)]
pub struct Trees {
    kept: Kept<Tree>,
    seconds: f64,
}

impl Trees {
    /// Trees that are kept for the next scene.
    pub fn kept() -> Self {
        Self { kept: Kept::remembering(), seconds: 0.0 }
    }

    /// Begins a scene: what the last whole one did not use is forgotten.
    pub(super) fn begin(&mut self) {
        self.seconds = 0.0;
        self.kept.begin();
    }

    /// Ends it. Gives the seconds that building took.
    pub(super) fn end(&mut self) -> f64 {
        self.kept.end();
        self.seconds
    }

    /// A tree that depends on nothing but the bytes of `key`.
    pub(super) fn tree(&mut self, key: &[&[u8]], build: impl FnOnce() -> Tree) -> Arc<Tree> {
        let Ok(tree) = self.kept.get(key, || {
            let start = Instant::now();
            let tree = build();
            self.seconds += start.elapsed().as_secs_f64();
            Ok::<_, Infallible>(tree)
        });
        tree
    }

    /// How many were built for the last scene.
    pub fn built(&self) -> u32 {
        self.kept.made()
    }
}

impl Prepared {
    /// Where the tree of some more primitives begins.
    pub(super) fn first_item(&self, primitives: usize) -> Result<u32> {
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
    pub(super) fn push_tree(&mut self, triangles: Vec<Triangle>, trees: &mut Trees) -> Result<(u32, u32)> {
        let leaves = Leaves {
            first_item: self.first_item(triangles.len())?,
            mark: LEAF,
            item: &|i| bytemuck::cast(triangles[i as usize]),
        };
        let key = [&leaves.first_item.to_le_bytes(), bytemuck::cast_slice(&triangles)];
        let tree = trees.tree(&key, || {
            let bounds = triangles.iter().map(triangle_bounds).collect();
            bvh::build(bounds, TRIANGLES_A_LEAF, Quality::Default, &leaves)
        });
        self.triangle_count += triangles.len();
        self.node_count += tree.nodes;
        self.bvh_cost = self.bvh_cost.max(tree.cost);
        let place = (tree.root, tree.depth);
        self.tree.append(&mut Arc::unwrap_or_clone(tree).items);
        Ok(place)
    }
}
