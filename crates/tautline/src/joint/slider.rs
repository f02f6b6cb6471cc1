//! Joints like that of a piston.

use glam::Vec3;

use super::build::{Link, common, common_angular};
use super::kind::{Drive, Motor};
use crate::world::BodyHandle;

/// A body moves along an axis of its base without turning: freely, between limits, or driven by a motor.
#[derive(Debug, Clone, PartialEq)]
pub struct SliderJoint {
    pub(crate) link: Link,
    pub(crate) axis: Vec3,
    pub(crate) drive: Drive,
}

common!(SliderJoint);
common_angular!(SliderJoint);

impl SliderJoint {
    /// `body` is held by `base`, or by the world if that is `None`.
    pub fn new(body: BodyHandle, base: impl Into<Option<BodyHandle>>) -> Self {
        Self { link: Link::new(body, base.into()), axis: Vec3::Y, drive: Drive::default() }
    }

    /// The axis that the body moves along, in the world, as the bodies stand when the joint is added; it turns with
    /// the base. Of any length but 0; Y if not told.
    pub fn axis(self, axis: Vec3) -> Self {
        Self { axis, ..self }
    }

    /// The body's anchor is from `low` to `high` before its base's, in m.
    pub fn limits(mut self, low: f32, high: f32) -> Self {
        self.drive.limits = Some([low, high]);
        self
    }

    /// Moves the body at `speed` (m/s) with up to `max_force` (N); a speed of 0 is a brake.
    pub fn motor(mut self, speed: f32, max_force: f32) -> Self {
        self.drive.motor = Some(Motor { speed, strength: max_force });
        self
    }
}
