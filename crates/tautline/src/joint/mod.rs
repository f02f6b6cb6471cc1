//! Joints: what holds a rigid body to another one or to the world.
//!
//! A builder ([`BallJoint`], [`HingeJoint`], [`FixedJoint`], [`SliderJoint`], [`DistanceJoint`]) names the body that
//! is held and the base that holds it, `None` for the world. Points and axes are given in the world as the bodies
//! stand when the joint is added, or in the frames of their shapes. Angles and ways are those of the body as seen
//! from its base, and 0 where it stands when the joint is added.
//!
//! Joints are solved exactly, whole machines at once: a chain does not stretch, whatever hangs from it, and a
//! pendulum keeps its energy. A compliance makes one soft.

mod ball;
mod build;
mod distance;
mod fixed;
mod hinge;
mod kind;
mod measure;
mod slider;
mod store;
mod view;

use glam::Vec3;
use serde::{Deserialize, Serialize};

pub use ball::BallJoint;
pub use build::JointDescription;
pub use distance::DistanceJoint;
pub use fixed::FixedJoint;
pub use hinge::HingeJoint;
pub use kind::Motor;
pub use slider::SliderJoint;
pub use store::{JointEvent, JointHandle};
pub use view::{JointKind, JointView};

pub(crate) use kind::{Kind, Push, Spring, Stop};
pub(crate) use measure::{Coordinates, LocalFrame, Placed, measure};
pub(crate) use store::Joints;

/// The most rows that a joint has.
pub(crate) const MOST_ROWS: usize = 6;
/// The most of them that have bounds or are driven.
pub(crate) const MOST_STOPS: usize = 2;

/// A joint in a world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Joint {
    pub(crate) kind: Kind,
    /// Indices of the bodies in the world; no base = the world.
    pub(crate) body: u32,
    pub(crate) base: Option<u32>,
    pub(crate) on_body: LocalFrame,
    pub(crate) on_base: LocalFrame,
    pub(crate) strength: Strength,
    pub(crate) state: State,
}

/// How firmly a joint holds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Strength {
    /// In m/N; 0 = as rigid as a substep allows.
    pub(crate) compliance: f32,
    /// In rad/(N m).
    pub(crate) angular_compliance: f32,
    /// In N; `None` = it never breaks.
    pub(crate) break_force: Option<f32>,
    /// In N m.
    pub(crate) break_torque: Option<f32>,
    /// Whether the two bodies collide with each other.
    pub(crate) collide_connected: bool,
}

/// What is known of a joint from the last substep.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    /// By row, in kg m or kg m²: the impulse times a substep.
    pub(crate) multipliers: [f32; MOST_ROWS],
    pub(crate) modes: [Mode; MOST_STOPS],
    /// The angle of a hinge, which goes on counting beyond half a turn, in rad.
    pub(crate) angle: f32,
    /// How fast the length of a spring grew, in m/s.
    pub(crate) rate: f32,
    /// What the base did to the body in the last step: mean force (N) and torque (N m) about the anchor.
    pub(crate) force: Vec3,
    pub(crate) torque: Vec3,
    pub(crate) is_broken: bool,
}

impl State {
    fn is_finite(&self) -> bool {
        let Self { multipliers, angle, rate, force, torque, .. } = self;
        let numbers = multipliers.iter().chain([angle, rate]);
        numbers.copied().all(f32::is_finite) && force.is_finite() && torque.is_finite()
    }
}

/// What a row with bounds does.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Mode {
    /// Nothing, or what drives it is as strong as it needs to be.
    #[default]
    Within,
    /// Its motor is as strong as it can be, forwards or …
    Forwards,
    /// … backwards, and not strong enough.
    Backwards,
    AtLow,
    AtHigh,
}

impl Joint {
    pub(crate) fn is_sound(&self, body_count: usize) -> bool {
        let count = body_count as u32;
        self.body < count
            && self.base.is_none_or(|base| base < count && base != self.body)
            && self.on_body.is_finite()
            && self.on_base.is_finite()
            && self.state.is_finite()
            && self.strength.validate().is_ok()
            && self.kind.validate().is_ok()
    }
}
