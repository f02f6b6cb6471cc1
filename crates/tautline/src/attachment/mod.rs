//! Attachments: what holds cloth and rope to each other, to rigid bodies and to the world.
//!
//! An [`Anchor`] is a point of a body: a particle, a place on a triangle of a cloth or on a segment of a rope, a point of a
//! rigid body, or a point of the world. An attachment keeps two of them together, with forces that are equal and opposite.
//! Between two rigid bodies there are joints for that.

mod build;
mod rest;
mod store;
mod view;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::{Error, positive, within};
use crate::world::BodyHandle;

pub use store::AttachmentHandle;
pub use view::AttachmentView;

pub(crate) use store::Attachments;

/// A point of a body, or of the world, where an attachment holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// `None` = the world.
    body: Option<BodyHandle>,
    place: Place,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Particle(u32),
    Triangle(u32, [f32; 3]),
    Segment(u32, f32),
    Point(Vec3),
}

impl Anchor {
    /// A particle of a cloth or rope.
    pub fn particle(body: BodyHandle, particle: u32) -> Self {
        Self { body: Some(body), place: Place::Particle(particle) }
    }

    /// A point of a triangle of a cloth, by its number in [`BodyView::triangles`](crate::BodyView::triangles) and its
    /// barycentric weights: the shares of its corners, of which none is negative and all are 1 together.
    pub fn triangle(body: BodyHandle, triangle: u32, weights: [f32; 3]) -> Self {
        Self { body: Some(body), place: Place::Triangle(triangle, weights) }
    }

    /// A point of a segment of a rope, by its number in [`BodyView::sticks`](crate::BodyView::sticks): 0 is where the
    /// segment begins, 1 where it ends.
    pub fn segment(body: BodyHandle, segment: u32, fraction: f32) -> Self {
        Self { body: Some(body), place: Place::Segment(segment, fraction) }
    }

    /// A point of a rigid body, in the frame of its shape, in m. It need not be inside. A particle that is held there
    /// does not collide with the body, but its neighbours do: a rope is best held at the surface.
    pub fn point(body: BodyHandle, point: Vec3) -> Self {
        Self { body: Some(body), place: Place::Point(point) }
    }

    /// A point of the world, in m.
    pub fn world(point: Vec3) -> Self {
        Self { body: None, place: Place::Point(point) }
    }
}

/// How firmly an attachment holds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Attachment {
    compliance: f32,
    break_force: Option<f32>,
}

impl Attachment {
    /// By how much it gives way to a force, in m/N; 0 = as little as a small step allows.
    pub fn compliance(self, compliance: f32) -> Self {
        Self { compliance, ..self }
    }

    /// Breaks once the mean force in a step is greater than this, in N.
    pub fn break_force(self, force: f32) -> Self {
        Self { break_force: Some(force), ..self }
    }

    fn validate(&self) -> Result<(), Error> {
        within("compliance", self.compliance, 0.0, 1e20, "a compliance from 0 to 1e20 (m/N)")?;
        self.break_force.map_or(Ok(0.0), |force| positive("break_force", force))?;
        Ok(())
    }
}

/// An attachment in a world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Attached {
    pub(crate) ends: [End; 2],
    strength: Attachment,
    /// The mean force on the first end in the last step, in N.
    force: Vec3,
    is_broken: bool,
}

/// What an attachment holds. Bodies by their indices in the world.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum End {
    /// A weighted mean of particles of a cloth or rope. Those that weigh nothing are not held.
    Particles { body: u32, particles: [u32; 3], weights: [f32; 3] },
    /// A point of a rigid body, in its principal frame, in m.
    Point { body: u32, point: Vec3 },
    /// A point of the world, in m.
    World(Vec3),
}

impl Attached {
    /// In m/N; 0 = stiff.
    pub(crate) fn compliance(&self) -> f32 {
        self.strength.compliance
    }

    fn bodies(&self) -> impl Iterator<Item = u32> {
        self.ends.into_iter().filter_map(End::body)
    }
}

impl End {
    pub(crate) fn body(self) -> Option<u32> {
        match self {
            Self::Particles { body, .. } | Self::Point { body, .. } => Some(body),
            Self::World(_) => None,
        }
    }

    fn body_mut(&mut self) -> Option<&mut u32> {
        match self {
            Self::Particles { body, .. } | Self::Point { body, .. } => Some(body),
            Self::World(_) => None,
        }
    }
}
