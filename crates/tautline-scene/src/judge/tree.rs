//! A tree over boxes: which of them overlap. It does not mind how they lie, so that a thousand boxes in one plane, or
//! with one x, take no longer than any others.

use tautline::Vec3;

/// A box in the axes of the world; its faces belong to it. In `f32`, as the positions it is around, so that it is exact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    /// The smallest around some points.
    pub(super) fn around(points: &[Vec3]) -> Self {
        let nothing = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
        points.iter().fold(nothing, |all, &point| all.joined(&Self { low: point, high: point }))
    }

    fn joined(&self, other: &Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// A binary tree with one box to a leaf, in the order of a walk: a node's first child stands right after it, and the
/// second after all that hangs on the first.
pub(super) struct Tree {
    nodes: Vec<Node>,
}

struct Node {
    bounds: Bounds,
    below: Below,
}

#[derive(Clone, Copy)]
enum Below {
    /// The number of the box.
    Leaf(u32),
    /// Where the second child stands.
    Second(u32),
}

impl Tree {
    /// Halves the boxes along the axis that their middles spread most on, and the halves again.
    pub(super) fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(2 * boxes.len()) };
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        if !items.is_empty() {
            tree.grow(boxes, &mut items);
        }
        tree
    }

    fn grow(&mut self, boxes: &[Bounds], items: &mut [u32]) {
        let bounds = |item: &u32| boxes[*item as usize];
        if let [item] = items {
            self.nodes.push(Node { bounds: bounds(item), below: Below::Leaf(*item) });
            return;
        }
        let node = self.nodes.len();
        let all = items[1..].iter().fold(bounds(&items[0]), |all, item| all.joined(&bounds(item)));
        // Twice the middles: only their order counts.
        let middle = |item: &u32| bounds(item).low + bounds(item).high;
        let (least, most) =
            items.iter().map(middle).fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, most), middle| {
                (least.min(middle), most.max(middle))
            });
        let axis = (most - least).max_position();
        let half = items.len() / 2;
        let by_place = |a: &u32, b: &u32| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(b));
        items.select_nth_unstable_by(half, by_place);
        let (first, second) = items.split_at_mut(half);
        self.nodes.push(Node { bounds: all, below: Below::Second(0) });
        self.grow(boxes, first);
        self.nodes[node].below = Below::Second(self.nodes.len() as u32);
        self.grow(boxes, second);
    }

    /// Every two boxes that overlap, once.
    pub(super) fn pairs(&self, visit: &mut impl FnMut(u32, u32)) {
        for (node, Node { below, .. }) in self.nodes.iter().enumerate() {
            if let Below::Second(second) = *below {
                self.pairs_between(node + 1, second as usize, visit);
            }
        }
    }

    fn pairs_between(&self, a: usize, b: usize, visit: &mut impl FnMut(u32, u32)) {
        let (first, second) = (&self.nodes[a], &self.nodes[b]);
        if !first.bounds.overlaps(&second.bounds) {
            return;
        }
        match (first.below, second.below) {
            (Below::Leaf(a), Below::Leaf(b)) => visit(a, b),
            (Below::Leaf(_), Below::Second(after)) => {
                self.pairs_between(a, b + 1, visit);
                self.pairs_between(a, after as usize, visit);
            }
            (Below::Second(after), Below::Leaf(_)) => {
                self.pairs_between(a + 1, b, visit);
                self.pairs_between(after as usize, b, visit);
            }
            // Both are as large, or nearly: both are opened at once.
            (Below::Second(after_a), Below::Second(after_b)) => {
                for a in [a + 1, after_a as usize] {
                    for b in [b + 1, after_b as usize] {
                        self.pairs_between(a, b, visit);
                    }
                }
            }
        }
    }

    /// Every box that overlaps this one.
    pub(super) fn overlapping(&self, bounds: &Bounds, visit: &mut impl FnMut(u32)) {
        let mut node = 0;
        let mut waiting = Vec::new();
        while let Some(Node { bounds: at, below }) = self.nodes.get(node) {
            let next = match below {
                _ if !at.overlaps(bounds) => None,
                Below::Leaf(item) => {
                    visit(*item);
                    None
                }
                Below::Second(second) => {
                    waiting.push(*second as usize);
                    Some(node + 1)
                }
            };
            let Some(next) = next.or_else(|| waiting.pop()) else { return };
            node = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn boxes(count: usize, flatten: Vec3) -> Vec<Bounds> {
        let mut random = Random::new(count as u64);
        let mut point = || random.in_cube(1.0) * flatten;
        (0..count)
            .map(|_| {
                let middle = point();
                Bounds::around(&[middle + 0.1 * point(), middle + 0.1 * point()])
            })
            .collect()
    }

    #[test]
    fn every_overlapping_pair_is_found_once() {
        for (count, flatten) in
            [(0, Vec3::ONE), (1, Vec3::ONE), (2, Vec3::ZERO), (300, Vec3::ONE), (300, Vec3::X)]
        {
            let boxes = boxes(count, flatten);
            let tree = Tree::new(&boxes);
            let mut expected = Vec::new();
            for b in 0..count {
                expected
                    .extend((0..b).filter(|&a| boxes[a].overlaps(&boxes[b])).map(|a| (a as u32, b as u32)));
            }
            let mut found = Vec::new();
            tree.pairs(&mut |a, b| found.push((a.min(b), a.max(b))));
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected, "{count} boxes, {flatten}");
            for (i, bounds) in boxes.iter().enumerate() {
                let mut found = Vec::new();
                tree.overlapping(bounds, &mut |item| found.push(item as usize));
                found.sort_unstable();
                let expected: Vec<usize> = (0..count).filter(|&j| boxes[j].overlaps(bounds)).collect();
                assert_eq!(found, expected, "box {i}");
            }
        }
    }
}
