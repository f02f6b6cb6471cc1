//! One body of an assembly: where it is, how it moves, and where that takes it.

use glam::{DVec3, Mat3, Vec3};

use crate::simd::{LANES, Row};

use super::super::block::{Block, column, columns};
use super::super::elimination::{self, Part};
use super::super::rigidity;

/// A body as joints see it, with motions in the world's frame.
#[derive(Debug, Clone, Default)]
pub(super) struct Mover {
    /// In the lineup; of a kinematic body its first copy.
    pub(super) place: u32,
    /// Its centre of mass when the step began, and how far that has moved since, in m.
    pub(super) center: Vec3,
    pub(super) shift: Vec3,
    pub(super) axes: Mat3,
    start_axes: Mat3,
    /// Principal moments per mass, in m².
    inertia: Vec3,
    root_inertia: Vec3,
    /// What loads do to it, per mass; see `stiffen`. Summed up, the inertia that impulses meet.
    stiffness: Mat3,
    slow_inertia: Vec3,
    /// That with which its rotation has the energy that it came with.
    calm_inertia: Vec3,
    /// In 1/kg; 0 = nothing moves it.
    pub(super) inverse_mass: f32,
    /// In the substep, in m and rad.
    pub(super) linear: Vec3,
    pub(super) angular: Vec3,
    /// Motion that forces and contacts gave it, …
    given: [Vec3; 2],
    /// … and what joints add to that.
    gained: [DVec3; 2],
    /// What the row was too coarse for in earlier substeps of this step: momentum would get lost with it.
    lost: [DVec3; 2],
    /// What of its row is taken back once it has moved: linear and angular.
    lent: Option<[Vec3; 2]>,
    /// Where the motion turns the axes to.
    pub(super) turned: Mat3,
}

impl Mover {
    pub(super) fn at(place: u32) -> Self {
        Self { place, ..Self::default() }
    }

    pub(super) fn read(&mut self, blocks: &[Block]) {
        let (block, lane) = (&blocks[self.place as usize / LANES], self.place as usize % LANES);
        let constants = &block.constants;
        self.center = column(&block.center, lane);
        self.shift = column(&block.shift, lane);
        self.axes = columns(&block.axes, lane);
        self.start_axes = columns(&block.start_axes, lane);
        self.inertia = column(&constants.inertia, lane);
        self.root_inertia = column(&constants.root_inertia, lane);
        self.inverse_mass = constants.inverse_mass.0[lane];
        self.stiffness = Mat3::ZERO;
        self.slow_inertia = self.inertia;
        self.calm_inertia = self.inertia;
    }

    pub(super) fn read_motion(&mut self, velocities: &[Row]) {
        let [x, y, z, _, p, q, r, _] = velocities[self.place as usize].0;
        self.linear = Vec3::new(x, y, z);
        self.angular = self.start_axes * (Vec3::new(p, q, r) / self.root_inertia);
        self.given = [self.linear, self.angular];
        self.gained = [DVec3::ZERO; 2];
        self.lent = None;
    }

    /// Notes a part of its motion that only undoes errors.
    pub(super) fn lend(&mut self, part: &Part) {
        let [linear, angular] = [0, 3].map(|k| DVec3::new(part[k], part[k + 1], part[k + 2]).as_vec3());
        self.lent = Some([linear, self.start_axes.transpose() * angular * self.root_inertia]);
    }

    /// The row without what was lent.
    pub(super) fn repaid(&self, row: &Row) -> Option<Row> {
        let [linear, angular] = self.lent?;
        let mut repaid = *row;
        for (k, lent) in [(0, linear), (4, angular)] {
            for (number, lent) in repaid.0[k..k + 3].iter_mut().zip(lent.to_array()) {
                *number -= lent;
            }
        }
        Some(repaid)
    }

    /// The row of the body, of which this was read, with what joints have changed.
    pub(super) fn row(&mut self, before: &Row) -> Row {
        let mut row = *before;
        let turn = self.start_axes.transpose() * self.gained[1].as_vec3() * self.root_inertia;
        let changes = [self.gained[0], turn.as_dvec3()];
        for (k, (change, lost)) in changes.into_iter().zip(&mut self.lost).enumerate() {
            let place = &mut row.0[4 * k..4 * k + 3];
            let exact = DVec3::new(place[0].into(), place[1].into(), place[2].into()) + change + *lost;
            place.copy_from_slice(&exact.as_vec3().to_array());
            *lost = exact - exact.as_vec3().as_dvec3();
        }
        row
    }

    pub(super) fn begin_step(&mut self) {
        self.lost = [DVec3::ZERO; 2];
    }

    /// A force (kg m) that pulls a body by an arm turns it like a pendulum, with the stiffness (f·r) 1 − sym(r fᵀ) (Tournier
    /// et al. 2015, Stable constrained dynamics). Where that swings faster than substeps can tell, impulses meet as
    /// much more inertia as slows it down to what they can: Newmark's method does the same to a stiff spring.
    pub(super) fn stiffen(&mut self, force: Vec3, arm: Vec3) {
        let (force, arm) = (self.axes.transpose() * force, self.axes.transpose() * arm);
        let outer = |x: Vec3, y: Vec3| Mat3::from_cols(x * y.x, x * y.y, x * y.z);
        let lean = (outer(arm, force) + outer(force, arm)) * 0.5;
        self.stiffness += (Mat3::from_diagonal(Vec3::splat(force.dot(arm))) - lean) * self.inverse_mass;
    }

    /// Sums up what loads do: by row, as Gershgorin bounds the frequencies. Inertia only grows in a substep.
    pub(super) fn settle(&mut self) {
        let stiffness = std::mem::replace(&mut self.stiffness, Mat3::ZERO);
        let columns = [stiffness.x_axis, stiffness.y_axis, stiffness.z_axis];
        let bound = |k: usize| columns[k].abs().element_sum() - columns[k][k].abs() + columns[k][k];
        self.slow_inertia = self.slow_inertia.max(Vec3::new(bound(0), bound(1), bound(2)));
    }

    /// What an angular impulse (kg m² per substep) does to the rotation.
    pub(super) fn turned_by(&self, impulse: Vec3) -> Vec3 {
        self.axes * (self.axes.transpose() * impulse / self.slow_inertia) * self.inverse_mass
    }

    pub(super) fn push(&mut self, linear: Vec3, angular: Vec3) {
        self.gained[0] += linear.as_dvec3() * f64::from(self.inverse_mass);
        self.gained[1] += self.turned_by(angular).as_dvec3();
        self.linear = (self.given[0].as_dvec3() + self.gained[0]).as_vec3();
        self.angular = (self.given[1].as_dvec3() + self.gained[1]).as_vec3();
    }

    /// Takes off what joints have done to its motion, and as much of its rotation as makes its energy with the inertia
    /// that impulses meet no greater than it is.
    pub(super) fn calm(&mut self, [linear, angular]: [Vec3; 2]) {
        let [rest, turn] = [self.linear - linear, self.axes.transpose() * (self.angular - angular)];
        let share = (self.calm_inertia / self.slow_inertia).map(f32::sqrt);
        self.calm_inertia = self.slow_inertia;
        [self.linear, self.angular] = [rest, self.axes * (turn * share)];
        self.gained = [self.linear - self.given[0], self.angular - self.given[1]].map(|gain| gain.as_dvec3());
    }

    /// Mass and inertia about the axes of the world.
    pub(super) fn mass_block(&self) -> elimination::Block {
        let mass = 1.0 / f64::from(self.inverse_mass);
        let axes = self.axes.to_cols_array_2d().map(|axis| axis.map(f64::from));
        let inertia = self.slow_inertia.to_array().map(|moment| f64::from(moment) * mass);
        let mut block = elimination::ZERO;
        for i in 0..3 {
            block[i][i] = mass;
            for j in 0..3 {
                block[3 + i][3 + j] = (0..3).fold(0.0, |sum, k| sum + axes[k][i] * inertia[k] * axes[k][j]);
            }
        }
        block
    }

    /// Finds out where the motion turns it: as `rigidity` will.
    pub(super) fn look_ahead(&mut self) {
        let angular = self.axes.transpose() * self.angular;
        self.turned = self.axes * turn_of(angular, self.inertia);
    }
}

/// See `rigidity`: 2 (s I u + u × I u) = I ω h for the quaternion (u, s).
fn turn_of(angular: Vec3, inertia: Vec3) -> Mat3 {
    let half = angular * 0.5;
    let is_too_fast = half.length_squared() > rigidity::FASTEST * rigidity::FASTEST;
    let inertia = if is_too_fast { Vec3::ONE } else { inertia };
    let real_part = |u: Vec3| (1.0 - u.length_squared()).max(0.1).sqrt();
    let mut u = half;
    for _ in 0..3 {
        u = (half - u.cross(u * inertia) / inertia) / real_part(u);
    }
    Mat3::from_quat(glam::Quat::from_xyzw(u.x, u.y, u.z, real_part(u)).normalize())
}

/// Rows of a joint's Jacobian on one of its bodies: linear and angular.
pub(super) fn part(linear: Vec3, angular: Vec3) -> Part {
    let ([a, b, c], [d, e, f]) = (linear.to_array(), angular.to_array());
    [a, b, c, d, e, f].map(f64::from)
}
