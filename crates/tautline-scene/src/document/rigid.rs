//! Rigid bodies of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::shape::Shape;
use super::value::{Color, Rotation};

/// A solid that keeps its shape.
///
/// Under the solver `paper` it is a truss of sticks; under `default` it is rigid exactly, but for as long as such bodies
/// meet neither cloth nor rope it is a truss too in a scene that has any. What a truss does not know is refused then:
/// each such field says so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rigid {
    /// A name of its own, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its shape, in its own frame.
    pub shape: Shape,
    /// Where its frame is, in m.
    pub position: [f32; 3],
    /// How its frame is turned.
    pub rotation: Rotation,
    /// Velocity, in m/s.
    pub velocity: [f32; 3],
    /// Angular velocity about the centre of mass, in rad/s.
    pub angular_velocity: [f32; 3],
    /// Mass, in kg. Either this or `density`; without both the density is 1000 kg/m³.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f32>,
    /// Density, in kg/m³.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f32>,
    /// Coefficient of friction, 0 being none.
    pub friction: f32,
    /// Speed apart over speed together of a collision, 0 to 1; of two bodies the larger counts. Not for a truss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f32>,
    /// How far, in m, the normal force acts in front of the point of contact when it rolls, 0 being none; of two
    /// bodies the geometric mean counts, so that both need one. Not for a truss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f32>,
    /// How many times the scene's gravity acts on it. Not for a truss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_scale: Option<f32>,
    /// Rates at which its own motion dies out. Not for a truss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// Which bodies it collides with; all if absent. Not for a truss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub groups: Option<Groups>,
    /// Whether it never moves: the same as `motion` being `fixed`.
    pub fixed: bool,
    /// What moves it; forces and contacts if absent. A truss is not `kinematic`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// Colour; chosen by its place in the scene if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

/// What moves a rigid body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// Forces and contacts.
    Dynamic,
    /// Its velocity alone: it pushes others and nothing pushes it.
    Kinematic,
    /// Nothing.
    Fixed,
}

/// Rates at which a body's motion dies out, in 1/s, 0 being none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Damping {
    /// Of its velocity.
    pub linear: f32,
    /// Of its angular velocity.
    pub angular: f32,
}

/// Which bodies collide: two do if each is a member of a group that the other collides with. Groups are numbers from
/// 0 to 31.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Groups {
    /// The groups it belongs to; all if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memberships: Option<Vec<u32>>,
    /// The groups it collides with; all if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub filter: Option<Vec<u32>>,
}

impl Default for Rigid {
    /// A cube of 1 m.
    fn default() -> Self {
        Self {
            name: None,
            shape: Shape::default(),
            position: [0.0; 3],
            rotation: Rotation::default(),
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            mass: None,
            density: None,
            friction: 0.5,
            restitution: None,
            rolling_friction: None,
            gravity_scale: None,
            damping: None,
            groups: None,
            fixed: false,
            motion: None,
            color: None,
        }
    }
}

impl Rigid {
    /// What moves it.
    pub fn motion(&self) -> Motion {
        self.motion.unwrap_or(if self.fixed { Motion::Fixed } else { Motion::Dynamic })
    }
}
