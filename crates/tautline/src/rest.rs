//! Resting bodies are put to sleep, and woken by what touches them (paper, 8: stacked objects).

use glam::Vec3;

use crate::body::{Body, Frame, Motion};
use crate::collision::{Aabb, Contact};
use crate::particles::Particles;
use crate::settings::{ClothSolver, Sleep};

/// Wakes sleeping bodies that are touched by what has moved further than `reach` (m) in this substep. What gravity
/// gave the touching body in this very substep does not count: a body at rest on a sleeping one has it all the time.
pub(crate) fn wake_touched(
    bodies: &mut [Body],
    particles: &Particles,
    contacts: &[Contact],
    gravity_step: Vec3,
    reach: f32,
) {
    for contact in contacts {
        let (a, b) = (contact.body_a as usize, contact.body_b as usize);
        let (sleeper, mover, patch) = match (bodies[a].rest.asleep, bodies[b].rest.asleep) {
            (true, false) => (a, b, contact.b),
            (false, true) => (b, a, Some(contact.a)),
            _ => continue,
        };
        let Some(patch) = patch.filter(|_| bodies[mover].is_awake()) else { continue };
        let motion = patch.point(&particles.displacement) - gravity_step;
        if motion.length_squared() > reach * reach {
            bodies[sleeper].wake();
            // A blow may take it away from what it carries before that is touched; a nudge will not.
            if motion.length_squared() > BLOW * BLOW * reach * reach {
                wake_around(bodies, &particles.position, sleeper);
            }
        }
    }
}

/// Wakes the sleepers whose boxes come near that of body `index`, those near these, and so on: what a body
/// carries would otherwise hover once it is gone. Everything is near a half-space. Returns all of them, `index` first:
/// what rigid bodies rest on each other is known better from their contacts, and left to these.
pub(crate) fn wake_around(bodies: &mut [Body], positions: &[Vec3], index: usize) -> Vec<u32> {
    let bounds = |body: &Body, margin: f32| {
        let particles = &positions[body.particles.clone()];
        match body.rigid() {
            Some(rigid) => {
                let center = Frame::of_particles(particles).center;
                Some(Aabb::around(&[center], rigid.shape.reach() + margin))
            }
            None => (!particles.is_empty()).then(|| Aabb::around(particles, body.reach() + margin)),
        }
    };
    let mut woken = vec![index as u32];
    let mut next = 0;
    while let Some(&index) = woken.get(next) {
        next += 1;
        let source = &bodies[index as usize];
        let (is_free, source) = (
            source.rigid().is_some_and(|rigid| rigid.traits.motion == Motion::Dynamic),
            bounds(source, NEAR),
        );
        for (other, body) in bodies.iter_mut().enumerate().filter(|(_, body)| body.rest.asleep) {
            let near = |bounds: Aabb| source.is_none_or(|source| source.overlaps(&bounds));
            if !(is_free && body.is_rigid()) && bounds(body, 0.0).is_some_and(near) {
                body.wake();
                woken.push(other as u32);
            }
        }
    }
    woken
}

/// How much faster than what wakes a body is what wakes all around it.
const BLOW: f32 = 10.0;

/// How near a sleeper's box is to one that it may rest on, in m.
const NEAR: f32 = 0.1;

/// Puts bodies to sleep that have drifted slower than `sleep.speed` for `sleep.seconds`, unless they touch one
/// that has not. Drift rather than speed decides: a body that trembles on the spot is at rest.
pub(crate) fn put_to_sleep(
    bodies: &mut [Body],
    particles: &mut Particles,
    contacts: &[Contact],
    (sleep, cloth): (Sleep, ClothSolver),
    dt: f32,
) {
    for body in bodies.iter_mut().filter(|body| body.is_relaxed(cloth)) {
        note_drift(body, &particles.position, sleep, dt);
    }
    let restless = |body: &Body| body.is_awake() && body.rest.still_for < sleep.seconds;
    let mut may_sleep: Vec<bool> =
        bodies.iter().map(|body| body.is_relaxed(cloth) && !restless(body)).collect();
    for contact in contacts {
        let (a, b) = (contact.body_a as usize, contact.body_b as usize);
        may_sleep[a] &= !restless(&bodies[b]);
        may_sleep[b] &= !restless(&bodies[a]);
    }
    for (body, _) in bodies.iter_mut().zip(may_sleep).filter(|(_, may_sleep)| *may_sleep) {
        body.rest.asleep = true;
        particles.displacement[body.particles.clone()].fill(Vec3::ZERO);
    }
}

/// Counts for how long a body's particles have been near where they were, after a step of `dt` (s).
pub(crate) fn note_drift(body: &mut Body, positions: &[Vec3], sleep: Sleep, dt: f32) {
    let reach = sleep.speed * sleep.seconds;
    let positions = &positions[body.particles.clone()];
    let drifted = |(x, reference): (&Vec3, &Vec3)| x.distance_squared(*reference) > reach * reach;
    let rest = &mut body.rest;
    if rest.reference.len() != positions.len() {
        rest.reference = positions.into();
        rest.still_for = 0.0;
    } else if positions.iter().zip(&rest.reference).any(drifted) {
        rest.reference.copy_from_slice(positions);
        rest.still_for = 0.0;
    } else {
        rest.still_for += dt;
    }
}
