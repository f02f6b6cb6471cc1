//! Distances of random point sets, and whether the answers keep their promises.

use tautline::Vec3;
use tautline::geometry::distance::{Distance, distance};

/// The first byte says how many points A has and what kind of numbers follow: whole ones on a small lattice, which touch and
/// coincide, or any bits that a number can have.
pub(crate) fn run(bytes: &[u8]) {
    let Some((&head, rest)) = bytes.split_first() else { return };
    let points = if head & 1 == 0 { lattice(rest) } else { wild(rest) };
    let (a, b) = points.split_at((usize::from(head) >> 1).min(points.len()));
    let Ok(found) = distance(a, b) else {
        let is_bad = |points: &[Vec3]| points.is_empty() || points.iter().any(|point| !point.is_finite());
        assert!(is_bad(a) || is_bad(b), "good points are refused");
        return;
    };
    check(a, b, &found);
    if a != b {
        let back = distance(b, a).expect("as good the other way round");
        assert_eq!(found.distance.to_bits(), back.distance.to_bits());
        assert_eq!(found.normal, -back.normal);
    }
}

fn lattice(bytes: &[u8]) -> Vec<Vec3> {
    let number = |byte: u8| f32::from(byte as i8 >> 4) * 0.25;
    bytes.chunks_exact(3).map(|b| Vec3::new(number(b[0]), number(b[1]), number(b[2]))).collect()
}

fn wild(bytes: &[u8]) -> Vec<Vec3> {
    let number = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    bytes.chunks_exact(12).map(|b| Vec3::new(number(b), number(&b[4..]), number(&b[8..]))).collect()
}

/// What an answer promises; errors are measured by the extent of the larger set.
fn check(a: &[Vec3], b: &[Vec3], found: &Distance) {
    assert!(found.iterations <= 64 && found.distance.is_finite());
    assert!((found.normal.length() - 1.0).abs() < 1e-5, "{found:?}");
    let normal = found.normal.as_dvec3();
    let heights = |points: &[Vec3]| points.iter().map(|p| p.as_dvec3().dot(normal)).collect::<Vec<_>>();
    let highest = heights(a).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let lowest = heights(b).into_iter().fold(f64::INFINITY, f64::min);
    let reach = a.iter().chain(b).map(|p| p.as_dvec3().distance(a[0].as_dvec3())).fold(0.0, f64::max);
    let far = a.iter().chain(b).map(|p| f64::from(p.abs().max_element())).fold(0.0, f64::max);
    let signed = f64::from(found.distance);
    // Differences of coordinates are rounded, which tilts the normal of a gap that is tiny beside them.
    let tilt = if signed > 0.0 { 1e-15 * far / signed } else { 0.0 };
    let rounding = (1e-5 + tilt) * reach + 1e-14 * far + 1e-40;
    // A gap that no f32 can hold is told as the largest one.
    if found.distance < f32::MAX {
        assert!(signed - (lowest - highest) <= rounding, "{found:?}: {lowest} over {highest}");
    }
    if found.converged && found.distance < f32::MAX {
        let witnesses = found.point_b.as_dvec3() - found.point_a.as_dvec3();
        assert!((witnesses - normal * signed).length() <= rounding + 1e-6 * far, "{found:?}");
    }
}
