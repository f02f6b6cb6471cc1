//! The Gilbert–Johnson–Keerthi algorithm in van den Bergen's variant ("A fast and robust GJK implementation for
//! collision detection of convex objects", 1999; paper 5.1): walks simplices of A ⊖ B towards the origin. A pair
//! starts from the separating axis it ended with last time, and where that still separates, one pair of support
//! points settles it.

use glam::{DVec3, Vec3};

use super::simplex::{CsoVertex, Simplex};
use super::support::Support;

/// Most iterations that a query may take, those of EPA included.
pub const MAX_ITERATIONS: u32 = 64;

/// The closest point is accepted when the true one is nearer by at most this part of its distance.
const RELATIVE_GAP: f64 = 1e-12;
/// Nearer to the origin than this part of A ⊖ B's reach, the sets touch. f64 leaves some 1e-15 of noise.
const TOUCHING: f64 = 1e-12;
/// How much too far the answer may be, as part of A ⊖ B's reach, and still count as converged. Rounding tilts a
/// closest point at distance d by 1e-16/d, so it can hide the square root of 1e-16, times the edges of a sliver.
const ACCEPTED_GAP: f64 = 1e-7;

/// How two convex sets lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proximity {
    /// Some axis separates them.
    Separated,
    /// They share a point at least, touching included.
    Intersecting,
    /// The iterations ran out, or rounding stopped them, before either was certain.
    Unresolved,
}

/// What GJK found.
#[derive(Debug, Clone, Copy)]
pub struct Gjk {
    /// How the sets lie.
    pub proximity: Proximity,
    /// Intersecting: a simplex that holds the origin, to be expanded by EPA. Separated, from [`closest`]: the
    /// vertices and weights of the closest point.
    pub simplex: Simplex,
    /// The point of A ⊖ B closest to the origin, from B to A, in m; zero if they intersect. An upper bound unless
    /// the query was [`closest`].
    pub separation: DVec3,
    /// Pairs of support points computed.
    pub iterations: u32,
    /// Whether the answer is certain within rounding.
    pub converged: bool,
}

/// Whether A and B intersect; stops at the first separating axis.
///
/// `axis` points from A to B and need not be unit; zero means unknown. Where the sets are separated it is
/// replaced by a unit axis that separates them: keep it with the pair for the next frame.
pub fn intersect(a: &impl Support, b: &impl Support, axis: &mut Vec3) -> Gjk {
    let mut walk = Walk::new(*axis);
    walk.run(a, b, true);
    walk.finish(axis)
}

/// The closest points of A and B, or the fact that they intersect. `axis` is as for [`intersect`].
pub fn closest(a: &impl Support, b: &impl Support, axis: &mut Vec3) -> Gjk {
    let mut walk = Walk::new(*axis);
    walk.run(a, b, false);
    walk.finish(axis)
}

struct Walk {
    simplex: Simplex,
    /// Where the next support point is sought, from A to B: minus the closest point so far.
    direction: DVec3,
    /// |closest point|² so far.
    distance_squared: f64,
    /// The largest |vertex|² seen: the scale of rounding.
    reach_squared: f64,
    proximity: Proximity,
    iterations: u32,
    converged: bool,
}

impl Walk {
    fn new(axis: Vec3) -> Self {
        let axis = axis.as_dvec3();
        let is_usable = axis.is_finite() && axis != DVec3::ZERO;
        Self {
            simplex: Simplex::default(),
            direction: if is_usable { axis } else { DVec3::X },
            distance_squared: f64::INFINITY,
            reach_squared: 0.0,
            proximity: Proximity::Unresolved,
            iterations: 0,
            converged: false,
        }
    }

    fn run(&mut self, a: &impl Support, b: &impl Support, only_whether: bool) {
        while self.iterations < MAX_ITERATIONS {
            self.iterations += 1;
            let vertex = CsoVertex::support(a, b, self.direction);
            let height = self.direction.dot(vertex.point);
            if height < 0.0 {
                // All of A ⊖ B lies below the plane through the origin: the direction separates.
                self.proximity = Proximity::Separated;
                if only_whether {
                    self.converged = true;
                    return;
                }
            }
            if self.is_closest(&vertex, height) || !self.advance(vertex) {
                return;
            }
        }
    }

    /// |v|² + height bounds how much nearer the true closest point can be, times |v|. A vertex that comes back
    /// promises no progress whatever rounding says.
    fn is_closest(&mut self, vertex: &CsoVertex, height: f64) -> bool {
        if self.simplex.vertices().is_empty() {
            return false;
        }
        let gap = self.distance_squared + height;
        self.reach_squared = self.reach_squared.max(vertex.point.length_squared());
        self.converged =
            gap * gap <= ACCEPTED_GAP * ACCEPTED_GAP * self.distance_squared * self.reach_squared;
        gap <= RELATIVE_GAP * self.distance_squared || self.simplex.contains(vertex)
    }

    /// Takes the vertex in; false when the walk is over.
    fn advance(&mut self, vertex: CsoVertex) -> bool {
        let before = self.simplex;
        self.reach_squared = self.reach_squared.max(vertex.point.length_squared());
        self.simplex.push(vertex);
        let Some(point) = self.simplex.reduce() else {
            return self.intersecting();
        };
        let distance_squared = point.length_squared();
        if distance_squared <= TOUCHING * TOUCHING * self.reach_squared {
            return self.intersecting();
        }
        if distance_squared >= self.distance_squared {
            // Rounding: the simplex before was as good. `converged` says how good that is.
            self.simplex = before;
            return false;
        }
        self.distance_squared = distance_squared;
        self.direction = -point;
        true
    }

    fn intersecting(&mut self) -> bool {
        self.proximity = Proximity::Intersecting;
        self.converged = true;
        self.distance_squared = 0.0;
        false
    }

    fn finish(mut self, axis: &mut Vec3) -> Gjk {
        if self.proximity == Proximity::Unresolved && self.converged {
            // The origin is as near as rounding can tell.
            self.intersecting();
        }
        if self.proximity == Proximity::Separated {
            *axis = (self.direction / self.direction.length()).as_vec3();
        }
        let separation =
            if self.proximity == Proximity::Intersecting { DVec3::ZERO } else { -self.direction };
        Gjk {
            proximity: self.proximity,
            simplex: self.simplex,
            separation,
            iterations: self.iterations,
            converged: self.converged,
        }
    }
}
