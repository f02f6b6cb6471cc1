//! Of many points of a contact the four that hold it best.

use glam::Vec3;

use super::key::Key;

/// A point that may become part of a manifold.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    /// On the core of A, in A's frame.
    pub(super) on_a: Vec3,
    /// How far the core of B lies beyond it, in m.
    pub(super) separation: f32,
    pub(super) key: Key,
}

/// A later candidate has to be better by this part: rounding does not make the choice wander.
const BETTER: f32 = 1.001;

/// Moves the four to the front, and returns how many there are: of the points less than `slop` m above the deepest
/// the one farthest from the middle, the one farthest from it, the one that makes the largest triangle with both, and
/// the one farthest beyond one of the triangle's sides. Ties go to the first.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn reduce(points: &mut [Candidate], normal: Vec3, slop: f32) -> usize {
    if points.len() <= 4 {
        return points.len();
    }
    let deepest = points.iter().fold(f32::INFINITY, |least, point| least.min(point.separation));
    let middle = points.iter().map(|point| point.on_a).sum::<Vec3>() / points.len() as f32;
    let (mut start, mut largest) = (0, -1.0);
    for (i, point) in points.iter().enumerate().filter(|(_, point)| point.separation <= deepest + slop) {
        let squared = (point.on_a - middle).length_squared();
        if squared > largest * BETTER {
            (start, largest) = (i, squared);
        }
    }
    points.swap(0, start);
    let first = points[0].on_a;
    if !bring_best(points, 1, |p| (p - first).length_squared()) {
        return 1;
    }
    let second = points[1].on_a;
    let twice_area = |p: Vec3, q: Vec3, r: Vec3| normal.dot((q - p).cross(r - p));
    if !bring_best(points, 2, |p| twice_area(first, second, p).abs()) {
        return 2;
    }
    let third = points[2].on_a;
    let turn = if twice_area(first, second, third) > 0.0 { 1.0 } else { -1.0 };
    // Beyond which side of the triangle, and by how much.
    let beyond = |p: Vec3| {
        let sides = [[second, first], [third, second], [first, third]];
        sides.into_iter().map(|[q, r]| turn * twice_area(q, r, p)).fold(0.0, f32::max)
    };
    if bring_best(points, 3, beyond) { 4 } else { 3 }
}

/// Moves the point of largest measure among those from `place` on to `place`; false if all measure 0.
#[inline(always)]
fn bring_best(points: &mut [Candidate], place: usize, measure: impl Fn(Vec3) -> f32) -> bool {
    let (mut best, mut largest) = (place, 0.0);
    for (i, point) in points.iter().enumerate().skip(place) {
        let value = measure(point.on_a);
        if value > largest * BETTER {
            (best, largest) = (i, value);
        }
    }
    points.swap(place, best);
    largest > 0.0
}
