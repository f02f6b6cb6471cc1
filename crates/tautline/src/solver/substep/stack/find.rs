//! Which bodies are a stack.
//!
//! Bodies that touch one another without a joint, on something that bears them, slowly enough to be about to rest, and
//! such that loads are hard to pass on: over at least four bodies from below, or from a body to one that is four times
//! lighter; or few bodies that are about to slide or to topple, or that nothing bore yet. Only up to a few dozen, for an
//! exact solution costs more than passes: larger heaps have soft contacts.

use super::super::crew::{Crew, Timing};
use super::super::held::Held;
use super::super::joint::Sets;
use super::super::lineup::Lineup;
use super::super::pairs::Pairs;

/// The most bodies of a stack, and pairs of parts.
const MOST_BODIES: usize = 64;
const MOST_PAIRS: usize = 96;
/// The most bodies in all stacks of a world; those with the lowest places go first.
const MOST_IN_ALL: usize = 512;
/// From so many bodies over each other, or so many times the mass of the lightest, it is hard to pass on loads.
const TALL: u32 = 4;
const HEAVY: f32 = 4.0;
/// How fast surfaces of a stack come nearer to each other or part at most, in m/s; …
const QUIET: f32 = 0.5;
/// … and those of few bodies that are a stack only because they are about to slide, topple or rest.
const VERY_QUIET: f32 = 0.1;
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

/// Finds all stacks. `is_held` tells of a place whether joints hold its body.
pub(in super::super) fn find(
    pairs: &Pairs,
    (lineup, crew, timing): (&Lineup, &Crew, &Timing),
    is_held: impl Fn(u32) -> bool,
) -> Vec<Found> {
    let place = |body: u32| lineup.place_of.get(body as usize).copied().unwrap_or(u32::MAX);
    let is_solved = |place: u32| (place as usize) < lineup.solved;
    let touches = || {
        let touching = (0..).zip(&pairs.pairs).filter(|(_, pair)| pair.points > 0);
        touching.map(|(index, pair)| (index, [place(pair.a), place(pair.b).min(lineup.ground())]))
    };
    let mut sets = Sets::new(lineup.solved);
    let mut touches_any = vec![false; lineup.solved];
    for (_, [a, b]) in touches() {
        if is_solved(a) && is_solved(b) {
            sets.join(a, b);
        }
        for place in [a, b].into_iter().filter(|&place| is_solved(place)) {
            touches_any[place as usize] = true;
        }
    }
    let mut members: Vec<Found> = Vec::new();
    let mut found_at = vec![u32::MAX; lineup.solved];
    for body in (0..lineup.solved as u32).filter(|&body| touches_any[body as usize]) {
        let root = sets.root(body) as usize;
        if found_at[root] == u32::MAX {
            found_at[root] = members.len() as u32;
            members.push(Found::default());
        }
        members[found_at[root] as usize].places.push(body);
    }
    let mut contacts: Vec<Vec<Touch>> = vec![Vec::new(); members.len()];
    for touch in touches() {
        let Some(solved) = touch.1.into_iter().find(|&place| is_solved(place)) else { continue };
        let number = found_at[sets.root(solved) as usize] as usize;
        if members.get(number).is_some_and(|found| found.places.len() <= MOST_BODIES) {
            contacts[number].push(touch);
        }
    }
    let mut left = MOST_IN_ALL;
    let mut is_stack = |found: &Found, contacts: &[Touch]| {
        let is_one = found.places.len() <= MOST_BODIES.min(left)
            && contacts.len() <= MOST_PAIRS
            && !found.places.iter().any(|&place| is_held(place))
            && match fastest(contacts, pairs, (crew, timing.substeps)) / (timing.h * timing.substeps) {
                speed if speed < VERY_QUIET && found.places.len() <= FEW => {
                    is_delicate(contacts, pairs) || is_hard(&found.places, contacts, crew)
                }
                speed => speed < QUIET && is_hard(&found.places, contacts, crew),
            };
        left -= if is_one { found.places.len() } else { 0 };
        is_one
    };
    let mut stacks = Vec::new();
    for (mut found, contacts) in members.into_iter().zip(contacts) {
        if is_stack(&found, &contacts) {
            found.pairs = contacts.iter().map(|(index, _)| *index).collect();
            stacks.push(found);
        }
    }
    stacks
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

/// How far any two surfaces come nearer to each other or part in a step, in m. How they slide does not matter.
fn fastest(contacts: &[Touch], pairs: &Pairs, (crew, substeps): (&Crew, f32)) -> f32 {
    let speed = |(index, ends): &Touch| {
        let normal = pairs.details[*index as usize].held.as_ref().map(|held| held.normal());
        let [a, b] = ends.map(|place| crew.motion(place as usize, substeps));
        (a.0 - b.0).dot(normal.unwrap_or_default()).abs() + a.1 + b.1
    };
    contacts.iter().map(speed).fold(0.0, f32::max)
}

/// Whether nothing bore the bodies yet, or some contact is about to slide or bears at a part of its points only.
fn is_delicate(contacts: &[Touch], pairs: &Pairs) -> bool {
    let held = || contacts.iter().filter_map(|(index, _)| pairs.details[*index as usize].held.as_deref());
    let bears = |held: &Held| held.points.iter().any(|point| point.normal_impulse() > 0.0);
    let is_strained = |held: &Held| {
        held.points.iter().any(|point| {
            let limit = STRAINED * held.friction() * point.normal_impulse();
            point.is_there() && bears(held) && point.tangent_impulse().length_squared() >= limit * limit
        })
    };
    !held().any(bears) || held().any(is_strained)
}
