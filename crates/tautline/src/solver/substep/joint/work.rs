//! One joint of an assembly: what its rows are to do, and what they did.

use glam::Vec3;

use crate::joint::{Coordinates, Joint, Kind, LocalFrame, MOST_ROWS, Mode, Placed, Push, State, measure};

use super::assembly::Pace;
use super::mover::Mover;
use super::rows::{JointRow, rows};
use super::stop::{self, Row as StopRow};

/// By how much every row gives way, as a share of how much its bodies do: it decides between joints that hold the
/// same twice over. The error it makes is as small as this share of what the load would move a body in a substep.
const GIVE: f32 = 1e-4;

/// The share of an error at the start of a substep that it undoes. Joints by themselves make next to none; what contacts
/// pulled apart would shake if joints and contacts undid each other's work at once.
pub(super) const RECOVERY: f32 = 0.2;

/// Rows that move nothing, in 1/kg.
const LEAST_RESPONSE: f32 = 1e-25;

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
    pub(super) is_held: [bool; MOST_ROWS],
    goal: [f32; MOST_ROWS],
    /// How much of the way there undoes an error.
    pub(super) undone: [f32; MOST_ROWS],
    /// Whether it only holds: without a motor, a spring or compliance.
    is_firm: [bool; MOST_ROWS],
    /// How far motions lead along the rows. That is what counts for a motor, not where it ends.
    way: [f32; MOST_ROWS],
    pub(super) softness: [f32; MOST_ROWS],
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
            undone: zero,
            is_firm: [false; MOST_ROWS],
            way: zero,
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
            let shift = if is_ahead { mover.shift + mover.linear } else { mover.shift };
            Placed { shift, ..frame.on_body(mover.center, axes) }
        };
        let on_base = &self.joint.on_base;
        let base =
            self.base.map_or_else(|| on_base.in_world(), |base| place(on_base, &movers[base as usize]));
        [base, place(&self.joint.on_body, &movers[self.body as usize])]
    }

    /// Finds the rows where the bodies are.
    pub(super) fn prepare(&mut self, movers: &[Mover]) {
        let [base, body] = self.placed(movers, false);
        let kind = &self.joint.kind;
        self.now = measure(kind, &base, &body, self.joint.state.angle);
        self.rows = rows(kind, &base, &body);
        if let Kind::Hinge(_) = kind {
            self.joint.state.angle = self.now[5];
        }
    }

    /// Adds what the multipliers do to the stiffness of the two bodies.
    pub(super) fn stiffen(&self, movers: &mut [Mover]) {
        let [base, body] = self.placed(movers, false);
        let load = |(row, multiplier): (&JointRow, &f32)| row.linear * *multiplier;
        let force: Vec3 = self.rows.iter().zip(&self.joint.state.multipliers).map(load).sum();
        movers[self.body as usize].stiffen(force, body.arm);
        if let Some(index) = self.base {
            movers[index as usize].stiffen(-force, base.arm + base.to(&body));
        }
    }

    /// Finds how much the bodies give way to each row.
    pub(super) fn weigh(&mut self, movers: &[Mover]) {
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
    pub(super) fn aim(&mut self, pace: &Pace) -> bool {
        let before = self.is_held;
        let [linear, angular] = self.joint.kind.locks();
        let (strength, h) = (&self.joint.strength, pace.h);
        for k in 0..linear + angular {
            let compliance = if k < linear { strength.compliance } else { strength.angular_compliance };
            let error = self.now[k];
            self.is_firm[k] = compliance == 0.0;
            self.undone[k] =
                if self.is_firm[k] { -(error * RECOVERY).clamp(-pace.limit, pace.limit) } else { 0.0 };
            let rest = if self.is_firm[k] { error + self.undone[k] } else { 0.0 };
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
            let mode = self.joint.state.modes[i];
            let aim = stop::aim(stop, mode, &row, pace);
            (self.is_held[k], self.goal[k], self.softness[k]) = (aim.is_held, aim.goal, aim.softness);
            self.undone[k] = aim.undone;
            self.is_firm[k] = matches!(mode, Mode::AtLow | Mode::AtHigh) && aim.softness == 0.0;
        }
        for k in 0..MOST_ROWS {
            self.is_held[k] &= self.response[k] > LEAST_RESPONSE;
            self.softness[k] += GIVE * self.response[k];
        }
        self.is_held != before
    }

    /// Lets rows with bounds reach them or leave them. Returns by row how the multipliers change at once.
    pub(super) fn switch(&mut self, pace: &Pace) -> Option<[f32; MOST_ROWS]> {
        let [linear, angular] = self.joint.kind.locks();
        let (mut changes, mut has_changed) = ([0.0; MOST_ROWS], false);
        for (i, stop) in self.joint.kind.stops().iter().enumerate() {
            let (Some(stop), k) = (stop, linear + angular + i) else { continue };
            let state = &mut self.joint.state;
            let multiplier = state.multipliers[k];
            let lead = stop::Lead { ahead: self.ahead[k], way: self.way[k], multiplier };
            let mode = stop::next_mode(stop, state.modes[i], &lead, pace);
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
    pub(super) fn push(&self, movers: &mut [Mover], multipliers: &[f32; MOST_ROWS]) {
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

    /// How much of the way of row k undoes an error: all but what the load takes of it.
    pub(super) fn recovery(&self, k: usize) -> f32 {
        let sag = if self.is_firm[k] { self.softness[k] * self.joint.state.multipliers[k] } else { 0.0 };
        self.undone[k] - sag
    }

    /// Changes the multipliers at the end. Rows with bounds that push go on pushing.
    pub(super) fn take_back(&mut self, changes: &[f32; MOST_ROWS]) {
        let first: usize = self.joint.kind.locks().iter().sum();
        for (k, (multiplier, change)) in self.joint.state.multipliers.iter_mut().zip(changes).enumerate() {
            let rest = *multiplier + change;
            *multiplier = if k < first || rest * *multiplier > 0.0 { rest } else { 0.0 };
        }
    }

    /// Adds what all multipliers do to the motions of the two bodies.
    pub(super) fn pull(&self, movers: &[Mover], pulled: &mut [[Vec3; 2]]) {
        for (row, &multiplier) in self.rows.iter().zip(&self.joint.state.multipliers) {
            let sides = [(self.base, -1.0, row.on_base), (Some(self.body), 1.0, row.on_body)];
            for (index, sign, arm) in sides {
                let Some(index) = index.map(|index| index as usize) else { continue };
                pulled[index][0] += row.linear * (sign * multiplier * movers[index].inverse_mass);
                pulled[index][1] += movers[index].turned_by(arm * (sign * multiplier));
            }
        }
    }

    /// The work of the rows that only hold, and how much it would be if they stopped the bodies, in kg m².
    pub(super) fn work_done(&self, pulled: &[[Vec3; 2]]) -> [f32; 2] {
        let [on_base, on_body] = [self.base, Some(self.body)]
            .map(|index| index.map_or([Vec3::ZERO; 2], |index| pulled[index as usize]));
        let (mut work, mut scale) = (0.0, 0.0);
        for (k, row) in self.rows.iter().enumerate().filter(|(k, _)| self.is_held[*k] && self.is_firm[*k]) {
            let multiplier = self.joint.state.multipliers[k];
            let half = 0.5
                * (row.linear.dot(on_body[0] - on_base[0]) + row.on_body.dot(on_body[1])
                    - row.on_base.dot(on_base[1]));
            work += multiplier * (self.way[k] - self.undone[k] - half);
            scale += multiplier * half;
        }
        [work, scale]
    }

    /// Looks where the motions lead.
    pub(super) fn look_ahead(&mut self, movers: &[Mover], is_linear: bool) {
        let [placed_base, placed_body] = self.placed(movers, true);
        self.ahead = measure(&self.joint.kind, &placed_base, &placed_body, self.joint.state.angle);
        let still = Mover::default();
        let base = self.base.map_or(&still, |base| &movers[base as usize]);
        let body = &movers[self.body as usize];
        for (way, row) in self.way.iter_mut().zip(&self.rows) {
            *way = row.linear.dot(body.linear - base.linear) + row.on_body.dot(body.angular)
                - row.on_base.dot(base.angular);
        }
        if is_linear {
            self.ahead = std::array::from_fn(|k| self.now[k] + self.way[k]);
        }
    }

    /// How far row k is from where it is to lead.
    pub(super) fn shortfall(&self, k: usize) -> f64 {
        let first: usize = self.joint.kind.locks().iter().sum();
        let give = f64::from(self.softness[k]) * f64::from(self.joint.state.multipliers[k]);
        let is_driven = |stop: usize| {
            let push = self.joint.kind.stops()[stop].and_then(|stop| stop.push);
            matches!(push, Some(Push::Motor(_))) && self.joint.state.modes[stop] == Mode::Within
        };
        let reached = match k.checked_sub(first) {
            Some(stop) if is_driven(stop) => self.way[k],
            _ => self.ahead[k],
        };
        f64::from(self.goal[k]) - f64::from(reached) - give
    }

    /// Adds what the base did to the body in this substep to the state.
    pub(super) fn note(&mut self, pace: &Pace) {
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
