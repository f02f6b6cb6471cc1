//! Where the two sides of a joint are to each other.

use glam::{Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};

use super::{Kind, MOST_ROWS};
use crate::norm::Norm;

/// An anchor and axes on a body, in its principal frame; on the world, in the world's. The first axis is the joint's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct LocalFrame {
    /// In m.
    pub(crate) anchor: Vec3,
    pub(crate) basis: Mat3,
}

impl LocalFrame {
    pub(crate) fn is_finite(&self) -> bool {
        self.anchor.is_finite() && self.basis.is_finite()
    }

    /// On a body with its centre of mass and its axes here.
    pub(crate) fn on_body(&self, center: Vec3, axes: Mat3) -> Placed {
        Placed { origin: center, shift: Vec3::ZERO, arm: axes * self.anchor, basis: axes * self.basis }
    }

    pub(crate) fn in_world(&self) -> Placed {
        Placed { origin: self.anchor, shift: Vec3::ZERO, arm: Vec3::ZERO, basis: self.basis }
    }
}

/// One side of a joint in the world. Its anchor is at origin + shift + arm; they are kept apart since sums of large
/// and small numbers lose the small ones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    /// In m.
    pub(crate) origin: Vec3,
    /// How far the origin has moved, in m.
    pub(crate) shift: Vec3,
    /// From the origin to the anchor, in m.
    pub(crate) arm: Vec3,
    pub(crate) basis: Mat3,
}

impl Placed {
    pub(crate) fn anchor(&self) -> Vec3 {
        self.origin + (self.shift + self.arm)
    }

    /// From this anchor to another one.
    pub(crate) fn to(&self, other: &Self) -> Vec3 {
        (other.origin - self.origin) + ((other.shift - self.shift) + (other.arm - self.arm))
    }
}

/// By row, in m or rad: of locked rows what is wrong, of the others the value that has bounds.
pub(crate) type Coordinates = [f32; MOST_ROWS];

/// The coordinates of a joint between `base` and `body`. The angle of a hinge is the one nearest to `near`.
pub(crate) fn measure(kind: &Kind, base: &Placed, body: &Placed, near: f32) -> Coordinates {
    let between = base.to(body);
    let d = base.basis.transpose() * between;
    let turn = base.basis.transpose() * body.basis;
    match kind {
        Kind::Ball { .. } => {
            let axis = turn.x_axis;
            let swing = libm::atan2f((axis.y * axis.y + axis.z * axis.z).sqrt(), axis.x);
            [d.x, d.y, d.z, swing, twist(turn), 0.0]
        }
        // The error of the axes is their cross product: the sine of the angle between them.
        Kind::Hinge(_) => {
            let angle = libm::atan2f(turn.y_axis.z, turn.y_axis.y);
            [d.x, d.y, d.z, -turn.x_axis.z, turn.x_axis.y, unwrapped(angle, near)]
        }
        Kind::Fixed => {
            let error = sine(turn);
            [d.x, d.y, d.z, error.x, error.y, error.z]
        }
        Kind::Slider(_) => {
            let error = sine(turn);
            [d.y, d.z, error.x, error.y, error.z, d.x]
        }
        Kind::Distance { .. } => [between.norm(), 0.0, 0.0, 0.0, 0.0, 0.0],
    }
}

/// The axis of a rotation times the sine of its angle.
fn sine(turn: Mat3) -> Vec3 {
    let [x, y, z] = [turn.x_axis, turn.y_axis, turn.z_axis];
    Vec3::new(y.z - z.y, z.x - x.z, x.y - y.x) * 0.5
}

/// By how much a rotation turns about the first axis, besides leaning it over: the decomposition into swing and twist.
fn twist(turn: Mat3) -> f32 {
    let q = Quat::from_mat3(&turn);
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    2.0 * libm::atan2f(q.x * sign, q.w * sign)
}

/// An angle plus the number of turns that brings it nearest to another one.
fn unwrapped(angle: f32, near: f32) -> f32 {
    use std::f32::consts::TAU;
    angle + TAU * libm::roundf((near - angle) / TAU)
}
