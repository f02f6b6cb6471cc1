//! What a step did.

use crate::world::BodyHandle;

/// What a step did: sums over its substeps.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepReport {
    /// Pairs of bodies whose boxes overlapped.
    pub pairs: usize,
    /// Contacts that were separated.
    pub contacts: usize,
    /// Sticks looked at.
    pub visits: u64,
    /// Sticks found off by more than the tolerance, and relaxed: what the paper's chart 9(c) plots.
    pub relaxations: u64,
    /// Bodies that are neither fixed nor asleep, after the step.
    pub awake_bodies: usize,
    /// Bodies that turned non-finite, or got farther than 1e12 m, and have been frozen.
    pub faults: Vec<Fault>,
    /// Time by phase, in s; zeros from [`World::step`](crate::World::step), which has no clock.
    pub seconds: PhaseSeconds,
}

/// A body frozen because one of its particles turned non-finite, or got farther than 1e12 m.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fault {
    /// The body, which is fixed from now on.
    pub body: BodyHandle,
    /// The first such particle, counted within the body.
    pub particle: u32,
}

/// Time by phase, in s.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PhaseSeconds {
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
    /// Solving for rigid bodies.
    pub solve: f64,
    /// All small steps of cloth and rope.
    pub soft: f64,
}

impl std::ops::AddAssign for PhaseSeconds {
    fn add_assign(&mut self, other: Self) {
        self.integrate += other.integrate;
        self.broad_phase += other.broad_phase;
        self.narrow_phase += other.narrow_phase;
        self.separate += other.separate;
        self.relax += other.relax;
        self.solve += other.solve;
        self.soft += other.soft;
    }
}

/// Tells the time, in s from any start.
pub(crate) type Clock<'a> = dyn FnMut() -> f64 + 'a;

#[derive(Debug, Clone, Copy)]
pub(crate) enum Phase {
    Integrate,
    FindPairs,
    FindContacts,
    Separate,
    Relax,
    Solve,
    Soft,
}

/// Adds up time by phase.
pub(crate) struct Stopwatch<'a, 'b> {
    clock: &'a mut Clock<'b>,
    last: f64,
    seconds: PhaseSeconds,
}

impl<'a, 'b> Stopwatch<'a, 'b> {
    pub(crate) fn start(clock: &'a mut Clock<'b>) -> Self {
        let last = clock();
        Self { clock, last, seconds: PhaseSeconds::default() }
    }

    /// Counts the time since the last lap for `phase`.
    pub(crate) fn lap(&mut self, phase: Phase) {
        let now = (self.clock)();
        let seconds = &mut self.seconds;
        let sum = match phase {
            Phase::Integrate => &mut seconds.integrate,
            Phase::FindPairs => &mut seconds.broad_phase,
            Phase::FindContacts => &mut seconds.narrow_phase,
            Phase::Separate => &mut seconds.separate,
            Phase::Relax => &mut seconds.relax,
            Phase::Solve => &mut seconds.solve,
            Phase::Soft => &mut seconds.soft,
        };
        *sum += now - self.last;
        self.last = now;
    }

    pub(crate) fn finish(self) -> PhaseSeconds {
        self.seconds
    }
}
