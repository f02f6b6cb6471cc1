//! Where a point is relative to the surface of a rigid body.

use glam::Vec3;

use super::winding::is_inside;
use crate::geometry::closest::closest_on_triangle;
use crate::geometry::feature::FeaturePoint;

/// A closed surface in its present position.
#[derive(Clone, Copy)]
pub(crate) struct Solid<'a> {
    pub(crate) positions: &'a [Vec3],
    pub(crate) triangles: &'a [[u32; 3]],
    pub(crate) convex: bool,
}

/// The point of a surface that is nearest to some other point.
pub(crate) struct NearestPoint {
    /// On which feature it is, and where.
    pub(crate) point: FeaturePoint,
    /// Unit: the direction in which the other point leaves the solid.
    pub(crate) outward: Vec3,
    /// How far outside the other point is, in m; negative inside.
    pub(crate) distance: f32,
}

/// The point of the `candidates` (triangles of the solid) that is nearest to `center`, if `center` is inside
/// the solid or less than `thickness` (m) outside. Of equally near faces the first counts.
pub(crate) fn nearest_surface<'a>(
    center: Vec3,
    thickness: f32,
    candidates: impl Iterator<Item = &'a [u32]>,
    solid: &Solid<'_>,
) -> Option<NearestPoint> {
    let mut nearest: Option<(f32, [u32; 3], [f64; 3], Vec3)> = None;
    for corners in candidates {
        let &[a, b, c] = corners else { continue };
        let triangle = [a, b, c].map(|v| solid.positions[v as usize].as_dvec3());
        let weights = closest_on_triangle(center.as_dvec3(), triangle);
        let point = triangle[0] * weights[0] + triangle[1] * weights[1] + triangle[2] * weights[2];
        let away = (center.as_dvec3() - point).as_vec3();
        let squared = away.length_squared();
        if nearest.is_none_or(|(least, ..)| squared < least) {
            nearest = Some((squared, [a, b, c], weights, away));
        }
    }
    let (squared, corners, weights, away) = nearest?;
    let [a, b, c] = corners.map(|v| solid.positions[v as usize]);
    let face_normal = (b - a).cross(c - a).normalize_or_zero();
    let inside = solid.contains(center);
    let distance = squared.sqrt();
    if !inside && distance >= thickness {
        return None;
    }
    // On the surface itself the way out is the face's normal.
    let on_surface = distance <= 1e-6 * (1.0 + thickness);
    let distance = if inside { -distance } else { distance };
    let outward = if on_surface { face_normal } else { away / distance };
    Some(NearestPoint { point: FeaturePoint::new(corners, weights), outward, distance })
}

impl Solid<'_> {
    fn contains(&self, point: Vec3) -> bool {
        if !self.convex {
            return is_inside(point, self.positions, self.triangles);
        }
        self.triangles.iter().all(|triangle| {
            let [a, b, c] = triangle.map(|v| self.positions[v as usize]);
            (b - a).cross(c - a).dot(point - a) <= 0.0
        })
    }
}
