//! Looking at a joint.

use glam::Vec3;

use super::{Joint, JointHandle, Kind, Placed, measure};
use crate::body::Frame;
use crate::error::Error;
use crate::world::{BodyHandle, World};

/// What a joint is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Two points stay together.
    Ball,
    /// Two points and an axis stay together.
    Hinge,
    /// Nothing moves.
    Fixed,
    /// Only a shift along an axis is free.
    Slider,
    /// Two points keep a distance.
    Distance,
}

impl World {
    /// A joint, to be looked at.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn joint(&self, handle: JointHandle) -> Result<JointView<'_>, Error> {
        let index = self.joints.slots.index(handle)?;
        Ok(JointView { joint: &self.joints.items[index], world: self })
    }
}

/// A joint as it is now.
#[derive(Debug, Clone, Copy)]
pub struct JointView<'a> {
    joint: &'a Joint,
    world: &'a World,
}

impl JointView<'_> {
    /// What it is.
    pub fn kind(&self) -> JointKind {
        match self.joint.kind {
            Kind::Ball { .. } => JointKind::Ball,
            Kind::Hinge(_) => JointKind::Hinge,
            Kind::Fixed => JointKind::Fixed,
            Kind::Slider(_) => JointKind::Slider,
            Kind::Distance { .. } => JointKind::Distance,
        }
    }

    /// The body that is held.
    pub fn body(&self) -> BodyHandle {
        self.world.slots.handle(self.joint.body as usize)
    }

    /// The body that holds it; `None` for the world, and for half-spaces.
    pub fn base(&self) -> Option<BodyHandle> {
        self.joint.base.map(|base| self.world.slots.handle(base as usize))
    }

    /// Where it is, in the world, in m: on the body and on the base.
    pub fn anchors(&self) -> [Vec3; 2] {
        let [base, body] = self.placed();
        [body.anchor(), base.anchor()]
    }

    /// The axis of a hinge, slider or ball joint on the body and on the base, unit vectors in the world.
    pub fn axes(&self) -> [Vec3; 2] {
        let [base, body] = self.placed();
        [body.basis.x_axis, base.basis.x_axis]
    }

    /// By how much a hinge has turned, in rad; it goes on counting beyond half a turn.
    pub fn angle(&self) -> Option<f32> {
        matches!(self.joint.kind, Kind::Hinge(_)).then(|| self.coordinate(5))
    }

    /// How far a slider has moved along its axis, or the length of a distance joint, in m.
    pub fn translation(&self) -> Option<f32> {
        match self.joint.kind {
            Kind::Slider(_) => Some(self.coordinate(5)),
            Kind::Distance { .. } => Some(self.coordinate(0)),
            Kind::Ball { .. } | Kind::Hinge(_) | Kind::Fixed => None,
        }
    }

    /// How far the axis of a ball joint leans, and how far the body is turned about it, in rad.
    pub fn swing_and_twist(&self) -> Option<[f32; 2]> {
        matches!(self.joint.kind, Kind::Ball { .. }).then(|| [self.coordinate(3), self.coordinate(4)])
    }

    /// The mean force on the body in the last step, in N; the base felt the opposite.
    pub fn force(&self) -> Vec3 {
        self.joint.state.force
    }

    /// The mean torque on the body in the last step, besides that of the force at the anchor, in N m.
    pub fn torque(&self) -> Vec3 {
        self.joint.state.torque
    }

    /// Whether it has broken: it holds nothing any more.
    pub fn is_broken(&self) -> bool {
        self.joint.state.is_broken
    }

    fn coordinate(&self, row: usize) -> f32 {
        let [base, body] = self.placed();
        measure(&self.joint.kind, &base, &body, self.joint.state.angle)[row]
    }

    /// Base and body.
    fn placed(&self) -> [Placed; 2] {
        let Joint { on_body, on_base, .. } = self.joint;
        let frame = |body: u32| {
            let range = self.world.bodies[body as usize].particles.clone();
            Frame::of_particles(&self.world.particles.position[range])
        };
        let base = self
            .joint
            .base
            .map(frame)
            .map_or_else(|| on_base.in_world(), |frame| on_base.on_body(frame.center, frame.axes));
        let frame = frame(self.joint.body);
        [base, on_body.on_body(frame.center, frame.axes)]
    }
}
