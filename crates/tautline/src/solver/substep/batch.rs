//! Contacts in batches of eight pairs that share no body.
//!
//! Pairs are coloured greedily in their order: of the colours that neither body has yet, each takes the lowest. A
//! batch holds pairs of one colour and one number of points. What cannot move takes no colour.

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
    pub(super) place_a: [u32; LANES],
    pub(super) place_b: [u32; LANES],
    /// Where its points begin.
    pub(super) first: u32,
    /// How many points each of its pairs has.
    pub(super) points: u32,
    /// Bits of the lanes whose pairs belong to stacks.
    pub(super) stacked: u32,
}

impl Batch {
    /// Its points among all.
    #[inline(always)]
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.points) as usize
    }
}

/// What the points of a batch share.
#[derive(Debug, Clone, Default)]
pub(super) struct HeaderRows {
    /// From a to b.
    pub(super) normal: Rows3,
    pub(super) tangents: [Rows3; 2],
    pub(super) friction: Row,
    pub(super) restitution: Row,
    /// In m.
    pub(super) rolling_friction: Row,
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
    /// How many pairs each class has, then the number of its first batch.
    counts: Vec<u32>,
    /// The pairs that found no colour among the last 64.
    left: Vec<u32>,
}

/// Colours in a round.
const ROUND: u32 = 64;
const MOST_POINTS: u32 = 4;

impl Colouring {
    /// Puts the pairs into batches. `empty` is the place (counted within the range of `range_length` places) that
    /// empty lanes name, `ground` the place in the lineup.
    pub(super) fn batch(
        &mut self,
        pairs: &[Active],
        range_length: usize,
        [empty, ground]: [u32; 2],
        batches: &mut Vec<Batch>,
    ) {
        self.colour(pairs, range_length);
        batches.clear();
        let count = self.counts.iter().map(|count| count.div_ceil(LANES as u32) as usize).sum();
        reserve(batches, count);
        let mut first = 0;
        for (class, count) in self.counts.iter_mut().enumerate() {
            let points = class as u32 % MOST_POINTS + 1;
            let needed = count.div_ceil(LANES as u32);
            *count = batches.len() as u32 * LANES as u32;
            for _ in 0..needed {
                batches.push(Batch {
                    pairs: [NO_PAIR; LANES],
                    a: [empty; LANES],
                    b: [empty; LANES],
                    place_a: [ground; LANES],
                    place_b: [ground; LANES],
                    first,
                    points,
                    stacked: 0,
                });
                first += points;
            }
        }
        for (active, &class) in pairs.iter().zip(&self.classes) {
            let next = &mut self.counts[class as usize];
            let (batch, lane) = (*next as usize / LANES, *next as usize % LANES);
            *next += 1;
            let batch = &mut batches[batch];
            batch.pairs[lane] = active.pair;
            (batch.a[lane], batch.b[lane]) = (active.a, active.b);
            (batch.place_a[lane], batch.place_b[lane]) = (active.place_a, active.place_b);
            batch.stacked |= u32::from(active.is_stacked) << lane;
        }
    }

    fn colour(&mut self, pairs: &[Active], range_length: usize) {
        self.classes.clear();
        reserve(&mut self.classes, pairs.len());
        self.classes.resize(pairs.len(), 0);
        fit(&mut self.classes);
        self.counts.clear();
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
        if self.counts.len() <= class as usize {
            self.counts.resize(class as usize + 1, 0);
        }
        self.counts[class as usize] += 1;
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
                assert_eq!(u32::from(active.points), batch.points);
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
