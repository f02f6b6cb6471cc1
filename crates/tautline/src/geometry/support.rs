//! Support mappings: all that GJK and EPA know of a convex set.

use glam::{DVec3, Vec3};

/// The convex hull of finitely many points, seen through its support mapping.
///
/// Points are stored in f32 and handed out in f64: the difference of two f32 coordinates is exact there
/// (unless they differ by more than 2²⁹ in size), so GJK and EPA work on the very points that were given, near
/// the origin or a kilometre from it.
pub trait Support {
    /// The index of a point farthest along `direction`, which need not be unit. Ties go to the lowest index,
    /// so that a run can be replayed; a zero (or NaN) direction gives index 0.
    fn support(&self, direction: DVec3) -> u32;

    /// The point with this index, in m.
    fn point(&self, index: u32) -> DVec3;
}

/// Points in any order, searched one by one; interior points and duplicates are allowed. An index out of range
/// (an empty slice has no other) reads as the origin.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a>(pub &'a [Vec3]);

impl Support for Points<'_> {
    #[inline]
    fn support(&self, direction: DVec3) -> u32 {
        // Either half by itself, side by side: a comparison need not wait for the one before.
        let half = self.0.len().div_ceil(2);
        let (front, back) = self.0.split_at(half);
        let (mut in_front, mut in_back) = (Farthest::default(), Farthest::default());
        for (i, (p, q)) in front.iter().zip(back).enumerate() {
            in_front.look_at(i, p, direction);
            in_back.look_at(i, q, direction);
        }
        if front.len() > back.len() {
            in_front.look_at(half - 1, &front[half - 1], direction);
        }
        if in_back.height > in_front.height { half as u32 + in_back.index } else { in_front.index }
    }

    #[inline]
    fn point(&self, index: u32) -> DVec3 {
        self.0.get(index as usize).copied().unwrap_or_default().as_dvec3()
    }
}

/// The first of the points looked at that none of the others is beyond.
struct Farthest {
    height: f64,
    index: u32,
}

impl Default for Farthest {
    fn default() -> Self {
        Self { height: f64::NEG_INFINITY, index: 0 }
    }
}

impl Farthest {
    #[inline]
    fn look_at(&mut self, index: usize, point: &Vec3, direction: DVec3) {
        let height = point.as_dvec3().dot(direction);
        if height > self.height {
            *self = Self { height, index: index as u32 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_and_zero_directions_give_the_lowest_index() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y, Vec3::X];
        let points = Points(&square);
        assert_eq!(points.support(DVec3::X), 1);
        assert_eq!(points.support(DVec3::Y * 1e-30), 2);
        assert_eq!(points.support(DVec3::ZERO), 0);
        assert_eq!(points.support(DVec3::NAN), 0);
    }
}
