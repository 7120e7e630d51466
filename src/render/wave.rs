//! The buffers of a wave of paths, and the commands that send it through the kernels.

use super::Measured;
use super::kernels::Kernels;
use super::resident::Resident;
use crate::Result;
use crate::gpu::{Bindings, Buffer, Command, Gpu, Place, Ticket};
use crate::layout::{
    AOV_WORDS, COUNTER_PATH_GROUPS, COUNTER_SHADOW_GROUPS, COUNTER_WAITING_PATHS, COUNTER_WAITING_SHADOWS,
    COUNTERS, Frame, HIT_WORDS, PARKED_HEAD, PATH_WORDS, QUEUE_BINS, RAY_WORDS, SCHEDULE_WORDS, SHADOW_WORDS,
    WORD_BYTES, WORKGROUP,
};
use crate::prepare::Stage;
use std::sync::Arc;
use std::time::Instant;

/// Bytes of two queues, each of two halves of a part for every octant.
const QUEUE_BYTES: u64 = 4 * 4 * QUEUE_BINS as u64;

/// Rounds that are recorded at once. A path that is not done then goes round again.
const MOST_ROUNDS: u32 = 16;

/// Workgroups for a number of pieces of work, as `interleaved_group` in `stages/queue.glsl` takes them.
fn interleaved(frame: &Frame, pieces: u32) -> [u32; 2] {
    [pieces.div_ceil(frame.threads), frame.threads]
}

/// Bytes of the two traversals of a slot that may be parked: of its path's ray and of its shadow ray.
fn parked_bytes(scene: &Frame) -> u64 {
    2 * 4 * u64::from(PARKED_HEAD + scene.parked_stack)
}

/// The kernels that follow rays in a round.
#[derive(Clone, Copy)]
struct Rays {
    intersect: Stage,
    shadow: Stage,
}

/// For rays that end within one dispatch; others are put aside.
const SHORT: Rays = Rays { intersect: Stage::Intersect, shadow: Stage::Shadow };
/// For all rays: those that are too long for one dispatch are parked, at the cost of a quarter of the speed.
const LONG: Rays = Rays { intersect: Stage::IntersectLong, shadow: Stage::ShadowLong };

/// The state of one slice in flight.
pub(super) struct Wave {
    frame: Arc<Buffer>,
    counters: Arc<Buffer>,
    seen: Arc<Buffer>,
    bindings: Arc<Bindings>,
    slots: u32,
    rounds: u32,
    ticket: Option<Ticket>,
}

impl Wave {
    /// Makes the buffers of a wave of at most `slots` paths.
    pub(super) fn new(
        gpu: &Gpu,
        kernels: &Kernels,
        resident: &Resident,
        film: &Arc<Buffer>,
        scene: &Frame,
        slots: u32,
    ) -> Result<Self> {
        let n = u64::from(slots);
        let make = |name: &str, bytes: u64| gpu.buffer(name, bytes, Place::Device);
        let words = |name: &str, each: u32| make(name, n * u64::from(each) * WORD_BYTES);
        let frame = gpu.buffer("frame", size_of::<Frame>() as u64, Place::Upload)?;
        let counters = make("counters", 4 * u64::from(COUNTERS))?;
        let own = [
            ("rays", words("rays", RAY_WORDS)?),
            ("hits", words("hits", HIT_WORDS)?),
            ("paths", words("paths", PATH_WORDS)?),
            ("shadows", words("shadows", SHADOW_WORDS)?),
            ("aovs", words("aovs", AOV_WORDS)?),
            ("queue", make("queue", n * QUEUE_BYTES)?),
            ("parked", make("parked", n * parked_bytes(scene))?),
            ("schedule", make("schedule", 2 * u64::from(SCHEDULE_WORDS) * WORD_BYTES)?),
        ];
        let mut all: Vec<(&str, &Arc<Buffer>)> = own.iter().map(|(name, buffer)| (*name, buffer)).collect();
        all.extend(resident.buffers());
        all.extend([("frame", &frame), ("counters", &counters), ("film", film)]);
        let bindings = gpu.bindings(kernels.layout(), &all)?;
        // What waits is told by marks in these two: none at first.
        let fill = |i: usize| Command::Fill { buffer: &own[i].1, bytes: own[i].1.bytes(), value: 0 };
        gpu.run(&[fill(1), fill(3), Command::Barrier])?;
        let seen = gpu.buffer("counters (host)", 4 * u64::from(COUNTERS), Place::Readback)?;
        let rounds = scene.max_depth.saturating_add(2).min(MOST_ROUNDS);
        Ok(Self { frame, counters, seen, bindings, slots, rounds, ticket: None })
    }

    /// Dispatches every kernel of a usual round over nothing.
    pub(super) fn warm(&self, gpu: &Gpu, kernels: &Kernels) -> Result<()> {
        let stages =
            [Stage::Camera, SHORT.intersect, SHORT.shadow, Stage::Shade, Stage::Advance, Stage::Film];
        gpu.run(&stages.map(|stage| self.one(kernels, stage, [0, 1])))
    }

    /// Bytes of a slot in all buffers of a wave.
    pub(super) fn slot_bytes(scene: &Frame) -> u64 {
        let words = RAY_WORDS + HIT_WORDS + PATH_WORDS + SHADOW_WORDS + AOV_WORDS;
        u64::from(words) * WORD_BYTES + QUEUE_BYTES + parked_bytes(scene)
    }

    /// Starts a slice. The wave must be idle.
    pub(super) fn start(&mut self, gpu: &Gpu, kernels: &Kernels, frame: &Frame) -> Result<()> {
        debug_assert!(self.ticket.is_none() && frame.slot_count <= self.slots);
        self.frame.write(bytemuck::bytes_of(frame));
        let commands: Vec<_> =
            self.first(kernels, frame).into_iter().chain(self.rounds(kernels, frame, SHORT)).collect();
        self.ticket = Some(gpu.submit(&commands)?);
        Ok(())
    }

    /// Runs a slice command by command and adds what each stage took to `measured`.
    pub(super) fn measure(
        &mut self,
        gpu: &Gpu,
        kernels: &Kernels,
        frame: &Frame,
        measured: &mut Measured,
    ) -> Result<()> {
        self.frame.write(bytemuck::bytes_of(frame));
        let mut rays = (0, 0);
        let mut camera = true;
        for command in self.first(kernels, frame).into_iter().chain(self.rounds(kernels, frame, SHORT)) {
            let Some(stage) = kernels.stage_of(&command) else {
                gpu.run(&[command, Command::Barrier])?;
                continue;
            };
            let start = Instant::now();
            gpu.run(&[command, Command::Barrier])?;
            let seconds = start.elapsed().as_secs_f64();
            measured.seconds[stage as usize] += seconds;
            match stage {
                Stage::Advance => rays = self.waiting(gpu)?,
                Stage::Intersect => {
                    let part = if camera { &mut measured.camera } else { &mut measured.bounce };
                    part.add(rays.0, seconds);
                    camera = false;
                }
                Stage::Shadow => measured.shadow.add(rays.1, seconds),
                _ => {}
            }
        }
        self.again(gpu, kernels, frame)
    }

    /// Paths and shadow rays that wait for the next round.
    fn waiting(&self, gpu: &Gpu) -> Result<(u32, u32)> {
        let copy =
            Command::Copy { from: &self.counters, to: &self.seen, at: 0, bytes: 4 * u64::from(COUNTERS) };
        gpu.run(&[copy, Command::Barrier])?;
        self.seen_waiting()
    }

    /// The same, as the counters were when they were last copied.
    fn seen_waiting(&self) -> Result<(u32, u32)> {
        self.seen.read(4 * u64::from(COUNTERS), |c| {
            (c[COUNTER_WAITING_PATHS as usize], c[COUNTER_WAITING_SHADOWS as usize])
        })
    }

    /// Waits until the slice is in the film. Paths that were parked, or go on for longer than was recorded, go round
    /// again until none is left.
    pub(super) fn finish(&mut self, gpu: &Gpu, kernels: &Kernels, frame: &Frame) -> Result<()> {
        while let Some(ticket) = self.ticket.take() {
            ticket.wait()?;
            self.again(gpu, kernels, frame)?;
        }
        Ok(())
    }

    /// Sends what is left of a slice round again.
    fn again(&mut self, gpu: &Gpu, kernels: &Kernels, frame: &Frame) -> Result<()> {
        let (paths, shadows) = self.seen_waiting()?;
        if paths + shadows > 0 {
            self.ticket = Some(gpu.submit(&self.rounds(kernels, frame, LONG))?);
        }
        Ok(())
    }

    /// The first rays, and the queue of them.
    fn first<'a>(&'a self, kernels: &'a Kernels, frame: &Frame) -> Vec<Command<'a>> {
        vec![
            Command::Barrier,
            self.one(kernels, Stage::Camera, interleaved(frame, frame.slot_count / WORKGROUP)),
            Command::Barrier,
            self.one(kernels, Stage::Advance, [1, 1]),
        ]
    }

    fn one<'a>(&'a self, kernels: &'a Kernels, stage: Stage, groups: [u32; 2]) -> Command<'a> {
        Command::Dispatch { pipeline: kernels.pipeline(stage), bindings: &self.bindings, groups }
    }

    /// Rounds of all paths through the kernels, then the film, then the counters for the host.
    fn rounds<'a>(&'a self, kernels: &'a Kernels, frame: &Frame, rays: Rays) -> Vec<Command<'a>> {
        let over = |stage, counter: u32| Command::DispatchIndirect {
            pipeline: kernels.pipeline(stage),
            bindings: &self.bindings,
            sizes: &self.counters,
            offset: 4 * u64::from(counter),
        };
        let mut commands = vec![Command::Barrier];
        for _ in 0..self.rounds {
            commands.extend([
                over(rays.intersect, COUNTER_PATH_GROUPS),
                over(rays.shadow, COUNTER_SHADOW_GROUPS),
                Command::Barrier,
                over(Stage::Shade, COUNTER_PATH_GROUPS),
                Command::Barrier,
                self.one(kernels, Stage::Advance, [1, 1]),
                Command::Barrier,
            ]);
        }
        commands.extend([
            self.one(kernels, Stage::Film, interleaved(frame, frame.tile_count)),
            Command::Copy { from: &self.counters, to: &self.seen, at: 0, bytes: 4 * u64::from(COUNTERS) },
            Command::Barrier,
        ]);
        commands
    }
}
