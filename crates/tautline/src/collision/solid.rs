//! Where a point is relative to the surface of a rigid body.

use glam::Vec3;

use super::winding::is_inside;
use crate::geometry::closest::closest_on_triangle;
use crate::geometry::feature::FeaturePoint;
use crate::norm::Norm;

/// A closed surface in its present position.
#[derive(Clone, Copy)]
pub(crate) struct Solid<'a> {
    pub(crate) positions: &'a [Vec3],
    pub(crate) triangles: &'a [[u32; 3]],
    /// Of a convex surface the planes of its faces; empty for any other.
    pub(crate) planes: &'a [Plane],
}

/// The plane n·x = offset, n being unit or, for a face without area, zero.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    normal: Vec3,
    offset: f32,
}

impl Plane {
    /// Of a triangle, n pointing to where it is seen counter-clockwise.
    pub(crate) fn of([a, b, c]: [Vec3; 3]) -> Self {
        let normal = (b - a).cross(c - a).unit_or_zero();
        Self { normal, offset: normal.dot(a) }
    }

    fn height(&self, point: Vec3) -> f32 {
        self.normal.dot(point) - self.offset
    }
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
    let height = solid.height(center);
    if height.is_some_and(|height| height >= thickness) {
        return None;
    }
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
    let inside = match height {
        Some(height) => height <= 0.0,
        None => is_inside(center, solid.positions, solid.triangles),
    };
    let distance = squared.sqrt();
    if !inside && distance >= thickness {
        return None;
    }
    // On the surface itself the way out is the face's normal.
    let on_surface = distance <= 1e-6 * (1.0 + thickness);
    let distance = if inside { -distance } else { distance };
    let outward = if on_surface { Plane::of([a, b, c]).normal } else { away / distance };
    Some(NearestPoint { point: FeaturePoint::new(corners, weights), outward, distance })
}

impl Solid<'_> {
    /// How far `point` is above the highest of a convex surface's planes, in m: at most its distance, and
    /// negative inside. `None` for other surfaces.
    fn height(&self, point: Vec3) -> Option<f32> {
        self.planes.iter().map(|plane| plane.height(point)).reduce(f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;

    fn nearest(center: Vec3, thickness: f32, convex: bool) -> Option<NearestPoint> {
        let cube = primitives::cube(2.0).unwrap();
        let corners = |t: &[u32; 3]| t.map(|v| cube.positions[v as usize]);
        let planes: Vec<Plane> = cube.triangles.iter().map(|t| Plane::of(corners(t))).collect();
        let planes = if convex { &planes[..] } else { &[] };
        let solid = Solid { positions: &cube.positions, triangles: &cube.triangles, planes };
        nearest_surface(center, thickness, cube.triangles.iter().map(|t| &t[..]), &solid)
    }

    #[test]
    fn inside_outside_and_on_the_surface_of_a_cube() {
        for convex in [true, false] {
            let inside = nearest(Vec3::new(0.7, 0.1, 0.2), 0.0, convex).unwrap();
            assert!((inside.distance + 0.3).abs() < 1e-6 && inside.outward.distance(Vec3::X) < 1e-6);
            let near_corner = nearest(Vec3::splat(1.1), 0.2, convex).unwrap();
            assert!((near_corner.distance - 0.1 * 3f32.sqrt()).abs() < 1e-6);
            assert!(near_corner.outward.distance(Vec3::ONE.normalize()) < 1e-5);
            assert!(nearest(Vec3::splat(1.1), 0.1, convex).is_none(), "beyond the thickness");
            assert!(nearest(Vec3::new(0.0, 1.5, 0.0), 0.0, convex).is_none());
            let touching = nearest(Vec3::new(0.2, 1.0, -0.3), 0.1, convex).unwrap();
            assert!(touching.distance.abs() < 1e-6 && touching.outward.distance(Vec3::Y) < 1e-6);
        }
    }
}
