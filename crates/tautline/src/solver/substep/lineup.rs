//! Who stands where: rigid bodies in the order in which the solver keeps them.
//!
//! Awake dynamic bodies are cut into stripes along the direction they spread most in, so that stripes can be worked
//! on side by side, then every two neighbouring stripes, and nothing is shared: the order of the work, and so every
//! bit of the result, is the lineup's alone, whatever the number of threads. Within a stripe bodies that are near
//! each other stand near each other (Morton order).
//!
//! A stripe is a whole number of blocks of eight: its bodies, a copy of every kinematic body, and at least one empty
//! place, which stands for whatever does not move. Behind the stripes come those that are not solved for: fixed and
//! sleeping bodies, the kinematic ones themselves, and last a place for half-spaces, at rest at the origin.

use std::ops::Range;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::order::PutInOrder;
use crate::simd::LANES;

/// In a place where there is no body.
pub(super) const NOBODY: u32 = u32::MAX;

/// A stripe has about so many bodies: enough work to be worth a thread.
const BODIES_PER_STRIPE: usize = 1000;

/// A rigid body that is to stand somewhere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Its index in the world.
    pub(super) body: u32,
    pub(super) role: Role,
    pub(super) center: Vec3,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Solved for.
    Free,
    /// Moves as it was told.
    Driven,
    /// Fixed or asleep.
    Still,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Lineup {
    /// The body in each place.
    pub(super) places: Vec<u32>,
    /// The place of each body of the world; `NOBODY` for those that are not rigid.
    pub(super) place_of: Vec<u32>,
    pub(super) stripes: Vec<Stripe>,
    /// The number of the stripe that each block of eight places is in.
    stripe_of_block: Vec<u32>,
    /// How many places are in stripes.
    pub(super) solved: usize,
    /// How many kinematic bodies there are.
    driven_count: u32,
}

/// A run of places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Stripe {
    pub(super) places: Range<u32>,
    /// Where the copies of the kinematic bodies begin.
    driven: u32,
}

/// Which stripes a pair of bodies lies in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Region {
    /// Within stripe i.
    Stripe(u32),
    /// Between stripes i and i + 1.
    Border(u32),
    /// Between stripes further apart.
    Far,
}

impl Lineup {
    pub(super) fn new(mut entries: Vec<Entry>, body_count: usize) -> Self {
        let driven: Vec<u32> = bodies_of(&entries, Role::Driven);
        let still: Vec<u32> = bodies_of(&entries, Role::Still);
        entries.retain(|entry| entry.role == Role::Free);
        let mut lineup = Self { place_of: vec![NOBODY; body_count], ..Self::default() };
        let count = (entries.len() / BODIES_PER_STRIPE).max(1);
        sort_along_widest_axis(&mut entries);
        for i in 0..count {
            let range = i * entries.len() / count..(i + 1) * entries.len() / count;
            lineup.push_stripe(&mut entries[range], &driven);
        }
        lineup.solved = lineup.places.len();
        lineup.driven_count = driven.len() as u32;
        lineup.push(&driven);
        lineup.push(&still);
        lineup.fill();
        lineup
    }

    fn push_stripe(&mut self, entries: &mut [Entry], driven: &[u32]) {
        sort_by_neighbourhood(entries);
        let start = self.places.len() as u32;
        let bodies: Vec<u32> = entries.iter().map(|entry| entry.body).collect();
        self.push(&bodies);
        let first_copy = self.places.len() as u32;
        self.places.extend(driven);
        self.fill();
        self.stripe_of_block.resize(self.places.len() / LANES, self.stripes.len() as u32);
        self.stripes.push(Stripe { places: start..self.places.len() as u32, driven: first_copy });
    }

    fn push(&mut self, bodies: &[u32]) {
        for &body in bodies {
            self.place_of[body as usize] = self.places.len() as u32;
            self.places.push(body);
        }
    }

    /// Adds one empty place at least, up to a whole number of blocks.
    fn fill(&mut self) {
        let length = (self.places.len() / LANES + 1) * LANES;
        self.places.resize(length, NOBODY);
    }

    /// Checks a lineup from untrusted bytes.
    pub(super) fn is_valid(&self, body_count: usize) -> bool {
        let count = self.places.len();
        let is_body = |body: u32| body == NOBODY || (body as usize) < body_count;
        let mut end = 0;
        let stripes_follow = self.stripes.iter().all(|stripe| {
            let Stripe { places, driven } = stripe;
            let follows = places.start == end
                && (places.end as usize).is_multiple_of(LANES)
                && places.start < places.end;
            end = places.end;
            follows && *driven >= places.start && driven.saturating_add(self.driven_count) < places.end
        });
        let blocks =
            |(number, stripe): (u32, &Stripe)| std::iter::repeat_n(number, stripe.places.len() / LANES);
        let is_place = |(body, &place): (usize, &u32)| {
            place == NOBODY || self.places.get(place as usize).is_some_and(|&other| other as usize == body)
        };
        count.is_multiple_of(LANES)
            && (count == 0 || !self.stripes.is_empty() && self.places[count - 1] == NOBODY)
            && stripes_follow
            && end as usize == self.solved
            && (0..).zip(&self.stripes).flat_map(blocks).eq(self.stripe_of_block.iter().copied())
            && self.moving() <= count
            && self.place_of.len() <= body_count
            && self.places.iter().all(|&body| is_body(body))
            && self.place_of.iter().enumerate().all(is_place)
    }

    /// Whether a body stands in this place: copies of kinematic bodies stand in others.
    pub(super) fn is_place_of(&self, place: u32, body: u32) -> bool {
        self.place_of.get(body as usize) == Some(&place)
    }

    /// All bodies with their places, by place.
    pub(super) fn standing(&self) -> impl Iterator<Item = (u32, u32)> {
        let standing = self.places.iter().copied().zip(0..);
        standing.filter(|&(body, place)| self.is_place_of(place, body))
    }

    /// The runs of places that are solved side by side.
    pub(super) fn stripes(&self) -> impl Iterator<Item = Range<usize>> {
        self.stripes.iter().map(|stripe| stripe.places.start as usize..stripe.places.end as usize)
    }

    /// Up to where, in whole blocks, bodies can move.
    pub(super) fn moving(&self) -> usize {
        self.solved + (self.driven_count as usize).next_multiple_of(LANES)
    }

    /// The place that stands for half-spaces.
    pub(super) fn ground(&self) -> u32 {
        (self.places.len() as u32).saturating_sub(1)
    }

    /// A body is removed: its place is empty, also those of its copies if it is kinematic, and those behind it have moved
    /// down.
    pub(super) fn forget(&mut self, body: u32) {
        for other in self.places.iter_mut().filter(|other| **other != NOBODY) {
            *other = if *other == body { NOBODY } else { *other - u32::from(*other > body) };
        }
    }

    /// The number of the stripe that a place is in, if it is solved for.
    fn stripe_of(&self, place: u32) -> Option<u32> {
        self.stripe_of_block.get(place as usize / LANES).copied()
    }

    /// Where a pair of places is solved, if one of them is.
    pub(super) fn region(&self, a: u32, b: u32) -> Option<Region> {
        let between = |i: u32, j: u32| match i.abs_diff(j) {
            0 => Region::Stripe(i),
            1 => Region::Border(i.min(j)),
            _ => Region::Far,
        };
        match (self.stripe_of(a), self.stripe_of(b)) {
            (Some(i), Some(j)) => Some(between(i, j)),
            (Some(i), None) | (None, Some(i)) => Some(Region::Stripe(i)),
            (None, None) => None,
        }
    }

    /// The places whose velocities a region may read and change.
    pub(super) fn range(&self, region: Region) -> Range<usize> {
        let span = |first: u32, last: u32| {
            self.stripes[first as usize].places.start as usize
                ..self.stripes[last as usize].places.end as usize
        };
        match region {
            Region::Stripe(i) => span(i, i),
            Region::Border(i) => span(i, i + 1),
            Region::Far => 0..self.solved,
        }
    }

    /// Where a region finds the velocity of what is in a place: the place itself, the copy of a kinematic body in
    /// one of the region's stripes, or an empty place, for what is still.
    pub(super) fn velocity_place(&self, region: Region, place: u32) -> u32 {
        if (place as usize) < self.solved {
            return place;
        }
        let stripe = match region {
            Region::Stripe(i) | Region::Border(i) => i,
            Region::Far => 0,
        };
        let stripe = &self.stripes[stripe as usize];
        let copy = stripe.driven + (place - self.solved as u32);
        if place < self.solved as u32 + self.driven_count { copy } else { stripe.places.end - 1 }
    }

    /// Where the body in a place moves in the step: a kinematic one does in its copies, of which this is the first.
    pub(super) fn moving_place(&self, place: u32) -> u32 {
        if self.is_driven(place) { self.velocity_place(Region::Far, place) } else { place }
    }

    /// Whether this is the place of a kinematic body.
    pub(super) fn is_driven(&self, place: u32) -> bool {
        (self.solved as u32..self.solved as u32 + self.driven_count).contains(&place)
    }

    /// The place that holds the motion of a body, if it moves: of a kinematic one that of its first copy.
    pub(super) fn place_of_motion(&self, body: usize) -> Option<usize> {
        let place = *self.place_of.get(body).filter(|&&place| place != NOBODY)?;
        let moves = (place as usize) < self.solved || self.is_driven(place);
        moves.then(|| self.velocity_place(Region::Stripe(0), place) as usize)
    }
}

fn bodies_of(entries: &[Entry], role: Role) -> Vec<u32> {
    entries.iter().filter(|entry| entry.role == role).map(|entry| entry.body).collect()
}

fn sort_along_widest_axis(entries: &mut [Entry]) {
    let (low, high) = bounds(entries);
    let size = high - low;
    let axis = (0..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest });
    entries.put_in_order_by(|a, b| a.center[axis].total_cmp(&b.center[axis]).then(a.body.cmp(&b.body)));
}

fn sort_by_neighbourhood(entries: &mut [Entry]) {
    let (low, high) = bounds(entries);
    let scale = 1023.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    let code = |entry: &Entry| {
        let cell = (entry.center - low) * scale;
        spread_bits(cell.x as u32) | spread_bits(cell.y as u32) << 1 | spread_bits(cell.z as u32) << 2
    };
    entries.put_in_order_by_cached_key(|entry| (code(entry), entry.body));
}

fn bounds(entries: &[Entry]) -> (Vec3, Vec3) {
    entries.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), entry| {
        (low.min(entry.center), high.max(entry.center))
    })
}

/// Two zeros between the lowest ten bits (Morton 1966).
fn spread_bits(x: u32) -> u32 {
    let x = x.min(1023);
    let x = (x | x << 16) & 0x0300_00FF;
    let x = (x | x << 8) & 0x0300_F00F;
    let x = (x | x << 4) & 0x030C_30C3;
    (x | x << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(free: u32, driven: u32, still: u32) -> Vec<Entry> {
        let role = |i: u32| match i {
            i if i < free => Role::Free,
            i if i < free + driven => Role::Driven,
            _ => Role::Still,
        };
        let center = |i: u32| Vec3::new((i * 37 % 101) as f32, (i * 11 % 7) as f32, (i * 5 % 3) as f32);
        (0..free + driven + still).map(|i| Entry { body: i, role: role(i), center: center(i) }).collect()
    }

    #[test]
    fn every_body_has_one_place_and_stripes_are_whole_blocks() {
        let lineup = Lineup::new(entries(3100, 3, 5), 3108);
        assert_eq!(lineup.stripes.len(), 3);
        for body in 0..3108 {
            let place = lineup.place_of[body as usize];
            assert_eq!(lineup.places[place as usize], body);
            assert_eq!((place as usize) < lineup.solved, body < 3100);
        }
        for stripe in &lineup.stripes {
            assert_eq!((stripe.places.start % 8, stripe.places.end % 8), (0, 0));
            assert_eq!(lineup.places[stripe.places.end as usize - 1], NOBODY);
        }
        assert_eq!(lineup.places[lineup.ground() as usize], NOBODY);
        let moving = (0..3108).filter_map(|body| lineup.place_of_motion(body));
        assert_eq!(moving.filter(|&place| place < lineup.solved).count(), 3103);
    }

    #[test]
    fn a_region_finds_every_velocity_in_its_own_range() {
        let lineup = Lineup::new(entries(5000, 2, 1), 5003);
        let (driven, still) = (lineup.place_of[5001], lineup.place_of[5002]);
        for region in [Region::Stripe(2), Region::Border(3), Region::Far] {
            let range = lineup.range(region);
            for place in [driven, still, lineup.ground()] {
                assert!(range.contains(&(lineup.velocity_place(region, place) as usize)));
            }
            assert_eq!(lineup.places[lineup.velocity_place(region, driven) as usize], 5001);
            assert_eq!(lineup.places[lineup.velocity_place(region, still) as usize], NOBODY);
        }
        assert_eq!(lineup.region(driven, still), None);
        let (first, last) = (lineup.stripes[0].places.start, lineup.stripes[4].places.start);
        assert_eq!(lineup.region(first, first + 1), Some(Region::Stripe(0)));
        assert_eq!(lineup.region(last, first), Some(Region::Far));
        assert_eq!(lineup.region(first, driven), Some(Region::Stripe(0)));
    }

    #[test]
    fn a_world_without_free_bodies_has_one_empty_stripe() {
        let lineup = Lineup::new(entries(0, 1, 1), 2);
        assert_eq!(lineup.stripes.len(), 1);
        assert_eq!((lineup.place_of_motion(0), lineup.place_of_motion(1)), (Some(0), None));
        assert_eq!(lineup.places[0], 0);
    }
}
