//! The buffers of a wave of paths, and the commands that send it through the kernels.

use super::kernels::Kernels;
use super::resident::Resident;
use crate::Result;
use crate::gpu::{Bindings, Buffer, Command, Gpu, Place, Ticket};
use crate::layout::Frame;
use crate::prepare::Stage;
use std::sync::Arc;

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
        let groups = frame.threads * (frame.slot_count / crate::layout::WORKGROUP).div_ceil(frame.threads);
        let camera = [
            Command::Barrier,
            Command::Dispatch { pipeline: kernels.pipeline(Stage::Camera), bindings: &self.bindings, groups },
            Command::Barrier,
            self.one(kernels, Stage::Advance, 1),
            Command::Barrier,
        ];
        let film_groups = frame.threads * frame.tile_count.div_ceil(frame.threads);
        let ticket =
            gpu.submit(&camera.into_iter().chain(self.rounds(kernels, film_groups)).collect::<Vec<_>>())?;
        self.ticket = Some(ticket);
        Ok(())
    }

    /// Waits until the slice is in the film. Paths that were parked, or go on for longer than was recorded, go round
    /// again until none is left.
    pub(super) fn finish(&mut self, gpu: &Gpu, kernels: &Kernels, frame: &Frame) -> Result<()> {
        while let Some(ticket) = self.ticket.take() {
            ticket.wait()?;
            let left = self.seen.read(COUNTER_BYTES, |c| {
                let turn = (c[0] & 1) as usize;
                c[1 + turn] + c[3 + turn]
            })?;
            if left > 0 {
                let film_groups = frame.threads * frame.tile_count.div_ceil(frame.threads);
                let mut commands = vec![Command::Barrier];
                commands.extend(self.rounds(kernels, film_groups));
                self.ticket = Some(gpu.submit(&commands)?);
            }
        }
        Ok(())
    }

    fn one<'a>(&'a self, kernels: &'a Kernels, stage: Stage, groups: u32) -> Command<'a> {
        Command::Dispatch { pipeline: kernels.pipeline(stage), bindings: &self.bindings, groups }
    }

    /// Rounds of all paths through the kernels, then the film, then the counters for the host.
    fn rounds<'a>(&'a self, kernels: &'a Kernels, film_groups: u32) -> Vec<Command<'a>> {
        let over = |stage, offset| Command::DispatchIndirect {
            pipeline: kernels.pipeline(stage),
            bindings: &self.bindings,
            sizes: &self.counters,
            offset,
        };
        let mut commands = Vec::new();
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
