//! What happens in a scene at a time of its own.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::value::BodyRef;

/// At a time, a rigid body that is not fixed gets other velocities: how a kinematic one is led, and what is attached to it.
///
/// It is only for the solver `default`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cue {
    /// When, in s of the scene's time; at the start of the step that begins nearest.
    pub at: f32,
    /// The body.
    pub body: BodyRef,
    /// Its velocity from then on, in m/s.
    #[serde(default)]
    pub velocity: [f32; 3],
    /// Its angular velocity from then on, about its centre of mass, in rad/s.
    #[serde(default)]
    pub angular_velocity: [f32; 3],
}
