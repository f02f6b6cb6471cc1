//! Feature separation (paper, 6.1): touching features are moved onto a projection point between them.

use glam::Vec3;

use crate::body::Body;
use crate::collision::{Contact, Patch};
use crate::norm::Norm;
use crate::particles::Particles;

/// The particle of a body that separation moved furthest: its ordered list is the one to relax by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moved {
    /// Index into the world's particles.
    pub(crate) particle: usize,
    distance_squared: f32,
}

/// Separates all contacts, one after another. `moved` has a place for every body. Returns how many contacts
/// were found still deep enough to be moved.
///
/// p_A and p_B are moved onto q = p_A + m_B/(m_A + m_B) (p_B − p_A), the mended Eq 10, each by moving the
/// particles of its feature by wᵢλᵢ/Σwⱼλⱼ² times that (Eq 8 and 9 for any feature and any masses). m_A is the mass
/// that the feature presents at p_A, 1/Σwⱼλⱼ², not the body's: a vertex against a face of equal bodies would
/// otherwise move the face's three particles as far as the vertex, and create momentum. The same split serves for
/// a deformable body on a rigid one, where the paper moves the leaf the whole way and the feature half of it.
///
/// Verlet reads a projection as velocity. What has overlapped for longer than this substep, by a bad start or a body
/// put into another, is therefore left moving apart by no more than `limit` (m) a substep.
pub(crate) fn separate(
    contacts: &[Contact],
    bodies: &[Body],
    particles: &mut Particles,
    moved: &mut [Option<Moved>],
    limit: f32,
) -> usize {
    let mut count = 0;
    for contact in contacts {
        let depth = contact.depth(&particles.position);
        if depth <= 0.0 {
            continue;
        }
        let motion = relative_motion(contact, particles);
        // The motion counts with its sign: what is already moving apart at the limit is given no more speed.
        let depth = depth.min(contact.normal.dot(motion) + limit);
        if depth <= 0.0 {
            continue;
        }
        let mobility = |body: u32, patch: &Patch| match bodies[body as usize].is_awake() {
            true => patch.mobility(particles),
            false => 0.0,
        };
        let mobility_a = mobility(contact.body_a, &contact.a);
        let mobility_b = contact.b.map_or(0.0, |b| mobility(contact.body_b, &b));
        let total = mobility_a + mobility_b;
        if total <= 0.0 {
            continue;
        }
        count += 1;
        // Per unit of λᵢwᵢ: B's particles move along this, A's against it.
        let shift = (contact.normal * depth + friction(contact, depth, motion)) / total;
        if mobility_a > 0.0 {
            apply(&contact.a, -shift, particles, &mut moved[contact.body_a as usize]);
        }
        if let Some(b) = contact.b.filter(|_| mobility_b > 0.0) {
            apply(&b, shift, particles, &mut moved[contact.body_b as usize]);
        }
    }
    count
}

/// How far p_A has moved relative to p_B in this substep, in m.
fn relative_motion(contact: &Contact, particles: &Particles) -> Vec3 {
    let motion_b = contact.b.map_or(Vec3::ZERO, |b| b.point(&particles.displacement));
    contact.a.point(&particles.displacement) - motion_b
}

/// Coulomb's friction in position form: what A slides along B over the step is taken back, at most μ times the
/// normal correction (all of it: the contact sticks). The paper uses friction and omits the detail.
fn friction(contact: &Contact, depth: f32, motion: Vec3) -> Vec3 {
    let slide = motion - contact.normal * contact.normal.dot(motion);
    let (length, limit) = (slide.norm(), contact.friction * depth);
    if length > limit { slide * (limit / length) } else { slide }
}

fn apply(patch: &Patch, shift: Vec3, particles: &mut Particles, moved: &mut Option<Moved>) {
    for (particle, weight) in patch.terms() {
        let step = shift * (weight * particles.inverse_mass[particle]);
        particles.shift(particle, step);
        let distance_squared = step.length_squared();
        if moved.is_none_or(|most| distance_squared > most.distance_squared) {
            *moved = Some(Moved { particle, distance_squared });
        }
    }
}
