//! A tree over the boxes of triangles.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Bounds {
    pub(super) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
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
pub(super) struct Tree {
    nodes: Vec<Node>,
}

struct Node {
    bounds: Bounds,
    /// The item of a leaf.
    item: u32,
    /// Where the walk goes on after all that hangs on this node.
    after: u32,
}

const NO_ITEM: u32 = u32::MAX;

impl Tree {
    /// Halves the boxes along the axis that they spread most on, and the halves again.
    pub(super) fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(2 * boxes.len()) };
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        if !items.is_empty() {
            tree.grow(boxes, &mut items);
        }
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

    /// Every item whose box overlaps this one, until `visit` says that it is enough.
    pub(super) fn overlapping(&self, bounds: &Bounds, mut visit: impl FnMut(u32) -> bool) {
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

    #[test]
    fn what_overlaps_is_found_once() {
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 16) / 65536.0
        };
        let mut point = || DVec3::new(random(), random(), random());
        let boxes: Vec<Bounds> = (0..300)
            .map(|_| {
                let corner = point();
                Bounds::around([corner, corner + 0.2 * point()])
            })
            .collect();
        let tree = Tree::new(&boxes);
        for bounds in &boxes {
            let mut found = Vec::new();
            tree.overlapping(bounds, |item| {
                found.push(item);
                true
            });
            found.sort_unstable();
            let expected: Vec<u32> = (0..300).filter(|&i| boxes[i as usize].overlaps(bounds)).collect();
            assert_eq!(found, expected);
        }
    }
}
