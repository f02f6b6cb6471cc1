//! The point of a shape's surface closest to a point, and on which side of it that is.

use glam::{DVec3, Vec3};

use crate::geometry::closest::{closest_on_segment, closest_on_triangle};
use crate::norm::Norm;
use crate::shape::{Convex, Face};

use super::fan;

/// Points nearer to a core than this part of their coordinates have no direction from it.
const ROUNDING: f64 = 1e-14;

/// A place on the surface of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Closest {
    pub(crate) point: DVec3,
    /// In m, below 0 inside.
    pub(crate) distance: f64,
    /// Unit, out of the shape: the point asked for is `point + distance * normal`.
    pub(crate) normal: DVec3,
}

impl Closest {
    /// Of a shape with a core whose closest point is `on_core`; `fallback` (unit) is the normal if that is the point
    /// itself.
    fn around(point: DVec3, on_core: DVec3, radius: f64, fallback: DVec3) -> Self {
        let gap = point - on_core;
        let length = gap.norm();
        let rounding = ROUNDING * point.abs().max(on_core.abs()).max_element();
        let normal = if length > rounding { gap / length } else { fallback };
        Self { point: on_core + normal * radius, distance: length - radius, normal }
    }
}

/// The closest place on the surface of a convex part, in the part's frame. Of equally close ones that of the first
/// face; the centre of a ball gives +Y, the axis of a capsule some direction across it.
pub(crate) fn closest_to_convex(point: DVec3, part: &Convex) -> Closest {
    let radius = f64::from(part.radius);
    match *part.vertices {
        [center] => Closest::around(point, center.as_dvec3(), radius, DVec3::Y),
        [a, b] => {
            let ends = [a, b].map(|end| end.as_dvec3());
            let [s, t] = closest_on_segment(point, ends);
            let across =
                (ends[1] - ends[0]).try_unit().map_or(DVec3::Y, |axis| axis.any_orthonormal_vector());
            Closest::around(point, ends[0] * s + ends[1] * t, radius, across)
        }
        _ => closest_on_faces(point, part, radius),
    }
}

/// The closest point of a triangle without thickness; in it, the normal is the triangle's own.
pub(crate) fn closest_to_triangle(point: DVec3, corners: [Vec3; 3]) -> Closest {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let normal = (b - a).cross(c - a).unit_or(DVec3::Y);
    Closest::around(point, on_triangle(point, corners), 0.0, normal)
}

/// The closest point on the plane of the solid n · x < offset, with unit n.
pub(crate) fn closest_to_half_space(point: DVec3, normal: DVec3, offset: f64) -> Closest {
    let distance = normal.dot(point) - offset;
    Closest { point: point - normal * distance, distance, normal }
}

/// Where a point is over its highest face, that is where it is closest. Else it is closest to an edge or a corner of a face
/// that it is above: those that it sees.
fn closest_on_faces(point: DVec3, part: &Convex, radius: f64) -> Closest {
    let height = |face: &Face| face.normal.as_dvec3().dot(point) - f64::from(face.offset);
    // The face whose plane is highest under the point is the closest one if the point is inside.
    let (mut highest, mut top) = (f64::NEG_INFINITY, None);
    for face in &part.faces {
        let above = height(face);
        if above > highest {
            (highest, top) = (above, Some(face));
        }
    }
    let outward = top.map_or(DVec3::Y, |face| face.normal.as_dvec3());
    let has_inside = part.faces.len() > 2;
    if has_inside && highest <= 0.0 || top.is_some_and(|face| is_over(point, part, face)) {
        let distance = highest - radius;
        return Closest { point: point - outward * distance, distance, normal: outward };
    }
    let mut closest = DVec3::INFINITY;
    let seen = part.faces.iter().filter(|face| !has_inside || height(face) > 0.0);
    for corners in seen.flat_map(|face| fan(part, face)) {
        let candidate = on_triangle(point, corners);
        if candidate.distance_squared(point) < closest.distance_squared(point) {
            closest = candidate;
        }
    }
    Closest::around(point, closest, radius, outward)
}

/// Whether a point is straight above or below a face.
fn is_over(point: DVec3, part: &Convex, face: &Face) -> bool {
    let normal = face.normal.as_dvec3();
    let mut corners = part.corners(*face).map(|(_, corner)| corner.as_dvec3());
    let Some(first) = corners.next() else { return false };
    let mut last = first;
    for corner in corners.chain([first]) {
        if (corner - last).cross(point - last).dot(normal) < 0.0 {
            return false;
        }
        last = corner;
    }
    true
}

fn on_triangle(point: DVec3, corners: [Vec3; 3]) -> DVec3 {
    let corners = corners.map(|corner| corner.as_dvec3());
    let [u, v, w] = closest_on_triangle(point, corners);
    corners[0] * u + corners[1] * v + corners[2] * w
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::{parts, vector};
    use super::*;
    use crate::geometry::distance::distance;

    /// What may differ because faces are in f32, in m.
    const TOLERANCE: f64 = 1e-6;

    /// Outside by GJK; inside the least height under a face.
    fn expected(point: DVec3, part: &Convex) -> f64 {
        let gap = f64::from(distance(&[point.as_vec3()], &part.vertices).unwrap().distance);
        let under = part.faces.iter().map(|face| {
            let corner = part.corners(*face).next().unwrap().1;
            f64::from(face.normal.dot(corner)) - face.normal.as_dvec3().dot(point)
        });
        let depth = under.fold(f64::INFINITY, f64::min);
        let is_inside = part.faces.len() > 2 && depth > 0.0;
        (if is_inside { -depth } else { gap }) - f64::from(part.radius)
    }

    proptest! {
        #[test]
        fn the_distance_is_that_of_other_ways_to_find_it(part in parts(), point in vector(1.5)) {
            let point = point.as_vec3().as_dvec3();
            let closest = closest_to_convex(point, &part);
            prop_assert!((closest.distance - expected(point, &part)).abs() < TOLERANCE, "{closest:?}");
            prop_assert!((closest.normal.length() - 1.0).abs() < TOLERANCE);
            prop_assert!((closest.point + closest.normal * closest.distance - point).length() < TOLERANCE);
            let on_surface = closest_to_convex(closest.point, &part);
            prop_assert!(on_surface.distance.abs() < TOLERANCE, "{on_surface:?}");
        }

        #[test]
        fn a_triangle_is_a_polytope_of_two_faces(
            corners in prop::array::uniform3(vector(1.0)),
            point in vector(1.5),
        ) {
            let [corners, [point, ..]] = [corners, [point; 3]].map(|points| points.map(|p| p.as_vec3()));
            let closest = closest_to_triangle(point.as_dvec3(), corners);
            let expected = distance(&[point], &corners).unwrap();
            prop_assert!((closest.distance - f64::from(expected.distance)).abs() < TOLERANCE);
            prop_assert!((closest.point.as_vec3() - expected.point_b).length() < 1e-3);
        }
    }

    #[test]
    fn centres_and_planes_have_a_normal_too() {
        let core = |vertices: &[Vec3]| Convex::new(vertices.to_vec(), Vec::new(), Vec::new(), 0.5);
        let ball = closest_to_convex(DVec3::ONE, &core(&[Vec3::ONE]));
        assert_eq!((ball.distance, ball.normal, ball.point), (-0.5, DVec3::Y, DVec3::new(1.0, 1.5, 1.0)));
        let capsule = closest_to_convex(DVec3::ZERO, &core(&[Vec3::NEG_X, Vec3::X]));
        assert_eq!((capsule.distance, capsule.normal.x), (-0.5, 0.0));
        let floor = closest_to_half_space(DVec3::new(3.0, -2.0, 1.0), DVec3::Y, 1.0);
        assert_eq!((floor.distance, floor.point), (-3.0, DVec3::new(3.0, 1.0, 1.0)));
    }
}
