//! The paper's ordered relaxation lists (6.2): a body's sticks by graph distance from a particle.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::Stick;
use crate::order::PutInOrder;

/// For every particle v of a body the list C_v of all its sticks, nearest first and the near ones repeated.
///
/// A stick at distance k = 1, …, n from v (k = 1: incident to v) occurs max(1, ⌊n/k⌋) times. A stick repeated
/// right after itself would do nothing, so C_v is laid out in rounds: round r = 1, …, n holds, nearest first,
/// every stick that occurs at least r times. Sticks that v does not reach come last, once.
///
/// The lists are made beforehand, as in the paper, unless the body is so large that they would take more
/// memory than everything else: then each is made when it is asked for.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct OrderedLists {
    /// The lists of all particles, one after another: indices into the body's sticks.
    entries: Vec<u32>,
    /// Where the list of each particle starts in `entries`, and a last one for the end; empty for a large body.
    starts: Vec<u32>,
}

/// Particles times sticks above which lists are made when asked for.
const LARGE: usize = 2_000_000;

impl OrderedLists {
    pub(crate) fn new(particle_count: usize, sticks: &[Stick]) -> Self {
        if particle_count.saturating_mul(sticks.len()) > LARGE {
            return Self::default();
        }
        let (mut entries, mut starts) = (Vec::new(), vec![0]);
        for particle in 0..particle_count {
            append_list(particle as u32, particle_count, sticks, &mut entries);
            starts.push(entries.len() as u32);
        }
        Self { entries, starts }
    }

    /// C_v of the body that the lists are of: indices into its sticks; empty if there is no such particle.
    pub(crate) fn list(&self, particle: usize, particle_count: usize, sticks: &[Stick]) -> Cow<'_, [u32]> {
        match self.starts.get(particle..=particle + 1) {
            Some(&[start, end]) => Cow::Borrowed(&self.entries[start as usize..end as usize]),
            _ if particle < particle_count => {
                let mut list = Vec::new();
                append_list(particle as u32, particle_count, sticks, &mut list);
                Cow::Owned(list)
            }
            _ => Cow::Borrowed(&[]),
        }
    }

    pub(crate) fn is_valid(&self, particle_count: usize, stick_count: usize) -> bool {
        let made = self.starts.len() == particle_count + 1
            && self.starts[0] == 0
            && self.starts.is_sorted()
            && self.starts[particle_count] as usize == self.entries.len();
        let empty = self.starts.is_empty() && self.entries.is_empty();
        (made || empty) && self.entries.iter().all(|&stick| (stick as usize) < stick_count)
    }
}

fn append_list(particle: u32, particle_count: usize, sticks: &[Stick], entries: &mut Vec<u32>) {
    let distance = stick_distances(particle, particle_count, sticks);
    let farthest = distance.iter().flatten().copied().max().unwrap_or(1);
    let mut nearest_first: Vec<u32> = (0..sticks.len() as u32).collect();
    nearest_first.put_in_order_by_key(|&stick| distance[stick as usize].unwrap_or(u32::MAX));
    let occurrences = |stick: u32| distance[stick as usize].map_or(1, |k| (farthest / k).max(1));
    for round in 1..=farthest {
        entries.extend(nearest_first.iter().copied().filter(|&stick| occurrences(stick) >= round));
    }
}

/// k of every stick: 1 + the number of sticks on the shortest path from `particle` to its nearer end.
fn stick_distances(particle: u32, particle_count: usize, sticks: &[Stick]) -> Vec<Option<u32>> {
    let mut distance = vec![None; particle_count];
    distance[particle as usize] = Some(0);
    let mut reached = 0;
    // Bodies have few sticks and small diameters: a pass over all sticks per ring is simple and quick enough.
    loop {
        let mut grown = false;
        for stick in sticks {
            for (from, to) in [(stick.a, stick.b), (stick.b, stick.a)] {
                if distance[from as usize] == Some(reached) && distance[to as usize].is_none() {
                    distance[to as usize] = Some(reached + 1);
                    grown = true;
                }
            }
        }
        if !grown {
            break;
        }
        reached += 1;
    }
    let nearer = |stick: &Stick| match (distance[stick.a as usize], distance[stick.b as usize]) {
        (Some(a), Some(b)) => Some(1 + a.min(b)),
        _ => None,
    };
    sticks.iter().map(nearer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stick(a: u32, b: u32) -> Stick {
        Stick { a, b, rest_length: 1.0 }
    }

    /// A body with the distances of the paper's figure 7, v being particle 0: c1 … c7 are sticks 0 … 6.
    fn figure_7() -> Vec<Stick> {
        vec![stick(0, 1), stick(1, 2), stick(2, 4), stick(1, 4), stick(0, 5), stick(5, 2), stick(5, 3)]
    }

    #[test]
    fn figure_7_lists_near_sticks_first_and_repeats_them() {
        let lists = OrderedLists::new(6, &figure_7());
        let list = lists.list(0, 6, &figure_7());
        // k: c1, c5 → 1; c2, c4, c6, c7 → 2; c3 → 3. n = 3, so that only k = 1 repeats.
        assert_eq!(*list, [0, 4, 1, 3, 5, 6, 2, 0, 4, 0, 4]);
        assert_eq!(OrderedLists::default().list(0, 6, &figure_7()), list, "made when asked for");
    }

    #[test]
    fn every_stick_occurs_as_often_as_the_paper_says() {
        let chain: Vec<Stick> = (0..12).map(|i| stick(i, i + 1)).collect();
        let lists = OrderedLists::new(13, &chain);
        let list = lists.list(0, 13, &chain);
        for (index, k) in (1..=12).enumerate() {
            let count = list.iter().filter(|&&s| s as usize == index).count();
            assert_eq!(count, (12 / k).max(1), "stick at distance {k}");
        }
        assert!(lists.is_valid(13, 12));
        let rounds = list.iter().filter(|&&stick| stick == 0).count();
        assert!(list[..rounds].is_sorted(), "the first round is nearest first");
    }

    #[test]
    fn sticks_out_of_reach_are_still_listed() {
        let sticks = [stick(2, 3), stick(0, 1)];
        let lists = OrderedLists::new(4, &sticks);
        assert_eq!(*lists.list(0, 4, &sticks), [1, 0]);
        assert!(lists.list(9, 4, &sticks).is_empty());
        assert!(OrderedLists::new(1, &[]).list(0, 1, &[]).is_empty());
    }
}
