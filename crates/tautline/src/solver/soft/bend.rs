//! Resistance to bending along lines of particles: three that follow each other want to be in line.
//!
//! For three particles a, b, c at the distance e from each other, |a − 2b + c| = 2e sin(θ/2) ≈ e θ with θ the angle they
//! turn by. So the energy of bending ½ k θ² is that of the vector constraint C = a − 2b + c with the compliance e²/k. C
//! takes no square root, is 0 in flat and stretched sheets alike, and turning or shifting all changes nothing in |C|, so
//! that momentum and angular momentum are kept. For a strip of width b and flexural rigidity B, k = B b/e.

use super::points::{Moving, MovingEights, eights};
use crate::simd::{LANES, Lanes};

/// Lines of particles side by side, as `Threads`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lines {
    pub(super) start: usize,
    pub(super) stride: usize,
    pub(super) knots: usize,
    pub(super) count: usize,
    /// α/h², in 1/kg.
    pub(super) compliance: f32,
}

impl Lines {
    /// Bends every line at every inner knot once; of three knots that follow each other, each in its own colour.
    #[inline(always)]
    pub(super) fn straighten<L: Lanes>(&self, moving: &mut Moving<'_>, masses: &[f32]) {
        let (mut knots, masses) = (moving.eights(), eights(masses));
        let (start, stride, count) = (self.start / LANES, self.stride / LANES, self.count / LANES);
        for colour in 0..3 {
            for knot in (1 + colour..self.knots.saturating_sub(1)).step_by(3) {
                let first = start + knot * stride;
                for eight in first..first + count {
                    let places = [eight - stride, eight, eight + stride];
                    straighten_eight::<L>(&mut knots, masses, places, L::splat(self.compliance));
                }
            }
        }
    }
}

/// λ = −C/max(α/h², w_a + 4 w_b + w_c): as an explicit force as long as that is stable, whose stiffness is exact; and a
/// projection where it would not be. The usual sum of both makes what is stiff softer than it is asked to be.
#[inline(always)]
fn straighten_eight<L: Lanes>(
    knots: &mut MovingEights<'_>,
    masses: &[[f32; LANES]],
    [a, b, c]: [usize; 3],
    compliance: L,
) {
    let masses = [L::read(&masses[a]), L::read(&masses[b]), L::read(&masses[c])];
    let (at_a, at_b, at_c) = (knots.read::<L>(a), knots.read(b), knots.read(c));
    let bend = at_a + at_c - (at_b + at_b);
    let mobility = masses[0] + masses[1] * L::splat(4.0) + masses[2];
    let is_whole = mobility.greater(L::splat(0.0));
    let multiplier = -(bend * is_whole.and(L::splat(1.0) / mobility.max(compliance)));
    knots.shift(a, at_a, multiplier * masses[0]);
    knots.shift(b, at_b, multiplier * (masses[1] * L::splat(-2.0)));
    knots.shift(c, at_c, multiplier * masses[2]);
}

#[cfg(test)]
#[path = "tests/bend.rs"]
mod tests;
