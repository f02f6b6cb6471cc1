//! An order of boxes in which neighbours in the list are neighbours in space.

use glam::Vec3;

use crate::collision::Aabb;
use crate::simd::LANES;

/// Boxes are halved by their centres along the axis where those spread most, and the halves again, down to groups of
/// eight. No grid and no scale is involved, so one box far away or sizes from centimetres to kilometres cost nothing,
/// and groups hold half as many false neighbours as eight in a row along a Morton curve do.
#[derive(Debug, Clone, Default)]
pub(super) struct SpatialOrder {
    indices: Vec<u32>,
    /// Scratch.
    entries: Vec<Entry>,
    /// Scratch: stretches of `entries` to be halved.
    stretches: Vec<(usize, usize)>,
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    /// Of the box, times two.
    center: Vec3,
    index: u32,
}

impl SpatialOrder {
    /// The boxes in order.
    pub(super) fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// Gives back scratch memory.
    pub(super) fn shrink(&mut self) {
        (self.entries, self.stretches) = (Vec::new(), Vec::new());
    }

    pub(super) fn arrange(&mut self, boxes: &[Aabb]) {
        self.entries.clear();
        self.entries.extend((0..).zip(boxes).map(|(index, b)| Entry { center: b.low + b.high, index }));
        self.stretches.clear();
        self.stretches.push((0, boxes.len()));
        while let Some((start, end)) = self.stretches.pop() {
            let stretch = &mut self.entries[start..end];
            if stretch.len() <= LANES {
                continue;
            }
            // At a power of two, so that nodes of every level begin at a cut.
            let cut = stretch.len().next_power_of_two() / 2;
            divide(stretch, cut);
            self.stretches.extend([(start, start + cut), (start + cut, end)]);
        }
        self.indices.clear();
        self.indices.extend(self.entries.iter().map(|entry| entry.index));
    }
}

/// Puts the `cut` lowest along the widest axis first. Of equal ones the lower index is lower.
fn divide(entries: &mut [Entry], cut: usize) {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = entries.iter().fold(none, |(low, high), e| (low.min(e.center), high.max(e.center)));
    let axis = (high - low).max_position();
    entries.select_nth_unstable_by(cut, |a, b| {
        a.center[axis].total_cmp(&b.center[axis]).then(a.index.cmp(&b.index))
    });
}
