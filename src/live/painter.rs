//! The thread that renders: the picture of the newest generation, until it has enough samples.

use super::{Generation, Shot, Show};
use crate::Result;
use crate::gpu::DeviceType;
use crate::render::{Accumulation, Progress, Renderer};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvError, TryRecvError};
use std::time::{Duration, Instant};

/// What the painter is told.
pub(super) enum Order {
    /// Render this from now on; the edit that it came from.
    Paint(Arc<Generation>, Option<Instant>),
    /// Leave the processor to others, until there is another order.
    Pause,
    /// Go on.
    Resume,
}

/// Least time between two shots.
const SHOT_PERIOD: Duration = Duration::from_millis(100);
/// Part of the time that may be spent on shots.
const SHOT_SHARE: u32 = 5;

/// Renders up to `spp` samples a pixel of what it is told, until there is nobody left who could tell.
pub(super) fn paint(orders: &Receiver<Order>, show: &Show, spp: u32) {
    let mut canvas: Option<Canvas> = None;
    let mut paused = false;
    loop {
        let busy = !paused && canvas.as_ref().is_some_and(|canvas| !canvas.done);
        let order = match orders.try_recv() {
            Err(TryRecvError::Empty) if !busy => orders.recv().map(Some),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(RecvError),
            Ok(order) => Ok(Some(order)),
        };
        let outcome = match order {
            Err(RecvError) => return,
            Ok(Some(Order::Pause)) => {
                paused = canvas.as_ref().is_some_and(|canvas| canvas.on_cpu);
                Ok(())
            }
            Ok(Some(Order::Resume)) => {
                paused = false;
                Ok(())
            }
            Ok(Some(Order::Paint(generation, edited))) => {
                paused = false;
                canvas = None;
                Canvas::new(generation, edited, spp).map(|new| canvas = Some(new))
            }
            Ok(None) => canvas.as_mut().map_or(Ok(()), |canvas| canvas.step(show)),
        };
        if let Err(error) = outcome {
            canvas = None;
            show.change(|state| state.error = Some(error));
        }
    }
}

/// A picture under way.
struct Canvas {
    generation: Arc<Generation>,
    picture: Accumulation<Arc<Renderer>>,
    edited: Option<Instant>,
    /// What the driver took to compile what it had left for the first dispatch.
    warm: Duration,
    begun: Instant,
    shown: Option<Instant>,
    /// What the last shot took.
    cost: Duration,
    done: bool,
    on_cpu: bool,
}

impl Canvas {
    fn new(generation: Arc<Generation>, edited: Option<Instant>, spp: u32) -> Result<Self> {
        let renderer = generation.renderer.clone();
        let on_cpu = renderer.device().kind == DeviceType::Cpu;
        let picture = Accumulation::soon(renderer, 0, spp)?;
        let warm = picture.warm()?;
        let (begun, cost) = (Instant::now(), Duration::ZERO);
        Ok(Self { generation, picture, edited, warm, begun, shown: None, cost, done: false, on_cpu })
    }

    /// One slice more, and a shot when it is time for one.
    fn step(&mut self, show: &Show) -> Result<()> {
        let progress = self.picture.step()?;
        self.done = progress.is_none();
        let period = SHOT_PERIOD.max(self.cost * SHOT_SHARE);
        match progress {
            Some(progress) if self.shown.is_none_or(|shown| shown.elapsed() >= period) => {
                self.shoot(&progress, show)
            }
            None => self.shoot_last(show),
            Some(_) => Ok(()),
        }
    }

    fn shoot_last(&mut self, show: &Show) -> Result<()> {
        let film = self.picture.film()?;
        let spp = film.samples_per_pixel();
        let samples = film.frame().window.area() * u64::from(spp);
        let nothing = Duration::ZERO;
        self.shoot(&Progress { spp, done: 1.0, samples, computed: samples, elapsed: nothing }, show)
    }

    fn shoot(&mut self, progress: &Progress, show: &Show) -> Result<()> {
        let start = Instant::now();
        let rate = progress.samples as f64 / self.begun.elapsed().as_secs_f64();
        let mut picture = self.picture.film()?.resolve();
        let first = self.shown.is_none();
        let old = show.state();
        if let Some(old) = &old.shot {
            picture.fill_gaps(&old.picture);
        }
        let shot = Arc::new(Shot {
            generation: self.generation.clone(),
            picture,
            serial: old.shot.as_ref().map_or(0, |shot| shot.serial) + 1,
            spp: progress.spp,
            rate,
            warm_seconds: self.warm.as_secs_f64(),
        });
        let latency = self.edited.map(|edited| edited.elapsed().as_secs_f64());
        show.change(|state| {
            if first {
                state.before = state.shot.take();
                state.latency = latency;
            }
            state.generation = Some(self.generation.clone());
            state.shot = Some(shot);
        });
        self.shown = Some(Instant::now());
        self.cost = start.elapsed();
        Ok(())
    }
}
