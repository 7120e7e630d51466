//! What ends a render early: Ctrl-C, SIGTERM, and the time limit.

use dapple::{Error, Result};
use serde::Serialize;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Exit code of a second Ctrl-C: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// Why a render ended before all samples were done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    Signal,
    TimeLimit,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Signal => "a signal",
            Self::TimeLimit => "the time limit",
        })
    }
}

/// Watches for the end.
pub struct Stop {
    signalled: Arc<AtomicBool>,
    limit: Option<Duration>,
}

impl Stop {
    /// From now on a first Ctrl-C or SIGTERM only asks for the end, and a Ctrl-C after it quits.
    pub fn watch(limit: Option<Duration>) -> Result<Self> {
        let signalled = Arc::new(AtomicBool::new(false));
        let refused = |error| Error::device(format!("cannot watch for Ctrl-C: {error}"));
        // Handlers run in the order of registration: the one that quits sees the flag of an earlier signal only.
        flag::register_conditional_shutdown(SIGINT, INTERRUPTED, signalled.clone()).map_err(refused)?;
        for signal in [SIGINT, SIGTERM] {
            flag::register(signal, signalled.clone()).map_err(refused)?;
        }
        Ok(Self { signalled, limit })
    }

    /// Why to end after `elapsed` of rendering, if at all.
    pub fn reason(&self, elapsed: Duration) -> Option<Reason> {
        if self.signalled.load(Ordering::Relaxed) {
            Some(Reason::Signal)
        } else {
            self.limit.filter(|limit| elapsed >= *limit).map(|_| Reason::TimeLimit)
        }
    }

    /// What is left of the time limit.
    pub fn left(&self, elapsed: Duration) -> Option<Duration> {
        self.limit.map(|limit| limit.saturating_sub(elapsed))
    }
}
