//! The support mapping of points that are asked for many times: eight at a time, and yet the point that [`Points`] finds.

use glam::{DVec3, Vec3};
use wide::f32x8;

use super::support::{Points, Support};

const LANES: usize = 8;
/// A height in f32 is off by less than this part of the largest that any point could have: four roundings, 2⁻²² in all.
/// Four times that, for two heights and what is rounded in comparing them.
const MARGIN: f32 = 1.0 / (1 << 20) as f32;
/// Between these nothing overflows, and what underflows is far below the margin.
const USUAL: std::ops::Range<f32> = 1e-20..1e30;

/// All x, all y and all z of eight points.
type Row = [[f32; LANES]; 3];

/// Points side by side. The heights of all are found in f32, and those of the few that may be the farthest in f64.
pub(super) struct PointRows<'a> {
    points: &'a [Vec3],
    /// The last point fills up the last row.
    rows: Vec<Row>,
    /// The largest coordinate.
    largest: f32,
}

impl<'a> PointRows<'a> {
    pub(super) fn new(points: &'a [Vec3]) -> Self {
        let mut rows = Vec::with_capacity(points.len().div_ceil(LANES));
        let (eights, rest) = points.as_chunks();
        rows.extend(eights.iter().map(row));
        if let Some(&last) = rest.last() {
            let mut eight = [last; LANES];
            eight[..rest.len()].copy_from_slice(rest);
            rows.push(row(&eight));
        }
        let mut largest = f32x8::ZERO;
        for numbers in rows.as_flattened() {
            largest = largest.fast_max(f32x8::new(*numbers).abs());
        }
        Self { points, rows, largest: highest_of(largest) }
    }

    /// As [`Support::support`], where heights in f32, along `rough`, are off by less than half the margin.
    #[inline]
    fn farthest(&self, direction: DVec3, rough: [f32x8; 3], margin: f32) -> u32 {
        let mut highest = f32x8::splat(f32::NEG_INFINITY);
        for row in &self.rows {
            highest = highest.fast_max(heights(row, rough));
        }
        let enough = f32x8::splat(highest_of(highest) - margin);
        let (mut farthest, mut index) = (f64::NEG_INFINITY, 0);
        for (row, first) in self.rows.iter().zip((0..).step_by(LANES)) {
            let mut candidates = heights(row, rough).simd_gt(enough).to_bitmask();
            while candidates != 0 {
                let candidate = first + candidates.trailing_zeros();
                candidates &= candidates - 1;
                // What fills up the last row is no higher than the point that it repeats.
                let height = self.point(candidate).dot(direction);
                if height > farthest && (candidate as usize) < self.points.len() {
                    (farthest, index) = (height, candidate);
                }
            }
        }
        index
    }
}

#[inline]
fn row(points: &[Vec3; LANES]) -> Row {
    let mut row = [[0.0; LANES]; 3];
    for (lane, point) in points.iter().enumerate() {
        (row[0][lane], row[1][lane], row[2][lane]) = (point.x, point.y, point.z);
    }
    row
}

#[inline]
fn heights(row: &Row, [x, y, z]: [f32x8; 3]) -> f32x8 {
    f32x8::new(row[0]) * x + f32x8::new(row[1]) * y + f32x8::new(row[2]) * z
}

#[inline]
fn highest_of(heights: f32x8) -> f32 {
    let [a, b, c, d, e, f, g, h] = heights.to_array();
    let max = |a: f32, b: f32| if a > b { a } else { b };
    max(max(max(a, e), max(b, f)), max(max(c, g), max(d, h)))
}

impl Support for PointRows<'_> {
    #[inline]
    fn support(&self, direction: DVec3) -> u32 {
        let rough = direction.as_vec3();
        let length = rough.x.abs() + rough.y.abs() + rough.z.abs();
        let reach = length * self.largest;
        if USUAL.contains(&length) && USUAL.contains(&reach) {
            self.farthest(direction, rough.to_array().map(f32x8::splat), reach * MARGIN)
        } else {
            Points(self.points).support(direction)
        }
    }

    #[inline]
    fn point(&self, index: u32) -> DVec3 {
        Points(self.points).point(index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// On a lattice, so that many points are equally far; anywhere; and of any size.
    fn coordinate() -> impl Strategy<Value = f32> {
        let any = any::<f32>().prop_filter("it is finite", |x| x.is_finite());
        prop_oneof![(-2..=2).prop_map(|n: i32| n as f32), -1.0..1.0_f32, any]
    }

    fn direction() -> impl Strategy<Value = DVec3> {
        let lattice = prop::array::uniform3(-2..=2).prop_map(|c: [i32; 3]| c.map(f64::from));
        let any = prop::array::uniform3(any::<f64>());
        prop_oneof![lattice, prop::array::uniform3(-1.0..1.0), any].prop_map(DVec3::from_array)
    }

    fn one_by_one(points: &[Vec3], direction: DVec3) -> u32 {
        let height = |i: usize| points[i].as_dvec3().dot(direction);
        let mut farthest = 0;
        for i in 1..points.len() {
            // Not a number is nowhere.
            if height(i) > height(farthest) || height(farthest).is_nan() && height(i) > f64::NEG_INFINITY {
                farthest = i;
            }
        }
        farthest as u32
    }

    proptest! {
        #[test]
        fn finds_the_point_that_a_search_one_by_one_finds(
            points in prop::collection::vec(prop::array::uniform3(coordinate()), 0..40),
            direction in direction(),
        ) {
            let points: Vec<Vec3> = points.into_iter().map(Vec3::from).collect();
            let expected = one_by_one(&points, direction);
            prop_assert_eq!(Points(&points).support(direction), expected);
            prop_assert_eq!(PointRows::new(&points).support(direction), expected);
        }
    }
}
