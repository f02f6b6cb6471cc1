//! The stick: two particles kept at a distance (paper, 3.2 and 6.2).

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::norm::Norm;
use crate::settings::SquareRoot;

/// Two particles of a body and the distance at which they are kept: |x_b − x_a| = d.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Stick {
    /// One end, counted within the body.
    pub a: u32,
    /// The other end.
    pub b: u32,
    /// d, in m.
    pub rest_length: f32,
}

impl Stick {
    /// Whether its length is one that can be relaxed to.
    pub(crate) fn is_sound(&self) -> bool {
        (self.rest_length * self.rest_length).is_normal() && self.rest_length > 0.0
    }

    /// Refuses sticks whose squared length is no normal number.
    pub(crate) fn check_all(sticks: &[Self], field: &str) -> Result<(), Error> {
        if sticks.iter().all(Self::is_sound) {
            return Ok(());
        }
        let problem = "gives an edge of a length outside 1e-18 to 1e18 m".into();
        Err(Error::Invalid { field: field.into(), problem })
    }

    /// By what share of its length it is too long where its body's particles are.
    pub(crate) fn strain(&self, positions: &[Vec3]) -> f32 {
        positions[self.a as usize].distance_to(positions[self.b as usize]) / self.rest_length - 1.0
    }

    /// A stick between two of `positions` that is at rest there.
    pub(crate) fn at_rest(a: u32, b: u32, positions: &[Vec3]) -> Self {
        Self { a, b, rest_length: positions[a as usize].distance_to(positions[b as usize]) }
    }
}

/// How much of `b − a` each end moves, per unit of its inverse mass: a moves by `+s·w_a·(b − a)`, b by
/// `−s·w_b·(b − a)`. `inverse_mass` is w_a + w_b and above 0.
///
/// Exact: C = |x_b − x_a| − d, s = C/(|x_b − x_a|(w_a + w_b)). First order: √q ≈ (q + d²)/2d for q = |x_b − x_a|²
/// near d², so that s = (q − d²)/((q + d²)(w_a + w_b)) (Jakobsen's, doubled for both ends).
#[inline]
pub(crate) fn scale(length_squared: f32, rest_length: f32, inverse_mass: f32, root: SquareRoot) -> f32 {
    match root {
        SquareRoot::Exact => {
            let length = length_squared.sqrt();
            (length - rest_length) / (length * inverse_mass)
        }
        SquareRoot::FirstOrder => {
            let rest_squared = rest_length * rest_length;
            (length_squared - rest_squared) / ((length_squared + rest_squared) * inverse_mass)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_exact_relaxation_restores_the_length_and_keeps_the_centre_of_mass() {
        let (a, b, d) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(2.0, 0.0, 5.0), 1.7);
        let (wa, wb) = (0.5, 2.0);
        let s = scale(a.distance_squared(b), d, wa + wb, SquareRoot::Exact);
        let (da, db) = ((b - a) * (s * wa), (b - a) * (-s * wb));
        assert!(((a + da).distance(b + db) - d).abs() < 1e-6);
        assert!((da / wa + db / wb).length() < 1e-6, "momentum");
    }

    #[test]
    fn first_order_agrees_to_second_order_in_the_strain() {
        for strain in [0.1f32, 0.01, -0.01, -0.1] {
            let length = 1.0 + strain;
            let exact = scale(length * length, 1.0, 1.0, SquareRoot::Exact);
            let approximate = scale(length * length, 1.0, 1.0, SquareRoot::FirstOrder);
            assert!((exact - approximate).abs() <= strain * strain, "{strain}: {exact} {approximate}");
        }
    }
}
