//! A tree over boxes that stay where they are: which of them overlap. It does not mind how they lie, so that a thousand
//! boxes in one plane, or with one x, take no longer than any others.

use glam::DVec3;

/// An axis-aligned box; its faces belong to it. In `f64`, so that it is exact around positions in `f32`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub low: DVec3,
    /// The one with the greatest.
    pub high: DVec3,
}

impl Bounds {
    /// The smallest around some points; around none one that overlaps nothing.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let nothing = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        points.into_iter().fold(nothing, |all, p| Self { low: all.low.min(p), high: all.high.max(p) })
    }

    fn joined(&self, other: &Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// A binary tree with one box to a leaf, in the order of a walk: a node's first child stands right after it.
#[derive(Debug, Clone)]
pub struct BoxTree {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone)]
struct Node {
    bounds: Bounds,
    /// The box of a leaf.
    item: u32,
    /// Where the walk goes on after all that hangs on this node.
    after: u32,
}

const NO_ITEM: u32 = u32::MAX;

impl BoxTree {
    /// Halves the boxes along the axis that they spread most on, and the halves again; O(n log n).
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(2 * boxes.len()) };
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        tree.grow(boxes, &mut items);
        tree
    }

    fn grow(&mut self, boxes: &[Bounds], items: &mut [u32]) {
        let bounds = items.iter().map(|&item| boxes[item as usize]).reduce(|all, one| all.joined(&one));
        let Some(bounds) = bounds else { return };
        let node = self.nodes.len();
        let item = if let [item] = *items { item } else { NO_ITEM };
        self.nodes.push(Node { bounds, item, after: 0 });
        if items.len() > 1 {
            let axis = (bounds.high - bounds.low).max_position();
            // Twice the middles: only their order counts.
            let middle = |item: u32| boxes[item as usize].low[axis] + boxes[item as usize].high[axis];
            let half = items.len() / 2;
            items.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
            let (first, second) = items.split_at_mut(half);
            self.grow(boxes, first);
            self.grow(boxes, second);
        }
        self.nodes[node].after = self.nodes.len() as u32;
    }

    /// The number of every box that overlaps this one, in no order to rely on, until `visit` says that it is enough by
    /// `false`.
    pub fn overlapping(&self, bounds: &Bounds, mut visit: impl FnMut(u32) -> bool) {
        let mut next = 0;
        while let Some(node) = self.nodes.get(next) {
            let overlaps = node.bounds.overlaps(bounds);
            if overlaps && node.item != NO_ITEM && !visit(node.item) {
                return;
            }
            next = if overlaps { next + 1 } else { node.after as usize };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(count: usize, flatten: DVec3) -> Vec<Bounds> {
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 16) / 65536.0
        };
        let mut point = || DVec3::new(random(), random(), random()) * flatten;
        (0..count)
            .map(|_| {
                let corner = point();
                Bounds::around([corner, corner + 0.2 * point()])
            })
            .collect()
    }

    #[test]
    fn what_overlaps_is_found_once() {
        let cases = [(0, DVec3::ONE), (1, DVec3::ONE), (2, DVec3::ZERO), (300, DVec3::ONE), (300, DVec3::X)];
        for (count, flatten) in cases {
            let boxes = boxes(count, flatten);
            let tree = BoxTree::new(&boxes);
            for bounds in &boxes {
                let mut found = Vec::new();
                tree.overlapping(bounds, |item| {
                    found.push(item);
                    true
                });
                found.sort_unstable();
                let all = 0..count as u32;
                let expected: Vec<u32> = all.filter(|&i| boxes[i as usize].overlaps(bounds)).collect();
                assert_eq!(found, expected, "{count} boxes, {flatten}");
            }
        }
    }

    #[test]
    fn enough_is_enough() {
        let boxes = boxes(2, DVec3::ZERO);
        let mut visits = 0;
        BoxTree::new(&boxes).overlapping(&boxes[0], |_| {
            visits += 1;
            false
        });
        assert_eq!(visits, 1);
    }
}
