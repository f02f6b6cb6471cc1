//! Gas in closed cloth: p V = const, in one constraint over all its particles.
//!
//! The gas pushes every particle along ∇V by p h². What counts is the pressure after the push, for which
//! V' = V + G h² c/V' with G = Σ w |∇V|² and c = p V is a quadratic equation: implicit, so stable however light
//! the cloth and however hard the gas; where it is soft, the plain force. ∇V of a particle is a third of the area vectors
//! around it, whose sum over a closed surface is 0, as is that of their moments: where the small step began, which is where
//! impulses turn what they push.

use std::ops::Range;

use glam::{DVec3, Vec3};

use super::SoftSolver;
use super::points::Points;
use crate::body::Gas;

/// How often a cloth is swept that gas blows up: it pushes all ways at once, and what one sweep leaves of that adds up.
pub(super) const SWEEPS: u32 = 4;

/// A cloth with gas in it.
#[derive(Debug, Clone)]
pub(super) struct Balloon {
    /// By place.
    triangles: Vec<[u32; 3]>,
    gas: Gas,
    places: Range<usize>,
    /// ∇V of every place, in m².
    gradients: Vec<Vec3>,
}

impl SoftSolver {
    /// Lets gas push for a small step of `h` (s).
    pub(super) fn press(&mut self, h: f32) {
        for balloon in self.pieces.iter_mut().filter_map(|piece| piece.balloon.as_mut()) {
            balloon.press(&mut self.points, h);
        }
    }
}

impl Balloon {
    pub(super) fn new(triangles: Vec<[u32; 3]>, gas: Gas, places: Range<usize>) -> Self {
        Self { triangles, gas, places, gradients: Vec::new() }
    }

    fn press(&mut self, points: &mut Points, h: f32) {
        let volume = self.gas.bounded(self.measure(points));
        let mobility: f64 = (self.places.clone().zip(&self.gradients))
            .map(|(place, gradient)| f64::from(points.inverse_mass[place] * gradient.length_squared()))
            .sum();
        if mobility <= 0.0 {
            return;
        }
        let h_squared = f64::from(h) * f64::from(h);
        let after = volume_after(volume, mobility * h_squared * self.gas.content());
        let multiplier = (after - volume) / mobility;
        for (place, gradient) in self.places.clone().zip(&self.gradients) {
            points.shift(place, *gradient * (multiplier as f32 * points.inverse_mass[place]));
        }
    }

    /// Finds the gradients. Returns the volume, in m³, as of tetrahedra with the first place.
    fn measure(&mut self, points: &Points) -> f64 {
        self.gradients.clear();
        self.gradients.resize(self.places.len(), Vec3::ZERO);
        let origin = points.at(self.places.start);
        let mut six_fold = 0.0;
        for triangle in &self.triangles {
            let places = triangle.map(|place| place as usize);
            let [a, b, c] = places.map(|place| points.begun_at(place));
            let pushed = (b - a).cross(c - a) / 6.0;
            for place in places {
                self.gradients[place - self.places.start] += pushed;
            }
            let [a, b, c] = places.map(|place| points.at(place) - origin);
            let [a, doubled]: [DVec3; 2] = [a, (b - a).cross(c - a)].map(Vec3::as_dvec3);
            six_fold += a.dot(doubled);
        }
        six_fold / 6.0
    }
}

/// V' = V + g/V', its root above 0; g = G h² c, in m⁶.
fn volume_after(volume: f64, give: f64) -> f64 {
    let half = 0.5 * volume;
    half + (half * half + give).sqrt()
}

#[cfg(test)]
#[path = "tests/gas.rs"]
mod tests;
