//! The way of a body in a step, or in the substep that has just been made.

use glam::{DMat3, DQuat, DVec3, Mat3, Vec3};

use super::block::{Block, Rows3, column, columns};
use super::crew::set_lane;
use crate::geometry::query::{Motion, Rounded};
use crate::simd::Row;

/// Straight, and turning steadily.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    pub(super) center: DVec3,
    pub(super) rotation: DQuat,
    pub(super) shift: DVec3,
    /// Axis times angle.
    pub(super) turn: DVec3,
    /// Whether it can be cut short.
    pub(super) is_free: bool,
    pub(super) is_cut: bool,
}

impl Way {
    pub(super) fn of(block: &Block, lane: usize) -> Self {
        let rotation = |axes: &[Rows3; 3]| DQuat::from_mat3(&columns(axes, lane).as_dmat3()).normalize();
        let (start, end) = (rotation(&block.start_axes), rotation(&block.axes));
        let turn = end * start.inverse();
        // The shorter way round.
        let turn = if turn.w < 0.0 { -turn } else { turn };
        Self {
            center: column(&block.center, lane).as_dvec3(),
            rotation: start,
            shift: column(&block.shift, lane).as_dvec3(),
            turn: turn.to_scaled_axis(),
            is_free: block.constants.inverse_mass.0[lane] > 0.0,
            is_cut: false,
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.center.is_finite()
            && self.rotation.is_finite()
            && self.shift.is_finite()
            && self.turn.is_finite()
    }

    pub(super) fn motion<'a>(&self, shape: Rounded<'a>) -> Motion<'a> {
        Motion {
            shape,
            position: self.center,
            rotation: self.rotation,
            linear: self.shift,
            angular: self.turn,
        }
    }

    pub(super) fn without_turn(self) -> Self {
        if self.is_free { Self { turn: DVec3::ZERO, ..self } } else { self }
    }

    /// How another body that ends its way at `time` is carried along by this one from then on: not at all if this
    /// one ends there too.
    pub(super) fn carries(&self, other: &Self, time: f64) -> DVec3 {
        if self.is_free {
            return DVec3::ZERO;
        }
        let arm = (other.center + other.shift * time) - (self.center + self.shift * time);
        self.shift * (1.0 - time) + DQuat::from_scaled_axis(self.turn * (1.0 - time)) * arm - arm
    }

    /// Ended at `time`, and moved on by `carried`.
    pub(super) fn cut(self, time: f64, carried: DVec3) -> Self {
        if !self.is_free {
            return self;
        }
        Self { shift: self.shift * time + carried, turn: self.turn * time, is_cut: true, ..self }
    }

    /// Puts a body, with its row of velocities, at its end. Its rotation is the same in its own frame: that of a rod
    /// about its axis would else be one across it, with thousands of times the energy.
    pub(super) fn write(&self, block: &mut Block, lane: usize, row: &mut Row) {
        let (start, before) = (columns(&block.start_axes, lane), columns(&block.axes, lane));
        let axes = DMat3::from_quat(DQuat::from_scaled_axis(self.turn) * self.rotation).as_mat3();
        set_lane(&mut block.shift, lane, self.shift.as_vec3());
        for (rows, axis) in block.axes.iter_mut().zip([axes.x_axis, axes.y_axis, axes.z_axis]) {
            set_lane(rows, lane, axis);
        }
        let root = column(&block.constants.root_inertia, lane);
        let turned_back = |v: Vec3, [from, to]: [&Mat3; 2]| *to * (from.transpose() * v);
        let angular = start * (Vec3::new(row.0[4], row.0[5], row.0[6]) / root);
        let angular = start.transpose() * turned_back(angular, [&before, &axes]) * root;
        row.0[4..7].copy_from_slice(&angular.to_array());
    }
}
