//! The smallest sphere around any number of points, and the at most four points that hold it up.
//!
//! Welzl, "Smallest enclosing disks (balls and ellipsoids)", 1991, in the pivoting form of Gärtner, "Fast
//! and robust smallest enclosing balls", ESA 1999: the point farthest outside is moved to the front,
//! which here means that it enters a support of at most four. Nothing is random, the radius grows with every
//! step, and all arithmetic is in f64 relative to the first point, where f32 input loses nothing.

use glam::{DMat3, DVec3, Vec3};
use serde::{Deserialize, Serialize};

use super::Sphere;

/// A point counts as inside if its squared distance exceeds the squared radius by less than this factor.
const INSIDE: f64 = 1.0 + 1e-10;
/// Relative determinant under which points count as affinely dependent. Such a support is never needed: fewer
/// points give the same sphere to within `INSIDE`.
const DEPENDENT: f64 = 1e-13;
/// Far above what any input needs (about ten); a bound against rounding without end.
const MAX_PIVOTS: usize = 1000;

/// The points on a smallest enclosing sphere that determine it. Its centre is their weighted mean, and stays
/// so under any rigid (indeed affine) motion of the points.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SupportPoints {
    /// Indices of the support points; from `count` on, the first one is repeated.
    pub points: [u32; 4],
    /// Barycentric weights of the centre: not negative, their sum 1; 0 from `count` on.
    pub weights: [f32; 4],
    /// How many points there are, 1 to 4.
    pub count: u8,
}

/// A smallest enclosing sphere with its support.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EnclosingSphere {
    /// The sphere; it contains every point in exact arithmetic.
    pub sphere: Sphere,
    /// The points that determine it.
    pub support: SupportPoints,
}

/// The smallest sphere around `points`; duplicates and points on a line, plane or sphere are fine.
///
/// Equal candidates are decided by the lowest index. `None` for no points and for points that are
/// not finite.
pub fn smallest_enclosing_sphere(points: &[Vec3]) -> Option<EnclosingSphere> {
    let origin = points.first()?.as_dvec3();
    if !points.iter().all(|point| point.is_finite()) {
        return None;
    }
    let relative = |index: u32| points[index as usize].as_dvec3() - origin;
    let mut basis = Basis::of_point(0, DVec3::ZERO);
    for _ in 0..MAX_PIVOTS {
        let (pivot, distance_squared) = farthest(points, origin + basis.center);
        if distance_squared <= basis.radius_squared * INSIDE {
            break;
        }
        match basis.with(pivot, relative) {
            Some(next) if next.radius_squared > basis.radius_squared => basis = next,
            // Rounding has the last word: the radius below still covers every point.
            _ => break,
        }
    }
    let center = (origin + basis.center).as_vec3();
    let (_, distance_squared) = farthest(points, center.as_dvec3());
    let sphere = Sphere { center, radius: round_up(distance_squared.sqrt()) };
    Some(EnclosingSphere { sphere, support: basis.support() })
}

/// The smallest sphere *through* one to four points: its centre lies in their affine hull.
///
/// `None` for any other number of points, and where no such sphere exists: points that coincide, three
/// on a line, four in a plane.
pub fn circumsphere(points: &[Vec3]) -> Option<Sphere> {
    let origin = points.first()?.as_dvec3();
    let mut relative = [DVec3::ZERO; 4];
    for (slot, point) in relative.get_mut(..points.len())?.iter_mut().zip(points) {
        *slot = point.as_dvec3() - origin;
    }
    let ball = circumball(&relative[..points.len()])?;
    Some(Sphere { center: (origin + ball.center).as_vec3(), radius: ball.radius_squared.sqrt() as f32 })
}

struct Ball {
    center: DVec3,
    radius_squared: f64,
    weights: [f64; 4],
}

/// With dᵢ = pᵢ − p₀ the centre is p₀ + Σ μᵢdᵢ, and equal distance to all points means Σⱼ (dᵢ·dⱼ) μⱼ = ½ dᵢ·dᵢ.
/// Unused rows are those of the identity, so that one 3 × 3 system serves for 1 to 4 points.
fn circumball(points: &[DVec3]) -> Option<Ball> {
    let first = points[0];
    let mut gram = DMat3::IDENTITY;
    let mut half_squares = DVec3::ZERO;
    let mut scale = 1.0;
    for (i, p) in points[1..].iter().enumerate() {
        for (j, q) in points[1..].iter().enumerate() {
            gram.col_mut(j)[i] = (p - first).dot(q - first);
        }
        half_squares[i] = 0.5 * gram.col(i)[i];
        scale *= gram.col(i)[i];
    }
    let determinant = gram.determinant();
    // Hadamard: the determinant is at most the product of the diagonal. Written so that NaN fails.
    let independent = determinant > DEPENDENT * scale;
    if !independent {
        return None;
    }
    let [x, y, z] = [gram.x_axis, gram.y_axis, gram.z_axis];
    let solution =
        DVec3::new(half_squares.dot(y.cross(z)), half_squares.dot(z.cross(x)), half_squares.dot(x.cross(y)))
            / determinant;
    let mut offset = DVec3::ZERO;
    for (i, p) in points[1..].iter().enumerate() {
        offset += (p - first) * solution[i];
    }
    let weights = [1.0 - solution.element_sum(), solution.x, solution.y, solution.z];
    Some(Ball { center: first + offset, radius_squared: offset.length_squared(), weights })
}

/// A support and its ball, relative to the origin of the computation.
struct Basis {
    points: [u32; 4],
    count: usize,
    center: DVec3,
    radius_squared: f64,
    weights: [f64; 4],
}

impl Basis {
    fn of_point(index: u32, position: DVec3) -> Self {
        let weights = [1.0, 0.0, 0.0, 0.0];
        Basis { points: [index; 4], count: 1, center: position, radius_squared: 0.0, weights }
    }

    /// The smallest ball around this support and `pivot`, which lies outside and so is on its surface: the
    /// smallest ball through the pivot and some of the others that contains the rest of them.
    fn with(&self, pivot: u32, position: impl Fn(u32) -> DVec3) -> Option<Basis> {
        let members = &self.points[..self.count];
        let mut best: Option<Basis> = None;
        for chosen in 1..(1_u32 << self.count) {
            if chosen.count_ones() > 3 {
                continue;
            }
            let mut points = [pivot; 4];
            let mut count = 1;
            for (bit, &member) in members.iter().enumerate() {
                if chosen & (1 << bit) != 0 {
                    points[count] = member;
                    count += 1;
                }
            }
            let corners = points.map(&position);
            let Some(Ball { center, radius_squared, weights }) = circumball(&corners[..count]) else {
                continue;
            };
            let smaller = best.as_ref().is_none_or(|best| radius_squared < best.radius_squared);
            let inside = |&index: &u32| position(index).distance_squared(center) <= radius_squared * INSIDE;
            if smaller && members.iter().all(inside) {
                best = Some(Basis { points, count, center, radius_squared, weights });
            }
        }
        best
    }

    fn support(&self) -> SupportPoints {
        // Rounding can leave a weight at -1e-17, which must not reach the interface as negative.
        let weights = self.weights.map(|weight| weight.max(0.0) as f32);
        SupportPoints { points: self.points, weights, count: self.count as u8 }
    }
}

/// The point farthest from `center`, the first of equals, and its squared distance.
fn farthest(points: &[Vec3], center: DVec3) -> (u32, f64) {
    let mut best = (0, 0.0);
    for (index, point) in points.iter().enumerate() {
        let distance_squared = point.as_dvec3().distance_squared(center);
        if distance_squared > best.1 {
            best = (index as u32, distance_squared);
        }
    }
    best
}

/// The next f32 that is not below `value`.
fn round_up(value: f64) -> f32 {
    let rounded = value as f32;
    if f64::from(rounded) < value { rounded.next_up() } else { rounded }
}
