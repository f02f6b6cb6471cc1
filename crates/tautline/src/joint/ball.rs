//! Joints like a shoulder.

use glam::Vec3;

use super::build::{Link, common, common_angular};
use crate::world::BodyHandle;

/// A point of a body stays at a point of its base; all rotations are free, or within a cone and a twist.
///
/// ```
/// use std::sync::Arc;
/// use tautline::{BallJoint, RigidBody, Settings, Shape, Vec3, World};
///
/// let mut world = World::new(Settings::default())?;
/// let ball = Arc::new(Shape::sphere(0.1)?);
/// let ball = world.add(RigidBody::new(&ball).position(Vec3::X))?;
/// let joint = world.add_joint(BallJoint::new(ball, None).anchor(Vec3::ZERO))?;
/// for _ in 0..60 {
///     world.step(1.0 / 60.0)?;
/// }
/// let [on_ball, on_world] = world.joint(joint)?.anchors();
/// assert!(on_ball.distance(on_world) < 1e-5, "it swings about the origin");
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BallJoint {
    pub(crate) link: Link,
    pub(crate) axis: Vec3,
    pub(crate) cone: Option<f32>,
    pub(crate) twist: Option<[f32; 2]>,
}

common!(BallJoint);
common_angular!(BallJoint);

impl BallJoint {
    /// `body` is held by `base`, or by the world if that is `None`.
    pub fn new(body: BodyHandle, base: impl Into<Option<BodyHandle>>) -> Self {
        Self { link: Link::new(body, base.into()), axis: Vec3::Y, cone: None, twist: None }
    }

    /// The axis of cone and twist, in the world, as the bodies stand when the joint is added. Of any length but 0; Y
    /// if not told.
    pub fn axis(self, axis: Vec3) -> Self {
        Self { axis, ..self }
    }

    /// The body's axis leans away from its base's by no more than this, in rad, 0 to π.
    pub fn cone(self, angle: f32) -> Self {
        Self { cone: Some(angle), ..self }
    }

    /// The body turns about the axis from `low` to `high`, in rad, −π to π.
    pub fn twist(self, low: f32, high: f32) -> Self {
        Self { twist: Some([low, high]), ..self }
    }
}
