use glam::Vec3;

use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise, noise3, on_all, positions};

struct Solve<'a>(&'a [Bundle], &'a Points, usize);

impl Kernel for Solve<'_> {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let (mut bundles, mut points) = (self.0.to_vec(), self.1.clone());
        for _ in 0..self.2 {
            bundles.iter_mut().for_each(|bundle| bundle.solve::<L>(&mut points, &mut Vec::new()));
        }
        positions(&points)
    }
}

/// Ropes of 1 to 12 segments of some length, one after another, crumpled.
fn ropes() -> (Vec<Rope>, Points) {
    let mut points = Points::default();
    points.reset(160);
    let (mut ropes, mut start) = (Vec::new(), 0);
    for (number, segments) in [3_usize, 12, 1, 7, 5, 12, 2].into_iter().enumerate() {
        let length = |k: usize| 0.2 + 0.05 * noise(k + 20 * number);
        let spans =
            (0..segments).map(|k| Span { low: length(k), high: length(k), compliance: 0.0 }).collect();
        for knot in 0..=segments {
            let place = start + knot;
            let at = Vec3::new(number as f32, -0.22 * knot as f32, 0.0) + noise3(place) * 0.06;
            points.put(place, at, Vec3::ZERO);
            points.inverse_mass[place] = if knot == 0 { 0.0 } else { 1.0 + 0.3 * noise(place) };
        }
        ropes.push(Rope { start, spans });
        start += (segments + 1).next_multiple_of(LANES);
    }
    (ropes, points)
}

#[test]
fn solving_again_and_again_brings_all_lengths_to_rest() {
    let (ropes, points) = ropes();
    let bundles: Vec<Bundle> = ropes.iter().map(|rope| Bundle::new(vec![rope.clone()], 1.0)).collect();
    let found = on_all(|| Solve(&bundles, &points, 100));
    for rope in &ropes {
        for (stick, span) in rope.spans.iter().enumerate() {
            let [a, b] = [stick, stick + 1].map(|knot| get(&found, rope.start + knot));
            assert!((a.distance(b) / span.low - 1.0).abs() < 2e-5, "{}, not {}", a.distance(b), span.low);
        }
        assert_eq!(get(&found, rope.start), points.at(rope.start), "it is held");
    }
}
