//! Nothing goes through anything: when the substeps are over, the way that each fast body has come is looked at, and
//! where it led through another it ends at their first touch. (Where bodies are in haste, that is after every substep.)
//!
//! Contacts hold what meets in a step as far as they were foreseen when it began, and as far as one pass solves them.
//! At a hundred metres a second both can be wrong. So the core of a part, which is the part at four fifths of its
//! size, may not enter another part on the straight way from where the step began to where it ended; if it did,
//! both bodies stop where they first touched, with the velocities they have, and the next step finds them there.
//! What overlaps less than that is left to the contacts, and sliding, rolling and resting bodies never notice.
//!
//! What joints hold together stops together. Its parts overlap others more often, so that only their inner cores count,
//! and not against each other. On the way through a whole step it bends, and to stop in between pulls its joints apart:
//! then only the middle of a part counts.
//!
//! The time lost is part of one step, and momentum is not touched. Only what was stopped so at once, at a place where it
//! had its contacts all the time, also loses its approach: those contacts cannot hold it, or it would hang there.

use glam::Vec3;

use super::RigidSolver;
use super::block::Block;
use super::lineup::NOBODY;
use super::meet::Candidate;
use super::pairs::{Detail, Pair, Pairs};
use super::way::Way;
use crate::norm::Norm;
use crate::parallel;
use crate::simd::{Instructions, Kernel, LANES, Lanes, Vec3x8, run};

/// The sizes of cores, as shares of that of their part; those of what joints hold; and of that on the way of a whole step.
const CORES: &[f32] = &[0.8, 0.4, 0.0];
const HELD_CORES: &[f32] = &[0.4, 0.0];
const BENDING_CORES: &[f32] = &[0.0];
/// What moves less than this share of its inner radius in a step goes through nothing.
const FAST: f32 = 0.5;
/// Bodies that meet before this share of a way is over had their contact all the time.
const AT_ONCE: f64 = 0.1;
/// The angle that what was stopped so may turn by in a substep, in rad.
const MOST_TURN: f32 = 0.5;
/// From so many pairs on it pays to look at them side by side.
const WORTHWHILE: usize = 1024;
/// How often ways are looked at again after some were cut short; the last time what still meets does not move.
const ROUNDS: usize = 8;

/// Which of eight bodies are fast: a mask by lanes.
struct Fast<'a>(&'a Block);

impl Kernel for Fast<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<L: Lanes>(self) -> u32 {
        let constants = &self.0.constants;
        let mut turn = L::splat(0.0);
        for (now, before) in self.0.axes.iter().zip(&self.0.start_axes) {
            turn = turn + (Vec3x8::<L>::load(now) - Vec3x8::load(before)).length_squared();
        }
        // How far one of its points has moved at most: √(|Δc|² + r² Σ|Δeₖ|²/2).
        let reach = L::load(&constants.reach);
        let shift = Vec3x8::<L>::load(&self.0.shift).length_squared();
        let limit = L::load(&constants.inner_radius) * L::splat(FAST);
        (shift + reach * reach * L::splat(0.5) * turn).greater(limit * limit).bits()
    }
}

/// Two bodies that were stopped as soon as they moved: their contact did not hold them.
struct Blocked {
    places: [usize; 2],
    /// Unit, from the first to the second.
    normal: Vec3,
}

/// Of bodies that may meet others and of all that joints hold together with them: few of all, as a rule.
struct Ways {
    /// By place, the number of its way; `NOBODY` if it has none.
    numbers: Vec<u32>,
    /// With their places.
    ways: Vec<(usize, Way)>,
}

impl Ways {
    fn new(place_count: usize) -> Self {
        Self { numbers: vec![NOBODY; place_count], ways: Vec::new() }
    }

    fn get(&self, place: usize) -> Option<&Way> {
        self.ways.get(self.numbers[place] as usize).map(|(_, way)| way)
    }

    fn get_mut(&mut self, place: usize) -> Option<&mut Way> {
        self.ways.get_mut(self.numbers[place] as usize).map(|(_, way)| way)
    }

    /// Gives a place that has none a way.
    fn add(&mut self, place: usize, way: Way) {
        self.numbers[place] = self.ways.len() as u32;
        self.ways.push((place, way));
    }
}

impl RigidSolver {
    /// Ends the ways of fast bodies where they would lead through others.
    pub(super) fn sweep(&mut self, instructions: Instructions) {
        let blocks = self.crew.blocks[..self.lineup.solved / LANES].iter();
        let fast: Vec<u32> = blocks.map(|block| run(instructions, Fast(block))).collect();
        if fast.iter().all(|&lanes| lanes == 0) {
            return;
        }
        let candidates = self.candidates(&fast);
        let mut ways = Ways::new(self.lineup.places.len());
        for place in candidates.iter().flat_map(|candidate| candidate.places) {
            if ways.get(place).is_none() {
                for mate in self.mates(place) {
                    ways.add(mate, Way::of(&self.crew.blocks[mate / LANES], mate % LANES));
                }
            }
        }
        let blocked = self.cut_short(&candidates, &mut ways);
        for (place, way) in ways.ways.into_iter().filter(|(_, way)| way.is_cut) {
            let row = &mut self.crew.velocities[place];
            way.write(&mut self.crew.blocks[place / LANES], place % LANES, row);
        }
        blocked.into_iter().for_each(|blocked| self.stop(&blocked));
    }

    /// The places of what moves as one with the body in a place, itself included.
    fn mates(&self, place: usize) -> Vec<usize> {
        match self.assembly_of(place) {
            NOBODY => vec![place],
            assembly => self.joints.members(assembly).map(|place| place as usize).collect(),
        }
    }

    /// Cuts ways short until nothing meets on them. Returns who hardly moved for it.
    fn cut_short(&self, candidates: &[Candidate<'_>], ways: &mut Ways) -> Vec<Blocked> {
        let mut blocked = Vec::new();
        // Most do not meet, which can be told side by side as long as no way is cut; if not, that comes below.
        let meets = if parallel::is_worthwhile(candidates.len(), WORTHWHILE) {
            parallel::collect(candidates, true, |_, candidate| Some(would_meet(candidate, ways)))
        } else {
            vec![true; candidates.len()]
        };
        for round in 0..ROUNDS {
            let mut has_met = false;
            for (candidate, meets) in candidates.iter().zip(&meets) {
                let [place_a, place_b] = candidate.places;
                let [Some(mut a), Some(mut b)] = candidate.places.map(|place| ways.get(place).copied())
                else {
                    continue;
                };
                let is_known = (round > 0 || !meets) && !a.is_cut && !b.is_cut;
                if is_known || !(a.is_finite() && b.is_finite()) {
                    continue;
                }
                let Some(touch) = candidate.first_touch(&a, &b) else { continue };
                let mut time = touch.time;
                if round == 0 && time < AT_ONCE {
                    blocked.push(Blocked { places: candidate.places, normal: touch.at.normal.as_vec3() });
                    // What cannot turn may still go, and be pushed out; but not out of its joints.
                    let is_loose = |place: usize| self.assembly_of(place) == NOBODY;
                    a = if is_loose(place_a) { a.without_turn() } else { a };
                    b = if is_loose(place_b) { b.without_turn() } else { b };
                    time = candidate.first_touch(&a, &b).map_or(1.0, |touch| touch.time);
                }
                let time = if round + 1 == ROUNDS { 0.0 } else { time };
                let carried = [b.carries(&a, time), a.carries(&b, time)];
                for ((place, now), carried) in [(place_a, a), (place_b, b)].into_iter().zip(carried) {
                    if let Some(way) = ways.get_mut(place) {
                        *way = now;
                    }
                    for mate in self.mates(place) {
                        if let Some(way) = ways.get_mut(mate) {
                            *way = way.cut(time, carried);
                        }
                    }
                }
                has_met = true;
            }
            if !has_met {
                break;
            }
        }
        blocked
    }

    /// Takes the approach of two bodies to each other out of their velocities, as far as it is not rotation: a blow
    /// against their centres, without restitution. And slows their rotation to what a substep can follow.
    fn stop(&mut self, blocked: &Blocked) {
        let row = |place: usize| &self.crew.velocities[place].0;
        let [a, b] = blocked.places.map(row);
        let linear = |row: &[f32; LANES]| Vec3::new(row[0], row[1], row[2]);
        let approach = (linear(a) - linear(b)).dot(blocked.normal).max(0.0);
        let weights = [a[3], b[3]];
        for (i, sign) in [(0, -1.0), (1, 1.0)] {
            let place = blocked.places[i];
            let root = self.crew.blocks[place / LANES].constants.root_inertia.each_ref();
            let root = root.map(|row| row.0[place % LANES]);
            let row = &mut self.crew.velocities[place].0;
            if weights[i] <= 0.0 {
                continue;
            }
            let change = blocked.normal * (sign * approach * weights[i] / (weights[0] + weights[1]));
            row.iter_mut().zip(change.to_array()).for_each(|(number, change)| *number += change);
            let turn = Vec3::new(row[4] / root[0], row[5] / root[1], row[6] / root[2]).norm();
            let kept = (MOST_TURN / turn.max(MOST_TURN)).min(1.0);
            row[4..7].iter_mut().for_each(|number| *number *= kept);
        }
    }

    /// The pairs of parts of which one is of a fast body, as masks of lanes say, and that joints do not hold together.
    fn candidates(&self, fast: &[u32]) -> Vec<Candidate<'_>> {
        let is_fast = |place: u32| {
            fast.get(place as usize / LANES).is_some_and(|lanes| lanes >> (place as usize % LANES) & 1 == 1)
        };
        let candidate = |(pair, detail): (&Pair, &Detail)| {
            let place = |body: u32| self.lineup.place_of.get(body as usize).copied();
            let places = [place(pair.a)?, place(pair.b).filter(|&place| place != NOBODY)?];
            let moving = places.map(|place| self.lineup.moving_place(place));
            let [assembly_a, assembly_b] = moving.map(|place| self.assembly_of(place as usize));
            let is_one = assembly_a != NOBODY && assembly_a == assembly_b;
            if is_one || !moving.into_iter().any(is_fast) {
                return None;
            }
            let shape = |place: u32| self.crew.shapes[place as usize].as_deref();
            let shapes = [shape(places[0])?, shape(places[1])?];
            let is_held = assembly_a != NOBODY || assembly_b != NOBODY;
            let cores = match (is_held, self.is_hasty) {
                (false, _) => CORES,
                (true, true) => HELD_CORES,
                (true, false) => BENDING_CORES,
            };
            Candidate::new(moving.map(|place| place as usize), cores, shapes, [detail.part_a, detail.part_b])
        };
        let Pairs { pairs, details } = &self.pairs;
        let worthwhile = parallel::is_worthwhile(pairs.len(), WORTHWHILE);
        parallel::collect(pairs, worthwhile, |number, pair| candidate((pair, &details[number])))
    }
}

/// Whether two bodies would meet on their ways as they are.
fn would_meet(candidate: &Candidate<'_>, ways: &Ways) -> bool {
    match candidate.places.map(|place| ways.get(place)) {
        [Some(a), Some(b)] => a.is_finite() && b.is_finite() && candidate.first_touch(a, b).is_some(),
        _ => false,
    }
}
