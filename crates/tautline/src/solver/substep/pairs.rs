//! Pairs of parts of rigid bodies that are near each other, kept from step to step.
//!
//! The list is made from boxes that are larger than their bodies, and holds until a body leaves its box: bodies at
//! rest never do. A pair that is still there when the list is made anew keeps its contact and its multipliers.

use serde::{Deserialize, Serialize};

use super::held::{Held, MOST_POINTS};
use crate::body::{Body, Substance, Touch};
use crate::geometry::manifold::Memory;
use crate::parallel;

/// What is looked at in every step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Pair {
    /// Indices of the bodies in the world.
    pub(super) a: u32,
    pub(super) b: u32,
    /// The sum of the versions of both when their contact was found.
    pub(super) stamp: u32,
    /// How many points it has.
    pub(super) points: u32,
}

/// What is looked at if a body has moved.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Detail {
    /// The part of a's shape, and that of b's: of a mesh its triangle.
    pub(super) part_a: u32,
    pub(super) part_b: u32,
    pub(super) touch: Touch,
    pub(super) memory: Memory,
    /// While it has points.
    pub(super) held: Option<Box<Held>>,
}

/// Which parts a pair is of. Sorted by this.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) part_a: u32,
    pub(super) part_b: u32,
}

/// From so many pairs on it pays to move them side by side, …
const WORTHWHILE: usize = 4096;
/// … so many at a time.
const CHUNK: usize = 1024;

/// A stamp that no versions add up to.
pub(super) const NEVER: u32 = u32::MAX;

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pairs {
    pub(super) pairs: Vec<Pair>,
    pub(super) details: Vec<Detail>,
}

impl Pairs {
    pub(super) fn key(&self, index: usize) -> Key {
        self.pairs[index].key(&self.details[index])
    }

    /// Makes the list anew from ascending keys. The last one is left in `spare`.
    pub(super) fn replace(&mut self, keys: &[Key], spare: &mut Self, touch: impl Fn(&Key) -> Touch + Sync) {
        std::mem::swap(self, spare);
        self.pairs.resize(keys.len(), Pair::default());
        self.details.resize(keys.len(), Detail::default());
        let chunk = if parallel::is_worthwhile(keys.len(), WORTHWHILE) { CHUNK } else { keys.len().max(1) };
        let chunks = keys.chunks(chunk).zip(self.pairs.chunks_mut(chunk).zip(self.details.chunks_mut(chunk)));
        let ends: Vec<usize> = keys.chunks(chunk).skip(1).map(|keys| spare.position(&keys[0])).collect();
        let (mut pairs, mut details, mut start) = (&mut spare.pairs[..], &mut spare.details[..], 0);
        let mut moves: Vec<Move<'_>> = Vec::with_capacity(ends.len() + 1);
        for (i, (keys, (new_pairs, new_details))) in chunks.enumerate() {
            let count = ends.get(i).map_or(pairs.len(), |end| end - start);
            start += count;
            let (old_pairs, other_pairs) = pairs.split_at_mut(count);
            let (old_details, other_details) = details.split_at_mut(count);
            (pairs, details) = (other_pairs, other_details);
            moves.push(Move { keys, old: (old_pairs, old_details), new: (new_pairs, new_details) });
        }
        parallel::for_each(&mut moves, true, |task| task.run(&touch));
    }

    /// Where a key is, or would be.
    fn position(&self, key: &Key) -> usize {
        let (mut low, mut high) = (0, self.pairs.len());
        while low < high {
            let middle = low.midpoint(high);
            if self.key(middle) < *key { low = middle + 1 } else { high = middle }
        }
        low
    }

    /// Gives back memory that is not in use.
    pub(super) fn shrink(&mut self) {
        self.pairs.shrink_to_fit();
        self.details.shrink_to_fit();
    }

    /// Checks a list from untrusted bytes.
    pub(super) fn is_valid(&self, bodies: &[Body]) -> bool {
        let is_sound = |(pair, detail): (&Pair, &Detail)| {
            let exist = (pair.a.max(pair.b) as usize) < bodies.len();
            let is_held = detail.held.as_ref().is_some_and(|held| held.is_sound());
            exist
                && has_part(&bodies[pair.a as usize], detail.part_a)
                && has_part(&bodies[pair.b as usize], detail.part_b)
                && pair.points as usize <= MOST_POINTS
                && (pair.points == 0 || is_held)
                && detail.touch.is_sound()
        };
        self.pairs.len() == self.details.len()
            && self.pairs.iter().zip(&self.details).all(is_sound)
            && (1..self.pairs.len()).all(|index| self.key(index - 1) < self.key(index))
    }

    /// Forgets the pairs of a body that is removed; the bodies behind it move down.
    pub(super) fn remove_body(&mut self, body: u32) {
        self.forget(body);
        for pair in &mut self.pairs {
            pair.a -= u32::from(pair.a > body);
            pair.b -= u32::from(pair.b > body);
        }
    }

    /// Forgets the pairs of a body.
    pub(super) fn forget(&mut self, body: u32) {
        let mut keep =
            self.pairs.iter().map(|pair| pair.a != body && pair.b != body).collect::<Vec<_>>().into_iter();
        self.details.retain(|_| keep.next() == Some(true));
        self.pairs.retain(|pair| pair.a != body && pair.b != body);
    }
}

/// A run of keys, with what the old list has from the first of them up to the next run.
struct Move<'a> {
    keys: &'a [Key],
    old: (&'a mut [Pair], &'a mut [Detail]),
    new: (&'a mut [Pair], &'a mut [Detail]),
}

impl Move<'_> {
    /// Moves what is in both lists, and begins what is new.
    fn run(&mut self, touch: impl Fn(&Key) -> Touch) {
        let mut old = self.old.0.iter().zip(self.old.1.iter_mut()).peekable();
        for (key, (pair, detail)) in self.keys.iter().zip(self.new.0.iter_mut().zip(self.new.1.iter_mut())) {
            while old.next_if(|(pair, detail)| pair.key(detail) < *key).is_some() {}
            match old.next_if(|(pair, detail)| pair.key(detail) == *key) {
                Some((old_pair, old_detail)) => {
                    *pair = *old_pair;
                    *detail = Detail { held: old_detail.held.take(), ..*old_detail };
                }
                None => {
                    let Key { a, b, part_a, part_b } = *key;
                    *pair = Pair { a, b, stamp: NEVER, points: 0 };
                    *detail = Detail { part_a, part_b, touch: touch(key), ..Detail::default() };
                }
            }
        }
    }
}

impl Pair {
    #[inline(always)]
    fn key(&self, detail: &Detail) -> Key {
        Key { a: self.a, b: self.b, part_a: detail.part_a, part_b: detail.part_b }
    }
}

/// Whether a body has a part, or a triangle, of this number.
fn has_part(body: &Body, part: u32) -> bool {
    match &body.substance {
        Substance::Rigid(rigid) => match rigid.shape.surface() {
            Some(surface) => (part as usize) < surface.mesh().triangles.len(),
            None => (part as usize) < rigid.shape.parts().len(),
        },
        Substance::HalfSpace(_) => part == 0,
        Substance::Truss { .. } | Substance::Deformable(_) => false,
    }
}
