//! Sorting that need not be fast.
//!
//! The standard library's sorts are five kilobytes of code for each type and each order, and a page downloads all of it.
//! In WebAssembly what is sorted outside of hot loops is sorted by one function here, which moves indices and knows no
//! type. Both sorts are stable, and a stable sort has one result.

use std::cmp::Ordering;
use std::mem;

/// A list that can be put in order.
pub(crate) trait PutInOrder<T> {
    /// Ascending by `compare`; what is equal stays as it was.
    fn put_in_order_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering);

    /// Ascending.
    fn put_in_order(&mut self)
    where
        T: Ord,
    {
        self.put_in_order_by(T::cmp);
    }

    /// Ascending by their keys; what has the same stays as it was.
    fn put_in_order_by_key<K: Ord>(&mut self, mut key: impl FnMut(&T) -> K) {
        self.put_in_order_by(|a, b| key(a).cmp(&key(b)));
    }

    /// As [`put_in_order_by_key`](Self::put_in_order_by_key), with keys that take long: each is asked for once.
    fn put_in_order_by_cached_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
}

impl<T> PutInOrder<T> for [T] {
    fn put_in_order_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering) {
        if cfg!(target_family = "wasm") { sort_small(self, compare) } else { self.sort_by(compare) }
    }

    fn put_in_order_by_cached_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K) {
        if cfg!(target_family = "wasm") { sort_small_by_key(self, key) } else { self.sort_by_cached_key(key) }
    }
}

/// What there is of this for every type.
fn sort_small<T>(list: &mut [T], mut compare: impl FnMut(&T, &T) -> Ordering) {
    let order = sorted(list.len(), &mut |a, b| compare(&list[a], &list[b]) == Ordering::Less);
    arrange(list, order);
}

fn sort_small_by_key<T, K: Ord>(list: &mut [T], key: impl FnMut(&T) -> K) {
    let keys: Vec<K> = list.iter().map(key).collect();
    let order = sorted(list.len(), &mut |a, b| keys[a] < keys[b]);
    arrange(list, order);
}

/// Moves the item of the first index to the first place, and so on.
fn arrange<T>(list: &mut [T], mut order: Vec<usize>) {
    // Each cycle of places through which its items move.
    for start in 0..order.len() {
        let mut place = start;
        while order[place] != start {
            let from = mem::replace(&mut order[place], place);
            list.swap(place, from);
            place = from;
        }
        order[place] = place;
    }
}

/// The indices of `count` items in their order: runs are merged, twice as long each time.
fn sorted(count: usize, is_less: &mut dyn FnMut(usize, usize) -> bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut merged = order.clone();
    let mut run = 1;
    while run < count {
        for (two, merged) in order.chunks(2 * run).zip(merged.chunks_mut(2 * run)) {
            let (mut left, mut right) = two.split_at(run.min(two.len()));
            for slot in merged {
                let next = match (left, right) {
                    // Of two that are equal the left one.
                    ([a, ..], [b, ..]) if is_less(*b, *a) => &mut right,
                    ([], _) => &mut right,
                    _ => &mut left,
                };
                if let [first, rest @ ..] = *next {
                    (*slot, *next) = (*first, rest);
                }
            }
        }
        mem::swap(&mut order, &mut merged);
        run *= 2;
    }
    order
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_small_sort_does_what_that_of_the_library_does(
            list in prop::collection::vec((0..20_u32, any::<u32>()), 0..200),
        ) {
            let (mut small, mut by_key, mut expected) = (list.clone(), list.clone(), list);
            sort_small(&mut small, |a, b| a.0.cmp(&b.0));
            sort_small_by_key(&mut by_key, |item| item.0);
            expected.sort_by_key(|item| item.0);
            prop_assert_eq!(&small, &expected);
            prop_assert_eq!(&by_key, &expected);
        }
    }
}
