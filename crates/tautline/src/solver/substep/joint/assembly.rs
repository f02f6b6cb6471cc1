//! Bodies that joints hold together, and those joints, solved as a whole.
//!
//! A substep moves positions by q' = q + v h and velocities by the forces at q: the impulses act along the Jacobian at
//! q, and are such that the constraints hold at q'. That is SHAKE (Ryckaert, Ciccotti & Berendsen 1977), which is
//! symplectic and reversible, here with the rotation of Moser and Veselov (McLachlan & Zanna 2005): what swings keeps
//! its energy, and constraints do not drift. No velocity is left over to be taken out again, so that joints have no
//! relaxing pass. The equations are solved by Newton's method with the matrix at q.

use glam::Vec3;

use crate::joint::{Coordinates, Joint, Kind, LocalFrame, MOST_ROWS, Placed, State, measure};

use super::super::crew::Crew;
use super::elimination::{Matrix, Part, Plan, ZERO, transposed};
use super::mover::{Mover, part};
use super::rows::{JointRow, rows};
use super::stop::{self, Row as StopRow};

/// Newton's steps with all rows as they are; …
const LEAST_ITERATIONS: usize = 2;
/// … and at most, while rows reach their bounds or leave them.
const MOST_ITERATIONS: usize = 8;

/// By how much every row gives way, as a share of how much its bodies do: it decides between joints that hold the
/// same twice over. The error it makes is as small as this share of what the load would move a body in a substep.
const GIVE: f32 = 1e-4;

/// The share of an error at the start of a substep that it undoes. Joints by themselves make next to none; what contacts
/// pulled apart would shake if joints and contacts undid each other's work at once.
const RECOVERY: f32 = 0.2;

/// Rows that move nothing, in 1/kg.
const LEAST_RESPONSE: f32 = 1e-25;

/// Bodies that joints hold together.
#[derive(Debug, Clone, Default)]
pub(super) struct Assembly {
    /// First those that are solved for, then those that move as they are told.
    pub(super) movers: Vec<Mover>,
    pub(super) solved: usize,
    pub(super) works: Vec<Work>,
    pub(super) plan: Plan,
    matrix: Matrix,
    vector: Vec<Part>,
}

/// A joint while a step is made.
#[derive(Debug, Clone)]
pub(super) struct Work {
    /// In the world.
    pub(super) index: u32,
    pub(super) joint: Joint,
    /// Indices of movers; no base = the world.
    pub(super) body: u32,
    pub(super) base: Option<u32>,
    pub(super) rows: [JointRow; MOST_ROWS],
    /// By row, how much its two bodies give way to it, in 1/kg or 1/(kg m²).
    response: [f32; MOST_ROWS],
    /// At the start of the substep, and where motions lead.
    now: Coordinates,
    ahead: Coordinates,
    /// Whether a row is solved for; where it is to lead, and by how much it gives way.
    is_held: [bool; MOST_ROWS],
    goal: [f32; MOST_ROWS],
    softness: [f32; MOST_ROWS],
}

/// The substep that is being made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// In s.
    pub(super) h: f32,
    /// The most that a substep undoes of an error, in m or rad.
    pub(super) limit: f32,
}

impl Work {
    pub(super) fn new(index: usize, joint: &Joint, body: u32, base: Option<u32>) -> Self {
        let zero = [0.0; MOST_ROWS];
        Self {
            index: index as u32,
            joint: joint.clone(),
            body,
            base,
            rows: [JointRow::default(); MOST_ROWS],
            response: zero,
            now: zero,
            ahead: zero,
            is_held: [false; MOST_ROWS],
            goal: zero,
            softness: zero,
        }
    }

    /// Begins a step with the joint as it is now. Rows that it has no more do nothing, nor what is not finite.
    pub(super) fn begin(&mut self, joint: &Joint) {
        self.joint.clone_from(joint);
        self.is_held = [false; MOST_ROWS];
        let state = &mut self.joint.state;
        if !state.multipliers.iter().all(|multiplier| multiplier.is_finite()) {
            *state = State { is_broken: state.is_broken, ..State::default() };
        }
        (state.force, state.torque) = (Vec3::ZERO, Vec3::ZERO);
        let first: usize = self.joint.kind.locks().iter().sum();
        let mut stops = state.multipliers[first..].iter_mut().zip(self.joint.kind.stops());
        stops.by_ref().filter(|(_, stop)| stop.is_none()).for_each(|(multiplier, _)| *multiplier = 0.0);
    }

    /// Base and body, where they are or where their motions lead.
    fn placed(&self, movers: &[Mover], is_ahead: bool) -> [Placed; 2] {
        let place = |frame: &LocalFrame, mover: &Mover| {
            let axes = if is_ahead { mover.turned } else { mover.axes };
            let shift = if is_ahead { mover.linear } else { Vec3::ZERO };
            Placed { shift, ..frame.on_body(mover.center, axes) }
        };
        let on_base = &self.joint.on_base;
        let base =
            self.base.map_or_else(|| on_base.in_world(), |base| place(on_base, &movers[base as usize]));
        [base, place(&self.joint.on_body, &movers[self.body as usize])]
    }

    /// Finds the rows where the bodies are, and what their last loads do to the bodies.
    fn prepare(&mut self, movers: &mut [Mover]) {
        let [base, body] = self.placed(movers, false);
        let kind = &self.joint.kind;
        self.now = measure(kind, &base, &body, self.joint.state.angle);
        self.rows = rows(kind, &base, &body);
        if let Kind::Hinge(_) = kind {
            self.joint.state.angle = self.now[5];
        }
        let load = |(row, multiplier): (&JointRow, &f32)| row.linear * *multiplier;
        let force: Vec3 = self.rows.iter().zip(&self.joint.state.multipliers).map(load).sum();
        movers[self.body as usize].stiffen(force, body.arm);
        if let Some(index) = self.base {
            movers[index as usize].stiffen(-force, base.arm + base.to(&body));
        }
    }

    /// Finds how much the bodies give way to each row.
    fn weigh(&mut self, movers: &[Mover]) {
        let movers = [self.base.map(|base| &movers[base as usize]), Some(&movers[self.body as usize])];
        for (response, row) in self.response.iter_mut().zip(&self.rows) {
            *response = 0.0;
            for (mover, arm) in movers.iter().zip([row.on_base, row.on_body]) {
                let give = |mover: &Mover| {
                    row.linear.length_squared() * mover.inverse_mass + arm.dot(mover.turned_by(arm))
                };
                *response += mover.map_or(0.0, give);
            }
        }
    }

    /// Sets what the rows are to do. Returns whether other rows are held than before.
    fn aim(&mut self, pace: &Pace) -> bool {
        let before = self.is_held;
        let [linear, angular] = self.joint.kind.locks();
        let (strength, h) = (&self.joint.strength, pace.h);
        for k in 0..linear + angular {
            let compliance = if k < linear { strength.compliance } else { strength.angular_compliance };
            let error = self.now[k];
            let rest = if compliance > 0.0 {
                0.0
            } else {
                error - (error * RECOVERY).clamp(-pace.limit, pace.limit)
            };
            (self.is_held[k], self.goal[k], self.softness[k]) = (true, rest, compliance / (h * h));
        }
        for (i, stop) in self.joint.kind.stops().iter().enumerate() {
            let k = linear + angular + i;
            let Some(stop) = stop else { continue };
            let row = StopRow {
                now: self.now[k],
                mass: 1.0 / self.response[k].max(LEAST_RESPONSE),
                rate: self.joint.state.rate,
                compliance: if linear == 0 { strength.compliance } else { 0.0 },
            };
            let aim = stop::aim(stop, self.joint.state.modes[i], &row, pace);
            (self.is_held[k], self.goal[k], self.softness[k]) = (aim.is_held, aim.goal, aim.softness);
        }
        for k in 0..MOST_ROWS {
            self.is_held[k] &= self.response[k] > LEAST_RESPONSE;
            self.softness[k] += GIVE * self.response[k];
        }
        self.is_held != before
    }

    /// Lets rows with bounds reach them or leave them. Returns by row how the multipliers change at once.
    fn switch(&mut self, pace: &Pace) -> Option<[f32; MOST_ROWS]> {
        let [linear, angular] = self.joint.kind.locks();
        let (mut changes, mut has_changed) = ([0.0; MOST_ROWS], false);
        for (i, stop) in self.joint.kind.stops().iter().enumerate() {
            let (Some(stop), k) = (stop, linear + angular + i) else { continue };
            let state = &mut self.joint.state;
            let (now, ahead, multiplier) = (self.now[k], self.ahead[k], state.multipliers[k]);
            let mode = stop::next_mode(stop, state.modes[i], [now, ahead], multiplier, pace);
            has_changed |= mode != state.modes[i];
            state.modes[i] = mode;
            if let Some(fixed) = stop::fixed_multiplier(stop, mode, pace) {
                changes[k] = fixed - multiplier;
                state.multipliers[k] = fixed;
                has_changed |= changes[k] != 0.0;
            }
        }
        has_changed.then_some(changes)
    }

    /// What multipliers do to the two bodies.
    fn push(&self, movers: &mut [Mover], multipliers: &[f32; MOST_ROWS]) {
        let (mut force, mut on_base, mut on_body) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
        for (row, &multiplier) in self.rows.iter().zip(multipliers) {
            force += row.linear * multiplier;
            on_base += row.on_base * multiplier;
            on_body += row.on_body * multiplier;
        }
        movers[self.body as usize].push(force, on_body);
        if let Some(base) = self.base {
            movers[base as usize].push(-force, -on_base);
        }
    }

    /// Looks where the motions lead.
    fn look_ahead(&mut self, movers: &[Mover]) {
        let [base, body] = self.placed(movers, true);
        self.ahead = measure(&self.joint.kind, &base, &body, self.joint.state.angle);
    }

    /// Adds what the base did to the body in this substep to the state.
    fn note(&mut self, pace: &Pace) {
        let state = &mut self.joint.state;
        for (row, &multiplier) in self.rows.iter().zip(&state.multipliers) {
            if row.is_angular() {
                state.torque += row.on_body * multiplier;
            } else {
                state.force += row.linear * multiplier;
            }
        }
        state.rate = (self.ahead[0] - self.now[0]) / pace.h;
    }
}

impl Assembly {
    pub(super) fn new(movers: Vec<Mover>, solved: usize, works: Vec<Work>, plan: Plan) -> Self {
        Self { movers, solved, works, plan, ..Self::default() }
    }

    pub(super) fn read(&mut self, crew: &Crew) {
        for mover in &mut self.movers {
            mover.read(&crew.blocks, &crew.velocities);
        }
    }

    /// Solves for all joints in a substep.
    pub(super) fn solve(&mut self, pace: &Pace) {
        for work in &mut self.works {
            work.prepare(&mut self.movers);
        }
        self.movers.iter_mut().for_each(Mover::settle);
        for work in &mut self.works {
            work.weigh(&self.movers);
            // Rows that bodies turned under are aimed anew with the multipliers of the last substep.
            work.push(&mut self.movers, &work.joint.state.multipliers);
        }
        for iteration in 0..MOST_ITERATIONS {
            self.look_ahead();
            let has_switched = self.switch(pace);
            if has_switched {
                self.look_ahead();
            } else if iteration >= LEAST_ITERATIONS {
                break;
            }
            let mut is_changed = iteration == 0;
            for work in &mut self.works {
                is_changed |= work.aim(pace);
            }
            if is_changed || has_switched {
                self.fill();
                self.matrix.factor(&self.plan);
            }
            self.correct();
        }
        for work in &mut self.works {
            work.note(pace);
        }
    }

    fn look_ahead(&mut self) {
        self.movers.iter_mut().for_each(Mover::look_ahead);
        for work in &mut self.works {
            work.look_ahead(&self.movers);
        }
    }

    fn switch(&mut self, pace: &Pace) -> bool {
        let mut has_switched = false;
        for work in &mut self.works {
            if let Some(changes) = work.switch(pace) {
                work.push(&mut self.movers, &changes);
                has_switched = true;
            }
        }
        has_switched
    }

    /// The matrix [M Jᵀ; J −σ].
    fn fill(&mut self) {
        self.matrix.clear(&self.plan);
        for (block, mover) in self.matrix.diagonal.iter_mut().zip(&self.movers[..self.solved]) {
            *block = mover.mass_block();
        }
        let joints = self.matrix.diagonal[self.solved..].iter_mut();
        for ((work, diagonal), sides) in self.works.iter().zip(joints).zip(&self.plan.sides) {
            let mut blocks = [ZERO; 2];
            for (k, row) in work.rows.iter().enumerate() {
                diagonal[k][k] = -1.0;
                if work.is_held[k] {
                    diagonal[k][k] = f64::from(-work.softness[k]);
                    blocks[0][k] = part(-row.linear, -row.on_base);
                    blocks[1][k] = part(row.linear, row.on_body);
                }
            }
            for (side, block) in sides.iter().zip(blocks) {
                if let Some((index, is_transposed)) = *side {
                    self.matrix.lower[index as usize] =
                        if is_transposed { transposed(&block) } else { block };
                }
            }
        }
    }

    /// One step of Newton's method: J Δv + σ Δλ = goal − where it leads − σ λ, M Δv = Jᵀ Δλ.
    fn correct(&mut self) {
        self.vector.clear();
        self.vector.resize(self.solved + self.works.len(), [0.0; 6]);
        for (work, part) in self.works.iter().zip(&mut self.vector[self.solved..]) {
            for (k, number) in part.iter_mut().enumerate().filter(|(k, _)| work.is_held[*k]) {
                let give = f64::from(work.softness[k]) * f64::from(work.joint.state.multipliers[k]);
                *number = f64::from(work.goal[k]) - f64::from(work.ahead[k]) - give;
            }
        }
        self.matrix.solve(&self.plan, &mut self.vector);
        for (work, part) in self.works.iter_mut().zip(&self.vector[self.solved..]) {
            // The matrix is symmetric in −Δλ.
            let changes = part.map(|number| -number as f32);
            for (multiplier, change) in work.joint.state.multipliers.iter_mut().zip(&changes) {
                *multiplier += change;
            }
            work.push(&mut self.movers, &changes);
        }
    }
}
