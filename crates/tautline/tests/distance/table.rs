//! Every case against exact arithmetic, near the origin and a kilometre away, as a table.

use tautline::geometry::distance::{Distance, distance};
use tautline::geometry::feature::FeaturePoint;
use tautline::{DVec3, Vec3};

use crate::cases::{CASES, Pair, Random, moved};
use crate::exact::Lattice;

/// Where each case is tried.
const PLACES: [(&str, Vec3); 2] =
    [("at the origin", Vec3::ZERO), ("1 km away", Vec3::new(700.0, -500.0, 600.0))];

/// What is demanded of the signed distance, of witnesses and of the normal, as part of the scale; of iterations.
const MOST_ERROR: f64 = 1e-6;
const MOST_ITERATIONS: u32 = 64;

/// The worst of a case at a place.
#[derive(Default)]
struct Row {
    error: f64,
    promise: f64,
    iterations: u32,
    unresolved: usize,
    asymmetric: usize,
}

#[test]
fn agrees_with_exact_arithmetic() {
    print_and_judge(150);
}

/// About two minutes: `cargo test -p tautline --test distance hundred -- --ignored --nocapture`.
#[test]
#[ignore = "the same on 100 000 pairs"]
fn agrees_with_exact_arithmetic_on_a_hundred_thousand_pairs() {
    print_and_judge(1_700);
}

fn print_and_judge(pairs_each: usize) {
    let count = pairs_each * CASES.len() * PLACES.len();
    println!("{count} pairs; errors as parts of the scale: the extent of the larger set in m, at least 1");
    let head = format!("{:>9} {:>9} {:>10} {:>10}", "error", "promises", "iterations", "unresolved");
    println!("{:22} {:^41} │ {:^41}\n{:22} {head} │ {head}", "", PLACES[0].0, PLACES[1].0, "case");
    let mut failed = Vec::new();
    for (case, (name, generate)) in CASES.into_iter().enumerate() {
        let rows = PLACES.map(|(place, shift)| {
            let mut random = Random(case as u64);
            let row = Row::of(pairs_each, || {
                let (a, b) = generate(&mut random);
                (moved(a, shift), moved(b, shift))
            });
            if !row.is_good() {
                failed.push((name, place));
            }
            row.text()
        });
        println!("{name:22} {}", rows.join(" │ "));
    }
    assert!(failed.is_empty(), "{failed:?}");
}

impl Row {
    fn of(count: usize, mut generate: impl FnMut() -> Pair) -> Self {
        let mut row = Self::default();
        for _ in 0..count {
            let mut pair = generate();
            let exact = Lattice::snap(&mut pair).signed_distance();
            let found = distance(&pair.0, &pair.1).unwrap();
            row.error = row.error.max((f64::from(found.distance) - exact).abs() / scale(&pair));
            row.promise = row.promise.max(broken_promise(&pair, &found) / scale(&pair));
            row.iterations = row.iterations.max(found.iterations);
            row.unresolved += usize::from(!found.converged);
            let back = distance(&pair.1, &pair.0).unwrap();
            let is_mirrored = pair.0 == pair.1
                || found.distance.to_bits() == back.distance.to_bits() && found.normal == -back.normal;
            row.asymmetric += usize::from(!is_mirrored);
        }
        row
    }

    fn is_good(&self) -> bool {
        self.error <= MOST_ERROR
            && self.promise <= MOST_ERROR
            && self.iterations <= MOST_ITERATIONS
            && self.unresolved + self.asymmetric == 0
    }

    fn text(&self) -> String {
        format!("{:9.1e} {:9.1e} {:10} {:10}", self.error, self.promise, self.iterations, self.unresolved)
    }
}

/// The size of the larger set, in m, at least 1: where the pair lies does not count.
pub(crate) fn scale((a, b): &Pair) -> f64 {
    let extent = |points: &[Vec3]| points.iter().map(|p| p.distance(points[0])).fold(0.0, f32::max);
    f64::from(extent(a).max(extent(b))).max(1.0)
}

/// The largest violation of what an answer promises, apart from its value.
pub(crate) fn broken_promise((a, b): &Pair, found: &Distance) -> f64 {
    let (points_a, points_b): (Vec<_>, Vec<_>) =
        (a.iter().map(|p| p.as_dvec3()).collect(), b.iter().map(|p| p.as_dvec3()).collect());
    let signed = f64::from(found.distance);
    let normal = found.normal.as_dvec3();
    let (on_a, on_b) = (sum(&found.feature_a, a), sum(&found.feature_b, b));
    // Far from the origin a witness point is only as fine as f32 is there, and so is a sum of weights.
    let farthest = points_a.iter().chain(&points_b).map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let rounding = 4.0 * f64::from(f32::EPSILON) * farthest;
    [
        (normal.length() - 1.0).abs(),
        // Moving B by the depth along the normal separates.
        signed - separation(&points_a, &points_b, normal),
        // The witness points lie on the named features, and realise the distance.
        (on_a - found.point_a.as_dvec3()).length() - rounding,
        (on_b - found.point_b.as_dvec3()).length() - rounding,
        if found.converged { (on_b - on_a - normal * signed).length() - rounding } else { 0.0 },
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

fn sum(point: &FeaturePoint, points: &[Vec3]) -> DVec3 {
    point.iter().map(|(i, weight)| points[i as usize].as_dvec3() * f64::from(weight)).sum()
}

/// How far B lies beyond A along a unit axis.
fn separation(a: &[DVec3], b: &[DVec3], axis: DVec3) -> f64 {
    let highest = a.iter().map(|p| p.dot(axis)).fold(f64::NEG_INFINITY, f64::max);
    let lowest = b.iter().map(|p| p.dot(axis)).fold(f64::INFINITY, f64::min);
    lowest - highest
}
