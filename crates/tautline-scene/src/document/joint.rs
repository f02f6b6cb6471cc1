//! Joints of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::value::BodyRef;

/// What holds a rigid body to another one, or to the world. Points and directions are those of the world as the
/// bodies stand at the start.
///
/// Bodies of sticks have no joints: those are only for the solver `default`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// The body that is held.
    pub body: BodyRef,
    /// The body that holds it; the world if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<BodyRef>,
    /// What it leaves free.
    #[serde(default)]
    pub kind: JointKind,
    /// Where it is on the body, in m; at the centre of mass if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor: Option<[f32; 3]>,
    /// Where it is on the base, in m; where it is on the body if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_anchor: Option<[f32; 3]>,
    /// By how much it gives way to a force, in m/N; 0 is as little as a substep allows.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub compliance: f32,
    /// By how much it gives way to a torque, in rad/(N m). A distance joint has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_compliance: Option<f32>,
    /// Breaks once the mean force in a step is greater than this, in N; never if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub break_force: Option<f32>,
    /// Breaks once the mean torque in a step is greater than this, in N m; never if absent. A distance joint has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub break_torque: Option<f32>,
    /// Whether the body and its base collide with each other.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub collide_connected: bool,
}

/// What a joint leaves free. Angles and ways are the body's as its base sees it, and 0 at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum JointKind {
    /// All rotations, or those within a cone and a twist.
    Ball {
        /// The axis of cone and twist, of any length above 0.
        #[serde(default = "up")]
        axis: [f32; 3],
        /// How far the body's axis leans from its base's at most, in degrees, 0 to 180.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        cone_degrees: Option<f32>,
        /// The least and the greatest turn about the axis, in degrees, -180 to 180.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        twist_degrees: Option<[f32; 2]>,
    },
    /// A turn about an axis.
    Hinge {
        /// The axis, of any length above 0; the body turns counter-clockwise seen from its tip.
        #[serde(default = "up")]
        axis: [f32; 3],
        /// The least and the greatest angle, in degrees; more than a turn is fine.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        limits_degrees: Option<[f32; 2]>,
        /// What turns it: `speed` in rad/s, `strength` in N m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        motor: Option<Motor>,
    },
    /// Nothing.
    Fixed {},
    /// A shift along an axis.
    Slider {
        /// The axis, of any length above 0; it turns with the base.
        #[serde(default = "up")]
        axis: [f32; 3],
        /// The least and the greatest shift, in m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        limits: Option<[f32; 2]>,
        /// What shifts it: `speed` in m/s, `strength` in N.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        motor: Option<Motor>,
    },
    /// Everything but the distance of the two points: it is kept if neither `range` nor `spring` is given.
    Distance {
        /// The length that is kept or sprung to, in m; that at the start if absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length: Option<f32>,
        /// The shortest and the greatest length, in m: `[0, 2]` is a rope of 2 m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        range: Option<[f32; 2]>,
        /// A spring about `length`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spring: Option<Spring>,
    },
}

/// What drives a joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motor {
    /// The speed it wants; 0 is a brake.
    pub speed: f32,
    /// The most it gives for that.
    pub strength: f32,
}

/// A damped spring, by what it makes of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    /// The frequency they would swing at without damping, in Hz.
    pub frequency: f32,
    /// Damping over that which just lets nothing swing.
    #[serde(default)]
    pub damping_ratio: f32,
}

impl Default for JointKind {
    /// A ball joint without limits.
    fn default() -> Self {
        Self::Ball { axis: up(), cone_degrees: None, twist_degrees: None }
    }
}

impl Joint {
    /// A joint that holds firmly and for ever, at the body's centre of mass.
    pub fn new(body: BodyRef, base: Option<BodyRef>, kind: JointKind) -> Self {
        Self {
            body,
            base,
            kind,
            anchor: None,
            base_anchor: None,
            compliance: 0.0,
            angular_compliance: None,
            break_force: None,
            break_torque: None,
            collide_connected: false,
        }
    }
}

impl JointKind {
    /// The word that stands for it in a document, and in the path of its fields.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Ball { .. } => "ball",
            Self::Hinge { .. } => "hinge",
            Self::Fixed {} => "fixed",
            Self::Slider { .. } => "slider",
            Self::Distance { .. } => "distance",
        }
    }
}

fn up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

fn is_zero(number: &f32) -> bool {
    *number == 0.0
}
