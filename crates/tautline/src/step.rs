//! The step, phase by phase, in physical order.

use glam::Vec3;

use crate::body::{Body, Substance};
use crate::collision::{Aabb, Candidate, Scene, find_pairs};
use crate::error::{Error, within};
use crate::parallel;
use crate::particles::{VerletStep, is_within_reach};
use crate::report::{Clock, Fault, Phase, StepReport, Stopwatch};
use crate::rest::{put_to_sleep, wake_touched};
use crate::settings::ClothSolver;
use crate::solver::paper::{relax_bodies, separate};
use crate::solver::soft::sleepers_near_movers;
use crate::world::{Scratch, World};

/// The speed that wakes a body, as a multiple of the speed below which it falls asleep.
const WAKING_SPEED: f32 = 2.0;

impl World {
    /// Advances the world by `dt` seconds, in `settings.substeps` equal substeps.
    ///
    /// The same scene, settings and sequence of `dt` give the same bits on every platform, instruction set and
    /// number of threads. It never panics; a body with a particle that becomes non-finite, or gets farther than
    /// 1e12 m, is frozen and reported.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `dt` is from 1e-7 to 1 s; the world is as before.
    pub fn step(&mut self, dt: f32) -> Result<StepReport, Error> {
        self.step_with_clock(dt, &mut || 0.0)
    }

    /// As [`World::step`], with the time of each phase in the report: `clock` returns the time, in s. The engine has
    /// no clock of its own.
    ///
    /// # Errors
    /// As [`World::step`].
    pub fn step_with_clock(&mut self, dt: f32, clock: &mut Clock<'_>) -> Result<StepReport, Error> {
        within("dt", dt, 1e-7, 1.0, "a time from 1e-7 to 1 (s)")?;
        Ok(parallel::as_team(self.rigid.is_wide(), || self.advance(dt, clock)))
    }

    fn advance(&mut self, dt: f32, clock: &mut Clock<'_>) -> StepReport {
        self.index.take();
        let mut report = StepReport::default();
        let mut watch = Stopwatch::start(clock);
        let h = dt / self.settings.substeps as f32;
        self.wake_around_soft();
        self.wake_attached();
        self.begin_rigid(h, &mut report, &mut watch);
        let cloth = self.settings.cloth;
        let has_matter = self.bodies.iter().any(|body| body.is_relaxed(cloth));
        self.scratch.contacts.clear();
        let lent = self.lend_weight();
        self.begin_soft(h);
        for index in 0..self.settings.substeps {
            let is_renewed = index > 0 && self.rigid.is_hasty();
            if is_renewed {
                self.write_rigid(h, index > 1, &mut report);
                self.find_rigid_contacts(h, &mut watch);
            }
            self.pull_grabs(h, (index + 1) as f32 / self.settings.substeps as f32);
            self.rigid.substep(&self.settings, h, index == 0 || is_renewed);
            watch.lap(Phase::Solve);
            self.soft.substep(&self.bodies, &mut self.rigid, &self.settings, h);
            watch.lap(Phase::Soft);
            if has_matter {
                self.substep(h, &mut report, &mut watch);
            }
        }
        self.rest_grabs(&lent);
        self.finish_rigid(h, &mut report);
        self.finish_soft(h, &mut report);
        self.wear_cloth(dt);
        self.note_attachments(h);
        watch.lap(Phase::Integrate);
        self.rest(dt);
        self.particles.clear_forces();
        self.time += f64::from(dt);
        report.seconds = watch.finish();
        report.awake_bodies = self.bodies.iter().filter(|body| body.is_awake()).count();
        report
    }

    /// Reads cloth and rope, if they move in small steps.
    fn begin_soft(&mut self, h: f32) {
        if self.settings.cloth == ClothSolver::SmallSteps {
            let Self { soft, bodies, particles, attachments, settings, .. } = self;
            soft.begin((bodies, particles, attachments), settings, h);
        } else {
            self.soft.clear();
        }
    }

    /// Wakes cloth and rope near moving bodies, and rigid bodies near moving cloth and rope.
    fn wake_around_soft(&mut self) {
        if self.settings.cloth == ClothSolver::SmallSteps {
            for body in sleepers_near_movers(&self.bodies, &self.particles, self.settings.sleep) {
                self.wake_body(body);
            }
        }
    }

    /// Finds where rigid bodies touch: for all substeps, or for the first one only if some bodies are very fast.
    fn begin_rigid(&mut self, h: f32, report: &mut StepReport, watch: &mut Stopwatch<'_, '_>) {
        self.joints.events.clear();
        self.rigid.begin_step();
        report.contacts += self.find_rigid_contacts(h, watch);
        report.pairs += self.rigid.pair_count();
        if self.rigid.note_haste() {
            self.find_rigid_contacts(h, watch);
        }
    }

    /// Finds where rigid bodies touch. Returns the number of contact points.
    fn find_rigid_contacts(&mut self, h: f32, watch: &mut Stopwatch<'_, '_>) -> usize {
        let Self { rigid, bodies, particles, joints, settings, .. } = self;
        rigid.begin((bodies, particles, joints), settings, h);
        watch.lap(Phase::FindPairs);
        let mut contacts = rigid.find_contacts(bodies, settings, h);
        if rigid.wake_touched((bodies, joints), settings, h) {
            rigid.begin((bodies, particles, joints), settings, h);
            contacts = rigid.find_contacts(bodies, settings, h);
        }
        watch.lap(Phase::FindContacts);
        rigid.prepare(bodies, settings, h);
        rigid.take_off(bodies, particles, h);
        watch.lap(Phase::Solve);
        contacts
    }

    fn finish_rigid(&mut self, h: f32, report: &mut StepReport) {
        let has_parts = self.rigid.is_hasty() && self.settings.substeps > 1;
        self.write_rigid(h, has_parts, report);
        self.break_joints();
        self.contacts.finish(&self.rigid.presses(), &self.bodies, &self.slots);
    }

    /// Writes the state of rigid bodies back to their particles. A body that has left all reach is frozen where it was.
    /// What joints did is added to what they did in earlier parts of the step, if there were any.
    fn write_rigid(&mut self, h: f32, has_parts: bool, report: &mut StepReport) {
        let Self { rigid, bodies, particles, settings, slots, .. } = self;
        for lost in rigid.finish(bodies, particles, settings, h) {
            let body = &mut bodies[lost.body];
            particles.displacement[body.particles.clone()].fill(Vec3::ZERO);
            particles.inverse_mass[body.particles.clone()].fill(0.0);
            body.freeze();
            rigid.forget_contacts(lost.body);
            report.faults.push(Fault { body: slots.handle(lost.body), particle: lost.particle });
        }
        let states = self.rigid.finish_joints(&self.settings, h);
        self.joints.keep(states, has_parts);
    }

    /// Writes the state of cloth and rope back to their particles. A body that has left all reach is frozen where it was.
    fn finish_soft(&mut self, h: f32, report: &mut StepReport) {
        let Self { soft, bodies, particles, slots, .. } = self;
        for (index, particle) in soft.finish(bodies, particles, h) {
            let body = &mut bodies[index];
            particles.displacement[body.particles.clone()].fill(Vec3::ZERO);
            particles.inverse_mass[body.particles.clone()].fill(0.0);
            body.freeze();
            report.faults.push(Fault { body: slots.handle(index), particle });
        }
    }

    /// Lets cloth creep and tear.
    fn wear_cloth(&mut self, dt: f32) {
        let Self { soft, bodies, particles, .. } = self;
        for body in bodies.iter_mut().filter(|body| body.is_awake()) {
            let positions = &particles.position[body.particles.clone()];
            if let Substance::Deformable(deformable) = &mut body.substance
                && deformable.wear(positions, dt)
            {
                soft.invalidate();
            }
        }
    }

    fn substep(&mut self, h: f32, report: &mut StepReport, watch: &mut Stopwatch<'_, '_>) {
        self.integrate(h, report);
        watch.lap(Phase::Integrate);
        self.refit_trees();
        self.find_pairs();
        watch.lap(Phase::FindPairs);
        self.find_contacts();
        watch.lap(Phase::FindContacts);
        self.wake_touched(h);
        report.contacts += self.separate(h);
        for _ in 1..self.settings.features_per_pair {
            report.contacts += self.separate_again(h);
        }
        watch.lap(Phase::Separate);
        let counts =
            relax_bodies(&mut self.bodies, &mut self.particles, &self.scratch.moved, &self.settings, h);
        watch.lap(Phase::Relax);
        report.pairs += self.pairs.pairs.len();
        report.visits += counts.visits;
        report.relaxations += counts.relaxations;
        self.contain_faults(report);
    }

    /// Verlet's step for every particle that can move (paper, 3.1).
    fn integrate(&mut self, h: f32, report: &mut StepReport) {
        let damping = 1.0 / (1.0 + self.settings.damping * h);
        let store = &mut self.particles;
        self.scratch.start.clone_from(&store.position);
        let cloth = self.settings.cloth;
        for body in self.bodies.iter_mut().filter(|body| body.is_relaxed(cloth)) {
            let ratio = h / body.displacement_time();
            let step = VerletStep { keep: ratio * damping, kick: h * (h + body.previous_step) / 2.0 };
            body.previous_step = h;
            for i in body.particles.clone() {
                let w = store.inverse_mass[i];
                if w > 0.0 {
                    let acceleration = self.settings.gravity + store.force(i) * w;
                    step.advance(&mut store.position[i], &mut store.displacement[i], acceleration);
                }
            }
        }
        // Before anything else can touch it.
        self.contain_faults(report);
    }

    fn refit_trees(&mut self) {
        let cloth = self.settings.cloth;
        for body in self.bodies.iter_mut().filter(|body| body.is_relaxed(cloth)) {
            body.refit_tree(&self.particles.position);
        }
    }

    fn find_pairs(&mut self) {
        let scratch = &mut self.scratch;
        scratch.candidates.clear();
        for (index, body) in self.bodies.iter().enumerate() {
            let is_elsewhere = body.is_soft() && self.settings.cloth == ClothSolver::SmallSteps;
            if is_elsewhere || matches!(body.substance, Substance::HalfSpace(_) | Substance::Rigid(_)) {
                continue;
            }
            let bounds = Aabb::around(&self.particles.position[body.particles.clone()], body.reach());
            scratch.candidates.push(Candidate { body: index as u32, bounds, awake: body.is_awake() });
        }
        find_pairs(&mut scratch.candidates, self.settings.broad_phase, &mut scratch.found);
        self.pairs.update(&scratch.found);
    }

    fn find_contacts(&mut self) {
        let scene = Scene { bodies: &self.bodies, particles: &self.particles, cloth: self.settings.cloth };
        self.scratch.narrow_phase.find_contacts(scene, &mut self.pairs.pairs, &mut self.scratch.contacts);
    }

    /// A body wakes at a higher speed than it falls asleep at, or it would alternate between the two.
    fn wake_touched(&mut self, h: f32) {
        if let Some(sleep) = self.settings.sleep {
            let gravity_step = self.settings.gravity * (h * h);
            let reach = WAKING_SPEED * sleep.speed * h;
            let contacts = &self.scratch.contacts;
            wake_touched(&mut self.bodies, &self.particles, contacts, gravity_step, reach);
        }
    }

    /// How far a substep may push an old overlap apart, in m.
    fn separation_limit(&self, h: f32) -> f32 {
        self.settings.separation_speed.map_or(f32::INFINITY, |speed| speed * h)
    }

    fn separate(&mut self, h: f32) -> usize {
        let limit = self.separation_limit(h);
        self.scratch.moved.clear();
        self.scratch.moved.resize(self.bodies.len(), None);
        separate(&self.scratch.contacts, &self.bodies, &mut self.particles, &mut self.scratch.moved, limit)
    }

    /// Separates touching trusses again, at the features that are now deepest.
    fn separate_again(&mut self, h: f32) -> usize {
        let limit = self.separation_limit(h);
        let Scratch { narrow_phase, more_contacts, moved, .. } = &mut self.scratch;
        let scene = Scene { bodies: &self.bodies, particles: &self.particles, cloth: self.settings.cloth };
        narrow_phase.find_rigid_contacts(scene, &mut self.pairs.pairs, more_contacts);
        separate(more_contacts, &self.bodies, &mut self.particles, moved, limit)
    }

    /// Freezes bodies that have left all reach where they were when the substep began.
    fn contain_faults(&mut self, report: &mut StepReport) {
        let store = &mut self.particles;
        for (index, body) in self.bodies.iter_mut().enumerate().filter(|(_, body)| body.is_awake_matter()) {
            let range = body.particles.clone();
            let sound = |i: usize| is_within_reach(store.position[i], store.displacement[i]);
            if let Some(particle) = range.clone().position(|i| !sound(i)) {
                store.position[range.clone()].copy_from_slice(&self.scratch.start[range.clone()]);
                store.displacement[range.clone()].fill(Vec3::ZERO);
                store.inverse_mass[range].fill(0.0);
                body.fixed = true;
                report.faults.push(Fault { body: self.slots.handle(index), particle: particle as u32 });
            }
        }
    }

    fn rest(&mut self, dt: f32) {
        let cloth = self.settings.cloth;
        self.soft.note_rest(&mut self.bodies, &self.particles, dt);
        self.attachments.share_rest(&mut self.bodies, &self.particles);
        match self.settings.sleep {
            Some(sleep) => {
                let Self { bodies, particles, joints, rigid, soft, scratch, .. } = self;
                put_to_sleep(bodies, particles, &scratch.contacts, (sleep, cloth), dt);
                soft.put_to_sleep(bodies, particles, sleep, dt);
                rigid.put_to_sleep((bodies, particles, joints), sleep, dt);
            }
            None => self.bodies.iter_mut().for_each(Body::wake),
        }
    }
}
