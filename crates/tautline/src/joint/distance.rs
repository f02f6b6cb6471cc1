//! Rods, ropes, struts and springs.

use super::Kind;
use super::build::{Link, common};
use super::kind::Spring;
use crate::world::BodyHandle;

/// A point of a body keeps a distance from a point of its base: exactly (a rod), within a range (a rope or a strut),
/// or as a spring, with or without a range.
///
/// Two points that coincide have no direction between them, and no force acts until they part.
///
/// ```
/// use std::sync::Arc;
/// use tautline::{DistanceJoint, RigidBody, Settings, Shape, Vec3, World};
///
/// let mut world = World::new(Settings::default())?;
/// let ball = Arc::new(Shape::sphere(0.1)?);
/// let ball = world.add(RigidBody::new(&ball))?;
/// let rope = DistanceJoint::new(ball, None).anchors(Vec3::ZERO, Vec3::Y).range(0.0, 1.5);
/// let rope = world.add_joint(rope)?;
/// for _ in 0..60 {
///     world.step(1.0 / 60.0)?;
/// }
/// let length = world.joint(rope)?.translation().unwrap_or(0.0);
/// assert!((length - 1.5).abs() < 1e-5, "it has fallen until the rope was taut");
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceJoint {
    pub(crate) link: Link,
    length: Option<f32>,
    range: Option<[f32; 2]>,
    spring: Option<Spring>,
}

common!(DistanceJoint);

impl DistanceJoint {
    /// `body` is held by `base`, or by the world if that is `None`.
    pub fn new(body: BodyHandle, base: impl Into<Option<BodyHandle>>) -> Self {
        Self { link: Link::new(body, base.into()), length: None, range: None, spring: None }
    }

    /// The length it keeps or is sprung to, in m; without this, what it is when the joint is added.
    pub fn length(self, length: f32) -> Self {
        Self { length: Some(length), ..self }
    }

    /// The shortest and the greatest length, in m.
    pub fn range(self, low: f32, high: f32) -> Self {
        Self { range: Some([low, high]), ..self }
    }

    /// A spring by what it makes of the two bodies: the frequency they would swing at without damping, in Hz, and
    /// the damping over the critical one. Its stiffness is (2π frequency)² m, with m their effective mass.
    pub fn spring(self, frequency: f32, damping_ratio: f32) -> Self {
        Self { spring: Some(Spring { frequency, damping_ratio }), ..self }
    }

    /// The kind, with `found` (m) between its anchors.
    pub(crate) fn kind(&self, found: f32) -> Kind {
        let length = self.length.unwrap_or(found);
        let is_rod = self.range.is_none() && self.spring.is_none();
        let limits = if is_rod { Some([length, length]) } else { self.range };
        Kind::Distance { length, limits, spring: self.spring }
    }
}
