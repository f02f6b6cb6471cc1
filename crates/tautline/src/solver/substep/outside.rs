//! How what is not rigid sees rigid bodies between two substeps, and moves them.

use glam::{Mat3, Vec3};

use super::RigidSolver;
use super::block::{column, columns};
use super::lineup::NOBODY;
use crate::simd::LANES;

/// A rigid body at the end of a substep.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen {
    /// Centre of mass, in m.
    pub(crate) center: Vec3,
    /// From the principal frame to the world.
    pub(crate) axes: Mat3,
    /// Motion of the centre of mass in a substep, in m.
    pub(crate) linear: Vec3,
    /// Rotation in a substep, in the world's frame, in rad.
    pub(crate) angular: Vec3,
    /// 1/m, in 1/kg; 0 = nothing moves it.
    pub(crate) inverse_mass: f32,
    /// Principal moments of inertia per mass, in m².
    pub(crate) inertia_per_mass: Vec3,
}

/// What a body's motion and place change by.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Change {
    /// Of the motion in a substep, in m and in rad.
    pub(crate) linear: Vec3,
    pub(crate) angular: Vec3,
    /// Of the centre of mass, in m.
    pub(crate) shift: Vec3,
    /// Of the axes, a small rotation in rad.
    pub(crate) turn: Vec3,
}

impl RigidSolver {
    /// A rigid body as it is now; `None` for any other.
    pub(crate) fn see(&self, body: usize) -> Option<Seen> {
        let place = *self.lineup.place_of.get(body).filter(|&&place| place != NOBODY)? as usize;
        let (block, lane) = (self.crew.blocks.get(place / LANES)?, place % LANES);
        let constants = &block.constants;
        let row = &self.crew.velocities[place].0;
        // The row's rotation is √I ω in the frame of the step's start, see `block`.
        let turn = Vec3::new(row[4], row[5], row[6]) / column(&constants.root_inertia, lane);
        Some(Seen {
            center: column(&block.center, lane) + column(&block.shift, lane),
            axes: columns(&block.axes, lane),
            linear: Vec3::new(row[0], row[1], row[2]),
            angular: columns(&block.start_axes, lane) * turn,
            inverse_mass: if place < self.lineup.solved { constants.inverse_mass.0[lane] } else { 0.0 },
            inertia_per_mass: column(&constants.inertia, lane),
        })
    }

    /// Changes how an awake dynamic body moves, and where it is. Nothing happens to any other.
    pub(crate) fn nudge(&mut self, body: usize, change: &Change) {
        let place = self.lineup.place_of.get(body).map_or(NOBODY, |&place| place) as usize;
        if place >= self.lineup.solved {
            return;
        }
        let (block, lane) = (&mut self.crew.blocks[place / LANES], place % LANES);
        let root = column(&block.constants.root_inertia, lane);
        let (start, axes) = (columns(&block.start_axes, lane), columns(&block.axes, lane));
        let turned = rotation(change.turn) * axes;
        let row = &self.crew.velocities[place].0;
        let angular = start * (Vec3::new(row[4], row[5], row[6]) / root) + change.angular;
        let settled = turned_along(angular, [axes, turned], column(&block.constants.inertia, lane));
        let turn = start.transpose() * (change.angular + settled) * root;
        let linear = change.linear;
        let added = [linear.x, linear.y, linear.z, 0.0, turn.x, turn.y, turn.z, 0.0];
        for (row, by) in block.shift.iter_mut().zip(change.shift.to_array()) {
            row.0[lane] += by;
        }
        for (rows, axis) in block.axes.iter_mut().zip([turned.x_axis, turned.y_axis, turned.z_axis]) {
            rows.iter_mut().zip(axis.to_array()).for_each(|(row, number)| row.0[lane] = number);
        }
        self.flights.end(body);
        self.crew.push(place, added);
    }
}

/// What changes of a body's rotation ω when its axes are turned and its angular momentum stays what it was. Of the inertia only
/// what differs between the axes counts, so that nothing changes for what has none.
fn turned_along(angular: Vec3, [before, after]: [Mat3; 2], inertia: Vec3) -> Vec3 {
    let differing = inertia - inertia.min_element();
    let momentum = |axes: Mat3| axes * (differing * (axes.transpose() * angular));
    after * ((after.transpose() * (momentum(before) - momentum(after))) / inertia)
}

/// The rotation by a small vector (rad), without sines: Cayley's (1 + [t/2])/(1 − [t/2]), the rotation by
/// 2 atan(|t|/2).
pub(crate) fn rotation(turn: Vec3) -> Mat3 {
    let half = turn * 0.5;
    let scale = 2.0 / (1.0 + half.length_squared());
    let rotated = |v: Vec3| {
        let across = half.cross(v);
        v + (across + half.cross(across)) * scale
    };
    Mat3::from_cols(rotated(Vec3::X), rotated(Vec3::Y), rotated(Vec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_is_orthonormal_and_by_the_angle_of_cayley() {
        let turn = Vec3::new(0.3, -0.2, 0.5);
        let matrix = rotation(turn);
        let expected = Mat3::from_axis_angle(turn.normalize(), 2.0 * libm::atanf(0.5 * turn.length()));
        assert!((matrix - expected).to_cols_array().iter().all(|off| off.abs() < 1e-6));
        assert_eq!(rotation(Vec3::ZERO), Mat3::IDENTITY);
    }
}
