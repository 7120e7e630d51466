//! How many objects of a device are alive.

use super::Gpu;
use std::sync::Arc;

/// What an object holds as long as it is counted.
pub(super) type Token = Arc<()>;

/// The tokens, by the kind of object.
#[derive(Default)]
pub(super) struct Census {
    pub buffers: Token,
    pub pipelines: Token,
    pub bindings: Token,
    pub modules: Token,
}

/// Numbers of objects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Alive {
    /// Buffers.
    pub buffers: usize,
    /// Pipelines.
    pub pipelines: usize,
    /// Descriptor sets.
    pub bindings: usize,
    /// Shader modules.
    pub modules: usize,
}

impl Gpu {
    /// The objects that are alive.
    pub fn alive(&self) -> Alive {
        let census = &self.inner.census;
        let count = |token: &Token| Arc::strong_count(token) - 1;
        Alive {
            buffers: count(&census.buffers),
            pipelines: count(&census.pipelines),
            bindings: count(&census.bindings),
            modules: count(&census.modules),
        }
    }
}
