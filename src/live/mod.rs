//! A scene that is shown while it is edited.
//!
//! [`Watch`] tells which files were edited. The director waits for that, and asks the [`Studio`] for a [`Generation`]: the files as they
//! are now, on the device, with all that the edit did not touch kept. The painter renders the newest one, and puts pictures into the
//! [`Show`], where they are for all who want to see them. An edit with an error changes nothing but the error in the show.

mod director;
mod files;
mod painter;
mod picks;
mod serve;
mod show;
mod studio;
mod watch;

pub use picks::Picks;
pub use serve::{About, Address, Server};
pub use show::{Shot, Show, State};
pub use studio::{Adjust, Generation, Request, Studio};
pub use watch::Watch;

use crate::Result;
use crate::gpu::Gpu;
use crate::scene::Camera;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// What may happen to what is shown.
pub enum Event {
    /// Files were edited.
    Edited(Vec<PathBuf>),
    /// Somebody asks what is under the pixels.
    Pick,
    /// Look from elsewhere; none = from where the scene says.
    Look(Option<Camera>),
    /// No more is wanted.
    Quit,
}

/// A scene that is being shown. It ends when this is dropped.
pub struct Live {
    show: Arc<Show>,
    events: Sender<Event>,
    threads: Vec<JoinHandle<()>>,
}

impl Live {
    /// Shows a scene with up to `spp` samples a pixel, on threads of its own.
    ///
    /// # Errors
    ///
    /// When the folder of shaders has none, or files cannot be watched. A scene with an error is none: it may be mended.
    pub fn start(gpu: Arc<Gpu>, request: Request, spp: u32) -> Result<Self> {
        let show = Arc::new(Show::default());
        let (events, happened) = channel();
        let (orders, ordered) = channel();
        let watch = Watch::new(events.clone(), Event::Edited)?;
        let studio = Studio::new(gpu, request)?;
        let painted = show.clone();
        let painter = std::thread::spawn(move || painter::paint(&ordered, &painted, spp));
        let directed = show.clone();
        let director = std::thread::spawn(move || {
            director::direct(studio, watch, &happened, &orders, &directed);
        });
        Ok(Self { show, events, threads: vec![director, painter] })
    }

    /// What there is to see.
    pub fn show(&self) -> &Arc<Show> {
        &self.show
    }

    /// Where to tell what happens.
    pub fn events(&self) -> &Sender<Event> {
        &self.events
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        // Threads that are gone need not be told, and one that panicked has said so
        _ = self.events.send(Event::Quit);
        self.threads.drain(..).for_each(|thread| _ = thread.join());
    }
}
