//! Iterative relaxation (paper, 6.2): each stick is set to its length in turn, a few sweeps over.

use super::Moved;
use crate::body::{Body, Deformable, Substance};
use crate::constraint::{
    Angle, Bending, Stick, angle_gradient, bending_gradient, multiplier_step, stick_scale,
};
use crate::parallel;
use crate::particles::{Particles, ParticlesMut};
use crate::settings::{Ordering, Relaxation, Settings};

/// What relaxation did: the paper's chart 9(c) plots `relaxations`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Sticks looked at.
    pub(crate) visits: u64,
    /// Sticks found off by more than the tolerance, and relaxed.
    pub(crate) relaxations: u64,
}

impl std::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.visits += other.visits;
        self.relaxations += other.relaxations;
    }
}

/// Relaxes all bodies that are awake: each until its sticks are within tolerance, at most `settings.sweeps`
/// times. A rigid body that collided is relaxed by the list of the particle that separation moved furthest.
pub(crate) fn relax_bodies(
    bodies: &mut [Body],
    particles: &mut Particles,
    moved: &[Option<Moved>],
    settings: &Settings,
    h: f32,
) -> Counts {
    let views = particles.split_mut(bodies.iter().map(|body| body.particles.clone()));
    let mut tasks: Vec<Task<'_>> = bodies
        .iter_mut()
        .zip(views)
        .zip(moved)
        .filter(|((body, _), _)| body.is_relaxed(settings.cloth))
        .map(|((body, particles), &moved)| Task { body, particles, moved, counts: Counts::default() })
        .collect();
    let particle_count: usize = tasks.iter().map(|task| task.particles.position.len()).sum();
    parallel::for_each(&mut tasks, particle_count > WORTHWHILE, |task| task.relax(&settings.relaxation, h));
    tasks.iter().fold(Counts::default(), |mut sum, task| {
        sum += task.counts;
        sum
    })
}

/// From so many particles on it pays to relax bodies side by side.
const WORTHWHILE: usize = 2000;

/// A body to be relaxed.
struct Task<'a> {
    body: &'a mut Body,
    particles: ParticlesMut<'a>,
    moved: Option<Moved>,
    counts: Counts,
}

impl Task<'_> {
    fn relax(&mut self, settings: &Relaxation, h: f32) {
        let first = self.body.particles.start;
        self.counts = match &mut self.body.substance {
            Substance::Truss { truss } => {
                let moved = self.moved.filter(|_| settings.ordering == Ordering::ByDistance);
                let list = moved.map(|moved| truss.ordered_list(moved.particle - first));
                let order = list.as_deref().map_or(Order::AsBuilt, Order::Listed);
                relax_sticks(&mut self.particles, truss.sticks(), order, settings)
            }
            Substance::Deformable(deformable) => {
                relax_deformable(&mut self.particles, deformable, settings, h)
            }
            Substance::Rigid(_) | Substance::HalfSpace(_) => Counts::default(),
        };
    }
}

/// In which order a body's sticks are swept.
#[derive(Debug, Clone, Copy)]
enum Order<'a> {
    /// By a list of indices.
    Listed(&'a [u32]),
    /// From the first to the last.
    AsBuilt,
    /// From the first to the last and, every other time, back: always the same way, errors are pushed that way,
    /// and a cloth creeps off a cube.
    BackAndForth,
}

/// Sweep number `sweep` over a body's sticks.
fn sweep_in_order(
    particles: &mut ParticlesMut<'_>,
    sticks: &[Stick],
    order: Order<'_>,
    sweep: u32,
    settings: &Relaxation,
) -> Counts {
    let all = 0..sticks.len();
    match order {
        Order::Listed(list) => {
            sweep_sticks(particles, sticks, list.iter().map(|&index| index as usize), settings)
        }
        Order::BackAndForth if sweep % 2 == 1 => sweep_sticks(particles, sticks, all.rev(), settings),
        Order::AsBuilt | Order::BackAndForth => sweep_sticks(particles, sticks, all, settings),
    }
}

fn relax_sticks(
    particles: &mut ParticlesMut<'_>,
    sticks: &[Stick],
    order: Order<'_>,
    settings: &Relaxation,
) -> Counts {
    let mut total = Counts::default();
    for sweep in 0..settings.sweeps {
        let counts = sweep_in_order(particles, sticks, order, sweep, settings);
        total += counts;
        if counts.relaxations == 0 {
            break;
        }
    }
    total
}

fn relax_deformable(
    particles: &mut ParticlesMut<'_>,
    deformable: &mut Deformable,
    settings: &Relaxation,
    h: f32,
) -> Counts {
    let Deformable { sticks, angles, bendings, multipliers, .. } = deformable;
    if angles.is_empty() && bendings.is_empty() {
        return relax_sticks(particles, sticks, Order::BackAndForth, settings);
    }
    let inverse_h_squared = 1.0 / (h * h);
    multipliers.clear();
    multipliers.resize(angles.len() + bendings.len(), 0.0);
    let (at_particles, at_edges) = multipliers.split_at_mut(angles.len());
    let mut total = Counts::default();
    for sweep in 0..settings.sweeps {
        sweep_angles(particles, angles, at_particles, inverse_h_squared);
        sweep_bendings(particles, bendings, at_edges, inverse_h_squared);
        total += sweep_in_order(particles, sticks, Order::BackAndForth, sweep, settings);
    }
    total
}

/// One sweep over `sticks` in the given order. Sticks between two immovable particles and sticks whose ends
/// coincide (they have no direction) are left alone.
fn sweep_sticks(
    particles: &mut ParticlesMut<'_>,
    sticks: &[Stick],
    order: impl Iterator<Item = usize>,
    settings: &Relaxation,
) -> Counts {
    let (shortest, longest) = (1.0 - settings.tolerance, 1.0 + settings.tolerance);
    let (low, high) = (shortest * shortest, longest * longest);
    let mut counts = Counts::default();
    for index in order {
        let stick = &sticks[index];
        let (a, b) = (stick.a as usize, stick.b as usize);
        let along = particles.position[b] - particles.position[a];
        let length_squared = along.length_squared();
        let rest_squared = stick.rest_length * stick.rest_length;
        counts.visits += 1;
        if length_squared >= low * rest_squared && length_squared <= high * rest_squared {
            continue;
        }
        let (wa, wb) = (particles.inverse_mass[a], particles.inverse_mass[b]);
        if wa + wb == 0.0 || length_squared < f32::MIN_POSITIVE {
            continue;
        }
        counts.relaxations += 1;
        let shift = along * stick_scale(length_squared, stick.rest_length, wa + wb, settings.square_root);
        particles.shift(a, shift * wa);
        particles.shift(b, shift * -wb);
    }
    counts
}

/// One sweep over angles at particles. `multipliers` holds one λ per angle, 0 at the start of a substep.
fn sweep_angles(
    particles: &mut ParticlesMut<'_>,
    angles: &[Angle],
    multipliers: &mut [f32],
    inverse_h_squared: f32,
) {
    for (angle, multiplier) in angles.iter().zip(multipliers) {
        let corners = [angle.a as usize, angle.b as usize, angle.c as usize];
        let [a, b, c] = corners.map(|i| particles.position[i]);
        if let Some((theta, gradients)) = angle_gradient(a, b, c) {
            let violation = angle.limit.violation(theta);
            particles.project(
                corners,
                gradients,
                violation,
                angle.compliance * inverse_h_squared,
                multiplier,
            );
        }
    }
}

/// One sweep over dihedral angles at edges. `multipliers` as in [`sweep_angles`].
fn sweep_bendings(
    particles: &mut ParticlesMut<'_>,
    bendings: &[Bending],
    multipliers: &mut [f32],
    inverse_h_squared: f32,
) {
    for (bending, multiplier) in bendings.iter().zip(multipliers) {
        let corners =
            [bending.wings[0], bending.wings[1], bending.edge[0], bending.edge[1]].map(|i| i as usize);
        let [w0, w1, e0, e1] = corners.map(|i| particles.position[i]);
        if let Some((theta, gradients)) = bending_gradient([w0, w1], [e0, e1]) {
            let violation = bending.limit.violation(theta);
            particles.project(
                corners,
                gradients,
                violation,
                bending.compliance * inverse_h_squared,
                multiplier,
            );
        }
    }
}

impl ParticlesMut<'_> {
    #[inline]
    fn shift(&mut self, particle: usize, shift: glam::Vec3) {
        self.position[particle] += shift;
        self.displacement[particle] += shift;
    }

    /// Moves N particles along their gradients by one multiplier step: Δxᵢ = wᵢ ∇ᵢC Δλ.
    fn project<const N: usize>(
        &mut self,
        particles: [usize; N],
        gradients: [glam::Vec3; N],
        violation: f32,
        compliance: f32,
        multiplier: &mut f32,
    ) {
        let weights = particles.map(|i| self.inverse_mass[i]);
        let mobility: f32 = weights.iter().zip(&gradients).map(|(w, g)| w * g.length_squared()).sum();
        let step = multiplier_step(violation, compliance, *multiplier, mobility);
        *multiplier += step;
        for k in 0..N {
            self.shift(particles[k], gradients[k] * (weights[k] * step));
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::constraint::AngleLimit;
    use crate::particles::Particles;
    use crate::settings::Settings;

    fn store(positions: &[Vec3]) -> Particles {
        let mut particles = Particles::default();
        particles.extend(positions, 1.0, false);
        particles
    }

    fn whole(particles: &mut Particles) -> ParticlesMut<'_> {
        let all = 0..particles.len();
        particles.split_mut(std::iter::once(all)).remove(0)
    }

    #[test]
    fn a_stick_within_tolerance_is_visited_but_not_relaxed() {
        let settings = Settings::paper().relaxation;
        for (length, relaxations) in [(1.009, 0), (1.011, 1), (0.991, 0), (0.989, 1)] {
            let mut particles = store(&[Vec3::ZERO, Vec3::X * length]);
            let sticks = [Stick { a: 0, b: 1, rest_length: 1.0 }];
            let counts = sweep_sticks(&mut whole(&mut particles), &sticks, 0..1, &settings);
            assert_eq!(counts, Counts { visits: 1, relaxations }, "length {length}");
        }
    }

    #[test]
    fn coincident_and_pinned_ends_are_left_alone() {
        let settings = Settings::paper().relaxation;
        let sticks = [Stick { a: 0, b: 1, rest_length: 1.0 }];
        let mut coincident = store(&[Vec3::X, Vec3::X]);
        sweep_sticks(&mut whole(&mut coincident), &sticks, 0..1, &settings);
        assert_eq!(coincident.position, [Vec3::X, Vec3::X]);
        let mut pinned = Particles::default();
        pinned.extend(&[Vec3::ZERO, Vec3::X * 3.0], 1.0, true);
        sweep_sticks(&mut whole(&mut pinned), &sticks, 0..1, &settings);
        assert_eq!(pinned.position, [Vec3::ZERO, Vec3::X * 3.0]);
    }

    #[test]
    fn rigid_angles_and_bendings_reach_their_target() {
        let mut bent = store(&[Vec3::X, Vec3::ZERO, Vec3::Y]);
        let limit = AngleLimit::Target(2.0);
        let angles = [Angle { a: 0, b: 1, c: 2, limit, compliance: 0.0 }];
        let mut folded = store(&[Vec3::Z, Vec3::Y, Vec3::ZERO, Vec3::X]);
        let limit = AngleLimit::Target(0.0);
        let bendings = [Bending { edge: [2, 3], wings: [0, 1], limit, compliance: 0.0 }];
        for _ in 0..50 {
            sweep_angles(&mut whole(&mut bent), &angles, &mut [0.0], 1.0);
            sweep_bendings(&mut whole(&mut folded), &bendings, &mut [0.0], 1.0);
        }
        let x = &bent.position;
        let angle = angle_gradient(x[0], x[1], x[2]).unwrap().0;
        assert!((angle - 2.0).abs() < 1e-4, "angle {angle}");
        let x = &folded.position;
        let angle = bending_gradient([x[0], x[1]], [x[2], x[3]]).unwrap().0;
        assert!(angle.abs() < 1e-4, "dihedral {angle}");
    }
}
