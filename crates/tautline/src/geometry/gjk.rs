//! The Gilbert–Johnson–Keerthi algorithm in van den Bergen's variant ("A fast and robust GJK implementation for
//! collision detection of convex objects", 1999; paper 5.1): walks simplices of A ⊖ B towards the origin. A pair
//! starts from the separating axis it ended with last time, and where that still separates, one pair of support
//! points settles it.

use glam::{DVec3, Vec3};

use super::simplex::{CsoVertex, Simplex};
use super::support::Support;
use crate::norm::Norm;

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
    /// Intersecting: a simplex that holds the origin, to be expanded by EPA. Otherwise, from [`closest`]: the
    /// vertices and weights of the point of A ⊖ B closest to the origin.
    pub simplex: Simplex,
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
    let found = walk.finish(axis);
    // One separating axis is proof enough, however far the closest point is.
    Gjk { converged: found.converged || found.proximity == Proximity::Separated, ..found }
}

/// The closest points of A and B, or the fact that they intersect. `axis` is as for [`intersect`].
pub fn closest(a: &impl Support, b: &impl Support, axis: &mut Vec3) -> Gjk {
    let mut walk = Walk::new(*axis);
    walk.run(a, b, false);
    walk.finish(axis)
}

/// What an iteration did, to be looked at.
#[derive(Debug, Clone, Copy)]
pub struct Iteration {
    /// Where the support point was sought, from A to B.
    pub direction: DVec3,
    /// What was found there.
    pub vertex: CsoVertex,
    /// The simplex after it was taken in and reduced.
    pub simplex: Simplex,
    /// The point of the simplex that is closest to the origin.
    pub closest: DVec3,
}

/// As [`closest()`], telling `visit` every iteration.
pub fn trace(a: &impl Support, b: &impl Support, axis: &mut Vec3, visit: &mut dyn FnMut(Iteration)) -> Gjk {
    let mut walk = Walk::new(*axis);
    let mut goes_on = true;
    while goes_on && walk.iterations < MAX_ITERATIONS {
        let direction = walk.direction;
        let vertex = CsoVertex::support(a, b, direction);
        goes_on = walk.iterate(vertex, false);
        // Four vertices are left only where they hold the origin.
        let holds_origin = walk.simplex.vertices().len() == 4;
        let closest = if holds_origin { DVec3::ZERO } else { walk.simplex.closest_point() };
        visit(Iteration { direction, vertex, simplex: walk.simplex, closest });
    }
    walk.finish(axis)
}

struct Walk {
    simplex: Simplex,
    /// Where the next support point is sought, from A to B: minus v, the closest point so far.
    direction: DVec3,
    /// |v|²; infinite before the first vertex.
    distance_squared: f64,
    /// |v| times how much nearer the true closest point can be: |v|² − min v · x over A ⊖ B.
    gap: f64,
    /// The largest |vertex|² seen: the scale of rounding.
    reach_squared: f64,
    proximity: Proximity,
    iterations: u32,
}

impl Walk {
    fn new(axis: Vec3) -> Self {
        let axis = axis.as_dvec3();
        let is_usable = axis.is_finite() && axis != DVec3::ZERO;
        Self {
            simplex: Simplex::default(),
            direction: if is_usable { axis } else { DVec3::X },
            distance_squared: f64::INFINITY,
            gap: f64::INFINITY,
            reach_squared: 0.0,
            proximity: Proximity::Unresolved,
            iterations: 0,
        }
    }

    fn run(&mut self, a: &impl Support, b: &impl Support, only_whether: bool) {
        while self.iterations < MAX_ITERATIONS {
            let vertex = CsoVertex::support(a, b, self.direction);
            if !self.iterate(vertex, only_whether) {
                return;
            }
        }
    }

    /// Looks at the support point along the direction; false when the walk is over.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn iterate(&mut self, vertex: CsoVertex, only_whether: bool) -> bool {
        self.iterations += 1;
        let height = self.direction.dot(vertex.point);
        if height < 0.0 {
            // All of A ⊖ B lies below the plane through the origin: the direction separates.
            self.proximity = Proximity::Separated;
            if only_whether {
                return false;
            }
        }
        self.gap = self.distance_squared + height;
        self.reach_squared = self.reach_squared.max(vertex.point.length_squared());
        !self.is_closest(&vertex) && self.advance(vertex)
    }

    /// A vertex that comes back promises no progress, whatever rounding says.
    fn is_closest(&self, vertex: &CsoVertex) -> bool {
        let has_started = self.distance_squared.is_finite();
        has_started && (self.gap <= RELATIVE_GAP * self.distance_squared || self.simplex.contains(vertex))
    }

    /// Takes the vertex in; false when the walk is over.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn advance(&mut self, vertex: CsoVertex) -> bool {
        let before = self.simplex;
        self.simplex.push(vertex);
        let point = self.simplex.reduce().unwrap_or(DVec3::ZERO);
        let distance_squared = point.length_squared();
        if distance_squared <= TOUCHING * TOUCHING * self.reach_squared {
            self.proximity = Proximity::Intersecting;
            return false;
        }
        if distance_squared >= self.distance_squared {
            // Rounding: the simplex before was as good, and the gap says how good that is.
            self.simplex = before;
            return false;
        }
        self.distance_squared = distance_squared;
        self.direction = -point;
        true
    }

    fn is_certain(&self) -> bool {
        self.proximity == Proximity::Intersecting || self.is_near() || self.is_narrow()
    }

    /// Whether the closest point is as near as rounding can tell.
    fn is_near(&self) -> bool {
        self.distance_squared <= self.accepted_squared()
    }

    /// Whether nothing is nearer by more than rounding: then the plane at the closest point separates.
    fn is_narrow(&self) -> bool {
        self.gap * self.gap <= self.accepted_squared() * self.distance_squared
    }

    fn accepted_squared(&self) -> f64 {
        ACCEPTED_GAP * ACCEPTED_GAP * self.reach_squared
    }

    fn finish(self, axis: &mut Vec3) -> Gjk {
        let converged = self.is_certain();
        let proximity = match self.proximity {
            // The origin is as near as rounding can tell.
            Proximity::Unresolved if converged => Proximity::Intersecting,
            // And the direction to it tells nothing: a direction before has separated, this one does not.
            Proximity::Separated if self.is_near() && !self.is_narrow() => Proximity::Intersecting,
            proximity => proximity,
        };
        if proximity == Proximity::Separated {
            *axis = (self.direction / self.direction.norm()).as_vec3();
        }
        Gjk { proximity, simplex: self.simplex, iterations: self.iterations, converged }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::support::Points;

    #[test]
    fn a_trace_ends_where_the_query_does_and_comes_nearer_all_the_way() {
        let corners = |center: Vec3| -> Vec<Vec3> {
            (0..8).map(|i| center + Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect()
        };
        for offset in [Vec3::new(3.0, 0.4, 0.2), Vec3::new(0.5, 0.4, 0.2), Vec3::new(1.5, 1.3, 1.1)] {
            let (a, b) = (corners(Vec3::ZERO), corners(offset));
            let (mut distances, mut axes) = (Vec::new(), [Vec3::ZERO; 2]);
            let found = closest(&Points(&a), &Points(&b), &mut axes[0]);
            let traced = trace(&Points(&a), &Points(&b), &mut axes[1], &mut |iteration| {
                distances.push(iteration.closest.length());
            });
            assert_eq!((traced.iterations, traced.proximity), (found.iterations, found.proximity));
            assert_eq!((distances.len() as u32, axes[0]), (found.iterations, axes[1]));
            assert!(distances.is_sorted_by(|before, after| before >= after), "{distances:?}");
            if found.proximity == Proximity::Separated {
                assert_eq!(distances.last().copied(), Some(found.simplex.closest_point().length()));
            }
        }
    }
}
