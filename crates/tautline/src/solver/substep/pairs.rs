//! Pairs of parts of rigid bodies that are near each other, kept from step to step.
//!
//! The list is made from boxes that are larger than their bodies. It holds until a body leaves its box, which bodies at
//! rest never do; then the pairs of that body are found anew, or all if there are many such bodies. A pair that is
//! still there keeps its contact and its multipliers.

use serde::{Deserialize, Serialize};

use super::held::{Held, MOST_POINTS};
use crate::body::{Body, Substance};
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
    pub(super) memory: Memory,
    /// While it has points.
    pub(super) held: Option<Held>,
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

/// Lists grow by this part more than they have to, …
const GROWTH: usize = 32;
/// … and are cut back if more than this part of them is not in use.
const WASTE: usize = 32;

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
    pub(super) fn replace(&mut self, keys: &[Key], spare: &mut Self) {
        std::mem::swap(self, spare);
        reserve(&mut self.pairs, keys.len());
        reserve(&mut self.details, keys.len());
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
        parallel::for_each(&mut moves, true, |task| task.run());
    }

    /// Makes the list of the bodies in `is_listed` anew from their ascending keys; all others stay.
    pub(super) fn replace_some(&mut self, is_listed: &[bool], keys: &[Key]) {
        let Self { pairs, details } = self;
        let worthwhile = parallel::is_worthwhile(pairs.len(), WORTHWHILE);
        let listed = parallel::collect(pairs, worthwhile, |index, pair| {
            (is_listed[pair.a as usize] || is_listed[pair.b as usize]).then_some(index)
        });
        let mut is_old = vec![false; keys.len()];
        let mut gone = Vec::new();
        for index in listed {
            match keys.binary_search(&pairs[index].key(&details[index])) {
                Ok(key) => is_old[key] = true,
                Err(_) => gone.push(index),
            }
        }
        self.remove(&gone);
        let new = keys.iter().zip(is_old).filter(|(_, is_old)| !is_old).map(|(key, _)| key);
        self.insert(new.collect());
    }

    /// Removes the pairs with these indices, which ascend.
    fn remove(&mut self, gone: &[usize]) {
        let (mut gone, count) = (gone.iter().copied().peekable(), self.pairs.len());
        let Some(&first) = gone.peek() else { return };
        let mut kept = first;
        for index in first..count {
            if gone.next_if_eq(&index).is_none() {
                self.pairs.swap(kept, index);
                self.details.swap(kept, index);
                kept += 1;
            }
        }
        self.pairs.truncate(kept);
        self.details.truncate(kept);
    }

    /// Adds ascending keys that are not there yet.
    fn insert(&mut self, mut keys: Vec<&Key>) {
        let (mut from, mut to) = (self.pairs.len(), self.pairs.len() + keys.len());
        reserve(&mut self.pairs, to);
        reserve(&mut self.details, to);
        self.pairs.resize(to, Pair::default());
        self.details.resize(to, Detail::default());
        // From the end on, until nothing is left to be moved.
        while let Some(key) = keys.last() {
            to -= 1;
            if from > 0 && self.key(from - 1) > **key {
                from -= 1;
                self.pairs.swap(from, to);
                self.details.swap(from, to);
            } else {
                (self.pairs[to], self.details[to]) = begin(key);
                keys.pop();
            }
        }
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
            let is_sound = |held: &Held| held.is_sound(pair.points as usize) && held.touch().is_sound();
            let is_held = detail.held.as_ref().is_some_and(is_sound);
            exist
                && has_part(&bodies[pair.a as usize], detail.part_a)
                && has_part(&bodies[pair.b as usize], detail.part_b)
                && pair.points as usize <= MOST_POINTS
                && (pair.points == 0 || is_held)
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
    fn run(&mut self) {
        let mut old = self.old.0.iter().zip(self.old.1.iter_mut()).peekable();
        for (key, (pair, detail)) in self.keys.iter().zip(self.new.0.iter_mut().zip(self.new.1.iter_mut())) {
            while old.next_if(|(pair, detail)| pair.key(detail) < *key).is_some() {}
            match old.next_if(|(pair, detail)| pair.key(detail) == *key) {
                Some((old_pair, old_detail)) => {
                    *pair = *old_pair;
                    *detail = Detail { held: old_detail.held.take(), ..*old_detail };
                }
                None => (*pair, *detail) = begin(key),
            }
        }
    }
}

/// A pair that is new.
fn begin(key: &Key) -> (Pair, Detail) {
    let Key { a, b, part_a, part_b } = *key;
    (Pair { a, b, stamp: NEVER, points: 0 }, Detail { part_a, part_b, ..Detail::default() })
}

/// Room for so many, and not, as vectors grow by themselves, for up to twice as many.
pub(super) fn reserve<T>(items: &mut Vec<T>, count: usize) {
    if items.capacity() < count {
        items.reserve_exact(count + count / GROWTH - items.len());
    }
}

/// Makes a list of so many items, all of which are going to be written: what is in it is not moved to other memory.
pub(super) fn renew<T: Default>(items: &mut Vec<T>, count: usize) {
    if items.capacity() < count || items.capacity() > count + count / WASTE {
        *items = Vec::new();
        reserve(items, count);
    }
    items.resize_with(count, T::default);
}

/// Gives back what a list has too much of.
pub(super) fn fit<T>(items: &mut Vec<T>) {
    let count = items.len();
    if items.capacity() > count + count / WASTE {
        items.shrink_to(count + count / GROWTH);
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn keys(count: usize) -> impl Strategy<Value = Vec<Key>> {
        let key = (0..8_u32, 0..8_u32, 0..2_u32).prop_map(|(a, b, part_b)| Key { a, b, part_a: 0, part_b });
        prop::collection::btree_set(key, 0..count).prop_map(|keys| keys.into_iter().collect())
    }

    /// A list of these, of which each has a stamp of its own.
    fn list(keys: &[Key]) -> Pairs {
        let mut list = Pairs::default();
        list.replace(keys, &mut Pairs::default());
        (0..).zip(&mut list.pairs).for_each(|(stamp, pair)| pair.stamp = stamp);
        list
    }

    proptest! {
        /// However a list is made anew, what was in it is as it was, and the rest begins.
        #[test]
        fn what_stays_keeps_its_contact(old in keys(60), new in keys(60), listed in prop::collection::vec(any::<bool>(), 8)) {
            let is_listed = |key: &Key| listed[key.a as usize] || listed[key.b as usize];
            let stays = |key: &&Key| !is_listed(key);
            let mut expected: Vec<Key> = old.iter().filter(stays).chain(new.iter().filter(|key| is_listed(key))).copied().collect();
            expected.sort_unstable();
            let listed_keys: Vec<Key> = new.iter().filter(|key| is_listed(key)).copied().collect();
            let mut some = list(&old);
            some.replace_some(&listed, &listed_keys);
            let mut all = list(&old);
            all.replace(&expected, &mut Pairs::default());
            prop_assert_eq!(&some, &all);
            for (index, key) in expected.iter().enumerate() {
                prop_assert_eq!(some.key(index), *key);
                let stamp = old.binary_search(key).map_or(NEVER, |stamp| stamp as u32);
                prop_assert_eq!(some.pairs[index].stamp, stamp);
            }
        }
    }
}
