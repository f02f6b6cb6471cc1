//! The bodies of a lineup: their blocks, and their rows for the solver.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::body::{Body, Motion as MotionKind, Rigid, Substance};
use crate::parallel;
use crate::particles::{FARTHEST, Particles};
use crate::shape::Shape;
use crate::simd::{Instructions, Kernel, LANES, Lanes, Row, run};

use super::block::{Block, Constants, ParticleRows, Rows3, column};
use super::lineup::Lineup;
use super::read::Read;
use super::rigidity;

/// The step that is being made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Timing {
    /// A substep, in s.
    pub(super) h: f32,
    pub(super) substeps: f32,
    /// In m/s².
    pub(super) gravity: Vec3,
    /// In 1/s, for all bodies.
    pub(super) damping: f32,
    /// How far apart contacts are kept at least, in m.
    pub(super) margin: f32,
    pub(super) instructions: Instructions,
}

/// Where eight bodies were at some earlier time.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Earlier {
    pub(super) center: Rows3,
    /// The first two axes, which the third one follows from.
    pub(super) axes: [Rows3; 2],
}

/// What is remembered of a block from step to step.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Track {
    /// When contacts were last looked for.
    pub(super) seen: Earlier,
    /// When their boxes were made.
    pub(super) boxed: Earlier,
    /// How far bodies may get from there, in m.
    pub(super) room: Row,
    /// How much of the room this step may need, in m.
    pub(super) need: Row,
    /// Bits of the lanes that have moved since contacts were looked for.
    pub(super) moved: u32,
    /// Bits of the lanes that may leave their boxes in this step.
    pub(super) leaves: u32,
    /// Bits of the lanes in haste, for how far they go and how far they turn: see `RigidSolver::note_haste`.
    #[serde(skip)]
    pub(super) rushing: u32,
    #[serde(skip)]
    pub(super) turning: u32,
    /// Bits of the lanes that turn fast enough for an exact flight, see `flight`.
    #[serde(skip)]
    pub(super) spinning: u32,
}

/// Among so many blocks that differ one of the same bodies is looked for.
const LAST_KNOWN: usize = 8;

/// Everything by place.
#[derive(Debug, Clone, Default)]
pub(super) struct Crew {
    pub(super) blocks: Vec<Block>,
    pub(super) tracks: Vec<Track>,
    /// Where there is a body.
    pub(super) shapes: Vec<Option<Arc<Shape>>>,
    /// Of all solid ones, in m.
    least_inner_radius: f32,
    /// Two rows for each place, see `prepare::Poses`. When contacts are prepared, nobody needs them any more until the next
    /// step: from then on the first eight of a block's sixteen are the velocities of its places when `accumulated` was last
    /// brought up to date.
    pub(super) poses: Vec<Row>,
    /// One for each place, see `block`.
    pub(super) velocities: Vec<Row>,
    /// What the contacts' multipliers add to each velocity in a substep.
    pub(super) accumulated: Vec<Row>,
    /// What forces add to each velocity in a substep. Empty while gravity is the only one and nothing bounces.
    pub(super) kicks: Vec<Row>,
}

/// A run of blocks with all that belongs to them.
pub(super) struct Squad<'a> {
    pub(super) places: &'a [u32],
    pub(super) blocks: &'a mut [Block],
    pub(super) tracks: &'a mut [Track],
    pub(super) poses: &'a mut [Row],
    pub(super) velocities: &'a mut [Row],
    pub(super) accumulated: &'a mut [Row],
    pub(super) kicks: &'a mut [Row],
}

impl Crew {
    /// The bodies where they stand; nothing is read of where they are yet.
    pub(super) fn new(lineup: &Lineup, bodies: &[Body]) -> Self {
        let count = lineup.places.len();
        let mut constants: Vec<Arc<Constants>> = Vec::new();
        let block = |places: &[u32]| {
            let constants = shared(new_constants(places, bodies), &mut constants);
            Block { constants, ..Block::default() }
        };
        let shape = |&place: &u32| rigid_at(place, bodies).map(|(_, rigid)| Arc::clone(&rigid.shape));
        let shapes: Vec<_> = lineup.places.iter().map(shape).collect();
        let solid = shapes.iter().flatten().filter(|shape| shape.is_solid());
        Self {
            blocks: lineup.places.chunks(LANES).map(block).collect(),
            tracks: vec![Track::default(); count / LANES],
            least_inner_radius: solid.map(|shape| shape.inner_radius()).fold(f32::INFINITY, f32::min),
            shapes,
            poses: vec![Row::ZERO; 2 * count],
            velocities: vec![Row::ZERO; count],
            accumulated: vec![Row::ZERO; count],
            kicks: Vec::new(),
        }
    }

    /// Does `work` on every one of these runs of places, which follow each other, side by side.
    pub(super) fn for_each(
        &mut self,
        lineup: &Lineup,
        runs: impl Iterator<Item = Range<usize>>,
        work: impl Fn(&mut Squad<'_>) + Send + Sync,
    ) {
        let (mut blocks, mut tracks) = (&mut self.blocks[..], &mut self.tracks[..]);
        let (mut poses, mut velocities) = (&mut self.poses[..], &mut self.velocities[..]);
        let (mut accumulated, mut kicks) = (&mut self.accumulated[..], &mut self.kicks[..]);
        let (has_kicks, mut done) = (!kicks.is_empty(), 0);
        let squad = |run: Range<usize>| {
            let (skip, places) = (run.start - done, run.len());
            done = run.end;
            Squad {
                places: &lineup.places[run],
                blocks: take(&mut blocks, skip / LANES, places / LANES),
                tracks: take(&mut tracks, skip / LANES, places / LANES),
                poses: take(&mut poses, 2 * skip, 2 * places),
                velocities: take(&mut velocities, skip, places),
                accumulated: take(&mut accumulated, skip, places),
                kicks: if has_kicks { take(&mut kicks, skip, places) } else { &mut [] },
            }
        };
        let mut squads: Vec<Squad<'_>> = runs.map(squad).collect();
        // A single stripe is done before a thread would be awake.
        let worthwhile = lineup.stripes.len() > 1;
        parallel::for_each(&mut squads, worthwhile, work);
    }

    /// Reads where bodies are and how they move, and what pushes them. Bodies that never move are read once.
    pub(super) fn read(
        &mut self,
        lineup: &Lineup,
        (bodies, particles): (&[Body], &Particles),
        timing: &Timing,
        is_first: bool,
    ) {
        let end = if is_first { lineup.places.len() } else { lineup.moving() };
        let tail = lineup.solved..end;
        self.kicks.clear();
        if particles.is_forced() {
            self.kicks.resize(lineup.places.len(), Row::ZERO);
        }
        self.for_each(lineup, lineup.stripes().chain([tail]), |squad| {
            run(timing.instructions, Read { squad, bodies, particles, timing });
        });
    }

    /// Raises the versions of bodies that have moved, and tells how many may leave their boxes in this step.
    pub(super) fn count_versions(&mut self, lineup: &Lineup, versions: &mut [u32]) -> usize {
        let mut leaves = 0;
        for (track, places) in self.tracks.iter_mut().zip(lineup.places.chunks(LANES)) {
            leaves += track.leaves.count_ones() as usize;
            let mut moved = std::mem::take(&mut track.moved);
            while moved != 0 {
                let body = places[moved.trailing_zeros() as usize];
                moved &= moved - 1;
                if let Some(version) = versions.get_mut(body as usize) {
                    *version = version.wrapping_add(1);
                }
            }
        }
        leaves
    }

    /// The bodies, with their places, that may leave their boxes; they are noted no longer.
    pub(super) fn take_leavers(&mut self, lineup: &Lineup) -> Vec<(u32, u32)> {
        let mut leavers = Vec::new();
        for (track, first) in self.tracks.iter_mut().zip((0..).step_by(LANES)) {
            let mut leaves = std::mem::take(&mut track.leaves);
            while leaves != 0 {
                let place = first + leaves.trailing_zeros();
                leaves &= leaves - 1;
                let body = lineup.places[place as usize];
                if lineup.is_place_of(place, body) {
                    leavers.push((body, place));
                }
            }
        }
        leavers
    }

    /// Whether any two bodies may approach each other in a whole step by more than the inner radius of any.
    pub(super) fn has_fast(&self, substeps: f32) -> bool {
        let way_squared = |row: &Row| Vec3::new(row.0[0], row.0[1], row.0[2]).length_squared();
        let longest = self.velocities.iter().map(way_squared).fold(0.0, f32::max).sqrt() * substeps;
        2.0 * longest > self.least_inner_radius
    }

    /// How the centre of what is in a place moves in a whole step, and how far its turning moves its points, in m.
    pub(super) fn motion(&self, place: usize, substeps: f32) -> (Vec3, f32) {
        let (velocity, pose) = (&self.velocities[place].0, &self.poses[2 * place + 1].0);
        (Vec3::new(velocity[0], velocity[1], velocity[2]) * substeps, pose[6])
    }

    /// Gives a body a velocity whose change is not to be given to it again in the next substep.
    pub(super) fn set_velocity(&mut self, place: usize, row: Row) {
        let velocity = &mut self.velocities[place];
        let before = &mut self.poses[place_of_before(place)];
        for ((old, before), new) in velocity.0.iter_mut().zip(&mut before.0).zip(row.0) {
            *before = if *before == *old { new } else { *before + (new - *old) };
            *old = new;
        }
    }

    /// Adds to a velocity what counts as no contact's doing.
    pub(super) fn push(&mut self, place: usize, added: [f32; LANES]) {
        // Also to what contacts are told from, or it would be done again in every substep.
        for row in [&mut self.velocities[place], &mut self.poses[place_of_before(place)]] {
            row.0.iter_mut().zip(added).for_each(|(number, added)| *number += added);
        }
    }

    /// Moves all bodies by a substep.
    pub(super) fn advance(&mut self, lineup: &Lineup, timing: &Timing) {
        self.for_each(lineup, lineup.stripes(), |squad| run(timing.instructions, Advance { squad, timing }));
    }

    /// Takes out the energy that bodies got from having moved: see `rigidity::calmed`.
    pub(super) fn calm(&mut self, lineup: &Lineup, instructions: Instructions) {
        self.for_each(lineup, lineup.stripes(), |squad| run(instructions, Calm { squad }));
    }

    /// The particles of eight bodies as they are now.
    pub(super) fn particles_of(&self, block: usize, instructions: Instructions) -> Written {
        let rows = &self.velocities[block * LANES..(block + 1) * LANES];
        run(instructions, Write { block: &self.blocks[block], rows })
    }

    /// What a place remembers, to be carried over to another lineup.
    pub(super) fn memory(&self, place: usize) -> TrackMemory {
        let (track, lane) = (&self.tracks[place / LANES], place % LANES);
        let axes = track.seen.axes.each_ref().map(|rows| column(rows, lane));
        TrackMemory { center: column(&track.seen.center, lane), axes }
    }

    pub(super) fn recall(&mut self, place: usize, memory: &TrackMemory) {
        let (track, lane) = (&mut self.tracks[place / LANES], place % LANES);
        set_lane(&mut track.seen.center, lane, memory.center);
        for (rows, axis) in track.seen.axes.iter_mut().zip(memory.axes) {
            set_lane(rows, lane, axis);
        }
    }
}

/// Where one body was when contacts were last looked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrackMemory {
    center: Vec3,
    axes: [Vec3; 2],
}

/// Which of the poses' rows has the velocity that a place had before.
fn place_of_before(place: usize) -> usize {
    place + place / LANES * LANES
}

/// `count` items of a slice after `skip`; the slice then begins behind them.
fn take<'a, T>(slice: &mut &'a mut [T], skip: usize, count: usize) -> &'a mut [T] {
    let (_, tail) = std::mem::take(slice).split_at_mut(skip);
    let (head, tail) = tail.split_at_mut(count);
    *slice = tail;
    head
}

pub(super) fn set_lane(rows: &mut Rows3, lane: usize, value: Vec3) {
    for (row, number) in rows.iter_mut().zip(value.to_array()) {
        row.0[lane] = number;
    }
}

fn rigid_at(place: u32, bodies: &[Body]) -> Option<(&Body, &Rigid)> {
    let body = bodies.get(place as usize)?;
    match &body.substance {
        Substance::Rigid(rigid) => Some((body, rigid)),
        _ => None,
    }
}

fn new_constants(places: &[u32], bodies: &[Body]) -> Constants {
    let one = Row([1.0; LANES]);
    let mut constants = Constants {
        spread: [one; 3],
        inertia: [one; 3],
        root_inertia: [one; 3],
        inverse_root_inertia: [one; 3],
        ..Constants::default()
    };
    for (lane, &body) in places.iter().enumerate() {
        let Some((body, rigid)) = rigid_at(body, bodies) else { continue };
        set_lane(&mut constants.spread, lane, rigid.spread());
        let inertia = rigid.inertia_per_mass();
        set_lane(&mut constants.inertia, lane, inertia);
        constants.reach.0[lane] = rigid.shape.reach();
        constants.inner_radius.0[lane] = rigid.shape.inner_radius();
        if rigid.traits.motion == MotionKind::Dynamic && body.is_awake() {
            let moments = inertia * rigid.mass;
            let root = Vec3::new(moments.x.sqrt(), moments.y.sqrt(), moments.z.sqrt());
            set_lane(&mut constants.root_inertia, lane, root);
            set_lane(&mut constants.inverse_root_inertia, lane, Vec3::ONE / root);
            constants.inverse_mass.0[lane] = 1.0 / rigid.mass;
            constants.response.0[lane] = 1.0;
            constants.gravity_scale.0[lane] = rigid.traits.gravity_scale;
            constants.damping[0].0[lane] = rigid.traits.linear_damping;
            constants.damping[1].0[lane] = rigid.traits.angular_damping;
        }
    }
    constants
}

/// The same constants out of those known last, or else these, which are then known.
fn shared(constants: Constants, known: &mut Vec<Arc<Constants>>) -> Arc<Constants> {
    if let Some(same) = known.iter().rev().take(LAST_KNOWN).find(|other| ***other == constants) {
        return Arc::clone(same);
    }
    known.push(Arc::new(constants));
    Arc::clone(&known[known.len() - 1])
}

#[inline(always)]
pub(super) fn store<L: Lanes>(columns: [L; LANES], rows: &mut [Row]) {
    let lanes = L::transpose(columns);
    for (lane, row) in rows.iter_mut().enumerate() {
        lanes[lane].store(row);
    }
}

#[inline(always)]
fn load<L: Lanes>(rows: &[Row]) -> [L; LANES] {
    let zero = L::splat(0.0);
    let mut lanes = [zero; LANES];
    for (lanes, row) in lanes.iter_mut().zip(rows) {
        *lanes = L::load(row);
    }
    L::transpose(lanes)
}

struct Advance<'a, 'b> {
    squad: &'a mut Squad<'b>,
    timing: &'a Timing,
}

impl Kernel for Advance<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Squad { blocks, poses, velocities, accumulated, .. } = self.squad;
        let chunks = velocities.chunks_exact_mut(LANES).zip(accumulated.chunks_exact_mut(LANES));
        for ((block, (velocities, accumulated)), poses) in
            blocks.iter_mut().zip(chunks).zip(poses.chunks_exact_mut(2 * LANES))
        {
            let before = &mut poses[..LANES];
            for ((velocity, accumulated), before) in velocities.iter().zip(accumulated).zip(&*before) {
                let change = L::load(velocity) - L::load(before);
                (L::load(accumulated) + change).store(accumulated);
            }
            let columns =
                rigidity::advance::<L>(block, &load(velocities), self.timing.h, self.timing.damping);
            store(columns, velocities);
            before.copy_from_slice(velocities);
        }
    }
}

struct Calm<'a, 'b> {
    squad: &'a mut Squad<'b>,
}

impl Kernel for Calm<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Squad { blocks, velocities, .. } = self.squad;
        for (block, velocities) in blocks.iter().zip(velocities.chunks_exact_mut(LANES)) {
            store(rigidity::calmed::<L>(block, load(velocities)), velocities);
        }
    }
}

/// The particles of eight bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Written {
    pub(super) positions: ParticleRows,
    pub(super) displacements: ParticleRows,
    /// Bits of the lanes in which all numbers are within reach.
    pub(super) within_reach: u32,
}

impl Written {
    pub(super) const NOTHING: Self =
        Self { positions: [Row::ZERO; 12], displacements: [Row::ZERO; 12], within_reach: 0 };
}

struct Write<'a> {
    block: &'a Block,
    rows: &'a [Row],
}

impl Kernel for Write<'_> {
    type Output = Written;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Written {
        let mut written = Written::NOTHING;
        let Written { positions, displacements, within_reach } = &mut written;
        self.block.write::<L>(&load(self.rows), positions, displacements);
        let farthest = L::splat(FARTHEST);
        let mut is_within = farthest.greater(L::splat(0.0));
        for row in positions.iter().chain(displacements.iter()) {
            let number = L::load(row);
            is_within = is_within.and(farthest.greater(number.max(-number)));
        }
        *within_reach = is_within.bits();
        written
    }
}
