//! Pairs of bodies that may touch, and what is remembered of them from step to step.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Two bodies whose boxes overlap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pair {
    /// Index of the body that was added first.
    pub(crate) a: u32,
    /// Index of the other.
    pub(crate) b: u32,
    /// From A to B: what separated them last, or their contact normal; zero = unknown.
    pub(crate) axis: Vec3,
    /// False once two bodies have been found apart, or not both rigid, in this substep.
    pub(crate) may_touch: bool,
}

/// The pairs of the last substep, ascending.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct PairCache {
    pub(crate) pairs: Vec<Pair>,
    #[serde(skip)]
    previous: Vec<Pair>,
}

impl PairCache {
    /// Takes over the new pairs (ascending), each with what is known of it.
    pub(crate) fn update(&mut self, found: &[(u32, u32)]) {
        std::mem::swap(&mut self.pairs, &mut self.previous);
        self.pairs.clear();
        let mut known = self.previous.iter().peekable();
        for &(a, b) in found {
            while known.next_if(|pair| (pair.a, pair.b) < (a, b)).is_some() {}
            let axis = known.next_if(|pair| (pair.a, pair.b) == (a, b)).map_or(Vec3::ZERO, |pair| pair.axis);
            self.pairs.push(Pair { a, b, axis, may_touch: true });
        }
    }

    pub(crate) fn is_valid(&self, body_count: usize) -> bool {
        let sound = |pair: &Pair| pair.a < pair.b && (pair.b as usize) < body_count && pair.axis.is_finite();
        self.pairs.iter().all(sound) && self.pairs.is_sorted_by(|x, y| (x.a, x.b) < (y.a, y.b))
    }

    /// Forgets a body; those behind it move down by one.
    pub(crate) fn remove_body(&mut self, body: u32) {
        self.pairs.retain(|pair| pair.a != body && pair.b != body);
        for pair in &mut self.pairs {
            pair.a -= u32::from(pair.a > body);
            pair.b -= u32::from(pair.b > body);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_keeps_its_axis_while_it_lasts() {
        let mut cache = PairCache::default();
        cache.update(&[(0, 1), (0, 3), (2, 3)]);
        cache.pairs[1].axis = Vec3::X;
        cache.pairs[2].axis = Vec3::Y;
        cache.update(&[(0, 2), (0, 3), (1, 2), (2, 3)]);
        let axes: Vec<Vec3> = cache.pairs.iter().map(|pair| pair.axis).collect();
        assert_eq!(axes, [Vec3::ZERO, Vec3::X, Vec3::ZERO, Vec3::Y]);
        cache.remove_body(1);
        let bodies: Vec<(u32, u32)> = cache.pairs.iter().map(|pair| (pair.a, pair.b)).collect();
        assert_eq!(bodies, [(0, 1), (0, 2), (1, 2)]);
        assert_eq!(cache.pairs[2].axis, Vec3::Y);
    }
}
