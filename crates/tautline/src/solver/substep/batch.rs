//! Contacts in batches of eight pairs that share no body.
//!
//! Pairs are coloured greedily in their order: of the colours that neither body has yet, each takes the lowest. A
//! batch holds pairs of one colour and, but for what is left over, one number of points. What cannot move takes no
//! colour.

use crate::simd::{LANES, Row};

use super::block::Rows3;
use super::pairs::{fit, reserve};

/// A pair with points, as a group of pairs sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Active {
    /// Its number among the pairs.
    pub(super) pair: u32,
    /// The places of the bodies' velocities, counted within the group's range.
    pub(super) a: u32,
    pub(super) b: u32,
    /// Their places.
    pub(super) place_a: u32,
    pub(super) place_b: u32,
    /// How many points it has, 1 to 4.
    pub(super) points: u8,
    /// Whether impulses change the velocity of a, and of b.
    pub(super) moves_a: bool,
    pub(super) moves_b: bool,
    /// Whether it belongs to a stack, see `stack`.
    pub(super) is_stacked: bool,
}

/// In an empty lane.
pub(super) const NO_PAIR: u32 = u32::MAX;

/// Eight pairs, by lane.
#[derive(Debug, Clone)]
pub(super) struct Batch {
    pub(super) pairs: [u32; LANES],
    pub(super) a: [u32; LANES],
    pub(super) b: [u32; LANES],
    /// Where its points begin.
    pub(super) first: u32,
    /// How many points its pairs have at most, and each of them.
    pub(super) points: u32,
    pub(super) counts: [u8; LANES],
    /// Bits of the lanes whose pairs belong to stacks.
    pub(super) stacked: u32,
    /// Whether the next batch moves none of the same bodies.
    pub(super) has_twin: bool,
}

/// The places of eight pairs' bodies in the lineup, which are asked for their poses.
#[derive(Debug, Clone)]
pub(super) struct Places {
    pub(super) a: [u32; LANES],
    pub(super) b: [u32; LANES],
}

impl Batch {
    /// Its points among all.
    #[inline(always)]
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.points) as usize
    }

    /// Bits of the lanes that have a pair.
    pub(super) fn occupied(&self) -> u32 {
        (0..LANES).filter(|&lane| self.pairs[lane] != NO_PAIR).fold(0, |bits, lane| bits | 1 << lane)
    }

    /// Those of one of its pairs among all.
    pub(super) fn range_of(&self, lane: usize) -> std::ops::Range<usize> {
        self.first as usize..self.first as usize + usize::from(self.counts[lane])
    }
}

/// What the points of a batch share.
#[derive(Debug, Clone, Default)]
pub(super) struct HeaderRows {
    /// From a to b.
    pub(super) normal: Rows3,
    pub(super) tangents: [Rows3; 2],
    pub(super) friction: Row,
    /// 1 where contacts are soft, 0 in stacks that are solved.
    pub(super) is_soft: Row,
}

/// One point of each of eight pairs. A Jacobian is √I⁻¹ (l × Rᵀd): see `block`.
#[derive(Debug, Clone, Default)]
pub(super) struct PointRows {
    pub(super) normal_a: Rows3,
    pub(super) normal_b: Rows3,
    pub(super) tangents_a: [Rows3; 2],
    pub(super) tangents_b: [Rows3; 2],
    /// Effective masses, in kg; that of both tangents is the smaller one.
    pub(super) normal_mass: Row,
    pub(super) tangent_mass: Row,
    /// Distance of the surfaces along the normal, in m.
    pub(super) separation: Row,
    /// Multipliers, in kg m: the impulse times the substep.
    pub(super) normal_impulse: Row,
    pub(super) tangent_impulses: [Row; 2],
    /// How far the anchors have drifted apart along the tangents, in m.
    pub(super) drift: [Row; 2],
    /// How far they have been moved in this step to follow what slides, in m.
    pub(super) slid: [Row; 2],
}

/// Makes batches of the pairs.
#[derive(Debug, Clone, Default)]
pub(super) struct Colouring {
    /// Colours in use by each place, 64 at a time.
    used: Vec<u64>,
    /// The class of each pair: its colour and number of points.
    classes: Vec<u32>,
    /// Of each class, where its pairs go.
    slots: Vec<Slots>,
    /// The pairs that found no colour among the last 64.
    left: Vec<u32>,
}

/// Where the pairs of a class go, lane after lane: the first ones fill a batch of pairs with more points, which needs
/// no rows of their own for them, the others batches of theirs.
#[derive(Debug, Clone, Copy, Default)]
struct Slots {
    /// How many are still to be placed.
    count: u32,
    /// How many of them in another batch, and from which lane on: lanes are counted through all batches.
    guests: u32,
    guest_lane: u32,
    /// From which lane on the others are.
    lane: u32,
}

impl Slots {
    fn next(&mut self) -> usize {
        let lane = if self.guests > 0 { &mut self.guest_lane } else { &mut self.lane };
        self.guests = self.guests.saturating_sub(1);
        *lane += 1;
        *lane as usize - 1
    }
}

/// Colours in a round.
const ROUND: u32 = 64;
const MOST_POINTS: u32 = 4;

impl Colouring {
    /// Puts the pairs into batches, and returns the places of each. `empty` is the place (counted within the range of
    /// `range_length` places) that empty lanes name, `ground` the place in the lineup.
    pub(super) fn batch(
        &mut self,
        pairs: &[Active],
        range_length: usize,
        [empty, ground]: [u32; 2],
        batches: &mut Vec<Batch>,
    ) -> Vec<Places> {
        self.colour(pairs, range_length);
        batches.clear();
        let count: u32 = self.slots.iter().map(|slots| slots.count.div_ceil(LANES as u32)).sum();
        reserve(batches, count as usize);
        for colour in self.slots.chunks_mut(MOST_POINTS as usize) {
            share_out(colour, empty, batches);
        }
        let mut places = vec![Places { a: [ground; LANES], b: [ground; LANES] }; batches.len()];
        for (active, &class) in pairs.iter().zip(&self.classes) {
            let lane = self.slots[class as usize].next();
            let (number, lane) = (lane / LANES, lane % LANES);
            let (batch, places) = (&mut batches[number], &mut places[number]);
            batch.pairs[lane] = active.pair;
            batch.counts[lane] = active.points;
            (batch.a[lane], batch.b[lane]) = (active.a, active.b);
            (places.a[lane], places.b[lane]) = (active.place_a, active.place_b);
            batch.stacked |= u32::from(active.is_stacked) << lane;
        }
        places
    }

    fn colour(&mut self, pairs: &[Active], range_length: usize) {
        self.classes.clear();
        reserve(&mut self.classes, pairs.len());
        self.classes.resize(pairs.len(), 0);
        fit(&mut self.classes);
        self.slots.clear();
        self.left.clear();
        let mut todo: Option<Vec<u32>> = None;
        let mut base = 0;
        loop {
            self.used.clear();
            self.used.resize(range_length, 0);
            match &todo {
                None => (0..pairs.len() as u32).for_each(|i| self.colour_one(pairs, i, base)),
                Some(todo) => todo.iter().for_each(|&i| self.colour_one(pairs, i, base)),
            }
            if self.left.is_empty() {
                return;
            }
            todo = Some(std::mem::take(&mut self.left));
            base += ROUND;
        }
    }

    #[inline]
    fn colour_one(&mut self, pairs: &[Active], index: u32, base: u32) {
        let pair = &pairs[index as usize];
        let taken = |moves: bool, place: u32| if moves { self.used[place as usize] } else { 0 };
        let free = !(taken(pair.moves_a, pair.a) | taken(pair.moves_b, pair.b));
        if free == 0 {
            self.left.push(index);
            return;
        }
        let colour = free.trailing_zeros();
        if pair.moves_a {
            self.used[pair.a as usize] |= 1 << colour;
        }
        if pair.moves_b {
            self.used[pair.b as usize] |= 1 << colour;
        }
        let class = (base + colour) * MOST_POINTS + u32::from(pair.points) - 1;
        self.classes[index as usize] = class;
        if self.slots.len() <= class as usize {
            let colours = class / MOST_POINTS + 1;
            self.slots.resize((colours * MOST_POINTS) as usize, Slots::default());
        }
        self.slots[class as usize].count += 1;
    }
}

/// Adds empty batches for the classes of a colour, and tells these where their pairs go.
fn share_out(classes: &mut [Slots], empty: u32, batches: &mut Vec<Batch>) {
    const WIDTH: u32 = LANES as u32;
    // Free lanes of a batch of pairs with more points, and the first of them.
    let (mut free, mut free_lane) = (0, 0);
    for (points, class) in (1..=MOST_POINTS).rev().zip(classes.iter_mut().rev()) {
        let left_over = class.count % WIDTH;
        class.guests = left_over.min(free);
        class.guest_lane = free_lane;
        (free, free_lane) = (free - class.guests, free_lane + class.guests);
        class.lane = batches.len() as u32 * WIDTH;
        let own = class.count - class.guests;
        for _ in 0..own.div_ceil(WIDTH) {
            let first = batches.last().map_or(0, |batch: &Batch| batch.first + batch.points);
            batches.push(Batch {
                pairs: [NO_PAIR; LANES],
                a: [empty; LANES],
                b: [empty; LANES],
                first,
                points,
                counts: [0; LANES],
                stacked: 0,
                has_twin: true,
            });
        }
        if own % WIDTH > 0 {
            (free, free_lane) = (WIDTH - own % WIDTH, class.lane + own);
        }
    }
    if let Some(last) = batches.last_mut() {
        last.has_twin = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_lanes_of_a_batch_move_the_same_body() {
        // A hub that touches 150 bodies, and a chain through them.
        let pair = |pair, a, b| Active {
            pair,
            a,
            b,
            place_a: a,
            place_b: b,
            points: (pair % 4 + 1) as u8,
            moves_a: true,
            moves_b: b < 190,
            is_stacked: false,
        };
        let mut pairs: Vec<Active> = (1..=150).map(|i| pair(i - 1, 0, i)).collect();
        pairs.extend((1..=149).map(|i| pair(149 + i, i, i + 1)));
        pairs.extend((1..=20).map(|i| pair(298 + i, i, 199)));
        let mut batches = Vec::new();
        Colouring::default().batch(&pairs, 200, [199, 207], &mut batches);
        let mut seen = vec![0; pairs.len()];
        let mut first = 0;
        for batch in &batches {
            assert_eq!(batch.first, first);
            first += batch.points;
            let mut moved = Vec::new();
            for lane in (0..LANES).filter(|&lane| batch.pairs[lane] != NO_PAIR) {
                let active = pairs.iter().find(|active| active.pair == batch.pairs[lane]).unwrap();
                assert!(u32::from(active.points) <= batch.points && active.points == batch.counts[lane]);
                assert_eq!((active.a, active.b), (batch.a[lane], batch.b[lane]));
                seen[active.pair as usize] += 1;
                moved.push(active.a);
                moved.extend(active.moves_b.then_some(active.b));
            }
            let count = moved.len();
            moved.sort_unstable();
            moved.dedup();
            assert_eq!(moved.len(), count);
        }
        assert!(seen.iter().all(|&count| count == 1));
    }
}
