//! The bodies of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cloth::Cloth;
use super::rigid::Rigid;
use super::shape::Thread;
use super::soft::SoftSolid;
use super::value::{Color, Pin, RopeEnd, Weight};

/// One thing in the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Body {
    /// A solid that keeps its shape.
    Rigid(Rigid),
    /// A sheet.
    Cloth(Cloth),
    /// A rope.
    Rope(Rope),
    /// A solid that gives.
    SoftSolid(SoftSolid),
    /// An unmoving plane with everything behind it solid.
    HalfSpace(HalfSpace),
    /// The inside of an unmoving box.
    Room(Room),
}

/// A rope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rope {
    /// A name of its own, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// How it is laid out, in the world's frame.
    pub path: Thread,
    /// Its length at rest, in m; that of its path if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<f32>,
    /// Radius, in m.
    pub radius: f32,
    /// Velocity, in m/s.
    pub velocity: [f32; 3],
    /// Mass of the whole rope, in kg.
    pub mass: f32,
    /// Particles that never move: indices, or `first` and `last`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pins: Vec<Pin<RopeEnd>>,
    /// Particles with a mass of their own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub weights: Vec<Weight<RopeEnd>>,
    /// Coefficient of friction, 0 being none.
    pub friction: f32,
    /// Whether it collides with itself.
    pub self_collision: bool,
    /// Compliance of its resistance to bending, in rad²/J, 0 being rigid; none if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending: Option<f32>,
    /// Resistance to bending E I, in N·m², the moment being E I times the curvature; none if absent. Only for the solver
    /// `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_stiffness: Option<f32>,
    /// How far it gives when it is pulled, in 1/N: strain per force; not at all if absent. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compliance: Option<f32>,
    /// The sharpest angle it folds to at a particle, in degrees, 180 being straight; any if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_angle_degrees: Option<f32>,
    /// Colour; chosen by its place in the scene if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

impl Default for Rope {
    /// 50 segments over 2 m, 2 cm thick, 1 kg.
    fn default() -> Self {
        Self {
            name: None,
            path: Thread::default(),
            length: None,
            radius: 0.01,
            velocity: [0.0; 3],
            mass: 1.0,
            pins: Vec::new(),
            weights: Vec::new(),
            friction: 0.5,
            self_collision: false,
            bending: None,
            bending_stiffness: None,
            compliance: None,
            least_angle_degrees: None,
            color: None,
        }
    }
}

/// An unmoving plane: the points x with normal · x = offset. What is behind it is solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HalfSpace {
    /// A name of its own, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Out of the solid; of any length above 0.
    pub normal: [f32; 3],
    /// Distance of the plane from the origin along the normal, in m.
    pub offset: f32,
    /// Coefficient of friction, 0 being none.
    pub friction: f32,
    /// Speed apart over speed together of a collision, 0 to 1; of two bodies the larger counts. Only for the solver
    /// `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f32>,
    /// How far, in m, the normal force acts in front of the point of contact of what rolls on it; as that of a rigid
    /// body. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f32>,
    /// Colour; a grey if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

impl Default for HalfSpace {
    /// The floor at y = 0.
    fn default() -> Self {
        Self {
            name: None,
            normal: [0.0, 1.0, 0.0],
            offset: 0.0,
            friction: 0.5,
            restitution: None,
            rolling_friction: None,
            color: None,
        }
    }
}

/// The inside of an unmoving box: six half-spaces, drawn as walls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Room {
    /// A name of its own, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Inner corner with the smallest coordinates, in m.
    pub min: [f32; 3],
    /// Inner corner with the largest coordinates, in m.
    pub max: [f32; 3],
    /// Coefficient of friction, 0 being none.
    pub friction: f32,
    /// Speed apart over speed together of a collision, 0 to 1; of two bodies the larger counts. Only for the solver
    /// `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f32>,
    /// How far, in m, the normal force acts in front of the point of contact of what rolls on it; as that of a rigid
    /// body. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f32>,
    /// Colour; a grey if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

impl Default for Room {
    /// 4 m × 4 m × 4 m on the floor y = 0.
    fn default() -> Self {
        Self {
            name: None,
            min: [-2.0, 0.0, -2.0],
            max: [2.0, 4.0, 2.0],
            friction: 0.5,
            restitution: None,
            rolling_friction: None,
            color: None,
        }
    }
}

impl Body {
    /// Its name, if it has one of its own.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Rigid(Rigid { name, .. })
            | Self::Cloth(Cloth { name, .. })
            | Self::Rope(Rope { name, .. })
            | Self::SoftSolid(SoftSolid { name, .. })
            | Self::HalfSpace(HalfSpace { name, .. })
            | Self::Room(Room { name, .. }) => name.as_deref(),
        }
    }

    /// The word that stands for it in a document, and in the path of its fields.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Rigid(_) => "rigid",
            Self::Cloth(_) => "cloth",
            Self::Rope(_) => "rope",
            Self::SoftSolid(_) => "soft_solid",
            Self::HalfSpace(_) => "half_space",
            Self::Room(_) => "room",
        }
    }

    /// How many triangles it gives one by one.
    pub fn triangle_count(&self) -> u64 {
        match self {
            Self::Rigid(rigid) => rigid.shape.triangle_count(),
            Self::Cloth(cloth) => cloth.surface.triangle_count(),
            Self::SoftSolid(solid) => solid.shape.triangle_count(),
            Self::Rope(_) | Self::HalfSpace(_) | Self::Room(_) => 0,
        }
    }

    /// How many particles it asks for at most, where rigid bodies are trusses or are not; 0 for what has none, and
    /// for a mesh file that is not loaded.
    pub fn particle_count(&self, has_trusses: bool) -> u64 {
        match self {
            Self::Rigid(rigid) if has_trusses => rigid.shape.vertex_count(),
            Self::Rigid(_) => 4,
            Self::Cloth(cloth) => cloth.surface.vertex_count(),
            Self::Rope(rope) => rope.path.point_count(),
            Self::SoftSolid(solid) => solid.particle_count(),
            Self::HalfSpace(_) | Self::Room(_) => 0,
        }
    }
}
