//! Axis-aligned boxes, and the pairs of them that overlap.

use glam::DVec3;

use crate::order::PutInOrder;

/// The smallest box around some points.
#[derive(Clone, Copy)]
pub(super) struct Aabb {
    pub(super) min: DVec3,
    pub(super) max: DVec3,
}

impl Aabb {
    pub(super) fn around(points: &[DVec3], corners: &[u32]) -> Aabb {
        let nothing = Aabb { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        corners
            .iter()
            .map(|&i| points[i as usize])
            .fold(nothing, |b, p| Aabb { min: b.min.min(p), max: b.max.max(p) })
    }

    pub(super) fn overlaps(&self, other: &Aabb) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    pub(super) fn contains(&self, other: &Aabb) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }
}

/// Calls `visit(i, j)` for every box i of `a` that overlaps box j of `b`: a sweep along x.
pub(super) fn overlapping_pairs(a: &[Aabb], b: &[Aabb], mut visit: impl FnMut(usize, usize)) {
    let starts = |boxes: &[Aabb]| {
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        order.put_in_order_by(|&i, &j| boxes[i].min.x.total_cmp(&boxes[j].min.x));
        order
    };
    let (order_a, order_b) = (starts(a), starts(b));
    let (mut open_a, mut open_b) = (Vec::new(), Vec::new());
    let (mut next_a, mut next_b) = (0, 0);
    while next_a < order_a.len() || next_b < order_b.len() {
        let from_a = next_b == order_b.len()
            || (next_a < order_a.len() && a[order_a[next_a]].min.x <= b[order_b[next_b]].min.x);
        if from_a {
            let i = order_a[next_a];
            next_a += 1;
            open_b.retain(|&j: &usize| b[j].max.x >= a[i].min.x);
            open_b.iter().filter(|&&j| a[i].overlaps(&b[j])).for_each(|&j| visit(i, j));
            open_a.push(i);
        } else {
            let j = order_b[next_b];
            next_b += 1;
            open_a.retain(|&i: &usize| a[i].max.x >= b[j].min.x);
            open_a.iter().filter(|&&i| a[i].overlaps(&b[j])).for_each(|&i| visit(i, j));
            open_b.push(j);
        }
    }
}
