//! Pairs of bodies whose boxes overlap.

use glam::{Mat3, Vec3};

use crate::order::PutInOrder;
use crate::settings::BroadPhase;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Aabb {
    pub(crate) low: Vec3,
    pub(crate) high: Vec3,
}

impl Aabb {
    /// The smallest box around points, grown by `margin` on all sides (m).
    pub(crate) fn around(points: &[Vec3], margin: f32) -> Self {
        let (low, high) = points.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &point| {
            (low.min(point), high.max(point))
        });
        Self { low: low - margin, high: high + margin }
    }

    /// The smallest box around a box that is turned, from `low` to `high` in a frame with these axes.
    pub(crate) fn around_turned(center: Vec3, axes: &Mat3, low: Vec3, high: Vec3) -> Self {
        let (middle, half) = (center + *axes * ((low + high) * 0.5), (high - low) * 0.5);
        let reach = axes.x_axis.abs() * half.x + axes.y_axis.abs() * half.y + axes.z_axis.abs() * half.z;
        Self { low: middle - reach, high: middle + reach }
    }

    /// Larger on all sides, by so much (m).
    pub(crate) fn grown(&self, by: f32) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// A body's box, and whether it can move: two that cannot are no pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    pub(crate) body: u32,
    pub(crate) bounds: Aabb,
    pub(crate) awake: bool,
}

/// Writes the pairs (lower body, higher body) of overlapping boxes of which at least one is awake, ascending.
pub(crate) fn find_pairs(candidates: &mut [Candidate], method: BroadPhase, pairs: &mut Vec<(u32, u32)>) {
    pairs.clear();
    match method {
        BroadPhase::AllPairs => all_pairs(candidates, pairs),
        BroadPhase::SortAndSweep => sort_and_sweep(candidates, pairs),
    }
    pairs.put_in_order();
}

fn all_pairs(candidates: &[Candidate], pairs: &mut Vec<(u32, u32)>) {
    for (index, a) in candidates.iter().enumerate() {
        for b in &candidates[index + 1..] {
            add_if_overlapping(a, b, pairs);
        }
    }
}

fn sort_and_sweep(candidates: &mut [Candidate], pairs: &mut Vec<(u32, u32)>) {
    let axis = widest_axis(candidates);
    candidates
        .put_in_order_by(|a, b| a.bounds.low[axis].total_cmp(&b.bounds.low[axis]).then(a.body.cmp(&b.body)));
    for (index, a) in candidates.iter().enumerate() {
        let reached = |b: &&Candidate| b.bounds.low[axis] <= a.bounds.high[axis];
        for b in candidates[index + 1..].iter().take_while(reached) {
            add_if_overlapping(a, b, pairs);
        }
    }
}

fn add_if_overlapping(a: &Candidate, b: &Candidate, pairs: &mut Vec<(u32, u32)>) {
    if (a.awake || b.awake) && a.bounds.overlaps(&b.bounds) {
        pairs.push((a.body.min(b.body), a.body.max(b.body)));
    }
}

/// The axis along which the boxes' centres vary most.
fn widest_axis(candidates: &[Candidate]) -> usize {
    let centers = || candidates.iter().map(|c| (c.bounds.low + c.bounds.high).as_dvec3());
    let count = candidates.len().max(1) as f64;
    let mean = centers().sum::<glam::DVec3>() / count;
    let variance: glam::DVec3 = centers().map(|c| (c - mean) * (c - mean)).sum();
    if variance.x >= variance.y && variance.x >= variance.z {
        0
    } else if variance.y >= variance.z {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn sort_and_sweep_finds_what_all_pairs_finds(
            boxes in prop::collection::vec((prop::array::uniform3(-5.0f32..5.0), 0.1f32..2.0, any::<bool>()), 0..60)
        ) {
            let mut candidates: Vec<Candidate> = boxes
                .iter()
                .enumerate()
                .map(|(body, &(center, size, awake))| Candidate {
                    body: body as u32,
                    bounds: Aabb::around(&[Vec3::from(center)], size),
                    awake,
                })
                .collect();
            let (mut all, mut swept) = (Vec::new(), Vec::new());
            find_pairs(&mut candidates, BroadPhase::AllPairs, &mut all);
            find_pairs(&mut candidates, BroadPhase::SortAndSweep, &mut swept);
            prop_assert_eq!(all, swept);
        }
    }
}
