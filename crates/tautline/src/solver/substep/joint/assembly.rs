//! Bodies that joints hold together, and those joints, solved as a whole.
//!
//! A substep moves positions by q' = q + v h and velocities by the forces at q: the impulses act along the Jacobian at
//! q, and are such that the constraints hold at q'. That is SHAKE (Ryckaert, Ciccotti & Berendsen 1977), which is
//! symplectic and reversible, here with the rotation of Moser and Veselov (McLachlan & Zanna 2005): what swings keeps
//! its energy, and constraints do not drift. The equations are solved by Newton's method with the matrix at q.
//!
//! Where a substep is too long for that (a slack chain that snaps tight), the method finds no answer, or one in which
//! joints do work. Then velocities are made such that J v = 0, which only ever takes energy: see `go_straight`. What this
//! leaves of errors, or contacts have made, is undone by a motion that bodies give back once they have moved: see `lend`.

use glam::Vec3;

use crate::joint::MOST_ROWS;

use super::super::crew::Crew;
use super::super::elimination::{Matrix, Part, Plan, ZERO, transposed};
use super::super::rigidity::FASTEST;
use super::mover::{Mover, part};
use super::work::Work;

/// Newton's steps with all rows as they are; …
const LEAST_ITERATIONS: usize = 2;
/// … and at most, while rows reach their bounds or leave them.
const MOST_ITERATIONS: usize = 8;

/// Errors that are no reason to doubt Newton's method, in m or rad, …
const SMALL_ERROR: f64 = 1e-4;
/// … and those at which it has found the answer.
const NO_ERROR: f64 = 1e-5;

/// The most that bodies turn in a substep for Newton's method to be tried, in rad.
const GREATEST_TURN: f32 = 2.0 * FASTEST;

/// How much work joints may seem to do, as a share of what their impulses would do to bodies at rest. As much again is
/// that of an elastic blow.
const MOST_WORK: f32 = 0.5;

/// The least undoing of an error in a substep that is worth taking back, in m or rad.
const LEAST_LOAN: f64 = 1e-5;

/// Bodies that joints hold together.
#[derive(Debug, Clone, Default)]
pub(super) struct Assembly {
    /// First those that are solved for, then those that move as they are told.
    pub(super) movers: Vec<Mover>,
    pub(super) solved: usize,
    pub(super) works: Vec<Work>,
    pub(super) plan: Plan,
    /// Of each joint, and of each of its two sides that is a body that is solved for, the number of its edge.
    sides: Vec<[Option<u32>; 2]>,
    /// Whether motions are taken to lead straight on, since Newton's method has failed.
    is_linear: bool,
    matrix: Matrix,
    vector: Vec<Part>,
    /// By mover, what the joints have done to its motion, linear and angular.
    pulled: Vec<[Vec3; 2]>,
}

/// The substep that is being made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// In s.
    pub(super) h: f32,
    /// The most that a substep undoes of an error, in m or rad.
    pub(super) limit: f32,
}

impl Assembly {
    /// The first `solved` of the movers are solved for.
    pub(super) fn new(movers: Vec<Mover>, solved: usize, works: Vec<Work>) -> Self {
        let mut edges = Vec::new();
        let mut side = |body: u32, joint: usize| {
            let is_solved = (body as usize) < solved;
            is_solved.then(|| {
                edges.push([body, (solved + joint) as u32]);
                edges.len() as u32 - 1
            })
        };
        let sides = works.iter().enumerate();
        let sides =
            sides.map(|(j, work)| [work.base.and_then(|base| side(base, j)), side(work.body, j)]).collect();
        let plan = Plan::new(solved + works.len(), solved, &edges);
        Self { movers, solved, works, plan, sides, ..Self::default() }
    }

    pub(super) fn read(&mut self, crew: &Crew) {
        for mover in &mut self.movers {
            mover.read(&crew.blocks);
            mover.read_motion(&crew.velocities);
        }
    }

    pub(super) fn read_motions(&mut self, crew: &Crew) {
        for mover in &mut self.movers {
            mover.read_motion(&crew.velocities);
        }
    }

    pub(super) fn write_motions(&mut self, crew: &mut Crew) {
        for mover in &mut self.movers[..self.solved] {
            let row = mover.row(&crew.velocities[mover.place as usize]);
            crew.set_velocity(mover.place as usize, row);
        }
    }

    /// Finds the rows where the bodies are, and gives these what the joints did in the last substep.
    pub(super) fn warm_start(&mut self) {
        for work in &mut self.works {
            work.prepare(&self.movers);
        }
        self.stiffen();
        for work in &self.works {
            // Rows that bodies turned under are aimed anew with the multipliers of the last substep.
            work.push(&mut self.movers, &work.joint.state.multipliers);
        }
    }

    /// Finds the inertia that impulses meet under the loads that multipliers stand for.
    fn stiffen(&mut self) {
        for work in &self.works {
            work.stiffen(&mut self.movers);
        }
        self.movers.iter_mut().for_each(Mover::settle);
        for work in &mut self.works {
            work.weigh(&self.movers);
        }
    }

    /// Solves for all joints in a substep.
    pub(super) fn solve(&mut self, pace: &Pace) {
        self.is_linear = false;
        if !(self.iterate(pace) && self.does_no_work()) {
            self.go_straight(pace);
        }
        self.lend();
        for work in &mut self.works {
            work.note(pace);
        }
    }

    /// Newton's method. Returns whether it has found the answer.
    fn iterate(&mut self, pace: &Pace) -> bool {
        let mut last_error = f64::INFINITY;
        for iteration in 0..MOST_ITERATIONS {
            self.look_ahead();
            let has_switched = self.switch(pace);
            if has_switched {
                self.look_ahead();
            }
            let is_aimed_anew = self.aim(pace);
            let error = self.find_errors();
            let converges = error < last_error.max(SMALL_ERROR) && self.turns_little();
            if !self.is_linear && !converges {
                return false;
            }
            let is_met = error < NO_ERROR || self.is_linear;
            if iteration >= LEAST_ITERATIONS && is_met && !has_switched {
                return true;
            }
            if iteration == 0 || is_aimed_anew || has_switched {
                self.fill();
                self.matrix.factor(&self.plan);
            }
            self.correct();
            last_error = error;
        }
        false
    }

    /// Finds velocities with J v = 0, which there always are: twice, since the blow that a chain snaps tight with is many
    /// times the load of the last substep. With the inertia that this one made, links between heavy bodies would turn
    /// further than substeps can tell, and the more so in the next one, until the chain is drawn apart.
    fn go_straight(&mut self, pace: &Pace) {
        self.is_linear = true;
        for knows_blow in [false, true] {
            self.pull();
            if knows_blow {
                self.stiffen();
            }
            self.begin_anew();
            self.iterate(pace);
        }
    }

    fn look_ahead(&mut self) {
        self.movers.iter_mut().for_each(Mover::look_ahead);
        for work in &mut self.works {
            work.look_ahead(&self.movers, self.is_linear);
        }
    }

    fn turns_little(&self) -> bool {
        self.movers.iter().all(|mover| mover.angular.length_squared() < GREATEST_TURN * GREATEST_TURN)
    }

    /// Sets what all rows are to do. Returns whether other rows are held than before.
    fn aim(&mut self, pace: &Pace) -> bool {
        self.works.iter_mut().fold(false, |is_changed, work| is_changed | work.aim(pace))
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
        for ((work, diagonal), sides) in self.works.iter().zip(joints).zip(&self.sides) {
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
                if let Some(edge) = *side {
                    let (index, is_transposed) = self.plan.blocks[edge as usize];
                    self.matrix.lower[index as usize] =
                        if is_transposed { transposed(&block) } else { block };
                }
            }
        }
    }

    /// Finds how far rows are from where they are to lead. Returns the greatest such error, in m or rad.
    fn find_errors(&mut self) -> f64 {
        self.vector.clear();
        self.vector.resize(self.solved + self.works.len(), [0.0; 6]);
        let mut greatest = 0.0f64;
        for (work, part) in self.works.iter().zip(&mut self.vector[self.solved..]) {
            for (k, number) in part.iter_mut().enumerate().filter(|(k, _)| work.is_held[*k]) {
                *number = work.shortfall(k);
                greatest = greatest.max(number.abs());
            }
        }
        greatest
    }

    /// Whether rows that only hold do so without work. With the velocities v⁻ before and v⁺ after the joints, that is
    /// Σ λ J (v⁻ + v⁺)/2, which is nothing where a motion goes on as it did, and negative where it is stopped.
    fn does_no_work(&mut self) -> bool {
        self.pull();
        let sums = self.works.iter().map(|work| work.work_done(&self.pulled));
        let [work, scale] = sums.fold([0.0; 2], |sum, [work, scale]| [sum[0] + work, sum[1] + scale]);
        work <= MOST_WORK * scale
    }

    fn pull(&mut self) {
        self.pulled.clear();
        self.pulled.resize(self.movers.len(), [Vec3::ZERO; 2]);
        for work in &self.works {
            work.pull(&self.movers, &mut self.pulled);
        }
    }

    /// Goes back to how bodies would move had joints not pulled them. To make J v = 0 from there takes energy.
    fn begin_anew(&mut self) {
        for (mover, pulled) in self.movers[..self.solved].iter_mut().zip(&self.pulled) {
            mover.calm(*pulled);
        }
        for work in &mut self.works {
            work.joint.state.multipliers = [0.0; MOST_ROWS];
        }
    }

    /// Finds the part of all motions that undoes errors. It is given back after bodies have moved: kept, it would throw
    /// them, and the more the longer the chain that it adds up along.
    fn lend(&mut self) {
        self.vector.clear();
        self.vector.resize(self.solved + self.works.len(), [0.0; 6]);
        let mut greatest = 0.0f64;
        for (work, part) in self.works.iter().zip(&mut self.vector[self.solved..]) {
            for (k, number) in part.iter_mut().enumerate().filter(|(k, _)| work.is_held[*k]) {
                *number = f64::from(work.recovery(k));
                greatest = greatest.max(number.abs());
            }
        }
        if greatest > LEAST_LOAN {
            self.matrix.solve(&self.plan, &mut self.vector);
            let (motions, multipliers) = self.vector.split_at(self.solved);
            for (mover, part) in self.movers.iter_mut().zip(motions) {
                mover.lend(part);
            }
            // Which the matrix gives with the other sign.
            for (work, part) in self.works.iter_mut().zip(multipliers) {
                work.take_back(&part.map(|number| number as f32));
            }
        }
    }

    /// Takes back what was lent.
    pub(super) fn take_back(&self, crew: &mut Crew) {
        for mover in &self.movers[..self.solved] {
            if let Some(row) = mover.repaid(&crew.velocities[mover.place as usize]) {
                crew.set_velocity(mover.place as usize, row);
            }
        }
    }

    /// One step of Newton's method: J Δv + σ Δλ = goal − where it leads − σ λ, M Δv = Jᵀ Δλ.
    fn correct(&mut self) {
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
