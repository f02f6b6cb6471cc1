//! What is attached to each other falls asleep together, and wakes together.

use glam::Vec3;

use super::Attachments;
use crate::body::{Body, Motion};
use crate::particles::Particles;
use crate::world::World;

impl World {
    /// Wakes the sleepers that are attached to what is awake, and so on, at the start of a step.
    pub(crate) fn wake_attached(&mut self) {
        while let Some(sleeper) = self.attachments.sleeper(&self.bodies, &self.particles) {
            self.wake_body(sleeper);
        }
    }
}

impl Attachments {
    /// A body that sleeps attached to one that does not.
    fn sleeper(&self, bodies: &[Body], particles: &Particles) -> Option<usize> {
        let mut pairs = self.pairs();
        pairs.find_map(|[a, b]| {
            let of_two = |sleeper: usize, other: usize| {
                bodies[sleeper].rest.asleep && is_stirring(&bodies[other], particles)
            };
            of_two(a, b).then_some(a).or_else(|| of_two(b, a).then_some(b))
        })
    }

    /// Lets the bodies that are attached to each other have been still for the same time, before a step ends: then they
    /// fall asleep in the same one.
    pub(crate) fn share_rest(&self, bodies: &mut [Body], particles: &Particles) {
        loop {
            let mut is_done = true;
            for pair in self.pairs() {
                let [a, b] = pair.map(|body| stillness(&bodies[body], particles));
                let least = a.min(b);
                for body in pair {
                    let rest = &mut bodies[body].rest;
                    is_done &= rest.still_for <= least;
                    rest.still_for = rest.still_for.min(least);
                }
            }
            if is_done {
                break;
            }
        }
    }

    /// The bodies that attachments hold two and two.
    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        self.holding().filter_map(|(_, attached)| {
            let [a, b] = attached.ends.map(|end| end.body().map(|body| body as usize));
            Some([a?, b?])
        })
    }
}

/// Whether a body moves, or may: a kinematic one only while it does.
fn is_stirring(body: &Body, particles: &Particles) -> bool {
    match body.rigid().map(|rigid| rigid.traits.motion) {
        Some(Motion::Fixed) => false,
        Some(Motion::Kinematic) => {
            particles.displacement[body.particles.clone()].iter().any(|motion| *motion != Vec3::ZERO)
        }
        Some(Motion::Dynamic) | None => body.is_awake(),
    }
}

/// For how long a body has been still, as far as others are concerned, in s.
fn stillness(body: &Body, particles: &Particles) -> f32 {
    let can_sleep =
        body.rigid().is_none_or(|rigid| rigid.traits.can_sleep || rigid.traits.motion != Motion::Dynamic);
    match (is_stirring(body, particles), body.rigid().map(|rigid| rigid.traits.motion)) {
        (true, Some(Motion::Kinematic)) => 0.0,
        (true, _) if !can_sleep => 0.0,
        (true, _) => body.rest.still_for,
        (false, _) => f32::MAX,
    }
}
