//! Islands: rigid bodies that lean on each other or hang together fall asleep together, and wake together.
//!
//! What is fixed does not connect: two stacks on one floor are two islands. A kinematic body does not either, but
//! while it moves it keeps awake what it touches.

use glam::Vec3;

use super::crew::Timing;
use super::detect::Scene;
use super::joint::Sets;
use super::lineup::NOBODY;
use super::pairs::{Detail, Pair};
use super::{RigidSolver, scene};
use crate::body::{Body, Motion};
use crate::joint::Joints;
use crate::particles::Particles;
use crate::rest::note_drift;
use crate::settings::{Settings, Sleep};

/// How many times faster than what puts a body to sleep is what wakes it through a contact that bears already: a
/// body that has come to rest on a sleeper trembles.
const WAKING_SPEED: f32 = 2.0;

impl RigidSolver {
    /// Puts islands to sleep of which every body has drifted slower than `sleep.speed` for `sleep.seconds`, after a
    /// step of `dt` (s).
    pub(crate) fn put_to_sleep(
        &mut self,
        (bodies, particles, joints): (&mut [Body], &mut Particles, &Joints),
        sleep: Sleep,
        dt: f32,
    ) {
        for body in bodies.iter_mut().filter(|body| is_free(body)) {
            note_drift(body, &particles.position, sleep, dt);
        }
        let is_tired = |body: &Body| {
            let can_sleep = body.rigid().is_some_and(|rigid| rigid.traits.can_sleep);
            is_free(body) && can_sleep && body.rest.still_for >= sleep.seconds
        };
        let mut may_sleep: Vec<bool> = bodies.iter().map(is_tired).collect();
        if !may_sleep.contains(&true) {
            return;
        }
        let mut islands = Sets::new(bodies.len());
        for [a, b] in self.loaded_pairs().chain(joined(joints)) {
            let [first, second] = [a, b].map(|body| &bodies[body as usize]);
            match (is_free(first), is_free(second)) {
                (true, true) => islands.join(a, b),
                (true, false) => may_sleep[a as usize] &= !is_driving(second, particles),
                (false, true) => may_sleep[b as usize] &= !is_driving(first, particles),
                (false, false) => {}
            }
        }
        let restless: Vec<usize> =
            (0..bodies.len()).filter(|&body| is_free(&bodies[body]) && !may_sleep[body]).collect();
        for body in restless {
            may_sleep[islands.root(body as u32) as usize] = false;
        }
        for (index, body) in bodies.iter_mut().enumerate().filter(|(_, body)| is_free(body)) {
            if may_sleep[islands.root(index as u32) as usize] {
                body.rest.asleep = true;
                particles.displacement[body.particles.clone()].fill(Vec3::ZERO);
                self.is_stale = true;
            }
        }
    }

    /// Wakes the islands that something moves against in this step of substeps of `h` (s), once contacts have been
    /// found. Tells whether there are any: then the step is to begin anew, or they would be struck as if fixed.
    pub(crate) fn wake_touched(
        &mut self,
        (bodies, joints): (&mut [Body], &Joints),
        settings: &Settings,
        h: f32,
    ) -> bool {
        let Some(sleep) = settings.sleep else { return false };
        if !bodies.iter().any(|body| body.rest.asleep && body.is_rigid()) {
            return false;
        }
        let woken = self.touched(bodies, joints, sleep, &self.timing(settings, h));
        self.wake_islands(bodies, joints, &woken);
        !woken.is_empty()
    }

    /// The sleepers that something moves against or pulls at.
    fn touched(&self, bodies: &[Body], joints: &Joints, sleep: Sleep, timing: &Timing) -> Vec<u32> {
        let slow = sleep.speed * timing.h * timing.substeps;
        let scene = scene((&self.lineup, &self.crew, &self.versions, &self.assembly_of), bodies, timing);
        let mut woken = Vec::new();
        for (pair, detail) in
            self.pairs.pairs.iter().zip(&self.pairs.details).filter(|(pair, _)| pair.points > 0)
        {
            let Some([sleeper, mover]) = self.sleeper_and_mover(bodies, [pair.a, pair.b]) else { continue };
            let limit = match (self.is_driven(mover), is_loaded(pair, detail)) {
                (true, _) => 0.0,
                (false, true) => WAKING_SPEED * slow,
                (false, false) => slow,
            };
            let motion = scene.motion(mover);
            if motion > limit && gap(scene, pair, detail) <= motion {
                woken.push(sleeper);
            }
        }
        for ends in joined(joints) {
            let Some([sleeper, mover]) = self.sleeper_and_mover(bodies, ends) else { continue };
            if !self.is_driven(mover) || scene.motion(mover) > 0.0 {
                woken.push(sleeper);
            }
        }
        woken
    }

    /// Wakes the sleepers that touch or hang from these bodies, those that touch these, and so on.
    pub(crate) fn wake_islands(&mut self, bodies: &mut [Body], joints: &Joints, woken: &[u32]) {
        if woken.is_empty() {
            return;
        }
        let mut connects: Vec<bool> = bodies.iter().map(|body| body.rest.asleep).collect();
        woken.iter().for_each(|&body| connects[body as usize] = true);
        let mut islands = Sets::new(bodies.len());
        let touching = self.pairs.pairs.iter().filter(|pair| pair.points > 0).map(|pair| [pair.a, pair.b]);
        for [a, b] in touching.chain(joined(joints)) {
            if connects[a as usize] && connects[b as usize] {
                islands.join(a, b);
            }
        }
        let mut is_woken = vec![false; bodies.len()];
        woken.iter().for_each(|&body| is_woken[islands.root(body) as usize] = true);
        for (index, body) in bodies.iter_mut().enumerate().filter(|(_, body)| body.rest.asleep) {
            if is_woken[islands.root(index as u32) as usize] {
                body.wake();
            }
        }
        self.is_stale = true;
    }

    /// The pairs of bodies of which one bears on the other.
    fn loaded_pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let pairs = self.pairs.pairs.iter().zip(&self.pairs.details);
        pairs.filter(|(pair, detail)| is_loaded(pair, detail)).map(|(pair, _)| [pair.a, pair.b])
    }

    fn place(&self, body: u32) -> u32 {
        self.lineup.place_of.get(body as usize).copied().unwrap_or(NOBODY)
    }

    fn is_driven(&self, body: u32) -> bool {
        self.lineup.is_driven(self.place(body))
    }

    /// Of two bodies the one that sleeps and the one that may move, if that is what they do.
    fn sleeper_and_mover(&self, bodies: &[Body], [a, b]: [u32; 2]) -> Option<[u32; 2]> {
        let may_move = |body: u32| (self.place(body) as usize) < self.lineup.solved || self.is_driven(body);
        let ends = match (may_move(a), may_move(b)) {
            (false, true) => [a, b],
            (true, false) => [b, a],
            _ => return None,
        };
        bodies[ends[0] as usize].rest.asleep.then_some(ends)
    }
}

/// The pairs of bodies that joints hold together.
fn joined(joints: &Joints) -> impl Iterator<Item = [u32; 2]> {
    joints.holding().filter_map(|(_, joint)| Some([joint.base?, joint.body]))
}

/// Whether it is a rigid body that moves freely.
fn is_free(body: &Body) -> bool {
    body.is_awake() && body.rigid().is_some_and(|rigid| rigid.traits.motion == Motion::Dynamic)
}

/// Whether it moves, and nothing stops it.
fn is_driving(body: &Body, particles: &Particles) -> bool {
    let is_driven = body.rigid().is_some_and(|rigid| rigid.traits.motion == Motion::Kinematic);
    is_driven && particles.displacement[body.particles.clone()].iter().any(|motion| *motion != Vec3::ZERO)
}

fn is_loaded(pair: &Pair, detail: &Detail) -> bool {
    let held = detail.held.as_ref().filter(|_| pair.points > 0);
    held.is_some_and(|held| held.points().any(|point| point.normal_impulse() > 0.0))
}

/// How far apart two rigid bodies are at their nearest points, in m.
fn gap(scene: Scene<'_>, pair: &Pair, detail: &Detail) -> f32 {
    let Some(held) = &detail.held else { return f32::INFINITY };
    let (a, b) = (scene.placed(pair.a), scene.placed(pair.b));
    let gaps = held.points().map(|point| {
        let (on_a, on_b) = (a.center + a.axes * point.on_a(), b.center + b.axes * point.on_b());
        (on_b - on_a).dot(held.normal())
    });
    gaps.fold(f32::INFINITY, f32::min)
}
