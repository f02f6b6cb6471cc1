//! Closest points of segments, triangles and convex polytopes, as barycentric weights. In f64: callers hold f32
//! points, whose differences are then exact, and a sliver costs accuracy instead of the answer.

use glam::{DVec3, Vec3};

use crate::norm::Norm;

/// sin² of an angle below which two segments count as parallel.
const PARALLEL: f64 = 1e-24;
/// The square of a triangle's height over its longest edge below which its corners count as collinear.
const SLIVER: f64 = 1e-24;
/// How far the weights of a triangle may be from 1 in all before they are made so: areas of a sliver, and those under a
/// point far away, are full of rounding.
const ROUNDING: f64 = 1e-9;

/// Weights over `[a, b]` of the segment's point closest to `point`. A segment without length gives `[1, 0]`.
#[inline]
pub fn closest_on_segment(point: DVec3, [a, b]: [DVec3; 2]) -> [f64; 2] {
    let along = b - a;
    let length_squared = along.length_squared();
    let t =
        if length_squared > 0.0 { ((point - a).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    [1.0 - t, t]
}

/// Weights over `[a, b, c]` of the triangle's point closest to `point`. Collinear and coincident corners are
/// allowed. Ties (only a triangle without area has them) go to the earliest edge of ab, bc, ca.
#[inline]
pub fn closest_on_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let area_squared = normal.length_squared();
    let larger = |a: f64, b: f64| if a > b { a } else { b }; // a single instruction, unlike f64::max
    let [ab, bc, ca] = [b - a, c - b, a - c].map(|edge| edge.length_squared());
    let longest_squared = larger(larger(ab, bc), ca);
    if area_squared > SLIVER * longest_squared * longest_squared {
        // Weights as areas of the three triangles under the point's projection.
        let (pa, pb, pc) = (a - point, b - point, c - point);
        let weights = [pb.cross(pc), pc.cross(pa), pa.cross(pb)].map(|area| area.dot(normal) / area_squared);
        let sum = weights.iter().sum::<f64>();
        if sum > 0.0 && weights.iter().all(|&weight| weight >= 0.0) {
            return if (sum - 1.0).abs() > ROUNDING { weights.map(|weight| weight / sum) } else { weights };
        }
    }
    closest_on_outline(point, [a, b, c])
}

fn closest_on_outline(point: DVec3, corners: [DVec3; 3]) -> [f64; 3] {
    let mut best = [1.0, 0.0, 0.0];
    let mut best_squared = f64::INFINITY;
    for i in 0..3 {
        let j = (i + 1) % 3;
        let [s, t] = closest_on_segment(point, [corners[i], corners[j]]);
        let squared = (corners[i] * s + corners[j] * t - point).length_squared();
        if squared < best_squared {
            best_squared = squared;
            best = [0.0; 3];
            best[i] = s;
            best[j] = t;
        }
    }
    best
}

/// Weights over `a` and over `b` of the mutually closest points of two segments. Parallel segments have many:
/// the middle of the stretch where they run side by side is taken. Segments without length are allowed.
pub fn closest_between_segments(a: [DVec3; 2], b: [DVec3; 2]) -> [[f64; 2]; 2] {
    let (along_a, along_b, between) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let (aa, bb, ab) = (along_a.length_squared(), along_b.length_squared(), along_a.dot(along_b));
    let crossing = along_a.cross(along_b).length_squared();
    if crossing <= PARALLEL * aa * bb {
        return closest_of_parallel_segments(a, b);
    }
    // Ericson, Real-Time Collision Detection, 5.1.9: closest points of the lines, then clamp s, t, and s again.
    let (a_between, b_between) = (along_a.dot(between), along_b.dot(between));
    let s = ((a_between * bb - b_between * ab) / crossing).clamp(0.0, 1.0);
    let t = ((s * ab - b_between) / bb).clamp(0.0, 1.0);
    let on_a = closest_on_segment(b[0] + along_b * t, a);
    [on_a, [1.0 - t, t]]
}

fn closest_of_parallel_segments(a: [DVec3; 2], b: [DVec3; 2]) -> [[f64; 2]; 2] {
    // The ends of b on a bound the stretch of a beside b; both fall on one end of a where there is none.
    let [first, last] = b.map(|end| closest_on_segment(end, a)[1]);
    let s = 0.5 * (first + last);
    let on_b = closest_on_segment(a[0] + (a[1] - a[0]) * s, b);
    [[1.0 - s, s], on_b]
}

/// Where a point lies in a convex polytope: its nearest face, and how deep under that face's plane, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth {
    /// Index of the triangle; of equally near ones the lowest.
    pub face: usize,
    /// The face's unit normal, outwards.
    pub normal: DVec3,
    /// Distance to the face's plane, in m; 0 on the surface.
    pub depth: f64,
}

/// The nearest face of the convex polytope around `point`, or `None` if the point is outside. Triangles are
/// counter-clockwise seen from outside; those without area are passed over. A polytope without faces contains
/// nothing, and neither does an index out of range.
pub fn depth_in_convex(point: DVec3, positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Depth> {
    let mut nearest: Option<Depth> = None;
    for (face, triangle) in triangles.iter().enumerate() {
        let [a, b, c] = corners(positions, triangle)?;
        let normal = (b - a).cross(c - a);
        let length = normal.norm();
        if length == 0.0 {
            continue;
        }
        let normal = normal / length;
        let depth = normal.dot(a - point);
        if depth < 0.0 {
            return None;
        }
        if nearest.is_none_or(|n| depth < n.depth) {
            nearest = Some(Depth { face, normal, depth });
        }
    }
    nearest
}

fn corners(positions: &[Vec3], &[a, b, c]: &[u32; 3]) -> Option<[DVec3; 3]> {
    let corner = |index: u32| positions.get(index as usize).map(|p| p.as_dvec3());
    Some([corner(a)?, corner(b)?, corner(c)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Coordinates on a lattice make parallel, collinear and coincident corners common.
    fn point() -> impl Strategy<Value = DVec3> {
        let lattice =
            prop::array::uniform3(-3..=3).prop_map(|c: [i32; 3]| DVec3::from_array(c.map(f64::from)));
        let anywhere = prop::array::uniform3(-3.0..3.0).prop_map(DVec3::from_array);
        prop_oneof![lattice, anywhere]
    }

    fn sum<const N: usize>(weights: [f64; N], corners: [DVec3; N]) -> DVec3 {
        assert!(weights.iter().all(|&w| w >= 0.0) && (weights.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        weights.into_iter().zip(corners).map(|(weight, corner)| corner * weight).sum()
    }

    /// A point of a convex hull is the closest to `point` if and only if no corner lies further towards it.
    fn is_closest(found: DVec3, point: DVec3, corners: &[DVec3]) -> bool {
        corners.iter().all(|&corner| (point - found).dot(corner - found) < 1e-9)
    }

    #[test]
    fn weights_of_a_sliver_sum_to_one() {
        let corner = DVec3::new(12.078_612_327_575_684, 12.078_431_129_455_566, 2.0);
        let [small, smaller] = [2.715_197_069_846_907e-6, 2.715_166_829_148_074_6e-6];
        let corners =
            [DVec3::new(small, smaller, smaller) - corner, DVec3::splat(smaller) - corner, DVec3::ZERO];
        for point in [DVec3::ZERO, corners[0] * 0.5, corners[1] * 1e-3, DVec3::X] {
            // It asserts just that.
            sum(closest_on_triangle(point, corners), corners);
        }
    }

    proptest! {
        #[test]
        fn no_corner_is_further_towards_the_point(p in point(), corners in prop::array::uniform3(point())) {
            let [a, b, _] = corners;
            prop_assert!(is_closest(sum(closest_on_segment(p, [a, b]), [a, b]), p, &[a, b]));
            prop_assert!(is_closest(sum(closest_on_triangle(p, corners), corners), p, &corners));
        }

        #[test]
        fn each_segment_is_closest_to_the_others_point(
            a in prop::array::uniform2(point()),
            b in prop::array::uniform2(point()),
        ) {
            let [on_a, on_b] = closest_between_segments(a, b);
            let (p, q) = (sum(on_a, a), sum(on_b, b));
            prop_assert!(is_closest(p, q, &a) && is_closest(q, p, &b), "{} {}", p, q);
        }
    }

    #[test]
    fn parallel_segments_meet_in_the_middle_of_their_overlap() {
        let a = [DVec3::ZERO, DVec3::X * 4.0];
        let b = [DVec3::new(6.0, 1.0, 0.0), DVec3::new(2.0, 1.0, 0.0)];
        assert_eq!(closest_between_segments(a, b), [[0.25, 0.75], [0.25, 0.75]]);
    }

    #[test]
    fn depth_is_measured_from_the_nearest_face() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]];
        let depth = |x, y, z| depth_in_convex(DVec3::new(x, y, z), &positions, &triangles);
        let nearest = depth(0.1, 0.2, 0.3).unwrap();
        assert_eq!((nearest.face, nearest.normal), (1, DVec3::NEG_X));
        assert!((nearest.depth - 0.1).abs() < 1e-12);
        assert_eq!(depth(0.25, 0.25, 0.0).unwrap().depth, 0.0);
        assert_eq!(depth(0.5, 0.5, 0.5), None);
        assert_eq!(depth_in_convex(DVec3::ZERO, &positions, &[]), None);
    }
}
