//! The particle store: everything that moves, as arrays over all particles of the world.
//!
//! The Verlet pair is stored as position x and displacement d = x − x⁻, never as two positions: far from the
//! origin the difference of two `f32` positions cancels, a stored difference does not.

use std::ops::Range;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// How far out a particle may be, and how far it may move in a substep, in m. There `f32` tells places 65 km apart; a speed
/// or an angular momentum of what is farther could be beyond all numbers.
pub(crate) const FARTHEST: f32 = 1e12;

/// Whether a particle is still somewhere: what is not finite is nowhere.
pub(crate) fn is_within_reach(position: Vec3, displacement: Vec3) -> bool {
    [position, displacement].iter().all(|vector| vector.abs().cmplt(Vec3::splat(FARTHEST)).all())
}

/// All particles, body after body. A body owns one contiguous range; particle `i` of a body is vertex `i` of
/// its geometry.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Particles {
    /// x, in m.
    pub(crate) position: Vec<Vec3>,
    /// d = x − x⁻, in m: the motion over the last substep.
    pub(crate) displacement: Vec<Vec3>,
    /// w = 1/m, in 1/kg; 0 = pinned or fixed.
    pub(crate) inverse_mass: Vec<f32>,
    /// m, in kg, kept while a particle is pinned.
    pub(crate) mass: Vec<f32>,
    /// Sum of the external forces for the coming step, in N; empty if there are none.
    force: Vec<Vec3>,
}

/// The particles of one body, to be moved by a solver.
#[derive(Debug)]
pub(crate) struct ParticlesMut<'a> {
    pub(crate) position: &'a mut [Vec3],
    pub(crate) displacement: &'a mut [Vec3],
    pub(crate) inverse_mass: &'a [f32],
}

impl Particles {
    pub(crate) fn len(&self) -> usize {
        self.position.len()
    }

    /// Appends particles at rest, of one mass each, and returns their range.
    pub(crate) fn extend(&mut self, positions: &[Vec3], mass: f32, fixed: bool) -> Range<usize> {
        let range = self.len()..self.len() + positions.len();
        self.position.extend_from_slice(positions);
        self.displacement.resize(range.end, Vec3::ZERO);
        self.inverse_mass.resize(range.end, if fixed { 0.0 } else { 1.0 / mass });
        self.mass.resize(range.end, mass);
        if self.is_forced() {
            self.force.resize(range.end, Vec3::ZERO);
        }
        range
    }

    /// Whether any force may act on a particle in the coming step.
    pub(crate) fn is_forced(&self) -> bool {
        !self.force.is_empty()
    }

    /// The forces on the particles of a range in the coming step, in N; none if there are none at all.
    pub(crate) fn forces(&self, range: Range<usize>) -> &[Vec3] {
        self.force.get(range).unwrap_or_default()
    }

    /// The force on a particle in the coming step, in N.
    pub(crate) fn force(&self, particle: usize) -> Vec3 {
        self.force.get(particle).copied().unwrap_or(Vec3::ZERO)
    }

    /// Adds to the force (N) on a particle in the coming step.
    pub(crate) fn add_force(&mut self, particle: usize, force: Vec3) {
        let count = self.len();
        self.force.resize(count, Vec3::ZERO);
        self.force[particle] += force;
    }

    /// Gives particles from `start` on that can move their masses, in kg.
    pub(crate) fn weigh(&mut self, start: usize, masses: &[f32]) {
        for (i, &mass) in (start..).zip(masses) {
            self.mass[i] = mass;
            self.inverse_mass[i] = 1.0 / mass;
        }
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        let count = self.len();
        let lengths = [self.displacement.len(), self.inverse_mass.len(), self.mass.len()];
        let vectors = self.position.iter().chain(&self.displacement).chain(&self.force);
        let sound = lengths.iter().all(|&length| length == count)
            && (!self.is_forced() || self.force.len() == count)
            && vectors.into_iter().all(|vector| vector.is_finite())
            && self.inverse_mass.iter().all(|w| w.is_finite() && *w >= 0.0)
            && self.mass.iter().all(|m| m.is_finite() && *m > 0.0);
        if sound { Ok(()) } else { Err(Error::Snapshot("its particles are inconsistent".into())) }
    }

    /// Takes the particles of `range` out; those behind it move down.
    pub(crate) fn remove(&mut self, range: Range<usize>) {
        self.position.drain(range.clone());
        self.displacement.drain(range.clone());
        self.inverse_mass.drain(range.clone());
        self.mass.drain(range.clone());
        if self.is_forced() {
            self.force.drain(range);
        }
    }

    /// Forgets the forces of the step that ends.
    pub(crate) fn clear_forces(&mut self) {
        self.force.clear();
    }

    /// Moves a particle by `shift` (m) and so changes its displacement alike: Verlet reads a projection as
    /// velocity.
    #[inline]
    pub(crate) fn shift(&mut self, particle: usize, shift: Vec3) {
        self.position[particle] += shift;
        self.displacement[particle] += shift;
    }

    /// Views of the ranges of consecutive bodies that cover the store, to be moved side by side.
    pub(crate) fn split_mut(&mut self, ranges: impl Iterator<Item = Range<usize>>) -> Vec<ParticlesMut<'_>> {
        let (mut position, mut displacement) = (&mut self.position[..], &mut self.displacement[..]);
        let mut inverse_mass = &self.inverse_mass[..];
        let take = |range: Range<usize>| {
            let (x, rest_x) = std::mem::take(&mut position).split_at_mut(range.len());
            let (d, rest_d) = std::mem::take(&mut displacement).split_at_mut(range.len());
            let (w, rest_w) = inverse_mass.split_at(range.len());
            (position, displacement, inverse_mass) = (rest_x, rest_d, rest_w);
            ParticlesMut { position: x, displacement: d, inverse_mass: w }
        };
        ranges.map(take).collect()
    }

    /// Σ ½ m v², in J, with v = d/h.
    pub(crate) fn kinetic_energy(&self, range: Range<usize>, h: f32) -> f64 {
        let moving = range.filter(|&i| self.inverse_mass[i] > 0.0);
        moving.map(|i| 0.5 * f64::from(self.mass[i]) * self.velocity(i, h).as_dvec3().length_squared()).sum()
    }

    /// v = d/h, in m/s: the mean over the last substep, that is, the velocity half a substep ago.
    pub(crate) fn velocity(&self, particle: usize, h: f32) -> Vec3 {
        self.displacement[particle] / h
    }
}

/// One substep of one particle: Verlet's x' = x + (x − x⁻) + a h² (paper, Eq 1), corrected for a step that
/// changes. d/h is the velocity in the middle of the last substep, so that between two middles (h + h⁻)/2
/// passes: d' = d h/h⁻ + a h (h + h⁻)/2. Constant acceleration is then exact for any sequence of steps, and
/// h⁻ = 0 stands for a body newly placed, whose d is its velocity now: then d' = v h + a h²/2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VerletStep {
    /// What is left of d: h/h⁻ (or h, see above) times the damping factor.
    pub(crate) keep: f32,
    /// h (h + h⁻)/2, in s².
    pub(crate) kick: f32,
}

impl VerletStep {
    #[inline]
    pub(crate) fn advance(self, position: &mut Vec3, displacement: &mut Vec3, acceleration: Vec3) {
        *displacement = *displacement * self.keep + acceleration * self.kick;
        *position += *displacement;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: Vec3 = Vec3::new(0.0, -9.81, 0.0);

    #[test]
    fn free_fall_is_exact_for_any_sequence_of_steps() {
        let (mut x, mut t, mut previous) = (Vec3::ZERO, 0.0, 0.0);
        let mut d = Vec3::ZERO;
        for step in 0..120 {
            let h = if step % 3 == 0 { 1.0 / 30.0 } else { 1.0 / 90.0 };
            let keep = if previous > 0.0 { h / previous } else { h };
            VerletStep { keep, kick: h * (h + previous) / 2.0 }.advance(&mut x, &mut d, G);
            previous = h;
            t += f64::from(h);
        }
        assert!((f64::from(x.y) + 0.5 * 9.81 * t * t).abs() < 1e-4, "fell {} in {t} s", x.y);
    }

    #[test]
    fn a_reversed_displacement_runs_back_to_the_start() {
        let h: f32 = 1.0 / 60.0;
        let step = VerletStep { keep: 1.0, kick: h * h };
        let spring = |x: Vec3| -x * 40.0 + G;
        let (start, d0) = (Vec3::new(0.3, -0.2, 0.5), Vec3::new(0.01, 0.02, -0.01));
        let (mut x, mut d) = (start, d0);
        for _ in 0..600 {
            let a = spring(x);
            step.advance(&mut x, &mut d, a);
        }
        // Backward in time the pair is (x, x⁺): step to the last position, then turn the motion round.
        x -= d;
        d = -d;
        for _ in 0..599 {
            let a = spring(x);
            step.advance(&mut x, &mut d, a);
        }
        assert!((x - start).length() < 1e-5, "returned to {x}, started from {start}");
    }

    #[test]
    fn split_views_cover_their_ranges() {
        let mut particles = Particles::default();
        let ranges =
            [particles.extend(&[Vec3::X, Vec3::Y], 1.0, false), particles.extend(&[Vec3::Z], 2.0, true)];
        let views = particles.split_mut(ranges.into_iter());
        assert_eq!((&*views[0].position, &*views[1].position), (&[Vec3::X, Vec3::Y][..], &[Vec3::Z][..]));
        assert_eq!(views[1].inverse_mass, [0.0]);
    }

    #[test]
    fn forces_take_memory_only_in_a_step_that_has_any() {
        let mut particles = Particles::default();
        particles.extend(&[Vec3::X, Vec3::Y], 1.0, false);
        assert_eq!((particles.force(1), particles.forces(0..2)), (Vec3::ZERO, &[][..]));
        particles.add_force(1, Vec3::Y);
        particles.add_force(1, Vec3::Z);
        particles.extend(&[Vec3::Z], 1.0, false);
        particles.remove(0..1);
        assert_eq!(particles.forces(0..2), [Vec3::Y + Vec3::Z, Vec3::ZERO]);
        assert!(particles.validate().is_ok());
        particles.clear_forces();
        assert!(!particles.is_forced() && particles.validate().is_ok());
    }

    #[test]
    fn removal_moves_later_particles_down() {
        let mut particles = Particles::default();
        particles.extend(&[Vec3::X, Vec3::Y], 1.0, false);
        particles.extend(&[Vec3::Z], 2.0, true);
        particles.remove(0..2);
        assert_eq!((&particles.position[..], &particles.inverse_mass[..]), (&[Vec3::Z][..], &[0.0][..]));
        assert_eq!(particles.mass, [2.0]);
    }
}
