//! What came of a run, in figures.

use std::time::Duration;

use serde::Serialize;
use tautline::{BodyHandle, PhaseSeconds, StepReport, Vec3};

use crate::build::{BuiltScene, Look};
use crate::error::Error;

/// What came of a run. SI units unless named.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunSummary {
    /// The scene's name.
    pub scene: String,
    /// How many bodies there are, half-spaces not counted.
    pub bodies: usize,
    /// How many particles they have.
    pub particles: usize,
    /// How many steps were taken.
    pub steps: u64,
    /// The scene's time at the end.
    pub seconds: f64,
    /// Mean time that a step took.
    pub ms_per_step: f64,
    /// How that time is divided.
    pub ms_per_step_by_phase: PhaseMilliseconds,
    /// Movable bodies whose centre is behind a half-space or outside the scene's bounds at the end.
    pub escaped: usize,
    /// Bodies that turned non-finite and were frozen.
    pub nonfinite: usize,
    /// Deepest penetration at the end.
    pub max_penetration_mm: f64,
    /// Mean penetration at the end over the pairs that penetrate.
    pub mean_penetration_mm: f64,
    /// Largest |length/rest length − 1| of a stick at the end.
    pub max_stick_strain: f32,
    /// Mean |length/rest length − 1| of all sticks at the end.
    pub mean_stick_strain: f32,
    /// Σ ½ m v² at the end.
    pub kinetic_energy: f64,
    /// Mean number of pairs of bodies whose boxes overlapped, over the substeps of a step.
    pub pairs_per_step: f64,
    /// Mean number of contacts in a step.
    pub contacts_per_step: f64,
    /// Mean number of sticks looked at in a step.
    pub visits_per_step: f64,
    /// Mean number of sticks relaxed in a step.
    pub relaxations_per_step: f64,
    /// Hash of the world's state at the end, 16 hexadecimal digits.
    pub state_hash: String,
}

/// Mean time of a step by phase, in ms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PhaseMilliseconds {
    /// Moving the particles.
    pub integrate: f64,
    /// Refitting trees and finding pairs.
    pub broad_phase: f64,
    /// Finding contacts.
    pub narrow_phase: f64,
    /// Separating features.
    pub separate: f64,
    /// Relaxing constraints.
    pub relax: f64,
    /// Solving for bodies of four particles.
    pub solve: f64,
}

/// Sums over the steps of a run.
#[derive(Debug, Clone, Default)]
pub(super) struct Tally {
    pub(super) steps: u64,
    elapsed: Duration,
    phases: PhaseSeconds,
    pairs: u64,
    contacts: u64,
    visits: u64,
    relaxations: u64,
    faults: usize,
}

impl Tally {
    pub(super) fn add(&mut self, report: &StepReport, elapsed: Duration) {
        self.steps += 1;
        self.elapsed += elapsed;
        self.phases += report.seconds;
        self.pairs += report.pairs as u64;
        self.contacts += report.contacts as u64;
        self.visits += report.visits;
        self.relaxations += report.relaxations;
        self.faults += report.faults.len();
    }

    pub(super) fn summary(&self, scene: &BuiltScene) -> Result<RunSummary, Error> {
        let world = &scene.world;
        let (penetration, strain) = (world.penetration(), world.strain());
        let steps = self.steps.max(1) as f64;
        let per_step = |count: u64| count as f64 / steps;
        let ms_per_step = |seconds: f64| 1e3 * seconds / steps;
        let phases = &self.phases;
        Ok(RunSummary {
            scene: scene.name.clone(),
            bodies: scene.parts.iter().filter(|part| !matches!(part.look, Look::Wall(_))).count(),
            particles: world.positions().len(),
            steps: self.steps,
            seconds: world.time(),
            ms_per_step: ms_per_step(self.elapsed.as_secs_f64()),
            ms_per_step_by_phase: PhaseMilliseconds {
                integrate: ms_per_step(phases.integrate),
                broad_phase: ms_per_step(phases.broad_phase),
                narrow_phase: ms_per_step(phases.narrow_phase),
                separate: ms_per_step(phases.separate),
                relax: ms_per_step(phases.relax),
                solve: ms_per_step(phases.solve),
            },
            escaped: escaped(scene)?,
            nonfinite: self.faults,
            max_penetration_mm: 1e3 * f64::from(penetration.max),
            mean_penetration_mm: 1e3 * f64::from(penetration.mean),
            max_stick_strain: strain.max,
            mean_stick_strain: strain.mean,
            kinetic_energy: world.kinetic_energy(),
            pairs_per_step: per_step(self.pairs),
            contacts_per_step: per_step(self.contacts),
            visits_per_step: per_step(self.visits),
            relaxations_per_step: per_step(self.relaxations),
            state_hash: format!("{:016x}", world.state_hash()),
        })
    }
}

/// How many movable bodies have their centre behind a half-space or outside the bounds.
fn escaped(scene: &BuiltScene) -> Result<usize, Error> {
    let body = |handle: BodyHandle| scene.world.body(handle);
    let mut planes = Vec::new();
    for part in &scene.parts {
        planes.extend(body(part.body)?.plane());
    }
    let is_outside = |p: Vec3| {
        let behind = planes.iter().any(|(normal, offset)| normal.dot(p) < *offset);
        let beyond = scene
            .bounds
            .as_ref()
            .is_some_and(|bounds| p.cmplt(bounds.min.into()).any() || p.cmpgt(bounds.max.into()).any());
        behind || beyond
    };
    let mut count = 0;
    for part in &scene.parts {
        let body = body(part.body)?;
        if !body.is_fixed() && is_outside(body.center_of_mass()) {
            count += 1;
        }
    }
    Ok(count)
}
