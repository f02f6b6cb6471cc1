//! Attachments of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::value::{BodyRef, RopeEnd, SheetPlace};

/// What keeps two points together, of which one at least is on cloth or rope; between rigid bodies there are joints.
///
/// It is only for the solver `default`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Attachment {
    /// One end.
    pub a: Anchor,
    /// The other end.
    pub b: Anchor,
    /// By how much it gives way to a force, in m/N; 0 is as little as a small step allows.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub compliance: f32,
    /// Breaks once the mean force in a step is greater than this, in N; never if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub break_force: Option<f32>,
}

/// A point of a body, or of the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Anchor {
    /// The body; the world if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<BodyRef>,
    /// Where on it.
    pub at: AnchorPlace,
}

/// Where on a body an attachment is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum AnchorPlace {
    /// The point of a rigid body, or of the world, that is here at the start, in m.
    Point([f32; 3]),
    /// A particle of a cloth or rope, by its index.
    Particle(u32),
    /// A corner of a grid of cloth.
    Corner(SheetPlace),
    /// An end of a rope.
    End(RopeEnd),
    /// A place on a triangle of a cloth.
    Triangle {
        /// Its number.
        number: u32,
        /// The shares of its corners, 1 together.
        #[serde(default = "middle")]
        weights: [f32; 3],
    },
    /// A place on a segment of a rope.
    Segment {
        /// Its number.
        number: u32,
        /// How far along it, from 0 to 1.
        #[serde(default)]
        fraction: f32,
    },
}

impl AnchorPlace {
    /// The word that stands for it in a document, and in the path of its fields.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Point(_) => "point",
            Self::Particle(_) => "particle",
            Self::Corner(_) => "corner",
            Self::End(_) => "end",
            Self::Triangle { .. } => "triangle",
            Self::Segment { .. } => "segment",
        }
    }
}

fn middle() -> [f32; 3] {
    [1.0 / 3.0; 3]
}

fn is_zero(number: &f32) -> bool {
    *number == 0.0
}
