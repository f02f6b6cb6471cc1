use glam::Vec3;

use super::*;
use crate::simd::{Instructions, Kernel, Numbers, run};
use crate::solver::soft::bend::Lines;
use crate::solver::soft::points::{get, set};
use crate::solver::soft::tests::moved;

struct Straighten<'a>(Lines<'a>, &'a Coordinates, &'a [f32]);

impl Kernel for Straighten<'_> {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        moved(self.1.clone(), |moving| self.0.straighten::<L>(moving, self.2))
    }
}

/// A strip that is rolled to a curvature κ carries the moment B κ per width: at its end that is a force times an edge. The
/// first colour moves the first knot by F w (2h)²/2, since lines are straightened in every second small step.
#[test]
fn a_rolled_strip_has_the_bending_moment_of_a_plate() {
    let (rigidity, curvature, h) = (0.02_f32, 0.8_f32, 1e-3_f32);
    let (along, down) = (0.05_f32, 0.08_f32);
    let knots = 12;
    for (compliance, edge, width) in
        [0, 1].map(|k| (bending_of(rigidity, [along, down], h)[k], [along, down][k], [down, along][k]))
    {
        let lines = Lines { start: 0, stride: LANES, knots, count: LANES, compliances: &[compliance; LANES] };
        let mut positions: Coordinates = std::array::from_fn(|_| Numbers::zeros(knots * LANES));
        for knot in 0..knots {
            let angle = curvature * edge * knot as f32;
            let at = Vec3::new(angle.sin(), 1.0 - angle.cos(), 0.0) / curvature;
            (0..LANES).for_each(|lane| set(&mut positions, knot * LANES + lane, at));
        }
        let masses = vec![compliance * 0.1; knots * LANES];
        let after = run(Instructions::Baseline, Straighten(lines, &positions, &masses));
        let moved = get(&after, 0).distance(get(&positions, 0));
        // Half the mobility, 0.6 of the compliance, is added to it for the knots that are straightened later.
        let moment = 1.3 * moved / (masses[0] * 2.0 * h * h) * edge;
        let expected = rigidity * curvature * width;
        assert!((moment / expected - 1.0).abs() < 5e-3, "{moment} N m instead of {expected}");
    }
}
