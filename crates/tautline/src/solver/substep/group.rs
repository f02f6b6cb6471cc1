//! The pairs of one region of the lineup, with their rows.

use std::ops::Range;

use crate::parallel;
use crate::simd::{Instructions, Kernel, LANES, Lanes, Row, run};

use super::batch::{Active, Batch, Colouring, HeaderRows, Places, PointRows};
use super::bounce::{Bounce, LANDING_VISITS, MOST_VISITS};
use super::contact::{Pass, Softness, pass};
use super::crew::Crew;
use super::lineup::{Lineup, Region};
use super::pairs::{Pair, Pairs, fit, renew};
use super::prepare::{Poses, fill};
use super::rolling::Rolling;
use super::stack::Found;

/// From so many pairs on it pays to sort them side by side, …
const WORTHWHILE: usize = 4096;
/// … so many at a time.
const CHUNK: usize = 1024;

/// Pairs that are solved one batch after the other.
#[derive(Debug, Clone)]
pub(super) struct Group {
    /// The places whose velocities it reads and changes.
    pub(super) range: Range<usize>,
    /// Until they are put into batches.
    active: Vec<Active>,
    pub(super) batches: Vec<Batch>,
    pub(super) headers: Vec<HeaderRows>,
    pub(super) points: Vec<PointRows>,
    /// Of the batches with restitution.
    pub(super) bounces: Vec<Bounce>,
    /// Of the batches with rolling friction.
    rollings: Vec<Rolling>,
    /// Whether the last visit of the bounces changed anything.
    is_ringing: bool,
}

/// Where the contact of a pair is: its group, batch and lane.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lane {
    group: u32,
    batch: u32,
    lane: u32,
}

impl Lane {
    /// Of its batch.
    pub(super) fn lane(&self) -> usize {
        self.lane as usize
    }
}

/// All groups, in the order in which they are solved: stripes, every other border, the borders between, and what is
/// far apart. Within one of these phases no two groups share a place.
#[derive(Debug, Clone, Default)]
pub(super) struct Groups {
    groups: Vec<Group>,
    phases: Vec<Range<usize>>,
}

impl Group {
    fn new(region: Region, lineup: &Lineup) -> Self {
        Self {
            range: lineup.range(region),
            active: Vec::new(),
            batches: Vec::new(),
            headers: Vec::new(),
            points: Vec::new(),
            bounces: Vec::new(),
            rollings: Vec::new(),
            is_ringing: false,
        }
    }

    /// Blows do not last: their impulses are not those of the next step.
    pub(super) fn forget_blows(&mut self) {
        for bounce in &self.bounces {
            bounce.forget_blows(&mut self.points[self.batches[bounce.batch as usize].range()]);
        }
    }

    /// Whether it has no pairs.
    pub(super) fn is_empty(&self) -> bool {
        self.active.is_empty() && self.batches.is_empty()
    }

    /// Puts the pairs that were sorted in into batches, which stand for them from then on.
    /// Returns their bodies' places.
    fn batch(&mut self, ground: u32) -> Vec<Places> {
        let empty = self.range.len() as u32 - 1;
        let active = std::mem::take(&mut self.active);
        let places =
            Colouring::default().batch(&active, self.range.len(), [empty, ground], &mut self.batches);
        let points = self.batches.last().map_or(0, |batch| batch.first + batch.points);
        fit(&mut self.batches);
        renew(&mut self.headers, self.batches.len());
        renew(&mut self.points, points as usize);
        places
    }
}

/// A pair as its group sees it, if it has points and a body that is solved for.
#[inline(always)]
fn active(lineup: &Lineup, (index, pair): (usize, &Pair)) -> Option<(Region, Active)> {
    if pair.points == 0 {
        return None;
    }
    let place = |body: u32| lineup.place_of.get(body as usize).copied().unwrap_or(u32::MAX);
    let (place_a, place_b) = (place(pair.a), place(pair.b).min(lineup.ground()));
    let region = lineup.region(place_a, place_b)?;
    let start = lineup.range(region).start as u32;
    let local = |place: u32| lineup.velocity_place(region, place) - start;
    let active = Active {
        pair: index as u32,
        a: local(place_a),
        b: local(place_b),
        place_a,
        place_b,
        points: pair.points as u8,
        moves_a: (place_a as usize) < lineup.solved,
        moves_b: (place_b as usize) < lineup.solved,
        is_stacked: false,
    };
    Some((region, active))
}

impl Groups {
    pub(super) fn new(lineup: &Lineup) -> Self {
        let count = lineup.stripes.len() as u32;
        let stripes = (0..count).map(Region::Stripe);
        let even = (0..count.saturating_sub(1)).step_by(2).map(Region::Border);
        let odd = (1..count.saturating_sub(1).max(1)).step_by(2).map(Region::Border);
        let mut groups = Self::default();
        let phases: [Vec<Region>; 4] = [stripes.collect(), even.collect(), odd.collect(), vec![Region::Far]];
        for regions in phases {
            let start = groups.groups.len();
            groups.groups.extend(regions.into_iter().map(|region| Group::new(region, lineup)));
            groups.phases.push(start..groups.groups.len());
        }
        groups
    }

    /// All batches, in the order in which they are solved.
    pub(super) fn batches(&self) -> impl Iterator<Item = &Batch> {
        self.groups.iter().flat_map(|group| &group.batches)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Group> {
        self.groups.iter()
    }

    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Group> {
        self.groups.iter_mut()
    }

    /// Sorts the pairs that have points, and of which a body is solved for, into their groups.
    pub(super) fn sort_in(&mut self, pairs: &Pairs, lineup: &Lineup) {
        for group in &mut self.groups {
            group.active.clear();
            // As many as in the last step.
            group.active.reserve(group.batches.len() * LANES);
        }
        let numbered = pairs.pairs.iter().enumerate();
        if !parallel::is_worthwhile(pairs.pairs.len(), WORTHWHILE) {
            for (region, active) in numbered.filter_map(|pair| active(lineup, pair)) {
                self.group_of(region).active.push(active);
            }
            return;
        }
        let mut sorted = vec![Vec::new(); pairs.pairs.len().div_ceil(CHUNK)];
        let mut chunks: Vec<_> = (0..).step_by(CHUNK).zip(&mut sorted).collect();
        parallel::for_each(&mut chunks, true, |(start, sorted)| {
            sorted.reserve(CHUNK);
            sorted.extend(numbered.clone().skip(*start).take(CHUNK).filter_map(|pair| active(lineup, pair)));
        });
        for (region, active) in sorted.into_iter().flatten() {
            self.group_of(region).active.push(active);
        }
    }

    /// All pairs that were sorted in, group after group.
    pub(super) fn active(&self) -> impl Iterator<Item = &Active> + Clone {
        self.groups.iter().flat_map(|group| &group.active)
    }

    /// Notes of the pairs of stacks that they belong to one.
    pub(super) fn mark_stacks(&mut self, stacks: &[Found], pair_count: usize) {
        if stacks.is_empty() {
            return;
        }
        let mut is_stacked = vec![false; pair_count];
        stacks.iter().flat_map(|stack| &stack.pairs).for_each(|&pair| is_stacked[pair as usize] = true);
        for active in self.groups.iter_mut().flat_map(|group| &mut group.active) {
            active.is_stacked = is_stacked[active.pair as usize];
        }
    }

    fn group_of(&mut self, region: Region) -> &mut Group {
        let [even, odd, far] = [1, 2, 3].map(|phase| self.phases[phase].start);
        let index = match region {
            Region::Stripe(i) => i as usize,
            Region::Border(i) if i % 2 == 0 => even + i as usize / 2,
            Region::Border(i) => odd + i as usize / 2,
            Region::Far => far,
        };
        &mut self.groups[index]
    }

    /// Tells where pairs are, batch after batch, as their rows are in memory: those in these lanes of a batch (bits).
    pub(super) fn for_each_lane(&self, lanes_of: fn(&Batch) -> u32, mut visit: impl FnMut(u32, Lane)) {
        let in_use = (0..).zip(&self.groups).filter(|(_, group)| !group.is_empty());
        for (group, of_group) in in_use {
            for (batch, of_batch) in (0..).zip(&of_group.batches) {
                let lanes = lanes_of(of_batch);
                for lane in (0..LANES as u32).filter(|lane| lanes >> lane & 1 != 0) {
                    visit(of_batch.pairs[lane as usize], Lane { group, batch, lane });
                }
            }
        }
    }

    fn batch_of(&self, at: &Lane) -> (&Group, &Batch) {
        let group = &self.groups[at.group as usize];
        (group, &group.batches[at.batch as usize])
    }

    /// The rows of a contact, of which those of one lane are its own.
    pub(super) fn rows(&self, at: &Lane) -> (&HeaderRows, &[PointRows]) {
        let (group, batch) = self.batch_of(at);
        (&group.headers[at.batch as usize], &group.points[batch.range_of(at.lane())])
    }

    pub(super) fn rows_mut(&mut self, at: &Lane) -> (&mut HeaderRows, &mut [PointRows]) {
        let group = &mut self.groups[at.group as usize];
        let range = group.batches[at.batch as usize].range_of(at.lane());
        (&mut group.headers[at.batch as usize], &mut group.points[range])
    }

    /// Where the velocities of both bodies of a contact are.
    pub(super) fn places(&self, at: &Lane) -> [u32; 2] {
        let (group, batch) = self.batch_of(at);
        [batch.a[at.lane()], batch.b[at.lane()]].map(|place| place + group.range.start as u32)
    }

    /// Does `work` on every group with its range of `rows`, phase after phase, those of a phase side by side.
    pub(super) fn for_each(&mut self, rows: &mut [Row], work: impl Fn(&mut Group, &mut [Row]) + Send + Sync) {
        for phase in &self.phases {
            let groups = &mut self.groups[phase.clone()];
            if let [group] = groups {
                let range = group.range.clone();
                if !group.is_empty() {
                    work(group, &mut rows[range]);
                }
                continue;
            }
            let (mut rest, mut start) = (&mut rows[..], 0);
            let mut tasks: Vec<(&mut Group, &mut [Row])> = Vec::with_capacity(groups.len());
            for group in groups {
                let (_, tail) = rest.split_at_mut(group.range.start - start);
                let (own, tail) = tail.split_at_mut(group.range.len());
                (rest, start) = (tail, group.range.end);
                tasks.push((group, own));
            }
            parallel::for_each(&mut tasks, true, |(group, rows)| {
                if !group.is_empty() {
                    work(group, rows);
                }
            });
        }
    }

    /// Makes batches and rows of all groups, and sums up in `accumulated` what their multipliers do to each place.
    pub(super) fn prepare(
        &mut self,
        pairs: &Pairs,
        poses: &[Row],
        ground: u32,
        accumulated: &mut [Row],
        instructions: Instructions,
    ) {
        self.for_each(accumulated, |group, accumulated| {
            let places = &group.batch(ground);
            run(instructions, Prepare { group, pairs, places, poses: Poses(poses), accumulated });
        });
    }

    /// Whether any contact has restitution.
    pub(super) fn has_bounces(&self) -> bool {
        self.groups.iter().any(|group| !group.bounces.is_empty())
    }

    /// Before forces act: ends the blows of the last substep, and finds those of this one.
    pub(super) fn meet(&mut self, crew: &mut Crew, h: f32, instructions: Instructions) {
        if !self.has_bounces() {
            return;
        }
        let (velocities, kicks) = (&crew.velocities, &crew.kicks);
        self.for_each(&mut crew.accumulated, |group, accumulated| {
            let (velocities, kicks) = (&velocities[group.range.clone()], &kicks[group.range.clone()]);
            run(instructions, Meet { group, velocities, kicks, accumulated, h });
        });
    }

    /// After the biased pass: lets all points of bodies that meet in this substep do so together.
    pub(super) fn land(&mut self, softness: &Softness, velocities: &mut [Row], instructions: Instructions) {
        if self.has_bounces() {
            self.for_each(velocities, |group, velocities| {
                run(instructions, Land { softness, group, velocities });
            });
        }
    }

    /// After the relaxing pass: blows part the bodies that met.
    pub(super) fn part(&mut self, velocities: &mut [Row], instructions: Instructions) {
        if !self.has_bounces() {
            return;
        }
        for visit in 0..MOST_VISITS {
            self.for_each(velocities, |group, velocities| {
                group.is_ringing = run(instructions, Part { group, velocities, is_first: visit == 0 });
            });
            if !self.groups.iter().any(|group| group.is_ringing) {
                break;
            }
        }
    }

    /// After the relaxing pass: rolling friction.
    pub(super) fn resist_rolling(&mut self, velocities: &mut [Row], instructions: Instructions) {
        if self.groups.iter().all(|group| group.rollings.is_empty()) {
            return;
        }
        self.for_each(velocities, |group, velocities| run(instructions, Resist { group, velocities }));
    }

    /// Visits all contacts once.
    pub(super) fn pass(
        &mut self,
        kind: Pass,
        softness: &Softness,
        velocities: &mut [Row],
        instructions: Instructions,
    ) {
        self.for_each(velocities, |group, velocities| {
            run(instructions, Visit { kind, softness, group, velocities });
        });
    }
}

struct Prepare<'a> {
    group: &'a mut Group,
    pairs: &'a Pairs,
    /// Of each batch.
    places: &'a [Places],
    poses: Poses<'a>,
    accumulated: &'a mut [Row],
}

impl Kernel for Prepare<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Group { batches, headers, points, bounces, rollings, .. } = self.group;
        let contact_of = |pair: u32| self.pairs.details[pair as usize].held.as_ref();
        bounces.clear();
        rollings.clear();
        let with_places = batches.iter().zip(self.places).zip(headers);
        for (number, ((batch, places), header)) in (0..).zip(with_places) {
            let rows = &mut points[batch.range()];
            let frames = [self.poses.gather::<L>(&places.a), self.poses.gather::<L>(&places.b)];
            let rare = fill::<L>(batch, contact_of, &frames, (header, rows), self.accumulated);
            let zero = L::splat(0.0);
            if L::load(&rare.restitution).greater(zero).bits() != 0 {
                bounces.push(Bounce::new(number, rare.restitution));
            }
            if L::load(&rare.rolling_friction).greater(zero).bits() != 0 {
                let rolling = Rolling::new::<L>(number, rare.rolling_friction, header, &frames);
                rollings.push(rolling);
            }
        }
    }
}

struct Meet<'a> {
    group: &'a mut Group,
    velocities: &'a [Row],
    kicks: &'a [Row],
    accumulated: &'a mut [Row],
    h: f32,
}

impl Kernel for Meet<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Group { batches, headers, points, bounces, .. } = self.group;
        for bounce in bounces {
            let number = bounce.batch as usize;
            let contacts = (&batches[number], &headers[number], &mut points[batches[number].range()]);
            bounce.meet::<L>(contacts, (self.velocities, self.kicks), self.accumulated, self.h);
        }
    }
}

struct Land<'a> {
    softness: &'a Softness,
    group: &'a mut Group,
    velocities: &'a mut [Row],
}

impl Kernel for Land<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Group { batches, headers, points, bounces, .. } = self.group;
        for bounce in bounces.iter().filter(|bounce| bounce.is_landing()) {
            let own = bounce.batch as usize..bounce.batch as usize + 1;
            for _ in 0..LANDING_VISITS {
                let (batch, header) = (&batches[own.clone()], &headers[own.clone()]);
                pass::<L>(Pass::Biased, self.softness, batch, header, points, self.velocities);
            }
        }
    }
}

struct Part<'a> {
    group: &'a mut Group,
    velocities: &'a mut [Row],
    is_first: bool,
}

impl Kernel for Part<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<L: Lanes>(self) -> bool {
        let Group { batches, headers, points, bounces, .. } = self.group;
        let mut is_ringing = false;
        for bounce in bounces {
            let number = bounce.batch as usize;
            let (batch, header) = (&batches[number], &headers[number]);
            if self.is_first {
                bounce.wake::<L>((batch, header, &mut points[batch.range()]), self.velocities);
            }
            is_ringing |= bounce.part::<L>((batch, header, &mut points[batch.range()]), self.velocities);
        }
        is_ringing
    }
}

struct Resist<'a> {
    group: &'a mut Group,
    velocities: &'a mut [Row],
}

impl Kernel for Resist<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Group { batches, points, rollings, .. } = self.group;
        for rolling in rollings {
            let batch = &batches[rolling.batch as usize];
            rolling.resist::<L>((batch, &points[batch.range()]), self.velocities);
        }
    }
}

struct Visit<'a> {
    kind: Pass,
    softness: &'a Softness,
    group: &'a mut Group,
    velocities: &'a mut [Row],
}

impl Kernel for Visit<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Group { batches, headers, points, .. } = self.group;
        // The kind is a constant in each of the two copies.
        match self.kind {
            Pass::Biased => pass::<L>(Pass::Biased, self.softness, batches, headers, points, self.velocities),
            Pass::Relaxing => {
                pass::<L>(Pass::Relaxing, self.softness, batches, headers, points, self.velocities)
            }
        }
    }
}
