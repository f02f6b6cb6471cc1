use glam::DVec3;

use super::*;
use crate::simd::{Kernel, Numbers};
use crate::solver::soft::points::{Coordinates, set};
use crate::solver::soft::tests::{cloud, farthest, in_f64, moved, noise3, on_all, weights};

const STRIDE: usize = 16;

struct Straighten(f32, usize, Coordinates, Numbers);

impl Kernel for Straighten {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let Self(compliance, knots, positions, masses) = self;
        let compliances = [compliance; 8];
        let lines = Lines { start: 8, stride: STRIDE, knots, count: 8, compliances: &compliances };
        moved(positions, |moving| lines.straighten::<L>(moving, &masses))
    }
}

/// Every inner knot once, in three colours: what is soft by a force, what is stiff by a projection.
#[test]
fn every_inner_knot_is_straightened_once() {
    for knots in 2..=12 {
        for compliance in [0.0_f32, 2.0, 5.0, 40.0] {
            let places = 8 + knots * STRIDE;
            let masses = weights(places);
            let mut expected = in_f64(&cloud(places, knots));
            let inner = (0..3).flat_map(|colour| (1 + colour..knots - 1).step_by(3));
            for (knot, lane) in inner.flat_map(|knot| (0..8).map(move |lane| (knot, lane))) {
                let [a, b, c] = [knot - 1, knot, knot + 1].map(|knot| 8 + knot * STRIDE + lane);
                let [wa, wb, wc] = [a, b, c].map(|place| f64::from(masses[place]));
                let mobility = wa + 4.0 * wb + wc;
                if mobility > 0.0 {
                    let bend = expected[a] - expected[b] * 2.0 + expected[c];
                    let multiplier = -bend / mobility.max(f64::from(compliance) + 0.5 * mobility);
                    expected[a] += multiplier * wa;
                    expected[b] -= multiplier * (2.0 * wb);
                    expected[c] += multiplier * wc;
                }
            }
            let found = on_all(|| Straighten(compliance, knots, cloud(places, knots), weights(places)));
            let off = farthest(&found, &expected);
            assert!(off < 3e-6, "{knots} knots, {compliance}: {off} m off");
        }
    }
}

/// Σ m Δx and Σ m x × Δx, about a place far off.
fn changes(
    before: &[DVec3],
    after: &[DVec3],
    masses: &[f32],
    places: impl Iterator<Item = usize>,
) -> [DVec3; 2] {
    let moved = |place: usize| (after[place] - before[place]) / f64::from(masses[place]);
    places.fold([DVec3::ZERO; 2], |[linear, angular], place| {
        [linear + moved(place), angular + (before[place] - DVec3::new(3.0, -2.0, 1.0)).cross(moved(place))]
    })
}

#[test]
fn free_lines_keep_their_momentum_and_angular_momentum() {
    for compliance in [0.0, 20.0] {
        // With one inner knot both are kept; with more, those of later colours act where the first have moved them.
        for knots in [3, 10] {
            let places = 8 + knots * STRIDE;
            let masses: Numbers = (0..places).map(|k| 1.0 + 0.2 * (k % 4) as f32).collect();
            let found = on_all(|| Straighten(compliance, knots, cloud(places, 7), masses.clone()));
            let (before, after) = (in_f64(&cloud(places, 7)), in_f64(&found));
            for lane in 0..8 {
                let places = (0..knots).map(|knot| 8 + knot * STRIDE + lane);
                let [linear, angular] = changes(&before, &after, &masses, places.clone());
                let all: f64 = places.map(|place| before[place].distance(after[place])).sum();
                assert!(all > 0.01, "nothing has moved");
                assert!(linear.length() < 1e-6 * knots as f64, "{linear}");
                assert!(knots > 3 || angular.length() < 1e-5, "{angular}");
            }
        }
    }
}

/// Straight lines feel nothing, however they lie and are stretched.
#[test]
fn straight_lines_stay() {
    let places = 8 + 6 * STRIDE;
    let mut positions = cloud(places, 5);
    for lane in 0..8 {
        for knot in 0..6 {
            let at = noise3(lane) + noise3(lane + 100) * knot as f32;
            set(&mut positions, 8 + knot * STRIDE + lane, at);
        }
    }
    let before = in_f64(&positions);
    let found = on_all(|| Straighten(0.0, 6, positions.clone(), std::iter::repeat_n(1.0, places).collect()));
    assert!(farthest(&found, &before) < 1e-6);
}
