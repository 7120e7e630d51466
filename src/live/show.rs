//! What there is to see: written by the threads that make it, read by those that show it.

use super::{Generation, Picks};
use crate::Error;
use crate::film::Picture;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::watch;

/// A picture at some time.
pub struct Shot {
    /// Its generation.
    pub generation: Arc<Generation>,
    /// What is in the film. Pixels without a sample are those of the shot before, where it has the same size.
    pub picture: Picture,
    /// Counts from 1: later shots have larger ones.
    pub serial: u64,
    /// Samples that every pixel has.
    pub spp: u32,
    /// Samples a second of this generation.
    pub rate: f64,
    /// Seconds in which the driver compiled what it had left for the first dispatch.
    pub warm_seconds: f64,
}

/// What there is to see now.
#[derive(Clone, Default)]
pub struct State {
    /// The last good generation.
    pub generation: Option<Arc<Generation>>,
    /// Its picture, or that of the one before as long as it has none.
    pub shot: Option<Arc<Shot>>,
    /// The last picture of the generation before.
    pub before: Option<Arc<Shot>>,
    /// What is under the pixels of a generation that was asked about.
    pub picks: Option<Arc<Picks>>,
    /// What is wrong with the files as they are now.
    pub error: Option<Error>,
    /// It is looked at from elsewhere than the scene says.
    pub moved: bool,
    /// Attempts so far, good and bad.
    pub attempts: u64,
    /// Seconds from the edit to the first new pixels of the generation; none when it was no edit.
    pub latency: Option<f64>,
}

/// The state, and who waits for it to change.
pub struct Show {
    state: Mutex<State>,
    changed: Condvar,
    changes: watch::Sender<u64>,
}

impl Default for Show {
    fn default() -> Self {
        Self { state: Mutex::default(), changed: Condvar::new(), changes: watch::Sender::new(0) }
    }
}

impl Show {
    /// The state as it is now.
    pub fn state(&self) -> State {
        self.lock().clone()
    }

    /// Waits until the state is one that is wanted, but no longer than `limit`. Gives it as it is then.
    pub fn wait(&self, limit: Duration, mut wanted: impl FnMut(&State) -> bool) -> State {
        let waited = self.changed.wait_timeout_while(self.lock(), limit, |state| !wanted(state));
        waited.unwrap_or_else(PoisonError::into_inner).0.clone()
    }

    /// A number that changes with the state.
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.changes.subscribe()
    }

    /// Changes the state.
    pub(super) fn change(&self, change: impl FnOnce(&mut State)) {
        change(&mut self.lock());
        self.changed.notify_all();
        self.changes.send_modify(|number| *number += 1);
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        // Each change is whole before a thread could panic
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
