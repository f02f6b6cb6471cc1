//! Of many points of a contact the four that hold it best, and that go on holding it.

use glam::Vec3;

use super::MAX_POINTS;
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
/// What counts as deeper when points are chosen, as part of the size.
const SLOP: f32 = 1e-4;
/// By how much, as part of the size, another point may be deeper before those of the last call are given up.
const STAYS: f32 = 5e-4;

/// The names of the points that a pair had in the last call.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Former {
    keys: [u32; MAX_POINTS],
    count: usize,
}

impl Former {
    /// Of more points than a manifold has, the first.
    pub(crate) fn new(keys: impl Iterator<Item = u32>) -> Self {
        let mut former = Self::default();
        for (place, key) in former.keys.iter_mut().zip(keys) {
            *place = key;
            former.count += 1;
        }
        former
    }
}

/// Moves the best four to the front, and returns how many there are. `size`: of the smaller body, in m.
///
/// The former four stay while they are there and as deep as any. What presses at a point would be lost with it, and
/// the bodies drop a little: choosing anew in each step, which rounding alone can decide, keeps heaps from ever coming
/// to rest.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn reduce(points: &mut [Candidate], normal: Vec3, size: f32, former: &Former) -> usize {
    if points.len() <= MAX_POINTS {
        points.len()
    } else if stay(points, former, STAYS * size) {
        MAX_POINTS
    } else {
        choose(points, normal, SLOP * size)
    }
}

/// Moves the former four to the front, in their order; false if one is missing, or another point is deeper than one of
/// them by `most` m. Those that were moved until then are still preferred: ties go to the first.
#[inline(always)]
fn stay(points: &mut [Candidate], former: &Former, most: f32) -> bool {
    if former.count < MAX_POINTS {
        return false;
    }
    for (place, &key) in former.keys.iter().enumerate() {
        let Some(further) = points[place..].iter().position(|point| point.key.0 == key) else { return false };
        points.swap(place, place + further);
    }
    let (kept, others) = points.split_at(MAX_POINTS);
    let highest = kept.iter().fold(f32::NEG_INFINITY, |highest, point| highest.max(point.separation));
    others.iter().all(|point| point.separation >= highest - most)
}

/// Of the points less than `slop` m above the deepest the one farthest from the middle, the one farthest from it, the
/// one that makes the largest triangle with both, and the one farthest beyond one of the triangle's sides. Ties go to
/// the first.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn choose(points: &mut [Candidate], normal: Vec3, slop: f32) -> usize {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a hexagon of about 1 m in the plane y = 0, with these separations.
    fn hexagon(separations: [f32; 6]) -> Vec<Candidate> {
        let corner = |k: usize| {
            let angle = std::f32::consts::FRAC_PI_3 * k as f32;
            Candidate {
                on_a: Vec3::new(libm::cosf(angle), 0.0, libm::sinf(angle)) * (1.0 + 0.02 * k as f32),
                separation: separations[k],
                key: Key(k as u32),
            }
        };
        (0..6).map(corner).collect()
    }

    fn chosen(mut points: Vec<Candidate>, former: &[u32]) -> Vec<u32> {
        let former = Former::new(former.iter().copied());
        let count = reduce(&mut points, Vec3::Y, 1.0, &former);
        points[..count].iter().map(|point| point.key.0).collect()
    }

    #[test]
    fn points_stay_while_they_are_there_and_as_deep_as_any() {
        let anew = chosen(hexagon([0.0; 6]), &[]);
        let former = [5, 1, 2, 4];
        assert_ne!(anew, former);
        assert_eq!(chosen(hexagon([0.0; 6]), &former), former);
        assert_eq!(chosen(hexagon([-0.4e-3, 0.0, 0.0, -0.4e-3, 0.0, 0.0]), &former), former);
        // Another one is deeper.
        assert!(chosen(hexagon([0.0, 0.0, 0.0, -0.6e-3, 0.0, 0.0]), &former).contains(&3));
        // One is gone.
        assert_eq!(chosen(hexagon([0.0; 6]), &[5, 1, 2, 7]), anew);
        // There were fewer.
        assert_eq!(chosen(hexagon([0.0; 6]), &former[..3]), anew);
    }
}
