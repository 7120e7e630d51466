//! What was made for the scene before, found again by what it was made from.

use crate::scene::Mesh;
use std::collections::HashMap;
use std::sync::Arc;

/// Things that the scene before had, so that an edit makes only those that it touches.
#[derive(Debug)]
pub struct Kept<T> {
    /// None: nothing is kept.
    known: Option<HashMap<blake3::Hash, Arc<T>>>,
    /// Those of the scene that is being made.
    used: HashMap<blake3::Hash, Arc<T>>,
    /// The last scene was made to its end.
    whole: bool,
    made: u32,
}

/// Displaced meshes.
pub type Displaced = Kept<Mesh>;

/// Nothing is kept.
impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self { known: None, used: HashMap::new(), whole: false, made: 0 }
    }
}

impl<T> Kept<T> {
    /// Things that are kept for the next scene.
    pub fn remembering() -> Self {
        Self { known: Some(HashMap::new()), ..Self::default() }
    }

    /// Whether anything is kept.
    pub fn remembers(&self) -> bool {
        self.known.is_some()
    }

    /// Begins a scene: what the last whole one did not use is forgotten.
    pub fn begin(&mut self) {
        self.made = 0;
        if let Some(known) = &mut self.known {
            if std::mem::take(&mut self.whole) {
                known.clear();
            }
            known.extend(self.used.drain());
        }
    }

    /// Ends it.
    pub fn end(&mut self) {
        self.whole = true;
    }

    /// How many were made for the last scene.
    pub fn made(&self) -> u32 {
        self.made
    }

    /// A thing that depends on nothing but the bytes of `key`.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub(super) fn get<E>(&mut self, key: &[&[u8]], make: impl FnOnce() -> Result<T, E>) -> Result<Arc<T>, E> {
        let Some(known) = &self.known else {
            self.made += 1;
            return make().map(Arc::new);
        };
        let mut hasher = blake3::Hasher::new();
        for part in key {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
        let key = hasher.finalize();
        let thing = match self.used.get(&key).or_else(|| known.get(&key)) {
            Some(thing) => thing.clone(),
            None => {
                self.made += 1;
                Arc::new(make()?)
            }
        };
        self.used.insert(key, thing.clone());
        Ok(thing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn ask(kept: &mut Kept<u32>, keys: &[&[u8]]) -> u32 {
        let made = ask_and_fail(kept, keys);
        kept.end();
        made
    }

    fn ask_and_fail(kept: &mut Kept<u32>, keys: &[&[u8]]) -> u32 {
        kept.begin();
        for (key, number) in keys.iter().zip(0..) {
            let Ok(thing) = kept.get(&[key], || Ok::<_, Infallible>(number));
            assert_eq!(*thing, number);
        }
        kept.made()
    }

    #[test]
    fn what_the_scene_before_had_is_not_made_again() {
        let mut kept = Kept::remembering();
        assert_eq!(ask(&mut kept, &[b"a", b"b"]), 2);
        assert_eq!(ask(&mut kept, &[b"a", b"b"]), 0);
        assert_eq!(ask(&mut kept, &[b"a"]), 0);
        // Forgotten, because the last scene had it not
        assert_eq!(kept.known.as_ref().map(HashMap::len), Some(2));
        assert_eq!(ask(&mut kept, &[b"a", b"c"]), 1);
        assert_eq!(ask(&mut kept, &[b"a", b"b"]), 1);
    }

    #[test]
    fn a_scene_that_fails_forgets_nothing() {
        let mut kept = Kept::remembering();
        assert_eq!(ask(&mut kept, &[b"a", b"b"]), 2);
        assert_eq!(ask_and_fail(&mut kept, &[b"x", b"y", b"c"]), 3);
        assert_eq!(ask_and_fail(&mut kept, &[]), 0);
        assert_eq!(ask(&mut kept, &[b"a", b"b", b"c"]), 0);
    }

    #[test]
    fn what_fails_is_tried_again() {
        let mut kept = Kept::remembering();
        kept.begin();
        assert_eq!(kept.get(&[b"a"], || Err("no")), Err("no"));
        assert_eq!(kept.get(&[b"a"], || Ok::<_, &str>(1)), Ok(Arc::new(1)));
    }

    #[test]
    fn parts_of_a_key_do_not_run_together() {
        let mut kept = Kept::<u32>::remembering();
        kept.begin();
        for key in [[b"ab".as_slice(), b"c"], [b"a", b"bc"]] {
            let Ok(_) = kept.get(&key, || Ok::<_, Infallible>(0));
        }
        assert_eq!(kept.made(), 2);
    }

    #[test]
    fn nothing_is_kept_unless_asked_for() {
        let mut kept = Kept::default();
        assert_eq!(ask(&mut kept, &[b"a"]), 1);
        assert_eq!(ask(&mut kept, &[b"a"]), 1);
        assert!(kept.used.is_empty());
    }
}
