//! Which bodies are a stack.
//!
//! Bodies that touch one another without a joint, on something that bears them, slowly enough to be about to rest, and
//! such that loads are hard to pass on: over at least four bodies from below, or from a body to one that is four times
//! lighter; or few bodies that are about to slide or to topple, or that nothing bore yet. Only up to a few dozen, for an
//! exact solution costs more than passes: larger heaps have soft contacts.

use glam::Vec3;

use super::super::batch::Active;
use super::super::crew::{Crew, Timing};
use super::super::group::Groups;
use super::super::held::Held;
use super::super::joint::Sets;
use super::super::lineup::{Lineup, NOBODY};
use super::super::pairs::Pairs;
use crate::norm::Norm;
use crate::order::PutInOrder;

/// The most bodies of a stack, and pairs of parts.
const MOST_BODIES: usize = 64;
const MOST_PAIRS: usize = 96;
/// The most bodies in all stacks of a world; those with the lowest places go first.
const MOST_IN_ALL: usize = 512;
/// From so many bodies over each other, or so many times the mass of the lightest, it is hard to pass on loads.
const TALL: u32 = 4;
const HEAVY: f32 = 4.0;
/// How fast surfaces of a stack come nearer to each other or part at most, in m/s: what sways more is damped by soft
/// contacts.
const QUIET: f32 = 0.05;
/// Up to so many bodies are few.
const FEW: usize = 4;
/// From this share of the greatest friction on a body is about to slide.
const STRAINED: f32 = 0.5;

/// What makes a stack.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct Found {
    /// Of its bodies, ascending.
    pub(super) places: Vec<u32>,
    /// Indices, ascending.
    pub(in super::super) pairs: Vec<u32>,
}

/// A pair that touches: its index, and the places of its bodies.
type Touch = (u32, [u32; 2]);

/// Bodies that touch one another, and where, both ascending.
#[derive(Debug, Clone, Default)]
struct Island {
    places: Vec<u32>,
    touches: Vec<Touch>,
}

/// Finds all stacks, given what joints hold. Without gravity there are none: nothing leans.
pub(in super::super) fn find(
    (groups, pairs): (&Groups, &Pairs),
    (lineup, crew, timing): (&Lineup, &Crew, &Timing),
    assembly_of: &[u32],
) -> Vec<Found> {
    if timing.gravity == Vec3::ZERO {
        return Vec::new();
    }
    let quiet = QUIET * timing.h * timing.substeps;
    let mut left = MOST_IN_ALL;
    let mut is_stack = |island: &Island| {
        let Island { places, touches } = island;
        let is_one = places.len() <= MOST_BODIES.min(left)
            && touches.len() <= MOST_PAIRS
            && !places.iter().any(|&place| assembly_of[place as usize] != NOBODY)
            && (is_hard(places, touches, crew) || places.len() <= FEW && is_delicate(touches, pairs));
        left -= if is_one { places.len() } else { 0 };
        is_one
    };
    let is_restless = |active: &Active| speed(active, pairs, (crew, timing.substeps)) >= quiet;
    let stacks = islands(groups, lineup.solved, is_restless).into_iter().filter(|island| is_stack(island));
    let found = |Island { places, touches }| {
        let pairs = touches.into_iter().map(|(pair, _)| pair).collect();
        Found { places, pairs }
    };
    stacks.map(found).collect()
}

/// What touches something, in the order of the lowest places, but for islands of too many bodies, and those in which
/// not all is quiet.
fn islands(groups: &Groups, solved: usize, is_restless: impl Fn(&Active) -> bool) -> Vec<Island> {
    let mut sets = Sets::new(solved);
    // Of each island by the lowest of its places, which is the root of the set; of the others 1 if they touch something.
    let mut sizes = vec![0_u32; solved];
    for Active { place_a, place_b, moves_a, moves_b, .. } in groups.active() {
        for (place, moves) in [(place_a, moves_a), (place_b, moves_b)] {
            if *moves {
                sizes[*place as usize] = 1;
            }
        }
        if *moves_a && *moves_b {
            sets.join(*place_a, *place_b);
        }
    }
    for place in 0..solved as u32 {
        let root = sets.root(place);
        sizes[root as usize] += u32::from(root != place);
    }
    let mut islands: Vec<Island> = Vec::new();
    let is_small = |size: u32| (1..=MOST_BODIES as u32).contains(&size);
    if !(0..solved as u32).any(|place| sets.root(place) == place && is_small(sizes[place as usize])) {
        return islands;
    }
    let root_of = |sets: &mut Sets, Active { place_a, place_b, moves_a, .. }: &Active| {
        sets.root(if *moves_a { *place_a } else { *place_b }) as usize
    };
    for active in groups.active() {
        let root = root_of(&mut sets, active);
        if is_small(sizes[root]) && is_restless(active) {
            sizes[root] = 0;
        }
    }
    let mut numbers = vec![0; solved];
    for place in (0..solved as u32).filter(|&place| sizes[place as usize] > 0) {
        let root = sets.root(place);
        if !is_small(sizes[root as usize]) {
            continue;
        }
        if root == place {
            numbers[root as usize] = islands.len();
            islands.push(Island::default());
        }
        islands[numbers[root as usize]].places.push(place);
    }
    for active in groups.active() {
        let root = root_of(&mut sets, active);
        if is_small(sizes[root]) {
            islands[numbers[root]].touches.push((active.pair, [active.place_a, active.place_b]));
        }
    }
    islands.iter_mut().for_each(|island| island.touches.put_in_order());
    islands
}

/// Whether loads go through many bodies, or from heavy to light ones, and something bears them.
fn is_hard(places: &[u32], contacts: &[Touch], crew: &Crew) -> bool {
    let heights = heights(places, contacts);
    let tallest = heights.iter().filter(|&&height| height != u32::MAX).max();
    let inverse_mass = |place: &u32| crew.velocities[*place as usize].0[3];
    let lightest = places.iter().map(inverse_mass).fold(0.0, f32::max);
    let heaviest = places.iter().map(inverse_mass).fold(f32::INFINITY, f32::min);
    tallest.is_some_and(|&tallest| tallest >= TALL || lightest >= HEAVY * heaviest)
}

/// Over how many bodies each one is borne, itself included; the greatest number if nothing bears it.
fn heights(places: &[u32], contacts: &[Touch]) -> Vec<u32> {
    let index = |place: u32| places.binary_search(&place).ok();
    let mut heights = vec![u32::MAX; places.len()];
    let mut has_changed = true;
    while has_changed {
        has_changed = false;
        for (_, [a, b]) in contacts {
            let [height_a, height_b] = [*a, *b].map(|place| index(place).map_or(0, |index| heights[index]));
            for (place, other) in [(*a, height_b), (*b, height_a)] {
                if let Some(index) = index(place)
                    && other.saturating_add(1) < heights[index]
                {
                    heights[index] = other + 1;
                    has_changed = true;
                }
            }
        }
    }
    heights
}

/// How far two surfaces come nearer to each other or part in a step, in m. How they slide does not matter.
fn speed(touch: &Active, pairs: &Pairs, (crew, substeps): (&Crew, f32)) -> f32 {
    let normal = pairs.details[touch.pair as usize].held.as_ref().map(|held| held.normal());
    let [a, b] = [touch.place_a, touch.place_b].map(|place| crew.motion(place as usize, substeps));
    (a.0 - b.0).dot(normal.unwrap_or_default()).abs() + a.1 + b.1
}

/// Whether nothing bore the bodies yet, or some contact is about to slide or bears at a part of its points only.
fn is_delicate(contacts: &[Touch], pairs: &Pairs) -> bool {
    let held = || contacts.iter().filter_map(|(index, _)| pairs.details[*index as usize].held.as_ref());
    let bears = |held: &Held| held.points().any(|point| point.normal_impulse() > 0.0);
    let is_strained = |held: &Held| {
        held.points().any(|point| {
            let (normal, friction) = (point.normal_impulse(), point.tangent_impulse().extend(0.0).norm());
            normal == 0.0 || friction > STRAINED * held.friction() * normal
        })
    };
    !held().any(bears) || held().any(|held| bears(held) && is_strained(held))
}
