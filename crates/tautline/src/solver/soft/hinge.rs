//! Angles that are held: at the inner particles of ropes, and between the triangles of cloth.

use crate::constraint::{Angle, Bending, angle_gradient, bending_gradient};
use crate::solver::soft::points::Points;

/// The angles of a piece, by place.
#[derive(Debug, Clone, Default)]
pub(super) struct Hinges {
    angles: Vec<Angle>,
    bendings: Vec<Bending>,
    /// Whether they were given as stiffness, which is to come out as it was asked.
    by_stiffness: bool,
}

/// Hinges are turned once in so many small steps: angles take a dozen times as long as sticks, and are softer.
pub(super) const EVERY: u32 = 2;

impl Hinges {
    /// `place` tells where a particle of the body is.
    pub(super) fn new(
        angles: &[Angle],
        bendings: &[Bending],
        by_stiffness: bool,
        place: impl Fn(usize) -> usize,
    ) -> Self {
        let at = |particle: u32| place(particle as usize) as u32;
        let angle = |angle: &Angle| Angle { a: at(angle.a), b: at(angle.b), c: at(angle.c), ..*angle };
        let bending = |bending: &Bending| Bending {
            edge: bending.edge.map(at),
            wings: bending.wings.map(at),
            ..*bending
        };
        let (angles, bendings) = (angles.iter().map(angle), bendings.iter().map(bending));
        Self { angles: angles.collect(), bendings: bendings.collect(), by_stiffness }
    }

    /// Turns every hinge once; `h_squared` is a small step times the time from one such turn to the next, in s².
    pub(super) fn turn(&self, points: &mut Points, h_squared: f32) {
        // Half of the hinges around one have turned before it: see `bend`.
        let early = if self.by_stiffness { 0.5 } else { 0.0 };
        for angle in &self.angles {
            let places = [angle.a, angle.b, angle.c].map(|place| place as usize);
            let [a, b, c] = places.map(|place| points.at(place));
            if let Some((value, gradients)) = angle_gradient(a, b, c) {
                let (violation, compliance) = (angle.limit.violation(value), angle.compliance / h_squared);
                relax(points, places, gradients, violation, [compliance, early]);
            }
        }
        for bending in &self.bendings {
            let [w0, w1] = bending.wings.map(|place| place as usize);
            let [e0, e1] = bending.edge.map(|place| place as usize);
            let at = |place: usize| points.at(place);
            if let Some((value, gradients)) = bending_gradient([at(w0), at(w1)], [at(e0), at(e1)]) {
                let (violation, compliance) =
                    (bending.limit.violation(value), bending.compliance / h_squared);
                relax(points, [w0, w1, e0, e1], gradients, violation, [compliance, early]);
            }
        }
    }
}

/// λ = −C/max(α/h² + `early` M, M) with M = Σ w|∇C|², as in `bend`.
fn relax<const N: usize>(
    points: &mut Points,
    places: [usize; N],
    gradients: [glam::Vec3; N],
    violation: f32,
    [compliance, early]: [f32; 2],
) {
    let masses = places.map(|place| points.inverse_mass[place]);
    let mobility: f32 =
        masses.iter().zip(gradients).map(|(mass, gradient)| mass * gradient.length_squared()).sum();
    if violation == 0.0 || mobility <= 0.0 {
        return;
    }
    let multiplier = -violation / mobility.max(compliance + early * mobility);
    for ((place, mass), gradient) in places.into_iter().zip(masses).zip(gradients) {
        points.shift(place, gradient * (mass * multiplier));
    }
}
