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
pub(super) struct Lines<'a> {
    pub(super) start: usize,
    pub(super) stride: usize,
    pub(super) knots: usize,
    pub(super) count: usize,
    /// α/h² of every line, in 1/kg.
    pub(super) compliances: &'a [f32],
}

impl Lines<'_> {
    /// Bends every line at every inner knot once; of three knots that follow each other, each in its own colour.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn straighten<L: Lanes>(&self, moving: &mut Moving<'_>, masses: &[f32]) {
        let (mut knots, masses, compliances) = (moving.eights(), eights(masses), eights(self.compliances));
        let (start, stride, count) = (self.start / LANES, self.stride / LANES, self.count / LANES);
        for colour in 0..3 {
            for knot in (1 + colour..self.knots.saturating_sub(1)).step_by(3) {
                let first = start + knot * stride;
                for (eight, compliance) in (first..first + count).zip(compliances) {
                    let places = [eight - stride, eight, eight + stride];
                    straighten_eight::<L>(&mut knots, masses, places, L::read(compliance));
                }
            }
        }
    }
}

/// λ = −C/max(α/h² + M/2, M) with M = w_a + 4 w_b + w_c: a force as long as that is stable, and a projection where it would
/// not be. Of the knots around one, half are straightened before it in a pass, and leave it more bent by M/2 times their λ
/// than it will be; so that with M/2 its stiffness is as asked on the mean, where the usual M would make it softer.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn straighten_eight<L: Lanes>(
    knots: &mut MovingEights<'_>,
    masses: &[[f32; LANES]],
    [a, b, c]: [usize; 3],
    compliance: L,
) {
    let masses = [L::read(&masses[a]), L::read(&masses[b]), L::read(&masses[c])];
    let [from_a, off_a] = knots.read::<L>(a);
    let ([from_b, off_b], [from_c, off_c]) = (knots.read(b), knots.read(c));
    let bend = ((from_a - from_b) + (from_c - from_b)) + ((off_a - off_b) + (off_c - off_b));
    let mobility = masses[0] + masses[1] * L::splat(4.0) + masses[2];
    let is_whole = mobility.greater(L::splat(0.0));
    let multiplier =
        -(bend * is_whole.and(L::splat(1.0) / mobility.max(compliance + mobility * L::splat(0.5))));
    knots.write(a, off_a + multiplier * masses[0]);
    knots.write(b, off_b - multiplier * (masses[1] * L::splat(2.0)));
    knots.write(c, off_c + multiplier * masses[2]);
}

#[cfg(test)]
#[path = "tests/bend.rs"]
mod tests;
