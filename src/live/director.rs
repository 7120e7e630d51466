//! The thread that waits for edits and makes generations of them.

use super::painter::Order;
use super::{Event, Picks, Show, State, Studio, Watch};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

/// An edit is over when so long nothing more happened: to save a file takes several steps.
const QUIET: Duration = Duration::from_millis(15);
/// But no longer than so long after it began.
const LONGEST: Duration = Duration::from_millis(250);
/// What is under the pixels is found out when so long nothing happened, so that no step of the camera waits for it.
const REST: Duration = Duration::from_millis(250);

/// What happened since the last attempt.
#[derive(Default)]
struct Happened {
    edited: BTreeSet<PathBuf>,
    looked: bool,
    asked: bool,
    quit: bool,
}

/// Makes a generation, and another whenever something happened, until it is told to quit.
pub(super) fn direct(
    mut studio: Studio,
    mut watch: Watch,
    events: &Receiver<Event>,
    painter: &Sender<Order>,
    show: &Show,
) {
    let mut cause = None;
    let mut asked = false;
    loop {
        attempt(&mut studio, &mut watch, painter, show, cause.take());
        loop {
            let first =
                match if asked { events.recv_timeout(REST) } else { events.recv().map_err(Into::into) } {
                    Ok(first) => first,
                    Err(RecvTimeoutError::Timeout) => {
                        asked = false;
                        pick(&mut studio, show);
                        continue;
                    }
                    Err(RecvTimeoutError::Disconnected) => return,
                };
            let begun = Instant::now();
            let mut happened = Happened::default();
            happened.take(first, &mut studio);
            while !happened.quit && begun.elapsed() < LONGEST {
                let wait = if happened.edited.is_empty() { Duration::ZERO } else { QUIET };
                match events.recv_timeout(wait) {
                    Ok(event) => happened.take(event, &mut studio),
                    Err(RecvTimeoutError::Timeout) => break,
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
            if happened.quit {
                return;
            }
            asked |= happened.asked;
            if happened.looked || studio.touched_by(&happened.edited) {
                cause = Some(begun);
                break;
            }
        }
    }
}

impl Happened {
    fn take(&mut self, event: Event, studio: &mut Studio) {
        match event {
            Event::Edited(paths) => self.edited.extend(paths),
            Event::Look(camera) => {
                studio.set_camera(camera);
                self.looked = true;
            }
            Event::Pick => self.asked = true,
            Event::Quit => self.quit = true,
        }
    }
}

/// Finds out what is under the pixels of the last good generation, once.
fn pick(studio: &mut Studio, show: &Show) {
    let State { generation, picks, error, .. } = show.state();
    let Some(number) = generation.map(|generation| generation.number) else { return };
    if error.is_some() || picks.is_some_and(|picks| picks.generation == number) {
        return;
    }
    // Files that have just become others are no error here: that edit is yet to come
    let picks = studio.picks(number).unwrap_or_else(|_| Picks::none(number));
    show.change(|state| state.picks = Some(Arc::new(picks)));
}

/// One transaction.
fn attempt(
    studio: &mut Studio,
    watch: &mut Watch,
    painter: &Sender<Order>,
    show: &Show,
    cause: Option<Instant>,
) {
    // A painter that is gone has nobody to paint for: the next event is to quit
    let order = |order| _ = painter.send(order);
    order(Order::Pause);
    let outcome = studio.generation().map(Arc::new);
    let (files, tree) = studio.watched();
    let outcome = watch.follow(files, tree).and(outcome);
    // The error is gone before the first pixels are there
    show.change(|state| {
        state.attempts += 1;
        state.moved = studio.is_moved();
        state.error = outcome.as_ref().err().cloned();
    });
    order(match &outcome {
        Ok(generation) => Order::Paint(generation.clone(), cause),
        Err(_) => Order::Resume,
    });
}
