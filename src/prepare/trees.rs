//! Trees that are built, or were built before.

use super::bounds::triangle_bounds;
use super::bvh::{self, Quality};
use super::{Leaves, Prepared, Tree};
use crate::layout::{LEAF, LEAF_FIRST_MASK, Triangle};
use crate::{Error, Result};
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

/// Most triangles a leaf holds.
const TRIANGLES_A_LEAF: u32 = 4;

/// The trees of the scene that was prepared before, so that an edit builds only those whose primitives are others.
#[derive(Debug, Default)]
pub struct Trees {
    /// None: nothing is kept.
    known: Option<HashMap<blake3::Hash, Arc<Tree>>>,
    /// Those that the scene has which is being prepared.
    used: HashMap<blake3::Hash, Arc<Tree>>,
    /// The last scene was prepared to its end.
    whole: bool,
    built: u32,
    seconds: f64,
}

impl Trees {
    /// Trees that are kept for the next scene.
    pub fn kept() -> Self {
        Self { known: Some(HashMap::new()), ..Self::default() }
    }

    /// Begins a scene: what the last whole one did not use is forgotten.
    pub(super) fn begin(&mut self) {
        (self.built, self.seconds) = (0, 0.0);
        if let Some(known) = &mut self.known {
            if std::mem::take(&mut self.whole) {
                known.clear();
            }
            known.extend(self.used.drain());
        }
    }

    /// Ends it. Gives the seconds that building took.
    pub(super) fn end(&mut self) -> f64 {
        self.whole = true;
        self.seconds
    }

    /// A tree that depends on nothing but the bytes of `key`.
    pub(super) fn tree(&mut self, key: &[&[u8]], build: impl FnOnce() -> Tree) -> Arc<Tree> {
        let Some(known) = &self.known else { return self.timed(build) };
        let mut hasher = blake3::Hasher::new();
        for part in key {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
        let key = hasher.finalize();
        let tree = match self.used.get(&key).or_else(|| known.get(&key)) {
            Some(tree) => tree.clone(),
            None => self.timed(build),
        };
        self.used.insert(key, tree.clone());
        tree
    }

    fn timed(&mut self, build: impl FnOnce() -> Tree) -> Arc<Tree> {
        let start = Instant::now();
        let tree = Arc::new(build());
        self.seconds += start.elapsed().as_secs_f64();
        self.built += 1;
        tree
    }

    /// How many were built for the last scene.
    pub fn built(&self) -> u32 {
        self.built
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

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(trees: &mut Trees, keys: &[&[u8]]) -> u32 {
        let built = ask_and_fail(trees, keys);
        trees.end();
        built
    }

    fn ask_and_fail(trees: &mut Trees, keys: &[&[u8]]) -> u32 {
        trees.begin();
        for (key, root) in keys.iter().zip(0..) {
            assert_eq!(trees.tree(&[key], || Tree { root, ..Tree::default() }).root, root);
        }
        trees.built()
    }

    #[test]
    fn what_the_scene_before_had_is_not_built_again() {
        let mut trees = Trees::kept();
        assert_eq!(ask(&mut trees, &[b"a", b"b"]), 2);
        assert_eq!(ask(&mut trees, &[b"a", b"b"]), 0);
        assert_eq!(ask(&mut trees, &[b"a"]), 0);
        // Forgotten, because the last scene had it not
        assert_eq!(trees.known.as_ref().map(HashMap::len), Some(2));
        assert_eq!(ask(&mut trees, &[b"a", b"c"]), 1);
        assert_eq!(ask(&mut trees, &[b"a", b"b"]), 1);
    }

    #[test]
    fn a_scene_that_fails_forgets_nothing() {
        let mut trees = Trees::kept();
        assert_eq!(ask(&mut trees, &[b"a", b"b"]), 2);
        assert_eq!(ask_and_fail(&mut trees, &[b"x", b"y", b"c"]), 3);
        assert_eq!(ask_and_fail(&mut trees, &[]), 0);
        assert_eq!(ask(&mut trees, &[b"a", b"b", b"c"]), 0);
    }

    #[test]
    fn parts_of_a_key_do_not_run_together() {
        let mut trees = Trees::kept();
        trees.begin();
        trees.tree(&[b"ab", b"c"], Tree::default);
        trees.tree(&[b"a", b"bc"], Tree::default);
        assert_eq!(trees.built(), 2);
    }

    #[test]
    fn nothing_is_kept_unless_asked_for() {
        let mut trees = Trees::default();
        assert_eq!(ask(&mut trees, &[b"a"]), 1);
        assert_eq!(ask(&mut trees, &[b"a"]), 1);
        assert!(trees.used.is_empty());
    }
}
