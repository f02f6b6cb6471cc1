//! The signed distance of convex sets against brute force, and what its answer promises about itself.

mod cases;
mod oracle;

use cases::{CASES, Pair, Random};
use tautline::geometry::distance::{Distance, distance};
use tautline::geometry::feature::FeaturePoint;
use tautline::{DVec3, Error, Vec3};

const PAIRS_PER_CASE: usize = 600;

/// The size of the larger set, in m, at least 1: where the pair lies does not count.
fn scale((a, b): &Pair) -> f64 {
    let extent = |points: &[Vec3]| points.iter().map(|p| p.distance(points[0])).fold(0.0, f32::max);
    f64::from(extent(a).max(extent(b))).max(1.0)
}

fn sum(point: &FeaturePoint, points: &[Vec3]) -> DVec3 {
    point.iter().map(|(i, weight)| points[i as usize].as_dvec3() * f64::from(weight)).sum()
}

/// The largest violation of what a converged answer promises, apart from its value.
fn broken_promise((a, b): &Pair, found: &Distance) -> f64 {
    let (points_a, points_b): (Vec<_>, Vec<_>) =
        (a.iter().map(|p| p.as_dvec3()).collect(), b.iter().map(|p| p.as_dvec3()).collect());
    let signed = f64::from(found.distance);
    let normal = found.normal.as_dvec3();
    let (on_a, on_b) = (sum(&found.feature_a, a), sum(&found.feature_b, b));
    [
        (normal.length() - 1.0).abs(),
        // Moving B by the depth along the normal separates.
        signed - oracle::separation(&points_a, &points_b, normal),
        // The witness points lie on the named features, and realise the distance.
        (on_a - found.point_a.as_dvec3()).length(),
        (on_b - found.point_b.as_dvec3()).length(),
        (on_b - on_a - normal * signed).length(),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

#[test]
fn agrees_with_brute_force() {
    println!("{:22} {:>10} {:>10} {:>10} {:>10}", "case", "error", "promises", "iterations", "unresolved");
    let mut failed = Vec::new();
    for (case, (name, generate)) in CASES.into_iter().enumerate() {
        let mut random = Random(case as u64);
        let (mut error, mut promise, mut iterations, mut unresolved) = (0.0_f64, 0.0_f64, 0, 0);
        for _ in 0..PAIRS_PER_CASE {
            let pair = generate(&mut random);
            let found = distance(&pair.0, &pair.1).unwrap();
            let off = (f64::from(found.distance) - oracle::signed_distance(&pair.0, &pair.1)).abs();
            error = error.max(off / scale(&pair));
            promise = promise.max(broken_promise(&pair, &found) / scale(&pair));
            iterations = iterations.max(found.iterations);
            unresolved += usize::from(!found.converged);
        }
        println!("{name:22} {error:10.1e} {promise:10.1e} {iterations:10} {unresolved:10}");
        let tolerance = if name == "1 km away" { 2e-4 } else { 1e-6 };
        if error > 1e-6 || promise > tolerance || iterations > 64 || unresolved > 0 {
            failed.push(name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
#[test]
fn hunt() {
    let n: usize = std::env::var("HUNT").ok().and_then(|s| s.parse().ok()).unwrap_or(1000);
    for (case, (name, generate)) in CASES.into_iter().enumerate() {
        let mut random = Random(1000 + case as u64);
        let (mut bad, mut bp, mut it, mut err) = (0, 0.0f64, 0, 0.0f64);
        for _ in 0..n {
            let pair = generate(&mut random);
            let f = distance(&pair.0, &pair.1).unwrap();
            it = it.max(f.iterations);
            let p = broken_promise(&pair, &f) / scale(&pair);
            bp = bp.max(p);
            if !f.converged || p > 1e-4 {
                bad += 1;
                let e =
                    (f64::from(f.distance) - oracle::signed_distance(&pair.0, &pair.1)).abs() / scale(&pair);
                err = err.max(e);
                if bad <= 2 {
                    println!("  {name} {e:e} {p:e} {f:?}");
                }
            }
        }
        println!("{name:22} promise {bp:10.1e} it {it} bad {bad} err of bad {err:e}");
    }
}
