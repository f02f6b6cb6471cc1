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
        let mut farthest = f64::NEG_INFINITY;
        let mut index = 0;
        for (i, point) in self.0.iter().enumerate() {
            let height = point.as_dvec3().dot(direction);
            if height > farthest {
                farthest = height;
                index = i as u32;
            }
        }
        index
    }

    #[inline]
    fn point(&self, index: u32) -> DVec3 {
        self.0.get(index as usize).copied().unwrap_or_default().as_dvec3()
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
