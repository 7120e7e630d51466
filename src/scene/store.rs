//! Named objects and typed indices to them.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};
use std::sync::Arc;

/// Index of an object in its [`Store`]: typed, so that a material cannot be taken for a mesh.
pub struct Handle<T> {
    index: u32,
    kind: PhantomData<fn() -> T>,
}

impl<T> Handle<T> {
    /// Position in the store.
    pub fn index(self) -> usize {
        self.index as usize
    }
}

impl<T> Clone for Handle<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Handle<T> {}
impl<T> PartialEq for Handle<T> {
    fn eq(&self, other: &Self) -> bool {
        self.index == other.index
    }
}
impl<T> Eq for Handle<T> {}
impl<T> PartialOrd for Handle<T> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> Ord for Handle<T> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.index.cmp(&other.index)
    }
}
impl<T> std::hash::Hash for Handle<T> {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.index.hash(state);
    }
}
impl<T> fmt::Debug for Handle<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.index)
    }
}

/// Named objects in the order in which they were added. Names need not be unique here: readers that
/// promise unique names check that themselves.
///
/// Copies of a store share their objects, until one of them is changed.
#[derive(Debug)]
pub struct Store<T> {
    items: Vec<(String, Arc<T>)>,
}

impl<T> Clone for Store<T> {
    fn clone(&self) -> Self {
        Self { items: self.items.clone() }
    }
}

impl<T> Default for Store<T> {
    fn default() -> Self {
        Self { items: Vec::new() }
    }
}

impl<T> Store<T> {
    /// Adds an object and gives its handle. A store holds at most 2³² − 1 objects.
    pub fn add(&mut self, name: impl Into<String>, item: impl Into<Arc<T>>) -> Handle<T> {
        let index = self.items.len() as u32;
        self.items.push((name.into(), item.into()));
        Handle { index, kind: PhantomData }
    }

    /// Name of an object.
    pub fn name(&self, handle: Handle<T>) -> &str {
        &self.items[handle.index()].0
    }

    /// An object, to keep.
    pub fn shared(&self, handle: Handle<T>) -> Arc<T> {
        self.items[handle.index()].1.clone()
    }

    /// Puts another object in the place of one.
    pub fn replace(&mut self, handle: Handle<T>, item: impl Into<Arc<T>>) {
        self.items[handle.index()].1 = item.into();
    }

    /// The objects alone.
    pub fn into_items(self) -> impl Iterator<Item = Arc<T>> {
        self.items.into_iter().map(|(_, item)| item)
    }

    /// Number of objects.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// All objects with handle and name, in the order of their handles.
    pub fn iter(&self) -> impl Iterator<Item = (Handle<T>, &str, &T)> {
        self.items
            .iter()
            .enumerate()
            .map(|(i, (name, item))| (Handle { index: i as u32, kind: PhantomData }, name.as_str(), &**item))
    }
}

impl<T> Index<Handle<T>> for Store<T> {
    type Output = T;
    fn index(&self, handle: Handle<T>) -> &T {
        &self.items[handle.index()].1
    }
}

impl<T: Clone> IndexMut<Handle<T>> for Store<T> {
    fn index_mut(&mut self, handle: Handle<T>) -> &mut T {
        Arc::make_mut(&mut self.items[handle.index()].1)
    }
}
