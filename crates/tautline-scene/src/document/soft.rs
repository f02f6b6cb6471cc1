//! Soft solids of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::shape::Shape;
use super::value::{Color, Rotation};

/// A solid that gives: a jelly, a tyre, a sponge. Only for the solver `default`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SoftSolid {
    /// A name of its own, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its shape at rest, in its own frame: one closed surface, whose vertices become particles; the inside of a box is
    /// divided in `cells`. What is round is faceted as a truss is.
    pub shape: Shape,
    /// Cells along X, Y and Z of a box; 4 each if absent. For no other shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<[u32; 3]>,
    /// At most so many triangles have the surface that is simulated, which moves the shape as it is drawn; `pins` and
    /// attachments count the vertices of the coarser one. Not for a box, which has `cells`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coarse_triangles: Option<u32>,
    /// Where its frame is, in m.
    pub position: [f32; 3],
    /// How its frame is turned.
    pub rotation: Rotation,
    /// Velocity, in m/s.
    pub velocity: [f32; 3],
    /// Angular velocity about the origin of its frame, in rad/s.
    pub angular_velocity: [f32; 3],
    /// Mass, in kg. Either this or `density`; without both the density is 1000 kg/m³.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f32>,
    /// Density, in kg/m³.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f32>,
    /// Young's modulus, in Pa.
    pub young_modulus: f32,
    /// Poisson's ratio, 0 to 0.49.
    pub poisson_ratio: f32,
    /// Coefficient of friction, 0 being none.
    pub friction: f32,
    /// How far from solids it is kept, in m; chosen by the distance of its particles if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f32>,
    /// Whether it collides with itself.
    pub self_collision: bool,
    /// Particles that never move: indices of vertices.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pins: Vec<u32>,
    /// Colour; chosen by its place in the scene if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

impl Default for SoftSolid {
    /// A jelly cube of 1 m.
    fn default() -> Self {
        Self {
            name: None,
            shape: Shape::default(),
            cells: None,
            coarse_triangles: None,
            position: [0.0; 3],
            rotation: Rotation::default(),
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            mass: None,
            density: None,
            young_modulus: 1e5,
            poisson_ratio: 0.45,
            friction: 0.5,
            thickness: None,
            self_collision: true,
            pins: Vec::new(),
            color: None,
        }
    }
}

impl SoftSolid {
    /// Cells of a box if it does not say how many.
    pub const CELLS: [u32; 3] = [4; 3];

    /// How many particles it has on its surface and, if it is a box, inside; at most so many if it is made coarser. 0 for a
    /// file that is not loaded.
    pub fn particle_count(&self) -> u64 {
        match self.shape {
            Shape::Box { .. } => {
                let along = |count: u32| u64::from(count).saturating_add(1);
                self.cells.unwrap_or(Self::CELLS).map(along).into_iter().fold(1, u64::saturating_mul)
            }
            ref shape => shape.vertex_count(),
        }
    }
}
