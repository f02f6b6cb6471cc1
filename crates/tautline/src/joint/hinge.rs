//! Joints like that of a door.

use glam::Vec3;

use super::build::{Link, common, common_angular};
use super::kind::{Drive, Motor};
use crate::world::BodyHandle;

/// A body turns about an axis of its base, freely, between limits, or driven by a motor.
///
/// ```
/// use std::sync::Arc;
/// use tautline::{HingeJoint, RigidBody, Settings, Shape, Vec3, World};
///
/// let mut world = World::new(Settings::default())?;
/// let door = Arc::new(Shape::cuboid(Vec3::new(0.4, 1.0, 0.02))?);
/// let door = world.add(RigidBody::new(&door).mass(20.0))?;
/// let hinge = HingeJoint::new(door, None).anchor(Vec3::X * -0.4).axis(Vec3::Y);
/// let hinge = world.add_joint(hinge.limits(0.0, 1.5).motor(1.0, 50.0))?;
/// for _ in 0..60 {
///     world.step(1.0 / 60.0)?;
/// }
/// let angle = world.joint(hinge)?.angle().unwrap_or(0.0);
/// assert!((angle - 1.0).abs() < 0.1, "it has been opened at 1 rad/s");
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct HingeJoint {
    pub(crate) link: Link,
    pub(crate) axis: Vec3,
    pub(crate) drive: Drive,
}

common!(HingeJoint);
common_angular!(HingeJoint);

impl HingeJoint {
    /// `body` is held by `base`, or by the world if that is `None`.
    pub fn new(body: BodyHandle, base: impl Into<Option<BodyHandle>>) -> Self {
        Self { link: Link::new(body, base.into()), axis: Vec3::Y, drive: Drive::default() }
    }

    /// The axis that the body turns about, counter-clockwise seen from its tip; in the world, as the bodies stand when
    /// the joint is added. Of any length but 0; Y if not told.
    pub fn axis(self, axis: Vec3) -> Self {
        Self { axis, ..self }
    }

    /// The body turns from `low` to `high`, in rad; more than a turn is fine.
    pub fn limits(mut self, low: f32, high: f32) -> Self {
        self.drive.limits = Some([low, high]);
        self
    }

    /// Turns the body at `speed` (rad/s) with up to `max_torque` (N m); a speed of 0 is a brake.
    pub fn motor(mut self, speed: f32, max_torque: f32) -> Self {
        self.drive.motor = Some(Motor { speed, strength: max_torque });
        self
    }
}
