//! Queries on two convex sets: the contact that a step asks for, and the signed distance for everybody else.
//! Both run the same GJK and EPA.

use glam::{DVec3, Vec3};

use super::epa::Epa;
use super::feature::{ContactFeatures, FeaturePoint};
use super::gjk::{self, Gjk, MAX_ITERATIONS, Proximity};
use super::rows::PointRows;
use super::support::{Points, Support};
use crate::Error;
use crate::norm::Norm;

/// What [`contact`] found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The touching features, or `None` if the sets are apart.
    pub features: Option<ContactFeatures>,
    /// Iterations of GJK and EPA, at most 64.
    pub iterations: u32,
    /// Whether the answer is certain within rounding; see [`Distance::converged`].
    pub converged: bool,
}

/// Whether A and B intersect, and if so, where: GJK from the pair's `axis` of the last step, then EPA.
///
/// `axis` points from A to B; zero means unknown. It is replaced by the axis found, to be kept for the next
/// step: one that separates, or the contact normal. `epa` is scratch memory.
pub fn contact(a: &impl Support, b: &impl Support, axis: &mut Vec3, epa: &mut Epa) -> Contact {
    let gjk = gjk::intersect(a, b, axis);
    if gjk.proximity != Proximity::Intersecting {
        return Contact { features: None, iterations: gjk.iterations, converged: gjk.converged };
    }
    let face = epa.hit_face(a, b, &gjk.simplex, *axis, MAX_ITERATIONS - gjk.iterations);
    *axis = face.normal.as_vec3();
    Contact {
        features: Some(ContactFeatures::new(a, b, &face)),
        iterations: gjk.iterations + face.iterations,
        converged: face.converged,
    }
}

/// The signed distance of two convex hulls, and where it is realised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// Above 0 the gap between the hulls, below 0 the depth of penetration (the shortest translation that takes
    /// them apart), in m.
    pub distance: f32,
    /// Unit, from A to B: `point_b - point_a` is `distance * normal`. If they penetrate, moving B by the depth
    /// along it separates them. Of a gap that is tiny beside the coordinates, rounding tilts it: by 1e-15 times the largest
    /// coordinate over the gap.
    pub normal: Vec3,
    /// The witness point on A, in m: closest to B, or deepest in it.
    pub point_a: Vec3,
    /// The witness point on B, in m.
    pub point_b: Vec3,
    /// The feature of A that holds `point_a`, as indices into the points of A.
    pub feature_a: FeaturePoint,
    /// The feature of B that holds `point_b`.
    pub feature_b: FeaturePoint,
    /// Iterations taken, at most 64.
    pub iterations: u32,
    /// Whether the answer is certain within rounding. If not, a gap is an upper bound of the true one, and so is a
    /// depth: the normal still separates, but a shorter way may exist, and the witness points do not quite realise
    /// it. That takes hundreds of points about equally near, such as two fine balls deep in each other.
    pub converged: bool,
}

/// The signed distance of the convex hulls of two point sets, in any order, duplicates and flat sets allowed.
///
/// The same sets swapped give the same bits mirrored: A and B exchanged, the normal reversed. (Only of a set and
/// itself can the mirror image not be told from the original.) Takes at most 64 iterations and says whether that
/// was enough.
///
/// # Errors
///
/// [`Error::Invalid`] if a set is empty and [`Error::OutOfRange`] if a coordinate is not finite; the field is
/// `a`, `b`, or the point, such as `a[3]`.
pub fn distance(a: &[Vec3], b: &[Vec3]) -> Result<Distance, Error> {
    let (a, b) = (Set::new("a", a)?, Set::new("b", b)?);
    if is_in_order(a.points, b.points) {
        Ok(ordered_distance(&a, &b))
    } else {
        Ok(ordered_distance(&b, &a).mirrored())
    }
}

/// So many points are worth being arranged in rows.
const MANY: usize = 48;

/// Points that have been checked, and a point amid them.
struct Set<'a> {
    points: &'a [Vec3],
    middle: Vec3,
}

impl<'a> Set<'a> {
    fn new(field: &str, points: &'a [Vec3]) -> Result<Self, Error> {
        let middle = sum(points) / points.len() as f32;
        // Of finite points the sum may be too large, of others it is never finite.
        if !middle.is_finite() {
            check(field, points)?;
        }
        Ok(Self { points, middle })
    }
}

/// Four sums at a time: an addition need not wait for the one before.
fn sum(points: &[Vec3]) -> Vec3 {
    let (fours, rest) = points.as_chunks::<4>();
    let mut sums = [Vec3::ZERO; 4];
    for four in fours {
        for (sum, &point) in sums.iter_mut().zip(four) {
            *sum += point;
        }
    }
    sums.iter().chain(rest).sum()
}

fn check(field: &str, points: &[Vec3]) -> Result<(), Error> {
    if points.is_empty() {
        let problem = "it has no points; a convex set needs at least one".to_owned();
        return Err(Error::Invalid { field: field.to_owned(), problem });
    }
    for (i, point) in points.iter().enumerate() {
        if let Some(value) = point.to_array().into_iter().find(|value| !value.is_finite()) {
            return Err(Error::OutOfRange {
                field: format!("{field}[{i}]"),
                value: value.into(),
                expected: "a point with finite coordinates",
            });
        }
    }
    Ok(())
}

/// An order of point sets, so that a query and its mirror image run the same arithmetic.
fn is_in_order(a: &[Vec3], b: &[Vec3]) -> bool {
    let by_coordinate = || {
        let pairs = a.iter().flat_map(|p| p.to_array()).zip(b.iter().flat_map(|p| p.to_array()));
        pairs.map(|(x, y)| x.total_cmp(&y)).find(|order| order.is_ne())
    };
    match a.len().cmp(&b.len()) {
        std::cmp::Ordering::Equal => by_coordinate().is_none_or(|order| order.is_lt()),
        order => order.is_lt(),
    }
}

fn ordered_distance(a: &Set, b: &Set) -> Distance {
    let mut axis = b.middle - a.middle;
    let is_few = a.points.len().max(b.points.len()) < MANY;
    let (a, b) = (Points(a.points), Points(b.points));
    let gjk = if is_few {
        gjk::closest(&a, &b, &mut axis)
    } else {
        gjk::closest(&PointRows::new(a.0), &PointRows::new(b.0), &mut axis)
    };
    if gjk.proximity == Proximity::Intersecting {
        let budget = MAX_ITERATIONS - gjk.iterations;
        let face = Epa::with_room().hit_face(&a, &b, &gjk.simplex, axis, budget);
        Distance::penetrating(
            ContactFeatures::new(&a, &b, &face),
            gjk.iterations + face.iterations,
            face.converged,
        )
    } else {
        Distance::separated(&a, &b, &gjk)
    }
}

impl Distance {
    fn penetrating(contact: ContactFeatures, iterations: u32, converged: bool) -> Self {
        Self {
            distance: 0.0 - contact.depth, // and not −0 when they just touch
            normal: contact.normal,
            point_a: contact.point_a,
            point_b: contact.point_b,
            feature_a: contact.a,
            feature_b: contact.b,
            iterations,
            converged,
        }
    }

    fn separated(a: &impl Support, b: &impl Support, gjk: &Gjk) -> Self {
        let (vertices, weights) = gjk.simplex.triangle();
        let weighted =
            |points: [DVec3; 3]| points[0] * weights[0] + points[1] * weights[1] + points[2] * weights[2];
        // From B to A.
        let separation = gjk.simplex.closest_point();
        let gap = separation.norm();
        Self {
            distance: (gap as f32).min(f32::MAX),
            normal: (-separation / gap).as_vec3(),
            point_a: weighted(vertices.map(|v| a.point(v.a))).as_vec3(),
            point_b: weighted(vertices.map(|v| b.point(v.b))).as_vec3(),
            feature_a: FeaturePoint::new(vertices.map(|v| v.a), weights),
            feature_b: FeaturePoint::new(vertices.map(|v| v.b), weights),
            iterations: gjk.iterations,
            converged: gjk.converged,
        }
    }

    fn mirrored(self) -> Self {
        Self {
            normal: -self.normal,
            point_a: self.point_b,
            point_b: self.point_a,
            feature_a: self.feature_b,
            feature_b: self.feature_a,
            ..self
        }
    }
}
