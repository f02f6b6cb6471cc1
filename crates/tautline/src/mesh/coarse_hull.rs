//! Convex hulls of fewer corners, and how far they are off.

use glam::{DVec3, Vec3};

use super::{ConvexHull, convex_hull, exact};
use crate::error::{Error, MeshDefect, within};
use crate::geometry::gjk::{Proximity, closest};
use crate::geometry::support::Points;
use crate::norm::Norm;

/// A convex hull within another, of some of its corners.
#[derive(Debug, Clone, PartialEq)]
pub struct CoarseHull {
    /// Its `sources` are points that the whole hull was asked for.
    pub hull: ConvexHull,
    /// The Hausdorff distance from the whole hull, in m: of what is left out nothing is farther from this one.
    pub error: f32,
}

impl ConvexHull {
    /// The hull of as many of its corners as it takes to be no farther than `tolerance` (m) from the whole, but of at least
    /// four and at most `max_corners`. Each next corner is the one that is farthest from the hull of those before. The same
    /// hull gives the same bits.
    ///
    /// # Errors
    ///
    /// [`Error::OutOfRange`] if `max_corners` is below 4 or `tolerance` is not from 0 to 1e9. [`Error::Mesh`] if it was not
    /// made by [`convex_hull`] and has no volume.
    pub fn coarsened(&self, max_corners: usize, tolerance: f32) -> Result<CoarseHull, Error> {
        if max_corners < 4 {
            let (value, expected) = (max_corners as f64, "a count of at least 4");
            return Err(Error::OutOfRange { field: "max_corners".into(), value, expected });
        }
        within("tolerance", tolerance, 0.0, 1e9, "a distance from 0 to 1e9 m")?;
        let corners = &self.mesh.positions;
        if corners.len() < 4 {
            return Err(MeshDefect::Flat { count: corners.len() }.into());
        }
        let mut choice = Choice::new(corners);
        let (mut next, mut error) = choice.farthest();
        while choice.chosen.len() < max_corners.min(corners.len()) && error > f64::from(tolerance) {
            choice.take(next);
            (next, error) = choice.farthest();
        }
        let mut hull = convex_hull(&choice.chosen)?;
        for source in &mut hull.sources {
            let corner = choice.indices[*source as usize];
            *source = self.sources.get(corner).copied().unwrap_or(corner as u32);
        }
        Ok(CoarseHull { hull, error: error as f32 })
    }
}

/// Corners that have been chosen, and how far the others are from their hull.
struct Choice<'a> {
    corners: &'a [Vec3],
    indices: Vec<usize>,
    chosen: Vec<Vec3>,
    /// At most so far away, in m: what has been found when fewer were chosen. 0 if chosen.
    bounds: Vec<f64>,
    /// How many were chosen when a bound was found.
    found_at: Vec<usize>,
}

impl<'a> Choice<'a> {
    /// Four that span a volume, of at least as many corners: the one that is farthest from the middle, two more, and the one
    /// that is farthest from their plane. (The farthest from their triangle may lie in its plane.)
    fn new(corners: &'a [Vec3]) -> Self {
        let middle = corners.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / corners.len() as f64;
        let bounds = corners.iter().map(|p| p.as_dvec3().distance_to(middle)).collect();
        let found_at = vec![0; corners.len()];
        let mut choice = Self { corners, indices: Vec::new(), chosen: Vec::new(), bounds, found_at };
        choice.take(largest(&choice.bounds));
        choice.bounds.fill(f64::INFINITY);
        for _ in 0..2 {
            let (next, _) = choice.farthest();
            choice.take(next);
        }
        let [a, b, c] = [0, 1, 2].map(|i| choice.chosen[i]);
        let heights: Vec<f64> = corners.iter().map(|&p| exact::height_above(a, b, c, p).abs()).collect();
        choice.take(largest(&heights));
        choice
    }

    fn take(&mut self, index: usize) {
        self.indices.push(index);
        self.chosen.push(self.corners[index]);
    }

    /// The corner that is farthest from the hull of those chosen, and its distance in m. Distances only shrink while more are
    /// chosen: the largest bound is found anew until it stays the largest.
    fn farthest(&mut self) -> (usize, f64) {
        loop {
            let index = largest(&self.bounds);
            if self.found_at[index] == self.chosen.len() {
                return (index, self.bounds[index]);
            }
            self.bounds[index] = self.distance(index);
            self.found_at[index] = self.chosen.len();
        }
    }

    fn distance(&self, index: usize) -> f64 {
        let corner = [self.corners[index]];
        let mut axis = self.chosen[0] - corner[0];
        let found = closest(&Points(&corner), &Points(&self.chosen), &mut axis);
        let is_inside = found.proximity == Proximity::Intersecting;
        if is_inside { 0.0 } else { found.simplex.closest_point().norm() }
    }
}

/// The index of the largest; of equal ones the first.
fn largest(numbers: &[f64]) -> usize {
    (1..numbers.len()).fold(0, |best, i| if numbers[i] > numbers[best] { i } else { best })
}
