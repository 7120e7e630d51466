//! The buffers of a wave of paths, and the commands that send it through the kernels.

use super::Measured;
use super::kernels::Kernels;
use super::resident::Resident;
use crate::Result;
use crate::gpu::{Bindings, Buffer, Command, Gpu, Place, Ticket};
use crate::layout::{Frame, WORKGROUP};
use crate::prepare::Stage;
use std::sync::Arc;
use std::time::Instant;

/// Bytes of a slot in each buffer of a wave; those of `stages/wave.glsl`.
const RAY_BYTES: u64 = 32;
const HIT_BYTES: u64 = 16;
const PATH_BYTES: u64 = 48;
const SHADOW_BYTES: u64 = 48;
const AOV_BYTES: u64 = 32;
/// Two halves of two queues.
const QUEUE_BYTES: u64 = 16;
/// Two traversals: of the path's ray and of its shadow ray.
const PARKED_HEAD: u64 = 6;

const COUNTER_BYTES: u64 = 64;
const PATH_GROUPS_OFFSET: u64 = 4 * 8;
const SHADOW_GROUPS_OFFSET: u64 = 4 * 12;

/// Rounds that are recorded at once. A path that is not done then goes round again.
const MOST_ROUNDS: u32 = 16;

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
        let parked = 8 * (PARKED_HEAD + u64::from(scene.parked_stack));
        let frame = gpu.buffer("frame", size_of::<Frame>() as u64, Place::Upload)?;
        let counters = make("counters", COUNTER_BYTES)?;
        let own = [
            ("rays", make("rays", n * RAY_BYTES)?),
            ("hits", make("hits", n * HIT_BYTES)?),
            ("paths", make("paths", n * PATH_BYTES)?),
            ("shadows", make("shadows", n * SHADOW_BYTES)?),
            ("aovs", make("aovs", n * AOV_BYTES)?),
            ("queue", make("queue", n * QUEUE_BYTES)?),
            ("parked", make("parked", n * parked)?),
        ];
        let mut all: Vec<(&str, &Arc<Buffer>)> = own.iter().map(|(name, buffer)| (*name, buffer)).collect();
        all.extend(resident.buffers());
        all.extend([("frame", &frame), ("counters", &counters), ("film", film)]);
        let bindings = gpu.bindings(kernels.layout(), &all)?;
        // What waits is told by marks in these two: none at first.
        let fill = |i: usize| Command::Fill { buffer: &own[i].1, bytes: own[i].1.bytes(), value: 0 };
        gpu.run(&[fill(1), fill(3), Command::Barrier])?;
        let seen = gpu.buffer("counters (host)", COUNTER_BYTES, Place::Readback)?;
        let rounds = scene.max_depth.saturating_add(2).min(MOST_ROUNDS);
        Ok(Self { frame, counters, seen, bindings, slots, rounds, ticket: None })
    }

    /// Bytes of a slot in all buffers of a wave.
    pub(super) fn slot_bytes(scene: &Frame) -> u64 {
        let parked = 8 * (PARKED_HEAD + u64::from(scene.parked_stack));
        RAY_BYTES + HIT_BYTES + PATH_BYTES + SHADOW_BYTES + AOV_BYTES + QUEUE_BYTES + parked
    }

    /// Starts a slice. The wave must be idle.
    pub(super) fn start(&mut self, gpu: &Gpu, kernels: &Kernels, frame: &Frame) -> Result<()> {
        debug_assert!(self.ticket.is_none() && frame.slot_count <= self.slots);
        self.frame.write(bytemuck::bytes_of(frame));
        let commands: Vec<_> =
            self.first(kernels, frame).into_iter().chain(self.rounds(kernels, frame)).collect();
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
        for command in self.first(kernels, frame).into_iter().chain(self.rounds(kernels, frame)) {
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
        let copy = Command::Copy { from: &self.counters, to: &self.seen, bytes: COUNTER_BYTES };
        gpu.run(&[copy, Command::Barrier])?;
        self.seen_waiting()
    }

    /// The same, as the counters were when they were last copied.
    fn seen_waiting(&self) -> Result<(u32, u32)> {
        self.seen.read(COUNTER_BYTES, |c| {
            let turn = (c[0] & 1) as usize;
            (c[1 + turn], c[3 + turn])
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
            self.ticket = Some(gpu.submit(&self.rounds(kernels, frame))?);
        }
        Ok(())
    }

    /// The first rays, and the queue of them.
    fn first<'a>(&'a self, kernels: &'a Kernels, frame: &Frame) -> Vec<Command<'a>> {
        let groups = frame.threads * (frame.slot_count / WORKGROUP).div_ceil(frame.threads);
        vec![
            Command::Barrier,
            self.one(kernels, Stage::Camera, groups),
            Command::Barrier,
            self.one(kernels, Stage::Advance, 1),
        ]
    }

    fn one<'a>(&'a self, kernels: &'a Kernels, stage: Stage, groups: u32) -> Command<'a> {
        Command::Dispatch { pipeline: kernels.pipeline(stage), bindings: &self.bindings, groups }
    }

    /// Rounds of all paths through the kernels, then the film, then the counters for the host.
    fn rounds<'a>(&'a self, kernels: &'a Kernels, frame: &Frame) -> Vec<Command<'a>> {
        let film_groups = frame.threads * frame.tile_count.div_ceil(frame.threads);
        let over = |stage, offset| Command::DispatchIndirect {
            pipeline: kernels.pipeline(stage),
            bindings: &self.bindings,
            sizes: &self.counters,
            offset,
        };
        let mut commands = vec![Command::Barrier];
        for _ in 0..self.rounds {
            commands.extend([
                over(Stage::Intersect, PATH_GROUPS_OFFSET),
                over(Stage::Shadow, SHADOW_GROUPS_OFFSET),
                Command::Barrier,
                over(Stage::Shade, PATH_GROUPS_OFFSET),
                Command::Barrier,
                self.one(kernels, Stage::Advance, 1),
                Command::Barrier,
            ]);
        }
        commands.extend([
            self.one(kernels, Stage::Film, film_groups),
            Command::Copy { from: &self.counters, to: &self.seen, bytes: COUNTER_BYTES },
            Command::Barrier,
        ]);
        commands
    }
}
