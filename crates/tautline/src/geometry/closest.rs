//! Closest points of segments, triangles and convex polytopes, as barycentric weights. In f64: callers hold f32
//! points, whose differences are then exact, and a sliver costs accuracy instead of the answer.

use glam::{DVec3, Vec3};

/// sin² of an angle below which three points count as collinear and two segments as parallel.
const PARALLEL: f64 = 1e-24;

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
    if area_squared > PARALLEL * (b - a).length_squared() * (c - a).length_squared() {
        // Weights as areas of the three triangles under the point's projection.
        let (pa, pb, pc) = (a - point, b - point, c - point);
        let weights = [pb.cross(pc), pc.cross(pa), pa.cross(pb)].map(|area| area.dot(normal) / area_squared);
        if weights.iter().all(|&weight| weight >= 0.0) {
            return weights;
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
        let length = normal.length();
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
