//! Sticks one after another, all solved together: rows and columns of a sheet, and ropes, eight side by side.
//!
//! For sticks with the directions n_j and the excess lengths C_j, whose ends are moved along u_j, the directions when the
//! small step began (as `stick::pull` does), the corrections w (λ_j u_j − λ_{j+1} u_{j+1}) that end all C at once to first
//! order are those of the tridiagonal system
//! ((w_j + w_{j+1}) n_j·u_j + ε) λ_j − w_j n_j·u_{j−1} λ_{j−1} − w_{j+1} n_j·u_{j+1} λ_{j+1} = −C_j. Elimination takes one
//! pass down and one up. The regularisation ε, a share of a particle's inverse mass, keeps folds from being pulled straight
//! at once; it lets threads give, so that a sweep over the sticks has to follow.

use super::points::{Moving, MovingEights, eights};
use super::stick::SpanAt;
use crate::simd::{LANES, Lanes, Row, Vec3x8};

/// ε over the inverse mass of a particle.
pub(super) const REGULARISATION: f32 = 0.01;

/// Threads side by side: the first knots of all stand next to each other, and so on from knot to knot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Threads<S> {
    /// The place of the first knot of the first thread, a multiple of eight, as the next.
    pub(super) start: usize,
    /// Places from knot to knot.
    pub(super) stride: usize,
    pub(super) knots: usize,
    /// How many there are, a multiple of eight; some may weigh nothing.
    pub(super) count: usize,
    pub(super) spans: S,
    /// ε, in 1/kg.
    pub(super) regularisation: f32,
}

/// What is remembered of eight sticks side by side on the way down: λ_j = remainder + ratio λ_{j+1}.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pivot {
    /// Along what its ends are moved.
    direction: [Row; 3],
    remainder: Row,
    ratio: Row,
}

impl<S> Threads<S> {
    /// Solves all threads. `pivots` is memory.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn solve<L: Lanes>(&self, moving: &mut Moving<'_>, masses: &[f32], pivots: &mut Vec<Pivot>)
    where
        S: SpanAt<L>,
    {
        let (mut knots, masses) = (moving.eights(), eights(masses));
        for first in self.start / LANES..(self.start + self.count) / LANES {
            self.eliminate(&knots, masses, first, pivots);
            self.substitute::<L>(&mut knots, masses, first, pivots);
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn eliminate<L: Lanes>(
        &self,
        knots: &MovingEights<'_>,
        masses: &[[f32; LANES]],
        first: usize,
        pivots: &mut Vec<Pivot>,
    ) where
        S: SpanAt<L>,
    {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let stride = self.stride / LANES;
        let (mut above, mut mass) = (knots.read::<L>(first), L::read(&masses[first]));
        // Of the stick above: its direction, and along what its ends are moved.
        let (mut direction, mut push) = (Vec3x8::zero(), Vec3x8::zero());
        let (mut remainder, mut inverse) = (zero, zero);
        pivots.clear();
        for stick in 0..self.knots - 1 {
            let eight = first + (stick + 1) * stride;
            let (below, next_mass) = (knots.read(eight), L::read(&masses[eight]));
            let before = below[0] - above[0];
            let between = before + (below[1] - above[1]);
            let squared = between.length_squared().max(L::splat(1e-24));
            let (length, is_steady) = (squared.sqrt(), between.dot(before).greater(squared * L::splat(0.5)));
            let spans = self.spans.span(stick);
            let free = mass + next_mass;
            let is_free = free.greater(zero);
            let excess = is_free.and(length - length.max(spans.low).min(spans.high));
            let per_length = is_free.and(one / length);
            let next = between * per_length;
            let next_push = Vec3x8::select(is_steady, before, between) * per_length;
            // Minus the elements beside the diagonal: of the stick above, and of this one.
            let (right, left) = (mass * direction.dot(next_push), mass * push.dot(next));
            let ratio = right * inverse;
            if let Some(last) = pivots.last_mut() {
                ratio.store(&mut last.ratio);
            }
            let diagonal = free * next.dot(next_push) + L::splat(self.regularisation) + spans.compliance;
            inverse = one / (diagonal - left * ratio);
            remainder = (left * remainder - excess) * inverse;
            let mut pivot = Pivot { direction: [Row::ZERO; 3], remainder: Row::ZERO, ratio: Row::ZERO };
            next_push.store(&mut pivot.direction);
            remainder.store(&mut pivot.remainder);
            pivots.push(pivot);
            (above, mass, direction, push) = (below, next_mass, next, next_push);
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn substitute<L: Lanes>(
        &self,
        knots: &mut MovingEights<'_>,
        masses: &[[f32; LANES]],
        first: usize,
        pivots: &mut Vec<Pivot>,
    ) {
        let (mut multiplier, mut from_below) = (L::splat(0.0), Vec3x8::<L>::zero());
        for knot in (0..self.knots).rev() {
            let from_above = match pivots.pop() {
                Some(pivot) => {
                    multiplier = L::load(&pivot.remainder) + L::load(&pivot.ratio) * multiplier;
                    Vec3x8::load(&pivot.direction) * multiplier
                }
                None => Vec3x8::zero(),
            };
            let eight = first + knot * self.stride / LANES;
            let shift = (from_above - from_below) * L::read(&masses[eight]);
            let [_, offset] = knots.read(eight);
            knots.write(eight, offset + shift);
            from_below = from_above;
        }
    }
}

#[cfg(test)]
#[path = "tests/thread.rs"]
mod tests;
