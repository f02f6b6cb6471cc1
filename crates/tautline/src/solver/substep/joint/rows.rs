//! What a joint is to the solver: by row, how motions change its coordinates.

use glam::Vec3;

use crate::joint::{Kind, MOST_ROWS, Placed};
use crate::norm::Norm;

/// How a coordinate changes: n·(v_body − v_base) + b·ω_body − a·ω_base.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct JointRow {
    /// n; 0 for a row that turns.
    pub(super) linear: Vec3,
    /// a.
    pub(super) on_base: Vec3,
    /// b.
    pub(super) on_body: Vec3,
}

impl JointRow {
    /// Along `normal`, at the body's anchor on both: equal and opposite forces at one point turn the whole by nothing.
    fn along(normal: Vec3, base: &Placed, body: &Placed) -> Self {
        let on_body = body.arm.cross(normal);
        let on_base = (base.arm + base.to(body)).cross(normal);
        Self { linear: normal, on_base, on_body }
    }

    fn about(axis: Vec3) -> Self {
        Self { linear: Vec3::ZERO, on_base: axis, on_body: axis }
    }

    pub(super) fn is_angular(&self) -> bool {
        self.linear == Vec3::ZERO
    }
}

/// The rows of a joint, in the order of its coordinates. A row whose direction is not defined is zero.
pub(super) fn rows(kind: &Kind, base: &Placed, body: &Placed) -> [JointRow; MOST_ROWS] {
    let none = JointRow::default();
    let axes = [base.basis.x_axis, base.basis.y_axis, base.basis.z_axis];
    let [x, y, z] = axes.map(|axis| JointRow::along(axis, base, body));
    let [turn_x, turn_y, turn_z] = axes.map(JointRow::about);
    match kind {
        Kind::Ball { .. } => {
            let own = body.basis.x_axis;
            let swing = axes[0].cross(own).try_unit().map_or(none, JointRow::about);
            // The rate of the twist is ω·(a + b) / (1 + a·b).
            let (sum, scale) = (axes[0] + own, 1.0 + axes[0].dot(own));
            let twist = if scale > FACING_AWAY { JointRow::about(sum / scale) } else { none };
            [x, y, z, swing, twist, none]
        }
        Kind::Hinge(_) => [x, y, z, turn_y, turn_z, turn_x],
        Kind::Fixed => [x, y, z, turn_x, turn_y, turn_z],
        Kind::Slider(_) => [y, z, turn_x, turn_y, turn_z, x],
        Kind::Distance { .. } => {
            let along = |normal| JointRow::along(normal, base, body);
            [base.to(body).try_unit().map_or(none, along), none, none, none, none, none]
        }
    }
}

/// 1 + the cosine of two axes that face away from each other: a twist is no more to be told.
const FACING_AWAY: f32 = 1e-3;
