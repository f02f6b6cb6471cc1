//! Pulling a body at a point of it, from outside.

use glam::{Mat3, Vec3};

use super::RigidSolver;
use super::block::{column, columns};
use super::lineup::NOBODY;
use crate::simd::LANES;

/// Where a point of a body is and how it moves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointMotion {
    /// In m.
    pub(crate) position: Vec3,
    /// Motion in a substep, in m.
    pub(crate) displacement: Vec3,
}

impl RigidSolver {
    /// Changes the motion of a point of an awake dynamic body, between two substeps: `point` is in the body's
    /// principal frame (m), `change` tells by how much (m in a substep), `limit` is the greatest change (m) that the
    /// impulse may give the centre of mass.
    ///
    /// An impulse m j at the arm r changes the motion of the point by K j, K j = j + m I⁻¹(r × j) × r: it is found
    /// from there, so that the point moves alike whatever the mass.
    pub(crate) fn pull(
        &mut self,
        body: usize,
        point: Vec3,
        limit: f32,
        change: impl FnOnce(PointMotion) -> Vec3,
    ) {
        let place = self.lineup.place_of.get(body).map_or(NOBODY, |&place| place) as usize;
        if place >= self.lineup.solved {
            return;
        }
        let (block, lane) = (&self.crew.blocks[place / LANES], place % LANES);
        let (arm, start) = (columns(&block.axes, lane) * point, columns(&block.start_axes, lane));
        let center = column(&block.center, lane) + column(&block.shift, lane);
        let constants = &block.constants;
        let (inertia, root) = (column(&constants.inertia, lane), column(&constants.root_inertia, lane));
        let row = &self.crew.velocities[place].0;
        // The row's rotation is √I ω in the frame of the step's start, see `block`.
        let turn = start * (Vec3::new(row[4], row[5], row[6]) / root);
        let displacement = Vec3::new(row[0], row[1], row[2]) + turn.cross(arm);
        let wanted = change(PointMotion { position: center + arm, displacement });

        let turned_by = |j: Vec3| start.transpose() * arm.cross(j) / inertia;
        let response = |j: Vec3| j + (start * turned_by(j)).cross(arm);
        let k = Mat3::from_cols(response(Vec3::X), response(Vec3::Y), response(Vec3::Z));
        let linear = (k.inverse() * wanted).clamp_length_max(limit);
        let angular = turned_by(linear) * root;
        let added = [linear.x, linear.y, linear.z, 0.0, angular.x, angular.y, angular.z, 0.0];
        self.flights.end(body);
        self.crew.push(place, added);
    }
}
